//! Each property of the timed model is broken by a robot whose timers do not suit its team, or by a
//! transition function without the rule that is there to keep it.

use crate::timing::*;
use crossguard_model_check::node::Rules;
use crossguard_model_check::properties::PropertyId;
use crossguard_model_check::report::{CheckVerdict, ScenarioReport};
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::sequence::{ChartPlace, ChartStep};
use crossguard_model_check::timed::TimedModel;
use crossguard_protocol::*;
use crossguard_testkit::rules::*;

const HANG: &str = include_str!("../scenarios/timed-hang.toml");

fn violated(scenario: Scenario, rules: impl Rules + 'static) -> (Vec<String>, ScenarioReport) {
    let report = run(TimedModel::with_rules(scenario, rules));
    let violated = report.violated().map(str::to_owned).collect();
    (violated, report)
}

/// The pair in which no robot fails.
fn sound_pair() -> Scenario {
    pair(&[NO_FOLLOWER_FAILS, NOBODY_CRASHES])
}

/// One robot that was configured with other timers than the team: `Config` refuses timers that
/// contradict each other in one robot, and cannot see those of another.
struct Misconfigured {
    station: u32,
    config: Config,
}

impl Misconfigured {
    fn new(station: u32, change: impl FnOnce(&mut Settings)) -> Self {
        let mut settings = pair(&[]).config.settings().clone();
        change(&mut settings);
        let config = Config::new(settings).unwrap();
        Self { station, config }
    }
}

impl Rules for Misconfigured {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let own = robot.station() == StationId(self.station);
        robot.step(if own { &self.config } else { config }, input)
    }
}

