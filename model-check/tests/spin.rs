//! The independent model of the pair in Promela (`model-check/spin`), checked with SPIN: the same
//! verdicts as the kit's model, the same rules needed for them, and the same things to be seen of robots,
//! bodies and pedestrian.
//!
//! It takes `spin` and `gcc`. Where one of them is missing, the tests are skipped, and say so by name.

use std::collections::BTreeSet;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::{Model, ModelState};
use crossguard_model_check::node::Node;
use crossguard_model_check::properties::PropertyId::{self, *};
use crossguard_model_check::report::CheckVerdict;
use crossguard_model_check::road::Body;
use crossguard_model_check::scenario::Scenario;
use crossguard_protocol::{
    Availability, Corridor, Ending, Failure, Farewell, Identity, Member, Phase, Progress, Robot,
    TaskSet, TaskType,
};

/// Distinct states of the Promela model; a change of it is to be looked at, like that of a scenario.
const STATES: usize = 1_543_163;

/// Properties of the Promela model. It has no totality (I13), as it has no inputs but the ones that its
/// channel carries, and no liveness under fairness.
const EXPRESSED: [PropertyId; 17] = [
    I1, I2, I3, I4, I5, I6, I7, I8, I9, I11, I12, I14, I16, L7, W1, W2, W4,
];

fn is_installed(program: &str) -> bool {
    Command::new(program).arg("--help").output().is_ok()
}

/// Whether SPIN can run; if not, says so.
fn can_run(test: &str) -> bool {
    let missing = ["spin", "gcc"]
        .into_iter()
        .find(|program| !is_installed(program));
    if let Some(program) = missing {
        // Not by eprintln!, which the test runner would capture.
        let skipped = format!("SKIPPED {test}: {program} is not installed");
        let _ = writeln!(std::io::stderr(), "{skipped}");
    }
    missing.is_none()
}

/// One run of SPIN's verifier, in a folder of its own.
struct Verification {
    folder: PathBuf,
    macros: Vec<String>,
}

impl Verification {
    /// Of the Promela model with the bounds of a scenario.
    fn of(name: &str, scenario: &Scenario) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("spin-{name}"));
        let bounds = &scenario.bounds;
        let n_ack = scenario.config.settings().n_ack;
        let losses = bounds.losses.expect("the Promela model counts losses");
        let block = TaskSet::of(&[TaskType::BLOCK]);
        let macros = vec![
            format!("-DDETECTIONS={}", bounds.detections),
            format!("-DCOMMANDS={}", bounds.commands),
            format!("-DDISTURBANCES={}", bounds.disturbances),
            format!("-DLOSSES={losses}"),
            format!("-DDELAYED={}", scenario.channel.delayed),
            format!("-DHOLDING={}", u8::from(scenario.request.tasks == block)),
            format!("-DN_ACK={n_ack}"),
        ];
        Self { folder, macros }
    }

    /// The same without one rule of the protocol, until these properties are violated.
    fn without(mut self, rule: &str, until: &[PropertyId]) -> Self {
        let bits = until.iter().fold(0_u32, |bits, &id| bits | 1 << number(id));
        self.macros.push(format!("-D{rule}"));
        self.macros.push(format!("-DUNTIL_VIOLATED={bits}"));
        self
    }

    /// The same, which prints what is to be seen.
    fn with_sights(mut self) -> Self {
        self.macros.push("-DSIGHTS".to_owned());
        self
    }

    /// The verifier's output.
    fn run(&self, optimize: &str) -> String {
        let _ = std::fs::remove_dir_all(&self.folder);
        std::fs::create_dir_all(&self.folder).unwrap();
        let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("spin/pair.pml");
        let mut spin = Command::new("spin");
        self.call(spin.arg("-a").args(&self.macros).arg(model));
        let gcc = ["-w", "-DSAFETY", "-DNOREDUCE", "-o", "pan", "pan.c"];
        self.call(Command::new("gcc").arg(optimize).args(gcc));
        let printed = self.call(Command::new("./pan").args(["-m40000", "-n", "-c0"]));
        std::fs::remove_dir_all(&self.folder).unwrap();
        printed
    }

    fn call(&self, command: &mut Command) -> String {
        let output = command.current_dir(&self.folder).output().unwrap();
        let printed = String::from_utf8(output.stdout).unwrap();
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{command:?}: {printed}{errors}");
        printed
    }
}

