//! The confinement table of the page, measured: real robots meet each lie, and it lasts no longer than the table says, and
//! almost that long.

use crossguard_protocol::{
    Answer, Command, Config, Confirmation, Coordination, Decimetres, Event, Farewell, Heartbeat,
    HelpRequest, Input, Millis, OfferNumber, Output, Outputs, Phase, Place, Progress, Ram, Report,
    RequestId, Rmcm, Robot, SessionId, SessionNumber, StationId, TaskSet, TaskType, UniqueNumber,
    Urgency, Verdict,
};

const HONEST: StationId = StationId(2);
const LIAR: StationId = StationId(9);
const TASK: TaskType = TaskType::BLOCK;
const TICK_MS: u32 = 10;
/// A RAM period, one lateness, and what the drift makes of 300 s.
const SLACK_MS: u32 = 100 + 50 + 310;

const fn number(count: u16) -> UniqueNumber {
    UniqueNumber { boot: 1, count }
}

fn request(urgency: Urgency) -> HelpRequest {
    HelpRequest {
        urgency,
        followers: 1,
        tasks: TaskSet::of(&[TASK]),
        place: Place(7),
    }
}

/// A robot that does not lie, and its clock.
struct Honest {
    robot: Robot,
    config: Config,
    now_ms: u32,
}

impl Honest {
    fn new() -> Self {
        Self {
            robot: Robot::new(HONEST, 1),
            config: Config::default(),
            now_ms: 0,
        }
    }

    fn take(&mut self, input: Input) -> Outputs {
        self.robot.step(&self.config, input)
    }

    fn event(&mut self, event: Event) -> Outputs {
        self.take(Input::Local(event))
    }

    fn hears(&mut self, coordination: Coordination) -> Outputs {
        self.hears_of(LIAR, coordination, None)
    }

    fn hears_of(
        &mut self,
        station: StationId,
        coordination: Coordination,
        farewell: Option<Farewell>,
    ) -> Outputs {
        let ram = Ram {
            station,
            coordination,
            farewell,
            on_duty: false,
        };
        let distance = Decimetres(0);
        self.take(Input::Ram { ram, distance })
    }

    fn elapse(&mut self) -> Outputs {
        self.now_ms += TICK_MS;
        self.take(Input::Elapsed(Millis(TICK_MS)))
    }

    /// Lets time pass, with what the liar says at each tick, until that is so; how long that took.
    fn until(
        &mut self,
        is_over: impl Fn(&Robot, &Outputs) -> bool,
        mut lies: impl FnMut(&mut Self),
    ) -> u32 {
        let began_ms = self.now_ms;
        for _ in 0..100_000 {
            let outputs = self.elapse();
            if is_over(&self.robot, &outputs) {
                return self.now_ms - began_ms;
            }
            lies(self);
        }
        panic!("it goes on for ever: {:?}", self.robot);
    }

    /// Asks for help and leads the liar, which has joined.
    fn leads() -> Self {
        let mut honest = Self::asks();
        while !matches!(honest.robot.phase(), Phase::Leading(_)) {
            offers(&mut honest);
            honest.elapse();
        }
        honest
    }

    fn asks() -> Self {
        let mut honest = Self::new();
        honest.event(Event::PedestrianDetected(request(Urgency::Medium)));
        honest
    }

    /// Has shown the liar's command for acknowledged, and shows go.
    fn shows_go() -> Self {
        let mut honest = Self::leads();
        echoes(&mut honest, None);
        honest.event(Event::CommandManeuver {
            follower: LIAR,
            task: TASK,
        });
        let answer = Answer {
            from: LIAR,
            session: honest.robot.session().unwrap(),
            request: RequestId(0),
            verdict: Verdict::Accepted,
        };
        honest.take(Input::Rmcm(Rmcm::Answer(answer)));
        honest
    }

    /// Follows the liar, which has commanded it.
    fn follows() -> Self {
        let mut honest = Self::new();
        honest.hears(asks(Heartbeat(0)));
        let Phase::Offering(offering) = honest.robot.phase() else {
            panic!("{:?}", honest.robot);
        };
        let offer = offering.number;
        honest.hears(leads(Heartbeat(1), Some(offer), number(0), Urgency::High));
        honest
    }

