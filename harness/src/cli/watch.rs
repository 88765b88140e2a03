//! A running robot at a glance, for a person who types `status` and for Prometheus.

use std::net::{Ipv4Addr, SocketAddr};

use crossguard_endpoint::cause::Cause;
use crossguard_robot::runtime::Running;
use crossguard_robot::trace::Record;

use super::Failure;
use crate::metrics::{self, Shared};

/// How a running robot is watched.
#[derive(clap::Args)]
pub(super) struct WatchArguments {
    /// Serve metrics for Prometheus at this address, or at this port of 127.0.0.1.
    #[arg(long, value_name = "[ADDRESS:]PORT", value_parser = address)]
    metrics: Option<SocketAddr>,
}

fn address(text: &str) -> Result<SocketAddr, String> {
    if let Ok(port) = text.parse::<u16>() {
        return Ok((Ipv4Addr::LOCALHOST, port).into());
    }
    text.parse().map_err(|_| {
        "a port from 0 to 65535, or an address and a port like 127.0.0.1:9100, is wanted".to_owned()
    })
}

/// Tally and metrics of a running robot.
pub(super) struct Watch {
    tally: Shared,
    /// Where metrics are served.
    pub(super) metrics: Option<SocketAddr>,
}

impl WatchArguments {
    /// Begins to watch a robot on this link, in this mode of security.
    pub(super) fn begin(&self, link: String, security: &'static str) -> Result<Watch, Failure> {
        let tally = Shared::default();
        tally.with(|tally| (tally.link, tally.security) = (link, security));
        let serve = |address| {
            metrics::serve(address, tally.clone())
                .map_err(|error| Failure::Input(format!("--metrics {address}: {error}")))
        };
        let metrics = self.metrics.map(serve).transpose()?;
        Ok(Watch { tally, metrics })
    }
}

impl Watch {
    /// Takes in what the robot did.
    pub(super) fn record(&self, record: &Record) {
        self.tally.with(|tally| tally.record(record));
    }

    /// Other stations that were heard, and road users around.
    pub(super) fn surroundings(&self) -> String {
        self.tally.with(|tally| tally.surroundings())
    }

    /// Its link, its security and its channel.
    pub(super) fn equipment(&self) -> String {
        self.tally.with(|tally| tally.equipment())
    }

    /// Takes in what no record tells.
    pub(super) fn look(&self, running: &Running) {
        let inbox_full = running.inbox_full();
        if inbox_full > 0 {
            let cause = Cause::InboxFull.into();
            self.tally
                .with(|tally| tally.causes.set(&cause, inbox_full));
        }
    }
}
