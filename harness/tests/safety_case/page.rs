//! The page that an assessor reads.

use std::fmt::Write as _;

use super::case::{Case, Claim, Said};
use super::evidence::{Evidence, HARNESSES, VERIFICATION, proof_time, scenario_file};
use super::repository::Repository;

const HEAD: &str = "\
# The safety case of the crossing

What can go wrong for somebody on the road, what is claimed about each of it, on what evidence, and what remains. Claims and
evidence are in [`harness/safety`](../safety), and a test ([`safety_case`](../tests/safety_case/main.rs)) makes this page of
them (`cargo xtask bless safety-case.md`). It fails when a test, property, proof, scenario or page that a claim rests on is
gone, when a claim has no evidence, and when a rule of the protocol or a verified property is needed by no claim.

The kit has not been assessed by anybody, and no part of it is certified. This page is for assessors of a robot that
uses it. It says what can be relied on, and where.
";

/// Where the day is on which all proofs were verified.
const VERIFIED: &str = "proofs/verified.toml";

/// The text of the page.
pub(crate) fn of(case: &Case, repository: &Repository) -> String {
    let mut page = HEAD.to_owned();
    page.push_str(&proved(repository));
    section(&mut page, "The goal", case.goal.trim());
    section(
        &mut page,
        "What is not a safety function",
        &said(&case.not_safety),
    );
    section(
        &mut page,
        "What an integrator has to bring",
        &said(&case.bring),
    );
    let text = "The kit was assessed by none of them. They say where to look.\n\n";
    let standards = case.orientation.iter();
    let standards = standards.map(|it| format!("- **{}**: {}\n", it.standard, it.what.trim()));
    section(
        &mut page,
        "Standards, for orientation",
        &(text.to_owned() + &standards.collect::<String>()),
    );
    section(&mut page, "Assumptions", &assumptions(case));
    let at_a_glance = [("hazard", &case.hazards), ("threat", &case.threats)].map(|it| glance(&it));
    section(&mut page, "At a glance", &at_a_glance.join("\n"));
    for (title, claims) in [("Hazards", &case.hazards), ("Threats", &case.threats)] {
        section(&mut page, title, "");
        for claim in claims {
            page.push_str(&told(claim, repository));
        }
    }
    section(&mut page, "From rules to hazards", &rules(case, repository));
    page.trim_end().to_owned() + "\n"
}

/// How old the proofs are.
fn proved(repository: &Repository) -> String {
    let text = repository.text(VERIFIED).unwrap_or_default();
    let verified: toml::Table = text.parse().unwrap_or_default();
    let date = verified.get("date").and_then(toml::Value::as_str);
    let date = date.unwrap_or("a day that is not known");
    format!(
        "\nKani verified all proofs on {date}. `cargo run -p crossguard-proofs --example run -- --status` says whether a source has\n\
         changed since, by the digests in {}.\n",
        link(VERIFIED, VERIFIED)
    )
}

fn section(page: &mut String, title: &str, text: &str) {
    let _ = write!(page, "\n## {title}\n");
    if !text.is_empty() {
        let _ = write!(page, "\n{}\n", text.trim_end());
    }
}

fn said(all: &[Said]) -> String {
    let lines = all
        .iter()
        .map(|it| format!("- **{}** {}\n", sentence(&it.what), it.why.trim()));
    lines.collect()
}

/// A title with a full stop behind it.
fn sentence(text: &str) -> String {
    format!("{}.", text.trim().trim_end_matches('.'))
}

fn or_none(list: &[String]) -> String {
    if list.is_empty() {
        "–".to_owned()
    } else {
        list.join(", ")
    }
}

fn assumptions(case: &Case) -> String {
    let mut table = "\
Where one does not hold, the claims that need it do not either. Rules G… are those of [the integrator's
guide](../../protocol/doc/integration.md#the-rules).

| id | what is assumed | who keeps it | rules | needed by |
|---|---|---|---|---|
"
    .to_owned();
    for it in &case.assumptions {
        let needed = case.claims().filter(|claim| claim.assumes.contains(&it.id));
        let needed: Vec<_> = needed.map(|claim| claim.id.clone()).collect();
        let rules = or_none(&it.rules);
        let _ = writeln!(
            table,
            "| {} | {} | {} | {rules} | {} |",
            it.id,
            it.what.trim(),
            it.who,
            needed.join(", ")
        );
    }
    table
}

