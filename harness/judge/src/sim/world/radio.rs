//! The radio between robots, and who records packets and sends them once more.

use std::rc::Rc;
use std::time::Duration;

use crossguard_endpoint::Stimulus;
use crossguard_endpoint::cause::Cause;
use crossguard_robot::trace::Entry;
use crossguard_robot::transport::Fate;
use rand::Rng;

use super::{EPOCH_UNIX_MS, Finding, Next, World};
use crate::sim::swarm::Replay;

/// A packet that arrives.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Arrival {
    pub(super) to: usize,
    pub(super) from: usize,
    /// When it arrives; it may wait until its endpoint is told.
    pub(super) arrived_us: u64,
    /// When a RAM was sent that is no repetition of an old one.
    pub(super) ram_sent_us: Option<u64>,
    pub(super) packet: Rc<[u8]>,
}

impl World<'_> {
    /// A packet has arrived; it waits if the robot hangs.
    pub(super) fn arrive(&mut self, arrival: Arrival) -> Result<(), Finding> {
        let seat = &mut self.seats[arrival.to];
        if seat.hangs_until_us.is_some() {
            seat.inbox.push(Next::Arrives(arrival));
            return Ok(());
        }
        self.receive(&arrival)
    }

    /// A robot is told of a packet.
    pub(super) fn receive(&mut self, arrival: &Arrival) -> Result<(), Finding> {
        let Arrival { to, from, .. } = *arrival;
        let arrived_ms = self.seats[to].clock.shows_us(arrival.arrived_us) / 1_000;
        self.has_heard_ram = false;
        let packet = &*arrival.packet;
        self.handle(to, Stimulus::Datagram { packet, arrived_ms })?;
        if let Some(sent_us) = arrival.ram_sent_us {
            if self.has_heard_ram {
                self.road.hear(self.now_us, to, from, sent_us);
            } else {
                self.road.lose(from, to);
            }
        }
        Ok(())
    }

    /// Packets of earlier arrive once more, at everybody.
    pub(super) fn replay(&mut self, replay: Replay) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "there are thousands of packets"
        )]
        let begins = (self.aired.len() as f64 * replay.begins) as usize;
        let aired = self.aired.iter().skip(begins).take(replay.packets);
        let aired: Vec<_> = aired.cloned().collect();
        let mut at_us = self.now_us;
        for (from, packet) in aired {
            at_us += replay.every_us;
            if at_us >= self.swarm.heals_us {
                return;
            }
            for to in 0..self.seats.len() {
                self.arrives_at(at_us, to, from, &packet);
            }
        }
    }

    /// A packet that is no RAM of this moment arrives then.
    pub(super) fn arrives_at(
        &mut self,
        arrived_us: u64,
        to: usize,
        from: usize,
        packet: &Rc<[u8]>,
    ) {
        let arrival = Arrival {
            to,
            from,
            arrived_us,
            ram_sent_us: None,
            packet: Rc::clone(packet),
        };
        self.at(arrived_us, Next::Arrives(arrival));
    }

    /// A packet is sent.
    pub(super) fn is_on_air(&mut self, packet: &[u8]) {
        self.packets += 1;
        if let Some(watch) = &mut self.watch {
            let epoch = Duration::from_millis(EPOCH_UNIX_MS.unsigned_abs());
            watch.packet(epoch + Duration::from_micros(self.now_us), packet);
        }
    }

    /// For how long a packet waits in a robot whose endpoint is late.
    fn waits_us(&mut self, to: usize) -> u64 {
        if self.swarm.is_in_time() {
            return 0;
        }
        let late_max_us = self.late_max_us(to);
        self.draws.random_range(0..=late_max_us)
    }

    pub(super) fn transmit(&mut self, from: usize, packet: &Rc<[u8]>, is_ram: bool) {
        self.is_on_air(packet);
        self.is_told(packet);
        if !self.is_healed && !self.swarm.replays.is_empty() {
            self.aired.push((from, Rc::clone(packet)));
        }
        for to in (0..self.seats.len()).filter(|&to| to != from) {
            match self.ways[from * self.seats.len() + to].fate(self.now_us) {
                Fate::Lost(how) => {
                    self.road.lose(from, to);
                    if self.seats[to].machine.is_some() && self.watch.is_some() {
                        let entry = Entry::Dropped {
                            cause: Cause::Simulated(how).into(),
                            detail: "by the simulator".to_owned(),
                            octets: packet.to_vec(),
                        };
                        self.record(to, entry);
                    }
                }
                Fate::Arrives {
                    after_us,
                    again_after_us,
                } => {
                    for after_us in [Some(after_us), again_after_us].into_iter().flatten() {
                        let arrived_us = self.now_us + after_us;
                        let arrival = Arrival {
                            to,
                            from,
                            arrived_us,
                            ram_sent_us: is_ram.then_some(self.now_us),
                            packet: Rc::clone(packet),
                        };
                        let waits_us = self.waits_us(to);
                        self.at(arrived_us + waits_us, Next::Arrives(arrival));
                    }
                }
            }
        }
    }
}
