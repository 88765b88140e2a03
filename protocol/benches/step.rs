//! Time of one transition, in the situations that an endpoint meets most and at worst.

#[path = "../tests/it/script.rs"]
mod script;

use std::hint::black_box;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use crossguard_protocol::{Input, Millis, Robot, TaskType};
use script::{ARI, GO2, NAO, NEAR, PEPPER, SPOT, Street, order};

fn team_of_four() -> Street {
    Street::with_roles(&[ARI, GO2, SPOT, NAO, PEPPER])
}

fn steps(criterion: &mut Criterion) {
    let pair = Street::with_roles(&[ARI, GO2]);
    let team = team_of_four();
    let executing = Street::executing(TaskType::MOVE);
    let mut commanded = team_of_four();
    for follower in [GO2, SPOT, NAO, PEPPER] {
        commanded.part(ARI, follower);
        commanded.tell(ARI, order(follower, TaskType::MOVE));
    }
    let heard = |ram_of: &Robot| Input::Ram {
        ram: ram_of.ram(),
        distance: NEAR,
    };
    let situations = [
        (
            "20 ms pass, idle",
            Robot::new(ARI, 1),
            Input::Elapsed(Millis(20)),
        ),
        (
            "20 ms pass, following",
            executing[GO2].clone(),
            Input::Elapsed(Millis(20)),
        ),
        (
            "20 ms pass, leading four",
            team[ARI].clone(),
            Input::Elapsed(Millis(20)),
        ),
        (
            "a RAM of nobody's concern",
            Robot::new(PEPPER, 1),
            heard(&pair[GO2]),
        ),
        (
            "the leader's RAM",
            executing[GO2].clone(),
            heard(&executing[ARI]),
        ),
        (
            "a follower's RAM, leading one",
            executing[ARI].clone(),
            heard(&executing[GO2]),
        ),
        (
            "a follower's RAM, leading four",
            team[ARI].clone(),
            heard(&team[PEPPER]),
        ),
        (
            "a command given, leading four",
            team[ARI].clone(),
            Input::Local(order(GO2, TaskType::MOVE)),
        ),
        (
            "four commands unacknowledged, all timers due",
            commanded[ARI].clone(),
            Input::Elapsed(Millis(600)),
        ),
        (
            "contact with all four lost",
            team[ARI].clone(),
            Input::Elapsed(Millis(60_000)),
        ),
    ];
    let mut group = criterion.benchmark_group("step");
    for (name, robot, input) in situations {
        group.bench_function(name, |bencher| {
            bencher.iter_batched_ref(
                || robot.clone(),
                |robot| robot.step(&pair.config, black_box(input)),
                BatchSize::SmallInput,
            );
        });
    }
    group.bench_function("the RAM of a leader of four", |bencher| {
        bencher.iter(|| black_box(&team[ARI]).ram());
    });
    group.finish();
}

criterion_group!(benches, steps);
criterion_main!(benches);
