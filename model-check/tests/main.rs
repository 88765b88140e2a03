//! The tests of the model checker, in one program: what they share is compiled and linked once.

mod channels;
mod confinement;
mod crossing;
mod fair;
mod insiders;
mod odds;
mod page;
mod paper_literal;
mod safety;
mod scenario_files;
mod scenarios;
mod spin;
mod symmetry;
#[path = "theorem/main.rs"]
mod theorem;
mod threads;
mod timed;
mod timed_weakenings;
mod timing;
mod walk;
mod weakenings;
