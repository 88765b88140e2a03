//! States and messages up to renaming, for tools that compare them.
//!
//! The transition function compares numbers and never looks at their absolute values: of two
//! heartbeats or offer numbers it asks which is newer, of two session numbers whether they are the same. So
//! two states that differ in such a renaming alone behave alike, and a model checker need visit only
//! one of them. So a model with unbounded counters is finite, and no counter is bounded.
//!
//! Of two station ids it asks which request goes before and which of two equal offers is the better one.
//! Where neither makes a difference, stations may be exchanged; [`Renaming::station`] says when.

use crate::help::rank;
use crate::id::{
    Heartbeat, ManeuverId, OfferNumber, SessionId, SessionNumber, StationId, UniqueNumber,
};
use crate::input::Timer;
use crate::list::List;
use crate::message::{Answer, Command, Confirmation, Coordination, Farewell, Ram, Rmcm};
use crate::output::Maneuver;
use crate::state::{Duty, Leading, Member, Offering, Phase, Requesting, Rival, Robot};
use crate::time::Millis;

/// A renaming of the contents of states and messages. A value that is given to no method stays as it is.
///
/// The renamed state is a valid one if the renaming keeps stations apart, keeps the order of the
/// heartbeats of each session and keeps them less than half the number space apart, keeps the order of the
/// numbers of each station and boot, [`Robot::next_number`] among them, keeps the number of an offer that
/// stands just below the next, and makes no timer due.
pub trait Renaming {
    /// A station. It is exchanged for another one wherever it occurs; numbers and heartbeats are still
    /// given by the old names of their stations.
    ///
    /// The renamed robots do the same under the new names if the order of requesters stays, all offers are equally
    /// good, and a requester confirms all that it hears. Then the followers that a leader has
    /// confirmed stand in the order of their station ids, and do so again under the new ones.
    fn station(&mut self, station: StationId) -> StationId {
        station
    }

    /// The time that an armed timer has left.
    fn countdown(&mut self, _timer: Timer, left: Millis) -> Millis {
        left
    }

    /// A heartbeat of `session`, which is given by its old name.
    fn heartbeat(&mut self, _session: SessionId, heartbeat: Heartbeat) -> Heartbeat {
        heartbeat
    }

    /// A session or offer number that `owner` gave out, or will give out next.
    fn number(&mut self, _owner: StationId, number: UniqueNumber) -> UniqueNumber {
        number
    }
}

fn session_number(
    to: &mut impl Renaming,
    owner: StationId,
    number: SessionNumber,
) -> SessionNumber {
    SessionNumber(to.number(owner, number.0))
}

fn offer_number(to: &mut impl Renaming, owner: StationId, number: OfferNumber) -> OfferNumber {
    OfferNumber(to.number(owner, number.0))
}

/// Gives a session of `owner` and its newest heartbeat other names. The session by its old name.
fn rename_own(
    to: &mut impl Renaming,
    owner: StationId,
    number: &mut SessionNumber,
    heartbeat: &mut Heartbeat,
) -> SessionId {
    let session = SessionId::of(owner, *number);
    *number = session_number(to, owner, *number);
    *heartbeat = to.heartbeat(session, *heartbeat);
    session
}

/// The followers that a leader has confirmed, under other names. Where no station changes their order is that
/// of the selection, whatever it was by.
fn confirmed<T: Copy, const N: usize>(
    list: &List<T, N>,
    rename: impl FnMut(&T) -> T,
    station: impl Fn(&T) -> StationId,
) -> List<T, N> {
    let renamed: List<T, N> = list.iter().map(rename).collect();
    if list.iter().map(&station).eq(renamed.iter().map(&station)) {
        return renamed;
    }
    sorted(&renamed, |a, b| station(a) < station(b))
}

fn sorted<T: Copy, const N: usize>(
    list: &List<T, N>,
    goes_before: impl Fn(&T, &T) -> bool,
) -> List<T, N> {
    let mut sorted = List::EMPTY;
    for item in list.iter() {
        sorted.insert_ranked(*item, &goes_before);
    }
    sorted
}

impl SessionId {
    /// The session under another name.
    #[must_use]
    pub fn renamed(self, to: &mut impl Renaming) -> Self {
        Self {
            number: session_number(to, self.leader, self.number),
            leader: to.station(self.leader),
        }
    }
}

impl Farewell {
    fn renamed(self, to: &mut impl Renaming, from: StationId) -> Self {
        match self {
            Self::Ended(number, ending) => Self::Ended(session_number(to, from, number), ending),
            Self::Left(session, offer) => {
                Self::Left(session.renamed(to), offer_number(to, from, offer))
            }
        }
    }
}

impl Confirmation {
    /// The confirmation under another name of its offer.
    #[must_use]
    pub fn renamed(self, to: &mut impl Renaming) -> Self {
        Self {
            offer: offer_number(to, self.station, self.offer),
            station: to.station(self.station),
        }
    }
}

