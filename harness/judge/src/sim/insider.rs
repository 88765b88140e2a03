//! An insider: a station with a certificate, if robots have one, that says anything in its own name.
//!
//! It knows the state of each robot that it speaks to, and mostly says what that robot does not ignore. Its messages are
//! made by an endpoint as real robots have it, around a robot that is whatever the insider wants to be.

use std::cell::Cell;
use std::rc::Rc;

use crossguard_codec::{Identifiers, RobotState};
use crossguard_endpoint::station::Security;
use crossguard_endpoint::{Effect, Endpoint, Moment, Stimulus};
use crossguard_model_check::network::{Message, concerns};
use crossguard_model_check::scenario::LyingPart;
use crossguard_model_check::utterances::Utterances;
use crossguard_protocol::{
    Config, Confirmation, Contact, Coordination, Corridor, Countdown, Event, Following, Heartbeat,
    HelpRequest, Identity, Input, Job, Leading, Lease, List, Member, OfferNumber, Offering, Output,
    Outputs, Phase, Ram, RequestId, Requesting, Robot, SessionNumber, StandingFarewell,
    StateMachine, StationId, TaskSet, TaskType, UniqueNumber,
};
use crossguard_robot::site::{Place, Site};
use rand::seq::IndexedRandom;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::swarm::Swarm;

/// What is drawn for the insider of a run.
#[derive(Clone, Debug)]
pub struct InsiderDraw {
    /// Its station id.
    pub station: StationId,
    /// What it mostly lies as.
    pub part: LyingPart,
    /// How long it is silent at most after it has said something, in milliseconds.
    pub pause_ms: u32,
    /// Where it says that it is.
    pub place: Place,
}

impl Swarm {
    /// The same run, with an insider that lies until the network is healed in this share of the seeds.
    #[must_use]
    pub fn with_insider(mut self, share: f64) -> Self {
        let Some(mut draws) = self.draws_of(0x4c49_4152, share) else {
            return self;
        };
        let parts = [
            LyingPart::Follower,
            LyingPart::Helper,
            LyingPart::Bystander,
            LyingPart::Leader,
        ];
        let station = u32::try_from(self.robots.len()).unwrap_or(0) + 1;
        self.insider = Some(InsiderDraw {
            station: StationId(station),
            part: *parts.choose(&mut draws).unwrap_or(&LyingPart::Bystander),
            pause_ms: draws.random_range(20..400),
            place: Place::new(
                draws.random_range(-10.0..10.0),
                draws.random_range(-10.0..10.0),
            ),
        });
        self
    }
}

/// A robot that is whatever it says.
#[derive(Debug)]
struct Mask {
    robot: Robot,
    next: Rc<Cell<Option<Message>>>,
}

impl StateMachine for Mask {
    fn robot(&self) -> &Robot {
        &self.robot
    }

    fn step(&mut self, _: &Config, _: Input) -> Outputs {
        let said = self.next.take().map(|message| match message {
            Message::Ram(ram) => {
                self.robot = wearing(&ram);
                Output::SendRam
            }
            Message::Rmcm(rmcm) => Output::SendRmcm(rmcm),
        });
        said.into_iter().collect()
    }
}

/// A robot whose RAM says this. It keeps its pseudonym.
fn wearing(ram: &Ram) -> Robot {
    let phase = phase_of(ram);
    let left = Countdown::OFF;
    let farewell = ram
        .farewell
        .map(|farewell| StandingFarewell { farewell, left });
    let known = || -> serde_json::Result<Robot> {
        let mut state = serde_json::to_value(Robot::new(ram.station, BOOT))?;
        state["phase"] = serde_json::to_value(&phase)?;
        state["farewell"] = serde_json::to_value(farewell)?;
        state["identity"] = serde_json::to_value(Identity::Locked(left))?;
        serde_json::from_value(state)
    };
    known().expect("a robot is its own values")
}

