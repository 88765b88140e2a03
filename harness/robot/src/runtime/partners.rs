//! The robots that this one has a session with: their datagrams have places of their own in the inbox.
//!
//! A flood fills the places for everybody. It must not shut out the heartbeats that a maneuver hangs on. An address can
//! be forged, and then a flood fills these places as well: it is not worse off for the robot than without them.

use std::sync::{Mutex, PoisonError};

use crossguard_codec::Identifiers;
use crossguard_codec::geonet::Address;
use crossguard_endpoint::station::listen::link_layer_of;
use crossguard_protocol::{Phase, Robot, StationId};

/// The link-layer addresses of the partners, which the loop writes and the reader reads.
#[derive(Debug, Default)]
pub(super) struct Partners(Mutex<Vec<[u8; 6]>>);

impl Partners {
    /// The robot is in this state now.
    pub(super) fn follow(&self, robot: &Robot, identifiers: &Identifiers) {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.clear();
        let address = |station: StationId| {
            Address::of_station(station.0, identifiers.robot_station_type).link_layer
        };
        match robot.phase() {
            Phase::Idle => {}
            Phase::Requesting(requesting) => {
                known.extend(requesting.offers.iter().map(|offer| address(offer.station)));
            }
            Phase::Offering(offering) => known.push(address(offering.session.leader)),
            Phase::Leading(leading) => {
                let members = leading.members.iter();
                known.extend(members.map(|member| address(member.station)));
            }
            Phase::Following(following) => known.push(address(following.session.leader)),
        }
    }

    /// Whether a packet says that it is from one of them.
    pub(super) fn include(&self, packet: &[u8]) -> bool {
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        !known.is_empty() && known.contains(&link_layer_of(packet))
    }
}
