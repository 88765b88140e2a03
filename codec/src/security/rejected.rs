//! Why a secured packet is not relied on.

use super::doubt::Doubt;
use super::hashed_id::HashedId8;

/// Octets that are not the canonical encoding of an envelope or certificate, and in or behind which field.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Malformed {
    /// They end too early.
    #[error("{0}: the octets end in it")]
    Truncated(&'static str),
    /// An octet has a value that it cannot have.
    #[error("{field}: 0x{found:02x} is not possible")]
    Value {
        /// In which field.
        field: &'static str,
        /// The octet.
        found: u8,
    },
    /// A value is not in its shortest form.
    #[error("{0}: not in its canonical form")]
    NotCanonical(&'static str),
    /// A default that is spelled out.
    #[error("{0}: the default is spelled out, which it must not be in canonical form")]
    ExplicitDefault(&'static str),
    /// There is more of something than the kit takes.
    #[error("{0}: more than is taken")]
    TooMany(&'static str),
    /// Something follows that is not announced.
    #[error("{0}: octets follow it")]
    Trailing(&'static str),
    /// A point that is not on the curve, or a signature out of range.
    #[error("{0}: not a point on the curve")]
    NotOnCurve(&'static str),
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
    /// The header names a protocol other than that of the message (`pduFunctionalType`).
    #[error("pduFunctionalType: the header is that of another protocol")]
    OtherProtocol,
    /// A RAM or RMCM with an `expiryTime`: their profile is that of CAM.
    #[error("expiryTime: not allowed in RAM and RMCM")]
    ExpiryNotAllowed,
    /// A RAM or RMCM with a `generationLocation`: their profile is that of CAM.
    #[error("generationLocation: not allowed in RAM and RMCM")]
    LocationNotAllowed,
    /// The `expiryTime` is not after the `generationTime`.
    #[error("expiryTime: not after generationTime")]
    ExpiresBeforeGenerated,
    /// A latitude or longitude that is none.
    #[error("{0}: not a place on earth")]
    NotOnEarth(&'static str),
    /// A certificate has extensions, which nobody here knows and which may restrict it.
    #[error("the certificate has extensions that are not known here")]
    CertificateExtension,
    /// The position vector of the packet was made at another time than its envelope.
    #[error(
        "the position vector of the packet is of another time than its envelope, by {by_ms} ms"
    )]
    OtherTime {
        /// How much older the position vector is; negative, if it is newer.
        by_ms: i32,
    },
    /// The `generationLocation` is not where the packet says that its source is.
    #[error("generationLocation: {metres} m away from the source of the packet")]
    LocationElsewhere {
        /// How far away, in metres.
        metres: u32,
    },
    /// The source of the packet is farther away than any radio reaches.
    #[error("sent from {metres} m away")]
    TooFar {
        /// How far away, in metres.
        metres: u32,
    },
    /// The own station signed it, under this or an earlier pseudonym.
    #[error("signed with an own ticket")]
    OwnTicket,
    /// The own clock was put back or ahead: what is verified by it may have been heard before.
    #[error("the own clock is {0}, and is not trusted")]
    TimeNotTrusted(Doubt),
    /// Generated before this station started, which may have heard it before.
    #[error("generated before this station started, which may have heard it before")]
    BeforeStart,
    /// Signed with a certificate that is revoked, or below one.
    #[error("certificate {0} is revoked")]
    Revoked(HashedId8),
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
    /// As many stations are heard as can be remembered, and nobody who is heard is forgotten for somebody new.
    #[error("so many stations are heard that no more can be remembered")]
    TooManyStations,
    /// It was received before, or cannot be told from one that was.
    #[error("received before")]
    Replayed,
    /// The same certificate or message was refused before for its signature.
    #[error("refused before, for a wrong signature")]
    RefusedBefore,
    /// More strangers than are listened to in this time: the certificate would have to be verified first.
    #[error("too many certificates are new")]
    TooManyNew,
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
            Self::Malformed(Malformed::ExplicitDefault(_)) => "explicit default",
            Self::Malformed(_) => "malformed envelope",
            Self::NotSigned => "not signed",
            Self::Unsupported(_) => "unsupported",
            Self::AgainstProfile(_) => "against profile",
            Self::OtherProtocol => "functional type of another protocol",
            Self::ExpiryNotAllowed => "expiry not allowed",
            Self::LocationNotAllowed => "generation location not allowed",
            Self::ExpiresBeforeGenerated => "expiry before generation",
            Self::NotOnEarth(_) => "place not on earth",
            Self::CertificateExtension => "certificate extension",
            Self::OtherTime { .. } => "position vector of another time",
            Self::LocationElsewhere { .. } => "generation location elsewhere",
            Self::TooFar { .. } => "too far away",
            Self::OwnTicket => "own ticket",
            Self::TimeNotTrusted(_) => "time not trusted",
            Self::BeforeStart => "before the start",
            Self::Revoked(_) => "revoked",
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
            Self::TooManyStations => "too many stations",
            Self::Replayed => "replayed",
            Self::RefusedBefore => "refused before",
            Self::TooManyNew => "too many new certificates",
            Self::CertificateSignature(_) => "wrong certificate signature",
            Self::Signature => "wrong signature",
        }
    }
}