fn phase_of(ram: &Ram) -> Phase {
    let off = Countdown::OFF;
    match ram.coordination {
        Coordination::None => Phase::Idle,
        Coordination::NeedHelp {
            number,
            heartbeat,
            request,
        } => Phase::Requesting(Requesting {
            number,
            request,
            heartbeat,
            rival: None,
            offers: List::EMPTY,
            help: off,
            selection: off,
        }),
        Coordination::OfferHelp {
            session,
            offer,
            capabilities,
            echo,
            t_safety,
        } => Phase::Offering(Offering {
            session,
            number: offer,
            capabilities,
            heard: echo,
            t_safety,
            reservation: off,
        }),
        Coordination::Leader {
            number,
            heartbeat,
            followers,
            urgency,
            place,
            yields,
        } => Phase::Leading(Leading {
            number,
            request: HelpRequest {
                urgency,
                followers: 1,
                tasks: TaskSet::default(),
                place,
            },
            heartbeat,
            members: followers.iter().copied().map(member).collect(),
            corridor: Corridor::Clear,
            rival: None,
            yields_to: yields.then_some(ram.station),
        }),
        Coordination::Follower {
            session,
            echo,
            last,
        } => Phase::Following(Following {
            session,
            offer: OfferNumber(UniqueNumber {
                boot: BOOT,
                count: 0,
            }),
            heard: echo,
            contact: Contact::Fresh(off),
            job: last.map(|report| Job {
                request: report.request,
                task: TaskType::BLOCK,
                progress: report.progress,
            }),
            refused: None,
            sees_people: false,
        }),
    }
}

const fn member(confirmed: Confirmation) -> Member {
    Member {
        station: confirmed.station,
        offer: confirmed.offer,
        echoed: None,
        lease: Lease::Expired(Countdown::OFF),
        next_request: RequestId(0),
        outstanding: None,
        order: None,
    }
}

/// The insider of a run.
pub(super) struct Insider {
    draw: InsiderDraw,
    next: Rc<Cell<Option<Message>>>,
    endpoint: Endpoint<Mask>,
    state: RobotState,
    /// Its newest session or offer.
    count: u16,
    /// Its newest heartbeat, of whichever session.
    beat: u16,
    draws: ChaCha8Rng,
}

/// The boot counter of its numbers.
const BOOT: u16 = 1;

impl Insider {
    pub(super) fn new(draw: &InsiderDraw, seed: u64, site: &Site, security: Security) -> Self {
        let identifiers = Identifiers::default();
        let station = security.station_id(&identifiers, draw.station);
        let next = Rc::new(Cell::new(None));
        let robot = wearing(&Ram {
            station,
            coordination: Coordination::None,
            farewell: None,
            on_duty: false,
        });
        let mask = Mask {
            robot,
            next: Rc::clone(&next),
        };
        let endpoint = Endpoint::new(mask, Config::default(), identifiers, 0);
        Self {
            next,
            endpoint: endpoint.with_security(security),
            state: RobotState {
                position: site.position(draw.place),
                ..RobotState::default()
            },
            draw: InsiderDraw {
                station,
                ..draw.clone()
            },
            count: 0,
            beat: 0,
            draws: ChaCha8Rng::seed_from_u64(seed ^ 0x4c49_4553),
        }
    }

    pub(super) const fn station(&self) -> StationId {
        self.draw.station
    }

    /// How long it is silent now, in microseconds.
    pub(super) fn pause_us(&mut self) -> u64 {
        u64::from(self.draws.random_range(1..=self.draw.pause_ms)) * 1_000
    }

    /// The one of this many robots that it speaks to.
    pub(super) fn hearer(&mut self, robots: usize) -> usize {
        self.draws.random_range(0..robots)
    }

