//! What a certified insider says to a robot: anything, in its own name, of a finite universe.
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
    HelpRequest, Millis, OfferNumber, Phase, Progress, Ram, Rejection, Report, RequestId, Rmcm,
    Robot, SessionId, SessionNumber, StationId, UniqueNumber, Urgency, Verdict,
};

use crate::network::Message;

/// What an insider may say to one robot.
#[derive(Clone, Debug)]
pub struct Utterances<'a> {
    /// Who speaks.
    pub liar: StationId,
    /// Who hears it.
    pub hearer: &'a Robot,
    /// What the insider asks for, and where it leads.
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
        let mut all = Vec::new();
        let parts = [self.leading(), self.asking(), self.offering()];
        let parts = parts.into_iter().flatten().chain(self.following());
        all.extend(parts.map(|coordination| self.ram(coordination, None)));
        let farewells = self.farewells().into_iter();
        all.extend(farewells.map(|farewell| self.ram(Coordination::None, Some(farewell))));
        let commands = self.commands().into_iter();
        all.extend(commands.map(|it| Message::Rmcm(Rmcm::Command(it))));
        let answers = self.answers().into_iter();
        all.extend(answers.map(|it| Message::Rmcm(Rmcm::Answer(it))));
        all
    }

    const fn ram(&self, coordination: Coordination, farewell: Option<Farewell>) -> Message {
        Message::Ram(Ram {
            station: self.liar,
            coordination,
            farewell,
            on_duty: false,
        })
    }

    fn session_numbers(&self) -> Vec<SessionNumber> {
        let mut numbers: Vec<_> = self
            .sessions
            .iter()
            .copied()
            .map(|(number, _)| number)
            .collect();
        numbers.dedup();
        numbers
    }

    /// The session of the hearer's own, and one from before its boot.
    fn sessions_of_hearer(&self) -> Vec<SessionId> {
        let leader = self.hearer.station();
        let stale = self.old.map(|number| SessionId {
            leader,
            number: SessionNumber(number),
        });
        let own = self
            .hearer
            .session()
            .filter(|session| session.leader == leader);
        [stale, own].into_iter().flatten().collect()
    }

    fn asking(&self) -> Vec<Coordination> {
        let urgencies = [Urgency::Low, Urgency::High];
        let sessions = self.sessions.iter().copied();
        let asked = sessions.flat_map(|session| urgencies.map(|urgency| (session, urgency)));
        let request = self.request;
        asked
            .map(|((number, heartbeat), urgency)| Coordination::NeedHelp {
                number,
                heartbeat,
                request: HelpRequest { urgency, ..request },
            })
            .collect()
    }

    /// With the hearer among its followers, for the offer that stands or for an old one, or without.
    fn leading(&self) -> Vec<Coordination> {
        let standing = match self.hearer.phase() {
            Phase::Offering(offering) => Some(offering.number),
            Phase::Following(following) => Some(following.offer),
            Phase::Idle | Phase::Requesting(_) | Phase::Leading(_) => None,
        };
        let old = self.old.map(OfferNumber);
        let station = self.hearer.station();
        let listed = [old, standing].into_iter().flatten();
        let listed = listed.map(|offer| [Confirmation { station, offer }].into_iter().collect());
        let lists: Vec<Followers> = listed.chain([Followers::EMPTY]).collect();
        let claims = [
            (Urgency::Low, false),
            (Urgency::High, false),
            (Urgency::High, true),
        ];
        let mut all = Vec::new();
        for (number, heartbeat) in self.sessions.iter().copied() {
            for followers in &lists {
                all.extend(claims.map(|(urgency, yields)| Coordination::Leader {
                    number,
                    heartbeat,
                    followers: *followers,
                    urgency,
                    place: self.request.place,
                    yields,
                }));
            }
        }
        all
    }

    fn offering(&self) -> Vec<Coordination> {
        let mut all = Vec::new();
        for session in self.sessions_of_hearer() {
            for offer in self.offers.iter().copied() {
                all.extend(
                    self.echoes
                        .iter()
                        .copied()
                        .map(|echo| Coordination::OfferHelp {
                            session,
                            offer,
                            capabilities: self.request.tasks,
                            echo,
                            t_safety: self.t_safety,
                        }),
                );
            }
        }
        all
    }

    fn following(&self) -> Vec<Coordination> {
        let progress = [
            Progress::Executing,
            Progress::InPosition,
            Progress::Completed,
            Progress::Failed(Failure::Maneuver),
            Progress::SafeIdle,
        ];
        let requests = self.requests.iter().copied();
        let reports =
            requests.flat_map(|request| progress.map(|progress| Report { request, progress }));
        let reports: Vec<_> = reports.map(Some).chain([None]).collect();
        let mut all = Vec::new();
        for session in self.sessions_of_hearer() {
            for echo in self.echoes.iter().copied() {
                let reports = reports.iter().copied();
                all.extend(reports.map(|last| Coordination::Follower {
                    session,
                    echo,
                    last,
                }));
            }
        }
        all
    }

    fn farewells(&self) -> Vec<Farewell> {
        let ends = [Ending::Completed, Ending::Aborted];
        let sessions = self.session_numbers().into_iter();
        let ended = sessions.flat_map(|number| ends.map(|ending| Farewell::Ended(number, ending)));
        let sessions = self.sessions_of_hearer().into_iter();
        let left = sessions.flat_map(|session| {
            let offers = self.offers.iter().copied();
            offers.map(move |offer| Farewell::Left(session, offer))
        });
        ended.chain(left).collect()
    }

    fn commands(&self) -> Vec<Command> {
        let to = self.hearer.station();
        let mut all = Vec::new();
        for number in self.session_numbers() {
            let session = SessionId {
                leader: self.liar,
                number,
            };
            for request in self.requests.iter().copied() {
                all.extend(self.request.tasks.iter().map(|task| Command {
                    session,
                    to,
                    request,
                    task,
                }));
            }
        }
        all
    }

    fn answers(&self) -> Vec<Answer> {
        let verdicts = [
            Verdict::Accepted,
            Verdict::Rejected(Rejection::UnsupportedTask),
        ];
        let mut all = Vec::new();
        for session in self.sessions_of_hearer() {
            for request in self.requests.iter().copied() {
                all.extend(verdicts.map(|verdict| Answer {
                    from: self.liar,
                    session,
                    request,
                    verdict,
                }));
            }
        }
        all
    }
}
