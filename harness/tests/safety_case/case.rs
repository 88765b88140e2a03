//! The safety case as it is in its files.

use std::collections::BTreeSet;

use serde::Deserialize;

use super::evidence::Evidence;
use super::repository::Repository;

/// A hazard or a threat, with what is claimed of it.
#[derive(Deserialize, Clone)]
#[serde(deny_unknown_fields)]
pub(crate) struct Claim {
    pub(crate) id: String,
    /// Who attacks; nobody in a hazard.
    pub(crate) who: Option<String>,
    pub(crate) title: String,
    pub(crate) situation: String,
    pub(crate) causes: Vec<String>,
    pub(crate) controls: Vec<String>,
    #[serde(rename = "claim")]
    pub(crate) says: String,
    pub(crate) argument: String,
    pub(crate) evidence: Vec<String>,
    pub(crate) assumes: Vec<String>,
    pub(crate) residual: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Assumption {
    pub(crate) id: String,
    pub(crate) what: String,
    pub(crate) who: String,
    pub(crate) rules: Vec<String>,
}

/// Something, and what there is to say about it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Said {
    pub(crate) what: String,
    pub(crate) why: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Standard {
    pub(crate) standard: String,
    pub(crate) what: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Beside {
    pub(crate) id: String,
    pub(crate) why: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Frame {
    goal: String,
    assumption: Vec<Assumption>,
    not_safety: Vec<Said>,
    bring: Vec<Said>,
    orientation: Vec<Standard>,
    beside: Vec<Beside>,
}

pub(crate) struct Case {
    pub(crate) goal: String,
    pub(crate) assumptions: Vec<Assumption>,
    pub(crate) not_safety: Vec<Said>,
    pub(crate) bring: Vec<Said>,
    pub(crate) orientation: Vec<Standard>,
    pub(crate) beside: Vec<Beside>,
    pub(crate) hazards: Vec<Claim>,
    pub(crate) threats: Vec<Claim>,
}

impl Case {
    pub(crate) fn read() -> Self {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Hazards {
            hazard: Vec<Claim>,
        }
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Threats {
            threat: Vec<Claim>,
        }
        let frame: Frame = toml::from_str(include_str!("../../safety/case.toml")).unwrap();
        let hazards: Hazards = toml::from_str(include_str!("../../safety/hazards.toml")).unwrap();
        let threats: Threats = toml::from_str(include_str!("../../safety/threats.toml")).unwrap();
        Self {
            goal: frame.goal,
            assumptions: frame.assumption,
            not_safety: frame.not_safety,
            bring: frame.bring,
            orientation: frame.orientation,
            beside: frame.beside,
            hazards: hazards.hazard,
            threats: threats.threat,
        }
    }

    pub(crate) fn claims(&self) -> impl Iterator<Item = &Claim> {
        self.hazards.iter().chain(&self.threats)
    }

    /// Everything that does not hold together.
    pub(crate) fn findings(&self, repository: &Repository) -> Vec<String> {
        let mut found: Vec<_> = self
            .claims()
            .flat_map(|it| it.findings(repository))
            .collect();
        let mut ids = BTreeSet::new();
        for claim in self.claims() {
            let id = &claim.id;
            if !ids.insert(id) {
                found.push(format!("{id}: twice"));
            }
            let is_known = |it: &&String| self.assumptions.iter().any(|known| known.id == **it);
            let unknown = claim.assumes.iter().filter(|it| !is_known(it));
            found.extend(unknown.map(|it| format!("{id}: no assumption {it}")));
        }
        found.extend(self.of_attackers());
        found.extend(self.of_assumptions(repository));
        found.extend(self.of_coverage(repository));
        found
    }

    fn of_attackers(&self) -> Vec<String> {
        const WHO: [&str; 4] = ["outsider", "insider", "local", "supply"];
        let hazards = self.hazards.iter().filter(|it| it.who.is_some());
        let is_named = |it: &&Claim| it.who.as_deref().is_some_and(|who| WHO.contains(&who));
        let threats = self.threats.iter().filter(|it| !is_named(it));
        let all = hazards.chain(threats);
        all.map(|it| format!("{}: 'who' is one of {WHO:?}, for threats alone", it.id))
            .collect()
    }

    fn of_assumptions(&self, repository: &Repository) -> Vec<String> {
        let mut found = Vec::new();
        let used: BTreeSet<_> = self.claims().flat_map(|it| &it.assumes).collect();
        for assumption in &self.assumptions {
            let id = &assumption.id;
            let missing = assumption
                .rules
                .iter()
                .filter_map(|it| rule_missing(it, repository));
            found.extend(missing.map(|why| format!("{id}: {why}")));
            if !["integrator", "operator", "kit"].contains(&&*assumption.who) {
                found.push(format!("{id}: who keeps it?"));
            }
            // The last one is about all that is explored, and any claim may rest on it.
            if !used.contains(id) {
                found.push(format!("{id}: no claim needs it"));
            }
        }
        found
    }

    /// Rules and properties that no claim rests on, and that nobody says why.
    fn of_coverage(&self, repository: &Repository) -> Vec<String> {
        let needed = self.needed();
        let rules = repository.rules().into_iter().map(|(id, _)| id);
        let all: BTreeSet<_> = rules.chain(repository.properties()).collect();
        let excused: BTreeSet<_> = self.beside.iter().map(|it| it.id.clone()).collect();
        let mut found = Vec::new();
        for id in &all {
            match (needed.contains(id), excused.contains(id)) {
                (false, false) => found.push(format!(
                    "{id}: no claim needs it, and 'beside' does not say why"
                )),
                (true, true) => {
                    found.push(format!("{id}: a claim needs it; take it out of 'beside'"));
                }
                _ => {}
            }
        }
        let unknown = excused.difference(&all);
        found.extend(unknown.map(|id| format!("{id}: neither rule nor property")));
        found
    }

    /// The rules that are controls, and the properties that are evidence.
    fn needed(&self) -> BTreeSet<String> {
        let controls = self.claims().flat_map(|it| it.controls.iter().cloned());
        let properties = self.claims().flat_map(Claim::properties);
        controls.chain(properties).collect()
    }
}

impl Claim {
    /// The properties among its evidence.
    pub(crate) fn properties(&self) -> impl Iterator<Item = String> {
        let named = self
            .evidence
            .iter()
            .filter_map(|it| it.strip_prefix("property:"));
        named.map(str::to_owned)
    }

    /// What is missing of it.
    pub(crate) fn findings(&self, repository: &Repository) -> Vec<String> {
        let mut found = Vec::new();
        let texts = [
            ("title", &self.title),
            ("situation", &self.situation),
            ("claim", &self.says),
            ("argument", &self.argument),
            ("residual", &self.residual),
        ];
        let empty = texts.iter().filter(|(_, text)| text.trim().is_empty());
        found.extend(empty.map(|(name, _)| format!("nothing said as '{name}'")));
        for (name, list) in [
            ("cause", &self.causes),
            ("control", &self.controls),
            ("evidence", &self.evidence),
        ] {
            if list.is_empty() {
                found.push(format!("no {name}"));
            }
        }
        found.extend(
            self.controls
                .iter()
                .filter_map(|it| rule_missing(it, repository)),
        );
        for piece in &self.evidence {
            let missing = match piece.parse::<Evidence>() {
                Ok(evidence) => evidence.missing(repository),
                Err(why) => Some(why),
            };
            found.extend(missing.map(|why| format!("{piece}: {why}")));
        }
        found
            .iter()
            .map(|why| format!("{}: {why}", self.id))
            .collect()
    }
}

/// A control is a rule of the protocol, one of the integrator's guide, or a file of code.
fn rule_missing(control: &str, repository: &Repository) -> Option<String> {
    let number = |letter| {
        let number = control.strip_prefix(letter)?;
        number
            .bytes()
            .all(|it| it.is_ascii_digit())
            .then_some(number)
    };
    let (is_there, what) = if number('R').is_some() {
        let mut rules = repository.rules().into_iter();
        (rules.any(|(id, _)| id == control), "rule")
    } else if let Some(number) = number('G') {
        (repository.has_guide_rule(number), "rule")
    } else {
        (repository.has(control), "file")
    };
    (!is_there).then(|| format!("no {what} {control}"))
}
