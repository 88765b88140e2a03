//! The timers: which are armed, which is due, what each does.

use crate::MAX_TIMERS;
use crate::config::Config;
use crate::input::Timer;
use crate::list::List;
use crate::output::{EndReason, GoneReason, Ignored, Output, ReleaseReason, Sink};
use crate::robot::{Effect, Step};
use crate::state::{Contact, Identity, Lease, Phase, Robot};
use crate::time::{Countdown, Millis};

/// Visits every countdown of a robot, with its timer, in the order in which due timers fire: what
/// keeps people safe first, the RAM that tells of it last. Works on `&Robot` and `&mut Robot`.
macro_rules! visit_countdowns {
    ($robot:expr, $iter:ident, ($($mutability:tt)?), $visit:expr) => {{
        let robot = $robot;
        #[allow(unused_mut, reason = "not every visitor has a state to change")]
        let mut visit = $visit;
        match &$($mutability)? robot.phase {
            Phase::Idle => {}
            Phase::Requesting(requesting) => {
                for offer in requesting.offers.$iter() {
                    visit(Timer::Offer(offer.station), &$($mutability)? offer.standing);
                }
                visit(Timer::Help, &$($mutability)? requesting.help);
                visit(Timer::Selection, &$($mutability)? requesting.selection);
            }
            Phase::Offering(offering) => {
                visit(Timer::Reservation, &$($mutability)? offering.reservation);
            }
            Phase::Leading(leading) => {
                for member in leading.members.$iter() {
                    let station = member.station;
                    match &$($mutability)? member.lease {
                        Lease::Stands(left) => visit(Timer::Lease(station), left),
                        Lease::Expired(left) => visit(Timer::Lost(station), left),
                    }
                    if let Some(order) = &$($mutability)? member.order {
                        visit(Timer::Execution(station), &$($mutability)? order.execution);
                    }
                    if let Some(outstanding) = &$($mutability)? member.outstanding {
                        let left = &$($mutability)? outstanding.acknowledgement;
                        visit(Timer::Acknowledgement(station), left);
                    }
                }
            }
            Phase::Following(following) => match &$($mutability)? following.contact {
                Contact::Fresh(left) => visit(Timer::Safety, left),
                Contact::Lost(left) => visit(Timer::Leave, left),
            },
        }
        if let Identity::Locked(left) = &$($mutability)? robot.identity {
            visit(Timer::IdentityLock, left);
        }
        if let Some(standing) = &$($mutability)? robot.farewell {
            visit(Timer::Farewell, &$($mutability)? standing.left);
        }
        visit(Timer::Ram, &$($mutability)? robot.ram);
    }};
}

impl Robot {
    /// The armed timers with the time they have left, in the order in which they would fire if all
    /// were due.
    #[must_use]
    pub fn timers(&self) -> List<(Timer, Millis), MAX_TIMERS> {
        let mut timers = List::EMPTY;
        visit_countdowns!(self, iter, (), |timer, countdown: &Countdown| {
            if let Some(left) = countdown.left() {
                let pushed = timers.push((timer, left));
                debug_assert!(pushed.is_ok(), "more than {MAX_TIMERS} timers");
            }
        });
        timers
    }

    /// The time until the next timer fires, `None` when no timer is armed.
    #[must_use]
    pub fn next_due(&self) -> Option<Millis> {
        let mut next: Option<Millis> = None;
        visit_countdowns!(self, iter, (), |_, countdown: &Countdown| {
            if let Some(left) = countdown.left() {
                next = Some(next.map_or(left, |next| next.min(left)));
            }
        });
        next
    }

    fn first_due(&self) -> Option<Timer> {
        let mut due = None;
        visit_countdowns!(self, iter, (), |timer, countdown: &Countdown| {
            if due.is_none() && countdown.is_due() {
                due = Some(timer);
            }
        });
        due
    }

    /// Lets time pass. Due timers fire, each once: a robot that was told late does what it
    /// missed now, not several times over.
    pub(crate) fn elapse(&mut self, step: &mut Step<'_, impl Sink>, elapsed: Millis) {
        let late = match self.ram.left() {
            Some(left) => elapsed.saturating_sub(left),
            None => Millis::ZERO,
        };
        self.advance(elapsed);
        // Every timer that fires is dropped or armed anew with at least 1 ms, so this ends.
        while let Some(timer) = self.first_due() {
            self.fire(step, timer, late);
        }
    }

    /// Lets all countdowns run; none fires yet.
    pub(crate) fn advance(&mut self, elapsed: Millis) {
        visit_countdowns!(self, iter_mut, (mut), |_, countdown: &mut Countdown| {
            countdown.elapse(elapsed);
        });
    }

    /// The time that `timer` has left, `None` when it is not armed.
    pub(crate) fn time_left(&self, timer: Timer) -> Option<Millis> {
        let mut left = None;
        visit_countdowns!(self, iter, (), |other, countdown: &Countdown| {
            if other == timer {
                left = countdown.left();
            }
        });
        left
    }

