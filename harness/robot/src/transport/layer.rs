//! The fault layer: any transport, with faults on the way in.
//!
//! A datagram that is held back is still on its way: it arrives when its delay is over, and waits from then on.

use std::collections::{BTreeMap, VecDeque};
use std::time::{Duration, Instant};

use crossguard_endpoint::cause::Loss;

use super::{Arrival, Channel, Fate, Faults, Halves, LinkError, Receiver, Source, Transport};

/// How many datagrams may be under way to one receiver.
const UNDER_WAY_MAX: usize = 1_024;

/// How many senders are told apart; those beyond share one channel.
const SOURCES_MAX: usize = 64;

/// A transport with faults. Each sender has a channel of its own to the receiver, so bursts of one
/// are not those of another.
#[derive(Clone, Debug)]
pub struct WithFaults<T> {
    /// Transport of the datagrams.
    pub transport: T,
    /// The faults on the way from every sender.
    pub faults: Faults,
    /// Seed of the draws.
    pub seed: u64,
}

impl<T: Transport> WithFaults<T> {
    /// The same faults on the way from every sender.
    pub const fn new(transport: T, faults: Faults, seed: u64) -> Self {
        Self {
            transport,
            faults,
            seed,
        }
    }
}

impl<T: Transport> Transport for WithFaults<T> {
    fn open(&self) -> Result<Halves, LinkError> {
        let Halves { sender, receiver } = self.transport.open()?;
        if self.faults.is_none() {
            // Nothing stands between the link and a robot that is not being tested.
            return Ok(Halves { sender, receiver });
        }
        let receiver = Faulty {
            receiver,
            faults: self.faults.clone(),
            seed: self.seed,
            began: Instant::now(),
            channels: BTreeMap::new(),
            under_way: BTreeMap::new(),
            count: 0,
            lost: VecDeque::new(),
        };
        Ok(Halves {
            sender,
            receiver: Box::new(receiver),
        })
    }
}

/// A receiver with faults.
struct Faulty {
    receiver: Box<dyn Receiver>,
    faults: Faults,
    seed: u64,
    began: Instant,
    channels: BTreeMap<Option<Source>, Channel>,
    /// By when they arrive, in µs, and in which order they came.
    under_way: BTreeMap<(u64, u64), (Source, Vec<u8>)>,
    count: u64,
    /// Lost datagrams that have not been told yet.
    lost: VecDeque<(Vec<u8>, Loss)>,
}

impl Faulty {
    fn now_us(&self) -> u64 {
        u64::try_from(self.began.elapsed().as_micros()).unwrap_or(u64::MAX)
    }

    /// Decides what becomes of a datagram that came in `at` this time.
    fn take(&mut self, from: Source, octets: Vec<u8>, at: Instant) {
        let came = at.saturating_duration_since(self.began);
        let came_us = u64::try_from(came.as_micros()).unwrap_or(u64::MAX);
        let known = self.channels.contains_key(&Some(from));
        let key = (known || self.channels.len() < SOURCES_MAX).then_some(from);
        let seed = self.seed.wrapping_add(self.channels.len() as u64);
        let channel = self.channels.entry(key);
        let channel = channel.or_insert_with(|| Channel::new(self.faults.clone(), seed));
        match channel.fate(came_us) {
            Fate::Lost(how) => self.lose(octets, how),
            Fate::Arrives {
                after_us,
                again_after_us,
            } => {
                if let Some(after_us) = again_after_us {
                    self.hold(came_us + after_us, from, octets.clone());
                }
                self.hold(came_us + after_us, from, octets);
            }
        }
    }

    fn hold(&mut self, until_us: u64, from: Source, octets: Vec<u8>) {
        if self.under_way.len() >= UNDER_WAY_MAX {
            return self.lose(octets, Loss::Overflow);
        }
        self.count += 1;
        self.under_way
            .insert((until_us, self.count), (from, octets));
    }

    fn lose(&mut self, octets: Vec<u8>, how: Loss) {
        self.lost.push_back((octets, how));
    }

    /// Arrival to tell now: a datagram that was lost, or one that has arrived.
    fn due(&mut self) -> Option<Arrival> {
        if let Some((octets, how)) = self.lost.pop_front() {
            return Some(Arrival::Lost { how, octets });
        }
        let now_us = self.now_us();
        let first = self.under_way.first_entry()?;
        let due_us = first.key().0;
        (due_us <= now_us).then(|| {
            let at = self.began + Duration::from_micros(due_us);
            let (from, octets) = first.remove();
            Arrival::Datagram { from, octets, at }
        })
    }

