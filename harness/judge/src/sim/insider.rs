//! An insider: a station with a certificate, if robots have one, that says anything in its own name.
//!
//! It knows the state of each robot that it speaks to, and mostly says what that robot does not ignore. Its packets are those of
//! a robot: the same codec, stack and signature.

use std::rc::Rc;

use crossguard_codec::geonet::{EgoPosition, Stack};
use crossguard_codec::si::generation_delta_time;
use crossguard_codec::{
    ExecutionStatus, Identifiers, Message as Pdu, RobotState, Service, TaskParameters, ram_from,
    rmcm_from_answer, rmcm_from_commands,
};
use crossguard_endpoint::station::Security;
use crossguard_model_check::network::{Message, concerns};
use crossguard_model_check::scenario::LyingPart;
use crossguard_model_check::utterances::Utterances;
use crossguard_protocol::{
    Availability, Config, Coordination, Following, Heartbeat, HelpRequest, Leading, OfferNumber,
    Phase, RequestId, Rmcm, Robot, SessionNumber, StationId, UniqueNumber,
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

/// The insider of a run.
pub(super) struct Insider {
    draw: InsiderDraw,
    stack: Stack,
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
        let mut stack = Stack::of_robot(identifiers, station);
        *stack.envelope_mut() = security.envelope;
        Self {
            stack,
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

    /// The packet of something that is meant for this robot.
    pub(super) fn lie(
        &mut self,
        timestamp_its: u64,
        hearer: &Robot,
        config: &Config,
        request: HelpRequest,
    ) -> Option<Rc<[u8]>> {
        let said = self.choose(hearer, config, request)?;
        let (ids, state) = (Identifiers::default(), &self.state);
        let time = generation_delta_time(timestamp_its);
        let (service, pdu) = match said {
            Message::Ram(ram) => {
                let ram = ram_from(&ids, state, &ram, Availability::Available, time, true);
                (Service::Ram, ram.map(Pdu::Ram))
            }
            Message::Rmcm(Rmcm::Command(command)) => {
                let commands = [(command, TaskParameters::default())];
                let rmcm = rmcm_from_commands(&ids, &state.position, &commands, time);
                (Service::Rmcm, rmcm.map(Pdu::Rmcm))
            }
            Message::Rmcm(Rmcm::Answer(answer)) => {
                let status = ExecutionStatus {
                    progression: state.task_progression,
                    time_to_completion: None,
                };
                let rmcm = rmcm_from_answer(&ids, &state.position, &answer, status, time);
                (Service::Rmcm, rmcm.map(Pdu::Rmcm))
            }
        };
        let octets = pdu.ok()?.encode(&ids).ok()?;
        let ego = EgoPosition::of(state, timestamp_its);
        let packet = self.stack.packet(&ego, service, &octets).ok()?;
        Some(Rc::from(packet))
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
