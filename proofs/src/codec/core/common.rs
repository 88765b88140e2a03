//! Containers that RAM and RMCM share.

use crossguard_codec::core::common::{CoordinationSession, TaskProgression};

use super::containers;

containers! {
    comes_back {
        session_comes_back(CoordinationSession, 2, |value| value.session_number.0 > 1);
        task_progression_comes_back(TaskProgression, 2, |value| *value == TaskProgression::SafeIdle);
    }
    is_canonical {
        session_is_canonical(CoordinationSession, 10);
        task_progression_is_canonical(TaskProgression, 3);
    }
    cut_short_is_refused {
        session_cut_short_is_refused(CoordinationSession, 2);
    }
}
