//! Whole messages, and those containers of a RAM that are too large to be proved canonical.
//!
//! Between a container as a message of its own and one inside a message stand two steps: what is read
//! depends on the bits ahead alone ([`what_is_ahead_decides`](super::bits::what_is_ahead_decides)), and
//! a message reads nothing but its containers, one behind the other. The harnesses here prove of the
//! second step that it stays inside the octets, whatever the bits are: in the place of
//! [`Reader::bits`](crossguard_codec::core::Reader::bits) stands any number of this many bits.

use crossguard_codec::core::ram::{
    RobotHighFrequencyContainer, RobotLeaderFollowerOperationContainer, RobotLowFrequencyContainer,
};
use crossguard_codec::core::rmcm::RMCM;
use crossguard_codec::core::vam::{VruClusterInformationContainer, VruMotionPredictionContainer};
use crossguard_codec::core::{Uper, laws, max_octets};

use super::any_octets;
use crate::harness::harnesses;
use crate::kani;

/// Any octets, also a few more than the longest encoding without extension additions has.
fn any_message<T: Uper, const N: usize>() {
    let octets: [u8; N] = any_octets::<T, N>();
    let length = usize::from(kani::any::<u16>()) % (N + 1);
    let is_accepted = laws::decode_stays_inside::<T>(&octets[..length]);
    kani::cover!(is_accepted, "accepted");
    kani::cover!(!is_accepted, "refused");
}

/// Declares a harness for each type.
macro_rules! stays_inside {
    ($($(#[random_only($reason:literal)])? $name:ident($type:ident, $unwind:literal))+) => {
        harnesses! { $(
            #[doc = concat!("Any octets that are to be a `", stringify!($type), "`.")]
            #[unwind($unwind)]
            #[stub(crossguard_codec::core::Reader::bits, crate::codec::core::any_bits)]
            #[stub(crossguard_codec::core::Reader::skip_additions, crate::codec::core::any_skip)]
            $(#[random_only($reason)])?
            fn $name() {
                any_message::<$type, { max_octets::<$type>() + 16 }>();
            }
        )+ }
    };
}

stays_inside! {
    rmcm_stays_inside(RMCM, 18)
    leader_follower_container_stays_inside(RobotLeaderFollowerOperationContainer, 18)
    high_frequency_container_stays_inside(RobotHighFrequencyContainer, 6)
    #[random_only("Kani was stopped unfinished, after five minutes.")]
    low_frequency_container_stays_inside(RobotLowFrequencyContainer, 25)
    cluster_container_stays_inside(VruClusterInformationContainer, 18)
    #[random_only("Not tried to its end.")]
    motion_prediction_container_stays_inside(VruMotionPredictionContainer, 25)
}
