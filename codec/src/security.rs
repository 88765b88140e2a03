//! Secured messages: the envelope of TS 103 097 v2.1.1, which is a profile of IEEE 1609.2.
//!
//! ```text
//!  payload ──► Station::seal ──► envelope ─ ─ ─ ► SignedMessage::decode ──► Station::verify ──► Verified
//!              ticket, key                        bounded, no recursion     │ time, profile
//!                                                                           │ ticket ◄ authority ◄ root
//!                                                                           │ region, permission
//!                                                                           │ replay, signatures
//!                                                                           └──► Rejected, by cause
//! ```
//!
//! - [`Station`] has the pseudonyms of one station and what it knows of others. It signs with the
//!   digest of its certificate, and with the whole of it once per second and whenever somebody may not
//!   know it (clause 7.1.1).
//! - [`SignedMessage`] reads envelopes, [`Verifier`] decides whether one can be relied on, and
//!   [`Rejected`] names each cause.
//! - A private key is behind the trait [`SigningKey`]: in memory ([`PrivateKey`], wiped when it is dropped), or in a
//!   token that signs.
//! - A [`TrustStore`] has the certificates that are revoked as well. What is signed with one of them, or below it,
//!   is rejected, also where it was known before.
//! - [`issue`] makes the certificates of roots, authorities and pseudonyms, for a test PKI.
//!
//! Nothing here reads a clock: time is an input. Octets of strangers are read by a reader of this
//! crate, not by rasn's, which reserves memory for as many elements as the octets announce; the tests
//! hold the two against each other. The crate `p256` signs, and the same message and key give the same
//! signature (RFC 6979); the crate `ring` verifies.
//!
//! Not here: enrolment and authorization requests, trust lists and revocation lists of TS 102 941,
//! encryption, other curves than NIST P-256, implicit certificates, polygons and countries as
//! regions. What needs one of them is rejected: `codec/doc/departures.md` has each choice of the standards.

mod cache;
mod certificate;
mod coer;
mod crypto;
mod doubt;
mod envelope;
mod hashed_id;
#[cfg(feature = "issue")]
pub mod issue;
mod permissions;
mod region;
mod rejected;
mod signer;
mod station;
mod thrift;
mod time;
mod trust;
mod trusted_time;
mod verifier;

pub use cache::{MESSAGES_MAX, TICKETS_MAX};
pub use certificate::{CERTIFICATE_LEN_MAX, Certificate, Content, Issuer};
pub use crypto::{NoKey, PrivateKey, PublicKey, Signature, keyed_digest, random_octets};
pub use doubt::Doubt;
pub use envelope::{Header, SignedMessage, SignerIdentifier};
pub use hashed_id::{HashedId3, HashedId8, NoHashedId8};
pub use permissions::{IssuePermission, Permission, Ssp, SspRange, Subjects};
pub use region::{Place, Region};
pub use rejected::{Malformed, Rejected};
pub use signer::{KeyFailure, SigningKey, Ticket, Unsigned};
pub use station::Station;
pub use thrift::REFUSED_MAX;
pub use time::{Duration, Time64, Unit, Validity};
pub use trust::{AUTHORITIES_MAX, ROOTS_MAX, TrustStore, Untrusted};
pub use trusted_time::TrustedTime;
pub use verifier::{AUTHORITIES_PER_S, Origin, Tolerances, Verified, Verifier};
