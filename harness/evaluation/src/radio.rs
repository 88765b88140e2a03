//! The radio channel: which station senses which, how long the channel is busy, and who has to wait.
//!
//! IEEE 802.11p in 10 MHz outside of a cell: path loss by distance, carrier sense at a threshold,
//! enhanced distributed channel access (EDCA) with one queue per station, broadcast without
//! acknowledgement. Times are microseconds. Not here: fading, buildings, hidden stations' own
//! retransmissions (broadcast has none), and capture of a stronger frame that comes later.

use rand::Rng;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::messages::DATA_RATE_MBPS;

/// One slot, in microseconds.
const SLOT_US: u64 = 13;
/// SIFS, in microseconds.
const SIFS_US: u64 = 32;
/// Window over which the channel busy ratio is taken, in microseconds.
pub const WINDOW_US: u64 = 100_000;

/// Properties of the channel. The paper states the power, 200 mW, and the frequency, 5.9 GHz.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Radio {
    /// Transmission power with antenna gains, in dBm.
    pub power_dbm: f64,
    /// Data rate, in Mbit/s; one of [`DATA_RATES_MBPS`](super::messages::DATA_RATES_MBPS).
    pub data_rate_mbps: f64,
    /// Path loss at 1 m, in dB: free space at 5.9 GHz.
    pub loss_at_1_m_db: f64,
    /// Path loss exponent.
    pub exponent: f64,
    /// Least received power that a station senses as a busy channel, in dBm.
    pub sense_dbm: f64,
    /// Noise with the receiver's noise figure, in dBm.
    pub noise_dbm: f64,
    /// Least ratio of signal to interference and noise at which a frame is received, in dB.
    pub sinr_min_db: f64,
    /// Arbitration interframe space number; 6 for best effort, in which CAM and VAM go.
    pub aifsn: u32,
    /// Contention window; 15 for best effort.
    pub contention_window: u32,
    /// Without contention and collisions: frames never overlap, and all are received.
    pub ideal: bool,
}

impl Default for Radio {
    fn default() -> Self {
        Self {
            power_dbm: 23.0,
            data_rate_mbps: DATA_RATE_MBPS,
            loss_at_1_m_db: 47.86,
            exponent: 2.2,
            sense_dbm: -85.0,
            noise_dbm: -95.0,
            sinr_min_db: 6.5,
            aifsn: 6,
            contention_window: 15,
            ideal: false,
        }
    }
}

impl Radio {
    /// How far away a transmission is sensed, in metres.
    #[must_use]
    pub fn range_m(&self) -> f64 {
        let loss_db = self.power_dbm - self.sense_dbm - self.loss_at_1_m_db;
        10_f64.powf(loss_db / (10.0 * self.exponent))
    }

    /// Power that is received over a distance, in milliwatts.
    fn received_mw(&self, distance2_m2: f64) -> f64 {
        let loss_db = self.loss_at_1_m_db + 5.0 * self.exponent * distance2_m2.max(1.0).log10();
        10_f64.powf((self.power_dbm - loss_db) / 10.0)
    }

    fn aifs_us(&self) -> u64 {
        SIFS_US + u64::from(self.aifsn) * SLOT_US
    }
}

/// A transmission.
#[derive(Clone, Debug)]
pub struct Transmission {
    /// Station that sends it.
    pub sender: usize,
    /// When it began.
    pub start_us: u64,
    /// When it ends.
    pub end_us: u64,
    /// Stations whose transmissions overlapped with it.
    overlapping: Vec<usize>,
}

/// Air time and access of all stations.
#[derive(Debug)]
pub struct Channel {
    radio: Radio,
    range2_m2: f32,
    east_m: Vec<f32>,
    north_m: Vec<f32>,
    busy_until_us: Vec<u64>,
    /// Busy time in this window and, from frames that last into it, in the next.
    busy_us: [Vec<u32>; 2],
    window_end_us: u64,
    access: Vec<Option<Access>>,
    active: Vec<Transmission>,
    contending: Vec<usize>,
}

