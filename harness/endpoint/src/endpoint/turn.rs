//! One call of an endpoint: what the exchange wants of it, and the effects that it gathers.

use std::fmt::Display;

use crossguard_codec::core::ram::RAM;
use crossguard_codec::geonet::{Address, Indication, PACKET_LEN_MAX, Signer};
use crossguard_codec::{Heard, RobotState, Service, TaskParameters};
use crossguard_protocol::{
    Coordination, Event, Ignored, Input, Output, Outputs, Phase, Place, Robot, StationId, TaskSet,
};

use super::{Around, Effect, Served, others};
use crate::cause::Cause;
use crate::exchange::{Host, Moment, Outgoing};
use crate::ras::clustering::PerceivedVru;
use crate::ras::containers;
use crate::ras::surroundings::Told;

/// Working data of one call of [`Endpoint::handle`](super::Endpoint::handle).
pub(super) struct Turn<'a> {
    pub(super) around: &'a mut Around,
    state: &'a RobotState,
    moment: Moment,
    packet: Vec<u8>,
    effects: Vec<Effect>,
}

impl<'a> Turn<'a> {
    pub(super) const fn new(around: &'a mut Around, state: &'a RobotState, moment: Moment) -> Self {
        Self {
            around,
            state,
            moment,
            packet: Vec::new(),
            effects: Vec::new(),
        }
    }

    pub(super) fn into_effects(self) -> Vec<Effect> {
        self.effects
    }

    pub(super) fn elapse(&mut self) {
        let now_ms = self.moment.now_ms;
        self.around.neighbours.map.forget(now_ms);
        self.around.surroundings.elapse(now_ms);
    }

    pub(super) fn answer(&mut self, event: Event, outputs: &Outputs) {
        if let Some(reason) = outputs.ignored() {
            self.effects.push(Effect::Ignored(event, reason));
        }
    }

    pub(super) fn perceive(&mut self, people: &[PerceivedVru]) {
        let (now_ms, position) = (self.moment.now_ms, &self.state.position);
        let perceived = self.around.surroundings.perceive(now_ms, position, people);
        if let Err(unplaced) = perceived {
            self.dropped(Cause::Unplaced, &unplaced, &[]);
        }
    }

    fn observe(&mut self, heard: &Heard) {
        let (ego, now_ms) = (self.ego(), self.moment.now_ms);
        self.around.neighbours.observe_robot(heard, &ego, now_ms);
    }

    /// A message was understood, from any sender.
    pub(super) fn understood(
        &mut self,
        kind: Service,
        from: StationId,
        message: &[u8],
        arrived_ms: u64,
    ) {
        let now_ms = self.moment.now_ms;
        self.effects.push(Effect::Heard {
            kind,
            from,
            arrived_ms: arrived_ms.min(now_ms),
            told_ms: now_ms,
            octets: message.to_vec(),
        });
    }

    #[cfg(feature = "foreign")]
    pub(super) fn not_sent(&mut self, error: &dyn Display) {
        self.dropped(Cause::NotSent, error, &[]);
    }
}

