//! Harnesses of the laws of `crossguard-codec`.

pub mod core;
pub mod geonet;
pub mod si;
pub mod time;
pub mod view;
