//! The thread that takes datagrams off the link.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::mpsc::{SyncSender, TrySendError};
use std::time::Duration;

use super::partners::Partners;
use super::{DATAGRAMS, Delivery, OF_PARTNERS};
use crate::transport::{Arrival, Receiver};

/// How long the reader leaves a link alone that has failed.
const LINK_REST: Duration = Duration::from_millis(200);

/// How long the reader waits for a datagram before it looks whether it should stop. A reader that looks less
/// often is known to have hung, and its datagrams to have waited, by that much later.
const READER_WAIT: Duration = Duration::from_millis(10);

/// Datagrams between the reader and the loop.
#[derive(Debug, Default)]
pub(super) struct Waiting {
    /// How many are in the inbox.
    pub(super) datagrams: AtomicUsize,
    /// How many were dropped and are not counted yet.
    pub(super) dropped: AtomicU64,
    pub(super) dropped_in_all: AtomicU64,
    /// How many the socket had no room for, which are not counted yet.
    pub(super) overflowed: AtomicU64,
    /// Robots whose datagrams have places of their own.
    pub(super) partners: Partners,
}

impl Waiting {
    /// Whether there is a place for what arrived.
    fn has_place(&self, delivery: &Delivery) -> bool {
        let taken = self.datagrams.load(Ordering::Relaxed);
        if taken < DATAGRAMS {
            return true;
        }
        let Delivery::Arrived(Ok(Arrival::Datagram { octets, .. })) = delivery else {
            return false;
        };
        taken < DATAGRAMS + OF_PARTNERS && self.partners.include(octets)
    }

    /// There is no place for one more.
    fn drop_one(&self) {
        self.dropped.fetch_add(1, Ordering::Relaxed);
        self.dropped_in_all.fetch_add(1, Ordering::Relaxed);
    }
}

/// Takes datagrams off the link, so that it does not have to keep them.
pub(super) struct Reader {
    pub(super) receiver: Box<dyn Receiver>,
    pub(super) deliveries: SyncSender<Delivery>,
    pub(super) waiting: Arc<Waiting>,
    pub(super) stop: Arc<AtomicBool>,
}

impl Reader {
    pub(super) fn run(mut self) {
        while !self.stop.load(Ordering::Relaxed) {
            let Some(arrival) = self.receiver.receive(READER_WAIT).transpose() else {
                continue;
            };
            // It takes no place: the datagram that comes with it may be the last one that has one.
            if let Ok(Arrival::Overflow(count)) = arrival {
                let overflowed = &self.waiting.overflowed;
                overflowed.fetch_add(count.into(), Ordering::Relaxed);
                continue;
            }
            let has_failed = arrival.is_err();
            if !self.deliver(Delivery::Arrived(arrival)) {
                return;
            }
            if has_failed {
                // An interface that is gone may come back; until then there is no hurry.
                std::thread::sleep(LINK_REST);
            }
        }
    }

