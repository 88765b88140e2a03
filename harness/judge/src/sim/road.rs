//! State of the road: who guards it, what signs show, and how long that goes on after something failed.
//!
//! ```text
//!   sign of a leader ───┐
//!   body of a follower ─┼──► Road::see ──► W1, W3, W5 in milliseconds, W6, W8
//!   what robots hear ───┘
//! ```
//!
//! Nothing here asks the protocol what is so, and no function of it judges. Bodies are those of
//! [`road`](crossguard_model_check::road), which follow what robots put out. The times are computed from the
//! settings of the robot that they are about.

use crossguard_model_check::timed::{Limits, longest};
use crossguard_protocol::{Millis, SessionId, Settings};

use super::times::{Longest, Measure, Worst};

/// For how long a position counts.
const FRESH: Millis = Millis(1_000);

/// Observation of a robot after something happened to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    /// When its sign ends by itself, if it shows *go*.
    pub(super) go_ends_us: Option<u64>,
    /// The session that it leads, if it does.
    pub(super) leads: Option<SessionId>,
    /// The session in which its body guards people, if it does.
    pub(super) guards: Option<SessionId>,
    /// Whether it is up and does not hang.
    pub(super) is_awake: bool,
}

/// Post of a robot at the road.
#[derive(Clone, Debug)]
pub(super) struct Post {
    /// The corner at which it leads.
    pub(super) corner: usize,
    /// How many guards its crossing requires.
    pub(super) required: usize,
    /// For how long its sign shows *go* after a failure at most (W1, W5), and by when it knows of one (W6).
    lease: Millis,
    /// How long after the second RAM of another leader was due.
    period: Millis,
    /// How long after it noticed somebody a sign shows *go*, or its application has a reason (W8).
    served: Millis,
}