    fn offer(&self) -> Option<OfferNumber> {
        match self.robot.phase() {
            Phase::Following(following) => Some(following.offer),
            _ => None,
        }
    }
}

fn asks(heartbeat: Heartbeat) -> Coordination {
    Coordination::NeedHelp {
        number: SessionNumber(number(0)),
        heartbeat,
        request: request(Urgency::High),
    }
}

fn leads(
    heartbeat: Heartbeat,
    follower: Option<OfferNumber>,
    session: UniqueNumber,
    urgency: Urgency,
) -> Coordination {
    let confirmation = |offer| Confirmation {
        station: HONEST,
        offer,
    };
    Coordination::Leader {
        number: SessionNumber(session),
        heartbeat,
        followers: follower.map(confirmation).into_iter().collect(),
        urgency,
        place: Place(7),
        yields: false,
    }
}

fn offers(honest: &mut Honest) {
    if let Phase::Requesting(requesting) = honest.robot.phase() {
        let (session, echo) = (honest.robot.session().unwrap(), requesting.heartbeat);
        honest.hears(Coordination::OfferHelp {
            session,
            offer: OfferNumber(number(0)),
            capabilities: TaskSet::of(&[TASK]),
            echo,
            t_safety: Millis(2_000),
        });
    }
}

fn echoes(honest: &mut Honest, last: Option<Progress>) {
    if let Phase::Leading(leading) = honest.robot.phase() {
        let (session, echo) = (honest.robot.session().unwrap(), leading.heartbeat);
        let last = last.map(|progress| Report {
            request: RequestId(0),
            progress,
        });
        honest.hears(Coordination::Follower {
            session,
            echo,
            last,
        });
    }
}

/// The longest time that the page gives for what a lie can do, in milliseconds; `None` where there is no limit.
fn at_most_ms(can: &str) -> Option<u32> {
    let page = include_str!("../doc/verification.md");
    let mut rows = page
        .lines()
        .map(|row| row.split('|').map(str::trim).collect::<Vec<_>>());
    let row = rows.find(|row| row.len() == 7 && row[2] == can).expect(can);
    let ms = row[5].strip_suffix(" ms")?;
    Some(ms.replace(',', "").parse().expect(ms))
}

/// A lie lasts no longer than its row says, and almost that long.
fn assert_lasts(can: &str, took_ms: u32) {
    let at_most_ms = at_most_ms(can).expect("it ends");
    println!("{can}: {took_ms} ms, at most {at_most_ms} ms");
    assert!(took_ms <= at_most_ms, "{can}: {took_ms} > {at_most_ms}");
    let is_tight = took_ms + SLACK_MS >= at_most_ms;
    assert!(is_tight, "{can}: {took_ms} << {at_most_ms}");
}

fn closes(_: &Robot, outputs: &Outputs) -> bool {
    let closes = |it: &Output| matches!(it, Output::CorridorClosed(_));
    outputs.iter().any(closes)
}

fn is_idle(robot: &Robot, _: &Outputs) -> bool {
    matches!(robot.phase(), Phase::Idle)
}

fn beat(ms: u32) -> Heartbeat {
    Heartbeat(u16::try_from(2 + ms / TICK_MS).unwrap())
}

fn falls_back(_: &Robot, outputs: &Outputs) -> bool {
    outputs.iter().any(|it| matches!(it, Output::FallBack(..)))
}

fn shows_go_in_an_open_corridor() -> Honest {
    let mut honest = Honest::shows_go();
    guards(&mut honest);
    assert_eq!(honest.event(Event::OpenCorridor).ignored(), None);
    honest
}

fn reserved() -> Honest {
    let mut honest = Honest::new();
    honest.hears(asks(Heartbeat(0)));
    honest
}