/// A test for each row: a scenario, a weakening, and all that it breaks there.
macro_rules! weakenings {
    ($($(#[$attribute:meta])* fn $name:ident($scenario:expr, $rules:expr, [$($id:ident),*]);)*) => {
        $($(#[$attribute])* fn $name() {
            let (violated, _) = violated($scenario, $rules);
            assert_eq!(violated, [$(stringify!($id)),*]);
        })*

        /// The weakenings, each with what it breaks.
        pub(crate) const BREAKS: &[(&str, &[PropertyId])] = &[$((stringify!($rules), &[$(PropertyId::$id),*])),*];
    };
}

weakenings! {
    #[test]
    fn a_safety_timer_that_is_shorter_than_the_leaders_lease_allows_breaks_the_theorem_alone(sound_pair(), TakesAnyTimers(short_of_safety()), [I10]);
    #[test]
    fn a_safety_timer_that_is_too_long_stops_a_follower_too_late(pair(&[NO_FOLLOWER_FAILS]), follows_too_long(), [I16, L5]);
    #[test]
    fn a_request_that_stands_too_long_is_noticed(sound_pair(), asks_too_long(), [I16, L1]);
    // The sign also shows go when the follower has fallen back.
    #[test]
    fn a_corridor_that_does_not_close_in_time_is_noticed(pair(&[]), SHOWS_GO_TOO_LONG, [I11, W1]);
    #[test]
    fn a_sign_that_shows_go_after_a_fallback_is_noticed(sound_pair(), SHOWS_GO_TOO_LONG, [W1]);
    #[test]
    fn robots_that_answer_each_other_in_no_time_would_hold_time_up(sound_pair(), AnswersEveryRam, [I12]);
    // The laws of single steps once let this pass.
    #[test]
    fn a_follower_that_waits_a_quarter_of_t_safety_is_noticed(sound_pair(), RenewsContactBy::new(Millis(45)), [I10, I19, W1, W6]);
    #[test]
    fn a_follower_that_waits_less_than_it_promised_is_noticed_where_no_lease_shows_it(pair(&[("t_lease = 90", "t_lease = 60"), NO_FOLLOWER_FAILS, NOBODY_CRASHES]), RenewsContactBy::new(Millis(170)), [I19]);
    #[test]
    fn a_leader_that_does_not_tell_of_a_lost_lease_leaves_its_application_unaware(sound_pair(), TELLS_OF_NO_LOST_GUARD, [W6]);
    #[test]
    fn a_leader_that_does_not_tell_of_a_failed_maneuver_leaves_its_application_unaware(with_a_long_lease(), TELLS_OF_NO_FAILURE, [W6]);
    #[test]
    fn a_request_that_ends_untold_lets_a_pedestrian_wait_for_ever(shipped("timed-wait"), TELLS_OF_NO_END, [W8]);
    #[test]
    fn a_leader_that_yields_late_shows_go_beside_another_for_too_long(shipped("timed-rivals"), YieldsLate, [W3]);
    // The follower falls back later still.
    #[test]
    fn a_sign_that_outlives_the_lease_shows_go_too_long_after_a_hang(hang_with_late_fallback(), NeverClosesTheCorridor(Some(Millis(170))), [W5]);
}

fn shipped(name: &str) -> Scenario {
    Scenario::load(name).unwrap()
}

/// The lease is long enough to stand from one heartbeat to the next.
fn with_a_long_lease() -> Scenario {
    let long = [
        ("t_lease = 90", "t_lease = 150"),
        ("t_safety = 180", "t_safety = 250"),
        NOBODY_CRASHES,
    ];
    pair(&long)
}

fn hang_with_late_fallback() -> Scenario {
    let text = changed(HANG, &[("t_safety = 180", "t_safety = 250")]);
    Scenario::parse("timed-hang", &text).unwrap()
}

/// A follower whose safety timer is shorter than the leader's lease allows.
fn short_of_safety() -> Misconfigured {
    Misconfigured::new(2, |settings| {
        settings.t_safety = Millis(120);
        settings.t_lease = Millis(40);
    })
}

/// A requester does not look at the `t_safety` that an offer tells.
struct TakesAnyTimers(Misconfigured);

impl Rules for TakesAnyTimers {
    fn step(&self, robot: &mut Robot, config: &Config, mut input: Input) -> Outputs {
        if let Input::Ram { ram, .. } = &mut input
            && let Coordination::OfferHelp { t_safety, .. } = &mut ram.coordination
        {
            *t_safety = Millis(60_000);
        }
        self.0.step(robot, config, input)
    }
}

#[test]
fn a_lease_that_is_longer_than_the_followers_safety_timer_allows_breaks_the_theorem() {
    let leader = Misconfigured::new(1, |settings| {
        settings.t_lease = Millis(160);
        settings.t_safety = Millis(270);
    });
    let (violated, report) = violated(sound_pair(), TakesAnyTimers(leader));
    // The lease is also longer than the scenario's settings have it, and the corridor is open under it.
    assert_eq!(violated, ["I10", "I16", "W1", "W6"]);
    let lease_theorem = report.properties.iter().find(|p| p.id == "I10").unwrap();
    let chart = &lease_theorem.counterexample;
    let puts_out = |robot: usize, text: &str| {
        let of_robot = |step: &&ChartStep| {
            let (ChartPlace::At(at) | ChartPlace::Between { to: at, .. }) = step.place;
            at == robot
        };
        let mut outputs = chart.iter().filter(of_robot).flat_map(|step| &step.outputs);
        outputs.any(|output| output.contains(text))
    };
    assert!(puts_out(0, "lease on robot 2 granted"), "{chart:#?}");
    assert!(puts_out(1, "contact lost"), "{chart:#?}");
    assert!(!puts_out(0, "lease on robot 2 expired"), "{chart:#?}");
}

#[test]
fn an_offer_whose_safety_timer_is_shorter_than_the_lease_allows_is_not_taken() {
    let (violated, report) = violated(sound_pair(), short_of_safety());
    assert_eq!(violated, Vec::<String>::new());
    let premise = report.verdict("I10-premise");
    assert_eq!(premise, Some(CheckVerdict::Unreachable));
}

/// A follower waits longer for its leader than the team's settings say.
fn follows_too_long() -> Misconfigured {
    Misconfigured::new(2, |settings| settings.t_safety = Millis(300))
}

/// A requester waits longer for help than the team's settings say.
fn asks_too_long() -> Misconfigured {
    Misconfigured::new(1, |settings| settings.t_help = Millis(350))
}

/// The sign is not told that the corridor has closed, and shows go for this long after it opened or was
/// extended; as long as the lease stands where nothing is said.
struct NeverClosesTheCorridor(Option<Millis>);

impl Rules for NeverClosesTheCorridor {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let outputs = robot.step(config, input);
        let told = |output: &Output| match *output {
            Output::CorridorClosed(_) => None,
            Output::CorridorOpened(left) => Some(Output::CorridorOpened(self.0.unwrap_or(left))),
            Output::CorridorExtended(left) => {
                Some(Output::CorridorExtended(self.0.unwrap_or(left)))
            }
            output => Some(output),
        };
        outputs.iter().filter_map(told).collect()
    }
}

/// Longer than any lease.
const SHOWS_GO_TOO_LONG: NeverClosesTheCorridor = NeverClosesTheCorridor(Some(Millis(300)));

#[test]
fn a_corridor_that_is_not_closed_ends_by_itself_in_time() {
    let (violated, report) = violated(pair(&[]), NeverClosesTheCorridor(None));
    assert_eq!(violated, Vec::<String>::new());
    assert_eq!(report.verdict("I11-premise"), Some(CheckVerdict::Reachable));
}

/// A follower renews its contact on news by this much, in place of `t_safety` in full. Joining starts with all
/// of it.
struct RenewsContactBy(Config);

impl RenewsContactBy {
    fn new(t_safety: Millis) -> Self {
        // The other values are not read when a follower hears a message.
        let settings = Settings {
            t_safety,
            t_lease: Millis(30),
            drift_ppm: 0,
            delay_max: Millis(0),
            ..pair(&[]).config.settings().clone()
        };
        Self(Config::new(settings).unwrap())
    }
}

impl Rules for RenewsContactBy {
    fn step(&self, robot: &mut Robot, config: &Config, input: Input) -> Outputs {
        let hears = matches!(input, Input::Ram { .. } | Input::Rmcm(_));
        let follows = matches!(robot.phase(), Phase::Following(_));
        robot.step(if hears && follows { &self.0 } else { config }, input)
    }
}

/// A leader's application is not told that a maneuver has failed.
const TELLS_OF_NO_FAILURE: Drops =
    Drops(|output| matches!(output, Output::Notify(Notice::ManeuverFailed(..))));

crossguard_testkit::weakenings! {
    /// A leader listens to no other leader as long as its own leases are long.
    YieldsLate(robot, config, input) {
        let is_long = |(timer, left): &(Timer, Millis)| {
            matches!(timer, Timer::Lease(_)) && *left > Millis(100)
        };
        if let Input::Ram { ram, .. } = input
            && matches!(ram.coordination, Coordination::Leader { .. })
            && matches!(robot.phase(), Phase::Leading(_))
            && robot.timers().iter().any(is_long)
        {
            return only(Output::Ignored(Ignored::LowerPrecedence));
        }
        robot.step(config, input)
    }
}
