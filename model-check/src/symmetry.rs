//! One state for all that differ in which of some identical robots is which.
//!
//! A scenario may name robots that are *symmetric*: to exchange any two of them, in every place where
//! a state speaks of them, turns each run into another run. So the states fall into classes of such as
//! differ by an exchange alone, and of each class one state is explored.
//!
//! # Why this is exact
//!
//! An exchange moves the robots' nodes, the messages on their way, and the history, with the station
//! ids in all of them. Every part of the model treats symmetric robots alike:
//!
//! * All robots run the same transition function with the same configuration, all are equally far
//!   apart, and symmetric ones detect nothing. So the initial state stays as it is, and what can happen
//!   to one of them can happen to the other.
//! * The transition function asks for the order of two station ids in two places. Of two requesters the
//!   lower one goes before: symmetric robots never request. Of two equal offers the lower one is the
//!   better: the number of followers is that of all other robots, nobody changes its pseudonym and so
//!   offers under two station ids, and a requester that selects at all selects them all. The order of
//!   offers and members in their lists is left, and it is put right by
//!   [`Renaming`].
//!   The rules that a test puts in the protocol's place must not ask for more.
//! * The receivers of one broadcast hear it in any order. If those listed first heard it first, the
//!   scenario's order would tell symmetric robots apart.
//! * The properties speak about all robots, or about any one robot's step. Properties of runs under fairness
//!   are refused: each robot's timers are fair on their own, and where robots change places along a run,
//!   one of them could wait for ever unseen.
//!
//! An exchange is thus an automorphism of the transition system, and it keeps the properties. Then the
//! system of the classes is bisimilar to the one of all states: a state is reachable if and only if one
//! of its class is, and L7 holds in both or in neither. The state that stands for a class is the one with
//! the smallest numbers of its parts, which are given in the order of first use. Which state it is depends
//! on that order; how many there are does not. Names are ranked within the station that gave them out, so
//! ranking and exchanging commute.

use crossguard_protocol::{Renaming, StationId};
use smallvec::SmallVec;

use crate::memo::MemoOfNumbers;
use crate::network::{Network, Transmission};
use crate::scenario::{MAX_ROBOTS, Scenario};

/// How many symmetric robots a scenario may have: one robot at least detects.
const MAX_SYMMETRIC: usize = MAX_ROBOTS - 1;

/// One way to exchange the symmetric robots.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Exchange {
    /// Where the robot at each place goes.
    places: [u8; MAX_ROBOTS],
    stations: SmallVec<[(StationId, StationId); MAX_SYMMETRIC]>,
}

impl Exchange {
    pub(crate) fn place(&self, place: usize) -> usize {
        self.places[place].into()
    }

    /// A set of places, one bit for each, after the exchange.
    pub(crate) fn bits(&self, places: u8) -> u8 {
        let members = (0..MAX_ROBOTS).filter(|place| places & 1 << place != 0);
        members.fold(0, |all, place| all | 1 << self.places[place])
    }

    /// A message on its way after the exchange, the message itself replaced by `message`.
    pub(crate) fn transmission(
        &self,
        sent: Transmission,
        message: impl Fn(u16) -> u16,
    ) -> Transmission {
        let place = |place: u8| self.places[usize::from(place)];
        Transmission {
            from: place(sent.from),
            to: place(sent.to),
            message: message(sent.message),
        }
    }

    /// A network after the exchange, its messages on air or delayed replaced by `message`.
    pub(crate) fn network(&self, network: &Network, message: impl Fn(u16) -> u16) -> Network {
        let mut exchanged = network.map(|sent| self.transmission(sent, &message));
        exchanged.sort_broadcasts();
        exchanged
    }
}

impl Renaming for &Exchange {
    fn station(&mut self, station: StationId) -> StationId {
        let exchanged = self.stations.iter().find(|(from, _)| *from == station);
        exchanged.map_or(station, |(_, to)| *to)
    }
}

/// All ways to exchange the symmetric robots of a scenario; none where it names none.
fn exchanges(scenario: &Scenario) -> Vec<Exchange> {
    let is_symmetric = |place: &u8| {
        let station = scenario.robots[usize::from(*place)].station;
        scenario.symmetric.contains(&station)
    };
    let station = |place: u8| scenario.robots[usize::from(place)].station;
    let robots = u8::try_from(scenario.robots.len()).expect("at most MAX_ROBOTS");
    let places: Vec<u8> = (0..robots).filter(is_symmetric).collect();
    if places.is_empty() {
        return Vec::new();
    }
    let mut orders: Vec<Vec<u8>> = vec![Vec::new()];
    for _ in &places {
        orders = orders
            .iter()
            .flat_map(|order| {
                let left = places.iter().filter(|place| !order.contains(place));
                left.map(|place| [order.as_slice(), &[*place]].concat())
            })
            .collect();
    }
    let exchange = |order: Vec<u8>| {
        let mut exchange = Exchange {
            places: std::array::from_fn(|place| u8::try_from(place).expect("at most MAX_ROBOTS")),
            stations: SmallVec::new(),
        };
        for (&from, &to) in places.iter().zip(&order) {
            exchange.places[usize::from(from)] = to;
            exchange.stations.push((station(from), station(to)));
        }
        exchange
    };
    orders.into_iter().map(exchange).collect()
}

/// The number of a part after each of the exchanges: six for three robots, which have six orders.
pub(crate) type Images = SmallVec<[u32; 6]>;

/// The images of parts of one kind, each computed once.
pub(crate) type KnownImages = MemoOfNumbers<Images>;

/// The exchanges of a scenario, and what they make of the parts of its states.
pub(crate) struct Symmetry {
    pub(crate) exchanges: Vec<Exchange>,
    pub(crate) nodes: KnownImages,
    pub(crate) messages: KnownImages,
    pub(crate) histories: KnownImages,
    pub(crate) sets: KnownImages,
}

impl Symmetry {
    /// Among the exchanges, the one that leaves all robots where they are.
    pub(crate) const IDENTITY: usize = 0;

    pub(crate) fn of(scenario: &Scenario) -> Self {
        Self {
            exchanges: exchanges(scenario),
            nodes: KnownImages::default(),
            messages: KnownImages::default(),
            histories: KnownImages::default(),
            sets: KnownImages::default(),
        }
    }

    /// Whether no robots are symmetric.
    pub(crate) const fn is_trivial(&self) -> bool {
        self.exchanges.is_empty()
    }

    /// The images of a part, which `image` computes where they are not known yet.
    pub(crate) fn images<'a>(
        &self,
        known: &'a KnownImages,
        part: u32,
        image: impl Fn(&Exchange) -> u32,
    ) -> &'a Images {
        let all = || self.exchanges.iter().map(image).collect();
        known.get_or_compute(part, all)
    }
}