/// The number that `properties.pml` gives to a property.
fn number(id: PropertyId) -> u32 {
    match id {
        L7 => 20,
        W1 => 21,
        W2 => 22,
        W4 => 24,
        _ => id.to_string()[1..].parse().unwrap(),
    }
}

fn says(printed: &str, what: &str, id: PropertyId) -> bool {
    printed.lines().any(|line| line == format!("{what} {id}"))
}

fn assert_exhaustive(printed: &str) {
    assert!(printed.contains("Full statespace search"), "{printed}");
    let depth = "max search depth too small";
    for limit in [depth, "Search not completed", "out of memory"] {
        assert!(!printed.contains(limit), "{printed}");
    }
}

/// The verdicts, and what is to be seen in all states; also with a guard that holds a place, which is in place once it says
/// so.
#[test]
fn spin_and_the_kit_come_to_the_same_verdicts_and_the_same_is_to_be_seen() {
    if !can_run("spin_and_the_kit_come_to_the_same_verdicts_and_the_same_is_to_be_seen") {
        return;
    }
    let pair = Scenario::load("pair").unwrap();
    let printed = Verification::of("pair", &pair).with_sights().run("-O2");
    let counted = format!("{STATES} states, stored");
    assert!(printed.contains(&counted), "{printed}");
    assert_eq!(assert_same_sights(&printed, pair.clone()), SIGHTS);
    assert_same_verdicts(&printed, pair);
    let blocks = pair_that_blocks();
    let printed = Verification::of("blocks", &blocks).with_sights().run("-O2");
    assert_same_sights(&printed, blocks.clone());
    assert_same_verdicts(&printed, blocks);
}

fn pair_that_blocks() -> Scenario {
    let text = include_str!("../scenarios/pair.toml")
        .replace("\"move\"", "\"block\"")
        .replace("commands = 2", "commands = 1")
        .replace("\"I5\", ", "");
    Scenario::parse("a guard that blocks", &text).unwrap()
}

fn assert_same_verdicts(printed: &str, mut scenario: Scenario) {
    assert_exhaustive(printed);
    assert!(printed.contains("errors: 0"), "{printed}");
    let expressed = |id: &PropertyId| EXPRESSED.contains(id);
    // A request number grows only where there are two commands.
    let (is_there, commands) = (scenario.properties.contains(&I5), scenario.bounds.commands);
    assert_eq!(is_there, commands > 1);
    scenario.properties.retain(expressed);
    let checked: Vec<_> = EXPRESSED
        .into_iter()
        .filter(|&id| id != I5 || is_there)
        .collect();
    assert_eq!(scenario.properties, checked);
    let report = check(&Model::new(scenario), &Options::default(), &mut |_| ());
    for id in checked {
        let holds = report.verdict(&id.to_string()) == Some(CheckVerdict::Holds);
        assert_eq!(!says(printed, "violated", id), holds, "{id}: {printed}");
        if let Some(verdict) = report.verdict(&format!("{id}-premise")) {
            let reachable = verdict == CheckVerdict::Reachable;
            assert_eq!(says(printed, "premise", id), reachable, "{id}: {printed}");
        }
    }
}

/// Asserts that without `rule` SPIN finds these properties violated. Where the kit's model is checked without
/// the same rule (`tests/weakenings.rs`), it finds the same.
fn assert_needed(rule: &str, scenario: &Scenario, properties: &[PropertyId]) {
    let printed = Verification::of(rule, scenario)
        .without(rule, properties)
        .run("-O0");
    for &id in properties {
        let breaks = says(&printed, "violated", id);
        assert!(breaks, "{rule}: {id} should break: {printed}");
    }
}