    /// How long to wait for the transport, so that nothing under way arrives late.
    fn patience(&self, at_most: Duration) -> Duration {
        self.under_way
            .first_key_value()
            .map_or(at_most, |(&(at, _), _)| {
                at_most.min(Duration::from_micros(at.saturating_sub(self.now_us())))
            })
    }
}

impl Receiver for Faulty {
    fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
        if let Some(due) = self.due() {
            return Ok(Some(due));
        }
        let patience = self.patience(at_most);
        match self.receiver.receive(patience)? {
            Some(Arrival::Datagram { from, octets, at }) => {
                self.take(from, octets, at);
                Ok(self.due())
            }
            Some(other) => Ok(Some(other)),
            None => Ok(self.due()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{NotSent, Sender};
    use super::*;

    /// A transport on which these datagrams have come in, each from a sender of its number.
    #[derive(Clone)]
    struct CameIn(VecDeque<(u8, Vec<u8>)>);

    impl Transport for CameIn {
        fn open(&self) -> Result<Halves, LinkError> {
            Ok(Halves::of(self.clone(), self.clone()))
        }
    }

    impl Sender for CameIn {
        fn send(&mut self, _: &[u8]) -> Result<(), NotSent> {
            Ok(())
        }
    }

    impl Receiver for CameIn {
        fn receive(&mut self, at_most: Duration) -> std::io::Result<Option<Arrival>> {
            let Some((from, octets)) = self.0.pop_front() else {
                std::thread::sleep(at_most);
                return Ok(None);
            };
            let (from, at) = (Source::LinkLayer([from; 6]), Instant::now());
            Ok(Some(Arrival::Datagram { from, octets, at }))
        }
    }

    /// What a receiver with these faults takes in of 200 datagrams, by number, and how many are lost; `count` together,
    /// unless more come.
    fn arrivals(faults: &str, count: usize) -> (Vec<u8>, usize) {
        let transport = CameIn((0..200).map(|number| (number % 2, vec![number])).collect());
        let receiving = WithFaults::new(transport, faults.parse().unwrap(), 7);
        let mut receiver = receiving.open().unwrap().receiver;
        let (mut arrived, mut lost) = (Vec::new(), 0);
        let deadline = Instant::now() + Duration::from_mins(1);
        loop {
            match receiver.receive(Duration::from_millis(50)).unwrap() {
                Some(Arrival::Datagram { octets, .. }) => arrived.push(octets[0]),
                Some(Arrival::Lost { .. }) => lost += 1,
                _ if arrived.len() + lost >= count || Instant::now() >= deadline => break,
                _ => {}
            }
        }
        (arrived, lost)
    }

    #[test]
    fn without_faults_everything_arrives_in_order() {
        assert_eq!(arrivals("", 200), ((0..200).collect(), 0));
    }

    #[test]
    fn what_is_lost_and_what_arrives_is_everything() {
        let (arrived, lost) = arrivals("loss=0.5", 200);
        assert!((60..140).contains(&lost), "{lost}");
        assert_eq!(arrived.len() + lost, 200);
        // Each of the two senders has draws of its own.
        let mut channels = [7, 8].map(|seed| Channel::new(Faults::loss(0.5), seed));
        let mut fate = |number: u8| channels[usize::from(number % 2)].fate(0);
        let expected = (0..200).filter(|number| matches!(fate(*number), Fate::Arrives { .. }));
        assert_eq!(arrived, expected.collect::<Vec<_>>());
    }

    #[test]
    fn delayed_and_repeated_datagrams_arrive_each_in_its_time() {
        let (arrived, lost) = arrivals("delay=1..20,duplication=1", 400);
        assert_eq!((arrived.len(), lost), (400, 0));
        assert!(!arrived.is_sorted(), "some have overtaken others");
    }

    #[test]
    fn a_delayed_datagram_is_on_its_way_until_it_is_due_and_waits_from_then_on() {
        let transport = CameIn([(0, b"hello".to_vec())].into());
        let receiving = WithFaults::new(transport, "delay=2000..2000".parse().unwrap(), 7);
        let mut receiver = receiving.open().unwrap().receiver;
        let before = Instant::now();
        assert_eq!(receiver.receive(Duration::from_millis(1)).unwrap(), None);
        let after = Instant::now();
        // It is taken late.
        std::thread::sleep(Duration::from_millis(2_100));
        let heard = receiver.receive(Duration::from_millis(1)).unwrap();
        let Some(Arrival::Datagram { at, .. }) = heard else {
            panic!("nothing has arrived");
        };
        // Times are kept to the microsecond here.
        let (delay, rounding) = (Duration::from_secs(2), Duration::from_micros(2));
        assert!(at + rounding >= before + delay && at <= after + delay + rounding);
    }
}
