//! When a datagram arrived that was taken off a socket: not later than the thread that receives can vouch for.
//!
//! The kernel's stamps are of the wall clock, which may be put. So the thread vouches for itself: while it
//! looks at the socket all the time, a datagram arrives when it is taken. A thread that hung, with its
//! process or alone, finds datagrams that have been waiting for it, and cannot tell since when. They may have
//! arrived as early as it looked the last time before, and that is what is said of all of them until the
//! socket was seen empty:
//!
//! ```text
//!   looks   looks            hangs             takes  takes  finds nothing
//!   ──┴───────┴─────────────────────────────────┴──────┴──────┴────────►
//!             └── said of both ─────────────────┘      │
//!             └────────────────────────────────────────┘
//! ```

use std::time::{Duration, Instant};

/// How much later than it asked for a thread may be awake and still have looked all the time.
const SLACK: Duration = Duration::from_millis(5);

/// What a receiving thread knows of its own attention.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attention {
    /// When it looked at the socket the last time.
    looked: Instant,
    /// Since when datagrams may be waiting that it has not taken.
    waiting_since: Option<Instant>,
}

impl Attention {
    /// A socket that has just been opened.
    pub(super) const fn new(now: Instant) -> Self {
        Self {
            looked: now,
            waiting_since: None,
        }
    }

    /// How long the next call may wait, of `at_most`: not at all while datagrams may be waiting. Only a socket
    /// that has nothing at once is empty, since a call that took long may have been held up with something in
    /// its hands.
    pub(super) const fn may_wait(&self, at_most: Duration) -> Duration {
        match self.waiting_since {
            None => at_most,
            Some(_) => Duration::ZERO,
        }
    }

    /// A call that was to wait for so long at most took a datagram at `now`. When that arrived at the earliest.
    pub(super) fn took(&mut self, at_most: Duration, now: Instant) -> Instant {
        let before = std::mem::replace(&mut self.looked, now);
        if now.duration_since(before) > at_most + SLACK {
            self.waiting_since.get_or_insert(before);
        }
        self.waiting_since.unwrap_or(now)
    }

    /// A call that began at `called`, and was to wait for so long at most, found nothing until `now`. One that
    /// a signal interrupted has not seen that. Where it came back late, the thread hung after it had looked,
    /// and what arrived meanwhile was not seen.
    pub(super) fn saw_empty(&mut self, called: Instant, at_most: Duration, now: Instant) {
        let has_hung = now.duration_since(called) > at_most + SLACK;
        self.looked = if has_hung { called } else { now };
        self.waiting_since = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT_MOST: Duration = Duration::from_millis(10);

    const fn ms(ms: u64) -> Duration {
        Duration::from_millis(ms)
    }

    #[test]
    fn what_an_attentive_thread_takes_has_just_arrived() {
        let began = Instant::now();
        let mut attention = Attention::new(began);
        attention.saw_empty(began, AT_MOST, began + ms(10));
        let now = began + ms(17);
        assert_eq!(attention.took(AT_MOST, now), now);
        assert_eq!(attention.may_wait(AT_MOST), AT_MOST);
    }

    #[test]
    fn what_waited_for_a_thread_that_hung_may_have_arrived_when_it_looked_last() {
        let began = Instant::now();
        let mut attention = Attention::new(began);
        let looked = began + ms(10);
        attention.saw_empty(began, AT_MOST, looked);
        // The process was stopped for two seconds; the signal that continues it interrupted the call.
        for n in 0..3 {
            // However long it is held up between two of them.
            let now = looked + ms(2_000 + 3 * n);
            assert_eq!(attention.took(AT_MOST, now), looked, "{n}");
            assert_eq!(attention.may_wait(AT_MOST), Duration::ZERO);
        }
        let called = looked + ms(2_010);
        attention.saw_empty(called, Duration::ZERO, called);
        let now = called + ms(3);
        assert_eq!(attention.took(AT_MOST, now), now);
    }

    #[test]
    fn what_waited_is_old_also_when_the_call_itself_came_late() {
        let began = Instant::now();
        let mut attention = Attention::new(began);
        let now = began + ms(300);
        assert_eq!(attention.took(AT_MOST, now), began);
        attention.saw_empty(now, AT_MOST, now + ms(10));
        let now = now + ms(11);
        assert_eq!(attention.took(AT_MOST, now), now);
    }

    #[test]
    fn a_thread_that_hung_after_it_had_looked_has_not_seen_what_arrived_meanwhile() {
        let began = Instant::now();
        let mut attention = Attention::new(began);
        // The call found nothing in its time, and the process was stopped before it could say so.
        let now = began + ms(1_200);
        attention.saw_empty(began, AT_MOST, now);
        assert_eq!(attention.took(AT_MOST, now), began);
        assert_eq!(attention.took(AT_MOST, now + ms(1)), began);
    }
}