    /// Puts something into the inbox, if it has a place for it. Whether there still is an inbox.
    fn deliver(&self, delivery: Delivery) -> bool {
        let datagrams = &self.waiting.datagrams;
        if !self.waiting.has_place(&delivery) {
            self.waiting.drop_one();
            return true;
        }
        datagrams.fetch_add(1, Ordering::Relaxed);
        match self.deliveries.try_send(delivery) {
            Ok(()) => true,
            Err(TrySendError::Full(_)) => {
                datagrams.fetch_sub(1, Ordering::Relaxed);
                self.waiting.drop_one();
                true
            }
            Err(TrySendError::Disconnected(_)) => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;
    use std::time::Instant;

    use crossguard_codec::geonet::{EgoPosition, Stack};
    use crossguard_codec::{Identifiers, Service};
    use crossguard_endpoint::cause::Cause;
    use crossguard_protocol::{Config, Decimetres, Heartbeat, SessionNumber, StationId};
    use crossguard_protocol::{Coordination, Event, HelpRequest, Input, Place, Ram, Robot};
    use crossguard_protocol::{TaskSet, UniqueNumber, Urgency};

    use super::*;
    use crate::application::Application;
    use crate::body::{Build, Simulated};
    use crate::journal::{RECORDS, WhenFull};
    use crate::runtime::Setup;
    use crate::site::Site;
    use crate::trace::Entry;
    use crate::transport::{Halves, NotSent, Sender, Source};

    fn from(station: u32) -> Delivery {
        let mut stack = Stack::of_robot(Identifiers::default(), StationId(station));
        let packet = stack.packet(&EgoPosition::default(), Service::Ram, b"anything");
        Delivery::Arrived(Ok(Arrival::Datagram {
            from: Source::Unknown,
            octets: packet.unwrap(),
            at: Instant::now(),
        }))
    }

    /// A robot that has offered its help to station 1.
    fn helper() -> Robot {
        let mut robot = Robot::new(StationId(2), 1);
        let request = HelpRequest {
            urgency: Urgency::High,
            followers: 1,
            tasks: TaskSet(u16::MAX),
            place: Place::UNKNOWN,
        };
        let ram = Ram {
            station: StationId(1),
            coordination: Coordination::NeedHelp {
                number: SessionNumber(UniqueNumber { boot: 1, count: 0 }),
                heartbeat: Heartbeat(0),
                request,
            },
            farewell: None,
            on_duty: false,
        };
        let distance = Decimetres(10);
        robot.step(&Config::default(), Input::Ram { ram, distance });
        assert!(robot.session().is_some());
        robot
    }

    #[test]
    fn a_flood_leaves_places_for_the_robots_of_the_session() {
        let waiting = Waiting::default();
        let identifiers = Identifiers::default();
        waiting.partners.follow(&helper(), &identifiers);
        let has_place = |taken, station| {
            waiting.datagrams.store(taken, Ordering::Relaxed);
            waiting.has_place(&from(station))
        };
        assert!(has_place(DATAGRAMS - 1, 9));
        assert!(!has_place(DATAGRAMS, 9));
        assert!(has_place(DATAGRAMS, 1));
        assert!(!has_place(DATAGRAMS + OF_PARTNERS, 1));
        let mut idle = helper();
        idle.step(&Config::default(), Input::Local(Event::LeaveRequested));
        waiting.partners.follow(&idle, &identifiers);
        assert!(!has_place(DATAGRAMS, 1));
    }

    /// A link on which these arrive, and nothing after them.
    struct Given(VecDeque<Arrival>);

    impl Receiver for Given {
        fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
            let next = self.0.pop_front();
            if next.is_none() {
                std::thread::sleep(at_most);
            }
            Ok(next)
        }
    }

    impl Sender for Given {
        fn send(&mut self, _: &[u8]) -> Result<(), NotSent> {
            Ok(())
        }
    }

    #[test]
    fn datagrams_that_the_socket_had_no_room_for_are_in_log_and_counters() {
        let Delivery::Arrived(Ok(next)) = from(9) else {
            panic!("no datagram");
        };
        let arrivals = Given([Arrival::Overflow(57), next].into());
        let (build, site, place) = (
            Build::Quadruped,
            Site::default(),
            crate::site::Place::default(),
        );
        let body = Simulated::new(build, site, place, 1.0, 1);
        let application = Application::new(Box::new(body), None);
        let link = Halves::of(Given(VecDeque::new()), arrivals);
        let mut setup = Setup::new("R1", StationId(1), application, link);
        let (length, lost) = (RECORDS, Cause::OutputFull);
        let records = setup.journal.reader(length, WhenFull::Skip, lost);
        let robot = setup.start();
        let full = Cause::SocketFull.into();
        let is_told = |entry: &Entry| matches!(entry, Entry::Dropped { cause, detail, .. } if *cause == full && detail.contains("57"));
        let deadline = Instant::now() + Duration::from_secs(30);
        let mut told = records.iter().map(|it| is_told(&it.entry));
        while !told.next().unwrap() {
            assert!(Instant::now() < deadline, "it is not in the log");
        }
        robot.stop().unwrap();
        let mut counted = [0; 2];
        for record in records {
            match &record.entry {
                Entry::Unrecorded { counters } => counted[0] += counters.of(&full),
                Entry::Stopped { counters } => counted[1] += counters.of(&full),
                _ => {}
            }
        }
        assert_eq!(counted, [56, 57]);
    }
}