impl Post {
    pub(super) fn new(
        corner: usize,
        required: usize,
        patience_s: f64,
        settings: &Settings,
        limits: &Limits,
    ) -> Self {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "patience is some seconds"
        )]
        let patience = Millis((patience_s * 1e3) as u32);
        let period = longest(settings.ram_period, settings);
        Self {
            corner,
            required,
            lease: limits.corridor_closed,
            period,
            // A leader that has lost its patience says so when it looks again.
            served: limits
                .roles
                .saturating_add(longest(patience, settings))
                .saturating_add(period),
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Go {
    session: SessionId,
    since_us: u64,
    ends_us: u64,
}

#[derive(Clone, Debug)]
struct RoadUser {
    post: Post,
    go: Option<Go>,
    guards: Option<SessionId>,
    /// The session in which it guarded before, and since when it does not.
    gone: Option<(SessionId, u64)>,
    is_awake: bool,
}

/// A stop-watch.
#[derive(Clone, Copy, Debug)]
struct Stopwatch {
    measure: Measure,
    /// The leader that it is about.
    leader: usize,
    /// The guard, or the other leader; the leader itself where there is none.
    other: usize,
    since_us: u64,
    bound_ms: u32,
}

/// Two leaders whose signs show *go* at one corner.
#[derive(Clone, Copy, Debug)]
struct Meeting {
    pair: [usize; 2],
    /// Whether the first has heard the second, and the other way round.
    heard: [bool; 2],
}

/// The time that was too long, and its robot.
pub(super) type Overdue = (Measure, usize);

/// The road of a run.
#[derive(Debug)]
pub(super) struct Road {
    seats: Vec<RoadUser>,
    watches: Vec<Stopwatch>,
    meetings: Vec<Meeting>,
    /// How long a message takes at most.
    delay: Millis,
    /// Whether endpoints are told of time in time: W3's time, W6 and W8 need that.
    is_in_time: bool,
    worst: Worst,
}

impl Road {
    pub(super) fn new(posts: impl Iterator<Item = Post>, delay: Millis, is_in_time: bool) -> Self {
        let seat = |post| RoadUser {
            post,
            go: None,
            guards: None,
            gone: None,
            is_awake: false,
        };
        Self {
            seats: posts.map(seat).collect(),
            watches: Vec::new(),
            meetings: Vec::new(),
            delay,
            is_in_time,
            worst: Worst::default(),
        }
    }

    pub(super) const fn worst(&self) -> Worst {
        self.worst
    }

    /// Time has come to `now_us`: signs end by themselves, and nothing may take longer than its bound.
    pub(super) fn pass(&mut self, now_us: u64) -> Result<(), Overdue> {
        for place in 0..self.seats.len() {
            let ended = self.seats[place].go.filter(|go| go.ends_us <= now_us);
            if let Some(go) = ended {
                self.stop(go.ends_us, place)?;
            }
        }
        let late = |watch: &&Stopwatch| now_us - watch.since_us > u64::from(watch.bound_ms) * 1_000;
        match self.watches.iter().find(late) {
            Some(watch) => Err((watch.measure, watch.leader)),
            None => Ok(()),
        }
    }

    /// Something has happened to a robot.
    pub(super) fn see(&mut self, now_us: u64, place: usize, sight: Sight) -> Result<(), Overdue> {
        let shown = sight.go_ends_us.filter(|ends_us| *ends_us > now_us);
        match (shown, sight.leads) {
            (None, _) => {
                if self.seats[place].go.is_some() {
                    self.stop(now_us, place)?;
                }
            }
            (Some(ends_us), leads) => self.show(now_us, place, ends_us, leads)?,
        }
        self.see_awake(now_us, place, sight.is_awake);
        self.see_guard(now_us, place, sight.guards.filter(|_| sight.is_awake));
        Ok(())
    }

    /// A sign shows *go* until then. The sign of a robot that is down shows it for the session that it led.
    fn show(
        &mut self,
        now_us: u64,
        place: usize,
        ends_us: u64,
        leads: Option<SessionId>,
    ) -> Result<(), Overdue> {
        if let Some(go) = &mut self.seats[place].go
            && leads.is_none_or(|session| session == go.session)
        {
            go.ends_us = ends_us;
            return Ok(());
        }
        if self.seats[place].go.is_some() {
            self.stop(now_us, place)?;
        }
        let Some(session) = leads else { return Ok(()) };
        self.end(now_us, |watch| {
            watch.measure == Measure::Served && watch.leader == place
        })?;
        let corner = self.seats[place].post.corner;
        let others = self.seats.iter().enumerate();
        let others = others.filter(|(_, other)| other.go.is_some() && other.post.corner == corner);
        self.meetings.extend(others.map(|(other, _)| Meeting {
            pair: [place, other],
            heard: [false; 2],
        }));
        self.seats[place].go = Some(Go {
            session,
            since_us: now_us,
            ends_us,
        });
        Ok(())
    }

    /// A sign shows *stop* from then on.
    fn stop(&mut self, at_us: u64, place: usize) -> Result<(), Overdue> {
        self.seats[place].go = None;
        self.meetings.retain(|it| !it.pair.contains(&place));
        self.end(at_us, |watch| match watch.measure {
            Measure::SignAfterGuard | Measure::SignAfterLeader => watch.leader == place,
            Measure::TwoSigns => watch.leader == place || watch.other == place,
            _ => false,
        })
    }

    fn see_awake(&mut self, now_us: u64, place: usize, is_awake: bool) {
        let was_awake = std::mem::replace(&mut self.seats[place].is_awake, is_awake);
        if was_awake == is_awake {
            return;
        }
        // Of one that is not awake nothing else is asked, and nothing of it that was is left.
        self.watches.retain(|watch| match watch.measure {
            Measure::SignAfterGuard => true,
            Measure::TwoSigns => watch.leader != place && watch.other != place,
            _ => watch.leader != place,
        });
        self.meetings.retain(|it| !it.pair.contains(&place));
        if !is_awake && self.seats[place].go.is_some() {
            let bound = self.seats[place].post.lease;
            self.start(Measure::SignAfterLeader, place, place, now_us, bound);
        }
    }

    fn see_guard(&mut self, now_us: u64, place: usize, guards: Option<SessionId>) {
        let was = std::mem::replace(&mut self.seats[place].guards, guards);
        if was == guards {
            return;
        }
        if let Some(session) = was {
            self.seats[place].gone = Some((session, now_us));
            let shows = |seat: &RoadUser| seat.go.is_some_and(|go| go.session == session);
            let leaders = self.seats.iter().enumerate();
            let leaders = leaders.filter(|(_, seat)| shows(seat));
            let leaders: Vec<_> = leaders
                .map(|(leader, seat)| (leader, seat.post.lease, seat.is_awake))
                .collect();
            for (leader, bound, is_awake) in leaders {
                self.start(Measure::SignAfterGuard, leader, place, now_us, bound);
                if is_awake && self.is_in_time {
                    self.start(Measure::Untold, leader, place, now_us, bound);
                }
            }
        }
        if guards.is_some() && self.seats[place].gone.map(|(session, _)| session) == guards {
            // It hung, or was on its way to another place of the same crossing, and is back.
            self.seats[place].gone = None;
            self.watches.retain(|watch| {
                let of_guard = matches!(watch.measure, Measure::SignAfterGuard | Measure::Untold);
                !(of_guard && watch.other == place)
            });
        }
    }

    fn start(&mut self, measure: Measure, leader: usize, other: usize, since_us: u64, by: Millis) {
        self.watches.push(Stopwatch {
            measure,
            leader,
            other,
            since_us,
            bound_ms: by.0,
        });
    }

    /// Ends stop-watches. Fails with the time that was too long, if there is one.
    fn end(&mut self, at_us: u64, is_over: impl Fn(&Stopwatch) -> bool) -> Result<(), Overdue> {
        let mut late = Ok(());
        let worst = &mut self.worst;
        self.watches.retain(|watch| {
            if !is_over(watch) {
                return true;
            }
            let took_us = at_us.saturating_sub(watch.since_us);
            worst.note(watch.measure, watch.bound_ms, took_us);
            if took_us > u64::from(watch.bound_ms) * 1_000 {
                late = Err((watch.measure, watch.leader));
            }
            false
        });
        late
    }

    /// A leader's application is told that a guard is gone (W6).
    pub(super) fn tell_gone(
        &mut self,
        now_us: u64,
        leader: usize,
        guard: Option<usize>,
    ) -> Result<(), Overdue> {
        self.end(now_us, |watch| {
            let is_meant = guard.is_none_or(|guard| watch.other == guard);
            watch.measure == Measure::Untold && watch.leader == leader && is_meant
        })
    }

    /// A robot has noticed somebody who wants to cross (W8).
    pub(super) fn notice(&mut self, now_us: u64, place: usize) {
        let bound = self.seats[place].post.served;
        if self.is_in_time {
            self.start(Measure::Served, place, place, now_us, bound);
        }
    }

    /// The application of a robot has a reason why its session is over.
    pub(super) fn tell_end(&mut self, now_us: u64, place: usize) -> Result<(), Overdue> {
        self.end(now_us, |watch| {
            matches!(watch.measure, Measure::Served | Measure::Untold) && watch.leader == place
        })
    }

    /// A follower falls back because it has lost contact with the leader of this session: the sign shows *go*
    /// no more.
    pub(super) fn lose_contact(&mut self, now_us: u64, session: SessionId) -> Result<(), Overdue> {
        let signs = self.seats.iter().enumerate();
        let mut shown =
            signs.filter_map(|(place, seat)| seat.go.map(|go| (place, go.session, go.ends_us)));
        let found = shown.find(|(_, led, ends_us)| *led == session && *ends_us > now_us);
        let too_long_us = found.map_or(0, |(_, _, ends_us)| ends_us - now_us);
        self.worst.note(Measure::Unguarded, 0, too_long_us);
        match found {
            Some((place, ..)) => Err((Measure::Unguarded, place)),
            None => Ok(()),
        }
    }

    /// A robot has understood a RAM that another one sent then (W3).
    pub(super) fn hear(&mut self, now_us: u64, to: usize, from: usize, sent_us: u64) {
        let shows = |place: usize| self.seats[place].go.map(|go| go.since_us);
        if !self.is_in_time || shows(from).is_none_or(|since_us| sent_us < since_us) {
            return;
        }
        let mut met = None;
        for meeting in &mut self.meetings {
            let [a, b] = meeting.pair;
            if (a, b) == (to, from) || (b, a) == (to, from) {
                let knew = meeting.heard == [true; 2];
                meeting.heard[usize::from(b == to)] = true;
                met = (!knew && meeting.heard == [true; 2]).then_some(meeting.pair);
            }
        }
        if let Some([a, b]) = met {
            let period = self.seats[a].post.period.max(self.seats[b].post.period);
            let bound = period.saturating_add(self.delay);
            self.start(Measure::TwoSigns, a, b, now_us, bound);
        }
    }

    /// A packet did not get from one robot to another: when these two hear each other again is open.
    pub(super) fn lose(&mut self, from: usize, to: usize) {
        let are_meant = |a: usize, b: usize| (a, b) == (from, to) || (b, a) == (from, to);
        self.watches.retain(|watch| {
            watch.measure != Measure::TwoSigns || !are_meant(watch.leader, watch.other)
        });
        for meeting in &mut self.meetings {
            if are_meant(meeting.pair[0], meeting.pair[1]) {
                meeting.heard = [false; 2];
            }
        }
    }

    /// Whether the sign of a leader shows *go*.
    pub(super) fn shows_go(&self, leader: usize) -> bool {
        self.seats[leader].go.is_some()
    }

    /// The robots whose bodies guard at the sign of a leader.
    pub(super) fn guards_of(&self, leader: usize) -> Vec<usize> {
        let session = self.seats[leader].go.map(|go| go.session);
        let seats = self.seats.iter().enumerate();
        let guards = seats.filter(|(_, seat)| seat.guards.is_some() && seat.guards == session);
        guards.map(|(place, _)| place).collect()
    }

    /// The leaders whose signs show *go* in a session.
    pub(super) fn signs_of(&self, session: SessionId) -> Vec<usize> {
        self.signs(|_, go| go.session == session)
    }

    /// For how long the sign of a leader shows *go* after a guard was pushed off its place: until its position is no longer
    /// fresh, and then as after any failure (P2).
    pub(super) fn leaves_within_us(&self, leader: usize) -> u64 {
        let post = &self.seats[leader].post;
        let bound = FRESH.saturating_add(post.lease).saturating_add(post.period);
        u64::from(bound.0) * 1_000
    }

    /// The leaders at a corner whose signs show *go*.
    pub(super) fn signs_at(&self, corner: usize) -> Vec<usize> {
        self.signs(|seat, _| seat.post.corner == corner)
    }

    fn signs(&self, is: impl Fn(&RoadUser, Go) -> bool) -> Vec<usize> {
        let seats = self.seats.iter().enumerate();
        let shows = seats.filter(|(_, seat)| seat.go.is_some_and(|go| is(seat, go)));
        shows.map(|(place, _)| place).collect()
    }

    /// A person steps on the road at the sign of a leader (W1). Every required guard is in place, or has been away for
    /// less than the leader's lease. So many of its followers are `liars`, which are nowhere. Returns the session, how
    /// many guards it requires, and the places of the guards that are gone.
    pub(super) fn step_on_road(
        &mut self,
        now_us: u64,
        leader: usize,
        liars: usize,
    ) -> Result<Option<(SessionId, usize, Vec<usize>)>, Overdue> {
        let RoadUser { post, go, .. } = &self.seats[leader];
        let Some(Go { session, .. }) = *go else {
            return Ok(None);
        };
        let (required, bound_ms) = (post.required, post.lease.0);
        let in_place = self.seats.iter();
        let in_place = in_place.filter(|seat| seat.guards == Some(session)).count();
        let seats = self.seats.iter().enumerate();
        let mut gone: Vec<_> = seats
            .filter_map(|(place, seat)| {
                let (of, since_us) = seat.gone?;
                (of == session && seat.guards != Some(session)).then_some((since_us, place))
            })
            .collect();
        gone.sort_unstable_by(|a, b| b.cmp(a));
        let missing = required.saturating_sub(in_place + liars);
        gone.truncate(missing);
        let since_us = gone.last().map_or(now_us, |(since_us, _)| *since_us);
        self.worst
            .note(Measure::GuardGone, bound_ms, now_us - since_us);
        let is_in_time = now_us - since_us <= u64::from(bound_ms) * 1_000;
        if gone.len() < missing || !is_in_time {
            return Err((Measure::GuardGone, leader));
        }
        let gone = gone.into_iter().map(|(_, place)| place).collect();
        Ok(Some((session, required, gone)))
    }

    /// A person who waited since the network was healed is across, and the crossing is completed (W7).
    pub(super) fn complete(&mut self, took_us: u64, bound_ms: u32) {
        let ms = u32::try_from(took_us.div_ceil(1_000)).unwrap_or(u32::MAX);
        let observed = Longest { ms, bound_ms };
        self.worst.note_longest(Measure::Crossed, observed);
    }
}

#[cfg(test)]
mod tests;
