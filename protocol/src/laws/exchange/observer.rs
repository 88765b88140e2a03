//! How the history grows: by what a robot is told by its own body, by what it puts out, in this order, and by the part
//! that it takes.
//!
//! Only the leader and the follower of the exchange make facts known, each its own. Each `match` names all outputs, so
//! that a new one has to be considered here. An event is a fact only where an output is judged by it: one that is
//! forgotten breaks the property of that output.

use super::{Exchange, Heard, History, messages};
use crate::id::{Heartbeat, StationId};
use crate::input::{Event, Input};
use crate::laws::part::record_of;
use crate::message::{Rmcm, Verdict};
use crate::output::{Maneuver, Notice, Output, Sink};
use crate::state::{Phase, Robot};

/// Watches one step.
#[derive(Clone, Debug)]
pub struct Observer {
    exchange: Exchange,
    /// The robot that takes the step.
    station: StationId,
    /// True if it leads the session, or asks for help in it, before the step.
    is_leader: bool,
    history: History,
    /// True if it sends its RAM.
    sends_ram: bool,
}

impl Observer {
    /// Before the step.
    #[must_use]
    pub fn new(exchange: &Exchange, history: &History, before: &Robot, input: &Input) -> Self {
        let mut observer = Self {
            exchange: *exchange,
            station: before.station,
            is_leader: leads(exchange, before),
            history: *history,
            sends_ram: false,
        };
        match input {
            Input::Ram { .. } | Input::Rmcm(_) | Input::Elapsed(_) | Input::Expired(_) => {}
            Input::Local(event) => observer.hear_body(event),
        }
        observer
    }

    fn hear_body(&mut self, event: &Event) {
        let history = &mut self.history;
        let id = match event {
            Event::InPosition(id) | Event::ManeuverCompleted(id) | Event::ManeuverFailed(id) => *id,
            _ => return,
        };
        if self.station != self.exchange.follower || id != self.exchange.maneuver() {
            return;
        }
        if matches!(event, Event::InPosition(_)) {
            history.in_position = true;
            return;
        }
        history.completed |= matches!(event, Event::ManeuverCompleted(_));
        history.over |= history.started;
    }

    /// One output.
    ///
    /// # Panics
    /// When it breaks a property.
    pub fn see(&mut self, output: &Output) {
        match output {
            Output::SendRam => self.sends_ram = true,
            Output::SendRmcm(rmcm) => self.see_rmcm(*rmcm),
            Output::StartManeuver(maneuver) => self.see_start(maneuver),
            Output::StopManeuver(maneuver, _) => self.see_end(maneuver, false),
            Output::FallBack(maneuver, _) => self.see_end(maneuver, true),
            Output::Notify(notice) if self.is_leader => self.see_notice(notice),
            Output::CorridorOpened(_)
            | Output::CorridorExtended(_)
            | Output::CorridorClosed(_)
            | Output::LockIdentity
            | Output::UnlockIdentity
            | Output::RenewEpoch
            | Output::Notify(_)
            | Output::Ignored(_) => {}
        }
    }

    fn see_rmcm(&mut self, rmcm: Rmcm) {
        let (exchange, history) = (&self.exchange, &mut self.history);
        match rmcm {
            Rmcm::Command(command) => {
                assert!(
                    command.session.leader == self.station,
                    "I1: commands for another"
                );
                if (command.session, command.to, command.request)
                    == (exchange.session, exchange.follower, exchange.request)
                {
                    history.commanded = history.commanded.or(Some(command.task));
                }
            }
            Rmcm::Answer(answer) => {
                assert!(answer.from == self.station, "I6: answers for another");
                if (answer.from, answer.session, answer.request)
                    == (exchange.follower, exchange.session, exchange.request)
                {
                    match answer.verdict {
                        Verdict::Accepted => history.accepted = true,
                        Verdict::Rejected(_) => history.refused = true,
                    }
                }
            }
        }
        assert!(
            messages::rmcm_is_true(exchange, history, rmcm),
            "I3: two commands of one number, or more than a session has"
        );
    }

    fn see_start(&mut self, maneuver: &Maneuver) {
        let (exchange, history) = (&self.exchange, &mut self.history);
        if self.station != exchange.follower || maneuver.id.session != exchange.session {
            return;
        }
        let position = exchange.position(maneuver.id.request);
        history.newer_started |= position > exchange.place();
        if maneuver.id != exchange.maneuver() {
            return;
        }
        assert!(history.joined, "I2: starts for who did not take it");
        assert!(
            history.commanded == Some(maneuver.task),
            "I3: starts what was not commanded"
        );
        assert!(!history.started, "I4, I9: starts twice");
        assert!(!history.newer_started, "I5: starts an older command");
        assert!(history.accepted, "I6: starts before it accepts");
        history.started = true;
    }

    fn see_end(&mut self, maneuver: &Maneuver, falls_back: bool) {
        if self.station == self.exchange.follower && maneuver.id == self.exchange.maneuver() {
            assert!(self.history.runs(), "I14: stops what does not run");
            self.history.over = true;
            self.history.fell_back |= falls_back;
        }
    }

