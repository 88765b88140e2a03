//! The transition function: [`Robot::step`] takes one input and hands it to the stage it concerns.
//!
//! ```text
//!            Input                                            Outputs
//!   Ram ───────────┐   ┌─ idle ────────── 1 Initialization ─┐
//!   Rmcm ──────────┤   ├─ help ────────── 2 Help             │
//!   Elapsed ───────┼──►├─ roles ───────── 3 Roles, leases    ├──► settle ──►
//!   Expired ───────┤   ├─ maneuver ────── 4 Commands         │   corridor, identity lock,
//!   Local ─────────┘   └─ termination ─── 5 Ends, farewells ─┘   RAM timer
//! ```

use crate::claim::Claim;
use crate::config::Config;
use crate::id::{OfferNumber, SessionId, SessionNumber, StationId, UniqueNumber};
use crate::input::{Decimetres, Event, Input};
use crate::message::{Confirmation, Coordination, Failure, Farewell, Progress, Ram, Report, Rmcm};
use crate::output::{Ignored, Output, Outputs, Sink};
use crate::state::{Duty, Identity, Offer, Phase, Rival, Robot, Role, State};
use crate::task::Availability;
use crate::time::{Countdown, Millis};

/// The context of one step: the configuration to read, the outputs to add to.
pub(crate) struct Step<'a, S> {
    pub(crate) config: &'a Config,
    pub(crate) out: &'a mut S,
    /// True if a lease was renewed in this step, so that an open corridor is extended.
    pub(crate) renewed: bool,
}

/// The outcome of an input: it had an effect, or it is ignored for a reason.
pub(crate) type Effect = Result<(), Ignored>;

/// A transition function together with its state: what an endpoint drives. The kit has one, [`Robot`]; a test
/// that shows what a rule is good for brings another one along.
pub trait StateMachine {
    /// The state.
    fn robot(&self) -> &Robot;

    /// Takes `input` in and returns what is to be done, in order: see [`Robot::step`].
    fn step(&mut self, config: &Config, input: Input) -> Outputs;
}

impl StateMachine for Robot {
    fn robot(&self) -> &Robot {
        self
    }

    fn step(&mut self, config: &Config, input: Input) -> Outputs {
        Robot::step(self, config, input)
    }
}

impl Robot {
    /// A robot that has just booted. `boot` is its boot counter, which must be larger than at any
    /// boot before.
    #[must_use]
    pub const fn new(station: StationId, boot: u16) -> Self {
        Self {
            station,
            boot,
            next_count: 0,
            availability: Availability::Available,
            identity: Identity::Unlocked,
            ram: Countdown::OFF,
            duty: None,
            farewell: None,
            phase: Phase::Idle,
        }
    }

    /// The transition function: takes `input` in and returns what is to be done, in order.
    ///
    /// It is total: every input in every state has a defined outcome, and one that changes nothing
    /// yields [`Output::Ignored`]. It is deterministic: the state and the outputs depend on nothing
    /// but the state before, `config` and `input`. It does not allocate and does not panic.
    pub fn step(&mut self, config: &Config, input: Input) -> Outputs {
        let mut out = Outputs::default();
        self.step_into(config, input, &mut out);
        out
    }

    /// [`step`](Self::step), with the outputs going where they are wanted.
    pub(crate) fn step_into(&mut self, config: &Config, input: Input, out: &mut impl Sink) {
        let step = &mut Step {
            config,
            out,
            renewed: false,
        };
        let effect = match input {
            Input::Ram { ram, distance } => self.hear_ram(step, &ram, distance),
            Input::Rmcm(Rmcm::Command(command)) => self.hear_command(step, command),
            Input::Rmcm(Rmcm::Answer(answer)) => self.hear_answer(step, answer),
            Input::Elapsed(elapsed) => {
                self.elapse(step, elapsed);
                Ok(())
            }
            Input::Expired(timer) => self.expire(step, timer),
            Input::Local(event) => self.notice_event(step, event),
        };
        // R26: an input that changes nothing says why.
        if let Err(reason) = effect {
            step.out.push(Output::Ignored(reason));
        }
        self.settle(step);
    }