impl Ram {
    /// The message under other names.
    #[must_use]
    pub fn renamed(&self, to: &mut impl Renaming) -> Self {
        let (mut ram, station) = (*self, self.station);
        match &mut ram.coordination {
            Coordination::None => {}
            Coordination::NeedHelp {
                number, heartbeat, ..
            } => {
                rename_own(to, station, number, heartbeat);
            }
            Coordination::OfferHelp {
                session,
                offer,
                echo,
                ..
            } => {
                let old = *session;
                *session = old.renamed(to);
                *offer = offer_number(to, station, *offer);
                *echo = to.heartbeat(old, *echo);
            }
            Coordination::Leader {
                number,
                heartbeat,
                followers,
                ..
            } => {
                rename_own(to, station, number, heartbeat);
                *followers = confirmed(followers, |it| it.renamed(to), |it| it.station);
            }
            Coordination::Follower { session, echo, .. } => {
                let old = *session;
                *session = old.renamed(to);
                *echo = to.heartbeat(old, *echo);
            }
        }
        ram.farewell = ram.farewell.map(|farewell| farewell.renamed(to, station));
        ram.station = to.station(station);
        ram
    }
}

impl Rmcm {
    /// The message under other names.
    #[must_use]
    pub fn renamed(&self, to: &mut impl Renaming) -> Self {
        match *self {
            Self::Command(command) => Self::Command(Command {
                session: command.session.renamed(to),
                to: to.station(command.to),
                ..command
            }),
            Self::Answer(answer) => Self::Answer(Answer {
                session: answer.session.renamed(to),
                from: to.station(answer.from),
                ..answer
            }),
        }
    }
}

impl Robot {
    /// The state under other names.
    #[must_use]
    pub fn renamed(&self, to: &mut impl Renaming) -> Self {
        let mut robot = self.clone();
        let station = self.station;
        robot.station = to.station(station);
        robot.next_count = to.number(station, self.next_number()).count;
        if let Some(standing) = &mut robot.farewell {
            standing.farewell = standing.farewell.renamed(to, station);
        }
        robot.duty = robot.duty.map(|duty| duty.renamed(to));
        match &mut robot.phase {
            Phase::Idle => {}
            Phase::Requesting(requesting) => requesting.rename(to, station),
            Phase::Offering(offering) => offering.rename(to, station),
            Phase::Leading(leading) => leading.rename(to, station),
            Phase::Following(following) => {
                let session = following.session;
                following.session = session.renamed(to);
                following.offer = offer_number(to, station, following.offer);
                following.heard = to.heartbeat(session, following.heard);
            }
        }
        robot.rename_countdowns(|timer, left| to.countdown(timer, left));
        robot
    }
}

impl Duty {
    fn renamed(self, to: &mut impl Renaming) -> Self {
        match self {
            Self::FallingBack(Maneuver { id, task }) => {
                let session = id.session.renamed(to);
                let id = ManeuverId { session, ..id };
                Self::FallingBack(Maneuver { id, task })
            }
            Self::Crossing(session) => Self::Crossing(session.renamed(to)),
        }
    }
}

impl Rival {
    fn renamed(self, to: &mut impl Renaming) -> Self {
        Self {
            heartbeat: to.heartbeat(self.session, self.heartbeat),
            session: self.session.renamed(to),
        }
    }
}

impl Requesting {
    fn rename(&mut self, to: &mut impl Renaming, station: StationId) {
        let session = rename_own(to, station, &mut self.number, &mut self.heartbeat);
        self.rival = self.rival.map(|rival| rival.renamed(to));
        for offer in self.offers.iter_mut() {
            offer.echo = to.heartbeat(session, offer.echo);
            offer.number = offer_number(to, offer.station, offer.number);
            offer.station = to.station(offer.station);
        }
        self.offers = sorted(&self.offers, |a, b| rank(a) < rank(b));
    }
}

impl Offering {
    fn rename(&mut self, to: &mut impl Renaming, station: StationId) {
        self.heard = to.heartbeat(self.session, self.heard);
        self.session = self.session.renamed(to);
        self.number = offer_number(to, station, self.number);
    }
}

impl Leading {
    fn rename(&mut self, to: &mut impl Renaming, station: StationId) {
        let session = rename_own(to, station, &mut self.number, &mut self.heartbeat);
        self.rival = self.rival.map(|rival| rival.renamed(to));
        self.yields_to = self.yields_to.map(|other| to.station(other));
        let rename = |member: &Member| Member {
            offer: offer_number(to, member.station, member.offer),
            echoed: member.echoed.map(|echoed| to.heartbeat(session, echoed)),
            station: to.station(member.station),
            ..*member
        };
        self.members = confirmed(&self.members, rename, |member| member.station);
    }
}

#[cfg(test)]
mod tests;