    /// News of the follower, as the leader tells its application.
    fn see_notice(&mut self, notice: &Notice) {
        let (exchange, history) = (&self.exchange, &mut self.history);
        let is_of = |station: StationId| station == exchange.follower;
        let is_watched = |station, id| is_of(station) && id == exchange.maneuver();
        match *notice {
            Notice::FollowerGone(station, _) => history.dropped |= is_of(station),
            Notice::FollowerJoined(station) | Notice::LeaseGranted(station) => {
                assert!(
                    !is_of(station) || history.joined,
                    "I10: counts who has not joined"
                );
            }
            Notice::CommandAcknowledged(station, id) | Notice::ManeuverReported(station, id) => {
                assert!(
                    !is_watched(station, id) || history.accepted,
                    "I6: counts as accepted"
                );
            }
            Notice::CommandRejected(station, id, _) => {
                assert!(
                    !is_watched(station, id) || history.refused,
                    "I6: counts as refused"
                );
            }
            Notice::ManeuverInPosition(station, id) => {
                assert!(
                    !is_watched(station, id) || history.in_position,
                    "I8: counts as in position"
                );
            }
            Notice::ManeuverCompleted(station, id) => {
                assert!(
                    !is_watched(station, id) || history.completed,
                    "I8: counts as completed"
                );
            }
            Notice::FollowerSafeIdle(station, id) => {
                assert!(
                    !is_watched(station, id) || history.fell_back,
                    "I9: counts as fallen back"
                );
            }
            // The leader's own execution limit is a failure too.
            Notice::ManeuverFailed(..)
            | Notice::RolesEstablished(_)
            | Notice::LeaseExpired(_)
            | Notice::OfferLapsed(_)
            | Notice::Yielded(_)
            | Notice::SessionEnded(..)
            | Notice::Offering(_)
            | Notice::Joined(_)
            | Notice::Released(..)
            | Notice::ContactLost(_)
            | Notice::ContactRegained(_) => {}
        }
    }

    /// After the step: the part that the robot takes then.
    ///
    /// # Panics
    /// When its RAM tells what is not so.
    #[must_use]
    pub fn end(self, after: &Robot) -> History {
        let mut history = self.history;
        take_part(&self.exchange, &mut history, after);
        assert!(
            !self.sends_ram || messages::ram_is_true(&self.exchange, &history, &after.ram()),
            "a RAM tells what is not so"
        );
        history
    }
}

impl Sink for Observer {
    fn push(&mut self, output: Output) {
        self.see(&output);
    }
}

/// Facts that the robot's part makes known.
fn take_part(exchange: &Exchange, history: &mut History, robot: &Robot) {
    if exchange.is_led_by(robot.station) {
        let leads = leads(exchange, robot);
        history.requested |= leads;
        history.ended |= history.requested && !leads;
        let heartbeat = newest_heartbeat(robot).filter(|_| leads);
        history.beaten |= heartbeat.is_some_and(|heartbeat| exchange.has_come(heartbeat));
        if let (true, Phase::Leading(leading)) = (leads, &robot.phase) {
            let listed = record_of(leading, exchange.follower);
            history.listed = history.listed.or(listed.map(|member| member.offer));
        }
    }
    if robot.station == exchange.follower {
        let (mut offers, mut follows, mut hears) = (false, false, false);
        match &robot.phase {
            Phase::Offering(offering) => {
                offers = (offering.session, offering.number) == (exchange.session, exchange.offer);
            }
            Phase::Following(following) => {
                follows = following.session == exchange.session;
                hears = follows && exchange.has_come(following.heard);
            }
            Phase::Idle | Phase::Requesting(_) | Phase::Leading(_) => {}
        }
        history.offered |= offers;
        history.joined |= follows;
        history.left |= history.joined && !follows;
        if hears && history.heard.is_none() {
            history.heard = Some(if history.over {
                Heard::AfterTheEnd
            } else {
                Heard::BeforeTheEnd
            });
        }
    }
}

/// The robot loses power: its part is over, and its body stands still.
#[must_use]
pub fn lose_power(exchange: &Exchange, history: &History, robot: &Robot) -> History {
    let mut after = *history;
    if exchange.is_led_by(robot.station) {
        after.ended |= after.requested;
    }
    if robot.station == exchange.follower {
        after.left |= after.joined;
        after.over |= after.started;
    }
    after
}

/// The newest heartbeat of a robot that leads a session, or asks for help in it.
pub(super) fn newest_heartbeat(robot: &Robot) -> Option<Heartbeat> {
    match &robot.phase {
        Phase::Requesting(requesting) => Some(requesting.heartbeat),
        Phase::Leading(leading) => Some(leading.heartbeat),
        Phase::Idle | Phase::Offering(_) | Phase::Following(_) => None,
    }
}

/// True if the robot leads the session, or asks for help in it.
pub(super) fn leads(exchange: &Exchange, robot: &Robot) -> bool {
    let number = match &robot.phase {
        Phase::Requesting(requesting) => requesting.number,
        Phase::Leading(leading) => leading.number,
        Phase::Idle | Phase::Offering(_) | Phase::Following(_) => return false,
    };
    exchange.is_led_by(robot.station) && number == exchange.session.number
}
