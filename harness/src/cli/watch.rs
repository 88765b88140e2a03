//! A running robot at a glance, for a person who types `status` and for Prometheus.

use std::net::{Ipv4Addr, SocketAddr};

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

impl WatchArguments {
    /// Begins to watch a robot on this link, in this mode of security. The address is that of its metrics, if they are
    /// served.
    pub(super) fn begin(
        &self,
        link: String,
        security: &'static str,
    ) -> Result<(Shared, Option<SocketAddr>), Failure> {
        let tally = Shared::default();
        tally.with(|tally| (tally.link, tally.security) = (link, security));
        let serve = |address| {
            metrics::serve(address, tally.clone())
                .map_err(|error| Failure::Input(format!("--metrics {address}: {error}")))
        };
        let metrics = self.metrics.map(serve).transpose()?;
        Ok((tally, metrics))
    }
}
