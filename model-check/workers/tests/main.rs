//! The tests of the workers, in one program.

mod broken;
mod counts;
mod processes;
