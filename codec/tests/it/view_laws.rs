//! The laws of the mapping, called with random input. Kani calls the same functions with all input.

use crate::support::core::Random;
use crossguard_codec::core::{Source, Uper, ram, rmcm};
use crossguard_codec::view::laws;
use crossguard_codec::{ExecutionStatus, MapPlace, TaskParameters, TaskProgression};
use crossguard_protocol::laws::arbitrary;
use crossguard_protocol::{
    Availability, Config, Coordination, MAX_FOLLOWERS, Millis, Role, Unavailability,
};
use proptest::prelude::*;

/// Random numbers for the protocol's values, mostly values that make a whole of them.
struct Hinted(Random);

impl crossguard_protocol::laws::Source for Hinted {
    fn number(&mut self, max: u32, hint: u32) -> u32 {
        let near = u32::try_from(self.0.index(0, 3)).unwrap();
        match self.0.index(0, 63) {
            1..8 if hint <= max => hint.saturating_add(near).min(max),
            8..16 if hint <= max => hint.saturating_sub(near),
            16.. if hint <= max => hint,
            _ => u32::try_from(self.0.integer(0, max.into())).unwrap(),
        }
    }
}

/// A RAM of the core that comes closer to a sound one than chance has it: a leader of its own session,
/// with the status of its role.
fn plausible(mut ram: ram::RAM, random: &mut Random) -> ram::RAM {
    use ram::{HelpStatus, SessionRole};
    let parameters = &mut ram.ram.ram_parameters;
    let operation = &mut parameters.robot_leader_follower_operation_container;
    let role = operation
        .as_mut()
        .and_then(|operation| operation.role.as_mut());
    let (status, own) = match role {
        None => (HelpStatus::None, None),
        Some(SessionRole::Requester(role)) => (HelpStatus::NeedHelp, Some(&mut role.session)),
        Some(SessionRole::Leader(role)) => (HelpStatus::RoleConfirmed, Some(&mut role.session)),
        Some(SessionRole::Helper(_)) => (HelpStatus::OfferHelp, None),
        Some(SessionRole::Follower(role)) => {
            if random.flip() {
                role.last_command = None;
            }
            (HelpStatus::RoleConfirmed, None)
        }
    };
    parameters.robot_status_container.help_status = status;
    if let Some(session) = own {
        session.leader_station_id = ram.header.station_id;
    }
    ram
}

fn rmcm_of(random: &mut Random) -> rmcm::RMCM {
    let mut rmcm = rmcm::RMCM::arbitrary(random);
    let container = &mut rmcm.rmcm.rmcm_parameters.maneuver_container;
    if let rmcm::ManeuverContainer::LeaderManeuverContainer(leader) = container {
        leader.session.leader_station_id = rmcm.header.station_id;
    }
    rmcm
}

fn availability(random: &mut Random) -> Availability {
    let why = [
        Unavailability::LowBattery,
        Unavailability::Teleoperated,
        Unavailability::EmergencyStop,
        Unavailability::LocalFault,
        Unavailability::NotSafe,
    ];
    let why = why.get(random.index(0, why.len())).copied();
    why.map_or(Availability::Available, Availability::Unavailable)
}

fn place(random: &mut Random) -> MapPlace {
    let region = random.flip().then_some(7);
    if random.flip() {
        MapPlace::RoadSegment { region, id: 12 }
    } else {
        MapPlace::Intersection { region, id: 12 }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4_096))]

    #[test]
    fn rams_keep_the_view(seed: u64, kind in 0_u32..5) {
        let availability = availability(&mut Random(!seed));
        let view = arbitrary::ram(&mut Hinted(Random(seed)), kind, true);
        laws::rams_keep_the_view(&view, availability);
    }

    #[test]
    fn hearing_a_ram_is_total(seed: u64) {
        let random = &mut Random(seed);
        let ram = ram::RAM::arbitrary(random);
        laws::hearing_a_ram_is_total(&ram);
        laws::hearing_a_ram_is_total(&plausible(ram, random));
    }

    #[test]
    fn states_are_told_as_they_were_read(seed: u64) {
        laws::states_are_told_as_they_were_read(&ram::RAM::arbitrary(&mut Random(seed)));
    }

    #[test]
    fn commands_keep_the_view(seed: u64, count in 0..6_usize, same_session: bool, placed: bool) {
        let source = &mut Hinted(Random(seed));
        let place = placed.then(|| place(&mut source.0));
        let commands: Vec<_> = (0..count).map(|_| arbitrary::command(source)).collect();
        let first = commands.first().copied();
        let told = |mut command: crossguard_protocol::Command| {
            if let Some(first) = first.filter(|_| same_session) {
                command.session = first.session;
            }
            let map_place = place;
            (command, TaskParameters { map_place, ..TaskParameters::default() })
        };
        let commands: Vec<_> = commands.into_iter().map(told).collect();
        laws::commands_keep_the_view(&commands);
    }

    #[test]
    fn answers_keep_the_view(seed: u64, time in prop::option::of(any::<u32>())) {
        let source = &mut Hinted(Random(seed));
        let answer = arbitrary::answer(source);
        let progression = TaskProgression::arbitrary(&mut source.0);
        let time_to_completion = time.map(Millis);
        let status = ExecutionStatus { progression, time_to_completion };
        laws::answers_keep_the_view(&answer, status);
    }

    #[test]
    fn hearing_an_rmcm_is_total(seed: u64) {
        laws::hearing_an_rmcm_is_total(&rmcm::RMCM::arbitrary(&mut Random(seed)));
        laws::hearing_an_rmcm_is_total(&rmcm_of(&mut Random(seed)));
    }

    #[test]
    fn parameters_are_told_as_they_were_read(seed: u64) {
        laws::parameters_are_told_as_they_were_read(&rmcm_of(&mut Random(seed)));
    }

    #[test]
    fn a_valid_robot_can_say_what_it_is(seed: u64, role in prop::sample::select(&Role::ALL[..])) {
        let config = Config::default();
        let source = &mut Hinted(Random(seed));
        for _ in 0..16 {
            let robot = arbitrary::robot(source, &config, role, (0, MAX_FOLLOWERS));
            laws::a_valid_robot_can_say_what_it_is(&config, &robot);
        }
    }
}

/// How many of many random values each premise lets through: no law is empty.
#[test]
fn the_premises_of_the_laws_are_met() {
    let (mut heard, mut commanded, mut valid) = (0, 0, 0);
    for seed in 0..10_000 {
        let random = &mut Random(seed);
        let ram = ram::RAM::arbitrary(random);
        let view = crossguard_codec::view_of_ram(&plausible(ram, random));
        heard += u32::from(view.is_ok_and(|view| view.coordination != Coordination::None));
        let rmcm = rmcm_of(random);
        let views = crossguard_codec::views_of_rmcm(&rmcm);
        commanded +=
            u32::from(views.is_ok_and(|_| crossguard_codec::execution_of(&rmcm).is_none()));
        let source = &mut Hinted(Random(seed));
        let config = Config::default();
        let role = Role::ALL[usize::try_from(seed).unwrap() % Role::ALL.len()];
        let robot = arbitrary::robot(source, &config, role, (0, MAX_FOLLOWERS));
        let says = robot.ram();
        let is_new = says.coordination == Coordination::None && says.farewell.is_none();
        valid += u32::from(robot.is_valid(&config) && !is_new);
    }
    println!("{heard} {commanded} {valid}");
    assert!(heard > 1_000 && commanded > 1_000 && valid > 100);
}
