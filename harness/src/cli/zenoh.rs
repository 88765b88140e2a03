//! What commands that listen or send have for zenoh, and `crossguard router`.

use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::Duration;

use crossguard_robot::transport::{Link, Zenoh, ZenohMode, ZenohRouter};

use super::interrupts::interrupts;
use super::{Failure, choices, print};

/// How often a router looks whether it is to stop.
const TICK: Duration = Duration::from_millis(50);

#[derive(clap::Args)]
#[group(skip)]
pub(super) struct ZenohArguments {
    /// Meet over zenoh: connected to each other robot, through a router, or as a router. Unless more is
    /// named, peers find each other on this machine, and nothing leaves it. Takes a program that was
    /// built with --features zenoh.
    #[arg(long, value_parser = choices::zenoh(), value_name = "MODE", group = "link")]
    zenoh: Option<ZenohMode>,
    /// Connect to a zenoh router or peer, like tcp/192.0.2.1:7447 (tcp, udp or tls); may be repeated.
    #[arg(long, value_name = "ENDPOINT", requires = "zenoh")]
    zenoh_connect: Vec<String>,
    /// Let zenoh listen on an endpoint, like tcp/0.0.0.0:7447; may be repeated.
    #[arg(long, value_name = "ENDPOINT", requires = "zenoh")]
    zenoh_listen: Vec<String>,
    /// Look for others by zenoh's multicast scouting on this interface.
    #[arg(long, value_name = "NAME", requires = "zenoh")]
    zenoh_scout: Option<String>,
    /// The zenoh key below which robots publish [default: crossguard/v2x].
    #[arg(long, value_name = "KEY", requires = "zenoh")]
    zenoh_key: Option<String>,
    /// Settings of zenoh in its own format, like certificates for TLS.
    #[arg(long, value_name = "FILE", requires = "zenoh")]
    zenoh_config: Option<PathBuf>,
}

impl ZenohArguments {
    /// The link, if it is to be over zenoh.
    pub(super) fn link(&self) -> Option<Link> {
        let part = Zenoh::new(self.zenoh?);
        Some(Link::Zenoh(Zenoh {
            connect: self.zenoh_connect.clone(),
            listen: self.zenoh_listen.clone(),
            scout: self.zenoh_scout.clone(),
            key: self.zenoh_key.clone().unwrap_or(part.key),
            config: self.zenoh_config.clone(),
            ..part
        }))
    }
}

#[derive(clap::Args)]
pub(super) struct RouterArguments {
    /// Listen on this endpoint; may be repeated [default: tcp/127.0.0.1:7447].
    #[arg(long, value_name = "ENDPOINT")]
    listen: Vec<String>,
    /// Connect to another router; may be repeated.
    #[arg(long, value_name = "ENDPOINT")]
    connect: Vec<String>,
    /// Settings of zenoh in its own format, like certificates for TLS.
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
}

pub(super) fn route(arguments: &RouterArguments) -> Result<(), Failure> {
    let part = Zenoh {
        listen: arguments.listen.clone(),
        connect: arguments.connect.clone(),
        config: arguments.config.clone(),
        ..Zenoh::new(ZenohMode::Router)
    };
    let interrupted = interrupts();
    // It routes until the end of this function.
    let _router = ZenohRouter::open(&part).map_err(Failure::input)?;
    print(format_args!("Routing, {}. Ctrl-C stops.", part.places()))?;
    while !interrupted.load(Ordering::Relaxed) {
        std::thread::sleep(TICK);
    }
    Ok(())
}