#[test]
fn in_spin_too_each_rule_is_needed_for_the_property_that_it_keeps() {
    if !can_run("in_spin_too_each_rule_is_needed_for_the_property_that_it_keeps") {
        return;
    }
    let pair = Scenario::load("pair").unwrap();
    let rules: [(&str, &[PropertyId]); 14] = [
        ("NO_OFFER_NUMBERS", &[I2]),
        ("NO_CONFIRMATION", &[I2]),
        ("NO_MEMORY_OF_REPEATED", &[I4, I9]),
        ("NO_ORDER_OF_REQUESTS", &[I5]),
        ("ANY_ACKNOWLEDGEMENT", &[I6, I7]),
        ("ANY_PROGRESS", &[I8]),
        ("CORRIDOR_STAYS_OPEN", &[I11, W1, W2]),
        ("RELEASED_GOES_ON", &[I14]),
        ("NO_FOLLOWER_TIMERS", &[I12, L7]),
        ("ONE_REPEAT_MORE", &[I16]),
        ("EVERY_END_STOPS", &[W2]),
        ("STOPS_IN_PLACE", &[W2]),
        ("FORGETS_ITS_DUTY", &[W4]),
        ("COMMANDS_GUARDS_AWAY", &[W2]),
    ];
    for (rule, properties) in rules {
        assert_needed(rule, &pair, properties);
    }
    assert_needed("OPENS_ON_THE_WAY", &pair_that_blocks(), &[I11, W1]);
}

#[test]
#[ignore = "takes a minute: cargo test -p crossguard-model-check --test it -- --ignored spin::"]
fn in_spin_too_a_command_of_an_earlier_session_must_not_be_executed() {
    if !can_run("in_spin_too_a_command_of_an_earlier_session_must_not_be_executed") {
        return;
    }
    // A second session takes a second pedestrian.
    let text = include_str!("../scenarios/pair.toml")
        .replace("detections = 1", "detections = 2")
        .replace("commands = 2", "commands = 1");
    let two_sessions = Scenario::parse("two sessions", &text).unwrap();
    let printed = Verification::of("two-sessions", &two_sessions).run("-O2");
    assert_exhaustive(&printed);
    assert!(printed.contains("errors: 0"), "{printed}");
    assert_needed("ANY_SESSION", &two_sessions, &[I3]);
}

/// How many different things are to be seen in the pair.
const SIGHTS: usize = 2_156;

/// Asserts that robots, bodies and pedestrian are to be seen in the same states in both models; in how many.
fn assert_same_sights(printed: &str, scenario: Scenario) -> usize {
    let number = |line: &str| line.strip_prefix("sees ")?.parse().ok();
    let in_spin: BTreeSet<u32> = printed.lines().filter_map(number).collect();
    let in_kit = sights(&Model::new(scenario));
    let only = |a: &BTreeSet<u32>, b: &BTreeSet<u32>| -> Vec<String> {
        let only = a.difference(b);
        only.map(|sight| format!("{sight:#034b}")).collect()
    };
    let (spin_alone, kit_alone) = (only(&in_spin, &in_kit), only(&in_kit, &in_spin));
    assert!(
        spin_alone.is_empty() && kit_alone.is_empty(),
        "{} in both; in SPIN alone {}: {:#?}; in the kit alone {}: {:#?}",
        in_spin.intersection(&in_kit).count(),
        spin_alone.len(),
        &spin_alone[..spin_alone.len().min(40)],
        kit_alone.len(),
        &kit_alone[..kit_alone.len().min(40)],
    );
    in_kit.len()
}

/// Sights in all states of the kit's model.
fn sights(model: &Model) -> BTreeSet<u32> {
    let mut sights = BTreeSet::new();
    for state in model.reachable() {
        let mut sight = Sight::default();
        sight.add(model, &state);
        // Two idle robots, before anything has happened, are all zeros, and left out in Promela.
        sights.extend(Some(sight.0).filter(|&packed| packed != 0));
    }
    sights
}

