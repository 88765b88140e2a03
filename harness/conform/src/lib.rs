//! A black-box tester of robots that speak RAM and RMCM.
//!
//! It plays leader, follower, requester, a network that loses and repeats, and a liar, against anybody's robot, and
//! judges what it sees by plain statements, each about one rule of the protocol.
//!
//! ```text
//!   cases.txt ──► case ──► bench (two stations) ◄──packets──► robot under test
//!                            │                                     ▲
//!                            ▼                                     │ what happens at it: typed, by a script,
//!                         exchange ──► statements ──► verdicts     │ by a person, or by itself
//!                                                                  │
//!                            └─────────────────────────────────────┘
//! ```
//!
//! - [`case`] plays a case; [`play`] has the words in which cases are written.
//! - [`exchange`] is all that a verdict may look at; [`statements`] say what must be true of it.
//! - [`campaign`] plays all cases, and says for each rule whether it was kept.
//! - [`subject`] is the robot under test: [`live`] over a link, or in a test in virtual time.
//!
//! **The statements share no code with what they judge.** They read messages and times; packets are encoded and decoded
//! by the codec. The transition function runs where it is the robot, in tests, and nowhere else.

mod bench;
pub mod campaign;
pub mod case;
pub mod exchange;
pub mod live;
mod perform;
pub mod play;
pub mod rules;
pub mod statements;
mod station;
pub mod subject;
mod words;

pub use bench::Terms;
pub use station::Beating;