    /// One timer expires, whatever time it has left.
    pub(crate) fn expire(&mut self, step: &mut Step<'_, impl Sink>, timer: Timer) -> Effect {
        if self.time_left(timer).is_none() {
            return Err(Ignored::TimerNotArmed);
        }
        self.fire(step, timer, Millis::ZERO);
        Ok(())
    }

    pub(crate) fn fire(&mut self, step: &mut Step<'_, impl Sink>, timer: Timer, late: Millis) {
        match timer {
            Timer::Safety => self.safety_expired(step),
            // R14: and `t_leave` as well.
            Timer::Leave => self.leave(step, ReleaseReason::ContactLost),
            Timer::Lease(station) => self.lease_expired(step, station),
            // Without a lease for so long, it must have left.
            Timer::Lost(station) => self.drop_follower(step, station, GoneReason::NoContact),
            Timer::Execution(station) => self.execution_expired(step, station),
            Timer::Acknowledgement(station) => self.acknowledgement_expired(step, station),
            Timer::Offer(station) => self.offer_expired(step, station),
            // R5
            Timer::Help => self.end_session(step, EndReason::NoHelp),
            Timer::Selection => self.selection_expired(step),
            // Free for other requesters. A leader that confirms it all the same is told that it has no part in the session.
            Timer::Reservation => self.release(step, ReleaseReason::ReservationExpired),
            Timer::IdentityLock => self.identity_lock_expired(step),
            Timer::Farewell => self.farewell = None,
            Timer::Ram => self.ram_expired(step, late),
        }
    }

    /// A RAM period is over, `late` milliseconds ago.
    fn ram_expired(&mut self, step: &mut Step<'_, impl Sink>, late: Millis) {
        let period = step.config.settings().ram_period;
        self.ram = Countdown::armed(Millis(period.0 - late.0 % period.0));
        // A session ends with the identity lock, long before its periods exceed 16 bits.
        let periods = u16::try_from(1 + late.0 / period.0).unwrap_or(u16::MAX);
        self.bump_heartbeat(step, periods);
        step.out.push(Output::SendRam);
    }

    /// Some RAM periods are over. A follower that has echoed nothing for half the number space, which
    /// is longer than the identity may be locked, is lost whatever its other timers say.
    fn bump_heartbeat(&mut self, step: &mut Step<'_, impl Sink>, periods: u16) {
        if let Phase::Requesting(requesting) = &mut self.phase {
            // A request ends long before half the number space is used.
            requesting.heartbeat = requesting.heartbeat.after(periods);
        }
        while let Phase::Leading(leading) = &mut self.phase {
            let Some(station) = leading.follower_out_of_order(periods) else {
                leading.heartbeat = leading.heartbeat.after(periods);
                return;
            };
            self.drop_follower(step, station, GoneReason::NoContact);
        }
    }

    /// Replaces the time that every armed timer has left.
    #[cfg(any(test, feature = "laws", feature = "renaming"))]
    pub(crate) fn rename_countdowns(&mut self, mut left: impl FnMut(Timer, Millis) -> Millis) {
        visit_countdowns!(self, iter_mut, (mut), |timer, countdown: &mut Countdown| {
            if let Some(time) = countdown.left() {
                *countdown = Countdown::armed(left(timer, time));
            }
        });
    }

    /// How many timers are due.
    pub(crate) fn due_timers(&self) -> usize {
        let mut due = 0;
        visit_countdowns!(self, iter, (), |_, countdown: &Countdown| {
            due += usize::from(countdown.is_due());
        });
        due
    }

    /// True if every armed timer has at most the time it was started with.
    pub(crate) fn timers_within_limits(&self, config: &Config) -> bool {
        let mut within = true;
        visit_countdowns!(self, iter, (), |timer, countdown: &Countdown| {
            let limit = timer_limit(config, timer);
            within &= countdown.is_within(limit);
        });
        within
    }
}

/// The longest time that `timer` can have left.
fn timer_limit(config: &Config, timer: Timer) -> Millis {
    let settings = config.settings();
    match timer {
        Timer::Safety => settings.t_safety,
        Timer::Leave => settings.t_leave,
        Timer::Lease(_) => settings.t_lease,
        Timer::Lost(_) => config.t_lost(),
        // `T_exec` depends on the task; the follower's record is checked against it.
        Timer::Execution(_) => Millis::MAX_TIMER,
        Timer::Acknowledgement(_) => settings.t_ack,
        Timer::Offer(_) => config.t_offer_lease(),
        Timer::Help => settings.t_help,
        Timer::Selection => settings.t_select,
        Timer::Reservation => settings.t_offer,
        Timer::IdentityLock => config.t_lock_session(),
        Timer::Farewell => settings.t_farewell,
        Timer::Ram => settings.ram_period,
    }
}