/// The visible part of a state, packed as in `sight.pml`.
#[derive(Default)]
struct Sight(u32);

impl Sight {
    fn pack(&mut self, value: u32, bits: u32) {
        assert!(value < 1 << bits);
        self.0 = self.0 << bits | value;
    }

    fn bit(&mut self, is_set: bool) {
        self.pack(u32::from(is_set), 1);
    }

    fn add(&mut self, model: &Model, state: &ModelState) {
        let mut nodes = model.nodes(state);
        let (leader, helper) = (nodes.next().unwrap(), nodes.next().unwrap());
        self.add_requester(leader);
        self.add_helper(helper);
        let body = match helper.actuation.body {
            Body::Parked => 0,
            Body::UnderWay(_) | Body::OutOfPosition(_) => 1,
            Body::InPosition(_) => 2,
            Body::FallingBack(..) => 3,
            Body::Ended(..) => 4,
        };
        self.pack(body, 3);
        self.bit(model.history(state).pedestrian.on_road().is_some());
    }

    fn add_requester(&mut self, node: &Node) {
        let robot = node.robot.as_ref().unwrap();
        let leading = node.leading();
        let member = leading.and_then(|leading| leading.members.iter().next());
        let (phase, is_answered) = match robot.phase() {
            Phase::Requesting(requesting) => (1, !requesting.offers.is_empty()),
            Phase::Leading(_) => (2, member.is_some_and(Member::has_joined)),
            _ => (0, false),
        };
        self.pack(phase, 2);
        self.bit(is_answered);
        let outstanding = member.and_then(|member| member.outstanding);
        self.bit(outstanding.is_some());
        self.bit(outstanding.is_some_and(|outstanding| outstanding.repeats > 0));
        let order = member.and_then(|member| member.order);
        self.pack(order.map_or(0, |order| 1 + progress(order.progress)), 3);
        self.bit(member.is_some_and(|member| member.lease.stands()));
        let corridor = match leading.map(|leading| leading.corridor) {
            None | Some(Corridor::Clear) => 0,
            Some(Corridor::Open) => 1,
            Some(Corridor::Clearing) => 2,
        };
        self.pack(corridor, 2);
        self.bit(robot.duty().is_some());
        self.bit(is_unavailable(robot));
        let ending = match robot.farewell() {
            Some(Farewell::Ended(_, Ending::Completed)) => 1,
            Some(Farewell::Ended(_, Ending::Aborted)) => 2,
            Some(Farewell::Left(..)) => panic!("the requester leaves nobody"),
            None => 0,
        };
        self.pack(ending, 2);
        self.bit(robot.identity() == Identity::Expiring);
        self.bit(node.actuation.road_unsure);
    }

    fn add_helper(&mut self, node: &Node) {
        let robot = node.robot.as_ref().unwrap();
        let following = node.following();
        let phase = match robot.phase() {
            Phase::Offering(_) => 1,
            Phase::Following(_) => 2,
            _ => 0,
        };
        self.pack(phase, 2);
        self.bit(following.is_some_and(|following| !following.contact.is_lost()));
        let job = following.and_then(|following| following.job);
        self.pack(job.map_or(0, |job| 1 + progress(Some(job.progress))), 3);
        self.bit(following.is_some_and(|following| following.refused.is_some()));
        self.bit(robot.duty().is_some());
        self.bit(is_unavailable(robot));
        self.bit(robot.farewell().is_some());
        self.bit(robot.identity() == Identity::Expiring);
    }
}

fn is_unavailable(robot: &Robot) -> bool {
    robot.availability() != Availability::Available
}

fn progress(progress: Option<Progress>) -> u32 {
    match progress {
        None => 0,
        Some(Progress::Executing) => 1,
        Some(Progress::InPosition) => 2,
        Some(Progress::Completed) => 3,
        Some(Progress::Failed(Failure::ExecutionLimit)) => 6,
        Some(Progress::Failed(_)) => 4,
        Some(Progress::SafeIdle) => 5,
    }
}
