//! The model forgets facts of the history that no rule can read any more, so that fewer states differ.
//!
//! A robot acts on the commands and offers that it holds or hears. So a time comes from which no rule will ask any more
//! whether a command was finished, or an offer confirmed. From then on each of these facts has the value that is
//! *worse* for the rules that read it: started, not accepted, not finished, not in position, fallen back, told and not
//! out of position; not confirmed.
//!
//! # Why nothing is missed
//!
//! When to forget is a guess about the robots, and a weakened protocol may prove it wrong. A wrong guess costs a false
//! alarm, and hides nothing. Call a state worse than another one where each of these facts is the same or has its worse
//! value, and the rest is the same up to names. Then *for each run of the model that forgets nothing, the model that
//! forgets has a run of the same steps through worse states, until it breaks a property of steps; and each property that the first
//! run breaks is broken by the second one, no later.* For:
//!
//! * Rules read each fact in one direction. I2 and C3 ask that an offer was confirmed; I4 that a command was not started,
//!   and I5 that none as new was; I6 that it was accepted, I8 that it was finished or in position, I9 that its follower has not
//!   fallen back, W1 and C2 that its leader has not been told. A rule that holds in a worse state holds in the better one.
//! * Nothing else reads these facts: no premise, no rule about runs, nothing that says what may happen. Insiders say
//!   every number that anybody knows of, so no confirmation is forgotten where one of them lies.
//! * A step keeps one state worse than the other, because what it records depends on nothing, with one exception: a body that
//!   comes into position makes `told` false where it was out of position, and what the leader hears on the way
//!   makes it true there. A command of which both are forgotten stays told, unless its body leaves its place once more; then both
//!   states record the same.
//! * To forget makes a state worse.
//!
//! Where nothing is broken, the two models have the same steps in the same order, so premises, runs (L) and the way back to idle
//! (L7) are the same as well.

use crossguard_protocol::{
    Confirmation, Coordination, ManeuverId, Member, Phase, Progress, Ram, Report, Rmcm, SessionId,
    StationId,
};

use super::{Draft, Model};
use crate::history::CommandRecord;
use crate::network::Message;
use crate::node::Node;
use crate::road::Body;

impl Model {
    pub(super) fn forget(&self, draft: &mut Draft) {
        let history = self.0.histories.value(draft.state.history);
        let forgetting = history.forgetting(
            |record| self.forgetful(draft, record),
            |session, follower| self.is_confirmation_known(draft, session, follower),
        );
        if let Some(history) = forgetting {
            draft.state.history = self.0.histories.number(history);
        }
    }

    fn node_of(&self, draft: &Draft, station: StationId) -> Option<&Node> {
        let place = self.0.scenario.place_of(station)?;
        Some(self.node(draft.state.nodes[place]))
    }

    /// Whether such a message may arrive.
    fn may_arrive(&self, draft: &Draft, is_meant: impl Fn(&Message) -> bool) -> bool {
        let mut messages = draft.network.messages();
        self.0.scenario.channel.monotone || messages.any(|number| is_meant(self.message(number)))
    }

    /// Whether a robot holds or may hear that the follower is confirmed. An insider may say every number that anybody knows of.
    fn is_confirmation_known(
        &self,
        draft: &Draft,
        session: SessionId,
        follower: Confirmation,
    ) -> bool {
        let Confirmation { station, offer } = follower;
        let phase = self.node_of(draft, station).and_then(Node::phase);
        let holds = match phase {
            Some(Phase::Offering(it)) => (it.session, it.number) == (session, offer),
            Some(Phase::Following(it)) => (it.session, it.offer) == (session, offer),
            _ => false,
        };
        let is_listed = |message: &Message| match message {
            Message::Ram(Ram {
                station,
                coordination:
                    Coordination::Leader {
                        number, followers, ..
                    },
                ..
            }) => {
                SessionId::of(*station, *number) == session
                    && followers.iter().any(|it| *it == follower)
            }
            _ => false,
        };
        holds
            || self.0.scenario.liars().next().is_some()
            || self
                .member_of(draft, session, station)
                .is_some_and(|it| it.offer == offer)
            || self.may_arrive(draft, is_listed)
    }

    fn member_of(&self, draft: &Draft, session: SessionId, station: StationId) -> Option<&Member> {
        let leading = self.node_of(draft, session.leader)?.leading()?;
        (leading.number == session.number)
            .then(|| leading.member(station))
            .flatten()
    }

    /// The record without the flags that nothing can read any more.
    fn forgetful(&self, draft: &Draft, record: &CommandRecord) -> CommandRecord {
        let ManeuverId { session, request } = record.id;
        let follower = self.node_of(draft, record.to);
        let member = self.member_of(draft, session, record.to);
        let outstanding = member.and_then(|member| member.outstanding);
        let is_outstanding = outstanding.is_some_and(|it| it.request == request);
        let order = member.and_then(|member| member.order);
        let order = order.filter(|order| order.request == request);
        let following = follower.and_then(Node::following);
        let following = following.filter(|following| following.session == session);
        let job = following.and_then(|following| following.job);
        let job = job.filter(|job| job.request == request);

        let commands = |message: &Message| match message {
            Message::Rmcm(Rmcm::Command(it)) => {
                (it.to, it.session, it.request) == (record.to, session, request)
            }
            _ => false,
        };
        let reports = |message: &Message, progress| match message {
            Message::Ram(Ram {
                station,
                coordination:
                    Coordination::Follower {
                        session: of,
                        last: Some(last),
                        ..
                    },
                ..
            }) => (*station, *of, *last) == (record.to, session, Report { request, progress }),
            _ => false,
        };

        let body = follower.map_or(Body::Parked, |node| node.actuation.body);
        let starts = !record.started && (is_outstanding || self.may_arrive(draft, commands));
        let runs = body.running().is_some_and(|it| it.id == record.id);
        let of_body = self.0.scenario.corridor && body.maneuver() == Some(record.id);
        let counts = is_outstanding || order.is_some();
        let is_said = |progress| {
            order.is_some_and(|order| order.progress == Some(progress))
                || job.is_some_and(|job| job.progress == progress)
                || self.may_arrive(draft, |message| reports(message, progress))
        };
        let is_asked_for = |progress| counts && is_said(progress);
        CommandRecord {
            started: record.started || !starts,
            accepted: record.accepted && (starts || runs || counts),
            finished: record.finished && is_asked_for(Progress::Completed),
            in_position: record.in_position && is_asked_for(Progress::InPosition),
            fell_back: record.fell_back || !(starts || runs),
            told: record.told || !(starts || of_body),
            out_of_position: record.out_of_position && (starts || of_body),
            ..*record
        }
    }
}
