//! Parts that messages of ETSI share with a RAM. Their basic container and motion are made as those of a RAM
//! are, so a robot says the same of itself in each.

use crossguard_codec::asn1::cdd::{
    ItsPduHeader, MessageId, OrdinalNumber1B, StationId as WireStationId,
};
use crossguard_codec::asn1::ram::RobotAwareness;
use crossguard_codec::core::ram::RAM;
use crossguard_codec::{
    DecodeError, EncodeError, Identifiers, Pdu, RobotState, ViewError, asn1, ram_from,
};
use crossguard_protocol::{Availability, Coordination, Ram, StationId};

/// RAM of `station` in this state, without a part in a session. `now_ms` is the time of
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

/// The header of a message of this kind from `station`.
pub(super) fn header<P: Pdu>(ids: &Identifiers, station: u32) -> ItsPduHeader {
    let (protocol_version, message_id) = P::expected_header(ids);
    ItsPduHeader::new(
        OrdinalNumber1B(protocol_version),
        MessageId(message_id),
        WireStationId(station),
    )
}

/// The position of the golden vectors of CAM and VAM (`codec/tests/golden`).
#[cfg(test)]
pub(super) fn golden_position() -> crossguard_codec::Position {
    crossguard_codec::Position {
        altitude: Some(260.0),
        altitude_confidence: Some(1.0),
        ellipse: Some(crossguard_codec::ConfidenceEllipse {
            semi_major: 1.0,
            semi_minor: 0.5,
            orientation: 90.0,
        }),
        ..crossguard_codec::Position::at(48.765_432_1, 9.123_456_7)
    }
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
