//! `crossguard explore`.

use std::net::SocketAddr;

use crossguard_model_check::explore::Explorer;
use crossguard_model_check::scenario::Scenario;

use super::interrupts::interrupts_that;
use super::ranges::address;
use super::{Failure, print};

#[derive(clap::Args)]
pub(super) struct Arguments {
    /// A shipped scenario by name, or a file.
    #[arg(value_name = "SCENARIO|FILE")]
    scenario: String,
    /// Where to serve it.
    #[arg(long, default_value = "127.0.0.1:3000", value_parser = address::<SocketAddr>)]
    address: SocketAddr,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scenario = Scenario::load(&arguments.scenario).map_err(Failure::input)?;
    let scenario = super::check::untimed(scenario)?;
    let address = arguments.address;
    let explorer = Explorer::new(scenario, address)
        .map_err(|cause| Failure::input(format!("{address}: {cause}")))?;
    print(format_args!(
        "Open http://{address}/ in a browser; Ctrl-C ends it."
    ))?;
    // Nothing is lost with it.
    let _ = interrupts_that(|| std::process::exit(0));
    explorer.serve();
    Ok(())
}
