//! The safety case: every claim has evidence, all evidence is there, and the page says what the files in
//! `harness/safety` say. A claim whose test, property, proof or page is gone fails here.

mod case;
mod evidence;
mod page;
mod repository;

use std::collections::BTreeSet;

use case::{Case, Claim};
use evidence::Evidence;
use repository::Repository;

const PAGE: &str = "harness/doc/safety-case.md";

#[test]
fn every_claim_has_evidence_that_is_there() {
    let (case, repository) = (Case::read(), Repository::here());
    let found = case.findings(&repository);
    assert!(found.is_empty(), "{}", found.join("\n"));
    let (hazards, threats) = (case.hazards.len(), case.threats.len());
    assert!(
        hazards >= 15 && threats >= 10,
        "{hazards} hazards, {threats} threats"
    );
}

#[test]
fn the_page_is_what_the_files_say() {
    let (case, repository) = (Case::read(), Repository::here());
    let page = page::of(&case, &repository);
    if std::env::var_os("CROSSGUARD_BLESS").is_some() {
        repository.write(PAGE, &page);
    }
    let there = repository.text(PAGE).unwrap_or_default();
    let mut lines = page.lines().zip(there.lines());
    let differs = lines.find(|(new, old)| new != old);
    assert!(
        page == there,
        "run: cargo xtask bless safety-case.md\n{differs:?}"
    );
}

/// The test of the test: each piece of evidence is taken away in turn, from the repository as it is.
#[test]
fn a_claim_whose_evidence_is_gone_is_found() {
    let (case, repository) = (Case::read(), Repository::here());
    let mut kinds = BTreeSet::new();
    for claim in case.claims() {
        assert_eq!(claim.findings(&repository), Vec::<String>::new());
        for piece in &claim.evidence {
            let evidence: Evidence = piece.parse().unwrap();
            let without = evidence.taken_out_of(&repository);
            let found = claim.findings(&without).join("\n");
            assert!(
                found.contains(&claim.id) && found.contains(piece),
                "{piece}: {found}"
            );
            kinds.insert(piece.split(':').next().unwrap());
        }
    }
    let all = [
        "law",
        "page",
        "proof",
        "property",
        "scenario",
        "test",
        "weakening",
    ];
    assert_eq!(kinds, BTreeSet::from(all), "each kind was tried");
}

/// A claim as it stands in the file, changed.
fn changed(change: impl Fn(&mut Claim)) -> Vec<String> {
    let mut case = Case::read();
    change(&mut case.hazards[0]);
    case.findings(&Repository::here())
}

#[track_caller]
fn assert_found(found: &[String], what: &str) {
    let all = found.join("\n");
    assert!(all.contains(what), "'{what}' is not in: {all}");
}

#[test]
fn a_claim_without_evidence_control_residual_risk_or_assumption_is_found() {
    assert_found(&changed(|it| it.evidence.clear()), "H1: no evidence");
    assert_found(&changed(|it| it.controls.clear()), "H1: no control");
    assert_found(
        &changed(|it| it.residual.clear()),
        "H1: nothing said as 'residual'",
    );
    assert_found(
        &changed(|it| it.says = " ".to_owned()),
        "H1: nothing said as 'claim'",
    );
    assert_found(
        &changed(|it| it.controls[0] = "R99".to_owned()),
        "H1: no rule R99",
    );
    assert_found(
        &changed(|it| it.controls[0] = "G99".to_owned()),
        "H1: no rule G99",
    );
    assert_found(
        &changed(|it| it.controls[0] = "no/such.rs".to_owned()),
        "H1: no file no/such.rs",
    );
    assert_found(
        &changed(|it| it.assumes.push("A99".to_owned())),
        "H1: no assumption A99",
    );
    assert_found(
        &changed(|it| it.evidence.push("rumour:x".to_owned())),
        "H1: rumour:x: no kind",
    );
    assert_found(&changed(|it| it.id = "H2".to_owned()), "H2: twice");
}

#[test]
fn an_ignored_test_a_helper_and_a_proof_that_was_not_finished_are_no_evidence() {
    let with = |piece: &'static str| changed(move |it| it.evidence.push(piece.to_owned()));
    let helper = "test:harness/tests/safety_case/main.rs::assert_found";
    assert_found(&with(helper), "assert_found is no test");
    let ignored = "test:harness/tests/processes/body_port.rs::nosuch";
    assert_found(&with(ignored), "no test nosuch");
    let open = "proof:protocol::exchange::frame::any_robot_keeps_it";
    assert_found(&with(open), "Kani has not proved");
    let ignored = repository::Repository::here()
        .with("a.rs", "#[test]\n#[ignore = \"long\"]\nfn slow() {}\n");
    let evidence: Evidence = "test:a.rs::slow".parse().unwrap();
    assert_found(&[evidence.missing(&ignored).unwrap()], "slow is ignored");
}

#[test]
fn a_rule_or_property_that_no_claim_needs_has_to_say_why() {
    let (mut case, repository) = (Case::read(), Repository::here());
    case.beside.retain(|it| it.id != "R4");
    assert_found(&case.findings(&repository), "R4: no claim needs it");
    let mut case = Case::read();
    for claim in case.hazards.iter_mut().chain(&mut case.threats) {
        claim.evidence.retain(|it| it != "property:W3");
    }
    assert_found(&case.findings(&repository), "W3: no claim needs it");
    let mut case = Case::read();
    case.beside[0].id = "R5".to_owned();
    assert_found(&case.findings(&repository), "R5: a claim needs it");
}
