//! One row for what is one event: a broadcast reaches its receivers one after the other, and is drawn once.

use std::collections::VecDeque;

/// Receptions of one packet are no further apart, in microseconds.
const WINDOW_US: u64 = 20_000;

/// Something to be drawn. Robots are named by their columns.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Mark {
    /// Something at one robot.
    Note {
        /// Where.
        lane: usize,
        /// What.
        text: String,
    },
    /// A message.
    Arrow(Arrow),
}

/// A message to one robot, or to several at once.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Arrow {
    /// The same for all receptions of a packet.
    pub(crate) packet: u64,
    /// Its sender.
    pub(crate) from: usize,
    /// Its receivers.
    pub(crate) to: Vec<ArrowHead>,
    /// What it says.
    pub(crate) text: String,
}

/// Where a message ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct ArrowHead {
    /// At this robot.
    pub(crate) lane: usize,
    /// It is lost on the way there.
    pub(crate) is_lost: bool,
}

/// Marks that wait for others to belong to them, each with its time in microseconds.
#[derive(Debug, Default)]
pub(crate) struct Gathering(VecDeque<(u64, Mark)>);

impl Gathering {
    /// Adds a mark, to one that waits where both are of one packet.
    pub(crate) fn add(&mut self, at_us: u64, mark: Mark) {
        if let Mark::Arrow(arrow) = &mark {
            let waiting = self.0.iter_mut().filter_map(|(_, mark)| match mark {
                Mark::Arrow(known) => Some(known),
                Mark::Note { .. } => None,
            });
            for known in waiting {
                if (known.packet, known.from) == (arrow.packet, arrow.from) {
                    for arrival in &arrow.to {
                        if known.to.iter().all(|it| it.lane != arrival.lane) {
                            known.to.push(*arrival);
                        }
                    }
                    return;
                }
            }
        }
        self.0.push_back((at_us, mark));
    }

    /// The marks that nothing can belong to any more at this time.
    pub(crate) fn due(&mut self, now_us: u64) -> Vec<(u64, Mark)> {
        let is_due = |(at_us, _): &&(u64, Mark)| at_us.saturating_add(WINDOW_US) <= now_us;
        let due = self.0.iter().take_while(is_due).count();
        self.0.drain(..due).collect()
    }

    /// All marks that wait.
    pub(crate) fn rest(&mut self) -> Vec<(u64, Mark)> {
        self.0.drain(..).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arrow(packet: u64, lane: usize, is_lost: bool) -> Mark {
        Mark::Arrow(Arrow {
            packet,
            from: 0,
            to: vec![ArrowHead { lane, is_lost }],
            text: "RAM".to_owned(),
        })
    }

    fn note(text: &str) -> Mark {
        Mark::Note {
            lane: 1,
            text: text.to_owned(),
        }
    }

    #[test]
    fn receptions_of_one_packet_are_one_mark_and_others_are_not() {
        let mut gathering = Gathering::default();
        for (at_us, mark) in [
            (0, arrow(7, 1, false)),
            (10, note("heard")),
            (40, arrow(7, 2, true)),
            (50, arrow(8, 1, false)),
        ] {
            gathering.add(at_us, mark);
        }
        assert_eq!(gathering.due(WINDOW_US - 1), []);
        let due = gathering.due(WINDOW_US + 10);
        let [(0, Mark::Arrow(both)), (10, Mark::Note { .. })] = &due[..] else {
            panic!("{due:?}");
        };
        assert_eq!(both.to.len(), 2);
        assert!(both.to[1].is_lost);
        // Once it is drawn, the same octets are another transmission.
        gathering.add(30_000, arrow(7, 1, false));
        assert_eq!(gathering.rest().len(), 2);
        assert_eq!(gathering.rest(), []);
    }
}
