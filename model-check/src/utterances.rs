//! Messages of a certified insider to a robot: anything, in its own name, of a finite universe.
//!
//! | field | values |
//! |---|---|
//! | sessions and offers of its own | all that somebody still knows of, one that is newer than all; of offers one that is older, too |
//! | sessions of others | the one that its hearer leads or asks for help in, and one from before its boot |
//! | offers of its hearer | the one that stands, and one from before its boot |
//! | heartbeats of its own | all that somebody still knows of, and one that is newer |
//! | echoes | all up to the newest heartbeat of its hearer, and one after it |
//! | request numbers | as many as the scenario has commands, and one more |
//! | tasks, place | those of the scenario's request |
//! | urgency, progress, verdicts, ends, `yields` | low and high; each kind of the others |
//!
//! Which numbers these are is up to the model, or to the simulator. A RAM has a farewell or a part in a session, not both:
//! to say both is to say one after the other.

use crossguard_protocol::{
    Answer, Command, Confirmation, Coordination, Ending, Failure, Farewell, Followers, Heartbeat,
    HelpRequest, Millis, OfferNumber, Phase, Place, Progress, Ram, Rejection, Report, RequestId,
    Rmcm, Robot, SessionId, SessionNumber, StationId, TaskSet, TaskType, UniqueNumber, Urgency,
    Verdict,
};

use crate::network::Message;

/// Messages that an insider may send to one robot.
#[derive(Clone, Debug)]
pub struct Utterances<'a> {
    /// The sender.
    pub liar: StationId,
    /// The receiver.
    pub hearer: &'a Robot,
    /// The insider's request, also for the place where it leads.
    pub request: HelpRequest,
    /// The safety timer that it claims as a helper.
    pub t_safety: Millis,
    /// The numbers of its own sessions, each with heartbeats.
    pub sessions: Vec<(SessionNumber, Heartbeat)>,
    /// The numbers of its own offers.
    pub offers: Vec<OfferNumber>,
    /// A number from before the hearer's boot.
    pub old: Option<UniqueNumber>,
    /// Which heartbeats of its hearer it echoes.
    pub echoes: Vec<Heartbeat>,
    /// Which request numbers it uses.
    pub requests: Vec<RequestId>,
}

impl Utterances<'_> {
    /// All of it.
    #[must_use]
    pub fn all(&self) -> Vec<Message> {
        let to = self.hearer.station();
        let (tasks, place) = (self.request.tasks, self.request.place);
        let lists = follower_lists(self.hearer, self.old.map(OfferNumber));
        let mut numbers: Vec<_> = self.sessions.iter().map(|(number, _)| *number).collect();
        numbers.dedup();
        let own: Vec<_> = numbers
            .iter()
            .map(|&number| led_by(self.liar, number))
            .collect();
        let of_hearer = self.sessions_of_hearer();
        let offering = offering(
            &of_hearer,
            &self.offers,
            &self.echoes,
            &[self.t_safety],
            tasks,
        );
        let parts = [
            leading(&self.sessions, &lists, place),
            asking(&self.sessions, &[Urgency::Low, Urgency::High], self.request),
            offering,
            following(&of_hearer, &self.echoes, &self.requests),
        ];
        let parts = parts.into_iter().flatten();
        let parts = parts.map(|part| self.ram(part, None));
        let farewells = ended(&numbers).chain(left(&of_hearer, &self.offers));
        let farewells = farewells.map(|farewell| self.ram(Coordination::None, Some(farewell)));
        let tasks: Vec<_> = tasks.iter().collect();
        let commands = commands(&own, &[to], &self.requests, &tasks).into_iter();
        let answers = answers(&[self.liar], &of_hearer, &self.requests).into_iter();
        let rmcms = commands.map(Rmcm::Command).chain(answers.map(Rmcm::Answer));
        parts
            .chain(farewells)
            .chain(rmcms.map(Message::Rmcm))
            .collect()
    }

    const fn ram(&self, coordination: Coordination, farewell: Option<Farewell>) -> Message {
        Message::Ram(Ram {
            station: self.liar,
            coordination,
            farewell,
            on_duty: false,
        })
    }

    /// The session of the hearer's own, and one from before its boot.
    fn sessions_of_hearer(&self) -> Vec<SessionId> {
        let leader = self.hearer.station();
        let stale = self.old.map(|number| led_by(leader, SessionNumber(number)));
        let own = self.hearer.session();
        let own = own.filter(|session| session.leader == leader);
        stale.into_iter().chain(own).collect()
    }
}

const fn led_by(leader: StationId, number: SessionNumber) -> SessionId {
    SessionId { leader, number }
}

