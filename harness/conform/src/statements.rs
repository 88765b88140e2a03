//! Statements about every exchange: plain ones over messages and times, each about one rule.
//!
//! None of them calls the transition function, and none knows a state of it: a statement reads what was sent, heard
//! and told, and says where its premise was met and whether it was kept there.
//!
//! ```text
//!   exchange ──► statement ──► met here, in this situation: kept, or broken and how
//! ```

/// A table of statements: the name, the rule, who judges it, of what each if it judges one at a time, and what it says.
macro_rules! statements {
    (@ $judge:ident) => { $judge };
    (@ $judge:ident $each:ident) => {
        |trace| $each(trace).into_iter().filter_map(|it| $judge(trace, it)).collect()
    };
    (@ $judge:ident (&$each:ident)) => {
        |trace| $each(trace).iter().filter_map(|it| $judge(trace, it)).collect()
    };
    ($($name:literal $rule:literal $judge:ident $(of $each:tt)?: $says:literal;)*) => {
        pub(super) const ALL: &[super::Statement] = &[$(super::Statement {
            name: $name,
            rule: $rule,
            says: $says,
            judge: statements!(@ $judge $($each)?),
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

use std::ops::Deref;

use crossguard_protocol::{Heartbeat, Millis, SessionId, Settings, StationId};

use crate::bench::Terms;
use crate::exchange::{Exchange, Message, RamSeen};
use crate::subject::Local;

/// How a statement was broken, if it was.
type Breach = Option<String>;

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
    /// Its text.
    pub says: &'static str,
    judge: fn(&Trace) -> Vec<Met>,
}

impl Statement {
    /// Where its premise was met in an exchange, and what came of it.
    #[must_use]
    pub fn judge(&self, exchange: &Exchange, terms: &Terms) -> Vec<Met> {
        (self.judge)(&Trace { exchange, terms })
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

/// An exchange, and what is assumed of the robot in it: all that a statement is judged by.
struct Trace<'a> {
    exchange: &'a Exchange,
    terms: &'a Terms,
}

impl Deref for Trace<'_> {
    type Target = Exchange;

    fn deref(&self) -> &Exchange {
        self.exchange
    }
}

/// Something that was told to the robot: when, what, and the newest RAM that had arrived of it by then.
type Told<'a> = (u64, Local, &'a RamSeen);

/// All that was told to the robot once it had sent a RAM.
fn told<'a>(trace: &'a Trace<'_>) -> impl Iterator<Item = Told<'a>> {
    let told = trace.told();
    told.filter_map(|(at, local)| Some((at, local, trace.state_at(at)?)))
}

/// A statement that was met when something was so.
fn met_when(at_ms: u64, situation: impl Into<String>, broken: Breach) -> Met {
    Met {
        at_ms,
        situation: situation.into(),
        broken,
    }
}

impl Trace<'_> {
    fn ms(&self, of: impl Fn(&Settings) -> Millis) -> u64 {
        self.terms.ms(of)
    }

    /// How soon something that is due at once has to be seen, in ms.
    fn soon_ms(&self) -> u64 {
        self.terms.soon_ms()
    }

    /// A statement that was met, and kept or broken.
    fn met(&self, at_ms: u64, broken: Breach) -> Met {
        met_when(at_ms, self.situation_at(at_ms), broken)
    }

    /// A message that the robot has to send within `limit_ms`. `None` if it does not send it, and something else was done
    /// in between.
    fn due(
        &self,
        at_ms: u64,
        limit_ms: u64,
        what: &str,
        is_it: impl Fn(&Message) -> bool,
    ) -> Option<Met> {
        let until_ms = at_ms + limit_ms;
        let mut said = self.said();
        let is_said = said.any(|(at, it)| (at_ms..=until_ms).contains(&at) && is_it(it));
        if !is_said && self.undisturbed_until(at_ms) < until_ms {
            return None;
        }
        let broken = (!is_said).then(|| format!("within {limit_ms} ms {what}"));
        Some(self.met(at_ms, broken))
    }

    /// The same of a RAM.
    fn ram_due(
        &self,
        at_ms: u64,
        limit_ms: u64,
        what: &str,
        is_it: impl Fn(&RamSeen) -> bool,
    ) -> Option<Met> {
        self.due(at_ms, limit_ms, what, |it| it.ram().is_some_and(&is_it))
    }

    /// The same of a RAM that is due at once.
    fn ram_soon(&self, at_ms: u64, what: &str, is_it: impl Fn(&RamSeen) -> bool) -> Option<Met> {
        self.ram_due(at_ms, self.soon_ms(), what, is_it)
    }

    /// A RAM that must not come while nothing else is done; `how` has words for one that comes so much later. `None` if
    /// something else was done too soon.
    fn never(
        &self,
        at_ms: u64,
        is_it: impl Fn(&RamSeen) -> bool,
        how: impl Fn(u64) -> String,
    ) -> Option<Breach> {
        let until_ms = self.undisturbed_until(at_ms);
        if until_ms < at_ms + self.soon_ms() {
            return None;
        }
        let mut rams = self.rams();
        let found = rams.find(|(at, state)| (at_ms..until_ms).contains(at) && is_it(state));
        Some(found.map(|(at, _)| how(at - at_ms)))
    }

    /// The RAM that the robot said while nothing else was done after `at_ms`, but not before what was done can have had
    /// an effect.
    fn afterwards(&self, at_ms: u64) -> impl Iterator<Item = (u64, &RamSeen)> {
        let until_ms = self.undisturbed_until(at_ms);
        let rams = self.rams();
        rams.filter(move |(at, _)| *at > at_ms && *at < until_ms)
    }

    /// Whether the robot's part was the same in all RAM while nothing else was done after `at_ms`; `None` if there were
    /// too few of them to say.
    fn part_unchanged(&self, at_ms: u64) -> Option<Breach> {
        let before = self.state_at(at_ms)?;
        // A requester with an offer leads when its time comes.
        if before.asks() || !self.is_in_contact(at_ms) {
            return None;
        }
        let kind = |state: &RamSeen| std::mem::discriminant(&state.ram.coordination);
        let enough_ms = if before.session().is_some() {
            self.ms(|s| s.ram_period) + self.terms.slack_ms.min(200)
        } else {
            0
        };
        let mut last_ms = None;
        for (at, state) in self.afterwards(at_ms) {
            if (state.session(), kind(state)) != (before.session(), kind(before)) {
                let now = crate::words::part(&state.ram.coordination);
                return Some(Some(format!("it is {now} {} ms later", at - at_ms)));
            }
            last_ms = Some(at);
        }
        (last_ms? >= at_ms + enough_ms).then_some(None)
    }

    /// Whether the leader of the session that the robot is in, if that is another, gave news within the last second: no
    /// timer ends the robot's part then.
    fn is_in_contact(&self, at_ms: u64) -> bool {
        let Some(state) = self.state_at(at_ms) else {
            return false;
        };
        let Some(session) = state.session().filter(|it| it.leader != self.robot) else {
            return true;
        };
        let beats = self.heartbeats(session).filter(|(at, _)| *at <= at_ms);
        let newest = news(beats).last();
        newest.is_some_and(|(at, _)| at + 1_000 >= at_ms)
    }

    fn heartbeats(&self, session: SessionId) -> impl Iterator<Item = (u64, Heartbeat)> {
        let played = self.played_rams();
        let of_it = played.filter(move |(_, it)| it.session() == Some(session));
        of_it.filter_map(|(at, it)| Some((at, it.heartbeat()?)))
    }

    /// The heartbeats that a follower of a session echoed.
    fn echoes(
        &self,
        session: SessionId,
        from: StationId,
    ) -> impl Iterator<Item = (u64, Heartbeat)> {
        let played = self.played_rams();
        let of_it = played.filter(move |(_, it)| it.ram.station == from && it.follows(session));
        of_it.filter_map(|(at, it)| Some((at, it.echo()?.1)))
    }
}

fn first_of_each<T, K: PartialEq>(
    all: impl Iterator<Item = T>,
    kind: impl Fn(&T) -> K,
) -> impl Iterator<Item = T> {
    let mut known = Vec::new();
    all.filter(move |it| {
        let kind = kind(it);
        let is_new = !known.contains(&kind);
        if is_new {
            known.push(kind);
        }
        is_new
    })
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
