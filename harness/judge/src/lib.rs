//! Judges of robots, and drawings of their runs.
//!
//! ```
//! use crossguard_judge::sim::Fuzz;
//!
//! // Three streets of up to four robots, with whatever goes wrong on them.
//! let streets = Fuzz { seeds: 3, robots: 4, sensors: 0.5, liars: 0.25, ..Fuzz::default() };
//! let totals = streets.run(&|_| true);
//! assert_eq!((totals.seeds, totals.violations), (3, 0));
//! ```
//!
//! - [`sim`] runs many robots in virtual time under seeded faults, and judges every step by the properties of
//!   the model checker.
//! - [`validate`] says whether logs of one or several robots are of something that could have happened.
//! - [`facts`] works out of logs where robots are and what they do, [`playback`] that at any time, for the studio and for
//!   reports; [`verdict`] is what validation says, in words; [`chart`] is a sequence chart, [`timing`] the table of times.
//! - [`readable`] has messages and packets as JSON; [`sniffer`] says what is in packets.

pub mod chart;
#[cfg(feature = "full")]
pub mod facts;
#[cfg(feature = "full")]
pub mod playback;
#[cfg(feature = "foreign")]
pub mod readable;
#[cfg(feature = "foreign")]
pub mod signature;
#[cfg(feature = "full")]
pub mod sim;
#[cfg(feature = "full")]
pub mod sniffer;
pub mod timing;
pub mod validate;
pub mod verdict;

/// Microseconds as seconds.
#[expect(clippy::cast_precision_loss, reason = "a run takes minutes")]
fn seconds(us: u64) -> f64 {
    us as f64 / 1e6
}
