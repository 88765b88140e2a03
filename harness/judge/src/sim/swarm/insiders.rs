//! Draws for a station that lies.

use crossguard_model_check::scenario::LyingPart;
use crossguard_protocol::StationId;
use crossguard_robot::site::Place;
use rand::Rng;
use rand::seq::IndexedRandom;

use super::Swarm;

/// Draw for the insider of a run.
#[derive(Clone, Debug)]
pub struct InsiderDraw {
    /// Its station id.
    pub station: StationId,
    /// The part in which it mostly lies.
    pub part: LyingPart,
    /// How long it is silent at most after it has said something, in milliseconds.
    pub pause_ms: u32,
    /// Where it says that it is.
    pub place: Place,
}

impl Swarm {
    /// The same run, with an insider that lies until the network is healed in this share of the seeds.
    #[must_use]
    pub fn with_insider(mut self, share: f64) -> Self {
        let Some(mut draws) = self.draws_of(0x4c49_4152, share) else {
            return self;
        };
        let parts = [
            LyingPart::Follower,
            LyingPart::Helper,
            LyingPart::Bystander,
            LyingPart::Leader,
        ];
        let station = u32::try_from(self.robots.len()).unwrap_or(0) + 1;
        self.insider = Some(InsiderDraw {
            station: StationId(station),
            part: *parts.choose(&mut draws).unwrap_or(&LyingPart::Bystander),
            pause_ms: draws.random_range(20..400),
            place: Place::new(
                draws.random_range(-10.0..10.0),
                draws.random_range(-10.0..10.0),
            ),
        });
        self
    }
}
