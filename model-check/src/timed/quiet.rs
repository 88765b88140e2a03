//! For how long a follower has heard no news of its leader, on its own clock: judged from what was delivered
//! to it and when, from what its RAM say and from what it puts out, and not from its timers.

use crossguard_protocol::{Coordination, Input, Millis, Notice, Output, Outputs, Ram, Rmcm};

use crate::serial::beat_is_newer;

/// Promise of a follower, and the time for which it has heard nothing.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Quiet {
    /// The `t_safety` in its offer.
    promised: Millis,
    /// Time that its clock has shown since the last news; `None` once it has given its leader up.
    shown: Option<Millis>,
}

/// Effect of a robot's step on its contact to a leader.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum ContactChange {
    NoLeader,
    /// It follows from now on, and its offer had this `t_safety`.
    Joins(Millis),
    News,
    /// Time passes, and it gives its leader up.
    GivesUp,
    /// Time passes, and it follows no longer.
    Leaves,
    Unchanged,
}

impl ContactChange {
    /// Of a step in which a robot that said `before` takes `input`, and says `after` now.
    pub(super) fn of(before: &Ram, input: Input, outputs: &Outputs, after: &Ram) -> Self {
        let Coordination::Follower { last, .. } = after.coordination else {
            let followed = matches!(before.coordination, Coordination::Follower { .. });
            let leaves = followed && matches!(input, Input::Elapsed(_));
            return if leaves { Self::Leaves } else { Self::NoLeader };
        };
        let (session, echo, known) = match before.coordination {
            Coordination::Follower {
                session,
                echo,
                last,
            } => (session, echo, last),
            Coordination::OfferHelp { t_safety, .. } => return Self::Joins(t_safety),
            _ => return Self::Unchanged,
        };
        let is_news = match input {
            Input::Elapsed(_) if gives_up(outputs) => return Self::GivesUp,
            Input::Ram { ram, .. } => matches!(ram.coordination,
                Coordination::Leader { number, heartbeat, .. }
                    if ram.station == session.leader
                        && number == session.number
                        && beat_is_newer(heartbeat, echo)),
            // One that is refused might be heard for the second time, so only one that is accepted counts.
            Input::Rmcm(Rmcm::Command(command)) => {
                let request = |report: crossguard_protocol::Report| report.request;
                command.session == session
                    && last.map(request) == Some(command.request)
                    && known.map(request) != Some(command.request)
            }
            _ => false,
        };
        if is_news { Self::News } else { Self::Unchanged }
    }
}

fn gives_up(outputs: &Outputs) -> bool {
    outputs.iter().any(|output| {
        let lost = matches!(output, Output::Notify(Notice::ContactLost(_)));
        lost || matches!(output, Output::FallBack(..))
    })
}

impl Quiet {
    /// After a step, before which the robot's clock has shown `elapsed` more; whether it has given its leader
    /// up no sooner than it has promised.
    pub(super) fn after(
        before: Option<Self>,
        elapsed: Millis,
        contact: ContactChange,
    ) -> (Option<Self>, bool) {
        let known = before.map(|quiet| Self {
            shown: quiet
                .shown
                .map(|shown| shown.saturating_add(elapsed).min(quiet.promised)),
            ..quiet
        });
        let with = |shown: Option<Millis>| known.map(|quiet| Self { shown, ..quiet });
        match contact {
            ContactChange::NoLeader => (None, true),
            ContactChange::Unchanged => (known, true),
            ContactChange::News => (with(Some(Millis::ZERO)), true),
            ContactChange::Joins(promised) => {
                let shown = Some(Millis::ZERO);
                (Some(Self { promised, shown }), true)
            }
            ContactChange::GivesUp | ContactChange::Leaves => {
                let is_long = |quiet: Self| quiet.shown.is_none_or(|shown| shown >= quiet.promised);
                let after = with(None).filter(|_| contact == ContactChange::GivesUp);
                (after, known.is_none_or(is_long))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_gives_up_before_its_time_since_the_last_news_breaks_its_promise() {
        let (joined, _) = Quiet::after(None, Millis::ZERO, ContactChange::Joins(Millis(100)));
        let step = |before, elapsed, contact| Quiet::after(before, Millis(elapsed), contact);
        let (at_60, _) = step(joined, 60, ContactChange::Unchanged);
        assert!(!step(at_60, 39, ContactChange::GivesUp).1);
        let (given_up, keeps) = step(at_60, 40, ContactChange::GivesUp);
        assert!(keeps);
        // News starts the time anew; without any there is nothing more to give up.
        let (heard, _) = step(at_60, 30, ContactChange::News);
        assert!(!step(heard, 99, ContactChange::GivesUp).1);
        assert!(step(given_up, 10, ContactChange::GivesUp).1);
        assert_eq!(step(heard, 10, ContactChange::NoLeader), (None, true));
        assert_eq!(step(heard, 10, ContactChange::Leaves), (None, false));
        assert_eq!(step(given_up, 10, ContactChange::Leaves), (None, true));
    }
}
