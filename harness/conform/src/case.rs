//! Cases: what the tester does one after the other, and playing one.

use crossguard_codec::geonet::Envelope;
use crossguard_protocol::StationId;

use crate::bench::{Bench, Terms};
use crate::exchange::Exchange;
use crate::play::Play;
use crate::subject::{Gone, NotTold, Subject};

/// The cases, one a line.
const CASES: &str = include_str!("cases.txt");

/// A case.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Case {
    /// The tester's plays, in order.
    pub plays: Vec<Play>,
    /// The statements that it is there for, by name.
    pub statements: Vec<String>,
}

impl Case {
    /// All cases, in the order in which they are played.
    ///
    /// # Panics
    /// Never: a test reads the file.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let cases: Option<_> = CASES.lines().map(Self::parse).collect();
        cases.expect("the file of cases is well-formed")
    }

    fn parse(line: &str) -> Option<Self> {
        let (plays, statements) = line.split_once(" => ")?;
        let plays: Option<_> = plays.split("; ").map(Play::of_words).collect();
        Some(Self {
            plays: plays?,
            statements: statements.split(' ').map(str::to_owned).collect(),
        })
    }

    /// The tester's plays, in words.
    #[must_use]
    pub fn words(&self) -> String {
        let words: Vec<_> = self.plays.iter().map(|play| play.words()).collect();
        words.join("; ")
    }
}

/// Result of a case.
#[derive(Clone, Debug)]
pub struct Played {
    /// All that was seen.
    pub exchange: Exchange,
    /// How many of the plays were done.
    pub done: usize,
    /// Why no more of them were.
    pub stopped: Option<Stopped>,
}

/// Why a case was not played to its end.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Stopped {
    /// The robot's situation is not the one that the next play needs.
    #[error("the robot is {situation}, which is no situation for '{play}'")]
    OutOfPlace {
        /// The robot's situation by its messages.
        situation: String,
        /// The play that was to be done.
        play: &'static str,
    },
    /// Something could not be brought about at the robot.
    #[error(transparent)]
    NotTold(#[from] NotTold),
    /// The robot ended, as a program does that is there for one crossing. Nothing is asked of it from then on.
    #[error("the robot has ended by itself")]
    Ended,
}

/// The tester's side of a case: who plays, under which signatures, and how often it has booted.
#[derive(Clone, Debug)]
pub struct Table {
    /// The robot under test.
    pub robot: StationId,
    /// Assumptions on it.
    pub terms: Terms,
    /// Envelopes of the packets of the tester's stations.
    pub envelopes: [Envelope; 2],
    /// The boot counter of the tester's stations; larger at each case.
    pub boot: u16,
}

/// How long a robot may take to say something after it was started, in ms.
const STARTS_MS: u64 = 15_000;

/// Plays a case against a robot that is at rest. The robot is borrowed, so that it can be played against again.
///
/// # Errors
/// The robot or the link is gone.
pub fn play<S: Subject>(subject: &mut S, table: &Table, plays: &[Play]) -> Result<Played, Gone> {
    let mut bench = Bench::new(subject, table.clone());
    if !bench.pass_until(STARTS_MS, |bench| bench.said().is_some())? {
        let station = table.robot;
        let text = format!("station {station} says nothing for {} s", STARTS_MS / 1_000);
        return Err(Gone::Robot(text));
    }
    let (mut done, mut stopped) = (0, None);
    for (i, play) in plays.iter().enumerate() {
        let fits = match bench.perform(*play, i + 1 == plays.len()) {
            Err(Gone::Ended) => {
                stopped = Some(Stopped::Ended);
                break;
            }
            fits => fits?,
        };
        if let Some(why) = bench.not_told.take() {
            stopped = Some(why.into());
            break;
        }
        if !fits {
            let now_ms = bench.subject.now_ms();
            stopped = Some(Stopped::OutOfPlace {
                situation: bench.exchange.situation_at(now_ms),
                play: play.words(),
            });
            break;
        }
        done += 1;
    }
    Ok(Played {
        exchange: bench.exchange,
        done,
        stopped,
    })
}
