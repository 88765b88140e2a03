//! The tests of the endpoint, in one program: what they share is compiled and linked once.

mod ages;
mod another_leader;
mod cam;
mod clock_that_goes_back;
mod groups;
mod made_up_sessions;
mod other_crossing;
mod partial_offer;
mod receive_path;
mod same_request;
mod state_after_the_step;
mod support;
mod vehicle;
mod way_of_a_ram;