    fn hear_ram(
        &mut self,
        step: &mut Step<'_, impl Sink>,
        ram: &Ram,
        distance: Decimetres,
    ) -> Effect {
        if ram.station == self.station {
            return Err(Ignored::OwnStation);
        }
        let from = ram.station;
        // A leader that ended one session may ask for help in the next with the same RAM, so the
        // farewell comes first.
        let farewell = ram
            .farewell
            .map(|farewell| self.hear_farewell(step, from, farewell));
        let part = match ram.coordination {
            Coordination::None => Err(Ignored::NothingNew),
            Coordination::NeedHelp {
                number,
                heartbeat,
                request,
            } => {
                let session = SessionId::of(from, number);
                self.hear_request(step, Rival { session, heartbeat }, request)
            }
            // R3: an offer that the same RAM takes back is none.
            Coordination::OfferHelp { session, offer, .. }
                if ram.farewell.is_some_and(|it| it.leaves(session, offer)) =>
            {
                Err(Ignored::OldOffer)
            }
            Coordination::OfferHelp {
                session,
                offer,
                capabilities,
                echo,
                t_safety,
            } => {
                let offer = Offer {
                    station: from,
                    number: offer,
                    capabilities,
                    distance,
                    echo,
                    standing: Countdown::OFF,
                };
                self.hear_offer(step, session, offer, t_safety)
            }
            Coordination::Leader {
                number,
                heartbeat,
                followers,
                urgency,
                place,
                yields,
            } => {
                let session = SessionId::of(from, number);
                let heard = Rival { session, heartbeat };
                let claim = (!yields).then_some(Claim { urgency, place });
                self.hear_leader(step, heard, &followers, claim)
            }
            Coordination::Follower {
                session,
                echo,
                last,
            } => self.hear_follower(step, from, session, echo, last),
        };
        part.or_else(|reason| farewell.unwrap_or(Err(reason)))
    }

    fn notice_event(&mut self, step: &mut Step<'_, impl Sink>, event: Event) -> Effect {
        match event {
            Event::PedestrianDetected(request) => self.detect_pedestrian(step, request),
            Event::CommandManeuver { follower, task } => self.command(step, follower, task),
            Event::InPosition(id) => self.report_progress(step, id, Progress::InPosition),
            Event::OutOfPosition(id) => self.report_progress(step, id, Progress::Executing),
            Event::ManeuverCompleted(id) => self.report_progress(step, id, Progress::Completed),
            Event::ManeuverFailed(id) => {
                self.report_progress(step, id, Progress::Failed(Failure::Maneuver))
            }
            Event::TaskCompleted => self.complete_task(step),
            Event::RoadClear => self.clear_road(step),
            Event::PersonOnRoad => self.see_person(),
            Event::AllAnswered => self.select_early(step),
            Event::LeaveRequested => self.leave_on_request(step),
            Event::AvailabilityChanged(availability) => {
                self.change_availability(step, availability)
            }
            Event::OpenCorridor => self.open_corridor(step),
            Event::CloseCorridor => self.close_corridor(step),
            Event::IdentityChanged(station, next) => self.change_identity(station, next),
            Event::EpochRenewed(boot) => self.renew_epoch(boot),
        }
    }

    /// Brings what depends on the whole state in line with it.
    pub(crate) fn settle(&mut self, step: &mut Step<'_, impl Sink>) {
        self.settle_corridor(step);
        self.settle_identity(step);
        if !self.is_bound() {
            self.ram = Countdown::OFF;
        } else if !self.ram.is_armed() {
            self.ram = Countdown::armed(step.config.settings().ram_period);
        }
    }

    /// True if the robot has a part in a session or says farewell to one.
    pub(crate) const fn is_bound(&self) -> bool {
        !matches!(self.phase, Phase::Idle) || self.farewell.is_some()
    }

    /// A number that this robot has never given out before.
    pub(crate) fn issue_number(
        &mut self,
        step: &mut Step<'_, impl Sink>,
    ) -> Result<UniqueNumber, Ignored> {
        // R1: no number is given out twice.
        let count = self.next_count;
        self.next_count = count.checked_add(1).ok_or(Ignored::NumbersExhausted)?;
        // R25: while half of the numbers are left.
        if self.next_count > u16::MAX / 2 {
            step.out.push(Output::RenewEpoch);
        }
        Ok(UniqueNumber {
            boot: self.boot,
            count,
        })
    }

    /// Takes back the number of an offer that nobody can confirm any more, so that a peer which asks for
    /// help and ends its request over and over uses up none.
    pub(crate) fn take_back_number(&mut self, offer: OfferNumber) {
        // R25: while it offers, it gives out nothing else. So this is the last one of its epoch.
        if offer.0.boot == self.boot {
            self.next_count = offer.0.count;
        }
    }

    /// True if this robot has given the number out, in this life or an earlier one.
    pub(crate) const fn has_issued(&self, number: UniqueNumber) -> bool {
        number.boot < self.boot || (number.boot == self.boot && number.count < self.next_count)
    }

    /// A larger boot counter has been persisted: its numbers are all new.
    fn renew_epoch(&mut self, boot: u16) -> Effect {
        if boot <= self.boot {
            return Err(Ignored::NothingNew);
        }
        // R25
        self.boot = boot;
        self.next_count = 0;
        Ok(())
    }

