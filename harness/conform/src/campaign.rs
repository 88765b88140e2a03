//! All cases, one after the other, and the verdict on each rule.

use serde::Serialize;

use crossguard_codec::Identifiers;
use crossguard_judge::chart::Chart;
use crossguard_protocol::StationId;
use crossguard_robot::trace::{Entry, Record};

use crate::case::{Case, Played, Table, play};
use crate::exchange::{Exchange, Happening, Message, Player};
use crate::rules::Rule;
use crate::statements::Statement;
use crate::subject::{Gone, Subject};

/// Verdict on a rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Verdict {
    /// Its statements were met, and kept.
    Pass,
    /// One of its statements was broken.
    Fail,
    /// None of its statements was met.
    NotObserved,
    /// Only a look inside can judge it.
    Beyond,
}

/// How a statement was broken.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Broken {
    /// The statement.
    pub statement: &'static str,
    /// Its text.
    pub says: &'static str,
    /// The case, in words.
    pub case: String,
    /// The situation of the robot.
    pub situation: String,
    /// The breach, in words.
    pub how: String,
    /// The exchange as a chart, in text.
    pub chart: String,
}

/// The verdict on a rule.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct RuleVerdict {
    /// Its id.
    pub rule: &'static str,
    /// Its text.
    pub says: &'static str,
    /// The verdict.
    pub verdict: Verdict,
    /// How often its statements were met and kept.
    pub kept: usize,
    /// How they were broken.
    pub broken: Vec<Broken>,
    /// Its statements that were never met.
    pub not_observed: Vec<&'static str>,
    /// The part of it that cannot be judged from outside.
    pub unjudged: Option<&'static str>,
}

/// Result of a campaign.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Report {
    /// The robot under test.
    pub robot: StationId,
    /// How many cases were played to their end.
    pub played: usize,
    /// How many there were.
    pub cases: usize,
    /// Why others were not, once each.
    pub stopped: Vec<String>,
    /// The rules, in order.
    pub rules: Vec<RuleVerdict>,
}

impl Report {
    /// Whether a rule was broken.
    #[must_use]
    pub fn has_failed(&self) -> bool {
        self.rules.iter().any(|rule| rule.verdict == Verdict::Fail)
    }

    /// Whether a rule that can be judged was not.
    #[must_use]
    pub fn is_incomplete(&self) -> bool {
        let is_open = |rule: &RuleVerdict| rule.verdict == Verdict::NotObserved;
        self.rules.iter().any(is_open)
    }
}

/// A campaign in the making.
#[derive(Debug)]
pub struct Campaign {
    statements: Vec<Statement>,
    rules: Vec<RuleVerdict>,
    met: Vec<&'static str>,
    played: usize,
    cases: usize,
    stopped: Vec<String>,
}

impl Campaign {
    /// One about these rules.
    #[must_use]
    pub fn new(rules: &[&'static Rule]) -> Self {
        let verdict = |rule: &&'static Rule| RuleVerdict {
            rule: rule.id,
            says: rule.says,
            verdict: Verdict::NotObserved,
            kept: 0,
            broken: Vec::new(),
            not_observed: Vec::new(),
            unjudged: rule.unjudged,
        };
        let is_asked = |it: &Statement| rules.iter().any(|rule| rule.id == it.rule);
        Self {
            statements: Statement::all().into_iter().filter(is_asked).collect(),
            rules: rules.iter().map(verdict).collect(),
            met: Vec::new(),
            played: 0,
            cases: 0,
            stopped: Vec::new(),
        }
    }

    /// The cases that meet one of its statements.
    #[must_use]
    pub fn cases(&self) -> Vec<Case> {
        let names: Vec<_> = self.statements.iter().map(|it| it.name).collect();
        let is_asked = |case: &Case| {
            case.statements
                .iter()
                .any(|it| names.contains(&it.as_str()))
        };
        Case::all().into_iter().filter(is_asked).collect()
    }

    /// Plays a case against a robot that is at rest. After a breach it plays the case once more, with the robot started
    /// anew. Only a statement that is broken again counts: a machine or a link may be late once.
    ///
    /// # Errors
    /// The robot or the link is gone.
    pub fn play<S: Subject>(
        &mut self,
        subject: &mut S,
        table: &mut Table,
        case: &Case,
    ) -> Result<(), Gone> {
        self.cases += 1;
        table.boot += 1;
        let played = play(subject, table, &case.plays)?;
        let mut again = None;
        if self.breaks(&played, table).next().is_some() && subject.restart().is_ok() {
            table.boot += 1;
            again = Some(play(subject, table, &case.plays)?);
        }
        match &played.stopped {
            None => self.played += 1,
            Some(why) => {
                let why = why.to_string();
                if !self.stopped.contains(&why) {
                    self.stopped.push(why);
                }
            }
        }
        self.judge(table, case, &played, again.as_ref());
        Ok(())
    }

