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
//! - [`issue`] makes the certificates of roots, authorities and pseudonyms, for a test PKI.
//!
//! Nothing here reads a clock: time is an input. Octets of strangers are read by a reader of this
//! crate, not by rasn's, which reserves memory for as many elements as the octets announce; the tests
//! hold the two against each other. Signatures are by the crate `p256`, and the same message and key
//! give the same signature (RFC 6979).
//!
//! What is not here: enrolment and authorization requests (TS 102 941), trust lists and revocation
//! lists, encryption, other curves than NIST P-256, implicit certificates, polygons and countries as
//! regions, and certificates or signatures in another form than the canonical one. What needs one of
//! them is rejected. Keys lie in memory and in files, not in a hardware security module.

mod cache;
mod certificate;
mod coer;
mod crypto;
mod envelope;
mod hashed_id;
pub mod issue;
mod permissions;
mod region;
mod rejected;
mod signer;
mod station;
mod time;
mod trust;
mod verifier;

pub use cache::{MESSAGES_MAX, TICKETS_MAX};
pub use certificate::{CERTIFICATE_LEN_MAX, Certificate, Content, Issuer};
pub use crypto::{NoKey, PrivateKey, PublicKey, Signature};
pub use envelope::{Header, SignedMessage, SignerIdentifier};
pub use hashed_id::{HashedId3, HashedId8};
pub use permissions::{IssuePermission, Permission, Ssp, SspRange, Subjects};
pub use region::{Place, Region};
pub use rejected::{Malformed, Rejected};
pub use signer::{Ticket, Unsigned};
pub use station::Station;
pub use time::{Duration, Time64, Unit, Validity};
pub use trust::{AUTHORITIES_MAX, ROOTS_MAX, TrustStore, Untrusted};
pub use verifier::{Tolerances, Verified, Verifier};
