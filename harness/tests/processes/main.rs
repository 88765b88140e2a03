//! Robots in processes of their own, in real time. They wait more than they compute: as one program, their tests run side
//! by side.

mod body_port;
mod conform;
mod embedded;
mod operator_port;