fn glance((kind, claims): &(&str, &Vec<Claim>)) -> String {
    let mut table =
        format!("| {kind} | | controls | properties | assumes |\n|---|---|---|---|---|\n");
    for it in *claims {
        let is_rule = |it: &&String| !it.contains('/');
        let controls: Vec<_> = it.controls.iter().filter(is_rule).cloned().collect();
        let properties: Vec<_> = it.properties().collect();
        let _ = writeln!(
            table,
            "| {} | {} | {} | {} | {} |",
            it.id,
            it.title,
            or_none(&controls),
            or_none(&properties),
            or_none(&it.assumes)
        );
    }
    table
}

/// A file of this repository, seen from this page.
fn link(text: &str, path: &str) -> String {
    format!("[{text}](../../{path})")
}

fn told(claim: &Claim, repository: &Repository) -> String {
    let mut text = format!(
        "\n### {}: {}\n\n{}\n",
        claim.id,
        claim.title,
        claim.situation.trim()
    );
    let who = claim.who.as_ref().map(|who| format!("Who: {who}. "));
    let causes = claim.causes.join("; ");
    let _ = writeln!(text, "{}Causes: {causes}.\n", who.unwrap_or_default());
    let _ = writeln!(text, "- **Claim.** {}", claim.says.trim());
    let _ = writeln!(text, "- **Argument.** {}", claim.argument.trim());
    let controls: Vec<_> = claim.controls.iter().map(|it| control(it)).collect();
    let _ = writeln!(text, "- **Controls.** {}", controls.join(", "));
    text.push_str("- **Evidence.**\n");
    for piece in &claim.evidence {
        let _ = writeln!(text, "  - {}", shown(piece, repository));
    }
    if !claim.assumes.is_empty() {
        let _ = writeln!(text, "- **Assumes** {}.", claim.assumes.join(", "));
    }
    let _ = writeln!(text, "- **Residual risk.** {}", claim.residual.trim());
    text
}

fn control(name: &str) -> String {
    if name.contains('/') {
        link(&format!("`{name}`"), name)
    } else if name.starts_with('R') {
        link(name, "protocol/doc/protocol.md#rules")
    } else {
        link(name, "protocol/doc/integration.md#the-rules")
    }
}

fn shown(piece: &str, repository: &Repository) -> String {
    match piece.parse() {
        Ok(Evidence::Property(id)) => {
            format!(
                "property {}",
                link(&id, &format!("{VERIFICATION}#properties"))
            )
        }
        Ok(Evidence::Scenario(name)) => {
            format!(
                "scenario {}, explored in full",
                link(&name, &scenario_file(&name))
            )
        }
        Ok(Evidence::Weakening(name)) => format!("weakening `{name}`"),
        Ok(Evidence::Law { file, name }) => format!("law {}", link(&name, &file)),
        Ok(Evidence::Proof(name)) => {
            let time = proof_time(&name, repository).unwrap_or_default();
            format!("proof {}, by Kani in {time}", link(&name, HARNESSES))
        }
        Ok(Evidence::Test { file, name }) => format!("test {}", link(&name, &file)),
        Ok(Evidence::Page { file, anchor }) => {
            let anchor = anchor.map(|it| format!("#{it}")).unwrap_or_default();
            format!("page {}", link(&file, &format!("{file}{anchor}")))
        }
        Err(why) => why,
    }
}

fn rules(case: &Case, repository: &Repository) -> String {
    let mut table = "\
Each rule of [the protocol](../../protocol/doc/protocol.md#rules) with its properties, and the claims that
have it as a control or one of its properties as evidence.

| rule | properties | control of | evidence for |
|---|---|---|---|
"
    .to_owned();
    let ids = |wanted: &dyn Fn(&Claim) -> bool| {
        let ids = case
            .claims()
            .filter(|it| wanted(it))
            .map(|it| it.id.clone());
        or_none(&ids.collect::<Vec<_>>())
    };
    for (rule, properties) in repository.rules() {
        let controlled = ids(&|it| it.controls.contains(&rule));
        let shown = ids(&|it| {
            it.properties()
                .any(|property| properties.contains(&property))
        });
        let _ = writeln!(
            table,
            "| {rule} | {} | {controlled} | {shown} |",
            properties.join(", ")
        );
    }
    table.push_str("\nRules and properties that no claim needs:\n\n");
    for it in &case.beside {
        let _ = writeln!(table, "- **{}.** {}", it.id, it.why.trim());
    }
    table
}
