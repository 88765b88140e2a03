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
    /// Its text.
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

impl Mark {
    /// Takes over the receivers of the same packet.
    fn join(&mut self, other: &Self) {
        if let (Self::Arrow(known), Self::Arrow(arrow)) = (self, other) {
            for arrival in &arrow.to {
                if known.to.iter().all(|it| it.lane != arrival.lane) {
                    known.to.push(*arrival);
                }
            }
        }
    }
}

/// Whether there is something to draw: of a message that nobody needs to see, there is not.
fn is_drawn((_, mark): &(u64, Mark)) -> bool {
    !matches!(mark, Mark::Arrow(arrow) if arrow.to.is_empty())
}

/// Marks that wait for others to belong to them, each with its time in microseconds.
#[derive(Debug, Default)]
pub(crate) struct Gathering(VecDeque<(u64, Mark)>);

impl Gathering {
    /// Adds a mark in the order of time, to one that waits where both are of one packet: that stands where it was sent.
    pub(crate) fn add(&mut self, at_us: u64, mut mark: Mark) {
        if let Some(place) = self.of_packet(&mark) {
            let (known_us, known) = &mut self.0[place];
            known.join(&mark);
            if at_us >= *known_us {
                return;
            }
            if let Some((_, known)) = self.0.remove(place) {
                mark = known;
            }
        }
        let place = self.0.partition_point(|(before_us, _)| *before_us <= at_us);
        self.0.insert(place, (at_us, mark));
    }

    /// Where a mark of the same packet waits.
    fn of_packet(&self, mark: &Mark) -> Option<usize> {
        let Mark::Arrow(arrow) = mark else {
            return None;
        };
        let is_same = |(_, known): &(u64, Mark)| match known {
            Mark::Arrow(known) => (known.packet, known.from) == (arrow.packet, arrow.from),
            Mark::Note { .. } => false,
        };
        self.0.iter().position(is_same)
    }

    /// The marks that nothing can belong to any more at this time.
    pub(crate) fn due(&mut self, now_us: u64) -> Vec<(u64, Mark)> {
        let is_due = |(at_us, _): &&(u64, Mark)| at_us.saturating_add(WINDOW_US) <= now_us;
        let due = self.0.iter().take_while(is_due).count();
        self.0.drain(..due).filter(is_drawn).collect()
    }

    pub(crate) fn rest(&mut self) -> Vec<(u64, Mark)> {
        self.0.drain(..).filter(is_drawn).collect()
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

    #[test]
    fn a_message_stands_where_it_was_sent_and_nobody_sees_one_that_nobody_hears() {
        let mut gathering = Gathering::default();
        let Mark::Arrow(heard) = arrow(7, 1, false) else {
            unreachable!()
        };
        let sent = |packet| {
            let (to, heard) = (Vec::new(), heard.clone());
            Mark::Arrow(Arrow {
                packet,
                to,
                ..heard
            })
        };
        gathering.add(10, arrow(7, 1, false));
        gathering.add(5, note("what the sender did next"));
        gathering.add(4, sent(7));
        gathering.add(3, sent(8));
        let rest = gathering.rest();
        assert!(
            matches!(&rest[..], [(4, Mark::Arrow(_)), (5, Mark::Note { .. })]),
            "{rest:?}"
        );
    }
}