#[derive(Clone, Copy, Debug)]
struct Access {
    /// Slots that it still has to wait; `None` while it only waits for the channel to be idle.
    slots: Option<u32>,
    /// From when on they count.
    from_us: u64,
    /// When it sends, if nobody else does before.
    at_us: u64,
}

impl Channel {
    /// A channel on which these many stations are.
    #[must_use]
    pub fn new(radio: Radio, stations: usize) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "metres")]
        let range2_m2 = (radio.range_m() * radio.range_m()) as f32;
        Self {
            radio,
            range2_m2,
            east_m: vec![0.0; stations],
            north_m: vec![0.0; stations],
            busy_until_us: vec![0; stations],
            busy_us: [vec![0; stations], vec![0; stations]],
            window_end_us: WINDOW_US,
            access: vec![None; stations],
            active: Vec::new(),
            contending: Vec::new(),
        }
    }

    /// Says where a station is now.
    #[expect(clippy::cast_possible_truncation, reason = "metres")]
    pub fn place(&mut self, station: usize, [east, north]: [f64; 2]) {
        self.east_m[station] = east as f32;
        self.north_m[station] = north as f32;
    }

    /// A station wants to send at `now_us`; when it will, if nobody else does before.
    pub fn want(&mut self, station: usize, now_us: u64, random: &mut ChaCha8Rng) -> u64 {
        let busy_until_us = self.busy_until_us[station];
        let is_busy = now_us < busy_until_us;
        let slots = (is_busy && !self.radio.ideal).then(|| self.draw(random));
        let from_us = if self.radio.ideal {
            now_us
        } else {
            now_us.max(busy_until_us + self.radio.aifs_us())
        };
        let at_us = from_us + u64::from(slots.unwrap_or(0)) * SLOT_US;
        self.access[station] = Some(Access {
            slots,
            from_us,
            at_us,
        });
        self.contending.push(station);
        at_us
    }

    fn draw(&self, random: &mut ChaCha8Rng) -> u32 {
        random.random_range(0..=self.radio.contention_window)
    }

    /// Whether a station that said it would send at `now_us` may.
    #[must_use]
    pub fn may_send(&self, station: usize, now_us: u64) -> bool {
        self.access[station].is_some_and(|access| access.at_us == now_us)
    }

    /// A station that may sends for `duration_us`. A station that has to wait longer for it is told when it will
    /// send now.
    pub fn send(
        &mut self,
        station: usize,
        now_us: u64,
        duration_us: u64,
        random: &mut ChaCha8Rng,
        mut postponed: impl FnMut(usize, u64),
    ) -> u64 {
        self.access[station] = None;
        self.contending.retain(|other| *other != station);
        let end_us = now_us + duration_us;
        self.occupy(station, now_us, end_us);
        if !self.radio.ideal {
            self.postpone(station, now_us, random, &mut postponed);
        }
        let overlapping = if self.radio.ideal {
            Vec::new()
        } else {
            self.active
                .iter_mut()
                .for_each(|other| other.overlapping.push(station));
            self.active.iter().map(|other| other.sender).collect()
        };
        self.active.push(Transmission {
            sender: station,
            start_us: now_us,
            end_us,
            overlapping,
        });
        end_us
    }

    /// Notes for everybody in range that the channel is busy.
    fn occupy(&mut self, sender: usize, start_us: u64, end_us: u64) {
        let (x, y) = (self.east_m[sender], self.north_m[sender]);
        let [now, next] = &mut self.busy_us;
        let places = self.east_m.iter().zip(&self.north_m);
        let busy = self.busy_until_us.iter_mut().zip(now).zip(next);
        for ((east, north), ((busy_until_us, now), next)) in places.zip(busy) {
            let (dx, dy) = (east - x, north - y);
            if dx * dx + dy * dy > self.range2_m2 {
                continue;
            }
            let from_us = if self.radio.ideal {
                start_us
            } else {
                start_us.max(*busy_until_us)
            };
            *busy_until_us = end_us.max(*busy_until_us);
            if end_us > from_us {
                let split_us = self.window_end_us.clamp(from_us, end_us);
                // A frame takes less than a window.
                *now += u32::try_from(split_us - from_us).unwrap_or(u32::MAX);
                *next += u32::try_from(end_us - split_us).unwrap_or(u32::MAX);
            }
        }
    }

    /// Contending stations in range freeze their backoff: the slots that are left count again once the channel is
    /// idle. A station whose backoff ends in this very slot sends all the same, which is a collision.
    fn postpone(
        &mut self,
        sender: usize,
        now_us: u64,
        random: &mut ChaCha8Rng,
        postponed: &mut impl FnMut(usize, u64),
    ) {
        for index in 0..self.contending.len() {
            let station = self.contending[index];
            let Some(access) = self.access[station] else {
                continue;
            };
            let (dx, dy) = (
                self.east_m[station] - self.east_m[sender],
                self.north_m[station] - self.north_m[sender],
            );
            if access.at_us <= now_us || dx * dx + dy * dy > self.range2_m2 {
                continue;
            }
            let passed = now_us.saturating_sub(access.from_us) / SLOT_US;
            let passed = u32::try_from(passed).unwrap_or(u32::MAX);
            let slots = match access.slots {
                Some(slots) => slots.saturating_sub(passed),
                None => self.draw(random),
            };
            let from_us = self.busy_until_us[station] + self.radio.aifs_us();
            let at_us = from_us + u64::from(slots) * SLOT_US;
            self.access[station] = Some(Access {
                slots: Some(slots),
                from_us,
                at_us,
            });
            postponed(station, at_us);
        }
    }

    /// The transmission of `sender` ends.
    pub fn end(&mut self, sender: usize) -> Option<Transmission> {
        let index = self.active.iter().position(|it| it.sender == sender)?;
        Some(self.active.swap_remove(index))
    }

    /// Whether a station is in range of another.
    #[must_use]
    pub fn in_range(&self, a: usize, b: usize) -> bool {
        self.distance2_m2(a, b) <= f64::from(self.range2_m2)
    }

    fn distance2_m2(&self, a: usize, b: usize) -> f64 {
        let dx = f64::from(self.east_m[a]) - f64::from(self.east_m[b]);
        let dy = f64::from(self.north_m[a]) - f64::from(self.north_m[b]);
        dx * dx + dy * dy
    }

    /// Whether a station receives a transmission: it is in range, does not send itself meanwhile, and
    /// what overlaps is weak enough.
    #[must_use]
    pub fn receives(&self, station: usize, transmission: &Transmission) -> bool {
        let sender = transmission.sender;
        if station == sender || !self.in_range(station, sender) {
            return false;
        }
        if transmission.overlapping.is_empty() {
            return true;
        }
        if transmission.overlapping.contains(&station) {
            return false;
        }
        let received_mw = |from| self.radio.received_mw(self.distance2_m2(station, from));
        let others_mw: f64 = transmission
            .overlapping
            .iter()
            .map(|&other| received_mw(other))
            .sum();
        let noise_mw = 10_f64.powf(self.radio.noise_dbm / 10.0);
        received_mw(sender) >= 10_f64.powf(self.radio.sinr_min_db / 10.0) * (others_mw + noise_mw)
    }

    /// Whether anything overlapped with a transmission.
    #[must_use]
    pub const fn overlapped(transmission: &Transmission) -> bool {
        !transmission.overlapping.is_empty()
    }

    /// Closes a window of the channel busy ratio at `now_us`; the busy time of every station in it, in
    /// microseconds.
    pub fn close_window(&mut self, now_us: u64, mut each: impl FnMut(usize, u32)) {
        self.window_end_us = now_us + WINDOW_US;
        let [now, next] = &mut self.busy_us;
        for (station, (now, next)) in now.iter_mut().zip(next).enumerate() {
            each(station, *now);
            *now = std::mem::take(next);
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;

    fn channel(radio: Radio, places: &[[f64; 2]]) -> (Channel, ChaCha8Rng) {
        let mut channel = Channel::new(radio, places.len());
        for (station, &place) in places.iter().enumerate() {
            channel.place(station, place);
        }
        (channel, ChaCha8Rng::seed_from_u64(1))
    }

    const NEAR: [[f64; 2]; 3] = [[0.0, 0.0], [10.0, 0.0], [0.0, 20.0]];

    #[test]
    fn the_range_is_that_of_the_path_loss() {
        assert!((Radio::default().range_m() - 542.0).abs() < 5.0);
        let free_space = Radio {
            exponent: 2.0,
            ..Radio::default()
        };
        assert!((free_space.range_m() - 1_016.0).abs() < 10.0);
    }

    #[test]
    fn who_finds_the_channel_idle_sends_after_aifs_and_who_finds_it_busy_later() {
        let (mut channel, mut random) = channel(Radio::default(), &NEAR);
        assert_eq!(channel.want(0, 1_000, &mut random), 1_000);
        assert!(channel.may_send(0, 1_000));
        let end_us = channel.send(0, 1_000, 400, &mut random, |_, _| panic!("nobody waits"));
        assert_eq!(end_us, 1_400);
        let at_us = channel.want(1, 1_100, &mut random);
        assert!((1_510..=1_510 + 15 * 13).contains(&at_us), "{at_us}");
        assert_eq!((at_us - 1_510) % 13, 0);
        // A third station that comes soon after the end waits for AIFS only.
        assert_eq!(channel.want(2, 1_450, &mut random), 1_510);
    }

    #[test]
    fn a_waiting_station_keeps_what_is_left_of_its_slots() {
        let (mut channel, mut random) = channel(Radio::default(), &NEAR);
        channel.want(0, 0, &mut random);
        channel.send(0, 0, 400, &mut random, |_, _| ());
        channel.access[1] = Some(Access {
            slots: Some(9),
            from_us: 510,
            at_us: 510 + 9 * 13,
        });
        channel.contending.push(1);
        channel.want(2, 520, &mut random);
        let mut moved = Vec::new();
        channel.send(2, 520 + 20, 400, &mut random, |station, at_us| {
            moved.push((station, at_us));
        });
        // Two slots have passed; the channel is idle again at 940, plus AIFS of 110.
        assert_eq!(moved, [(1, 940 + 110 + 7 * 13)]);
    }

    #[test]
    fn stations_of_the_same_slot_collide() {
        let (mut channel, mut random) = channel(Radio::default(), &NEAR);
        assert_eq!(channel.want(0, 0, &mut random).max(110), 110);
        channel.want(1, 0, &mut random);
        channel.send(0, 110, 400, &mut random, |station, _| {
            assert_ne!(station, 1);
        });
        channel.send(1, 110, 400, &mut random, |_, _| ());
        let first = channel.end(0).unwrap();
        assert!(Channel::overlapped(&first));
        assert!(!channel.receives(1, &first), "it sends itself");
        // From 10 m and 20 m: the difference is less than what is needed.
        assert!(!channel.receives(2, &first));
    }

    #[test]
    fn busy_time_counts_once_and_on_both_sides_of_a_window() {
        let (mut channel, mut random) = channel(Radio::default(), &NEAR);
        channel.send(0, 99_800, 400, &mut random, |_, _| ());
        channel.send(1, 99_900, 400, &mut random, |_, _| ());
        let mut busy = Vec::new();
        channel.close_window(100_000, |_, us| busy.push(us));
        channel.close_window(200_000, |_, us| busy.push(us));
        assert_eq!(busy, [200, 200, 200, 300, 300, 300]);
    }
}
