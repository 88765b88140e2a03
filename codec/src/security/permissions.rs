//! Permissions of certificates: sending messages, and issuing certificates (IEEE 1609.2, clauses 6.4.28
//! to 6.4.40).

/// A permission to send the messages of a service.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Permission {
    /// The service: its ITS-AID, which IEEE 1609.2 calls PSID.
    pub its_aid: u32,
    /// The permissions within the service.
    pub ssp: Ssp,
}

/// Service specific permissions.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Ssp {
    /// None are named: what the service defines as the default.
    Default,
    /// Octets whose meaning the service defines.
    Opaque(Vec<u8>),
    /// Bits, the first octet being the version of their meaning.
    Bitmap(Vec<u8>),
}

/// A permission to issue certificates.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct IssuePermission {
    /// For which services.
    pub subjects: Subjects,
    /// How many certificates there are at least below this one, down to the ticket; 1 by default.
    pub min_chain_length: i8,
    /// How many more there may be, any number if negative; 0 by default.
    pub chain_length_range: i8,
    /// True if it is for tickets that sign messages (`eeType` has `app`).
    pub for_applications: bool,
}

/// The services that an [`IssuePermission`] is for.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Subjects {
    /// All of them.
    All,
    /// These, each with a range.
    These(Vec<(u32, SspRange)>),
}

/// The service specific permissions that may be given.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum SspRange {
    /// All of them.
    All,
    /// These.
    Opaque(Vec<Vec<u8>>),
    /// Permissions that have `value` in all bits that are set in `mask`. Both have the same length.
    Bitmap {
        /// The bits.
        value: Vec<u8>,
        /// Which of them are fixed.
        mask: Vec<u8>,
    },
}

impl Ssp {
    /// The first 16 bits of a bitmap of this version; none, if it is no bitmap or of another version.
    #[must_use]
    pub fn bits(&self, version: u8) -> u16 {
        match self {
            Self::Bitmap(octets) if octets.first() == Some(&version) => {
                let octet = |at: usize| octets.get(at).copied().unwrap_or_default();
                u16::from_be_bytes([octet(1), octet(2)])
            }
            _ => 0,
        }
    }
}

impl SspRange {
    fn allows(&self, ssp: &Ssp) -> bool {
        match (self, ssp) {
            (Self::All, _) => true,
            (Self::Opaque(listed), Ssp::Opaque(octets)) => listed.contains(octets),
            (Self::Bitmap { value, mask }, Ssp::Bitmap(bits)) => {
                bits.len() == mask.len() && agree(bits, value, mask)
            }
            _ => false,
        }
    }

    /// True if all that `other` allows is allowed.
    fn encloses(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::All, _) => true,
            (Self::Opaque(listed), Self::Opaque(narrower)) => {
                narrower.iter().all(|octets| listed.contains(octets))
            }
            (
                Self::Bitmap { value, mask },
                Self::Bitmap {
                    value: narrower,
                    mask: narrower_mask,
                },
            ) => {
                let keeps = |(fixed, also): (&u8, &u8)| fixed & also == *fixed;
                mask.len() == narrower_mask.len()
                    && mask.iter().zip(narrower_mask).all(keeps)
                    && agree(narrower, value, mask)
            }
            _ => false,
        }
    }
}

/// True if two bitmaps are the same in all bits of a mask.
fn agree(bits: &[u8], value: &[u8], mask: &[u8]) -> bool {
    bits.iter()
        .zip(value)
        .zip(mask)
        .all(|((bits, value), mask)| bits & mask == value & mask)
}

impl IssuePermission {
    fn reaches(&self, chain_length: i8) -> bool {
        self.min_chain_length <= chain_length
            && (self.chain_length_range < 0
                || i16::from(chain_length)
                    <= i16::from(self.min_chain_length) + i16::from(self.chain_length_range))
    }

    fn range_of(&self, its_aid: u32) -> Vec<&SspRange> {
        match &self.subjects {
            Subjects::All => vec![&SspRange::All],
            Subjects::These(these) => these
                .iter()
                .filter(|(listed, _)| *listed == its_aid)
                .map(|(_, range)| range)
                .collect(),
        }
    }
}

/// The first ITS-AID of a ticket that its issuer, who has these permissions, may not give.
pub(super) fn not_to_be_given(issuer: &[IssuePermission], ticket: &[Permission]) -> Option<u32> {
    let may = |permission: &Permission| {
        issuer
            .iter()
            .filter(|issue| issue.for_applications && issue.reaches(1))
            .flat_map(|issue| issue.range_of(permission.its_aid))
            .any(|range| range.allows(&permission.ssp))
    };
    ticket
        .iter()
        .find(|permission| !may(permission))
        .map(|permission| permission.its_aid)
}