/// The offer of a robot that stands.
pub(crate) fn standing_offer(robot: &Robot) -> Option<OfferNumber> {
    match robot.phase() {
        Phase::Offering(offering) => Some(offering.number),
        Phase::Following(following) => Some(following.offer),
        Phase::Idle | Phase::Requesting(_) | Phase::Leading(_) => None,
    }
}

/// The hearer alone, for an old offer or the one that stands, or nobody.
pub(crate) fn follower_lists(hearer: &Robot, old: Option<OfferNumber>) -> Vec<Followers> {
    let station = hearer.station();
    let listed = old.into_iter().chain(standing_offer(hearer));
    let listed = listed.map(|offer| [Confirmation { station, offer }].into_iter().collect());
    listed.chain([Followers::EMPTY]).collect()
}

pub(crate) fn asking(
    sessions: &[(SessionNumber, Heartbeat)],
    urgencies: &[Urgency],
    request: HelpRequest,
) -> Vec<Coordination> {
    let asked = sessions.iter().flat_map(|&(number, heartbeat)| {
        let urgencies = urgencies.iter().copied();
        urgencies.map(move |urgency| Coordination::NeedHelp {
            number,
            heartbeat,
            request: HelpRequest { urgency, ..request },
        })
    });
    asked.collect()
}

/// To lead sessions of one's own, with each of these lists of followers.
pub(crate) fn leading(
    sessions: &[(SessionNumber, Heartbeat)],
    lists: &[Followers],
    place: Place,
) -> Vec<Coordination> {
    let claims = [
        (Urgency::Low, false),
        (Urgency::High, false),
        (Urgency::High, true),
    ];
    let mut all = Vec::new();
    for &(number, heartbeat) in sessions {
        for &followers in lists {
            all.extend(claims.map(|(urgency, yields)| Coordination::Leader {
                number,
                heartbeat,
                followers,
                urgency,
                place,
                yields,
            }));
        }
    }
    all
}

pub(crate) fn offering(
    sessions: &[SessionId],
    offers: &[OfferNumber],
    echoes: &[Heartbeat],
    safety_timers: &[Millis],
    capabilities: TaskSet,
) -> Vec<Coordination> {
    let mut all = Vec::new();
    for &session in sessions {
        for &offer in offers {
            for &echo in echoes {
                all.extend(
                    safety_timers
                        .iter()
                        .map(|&t_safety| Coordination::OfferHelp {
                            session,
                            offer,
                            capabilities,
                            echo,
                            t_safety,
                        }),
                );
            }
        }
    }
    all
}

/// To follow in the sessions of others, with any progress of these requests.
pub(crate) fn following(
    sessions: &[SessionId],
    echoes: &[Heartbeat],
    requests: &[RequestId],
) -> Vec<Coordination> {
    let progress = [
        Progress::Executing,
        Progress::InPosition,
        Progress::Completed,
        Progress::Failed(Failure::Maneuver),
        Progress::SafeIdle,
    ];
    let reports = (requests.iter())
        .flat_map(|&request| progress.map(|progress| Some(Report { request, progress })));
    let reports: Vec<_> = reports.chain([None]).collect();
    let mut all = Vec::new();
    for &session in sessions {
        for &echo in echoes {
            all.extend(reports.iter().map(|&last| Coordination::Follower {
                session,
                echo,
                last,
            }));
        }
    }
    all
}

pub(crate) fn ended(numbers: &[SessionNumber]) -> impl Iterator<Item = Farewell> {
    let ends = [Ending::Completed, Ending::Aborted];
    let numbers = numbers.iter();
    numbers.flat_map(move |&number| ends.map(|ending| Farewell::Ended(number, ending)))
}

pub(crate) fn left(
    sessions: &[SessionId],
    offers: &[OfferNumber],
) -> impl Iterator<Item = Farewell> {
    let left = |&session| {
        offers
            .iter()
            .map(move |&offer| Farewell::Left(session, offer))
    };
    sessions.iter().flat_map(left)
}

pub(crate) fn commands(
    sessions: &[SessionId],
    followers: &[StationId],
    requests: &[RequestId],
    tasks: &[TaskType],
) -> Vec<Command> {
    let mut all = Vec::new();
    for &session in sessions {
        for &to in followers {
            for &request in requests {
                all.extend(tasks.iter().map(|&task| Command {
                    session,
                    to,
                    request,
                    task,
                }));
            }
        }
    }
    all
}

pub(crate) fn answers(
    followers: &[StationId],
    sessions: &[SessionId],
    requests: &[RequestId],
) -> Vec<Answer> {
    let rejected = Verdict::Rejected(Rejection::UnsupportedTask);
    let mut all = Vec::new();
    for &session in sessions {
        for &from in followers {
            for &request in requests {
                all.extend([Verdict::Accepted, rejected].map(|verdict| Answer {
                    from,
                    session,
                    request,
                    verdict,
                }));
            }
        }
    }
    all
}
