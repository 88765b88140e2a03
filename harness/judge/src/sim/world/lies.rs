//! The insider among the robots: what it says arrives everywhere.

use std::rc::Rc;

use crossguard_endpoint::station::Security;
use crossguard_protocol::StationId;

use super::{Next, World, timestamp_at};
use crate::sim::insider::Insider;
use crate::sim::security;
use crate::sim::swarm::Swarm;

/// How long a lie is under way at most, in microseconds.
const WAY_US: u64 = 10_000;

/// The insider of a run, if it has one.
pub(super) fn insider(swarm: &Swarm) -> Option<Insider> {
    let draw = swarm.insider.as_ref()?;
    let security = if swarm.is_secured {
        security::of(swarm.robots.len(), draw.station, 0)
    } else {
        Security::default()
    };
    let site = &swarm.robots.first()?.plan.site;
    Some(Insider::new(draw, swarm.seed, site, security))
}

impl World<'_> {
    /// The insider says something, until the network is healed.
    pub(super) fn lie(&mut self) {
        let Some(mut insider) = self.insider.take() else {
            return;
        };
        if !self.is_healed {
            self.say(&mut insider);
            let pause_us = insider.pause_us();
            self.at(self.now_us + pause_us, Next::Lies);
        }
        self.insider = Some(insider);
    }

    fn say(&mut self, insider: &mut Insider) {
        let seat = &self.seats[insider.hearer(self.seats.len())];
        let Some(machine) = &seat.machine else { return };
        let time = timestamp_at(self.now_us / 1_000);
        let (hearer, request) = (machine.endpoint.robot(), seat.draw.plan.request());
        if let Some(packet) = insider.lie(time, hearer, &seat.draw.config, request) {
            self.spread(&packet);
        }
    }

    /// A packet of the insider reaches all robots.
    fn spread(&mut self, packet: &Rc<[u8]>) {
        self.is_on_air(packet);
        for to in 0..self.seats.len() {
            self.arrives_at(self.now_us + WAY_US, to, to, packet);
        }
    }

    /// How many followers of the leader of a session are the insider: 1 or none.
    pub(super) fn liars_among(&self, leader: usize) -> usize {
        let insider = self.insider.as_ref().map(Insider::station);
        let leading = self.monitor.node(leader).leading();
        let is_member = |it| leading.is_some_and(|leading| leading.member(it).is_some());
        usize::from(insider.is_some_and(is_member))
    }

    /// Whether this station is the insider.
    pub(super) fn is_insider(&self, station: StationId) -> bool {
        self.insider.as_ref().map(Insider::station) == Some(station)
    }
}
