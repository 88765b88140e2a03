//! The commands that a full build has beside the demonstration and the checker.

use clap::Subcommand;

use super::{
    Failure, codec, conform, export, fuzz, new, odds, pki, report, run, simulate, sniff, studio,
    validate,
};

#[derive(Subcommand)]
pub(super) enum Command {
    /// Make a folder with a site, a plan, two robots and people, to run as it is and to change.
    New(new::Arguments),
    /// Run one robot as one process, or all of a folder; events are typed or piped in.
    Run(Box<run::Arguments>),
    /// Work out how likely a crossing goes well when messages get lost, and how long it takes.
    Odds(Box<odds::Arguments>),
    /// Run many simulated robots in virtual time under drawn faults, and judge every step.
    Fuzz(fuzz::Arguments),
    /// Test anybody's robot from outside, over its link: play the others, and say for each rule whether it was kept.
    Conform(Box<conform::Arguments>),
    /// Tell whether logs of one or several robots are of something that could have happened.
    Validate(validate::Arguments),
    /// Write a page about a run: the studio's page After as one file.
    Report(report::Arguments),
    /// Look at logs in a browser: the street, the messages, states and timers at any time of the run.
    Studio(studio::Arguments),
    /// Convert logs to what other tools read: facts as JSON lines.
    Export(export::Arguments),
    /// Repeat the paper's evaluation: coverage and channel load on a grid of streets.
    ///
    /// Without a subcommand it ranks the intersections by the coverage that a robot there adds to those ranked before.
    Simulate(Box<simulate::Arguments>),
    /// Print what is in a capture, one line per message.
    Sniff(sniff::Arguments),
    /// Convert messages between octets and JSON.
    #[command(subcommand)]
    Codec(codec::Command),
    /// Make and show the certificates and keys of a PKI for tests.
    #[command(subcommand)]
    Pki(pki::Command),
}

/// Does what the command says.
pub(super) fn carry_out(command: Command) -> Result<(), Failure> {
    match command {
        Command::New(arguments) => new::run(&arguments),
        Command::Run(arguments) => run::run(&arguments),
        Command::Odds(arguments) => odds::run(&arguments),
        Command::Conform(arguments) => conform::run(&arguments),
        Command::Validate(arguments) => validate::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Studio(arguments) => studio::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Fuzz(arguments) => fuzz::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Sniff(arguments) => sniff::run(&arguments),
        Command::Codec(command) => codec::run(&command),
        Command::Pki(command) => pki::run(&command),
    }
}
