//! The tests of the codec, in one program: rasn's generic code is compiled once for all of them.

mod allocations;
mod broken_vectors;
mod differential;
mod extensions;
mod foreign;
mod generated;
mod geonet;
mod golden_its;
mod golden_messages;
mod heard;
mod json;
mod judges;
mod release1;
#[cfg(feature = "issue")]
mod security;
mod si;
mod size;
mod stack;
mod state;
mod strictness;
mod support;
mod view;
mod view_laws;
