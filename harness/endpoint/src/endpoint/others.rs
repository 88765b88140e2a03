//! Other stations than robots: what they say goes onto the map, and CAM and cluster VAM go to them.

use crossguard_codec::Service;
use crossguard_codec::geonet::Indication;
use crossguard_protocol::{Robot, StateMachine, StationId};

use super::turn::Turn;
use crate::cause::Cause;
use crate::exchange::{Exchange, Host as _};
use crate::ras::cam::{CamGeneration, cam};
use crate::ras::generation::Trigger;
use crate::ras::surroundings::Awareness;
use crate::ras::vam::vam_of;

#[derive(Clone, Debug, Default)]
pub(super) struct Others {
    cam: Option<CamGeneration>,
}

impl Others {
    pub(super) fn new(awareness: &Awareness) -> Self {
        Self {
            cam: awareness.cam.then(CamGeneration::default),
        }
    }

    pub(super) const fn are_told(&self) -> bool {
        self.cam.is_some()
    }

    #[expect(clippy::unused_self, reason = "its counterpart tells nobody")]
    pub(super) fn tell_of_people<P: StateMachine>(
        &self,
        exchange: &mut Exchange<P>,
        turn: &mut Turn<'_>,
    ) {
        let moment = turn.moment();
        let surroundings = &mut turn.around.surroundings;
        let due = surroundings.due_cluster_vams(moment.now_ms);
        let Some(plane) = surroundings.plane().copied() else {
            return;
        };
        let (ids, station) = (*exchange.identifiers(), exchange.robot().station().0);
        for told in due {
            let (position, time) = (&turn.state().position, moment.timestamp_its);
            match vam_of(&ids, station, position, time, &told, &plane) {
                Ok(vam) => {
                    exchange.transmit(turn, (Service::Vam, Trigger::Interval), &vam);
                }
                Err(error) => turn.not_sent(&error),
            }
        }
    }

    pub(super) fn tell_of_robot<P: StateMachine>(
        &mut self,
        exchange: &mut Exchange<P>,
        turn: &mut Turn<'_>,
        congestion_ms: u64,
    ) {
        let Some(generation) = &mut self.cam else {
            return;
        };
        let moment = turn.moment();
        let due = generation.poll(moment.now_ms, congestion_ms, turn.state());
        let Some((trigger, low_frequency)) = due else {
            return;
        };
        let (ids, station) = (exchange.identifiers(), exchange.robot().station().0);
        let time = moment.timestamp_its;
        match cam(ids, station, turn.state(), time, low_frequency) {
            Ok(octets) => exchange.transmit(turn, (Service::Cam, trigger), &octets),
            Err(error) => turn.not_sent(&error),
        }
    }
}

/// Puts on the map what another station tells to the robot `me`.
pub(super) fn hear(
    turn: &mut Turn<'_>,
    me: &Robot,
    indication: &Indication<'_>,
    packet: &[u8],
    arrived_ms: u64,
) {
    let service = indication.service;
    if service == Service::Denm {
        let why = "an event changes nothing that a robot does";
        return turn.dropped(Cause::NoUse(service), &why, packet);
    }
    let (ego, now_ms) = (turn.ego(), turn.moment().now_ms);
    let neighbours = &mut turn.around.neighbours;
    match neighbours.observe(me.station(), indication, &ego, now_ms) {
        Ok(received) => {
            if !received.is_canonical {
                turn.ignored(Cause::NotCanonical);
            }
            let message = received.message;
            let from = StationId(message.header().station_id.0);
            turn.understood(service, from, indication.message, arrived_ms);
        }
        Err(unobserved) => turn.dropped((&unobserved).into(), &unobserved, packet),
    }
}
