//! What `rmw_zenoh` attaches to every publication, request and response: number, time and sender.
//!
//! ```text
//!  0        8        16  17               33
//!  ├────────┼────────┼───┼────────────────┤
//!  │ number │ time   │16 │ gid            │   i64, i64 in ns since 1970, length, octets; little endian
//!  └────────┴────────┴───┴────────────────┘
//! ```
//!
//! That is how Kilted and Rolling have it, and Jazzy from `rmw_zenoh_cpp` 0.2.4 on. Jazzy up to 0.2.3 had a
//! name before each of the three, which is neither written nor read here.

/// The octets by which a publisher or client is known: see [`Entity::gid`](crate::entity::Entity::gid).
pub type Gid = [u8; 16];

/// How long an attachment is.
const LENGTH: usize = 33;

/// What is attached to a message.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Attachment {
    /// The number of the message, from 1 on.
    pub sequence: i64,
    /// When it was sent, in nanoseconds since 1970 (UTC).
    pub sent_ns: i64,
    /// Who sent it; in a response, who had asked.
    pub gid: Gid,
}

/// Octets that are no attachment of the form that is understood.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error(
    "an attachment of {0} octets is not of the form of rmw_zenoh in Kilted, Rolling, and Jazzy from \
     0.2.4 on, which has 33"
)]
pub struct NoAttachment(pub(crate) usize);

impl Attachment {
    /// Its octets.
    #[must_use]
    pub fn to_octets(self) -> Vec<u8> {
        let mut octets = Vec::with_capacity(LENGTH);
        octets.extend(self.sequence.to_le_bytes());
        octets.extend(self.sent_ns.to_le_bytes());
        octets.push(16);
        octets.extend(self.gid);
        octets
    }

    /// The attachment that octets are.
    ///
    /// # Errors
    /// When they are none.
    pub fn read(octets: &[u8]) -> Result<Self, NoAttachment> {
        let wrong = || NoAttachment(octets.len());
        let octets: &[u8; LENGTH] = octets.try_into().map_err(|_| wrong())?;
        let part = |from: usize| {
            let mut part = [0; 8];
            part.copy_from_slice(&octets[from..from + 8]);
            i64::from_le_bytes(part)
        };
        let mut gid = [0; 16];
        gid.copy_from_slice(&octets[17..]);
        if octets[16] != 16 {
            return Err(wrong());
        }
        Ok(Self {
            sequence: part(0),
            sent_ns: part(8),
            gid,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_attachment_is_read_as_it_was_written() {
        let attachment = Attachment {
            sequence: 0x0102,
            sent_ns: -1,
            gid: std::array::from_fn(|i| u8::try_from(i).unwrap()),
        };
        let octets = attachment.to_octets();
        assert_eq!(octets[..8], [2, 1, 0, 0, 0, 0, 0, 0]);
        assert_eq!(octets[8..17], [255, 255, 255, 255, 255, 255, 255, 255, 16]);
        assert_eq!(Attachment::read(&octets), Ok(attachment));
    }

    #[test]
    fn other_forms_are_refused() {
        // Jazzy up to 0.2.3: 77 octets with names.
        assert_eq!(Attachment::read(&[0; 77]), Err(NoAttachment(77)));
        assert_eq!(Attachment::read(&[0; 33]), Err(NoAttachment(33)));
    }
}
