//! The timed model.

use crossguard_model_check::check::Options;
use crossguard_model_check::scenario::Scenario;
use crossguard_model_check::timed::{Model, check};

#[test]
#[ignore]
fn probe() {
    let name = std::env::var("SCENARIO").unwrap();
    let model = Model::new(Scenario::load(&name).unwrap()).unwrap();
    let options = Options {
        states_max: Some(std::env::var("MAX").unwrap().parse().unwrap()),
        ..Options::default()
    };
    let report = check(&model, &options, &mut |p| {
        eprintln!("{} depth {}", p.explored, p.depth)
    });
    for p in &report.properties {
        println!("{} {:?}", p.id, p.verdict);
        for s in &p.counterexample {
            println!("   {} {:?}", s.action, s.outputs);
        }
    }
    println!(
        "{:?} {} {} {} {:?}",
        report.figures, report.unique_states, report.depth, report.seconds, report.cut_off
    );
}
