//! Robots in processes of their own, in real time. They wait more than they compute: as one program, their tests run side
//! by side.

mod attached;
mod clock_step;
mod corner;
mod links;
mod lost;
mod net;
mod others;
mod person_at_the_kerb;
mod stalled_output;
mod street;
mod typed;