impl Host for Turn<'_> {
    fn moment(&self) -> Moment {
        self.moment
    }

    fn state(&self) -> &RobotState {
        self.state
    }

    fn room(&mut self) -> &mut [u8] {
        self.packet.clear();
        self.packet.resize(PACKET_LEN_MAX, 0);
        &mut self.packet
    }

    fn transmit(&mut self, outgoing: Outgoing<'_>) {
        self.effects.push(Effect::Transmit {
            kind: outgoing.service,
            trigger: outgoing.trigger,
            octets: outgoing.message.to_vec(),
            packet: self.packet[..outgoing.packet_len].to_vec(),
        });
    }

    fn stepped(&mut self, input: &Input, outputs: &Outputs, after: &Robot) {
        self.effects.push(Effect::Stepped {
            input: *input,
            outputs: Box::new(*outputs),
            state: Box::new(after.clone()),
        });
        if let Input::Ram { ram, .. } = input
            && matches!(ram.coordination, Coordination::Leader { .. })
            && outputs.ignored() == Some(Ignored::LowerPrecedence)
            && self.around.answers.insists(ram.station)
        {
            let detail = format_args!(
                "station {} leads at the same place, and may not hear this robot",
                ram.station
            );
            self.dropped(Cause::NotYielding, &detail, &[]);
        }
    }

    fn act(&mut self, output: &Output, parameters: TaskParameters) {
        if !matches!(output, Output::Ignored(_)) {
            self.effects.push(Effect::Act(*output, parameters));
        }
    }

    fn answered(&mut self, vehicle: StationId, promises: bool) {
        self.effects
            .push(Effect::VehicleAnswered(vehicle, promises));
    }

    fn is_here(&mut self, place: Place, leads: bool, heard: &Heard) -> bool {
        let from = heard.state.as_ref().map(|state| state.position);
        let from = from.unwrap_or_default();
        let is_meant = |served: Served| {
            if leads {
                !served.is_elsewhere(place, &from)
            } else {
                served.is_meant(place, &from)
            }
        };
        let is_here = self.around.served.is_none_or(is_meant);
        if !is_here {
            self.observe(heard);
        }
        is_here
    }

    fn lacks(&mut self, unoffered: TaskSet, heard: &Heard) -> TaskSet {
        let lacking = self.around.needs.intersection(unoffered);
        if !lacking.is_empty() {
            self.observe(heard);
        }
        lacking
    }

    fn heard(&mut self, me: &Robot, heard: &Heard, message: &[u8], arrived_ms: u64) {
        let now_ms = self.moment.now_ms;
        self.understood(heard.service, heard.from, message, arrived_ms);
        for input in heard.inputs.iter() {
            if let Input::Ram { ram, .. } = input {
                self.around.answers.hear(now_ms, ram);
            }
        }
        let Some(state) = &heard.state else { return };
        self.observe(heard);
        let surroundings = &mut self.around.surroundings;
        if let Some(plane) = surroundings.plane() {
            let (cluster, from) = (heard.cluster.as_ref(), heard.from.0);
            if let Some(ended) = cluster.and_then(containers::ended) {
                surroundings.hear_ended(now_ms, from, ended);
                return;
            }
            // Its team goes by what it announces: a leader leaves people to nobody.
            let may_leave = !matches!(me.phase(), Phase::Leading(_));
            let cluster = cluster.filter(|_| may_leave);
            let cluster = cluster.and_then(|it| containers::on_plane(it, &state.position, plane));
            surroundings.hear(now_ms, me.station().0, from, cluster.as_ref());
        }
    }

    fn vouched(&mut self, from: StationId, (signer, address): (Signer, Address)) {
        let namesakes = &mut self.around.neighbours.namesakes;
        namesakes.bind(from, signer, address, self.moment.now_ms);
    }

    fn other(&mut self, me: &Robot, indication: &Indication<'_>, packet: &[u8], arrived_ms: u64) {
        others::hear(self, me, indication, packet, arrived_ms);
    }

    fn complete(&mut self, ram: &mut RAM) {
        let surroundings = &mut self.around.surroundings;
        match (surroundings.next_told(), surroundings.plane()) {
            (Some(Told::Cluster(cluster)), Some(plane)) => {
                containers::write(ram, plane, Some(&cluster));
            }
            (Some(Told::Ended(ended)), _) => containers::write_ended(ram, ended),
            (Some(Told::Cluster(_)) | None, _) => {}
        }
    }

    fn dropped(&mut self, cause: Cause, detail: &dyn Display, octets: &[u8]) {
        self.around.counters.count(cause);
        self.effects.push(Effect::Dropped {
            cause,
            detail: detail.to_string(),
            octets: octets.to_vec(),
        });
    }

    fn ignored(&mut self, cause: Cause) {
        self.around.counters.count(cause);
    }
}
