//! Lies of insiders in their own names: each property names the insiders that can break it, and the checker finds the same.

use crossguard_model_check::check::{Options, check};
use crossguard_model_check::model::Model;
use crossguard_model_check::properties::{Insider, PropertyId};
use crossguard_model_check::scenario::Scenario;

fn can_break(id: PropertyId, insiders: &[Insider]) -> bool {
    let liars = id.authentication().liars();
    liars.iter().any(|liar| insiders.contains(liar))
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "filters give references")]
fn is_about_runs_without_cooperation(id: &PropertyId) -> bool {
    !matches!(id, PropertyId::L3 | PropertyId::W7)
}

/// Where an insider stands, all properties hold that assume no truth of it, the ones that the scenario's
/// file claims among them.
fn assert_claims_what_it_cannot_break(name: &str, insiders: &[Insider]) {
    let mut scenario = Scenario::load(name).unwrap();
    let claimed = scenario.properties.clone();
    let all = PropertyId::all_untimed().filter(is_about_runs_without_cooperation);
    scenario.properties = all.filter(|id| !can_break(*id, insiders)).collect();
    let judged = scenario.properties.clone();
    let report = check(&Model::new(scenario), &Options::default(), &mut |_| ());
    let violated: Vec<_> = report.violated().collect();
    assert!(
        violated.is_empty() && report.exhaustive,
        "{name}: {violated:?}"
    );
    assert!(claimed.iter().all(|id| judged.contains(id)), "{name}");
}

/// A test for each scenario with an insider, and where it stands in it. One that is to become a follower is a stranger before.
macro_rules! insiders {
    ($($test:ident($name:literal, [$($insider:ident),*]);)*) => {$(
        #[test]
        fn $test() {
            assert_claims_what_it_cannot_break($name, &[$(Insider::$insider),*]);
        }
    )*};
}

insiders! {
    a_follower_that_lies_breaks_nothing_that_assumes_no_truth_of_it("lying-follower", [Follower, Stranger]);
    a_helper_that_lies_breaks_nothing_that_assumes_no_truth_of_it("lying-helper", [Stranger]);
    a_leader_that_lies_breaks_nothing_that_assumes_no_truth_of_it("lying-leader", [Leader, Stranger]);
    // A robot that joins it is led by it.
    a_bystander_that_lies_breaks_nothing_that_assumes_no_truth_of_it("lying-bystander", [Stranger, Leader]);
}

/// An insider breaks the properties that are said to assume its truth.
#[test]
fn what_assumes_the_truth_of_an_insider_is_broken_by_its_lies() {
    let broken = [
        ("lying-follower", Insider::Follower, "I6 I8 W1"),
        ("lying-leader", Insider::Leader, "I2 I3 I6 I15"),
    ];
    for (name, insider, ids) in broken {
        let ids: Vec<PropertyId> = ids.split(' ').map(|id| id.parse().unwrap()).collect();
        let all = PropertyId::all_untimed().filter(is_about_runs_without_cooperation);
        let said: Vec<_> = all.filter(|id| can_break(*id, &[insider])).collect();
        assert_eq!(said, ids, "{name}");
        for id in ids {
            let mut scenario = Scenario::load(name).unwrap();
            (scenario.properties, scenario.expected) = (vec![id], None);
            // A leader that lies gives a session's number once more to a robot that has booted again.
            let boots = u8::from(id == PropertyId::I15);
            (scenario.bounds.crashes, scenario.bounds.restarts) = (boots, boots);
            let options = Options {
                until_broken: vec![id],
                ..Options::default()
            };
            let report = check(&Model::new(scenario), &options, &mut |_| ());
            assert!(report.violated().eq([id.name()]), "{name}: {id}");
        }
    }
}
