//! The radio channel with time.
//!
//! A message is under way for a whole number of ticks, from none up to the scenario's largest delay;
//! it arrives at any moment of that, in any order, or never. Whether it is lost needs no deciding: a
//! message that has not arrived at the end of its time never will.

use crate::network::Transmission;

/// How many messages may be under way at a time.
const MAX_UNDER_WAY: usize = 20;

/// A transmission with the ticks it has been under way, in four bytes, or none.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
struct PackedFlight(u32);

impl PackedFlight {
    const EMPTY: Self = Self(0);

    /// Ticks are counted from 1 here, so that no message is all zeros.
    fn of(transmission: Transmission, ticks: u8) -> Self {
        let Transmission { from, to, message } = transmission;
        let [high, low] = message.to_be_bytes();
        Self(u32::from_be_bytes([ticks + 1, from << 4 | to, high, low]))
    }

    fn flight(self) -> Option<Flight> {
        let [ticks, from_to, high, low] = self.0.to_be_bytes();
        let transmission = Transmission {
            from: from_to >> 4,
            to: from_to & 0xf,
            message: u16::from_be_bytes([high, low]),
        };
        Some(Flight {
            transmission,
            ticks: ticks.checked_sub(1)?,
        })
    }
}

/// A message under way to one receiver.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Flight {
    /// The message and its way.
    pub transmission: Transmission,
    /// For how many ticks it has been under way.
    pub ticks: u8,
}

/// All messages under way, as a sorted set.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct TimedChannel([PackedFlight; MAX_UNDER_WAY]);

impl TimedChannel {
    pub(super) const EMPTY: Self = Self([PackedFlight::EMPTY; MAX_UNDER_WAY]);

    /// Everything under way.
    pub(super) fn flights(&self) -> impl Iterator<Item = Flight> {
        self.0.iter().filter_map(|slot| slot.flight())
    }

    /// Sends a message. One that is still under way from before is from now on the one sent now: both
    /// tell the receiver the same.
    ///
    /// # Panics
    /// When more messages are under way than there is room for.
    pub(super) fn send(&mut self, transmission: Transmission) {
        let is_same = |slot: &PackedFlight| {
            slot.flight()
                .is_some_and(|f| f.transmission == transmission)
        };
        let place = (self.0.iter().position(is_same))
            .or_else(|| self.0.iter().position(|slot| *slot == PackedFlight::EMPTY));
        let place = place.expect("room for what is sent within the longest delay");
        self.0[place] = PackedFlight::of(transmission, 0);
        self.0.sort_unstable();
    }

    /// Takes away a message that has arrived.
    pub(super) fn take(&mut self, flight: Flight) {
        let arrived = PackedFlight::of(flight.transmission, flight.ticks);
        self.retain(|slot| slot != arrived);
    }

    /// Takes away everything on its way to one robot, which is down.
    pub(super) fn forget_receiver(&mut self, to: u8) {
        self.retain(|slot| {
            slot.flight()
                .is_some_and(|flight| flight.transmission.to != to)
        });
    }

    /// One tick passes. What has been under way for `ticks_max` is lost.
    pub(super) fn tick(&mut self, ticks_max: u8) {
        for slot in &mut self.0 {
            *slot = match slot.flight() {
                Some(Flight {
                    transmission,
                    ticks,
                }) if ticks < ticks_max => PackedFlight::of(transmission, ticks + 1),
                _ => PackedFlight::EMPTY,
            };
        }
        self.0.sort_unstable();
    }

    /// The channel with every message replaced.
    pub(super) fn map(&self, mut replace: impl FnMut(u16) -> u16) -> Self {
        let mut mapped = Self::EMPTY;
        for (
            slot,
            Flight {
                transmission,
                ticks,
            },
        ) in mapped.0.iter_mut().zip(self.flights())
        {
            let message = replace(transmission.message);
            *slot = PackedFlight::of(
                Transmission {
                    message,
                    ..transmission
                },
                ticks,
            );
        }
        mapped.0.sort_unstable();
        mapped
    }

    fn retain(&mut self, keep: impl Fn(PackedFlight) -> bool) {
        for slot in &mut self.0 {
            if !keep(*slot) {
                *slot = PackedFlight::EMPTY;
            }
        }
        self.0.sort_unstable();
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
