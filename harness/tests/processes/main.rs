//! Robots in processes of their own, in real time. They wait more than they compute: as one program, their tests run side
//! by side.

mod ages;
mod attached;
mod body_port;
mod clock_step;
mod conform;
mod corridor_before_the_blocker_is_in_place;
mod duty_outlives_its_session;
mod embedded;
mod embedded_rust;
mod interface_gone;
mod killed;
mod leader_that_hangs;
mod map_and_signals;
mod person_at_the_kerb;
mod stalled_output;
mod two_hosts;
mod two_radios;
mod unit_process;
