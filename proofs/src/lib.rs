//! The proofs of Crossguard: harnesses that Kani proves, over the laws of the crates that own the
//! types.
//!
//! ```text
//!  laws of protocol, crossing and codec ◄── harnesses here ◄── cargo kani: every value
//!                                       ◄──                ◄── tests/harnesses.rs: random values
//!                                       ◄── tests: proptest, with shrinking; sweeps over all values
//! ```
//!
//! A harness chooses symbolic values, states its bound by `kani::assume`, calls a law, and marks
//! with `kani::cover!` each class of outcomes that must be reachable. In an ordinary build `kani`
//! is the [`stand_in`], which makes a harness a function that runs with random values.
//!
//! `proofs/run` proves all of them, and `times.tsv` has how long that took.

pub mod codec;
pub mod crossing;
mod harness;
pub mod protocol;
#[cfg(not(all(kani, not(feature = "stand-in"))))]
pub mod stand_in;
mod symbolic;

#[cfg(all(kani, not(feature = "stand-in")))]
pub(crate) use ::kani;
pub use harness::Harness;
#[cfg(not(all(kani, not(feature = "stand-in"))))]
pub(crate) use stand_in as kani;
pub use symbolic::Symbolic;

/// All harnesses.
#[cfg(not(all(kani, not(feature = "stand-in"))))]
pub fn harnesses() -> impl Iterator<Item = &'static Harness> {
    [
        protocol::numbers::HARNESSES,
        protocol::lists::HARNESSES,
        protocol::lease::HARNESSES,
        protocol::settings::HARNESSES,
        protocol::boot::HARNESSES,
        protocol::idle::HARNESSES,
        protocol::requesting::HARNESSES,
        protocol::offering::HARNESSES,
        protocol::following::HARNESSES,
        protocol::leading::conduct::HARNESSES,
        protocol::leading::peers::HARNESSES,
        protocol::leading::road::HARNESSES,
        protocol::ignored::HARNESSES,
        protocol::timers::HARNESSES,
        protocol::exchange::leader::HARNESSES,
        protocol::exchange::follower::HARNESSES,
        protocol::exchange::frame::HARNESSES,
        crossing::HARNESSES,
        codec::time::HARNESSES,
        codec::si::HARNESSES,
        codec::geonet::HARNESSES,
        codec::view::HARNESSES,
        codec::core::bits::HARNESSES,
        codec::core::cdd::HARNESSES,
        codec::core::common::HARNESSES,
        codec::core::ram::HARNESSES,
        codec::core::rmcm::HARNESSES,
        codec::core::whole::HARNESSES,
    ]
    .into_iter()
    .flatten()
}
