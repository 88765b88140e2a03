//! What messages of ETSI share with a RAM. Their basic container and motion are made as those of a RAM
//! are, so a robot says the same of itself in each.

use crossguard_codec::asn1::ram::RobotAwareness;
use crossguard_codec::core::ram::RAM;
use crossguard_codec::{
    DecodeError, EncodeError, Identifiers, RobotState, ViewError, asn1, ram_from,
};
use crossguard_protocol::{Availability, Coordination, Ram, StationId};

/// What a RAM of `station` would say of this state, without a part in a session. `now_ms` is the time of
/// its position in `TimestampIts`; `complete` adds containers.
pub(super) fn awareness(
    ids: &Identifiers,
    station: u32,
    state: &RobotState,
    now_ms: u64,
    with_low_frequency: bool,
    complete: impl FnOnce(&mut RAM),
) -> Result<RobotAwareness, NotMade> {
    let view = Ram {
        station: StationId(station),
        coordination: Coordination::None,
        farewell: None,
        on_duty: false,
    };
    let time = crossguard_codec::si::generation_delta_time(now_ms);
    let available = Availability::Available;
    let mut ram = ram_from(ids, state, &view, available, time, with_low_frequency)?;
    complete(&mut ram);
    Ok(asn1::ram::RAM::try_from(&ram)?.ram)
}

/// Why a message cannot be sent.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NotMade {
    /// It contradicts itself.
    #[error(transparent)]
    Contradictory(#[from] ViewError),
    /// The codec's two forms of it differ.
    #[error(transparent)]
    Disagreement(#[from] DecodeError),
    /// It cannot be encoded.
    #[error(transparent)]
    NotEncodable(#[from] EncodeError),
}