/// The first ITS-AID for which an authority may issue tickets though its root may not permit it.
/// An authority that may issue for all services needs a root that may.
pub(super) fn not_to_be_delegated(
    root: &[IssuePermission],
    authority: &[IssuePermission],
) -> Option<u32> {
    let delegable = || {
        root.iter()
            .filter(|issue| issue.for_applications && issue.reaches(2))
    };
    authority.iter().find_map(|issue| match &issue.subjects {
        Subjects::All => {
            let may = delegable().any(|issue| issue.subjects == Subjects::All);
            (!may).then_some(0)
        }
        Subjects::These(these) => {
            let may = |its_aid: u32, range: &SspRange| {
                delegable()
                    .flat_map(|issue| issue.range_of(its_aid))
                    .any(|wider| wider.encloses(range))
            };
            these
                .iter()
                .find(|(its_aid, range)| !may(*its_aid, range))
                .map(|(its_aid, _)| *its_aid)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bits(octets: &[u8]) -> Ssp {
        Ssp::Bitmap(octets.to_vec())
    }

    fn range(value: &[u8], mask: &[u8]) -> SspRange {
        SspRange::Bitmap {
            value: value.to_vec(),
            mask: mask.to_vec(),
        }
    }

    fn issue(range: SspRange, min_chain_length: i8) -> IssuePermission {
        IssuePermission {
            subjects: Subjects::These(vec![(36, range)]),
            min_chain_length,
            chain_length_range: 0,
            for_applications: true,
        }
    }

    fn given(ssp: Ssp) -> Vec<Permission> {
        vec![Permission { its_aid: 36, ssp }]
    }

    #[test]
    fn fixed_bits_are_fixed_and_others_are_free() {
        let issuer = [issue(range(&[1, 0xff, 0xfc], &[0xff, 0, 3]), 1)];
        for ssp in [&[1, 0, 0][..], &[1, 0xff, 0xfc], &[1, 0x55, 0xa8]] {
            assert_eq!(not_to_be_given(&issuer, &given(bits(ssp))), None);
        }
        for ssp in [&[2, 0, 0][..], &[1, 0, 1], &[1, 0], &[1, 0, 0, 0]] {
            assert_eq!(not_to_be_given(&issuer, &given(bits(ssp))), Some(36));
        }
        assert_eq!(not_to_be_given(&issuer, &given(Ssp::Default)), Some(36));
    }

    #[test]
    fn a_root_that_delegates_issues_no_tickets() {
        let root = [issue(SspRange::All, 2)];
        let authority = [issue(SspRange::All, 1)];
        assert_eq!(not_to_be_given(&root, &given(Ssp::Default)), Some(36));
        assert_eq!(not_to_be_given(&authority, &given(Ssp::Default)), None);
        assert_eq!(not_to_be_delegated(&root, &authority), None);
        assert_eq!(not_to_be_delegated(&authority, &authority), Some(36));
    }

    #[test]
    fn nobody_delegates_more_than_it_has() {
        let root = [issue(range(&[1, 0], &[0xff, 0x0f]), 2)];
        for (narrower, may) in [
            (range(&[1, 0], &[0xff, 0x0f]), true),
            (range(&[1, 0xf0], &[0xff, 0xff]), true),
            (range(&[1, 0], &[0xff, 0]), false),
            (range(&[1, 1], &[0xff, 0x0f]), false),
            (SspRange::All, false),
        ] {
            let authority = [issue(narrower, 1)];
            assert_eq!(not_to_be_delegated(&root, &authority).is_none(), may);
        }
        let all = IssuePermission {
            subjects: Subjects::All,
            ..issue(SspRange::All, 1)
        };
        assert_eq!(not_to_be_delegated(&root, &[all]), Some(0));
    }

    #[test]
    fn bits_count_only_in_their_version() {
        assert_eq!(bits(&[1, 0xc0]).bits(1), 0xc000);
        assert_eq!(bits(&[1, 0xc0, 0x01, 0xff]).bits(1), 0xc001);
        assert_eq!(bits(&[2, 0xc0]).bits(1), 0);
        assert_eq!(bits(&[]).bits(1), 0);
        assert_eq!(Ssp::Default.bits(1), 0);
        assert_eq!(Ssp::Opaque(vec![1, 0xff]).bits(1), 0);
    }
}