    /// Says something that is meant for this robot; the packets.
    pub(super) fn lie(
        &mut self,
        moment: Moment,
        hearer: &Robot,
        config: &Config,
        request: HelpRequest,
    ) -> Vec<Rc<[u8]>> {
        let chosen = self.choose(hearer, config, request);
        self.next.set(chosen);
        let said = Stimulus::Event(Event::AllAnswered);
        let effects = self.endpoint.handle(moment, &self.state, said);
        let packets = effects.into_iter().filter_map(|effect| match effect {
            Effect::Transmit { packet, .. } => Some(Rc::from(packet.as_slice())),
            _ => None,
        });
        packets.collect()
    }

    /// Something of its part that the robot does not ignore, or now and then anything.
    fn choose(&mut self, hearer: &Robot, config: &Config, request: HelpRequest) -> Option<Message> {
        self.beat = self.beat.saturating_add(1);
        let mut all = self.utterances(hearer, request).all();
        all.retain(|message| concerns(message, hearer.station()));
        if self.draws.random_bool(0.1) {
            return all.choose(&mut self.draws).copied();
        }
        let counts = |message: &Message| {
            let outputs = hearer.clone().step(config, message.input());
            outputs.ignored().is_none()
        };
        let effective: Vec<_> = all.into_iter().filter(counts).collect();
        let own = effective.iter().copied();
        let own: Vec<_> = own.filter(|it| self.draw.part.says(it)).collect();
        let chosen = own.choose(&mut self.draws);
        let chosen = chosen
            .or_else(|| effective.choose(&mut self.draws))
            .copied();
        let opens = chosen.and_then(|message| number_of(&message));
        if opens.is_some_and(|number| number.count > self.count) {
            self.count += 1;
        }
        chosen
    }

    fn utterances<'a>(&self, hearer: &'a Robot, request: HelpRequest) -> Utterances<'a> {
        let number = |count| UniqueNumber { boot: BOOT, count };
        let numbers = [number(self.count), number(self.count.saturating_add(1))];
        let led = hearer.session().filter(|it| it.leader == self.draw.station);
        let sessions = numbers.map(SessionNumber).into_iter();
        let sessions = sessions.chain(led.map(|session| session.number));
        let (newest, requests) = match hearer.phase() {
            Phase::Requesting(requesting) => (requesting.heartbeat, Vec::new()),
            Phase::Leading(leading) => (leading.heartbeat, requests_of(leading)),
            Phase::Following(following) => (Heartbeat(0), vec![newest_request(following)]),
            Phase::Idle | Phase::Offering(_) => (Heartbeat(0), Vec::new()),
        };
        let nearby = |id: RequestId| [id, id.next()];
        Utterances {
            liar: self.draw.station,
            hearer,
            request,
            t_safety: Config::default().settings().t_safety,
            sessions: sessions.map(|it| (it, Heartbeat(self.beat))).collect(),
            offers: numbers.map(OfferNumber).to_vec(),
            old: Some(UniqueNumber { boot: 0, count: 0 }),
            echoes: [0, 1, 3]
                .map(|ago| Heartbeat(newest.0.wrapping_sub(ago)))
                .to_vec(),
            requests: requests.into_iter().flat_map(nearby).collect(),
        }
    }
}

fn requests_of(leading: &Leading) -> Vec<RequestId> {
    let members = leading.members.iter();
    let ids = members.map(|member| {
        let order = member.order.map(|order| order.request);
        let outstanding = member.outstanding.map(|it| it.request);
        outstanding.or(order).unwrap_or(member.next_request)
    });
    ids.collect()
}

fn newest_request(following: &Following) -> RequestId {
    following.newest_request().unwrap_or(RequestId(0))
}

/// The insider's own number in a message.
const fn number_of(message: &Message) -> Option<UniqueNumber> {
    let Message::Ram(ram) = message else {
        return None;
    };
    match ram.coordination {
        Coordination::NeedHelp { number, .. } | Coordination::Leader { number, .. } => {
            Some(number.0)
        }
        Coordination::OfferHelp { offer, .. } => Some(offer.0),
        Coordination::None | Coordination::Follower { .. } => None,
    }
}
