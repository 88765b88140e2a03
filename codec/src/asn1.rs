//! The rasn types of the ASN.1 modules in `asn1/*.asn`.
//!
//! The modules are the source of truth and part of the product; a robot in C++ can feed them to its
//! own compiler. `generated.rs` follows from them by rasn-compiler and is never edited; a test
//! compares the two. What is generated keeps the names of ASN.1, in Rust's spelling for fields and
//! in its own for types and alternatives, and its serde view has the names of ASN.1 throughout.
//!
//! The types hold any number that fits their Rust type. Whether a value is within its ASN.1 range is
//! checked where it is [encoded](encode) or [decoded](decode), or converted to the type of the
//! [core](crate::core), which is what the endpoint has. RAM, RMCM and the basic container convert
//! both ways.

mod conversion;
#[rustfmt::skip]
#[allow(
    missing_docs,
    rustdoc::all,
    clippy::all,
    clippy::pedantic,
    reason = "generated from the ASN.1 modules, which are documented themselves"
)]
mod generated;
mod view;

pub use crate::uper::{Decoded, decode, encode};
pub use generated::{
    crossguard_cam as cam, crossguard_cdd as cdd, crossguard_cdd211 as cdd211,
    crossguard_common as common, crossguard_cpm as cpm, crossguard_denm as denm,
    crossguard_ram as ram, crossguard_rmcm as rmcm, crossguard_vam as vam,
};
