//! The sign of the leader: what the pedestrian sees. Followed from the outputs alone, and from nothing
//! that the protocol state says.

use crossguard_protocol::{Millis, Output};

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Sign {
    Stop,
    /// The pedestrian may cross, for this long on the clock of the leader.
    Go(Millis),
}

impl Sign {
    /// State of the sign after this output; `None` for one that is not for it. No other place knows
    /// which outputs these are.
    pub(super) const fn told(output: &Output) -> Option<Self> {
        match output {
            Output::CorridorOpened(left) | Output::CorridorExtended(left) => Some(Self::Go(*left)),
            Output::CorridorClosed(_) => Some(Self::Stop),
            _ => None,
        }
    }

    /// Time passes on the clock of the leader. A sign whose time is over shows stop by itself, also
    /// while the process of its robot hangs.
    pub(super) fn elapse(&mut self, elapsed: Millis) {
        if let Self::Go(left) = *self {
            *self = match left.saturating_sub(elapsed) {
                Millis::ZERO => Self::Stop,
                left => Self::Go(left),
            };
        }
    }

    pub(super) const fn shows_go(self) -> bool {
        matches!(self, Self::Go(_))
    }
}

#[cfg(test)]
mod tests {
    use crossguard_protocol::CorridorClosure;

    use super::*;

    #[test]
    fn a_sign_ends_by_itself_and_is_extended_from_now() {
        let mut sign = Sign::told(&Output::CorridorOpened(Millis(100))).unwrap();
        sign.elapse(Millis(60));
        assert_eq!(sign, Sign::Go(Millis(40)));
        sign = Sign::told(&Output::CorridorExtended(Millis(90))).unwrap();
        sign.elapse(Millis(60));
        assert!(sign.shows_go());
        sign.elapse(Millis(60));
        assert_eq!(sign, Sign::Stop);
        let closed = Output::CorridorClosed(CorridorClosure::SessionEnded);
        assert_eq!(Sign::told(&closed), Some(Sign::Stop));
        assert_eq!(Sign::told(&Output::SendRam), None);
    }
}
