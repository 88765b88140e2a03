//! Road users around a robot, in few numbers: its local dynamic map as logs, `status` and metrics have it.

use std::fmt::{self, Display, Formatter};

use crossguard_codec::{Identity, Kind, Position, distance};
use crossguard_endpoint::station::LocalDynamicMap;
use crossguard_protocol::Decimetres;
use serde::{Deserialize, Serialize};

/// Road users around, by kind; kinds without any are left out.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Around {
    /// One for each kind.
    pub kinds: Vec<OfKind>,
}

/// The road users of a kind that are around.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct OfKind {
    /// Which kind.
    pub kind: Kind,
    /// How many stations, objects and clusters there are.
    pub count: usize,
    /// The nearest one, unless no distance is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nearest: Option<Nearest>,
    /// For how long the one that was told of longest ago has not been told of again, in ms.
    pub oldest_ms: u64,
}

/// The nearest road user of a kind.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Nearest {
    /// Its identity.
    pub who: Identity,
    /// How far away it is, in metres.
    pub distance_m: f64,
}

impl Around {
    /// Road users on `map` at `now_ms`, seen from `own`.
    #[must_use]
    pub fn of(map: &LocalDynamicMap, own: &Position, now_ms: u64) -> Self {
        let kinds = Kind::ALL
            .into_iter()
            .filter_map(|kind| OfKind::of(map, kind, own, now_ms));
        Self {
            kinds: kinds.collect(),
        }
    }

    /// Road users of a kind, if there are any.
    #[must_use]
    pub fn of_kind(&self, kind: Kind) -> Option<&OfKind> {
        self.kinds.iter().find(|it| it.kind == kind)
    }
}

impl OfKind {
    /// How many of which kind, like `2 vehicles`.
    #[must_use]
    pub fn counted(&self) -> String {
        let several = if self.count == 1 { "" } else { "s" };
        format!("{} {}{several}", self.count, self.kind)
    }

    fn of(map: &LocalDynamicMap, kind: Kind, own: &Position, now_ms: u64) -> Option<Self> {
        let distances = map
            .of_kind(kind)
            .map(|known| (distance(own, &known.user.position), known.user.identity));
        let nearest = distances
            .min()
            .filter(|(far, _)| *far != Decimetres::UNKNOWN);
        let oldest = map.of_kind(kind).map(|known| known.heard_ms).min()?;
        Some(Self {
            kind,
            count: map.of_kind(kind).count(),
            nearest: nearest.map(|(far, who)| Nearest {
                who,
                distance_m: f64::from(far.0) / 10.0,
            }),
            oldest_ms: now_ms.saturating_sub(oldest),
        })
    }
}

impl Display for Around {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.kinds.is_empty() {
            return f.write_str("nobody");
        }
        for (place, of_kind) in self.kinds.iter().enumerate() {
            let comma = if place > 0 { ", " } else { "" };
            write!(f, "{comma}{of_kind}")?;
        }
        Ok(())
    }
}

impl Display for OfKind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} (", self.counted())?;
        if let Some(Nearest { who, distance_m }) = self.nearest {
            write!(f, "nearest {who} at {distance_m:.1} m, ")?;
        }
        let seconds = std::time::Duration::from_millis(self.oldest_ms).as_secs_f64();
        write!(f, "oldest {seconds:.1} s)")
    }
}

#[cfg(test)]
mod tests {
    use crossguard_codec::RoadUser;

    use super::*;

    fn user(id: u32, kind: Kind, position: Position) -> RoadUser {
        RoadUser {
            identity: Identity::Station(id),
            kind,
            station_type: None,
            position,
            speed: None,
            heading: None,
            length: None,
            cardinality: 1,
            signals: None,
            measured_its: 0,
        }
    }

    #[test]
    fn the_nearest_and_the_oldest_of_each_kind_are_told() {
        let own = Position::at(49.0, 8.4);
        let mut map = LocalDynamicMap::default();
        assert_eq!(Around::of(&map, &own, 0).to_string(), "nobody");
        map.observe(user(7, Kind::Vehicle, Position::at(49.001, 8.4)), 1_000);
        map.observe(user(8, Kind::Vehicle, Position::at(49.0001, 8.4)), 1_400);
        map.observe(user(9, Kind::Vru, Position::default()), 1_500);
        let around = Around::of(&map, &own, 1_500);
        assert_eq!(
            around.to_string(),
            "2 vehicles (nearest station 8 at 11.1 m, oldest 0.5 s), \
             1 vulnerable road user (oldest 0.0 s)"
        );
        let json = serde_json::to_string(&around).unwrap();
        assert_eq!(serde_json::from_str::<Around>(&json).unwrap(), around);
    }
}
