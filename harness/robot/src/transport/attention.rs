//! When a datagram arrived that was taken off a socket: not later than the thread that receives can vouch for.
//!
//! The kernel stamps what arrives, by the wall clock, which may be put. So a stamp is believed within what the
//! thread vouches for: a datagram did not arrive before the socket was seen empty the last time, and not after it
//! was taken. Where there is no stamp that fits, the thread vouches alone: while it looks at the socket all the
//! time, a datagram arrives when it is taken. A thread that hung, with its process or alone, finds datagrams that
//! have been waiting for it, and cannot tell since when. They may have arrived as early as it looked the last time
//! before, and that is what is said of all of them until the socket was seen empty:
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

/// Attention of a receiving thread to its socket.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attention {
    /// When it looked at the socket the last time.
    looked: Instant,
    /// Since when datagrams may be waiting that it has not taken.
    waiting_since: Option<Instant>,
    /// When the socket was seen empty the last time.
    empty: Instant,
}

impl Attention {
    /// A socket that has just been opened.
    pub(super) const fn new(now: Instant) -> Self {
        Self {
            looked: now,
            waiting_since: None,
            empty: now,
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

    /// A call that was to wait for so long at most took a datagram at `now`, which the kernel had so long before, if
    /// it says so. When the datagram arrived, or, where the kernel's age is not possible, when at the earliest.
    pub(super) fn took(
        &mut self,
        at_most: Duration,
        now: Instant,
        age: Option<Duration>,
    ) -> Instant {
        let before = std::mem::replace(&mut self.looked, now);
        if now.duration_since(before) > at_most + SLACK {
            self.waiting_since.get_or_insert(before);
        }
        let possible = now.duration_since(self.empty) + SLACK;
        age.filter(|age| *age <= possible)
            .and_then(|age| now.checked_sub(age))
            .or(self.waiting_since)
            .unwrap_or(now)
    }

    /// A call that began at `called`, and was to wait for so long at most, found nothing until `now`. One that
    /// a signal interrupted has not seen that. Where it came back late, the thread hung after it had looked,
    /// and what arrived meanwhile was not seen.
    pub(super) fn saw_empty(&mut self, called: Instant, at_most: Duration, now: Instant) {
        let has_hung = now.duration_since(called) > at_most + SLACK;
        self.looked = if has_hung { called } else { now };
        self.empty = self.looked;
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
        assert_eq!(attention.took(AT_MOST, now, None), now);
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
            assert_eq!(attention.took(AT_MOST, now, None), looked, "{n}");
            assert_eq!(attention.may_wait(AT_MOST), Duration::ZERO);
        }
        let called = looked + ms(2_010);
        attention.saw_empty(called, Duration::ZERO, called);
        let now = called + ms(3);
        assert_eq!(attention.took(AT_MOST, now, None), now);
    }

    #[test]
    fn what_waited_is_old_also_when_the_call_itself_came_late() {
        let began = Instant::now();
        let mut attention = Attention::new(began);
        let now = began + ms(300);
        assert_eq!(attention.took(AT_MOST, now, None), began);
        attention.saw_empty(now, AT_MOST, now + ms(10));
        let now = now + ms(11);
        assert_eq!(attention.took(AT_MOST, now, None), now);
    }

    #[test]
    fn a_thread_that_hung_after_it_had_looked_has_not_seen_what_arrived_meanwhile() {
        let began = Instant::now();
        let mut attention = Attention::new(began);
        // The call found nothing in its time, and the process was stopped before it could say so.
        let now = began + ms(1_200);
        attention.saw_empty(began, AT_MOST, now);
        assert_eq!(attention.took(AT_MOST, now, None), began);
        assert_eq!(attention.took(AT_MOST, now + ms(1), None), began);
    }

    #[test]
    fn the_kernel_is_believed_within_what_the_thread_vouches_for() {
        let began = Instant::now();
        let mut attention = Attention::new(began);
        attention.saw_empty(began, AT_MOST, began + ms(10));
        // It hung for 2 s, and one datagram arrived just before it went on.
        let now = began + ms(2_010);
        let took = |attention: &mut Attention, age| attention.took(AT_MOST, now, Some(age));
        assert_eq!(took(&mut attention, ms(30)) + ms(30), now);
        // Nothing can have arrived before the socket was empty: the clock was put.
        assert_eq!(took(&mut attention, ms(3_600_000)), began + ms(10));
        // A flood that the thread takes in without a pause waits for it all the same.
        let mut attention = Attention::new(began);
        for n in 1..100 {
            let now = began + ms(5 * n);
            let at = attention.took(AT_MOST, now, Some(ms(4 * n)));
            assert_eq!(at + ms(4 * n), now, "{n}");
        }
    }
}
