//! The mapping between messages and what the protocol reads of them.

use crossguard_codec::core::ram::{RAM, RobotLeaderFollowerOperationContainer};
use crossguard_codec::core::rmcm::{FollowerManeuverContainer, ManeuverContainer, RMCM};
use crossguard_codec::core::{Source as _, Uper};
use crossguard_codec::view::laws;
use crossguard_codec::{
    ExecutionStatus, TaskParameters, TaskProgression, view_of_ram, views_of_rmcm,
};
use crossguard_protocol::laws::{Source, arbitrary};
use crossguard_protocol::{Answer, Command, Millis};

use crate::harness::harnesses;
use crate::{Symbolic, kani};

/// Any RAM of a robot with this part in a session, of any availability.
fn any_view(part: u32) {
    let view = arbitrary::ram(&mut Symbolic, part, true);
    let availability = arbitrary::availability(&mut Symbolic);
    laws::rams_keep_the_view(&view, availability);
    let can_be_said = laws::can_be_said(&view);
    kani::cover!(can_be_said, "can be said");
    kani::cover!(!can_be_said, "contradicts itself");
}

harnesses! {
    /// Any answer.
    #[unwind(6)]
    fn answers_keep_the_view() {
        let answer: Answer = arbitrary::answer(&mut Symbolic);
        let status = ExecutionStatus {
            progression: TaskProgression::Idle,
            time_to_completion: Some(Millis(Symbolic.number(u32::MAX, 100))),
        };
        laws::answers_keep_the_view(&answer, status);
        let to_itself = answer.from == answer.session.leader;
        kani::cover!(to_itself, "of its leader");
        kani::cover!(!to_itself, "of another robot");
    }

    /// Any command, without parameters.
    #[unwind(6)]
    fn a_command_keeps_the_view() {
        let command: Command = arbitrary::command(&mut Symbolic);
        laws::commands_keep_the_view(&[(command, TaskParameters::default())]);
        let to_itself = command.to == command.session.leader;
        kani::cover!(to_itself, "to its leader");
        kani::cover!(!to_itself, "to another robot");
    }

    /// A RAM without a part in a session, with any farewell.
    #[unwind(6)]
    fn farewells_keep_the_view() {
        any_view(0);
    }

    /// A RAM that asks for help.
    #[unwind(6)]
    #[random_only("Kani was stopped unfinished, after two to seven minutes on a busy machine.")]
    fn requests_keep_the_view() {
        any_view(1);
    }

    /// A RAM that offers help.
    #[unwind(6)]
    fn offers_keep_the_view() {
        any_view(2);
    }

    /// A RAM of a leader.
    #[unwind(6)]
    #[random_only("Kani was stopped unfinished, after two to seven minutes on a busy machine.")]
    fn leaders_keep_the_view() {
        any_view(3);
    }

    /// A RAM of a follower.
    #[unwind(6)]
    fn followers_keep_the_view() {
        any_view(4);
    }

    /// Any status and any part in a session, in a RAM that is otherwise the lowest one.
    #[unwind(18)]
    fn hearing_a_ram_is_total() {
        let mut ram = RAM::LOWEST;
        ram.header.station_id = Uper::arbitrary(&mut Symbolic);
        let parameters = &mut ram.ram.ram_parameters;
        let status = &mut parameters.robot_status_container;
        status.help_status = Uper::arbitrary(&mut Symbolic);
        status.unavailability = Symbolic.flip().then(|| Uper::arbitrary(&mut Symbolic));
        parameters.robot_leader_follower_operation_container =
            Symbolic.flip().then(|| RobotLeaderFollowerOperationContainer::arbitrary(&mut Symbolic));
        laws::hearing_a_ram_is_total(&ram);
        let is_heard = view_of_ram(&ram).is_ok();
        kani::cover!(is_heard, "heard");
        kani::cover!(!is_heard, "contradicts itself");
    }

    /// Any answer in an RMCM that is otherwise the lowest one.
    #[unwind(6)]
    fn hearing_an_answer_is_total() {
        let mut rmcm = RMCM::LOWEST;
        rmcm.header.station_id = Uper::arbitrary(&mut Symbolic);
        rmcm.rmcm.rmcm_parameters.maneuver_container =
            ManeuverContainer::FollowerManeuverContainer(FollowerManeuverContainer::arbitrary(&mut Symbolic));
        laws::hearing_an_rmcm_is_total(&rmcm);
        let is_heard = views_of_rmcm(&rmcm).is_ok();
        kani::cover!(is_heard, "heard");
        kani::cover!(!is_heard, "contradicts itself");
    }
}