    /// The robot's own session of this number.
    pub(crate) const fn own_session(&self, number: SessionNumber) -> SessionId {
        SessionId::of(self.station, number)
    }

    /// The RAM that says what this state is. The endpoint adds the rest of the message.
    #[must_use]
    pub fn ram(&self) -> Ram {
        let coordination = match &self.phase {
            Phase::Idle => Coordination::None,
            Phase::Requesting(requesting) => Coordination::NeedHelp {
                number: requesting.number,
                heartbeat: requesting.heartbeat,
                request: requesting.request,
            },
            Phase::Offering(offering) => Coordination::OfferHelp {
                session: offering.session,
                offer: offering.number,
                capabilities: offering.capabilities,
                echo: offering.heard,
                t_safety: offering.t_safety,
            },
            Phase::Leading(leading) => Coordination::Leader {
                number: leading.number,
                heartbeat: leading.heartbeat,
                followers: leading
                    .members
                    .iter()
                    .map(|member| Confirmation {
                        station: member.station,
                        offer: member.offer,
                    })
                    .collect(),
                urgency: leading.request.urgency,
                place: leading.request.place,
                yields: leading.yields_to.is_some(),
            },
            Phase::Following(following) => Coordination::Follower {
                session: following.session,
                echo: following.heard,
                last: following.job.map(|job| Report {
                    request: job.request,
                    progress: job.progress,
                }),
            },
        };
        let farewell = self.farewell.map(|standing| standing.farewell);
        Ram {
            station: self.station,
            coordination,
            farewell,
            on_duty: self.duty.is_some(),
        }
    }

    /// The state of the paper's finite-state model.
    #[must_use]
    pub fn state(&self) -> State {
        match &self.phase {
            Phase::Idle => State::Idle,
            Phase::Requesting(_) | Phase::Offering(_) => State::HelpRequested,
            Phase::Leading(leading) if leading.is_executing() => State::ManeuverExecuting,
            Phase::Following(following) if following.executing().is_some() => {
                State::ManeuverExecuting
            }
            Phase::Leading(_) | Phase::Following(_) => State::RoleEstablished,
        }
    }

    /// The robot's role.
    #[must_use]
    pub const fn role(&self) -> Role {
        match self.phase {
            Phase::Idle => Role::None,
            Phase::Requesting(_) => Role::Requester,
            Phase::Offering(_) => Role::Helper,
            Phase::Leading(_) => Role::Leader,
            Phase::Following(_) => Role::Follower,
        }
    }

    /// The session that the robot has a part in.
    #[must_use]
    pub const fn session(&self) -> Option<SessionId> {
        match &self.phase {
            Phase::Idle => None,
            Phase::Requesting(requesting) => Some(self.own_session(requesting.number)),
            Phase::Offering(offering) => Some(offering.session),
            Phase::Leading(leading) => Some(self.own_session(leading.number)),
            Phase::Following(following) => Some(following.session),
        }
    }

    /// The robot's part in a session, in full.
    #[must_use]
    pub const fn phase(&self) -> &Phase {
        &self.phase
    }

    /// The robot's station id.
    #[must_use]
    pub const fn station(&self) -> StationId {
        self.station
    }

    /// The number that the robot will give out next.
    #[must_use]
    pub const fn next_number(&self) -> UniqueNumber {
        UniqueNumber {
            boot: self.boot,
            count: self.next_count,
        }
    }

    /// The boot counter with which it was started.
    #[must_use]
    pub const fn boot(&self) -> u16 {
        self.boot
    }

    /// Its readiness for coordination.
    #[must_use]
    pub const fn availability(&self) -> Availability {
        self.availability
    }

    /// The lock of its pseudonym.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.identity
    }

    /// Its duty on the road from a maneuver or session that ended early.
    #[must_use]
    pub const fn duty(&self) -> Option<Duty> {
        self.duty
    }

    /// The session that its farewell names as over.
    pub(crate) const fn farewell_session(&self) -> Option<SessionId> {
        match self.farewell {
            None => None,
            Some(standing) => Some(match standing.farewell {
                Farewell::Ended(number, _) => self.own_session(number),
                Farewell::Left(session, _) => session,
            }),
        }
    }

    /// The session that it names as over.
    #[must_use]
    pub fn farewell(&self) -> Option<Farewell> {
        self.farewell.map(|standing| standing.farewell)
    }

    /// Time to the next periodic RAM; `None` where the endpoint's generation rules apply.
    #[must_use]
    pub const fn next_ram(&self) -> Option<Millis> {
        self.ram.left()
    }
}
