//! The part that a message takes in a session, and the permission that it needs.
//!
//! No standard has service specific permissions for RAM and RMCM. Those of the kit are a bitmap of two
//! octets: the version of the bitmap, 1, and bits for the parts in the order of [`Part`]. A ticket
//! without the bit of a part says nothing in that part, whatever ITS-AID it is for.
//!
//! A longer bitmap names a station: its third octet is 0, and the station id follows, with its most significant octet
//! first. The holder goes by this id and by no other. Without one it goes by the first four octets of its `HashedId8`, or
//! of that of its mirror with n - s for s, whichever s is lower.

use crossguard_protocol::{Coordination, Farewell, Ram, Rmcm, StationId};

use crate::named;

/// Version of the bitmap of service specific permissions.
pub const SSP_VERSION: u8 = 1;

named! {
    /// A part in a session that needs a permission.
    #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
    pub enum Part {
        /// Asks for help, leads, commands: the first bit.
        Lead = "lead",
        /// Offers help, follows, answers: the second bit.
        Help = "help",
    }
}

impl Part {
    /// Its bit, 0 being the first after the version.
    #[must_use]
    pub const fn bit(self) -> u32 {
        self as u32
    }

    /// The bitmap that permits these parts.
    #[must_use]
    pub fn bitmap(parts: &[Self]) -> [u8; 2] {
        let bits = parts.iter().fold(0, |bits, part| bits | 0x80 >> part.bit());
        [SSP_VERSION, bits]
    }

    /// The bitmap that permits these parts to the station with this id alone.
    #[must_use]
    pub fn bitmap_naming(parts: &[Self], station: StationId) -> [u8; 7] {
        let [version, bits] = Self::bitmap(parts);
        let [a, b, c, d] = station.0.to_be_bytes();
        [version, bits, 0, a, b, c, d]
    }

    /// The station id that a bitmap names, if it names one.
    #[must_use]
    pub const fn named_in(bitmap: &[u8]) -> Option<StationId> {
        match bitmap {
            [SSP_VERSION, _, 0, a, b, c, d] => {
                Some(StationId(u32::from_be_bytes([*a, *b, *c, *d])))
            }
            _ => None,
        }
    }

    /// The parts that a RAM takes: that of its role, and that of a session which it names as over.
    pub fn of_ram(ram: &Ram) -> impl Iterator<Item = Self> {
        let role = match ram.coordination {
            Coordination::None => None,
            Coordination::NeedHelp { .. } | Coordination::Leader { .. } => Some(Self::Lead),
            Coordination::OfferHelp { .. } | Coordination::Follower { .. } => Some(Self::Help),
        };
        let farewell = ram.farewell.map(|farewell| match farewell {
            Farewell::Ended(..) => Self::Lead,
            Farewell::Left(..) => Self::Help,
        });
        role.into_iter().chain(farewell)
    }

    /// The part that an RMCM takes.
    #[must_use]
    pub const fn of_rmcm(rmcm: &Rmcm) -> Self {
        match rmcm {
            Rmcm::Command(_) => Self::Lead,
            Rmcm::Answer(_) => Self::Help,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_part_has_its_bit() {
        assert_eq!(Part::bitmap(&[]), [1, 0]);
        assert_eq!(Part::bitmap(&[Part::Lead]), [1, 0x80]);
        assert_eq!(Part::bitmap(&[Part::Help]), [1, 0x40]);
        assert_eq!(Part::bitmap(&[Part::Help, Part::Lead]), [1, 0xc0]);
    }

    #[test]
    fn a_bitmap_names_a_station_or_none() {
        let naming = Part::bitmap_naming(&[Part::Help], StationId(0x0102_0304));
        assert_eq!(naming, [1, 0x40, 0, 1, 2, 3, 4]);
        assert_eq!(Part::named_in(&naming), Some(StationId(0x0102_0304)));
        for other in [
            &[1, 0x40][..],
            &[1, 0x40, 0, 1, 2, 3],
            &[1, 0x40, 1, 1, 2, 3, 4],
            &[1, 0x40, 3, 1, 2, 3, 4],
            &[2, 0x40, 0, 1, 2, 3, 4],
            &[1, 0x40, 0, 1, 2, 3, 4, 5],
        ] {
            assert_eq!(Part::named_in(other), None);
        }
    }
}
