//! exp
use crossguard_protocol::laws::arbitrary::{self, Kind, Stage, Parting};
use crossguard_protocol::laws::steps::{self, Taken};
use crossguard_protocol::{Config, Robot};
use crate::harness::harnesses;
use crate::{kani, Symbolic};

fn any(config: &Config, stage: Stage, peers: usize, parting: Parting) -> Robot {
    let robot = arbitrary::shaped(&mut Symbolic, config, stage, peers, parting);
    kani::assume(robot.is_valid(config));
    robot
}

harnesses! {
    #[unwind(17)]
    #[solver(minisat)]
    fn e2() {
        let config = Config::default();
        let robot = any(&config, Stage::Leading, 2, Parting::None);
        let input = arbitrary::input(&mut Symbolic, Kind::RamFollower);
        let step = Taken::new(&config, robot, input);
        kani::cover!(step.said.is_empty(), "x");
    }
    #[unwind(17)]
    #[solver(minisat)]
    fn e3() {
        let config = Config::default();
        let robot = any(&config, Stage::Leading, 2, Parting::None);
        let input = arbitrary::input(&mut Symbolic, Kind::RamFollower);
        let step = Taken::new(&config, robot, input);
        steps::keeps_the_state_valid(&config, &step);
        kani::cover!(step.said.is_empty(), "x");
    }
    #[unwind(17)]
    #[solver(minisat)]
    fn e4() {
        let config = Config::default();
        let robot = any(&config, Stage::Leading, 2, Parting::None);
        let input = arbitrary::input(&mut Symbolic, Kind::RamFollower);
        let step = Taken::new(&config, robot, input);
        steps::all(&config, &step);
        kani::cover!(step.said.is_empty(), "x");
    }
}
