//! Why a secured packet is not relied on.

use super::hashed_id::HashedId8;

/// Octets that are not the canonical encoding of an envelope or certificate.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Malformed {
    /// They end too early.
    #[error("{field}: the octets end in it")]
    Truncated {
        /// In which field.
        field: &'static str,
    },
    /// An octet has a value that it cannot have.
    #[error("{field}: 0x{found:02x} is not possible")]
    Value {
        /// In which field.
        field: &'static str,
        /// The octet.
        found: u8,
    },
    /// A value is not in its shortest form.
    #[error("{field}: not in its canonical form")]
    NotCanonical {
        /// In which field.
        field: &'static str,
    },
    /// There is more of something than the kit takes.
    #[error("{field}: more than is taken")]
    TooMany {
        /// In which field.
        field: &'static str,
    },
    /// Something follows that is not announced.
    #[error("{field}: octets follow it")]
    Trailing {
        /// Behind which field.
        field: &'static str,
    },
    /// A point that is not on the curve, or a signature out of range.
    #[error("{field}: not a point on the curve")]
    NotOnCurve {
        /// In which field.
        field: &'static str,
    },
}

/// Why a secured packet is rejected. The order is that of the checks.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Rejected {
    /// A packet without an envelope, in enforce mode.
    #[error("the packet is not secured")]
    Unsecured,
    /// The envelope is not the encoding of one.
    #[error("{0}")]
    Malformed(#[from] Malformed),
    /// Not a signature at all, but unsecured or encrypted data, or a certificate request.
    #[error("the content is not signed data")]
    NotSigned,
    /// A choice of IEEE 1609.2 that the kit does not support.
    #[error("{0} is not supported")]
    Unsupported(&'static str),
    /// A header field that the profile of the message does not allow, or misses (TS 103 097,
    /// clauses 5.2 and 7.1).
    #[error("{0}: against the profile of TS 103 097")]
    AgainstProfile(&'static str),
    /// The own station signed it, under this or an earlier pseudonym.
    #[error("signed with an own ticket")]
    OwnTicket,
    /// Generated too long ago.
    #[error("generated {age_us} us ago")]
    TooOld {
        /// How long ago, in microseconds.
        age_us: u64,
    },
    /// Generated in the future.
    #[error("generated {ahead_us} us in the future")]
    FromTheFuture {
        /// How far in the future, in microseconds.
        ahead_us: u64,
    },
    /// The `expiryTime` of the message is over.
    #[error("the message has expired")]
    MessageExpired,
    /// The digest of a certificate that is not known; it has been put among those to ask for.
    #[error("certificate {0} is not known")]
    UnknownSigner(HashedId8),
    /// A certificate that nobody issued who belongs to a trusted root.
    #[error("issuer {0} belongs to no trusted root")]
    ForeignIssuer(HashedId8),
    /// The signer's certificate is one of an authority, or of no kind at all.
    #[error("the certificate is not an authorization ticket")]
    NotATicket,
    /// The signer's certificate or one above it is over.
    #[error("a certificate has expired")]
    CertificateExpired,
    /// The signer's certificate or one above it is not valid yet.
    #[error("a certificate is not valid yet")]
    CertificateNotYetValid,
    /// The validity of a certificate goes beyond that of its issuer.
    #[error("the certificate is valid for longer than its issuer")]
    BeyondIssuer,
    /// The issuer may not issue a certificate with these permissions.
    #[error("the issuer may not give the permission for ITS-AID {0}")]
    IssuerNotPermitted(u32),
    /// The certificate does not permit to send such messages.
    #[error("the certificate does not permit ITS-AID {0}")]
    NotPermitted(u32),
    /// The sender is outside of the region of its certificate, or does not say where it is.
    #[error("the sender is outside of the region of its certificate")]
    OutsideRegion,
    /// It was received before, or cannot be told from one that was.
    #[error("received before")]
    Replayed,
    /// The signature of a certificate is wrong.
    #[error("the signature of certificate {0} is wrong")]
    CertificateSignature(HashedId8),
    /// The signature of the message is wrong.
    #[error("the signature is wrong")]
    Signature,
}

impl Rejected {
    /// The name of the cause, for counters.
    #[must_use]
    pub const fn cause(&self) -> &'static str {
        match self {
            Self::Unsecured => "not secured",
            Self::Malformed(_) => "malformed envelope",
            Self::NotSigned => "not signed",
            Self::Unsupported(_) => "unsupported",
            Self::AgainstProfile(_) => "against profile",
            Self::OwnTicket => "own ticket",
            Self::TooOld { .. } => "too old",
            Self::FromTheFuture { .. } => "from the future",
            Self::MessageExpired => "message expired",
            Self::UnknownSigner(_) => "unknown certificate",
            Self::ForeignIssuer(_) => "foreign root",
            Self::NotATicket => "not a ticket",
            Self::CertificateExpired => "certificate expired",
            Self::CertificateNotYetValid => "certificate not yet valid",
            Self::BeyondIssuer => "validity beyond issuer",
            Self::IssuerNotPermitted(_) => "issuer not permitted",
            Self::NotPermitted(_) => "not permitted",
            Self::OutsideRegion => "outside region",
            Self::Replayed => "replayed",
            Self::CertificateSignature(_) => "wrong certificate signature",
            Self::Signature => "wrong signature",
        }
    }
}
