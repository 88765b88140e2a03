//! The radio channel with time.
//!
//! A message is under way for a whole number of ticks, from none up to the scenario's largest delay;
//! it arrives at any moment of that, in any order, or never. Whether it is lost needs no deciding: a
//! message that has not arrived at the end of its time never will.

use crate::network::Transmission;
use crate::transmission::PackedTransmission;

const MAX_UNDER_WAY: usize = 20;

/// A message under way to one receiver.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Flight {
    /// The message and its way.
    pub transmission: Transmission,
    /// For how many ticks it has been under way.
    pub ticks: u8,
}

impl Flight {
    fn of(packed: PackedTransmission) -> Option<Self> {
        Some(Self {
            transmission: packed.transmission()?,
            ticks: packed.tag() - 1,
        })
    }

    /// Tags count ticks from 1, so that no message is all zeros.
    const fn packed(self) -> PackedTransmission {
        PackedTransmission::tagged(self.transmission, self.ticks + 1)
    }
}

/// All messages under way, as a sorted set.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct TimedChannel([PackedTransmission; MAX_UNDER_WAY]);

impl TimedChannel {
    pub(super) const EMPTY: Self = Self([PackedTransmission::EMPTY; MAX_UNDER_WAY]);

    pub(super) fn flights(&self) -> impl Iterator<Item = Flight> {
        self.0.iter().copied().filter_map(Flight::of)
    }

    /// Sends a message. One that is still under way from before is from now on the one sent now: both
    /// tell the receiver the same. Panics when more are under way than there is room for.
    pub(super) fn send(&mut self, transmission: Transmission) {
        let is_same = |slot: &PackedTransmission| slot.transmission() == Some(transmission);
        let place = (self.0.iter().position(is_same))
            .or_else(|| self.0.iter().position(|slot| slot.is_empty()));
        let place = place.expect("room for what is sent within the longest delay");
        self.0[place] = PackedTransmission::tagged(transmission, 1);
        self.0.sort_unstable();
    }

    pub(super) fn take(&mut self, flight: Flight) {
        self.retain(|it| it != flight);
    }

    /// Takes away everything on its way to one robot, which is down.
    pub(super) fn forget_receiver(&mut self, to: u8) {
        self.retain(|it| it.transmission.to != to);
    }

    /// One tick passes. A message that has been under way for `ticks_max` is lost.
    pub(super) fn tick(&mut self, ticks_max: u8) {
        *self = self.each(|it| {
            let ticks = it.ticks + 1;
            (it.ticks < ticks_max).then_some(Flight { ticks, ..it })
        });
    }

    pub(super) fn map(&self, mut replace: impl FnMut(u16) -> u16) -> Self {
        self.each(|mut it| {
            it.transmission.message = replace(it.transmission.message);
            Some(it)
        })
    }

    fn retain(&mut self, keep: impl Fn(Flight) -> bool) {
        *self = self.each(|it| keep(it).then_some(it));
    }

    /// The channel with what becomes of each message under way.
    fn each(&self, mut change: impl FnMut(Flight) -> Option<Flight>) -> Self {
        let mut slots = self.0.map(|slot| {
            let changed = Flight::of(slot).and_then(&mut change);
            changed.map_or(PackedTransmission::EMPTY, Flight::packed)
        });
        slots.sort_unstable();
        Self(slots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn to(to: u8, message: u16) -> Transmission {
        Transmission {
            from: 0,
            to,
            message,
        }
    }

    #[test]
    fn a_message_is_under_way_up_to_its_longest_delay_and_then_lost() {
        let mut channel = TimedChannel::EMPTY;
        channel.send(to(1, 0));
        channel.tick(2);
        channel.send(to(1, 7));
        channel.tick(2);
        let ticks: Vec<_> = channel
            .flights()
            .map(|f| (f.transmission.message, f.ticks))
            .collect();
        assert_eq!(ticks, [(7, 1), (0, 2)]);
        channel.tick(2);
        assert_eq!(
            channel
                .flights()
                .map(|f| f.transmission.message)
                .collect::<Vec<_>>(),
            [7]
        );
    }

    #[test]
    fn what_arrives_or_cannot_be_heard_is_taken_away() {
        let mut channel = TimedChannel::EMPTY;
        channel.send(to(1, 3));
        channel.send(to(2, 3));
        channel.send(to(2, 4));
        channel.take(Flight {
            transmission: to(2, 3),
            ticks: 0,
        });
        channel.forget_receiver(1);
        assert!(channel.flights().map(|f| f.transmission).eq([to(2, 4)]));
    }
}
