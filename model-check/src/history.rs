//! Past events that a property needs and no robot's state holds. The model without time forgets
//! facts that nothing can read any more: see `model/forget.rs`.

use crossguard_protocol::{
    Answer, Command, Confirmation, Coordination, Event, Heartbeat, Input, ManeuverId, Notice,
    OfferNumber, Output, Outputs, Phase, Progress, Renaming, Report, RequestId, Rmcm, Robot,
    SessionId, StationId, TaskType, Verdict,
};

use crate::canonical::Renamable;
use crate::road::Pedestrian;
use crate::serial::request_is_newer;

/// The history of a run. Sorted, so that the order of unrelated events does not tell states apart.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub struct History {
    commands: Vec<CommandRecord>,
    confirmed: Vec<(SessionId, Confirmation)>,
    before_crash: Vec<(StationId, SessionId)>,
    /// Whether the pedestrian is on the road.
    pub pedestrian: Pedestrian,
}

/// Progress of one command.
#[expect(clippy::struct_excessive_bools, reason = "each is an independent fact")]
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct CommandRecord {
    /// The follower that it was sent to.
    pub to: StationId,
    /// Session and request number.
    pub id: ManeuverId,
    /// The commanded task.
    pub task: TaskType,
    /// The follower has acknowledged it.
    pub accepted: bool,
    /// The follower has started it.
    pub started: bool,
    /// The follower's application has finished it.
    pub finished: bool,
    /// The follower has fallen back from it.
    pub fell_back: bool,
    /// The follower's body has reached the place from which it guards.
    pub in_position: bool,
    /// The follower's body has left that place since it was there last.
    pub out_of_position: bool,
    /// The leader has received a report that it has ended, or that the body has left its place, or has dropped the follower.
    pub told: bool,
}

impl History {
    /// The record of a command, if it was ever sent.
    #[must_use]
    pub fn command(&self, to: StationId, id: ManeuverId) -> Option<&CommandRecord> {
        Some(&self.commands[self.place_of(to, id)?])
    }

    /// The records of all commands with this id: one per follower.
    pub(crate) fn commands_with(&self, id: ManeuverId) -> impl Iterator<Item = &CommandRecord> {
        self.commands.iter().filter(move |record| record.id == id)
    }

    /// Where the record of a command stands; runs may be long.
    fn place_of(&self, to: StationId, id: ManeuverId) -> Option<usize> {
        let key = (to, id.session, id.request.0);
        self.commands.binary_search_by_key(&key, command_order).ok()
    }

    /// The newest command of `session` that `to` has started.
    #[must_use]
    pub fn newest_started(&self, to: StationId, session: SessionId) -> Option<RequestId> {
        let key = |record: &CommandRecord| (record.to, record.id.session);
        let begin = self.commands.partition_point(|r| key(r) < (to, session));
        let of_session = self.commands[begin..].iter();
        let requests = of_session
            .take_while(|record| key(record) == (to, session))
            .filter(|record| record.started)
            .map(|record| record.id.request);
        requests.reduce(|a, b| if request_is_newer(b, a) { b } else { a })
    }

    /// Whether the leader of `session` has confirmed this follower with this offer.
    #[must_use]
    pub fn is_confirmed(&self, session: SessionId, follower: Confirmation) -> bool {
        let key = confirmation_order(&(session, follower));
        self.confirmed
            .binary_search_by_key(&key, confirmation_order)
            .is_ok()
    }

    /// Whether `station` had a role in `session` when it crashed.
    #[must_use]
    pub fn had_role_before_crash(&self, station: StationId, session: SessionId) -> bool {
        self.before_crash.binary_search(&(station, session)).is_ok()
    }

    /// Whether `station` ever had a role when it crashed.
    #[must_use]
    pub fn crashed_in_role(&self, station: StationId) -> bool {
        self.before_crash
            .iter()
            .any(|&(crashed, _)| crashed == station)
    }

    /// The history with other records of the same commands, and some of the confirmations; `None` where it stays the same.
    pub(crate) fn forgetting(
        &self,
        forgetful: impl Fn(&CommandRecord) -> CommandRecord,
        is_known: impl Fn(SessionId, Confirmation) -> bool,
    ) -> Option<Self> {
        let is_known = |&(session, follower): &_| is_known(session, follower);
        let commands: Vec<_> = self.commands.iter().map(forgetful).collect();
        if commands == self.commands && self.confirmed.iter().all(is_known) {
            return None;
        }
        let confirmed = self.confirmed.iter().copied();
        Some(Self {
            commands,
            confirmed: confirmed.filter(is_known).collect(),
            ..self.clone()
        })
    }

