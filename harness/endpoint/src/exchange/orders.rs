//! The parameters of each follower's newest command, for its repetitions.

use crossguard_codec::TaskParameters;
use crossguard_protocol::{MAX_FOLLOWERS, StationId};

/// One place for each follower that a leader may have.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Orders([Option<(StationId, TaskParameters)>; MAX_FOLLOWERS]);

impl Orders {
    /// Keeps the parameters of a command: in the place of older ones for this follower, or of those for a
    /// station that does not follow.
    pub(super) fn put(
        &mut self,
        follower: StationId,
        parameters: TaskParameters,
        follows: impl Fn(StationId) -> bool,
    ) {
        let is_own = |order: &Option<(StationId, _)>| order.is_some_and(|(it, _)| it == follower);
        let is_free = |order: &Option<(StationId, _)>| order.is_none_or(|(it, _)| !follows(it));
        let place = self.0.iter().position(is_own);
        let place = place.or_else(|| self.0.iter().position(is_free));
        // A leader has no more followers than there are places, and commands nobody else.
        if let Some(place) = place {
            self.0[place] = Some((follower, parameters));
        }
    }

    /// The parameters of the newest command to `follower`; open ones where there is none.
    pub(super) fn of(&self, follower: StationId) -> TaskParameters {
        let mut orders = self.0.iter().flatten();
        let order = orders.find(|(station, _)| *station == follower);
        order.map(|(_, parameters)| *parameters).unwrap_or_default()
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
        let mut orders = Orders::default();
        let follows = |station: StationId| station.0 <= 4;
        // Stations that no longer follow give their places up.
        for station in [90, 91, 92, 93, 1, 2, 3, 4] {
            orders.put(StationId(station), at(1.0), follows);
        }
        orders.put(StationId(2), at(0.5), follows);
        assert_eq!(orders.of(StationId(2)), at(0.5));
        for station in [1, 3, 4] {
            assert_eq!(orders.of(StationId(station)), at(1.0), "{station}");
        }
        assert_eq!(orders.of(StationId(90)), TaskParameters::default());
    }
}
