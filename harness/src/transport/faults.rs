//! Faults on purpose: a receiver that loses datagrams, the same ones at every run with a seed.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{Arrival, Receiver};

/// Which faults a receiver has.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Faults {
    /// Probability with which a datagram is lost, 0..=1.
    pub loss: f64,
    /// Seed of the draws.
    pub seed: u64,
}

/// A receiver with faults.
#[derive(Debug)]
pub struct Lossy<R> {
    receiver: R,
    loss: f64,
    draws: ChaCha8Rng,
}

impl<R> Lossy<R> {
    /// `receiver` with `faults`.
    pub fn new(receiver: R, faults: Faults) -> Self {
        let draws = ChaCha8Rng::seed_from_u64(faults.seed);
        Self {
            receiver,
            loss: faults.loss.clamp(0.0, 1.0),
            draws,
        }
    }
}

impl<R: Receiver> Receiver for Lossy<R> {
    fn receive(&mut self) -> std::io::Result<Option<Arrival>> {
        Ok(self.receiver.receive()?.map(|arrival| match arrival {
            Arrival::Datagram(octets) if self.draws.random_bool(self.loss) => Arrival::Lost(octets),
            other => other,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Endless;

    impl Receiver for Endless {
        fn receive(&mut self) -> std::io::Result<Option<Arrival>> {
            Ok(Some(Arrival::Datagram(vec![1])))
        }
    }

    fn lost_of_1000(loss: f64, seed: u64) -> usize {
        let mut lossy = Lossy::new(Endless, Faults { loss, seed });
        let is_lost = |arrival| matches!(arrival, Some(Arrival::Lost(_)));
        (0..1_000)
            .filter(|_| is_lost(lossy.receive().unwrap()))
            .count()
    }

    #[test]
    fn about_as_many_are_lost_as_should_be_and_the_same_ones_at_every_run() {
        assert_eq!(lost_of_1000(0.0, 1), 0);
        assert_eq!(lost_of_1000(1.0, 1), 1_000);
        let lost = lost_of_1000(0.3, 1);
        assert!((250..350).contains(&lost), "{lost}");
        assert_eq!(lost, lost_of_1000(0.3, 1));
    }
}
