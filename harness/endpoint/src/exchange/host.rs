//! Host interface of an exchange.

use core::fmt::Display;

use crossguard_codec::core::ram::RAM;
use crossguard_codec::geonet::{Address, EgoPosition, Indication, Request, Signer};
use crossguard_codec::{Heard, RobotState, Service, TaskParameters};
use crossguard_protocol::{Input, Output, Outputs, Place, Robot, StationId, TaskSet};

use crate::cause::Cause;
use crate::ras::generation::Trigger;

/// Time of a call, on both clocks of the robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Moment {
    /// Milliseconds since any fixed moment, on a clock that never goes back.
    pub now_ms: u64,
    /// `TimestampIts`: milliseconds since 2004, leap seconds counted.
    pub timestamp_its: u64,
}

impl Moment {
    /// `now_ms` after a clock began that showed `began_its` then.
    #[must_use]
    pub const fn after(began_its: u64, now_ms: u64) -> Self {
        Self {
            now_ms,
            timestamp_its: began_its + now_ms,
        }
    }
}

/// A message in its packet, which lies at the front of [`Host::room`].
#[derive(Clone, Copy, Debug)]
pub struct Outgoing<'a> {
    /// Which message.
    pub service: Service,
    /// Why it is sent.
    pub trigger: Trigger,
    /// The message.
    pub message: &'a [u8],
    /// Its port, traffic class and the like.
    pub request: &'a Request,
    /// Octets of the packet; the message is at its end, if there is no security envelope.
    pub packet_len: usize,
}

/// Host of an exchange. It receives the effects, in order.
pub trait Host {
    /// Current time: one for all that happens in a call.
    fn moment(&self) -> Moment;

    /// State of the robot, as the application reports it. The exchange corrects what the protocol knows better before
    /// it sends.
    fn state(&self) -> &RobotState;

    /// Where the robot is now, for packets.
    fn ego(&self) -> EgoPosition {
        EgoPosition::of(self.state(), self.moment().timestamp_its)
    }

    /// Where the next packet goes: [`PACKET_LEN_MAX`](crossguard_codec::geonet::PACKET_LEN_MAX) octets.
    fn room(&mut self) -> &mut [u8];

    /// Send the packet that is in [`Host::room`] now.
    fn transmit(&mut self, outgoing: Outgoing<'_>);

    /// The transition function took a step, and `after` is the state after it.
    fn stepped(&mut self, input: &Input, outputs: &Outputs, after: &Robot);

    /// The application is to do this, or to know it. `parameters` are those of the command that was the
    /// input of the step. Never [`Output::SendRam`] and [`Output::SendRmcm`].
    fn act(&mut self, output: &Output, parameters: TaskParameters);

    /// A vehicle answers the newest question whether it will stop.
    fn answered(&mut self, _vehicle: StationId, _promises: bool) {}

    /// Whether the crossing at this place, for which a robot that was heard asks for help, or at which it leads, may be that of this
    /// robot. The other robot is around in any case.
    fn is_here(&mut self, _place: Place, _leads: bool, _heard: &Heard) -> bool {
        true
    }

    /// The tasks that every follower is to do, of these, which are not in the offer of a robot that was heard. Its offer does not count
    /// if there are any. It is around in any case.
    fn lacks(&mut self, _unoffered: TaskSet, _heard: &Heard) -> TaskSet {
        TaskSet::EMPTY
    }

    /// The robot `me` understood a message, which arrived then.
    fn heard(&mut self, me: &Robot, heard: &Heard, message: &[u8], arrived_ms: u64);

    /// The certificate of this signer vouches for the robot with this station id, whose packets come from this address.
    fn vouched(&mut self, _from: StationId, _by: (Signer, Address)) {}

    /// A message of another service than those of robots arrived at the robot `me`, in this packet and then.
    fn other(&mut self, me: &Robot, indication: &Indication<'_>, packet: &[u8], arrived_ms: u64);

    /// The host may add what it knows of the people around.
    fn complete(&mut self, _ram: &mut RAM) {}

    /// Something was dropped: a datagram with these octets, or a message that cannot be sent.
    fn dropped(&mut self, cause: Cause, detail: &dyn Display, octets: &[u8]);

    /// An input was ignored, or a message was read that is not encoded canonically.
    fn ignored(&mut self, cause: Cause);
}
