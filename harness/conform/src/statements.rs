//! What must be true of every exchange: plain statements over messages and times, each about one rule.
//!
//! None of them calls the transition function, and none knows a state of it: a statement reads what was sent, heard
//! and told, and says where its premise was met and whether it was kept there.
//!
//! ```text
//!   exchange ──► statement ──► met here, in this situation: kept, or broken and how
//! ```

/// A table of statements: the name, the rule, who judges it, and what it says.
macro_rules! statements {
    ($($name:literal $rule:literal $judge:ident: $says:literal;)*) => {
        pub(super) const ALL: &[super::Statement] = &[$(super::Statement {
            name: $name,
            rule: $rule,
            says: $says,
            judge: $judge,
        }),*];
    };
}

mod answers;
mod contact;
mod ends;
mod help;
mod lead;
mod noise;
mod rivals;
mod roles;
mod select;
mod sign;

use crossguard_protocol::{Coordination, Heartbeat};

use crate::bench::Terms;
use crate::exchange::{Exchange, RamSeen, Seen, session_of};

/// How a statement was broken, if it was.
type Breach = Option<String>;

/// When something was seen, if it was.
type SeenAt = Option<u64>;

/// A place in an exchange where the premise of a statement was met.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Met {
    /// When, in ms on the tester's clock.
    pub at_ms: u64,
    /// The situation of the robot then.
    pub situation: String,
    /// How the statement was broken, if it was.
    pub broken: Option<String>,
}

/// Something that must be true.
#[derive(Clone, Copy, Debug)]
pub struct Statement {
    /// Its name.
    pub name: &'static str,
    /// The rule that it is about, as in the index of the protocol's page.
    pub rule: &'static str,
    /// What it says.
    pub says: &'static str,
    judge: fn(&Exchange, &Terms) -> Vec<Met>,
}

impl Statement {
    /// Where its premise was met in an exchange, and what came of it.
    #[must_use]
    pub fn judge(&self, exchange: &Exchange, terms: &Terms) -> Vec<Met> {
        (self.judge)(exchange, terms)
    }

    /// All of them, in the order of their rules.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let groups = [
            answers::ALL,
            contact::ALL,
            ends::ALL,
            help::ALL,
            lead::ALL,
            noise::ALL,
            rivals::ALL,
            roles::ALL,
            select::ALL,
            sign::ALL,
        ];
        let mut all = groups.concat();
        all.sort_by_key(|statement| (number(statement.rule), statement.name));
        all
    }
}

/// The number of a rule, to sort by.
pub(crate) fn number(rule: &str) -> u32 {
    rule.trim_start_matches('R').parse().unwrap_or(u32::MAX)
}

/// A statement that was met, and kept or broken.
fn met(exchange: &Exchange, at_ms: u64, broken: Option<String>) -> Met {
    Met {
        at_ms,
        situation: exchange.situation_at(at_ms),
        broken,
    }
}

/// A statement that was met when something was so.
fn met_when(at_ms: u64, situation: impl Into<String>, broken: Option<String>) -> Met {
    Met {
        at_ms,
        situation: situation.into(),
        broken,
    }
}

/// The first time after `at_ms`, and at most `limit_ms` later, at which something was seen: `Some(None)` if it never
/// was, `None` if that cannot be said because something else was done in between.
fn reaction(
    exchange: &Exchange,
    at_ms: u64,
    limit_ms: u64,
    is_it: impl Fn(&Seen) -> bool,
) -> Option<SeenAt> {
    let until_ms = at_ms + limit_ms;
    let mut after = exchange
        .seen
        .iter()
        .filter(|seen| (at_ms..=until_ms).contains(&seen.at_ms));
    if let Some(seen) = after.find(|seen| is_it(seen)) {
        return Some(Some(seen.at_ms));
    }
    (exchange.undisturbed_until(at_ms) >= until_ms).then_some(None)
}

/// A reaction that has to be seen in time, in words.
fn due(
    exchange: &Exchange,
    at_ms: u64,
    limit_ms: u64,
    what: &str,
    is_it: impl Fn(&Seen) -> bool,
) -> Option<Met> {
    let seen = reaction(exchange, at_ms, limit_ms, is_it)?;
    let broken = seen
        .is_none()
        .then(|| format!("within {limit_ms} ms {what}"));
    Some(met(exchange, at_ms, broken))
}

/// The RAM that the robot said while nothing else was done after `at_ms`, but not before what was done can have had
/// an effect.
fn afterwards(exchange: &Exchange, at_ms: u64) -> impl Iterator<Item = (u64, &RamSeen)> + '_ {
    let until_ms = exchange.undisturbed_until(at_ms);
    exchange
        .rams()
        .filter(move |(at, _)| *at > at_ms && *at < until_ms)
}

/// Whether the robot's part was the same in all RAM while nothing else was done after `at_ms`; `None` if there were
/// too few of them to say.
fn part_unchanged(exchange: &Exchange, terms: &Terms, at_ms: u64) -> Option<Breach> {
    let (_, before) = exchange.state_at(at_ms)?;
    // A requester with an offer leads when its time comes.
    let selects = matches!(before.ram.coordination, Coordination::NeedHelp { .. });
    if selects || !is_in_contact(exchange, at_ms) {
        return None;
    }
    let same = |ram: &RamSeen| {
        session_of(&ram.ram) == session_of(&before.ram)
            && std::mem::discriminant(&ram.ram.coordination)
                == std::mem::discriminant(&before.ram.coordination)
    };
    let has_part = session_of(&before.ram).is_some();
    let enough_ms = if has_part {
        terms.ms(|s| s.ram_period) + terms.slack_ms.min(200)
    } else {
        0
    };
    let mut last_ms = None;
    for (at, ram) in afterwards(exchange, at_ms) {
        if !same(ram) {
            let now = crate::words::part(&ram.ram.coordination);
            return Some(Some(format!("it is {now} {} ms later", at - at_ms)));
        }
        last_ms = Some(at);
    }
    (last_ms? >= at_ms + enough_ms).then_some(None)
}

/// Whether the leader of the session that the robot is in, if that is another, gave news within the last second: no timer
/// ends the robot's part then.
fn is_in_contact(exchange: &Exchange, at_ms: u64) -> bool {
    let Some((_, state)) = exchange.state_at(at_ms) else {
        return false;
    };
    let session = session_of(&state.ram).filter(|session| session.leader != exchange.robot);
    let Some(session) = session else { return true };
    let beats = exchange.played_rams().filter_map(|(at, _, played)| {
        let (Coordination::NeedHelp { heartbeat, .. } | Coordination::Leader { heartbeat, .. }) =
            played.ram.coordination
        else {
            return None;
        };
        (session_of(&played.ram) == Some(session) && at <= at_ms).then_some((at, heartbeat))
    });
    news(beats)
        .last()
        .is_some_and(|(at, _)| at + 1_000 >= at_ms)
}

/// When each heartbeat that was newer than all before was played: `(at, heartbeat)`, of RAM that give one.
fn news<'a>(
    played: impl Iterator<Item = (u64, Heartbeat)> + 'a,
) -> impl Iterator<Item = (u64, Heartbeat)> + 'a {
    let mut newest: Option<Heartbeat> = None;
    played.filter(move |(_, heartbeat)| {
        let is_news = newest.is_none_or(|newest| heartbeat.is_newer_than(newest));
        if is_news {
            newest = Some(*heartbeat);
        }
        is_news
    })
}
