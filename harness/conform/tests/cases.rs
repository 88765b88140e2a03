//! The cases are played to their ends, name statements that there are, and together they meet every statement but two.

use std::collections::BTreeSet;

use crossguard_conform::case::{Case, play};
use crossguard_conform::statements::Statement;
use crossguard_conform::subject::Subject as _;
use crossguard_protocol::{Config, Robot, StationId};

mod in_process;
use in_process::{InProcess, table};

/// Statements that no case meets yet.
const NOT_MET: [&str; 2] = ["the-nearer-is-chosen", "unfit-offers-are-not-taken"];

#[test]
fn the_cases_leave_no_statement_out() {
    let robot = StationId(1);
    let mut subject = InProcess::new(robot, Config::default(), Robot::new);
    let mut table = table(robot);
    let statements = Statement::all();
    let all: BTreeSet<_> = statements.iter().map(|it| it.name).collect();
    let (mut known, mut met) = (BTreeSet::new(), BTreeSet::new());
    for case in Case::all() {
        subject.restart().unwrap();
        table.boot += 1;
        let played = play(&mut subject, &table, &case.plays).unwrap();
        let words = case.words();
        assert_eq!(played.stopped, None, "{words}");
        assert!(case.statements.iter().all(|it| all.contains(&**it)));
        assert!(known.insert(case.plays), "twice: {words}");
        let judged = statements
            .iter()
            .filter(|it| !it.judge(&played.exchange, &table.terms).is_empty());
        met.extend(judged.map(|it| it.name));
    }
    assert!(all.difference(&met).eq(&NOT_MET), "{met:?}");
}
