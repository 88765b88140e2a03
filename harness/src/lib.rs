//! Endpoints, transports and the crossing of Crossguard.
#![allow(missing_docs)]
pub mod application;
pub mod body;
pub mod boot;
pub mod chart;
pub mod counters;
pub mod demo;
pub mod endpoint;
pub mod generation;
pub mod operator;
pub mod robot_file;
pub mod runtime;
pub mod site;
pub mod timing;
pub mod trace;
pub mod transport;
pub mod wire;