    /// The statements that are broken in an exchange.
    fn breaks<'a>(
        &'a self,
        played: &'a Played,
        table: &'a Table,
    ) -> impl Iterator<Item = &'static str> + 'a {
        let statements = self.statements.iter();
        let broken = statements.filter(|statement| {
            let met = statement.judge(&played.exchange, &table.terms);
            met.iter().any(|met| met.broken.is_some())
        });
        broken.map(|statement| statement.name)
    }

    fn judge(&mut self, table: &Table, case: &Case, played: &Played, again: Option<&Played>) {
        let confirmed: Option<Vec<_>> = again.map(|again| self.breaks(again, table).collect());
        for statement in &self.statements {
            let Some(rule) = self.rules.iter_mut().find(|it| it.rule == statement.rule) else {
                continue;
            };
            let counts = confirmed
                .as_ref()
                .is_none_or(|it| it.contains(&statement.name));
            let mut told = false;
            for met in statement.judge(&played.exchange, &table.terms) {
                if !self.met.contains(&statement.name) {
                    self.met.push(statement.name);
                }
                match met.broken {
                    Some(how) if counts && !told => {
                        told = true;
                        let known = rule.broken.iter().any(|it| {
                            it.statement == statement.name && it.situation == met.situation
                        });
                        if known {
                            continue;
                        }
                        rule.broken.push(Broken {
                            statement: statement.name,
                            says: statement.says,
                            case: case.words(),
                            situation: met.situation,
                            how,
                            chart: chart(&played.exchange),
                        });
                    }
                    Some(_) => {}
                    None => rule.kept += 1,
                }
            }
        }
    }

    /// The verdicts.
    #[must_use]
    pub fn report(mut self, robot: StationId) -> Report {
        for rule in &mut self.rules {
            let of_rule = self.statements.iter().filter(|it| it.rule == rule.rule);
            let unmet = of_rule.filter(|it| !self.met.contains(&it.name));
            rule.not_observed = unmet.map(|it| it.name).collect();
            let is_beyond = Rule::of_id(rule.rule).is_some_and(Rule::is_beyond);
            rule.verdict = if !rule.broken.is_empty() {
                Verdict::Fail
            } else if is_beyond {
                Verdict::Beyond
            } else if rule.kept > 0 {
                Verdict::Pass
            } else {
                Verdict::NotObserved
            };
        }
        Report {
            robot,
            played: self.played,
            cases: self.cases,
            stopped: self.stopped,
            rules: self.rules,
        }
    }
}

/// An exchange as a sequence chart, in text.
#[must_use]
pub fn chart(exchange: &Exchange) -> String {
    let [ada, bo] = exchange.players;
    let robot = "robot";
    let stations = [(robot, exchange.robot), ("Ada", ada), ("Bo", bo)];
    let mut chart = Chart::new(&stations, Identifiers::default());
    let mut lines = vec![chart.header()];
    let begun_ms = exchange.seen.first().map_or(0, |seen| seen.at_ms);
    for seen in &exchange.seen {
        let at_us = seen.at_ms.saturating_sub(begun_ms) * 1_000;
        let heard_by = |robot: &str, from: StationId, message: &Message| Record {
            at_us,
            robot: robot.to_owned(),
            entry: Entry::Heard {
                message: message.service(),
                from,
                reception: None,
                octets: seen.octets.clone(),
            },
        };
        let ada = Player::Ada.name();
        lines.extend(match &seen.what {
            Happening::Said(message) => chart.lines(&heard_by(ada, exchange.robot, message)),
            Happening::Played(player, message) => {
                let from = exchange.players[*player as usize];
                chart.lines(&heard_by(robot, from, message))
            }
            Happening::Play(words) => chart.note(at_us, ada, &format!("* {words}")),
            Happening::Noise(name) => chart.note(at_us, ada, &format!("sends {name}")),
            Happening::Told(local) => chart.note(at_us, robot, &format!("* {local}")),
            Happening::Restarted => chart.note(at_us, robot, "! loses power and starts again"),
        });
    }
    lines.extend(chart.rest());
    lines.join("\n")
}
