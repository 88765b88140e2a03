//! Without the feature `security`, a robot goes by its own name.

use crossguard_protocol::{Event, StateMachine};

use super::turn::Turn;
use crate::exchange::Exchange;

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pseudonyms {}

#[expect(clippy::unused_self, reason = "its counterpart has a state")]
impl Pseudonyms {
    pub(super) const fn renew<P: StateMachine>(self, _: &mut Exchange<P>, _: &mut Turn<'_>) {}

    pub(super) const fn disguise<P: StateMachine>(self, _: &Exchange<P>, event: Event) -> Event {
        event
    }

    pub(super) const fn break_silence(self) {}

    pub(super) const fn is_silent(self, _: u64) -> bool {
        false
    }
}