    pub(crate) fn record_step(
        &mut self,
        before: &Robot,
        after: &Robot,
        input: Input,
        outputs: &Outputs,
    ) {
        let station = after.station();
        match input {
            Input::Local(Event::ManeuverCompleted(id)) => {
                self.update(station, id, |record| record.finished = true);
            }
            Input::Local(Event::InPosition(id)) => {
                self.update(station, id, |record| {
                    record.in_position = true;
                    // Once the body is back, an earlier report of its absence is out of date.
                    record.told &= !record.out_of_position;
                    record.out_of_position = false;
                });
            }
            Input::Local(Event::OutOfPosition(id)) => {
                self.update(station, id, |record| record.out_of_position = true);
            }
            _ => {}
        }
        if let Some((follower, id)) = told_on_its_way(after, input) {
            self.update(follower, id, |record| record.told |= record.out_of_position);
        }
        if let Some((follower, id)) = told_end(station, input) {
            self.update(follower, id, |record| record.told = true);
        }
        for output in outputs.iter() {
            match *output {
                Output::SendRmcm(Rmcm::Command(command)) => self.record_command(command),
                Output::SendRmcm(Rmcm::Answer(Answer {
                    session,
                    request,
                    verdict: Verdict::Accepted,
                    ..
                })) => {
                    let id = ManeuverId { session, request };
                    self.update(station, id, |record| record.accepted = true);
                }
                Output::StartManeuver(maneuver) => {
                    self.update(station, maneuver.id, |record| record.started = true);
                }
                Output::FallBack(maneuver, _) => {
                    self.update(station, maneuver.id, |record| record.fell_back = true);
                }
                Output::Notify(Notice::FollowerGone(follower, _)) => {
                    let of_follower = |record: &&mut CommandRecord| {
                        record.to == follower && record.id.session.leader == station
                    };
                    for record in self.commands.iter_mut().filter(of_follower) {
                        record.told = true;
                    }
                }
                _ => {}
            }
        }
        if let (Phase::Requesting(_), Phase::Leading(leading)) = (before.phase(), after.phase()) {
            let session = SessionId {
                leader: station,
                number: leading.number,
            };
            for member in leading.members.iter() {
                let follower = Confirmation {
                    station: member.station,
                    offer: member.offer,
                };
                let confirmation = (session, follower);
                insert_sorted(&mut self.confirmed, confirmation, confirmation_order);
            }
        }
    }

    pub(crate) fn record_crash(&mut self, robot: &Robot) {
        if let (Some(session), Phase::Leading(_) | Phase::Following(_)) =
            (robot.session(), robot.phase())
        {
            insert_sorted(
                &mut self.before_crash,
                (robot.station(), session),
                |entry| *entry,
            );
        }
    }

    fn record_command(
        &mut self,
        Command {
            session,
            to,
            request,
            task,
        }: Command,
    ) {
        let id = ManeuverId { session, request };
        if self.command(to, id).is_some() {
            return;
        }
        let record = CommandRecord {
            to,
            id,
            task,
            accepted: false,
            started: false,
            finished: false,
            fell_back: false,
            in_position: false,
            out_of_position: false,
            told: false,
        };
        insert_sorted(&mut self.commands, record, command_order);
    }

    fn update(&mut self, to: StationId, id: ManeuverId, change: impl FnOnce(&mut CommandRecord)) {
        if let Some(place) = self.place_of(to, id) {
            change(&mut self.commands[place]);
        }
    }
}

impl Renamable for History {
    fn renamed(&self, to: &mut impl Renaming) -> Self {
        let mut history = self.clone();
        for record in &mut history.commands {
            record.to = to.station(record.to);
            record.id.session = record.id.session.renamed(to);
        }
        for (session, follower) in &mut history.confirmed {
            *session = session.renamed(to);
            *follower = follower.renamed(to);
        }
        for (station, session) in &mut history.before_crash {
            *station = to.station(*station);
            *session = session.renamed(to);
        }
        history.pedestrian = history.pedestrian.renamed(to);
        history.commands.sort_unstable_by_key(command_order);
        history.confirmed.sort_unstable_by_key(confirmation_order);
        history.before_crash.sort_unstable();
        history
    }
}

/// The command whose end a message reports to its leader, and its follower.
pub(crate) fn told_end(leader: StationId, input: Input) -> Option<(StationId, ManeuverId)> {
    let (follower, id, progress, _) = report_to(leader, input)?;
    (!progress.is_running()).then_some((follower, id))
}

/// The command that a message reports to this leader as on its way, where the leader knows no later heartbeat of the
/// follower.
pub(crate) fn told_on_its_way(leader: &Robot, input: Input) -> Option<(StationId, ManeuverId)> {
    let (follower, id, progress, echo) = report_to(leader.station(), input)?;
    let Phase::Leading(leading) = leader.phase() else {
        return None;
    };
    let is_newest = leading.member(follower)?.echoed == Some(echo);
    (progress == Progress::Executing && is_newest).then_some((follower, id))
}

/// The report and the echoed heartbeat in a message of a follower in a session of this leader.
fn report_to(
    leader: StationId,
    input: Input,
) -> Option<(StationId, ManeuverId, Progress, Heartbeat)> {
    let Input::Ram { ram, .. } = input else {
        return None;
    };
    match ram.coordination {
        Coordination::Follower {
            session,
            echo,
            last: Some(Report { request, progress }),
        } if session.leader == leader => {
            Some((ram.station, ManeuverId { session, request }, progress, echo))
        }
        _ => None,
    }
}

const fn command_order(record: &CommandRecord) -> (StationId, SessionId, u8) {
    (record.to, record.id.session, record.id.request.0)
}

const fn confirmation_order(
    (session, follower): &(SessionId, Confirmation),
) -> (SessionId, StationId, OfferNumber) {
    (*session, follower.station, follower.offer)
}

fn insert_sorted<T, K: Ord>(list: &mut Vec<T>, item: T, key: impl Fn(&T) -> K) {
    if let Err(at) = list.binary_search_by_key(&key(&item), &key) {
        list.insert(at, item);
    }
}
