//! What is true on the road, whatever the robots believe: bodies, signs and a pedestrian, and the properties
//! W1 to W4 and W7 of them.
//!
//! Nothing here asks a robot's state what is so. A body observes the outputs of its robot and moves by its
//! own actions; the pedestrian looks at signs and at nothing else. The properties that need time, W5, W6, W8
//! and the milliseconds of W1, are those of [`timed`](crate::timed).

pub(crate) mod w1_guards_in_place;
pub(crate) mod w2_guards_stay;
pub(crate) mod w3_one_sign;
pub(crate) mod w4_nothing_new_on_duty;
pub(crate) mod w7_crossing_gets_done;
mod world;

pub use world::{Body, End, Heard, Pedestrian};
