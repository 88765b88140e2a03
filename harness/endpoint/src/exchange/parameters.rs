//! The parameters of each follower's newest command, for its repetitions.

use crossguard_codec::TaskParameters;
use crossguard_protocol::{MAX_FOLLOWERS, StationId};

/// One place for each follower that a leader may have.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Parameters([Option<(StationId, TaskParameters)>; MAX_FOLLOWERS]);

impl Parameters {
    /// Keeps the parameters of a command: in the place of older ones for this follower, or of those for a
    /// station that does not follow.
    pub(super) fn put(
        &mut self,
        follower: StationId,
        parameters: TaskParameters,
        follows: impl Fn(StationId) -> bool,
    ) {
        let is_own = |kept: &Option<(StationId, _)>| kept.is_some_and(|(it, _)| it == follower);
        let is_free = |kept: &Option<(StationId, _)>| kept.is_none_or(|(it, _)| !follows(it));
        let place = self.0.iter().position(is_own);
        let place = place.or_else(|| self.0.iter().position(is_free));
        // A leader has no more followers than there are places, and commands nobody else.
        if let Some(place) = place {
            self.0[place] = Some((follower, parameters));
        }
    }

    /// The parameters of the newest command to `follower`; open ones where there is none.
    pub(super) fn of(&self, follower: StationId) -> TaskParameters {
        let mut kept = self.0.iter().flatten();
        let newest = kept.find(|(station, _)| *station == follower);
        newest
            .map(|(_, parameters)| *parameters)
            .unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(speed: f64) -> TaskParameters {
        TaskParameters {
            maximum_speed: Some(speed),
            ..TaskParameters::default()
        }
    }

    #[test]
    fn each_follower_keeps_its_newest_parameters() {
        let mut kept = Parameters::default();
        let follows = |station: StationId| station.0 <= 4;
        // Stations that no longer follow give their places up.
        for station in [90, 91, 92, 93, 1, 2, 3, 4] {
            kept.put(StationId(station), at(1.0), follows);
        }
        kept.put(StationId(2), at(0.5), follows);
        assert_eq!(kept.of(StationId(2)), at(0.5));
        for station in [1, 3, 4] {
            assert_eq!(kept.of(StationId(station)), at(1.0), "{station}");
        }
        assert_eq!(kept.of(StationId(90)), TaskParameters::default());
    }
}