fn commanded() -> Honest {
    let mut honest = Honest::follows();
    let command = Command {
        session: SessionId {
            leader: LIAR,
            number: SessionNumber(number(0)),
        },
        to: HONEST,
        request: RequestId(0),
        task: TASK,
    };
    let outputs = honest.take(Input::Rmcm(Rmcm::Command(command)));
    let starts = |it: &Output| matches!(it, Output::StartManeuver(_));
    assert!(outputs.iter().any(starts));
    honest
}

fn says_nothing(_: &mut Honest) {}

fn guards(honest: &mut Honest) {
    echoes(honest, Some(Progress::InPosition));
}

fn offers_and_leaves(honest: &mut Honest) {
    offers(honest);
    let session = honest.robot.session().unwrap();
    let farewell = Farewell::Left(session, OfferNumber(number(0)));
    honest.hears_of(LIAR, Coordination::None, Some(farewell));
}

fn asks_on(honest: &mut Honest) {
    honest.hears(asks(beat(honest.now_ms)));
}

fn leads_on(honest: &mut Honest) {
    let (heartbeat, offer) = (beat(honest.now_ms), honest.offer());
    honest.hears(leads(heartbeat, offer, number(0), Urgency::High));
}

/// The liar's means, as the page says them; the robot that it harms; the end of the harm; and the liar's step at each tick.
type Lie = (
    &'static str,
    fn() -> Honest,
    fn(&Robot, &Outputs) -> bool,
    fn(&mut Honest),
);

#[rustfmt::skip]
const LIES: [Lie; 9] = [
    ("says that it guards where it does not", shows_go_in_an_open_corridor, closes, guards),
    ("says that it guards, and is silent", shows_go_in_an_open_corridor, closes, says_nothing),
    ("offers and takes back, so that a request gets no roles", Honest::asks, is_idle, offers_and_leaves),
    ("offers, is confirmed, and does not join", Honest::leads, is_idle, says_nothing),
    ("asks for help, and so reserves an idle robot", reserved, is_idle, asks_on),
    ("asked for help, and is silent", reserved, is_idle, says_nothing),
    ("commands the robots that joined it, and keeps them", Honest::follows, is_idle, leads_on),
    ("commanded, and is silent", commanded, falls_back, says_nothing),
    ("led, and is silent", commanded, is_idle, says_nothing),
];

#[test]
fn each_lie_lasts_no_longer_than_its_row_says_and_almost_that_long() {
    for (can, begin, is_over, say) in LIES {
        let took_ms = begin().until(is_over, say);
        assert_lasts(can, took_ms);
    }
}

#[test]
fn a_bystander_that_leads_there_ends_every_request() {
    let can = "leads at the same place, and goes before a request or a session there";
    assert_eq!(at_most_ms(can), None);
    for session in 0..5 {
        let mut honest = Honest::asks();
        let took_ms = honest.until(is_idle, |honest| {
            let heartbeat = beat(honest.now_ms);
            honest.hears(leads(heartbeat, None, number(session), Urgency::Low));
        });
        assert!(took_ms <= 200, "{took_ms} ms");
    }
}

/// The second message of leaders that go before counts, also where others speak in between.
#[test]
fn a_bystander_with_ever_new_sessions_hides_no_leader() {
    let other_leads = |honest: &mut Honest| {
        let coordination = leads(beat(honest.now_ms), None, number(0), Urgency::Medium);
        honest.hears_of(StationId(1), coordination, None);
    };
    let yields = |robot: &Robot, _: &Outputs| matches!(robot.phase(), Phase::Leading(it) if it.yields_to.is_some());
    for with_liar in [false, true] {
        let mut honest = shows_go_in_an_open_corridor();
        other_leads(&mut honest);
        let began_ms = honest.now_ms;
        let took_ms = honest.until(yields, |honest| {
            guards(honest);
            let ms = honest.now_ms - began_ms;
            if with_liar {
                honest.hears(leads(Heartbeat(0), None, number(beat(ms).0), Urgency::High));
            }
            if ms.is_multiple_of(100) {
                other_leads(honest);
            }
        });
        let can = "leads in ever new sessions, and so would hide another leader at the same place";
        assert_lasts(can, took_ms);
    }
}
