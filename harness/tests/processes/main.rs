//! Robots in processes of their own, in real time. They wait more than they compute: as one program, their tests run side
//! by side.

mod body_port;
mod conform;
mod embedded;
mod operator_port;
#[path = "../robots/street.rs"]
#[expect(
    dead_code,
    reason = "the other program of robots in processes uses the rest"
)]
mod street;
