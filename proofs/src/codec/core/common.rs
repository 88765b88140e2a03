//! What RAM and RMCM share.

use crossguard_codec::core::common::{CoordinationSession, TaskProgression};
use crossguard_codec::core::max_octets;

use super::{cuts, octets, values};
use crate::harness::harnesses;

harnesses! {
    /// All sessions.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn session_comes_back() {
        values::<CoordinationSession, { max_octets::<CoordinationSession>() }>(|value| value.session_number.0 > 1);
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(10)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn session_is_canonical() {
        octets::<CoordinationSession, { max_octets::<CoordinationSession>() }>();
    }

    /// All sessions, and every cut.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn session_cut_short_is_refused() {
        cuts::<CoordinationSession, { max_octets::<CoordinationSession>() }>();
    }

    /// All progressions of a task.
    #[unwind(2)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::never)]
    fn task_progression_comes_back() {
        values::<TaskProgression, { max_octets::<TaskProgression>() }>(|value| *value == TaskProgression::SafeIdle);
    }

    /// Any octets, up to the maximum length, without extension additions.
    #[unwind(3)]
    #[solver(cadical)]
    #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::no_additions)]
    fn task_progression_is_canonical() {
        octets::<TaskProgression, { max_octets::<TaskProgression>() }>();
    }
}
