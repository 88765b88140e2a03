//! The table `[zone]` of a robot file: where people wait to cross, and the road there.
//!
//! ```toml
//! [zone]
//! polygon_m = [[-3.0, -2.5], [5.0, -2.5], [5.0, 9.5], [-3.0, 9.5]] # or: place_m = [1.0, -1.5], radius_m = 2.5
//! road_m = [[-3.0, 0.0], [5.0, 0.0], [5.0, 7.0], [-3.0, 7.0]]
//! escort_m = [[1.0, -1.0], [1.0, 8.0]]
//! dwell_s = 1.0
//! speed_max_mps = 0.5
//! approach_s = 3.0
//! clear_s = 3.0
//! ```
//!
//! Where the site has its kerbs, `pavement_m = 2.5` is enough instead of the shapes: people cross between the kerbs, and
//! wait up to that far behind them. The carriageway goes on beside the crossing then, as far as the site says.

use crossguard_crossing::{PositionRules, Sensors, TrafficRules, WaitingRules};
use crossguard_endpoint::ras::area::Area;
use crossguard_protocol::{Millis, Settings, TaskType};
use serde::{Deserialize, Deserializer};

use crate::located::{Exact, Impossible, NEAR_M, Number, is_near, possible};
use crate::plan::{Plan, millis};
use crate::sight::corners as corners_of;
use crate::site::Place;
use crate::site_file::{Purpose, SiteFile, Spot, between};
use crate::zone::{NoPolygon, Zone, point, polygon};

/// How far from the carriageway people wait to cross it at most, in metres.
const PAVEMENT_MAX_M: f64 = 20.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ZoneTable {
    pavement_m: Option<f64>,
    #[serde(default, deserialize_with = "corners")]
    polygon_m: Option<Vec<[f64; 2]>>,
    place_m: Option<Exact<f64, 2>>,
    radius_m: Option<f64>,
    #[serde(default, deserialize_with = "corners")]
    road_m: Option<Vec<[f64; 2]>>,
    /// The part of the carriageway between the kerbs of the site.
    #[serde(skip)]
    crossing_m: Option<Vec<[f64; 2]>>,
    escort_m: Option<Exact<Exact<f64, 2>, 2>>,
    dwell_s: Option<f64>,
    speed_max_mps: Option<f64>,
    approach_s: Option<f64>,
    clear_s: Option<f64>,
}

/// An outline, each corner in metres to the east and to the north.
pub(super) fn outline(corners: [Place; 4]) -> Vec<[f64; 2]> {
    corners.map(|at| [at.east, at.north]).to_vec()
}

/// Corners, each with two coordinates.
fn corners<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Vec<[f64; 2]>>, D::Error> {
    let corners = Vec::<Exact<f64, 2>>::deserialize(from)?;
    Ok(Some(corners.into_iter().map(|it| it.0).collect()))
}

/// Why a table `[zone]` is no zone.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum NoZone {
    /// It has no shape, or two.
    #[error(
        "wants one of 'pavement_m', 'polygon_m', and 'place_m' with 'radius_m', for where people wait; or 'road_m' \
         alone, to watch the road and detect nobody"
    )]
    Shape,
    /// No place on the site.
    #[error("{field}: [{}, {}] is no place: metres on the site, at most {NEAR_M}, are wanted", Number(&place[0]), Number(&place[1]))]
    Place {
        /// The field.
        field: &'static str,
        /// Its value.
        place: [f64; 2],
    },
    /// Corners are no polygon.
    #[error(transparent)]
    Polygon(#[from] NoPolygon),
    /// A number is not possible.
    #[error(transparent)]
    Number(#[from] Impossible),
    /// The site does not say between which kerbs people cross.
    #[error(
        "pavement_m wants a site with kerbs, and site '{0}' has none; say 'polygon_m' and 'road_m' instead"
    )]
    Kerbs(String),
    /// People between the kerbs would not count as on the road.
    #[error(
        "road_m leaves out a part of the crossing between the kerbs of the site: people there would not count as on the \
         road; leave it out, or draw it around the carriageway"
    )]
    PartialRoad,
    /// People wait at another road.
    #[error(
        "people wait more than {PAVEMENT_MAX_M} m from road_m: it is the carriageway that they cross"
    )]
    OtherRoad,
    /// The robot would not see who is on the road.
    #[error("has no 'road_m', the carriageway: one is wanted, to see who is on the road")]
    NoRoad,
    /// People would be escorted to the middle of the road, or along it.
    #[error(
        "escort_m leads from [{}, {}] to [{}, {}]: a place on each of the two pavements is wanted, with road_m between them",
        Number(&.0[0].east), Number(&.0[0].north), Number(&.0[1].east), Number(&.0[1].north)
    )]
    Escort([Place; 2]),
    /// The escort would be ended on its way, or with somebody on the road.
    #[error(
        "escort_m is {way_m:.1} m long, which takes an escort {way_s:.1} s: {limit} is {most_s} s; say places nearer to the kerbs, \
         or a longer {limit} in [protocol]"
    )]
    EscortTime {
        /// How long the way is, in metres.
        way_m: f64,
        /// How long it takes, in seconds.
        way_s: f64,
        /// The setting that gives it less time.
        limit: &'static str,
        /// How much time that is, in seconds.
        most_s: f64,
    },
    /// A robot that leads by itself has nobody to lead across.
    #[error("has 'road_m' alone: with autopilot it is wanted where people wait, too")]
    NobodyWaits,
}

impl ZoneTable {
    /// The shapes between and behind the kerbs of a site, where the table wants them.
    fn fill_from(&mut self, layout: &SiteFile) -> Result<(), NoZone> {
        let Some(pavement_m) = self.pavement_m else {
            return Ok(());
        };
        if self.polygon_m.is_some() || self.place_m.is_some() || self.radius_m.is_some() {
            return Err(NoZone::Shape);
        }
        let pavement_m = possible(
            "pavement_m",
            pavement_m,
            0.5..=PAVEMENT_MAX_M,
            "0.5 to 20 m",
        )?;
        let Some([near, far]) = layout.kerbs else {
            return Err(NoZone::Kerbs(layout.name.clone()));
        };
        self.polygon_m = Some(outline(between(near, far, pavement_m)));
        if let (None, Some(carriageway)) = (&self.road_m, layout.carriageway()) {
            self.crossing_m = Some(outline(carriageway.crossing));
            self.road_m = Some(outline(carriageway.whole));
        }
        let crossed = layout.places.values();
        let crossed = crossed.filter(|spot| spot.purpose == Purpose::Cross);
        let crossed: Vec<_> = crossed
            .map(|Spot { place, .. }| Exact([place.east, place.north]))
            .collect();
        if let ([from, to], None) = (&crossed[..], self.escort_m) {
            self.escort_m = Some(Exact([*from, *to]));
        }
        Ok(())
    }

    /// The zone, and the kerbs between which people are escorted, if they are said.
    pub(super) fn check(
        mut self,
        layout: &SiteFile,
        confidence_min: f64,
        is_autopilot: bool,
    ) -> Result<(Zone, Option<[Place; 2]>), NoZone> {
        self.fill_from(layout)?;
        let waiting = match (self.polygon_m, self.place_m, self.radius_m) {
            (Some(corners), None, None) => Some(polygon_on_site("polygon_m", corners)?),
            (None, Some(Exact(place)), Some(radius_m)) => Some(Area::Circle {
                center: on_site("place_m", place)?,
                radius_m: possible("radius_m", radius_m, 0.1..=1e3, "0.1 to 1000 m")?,
            }),
            (None, None, None) if self.road_m.is_some() => None,
            _ => return Err(NoZone::Shape),
        };
        let road = self
            .road_m
            .map(|corners| polygon_on_site("road_m", corners));
        let road = road.transpose()?.ok_or(NoZone::NoRoad)?;
        match &waiting {
            None if is_autopilot => return Err(NoZone::NobodyWaits),
            Some(waiting) if !is_beside(waiting, &road) => return Err(NoZone::OtherRoad),
            _ => {}
        }
        let kerbs = self.escort_m.map(|Exact([from, to])| {
            let place = |at: Exact<_, 2>| {
                on_site("escort_m", at.0).map(|[east, north]| Place::new(east, north))
            };
            Ok::<_, NoZone>([place(from)?, place(to)?])
        });
        let default = WaitingRules::default();
        let minute = "0 to 60 s";
        let time = |field, value: Option<f64>, default: Millis, most: f64, wanted| {
            value.map_or(Ok(default), |seconds| {
                possible(field, seconds, 0.0..=most, wanted).map(millis)
            })
        };
        let rules = WaitingRules {
            dwell: time("dwell_s", self.dwell_s, default.dwell, 60.0, minute)?,
            speed_max_cmps: match self.speed_max_mps {
                Some(speed) => centi(possible(
                    "speed_max_mps",
                    speed,
                    0.05..=2.0,
                    "0.05 to 2 m/s",
                )?),
                None => default.speed_max_cmps,
            },
            approach: time(
                "approach_s",
                self.approach_s,
                default.approach,
                10.0,
                "0 to 10 s",
            )?,
            clear: time("clear_s", self.clear_s, default.clear, 60.0, minute)?,
            confidence_min: percent(confidence_min),
            step_off: default.step_off,
        };
        let zone = Zone {
            waiting,
            road: Some(road),
            crossing: self.crossing_m.map(Area::Polygon),
            rules,
            sensors: Sensors::default(),
            position: PositionRules::default(),
            traffic: TrafficRules::default(),
        };
        Ok((zone, kerbs.transpose()?))
    }
}

/// Looks that a plan has people escorted over the road of a zone, from one pavement to the other, and in the time of that.
pub(super) fn check_escort(zone: &Zone, plan: &Plan, settings: &Settings) -> Result<(), NoZone> {
    let (Some(road), Some(kerbs)) = (zone.ground().road, plan.kerbs) else {
        return Ok(());
    };
    let [from, to] = kerbs.map(point);
    if road.has(from) || road.has(to) || !road.is_between(from, to) {
        return Err(NoZone::Escort(kerbs));
    }
    let way_m = kerbs[0].distance(kerbs[1]);
    let mut legs = plan.stages.iter().flat_map(|stage| &stage.parts);
    let escort = legs.find(|(_, leg)| leg.task == TaskType::MOVE);
    match escort.and_then(|(_, leg)| leg.too_long(way_m, settings)) {
        Some((way_s, limit, most_s)) => Err(NoZone::EscortTime {
            way_m,
            way_s,
            limit,
            most_s,
        }),
        None => Ok(()),
    }
}

/// Whether a place where people wait is at most as far from a carriageway as a pavement is wide, or on it.
fn is_beside(waiting: &Area, road: &Area) -> bool {
    let is_near = |at: &[f64; 2]| road.distance_m(*at) <= PAVEMENT_MAX_M;
    corners_of(waiting).iter().any(is_near)
        || corners_of(road).iter().any(|at| waiting.contains(*at))
}

/// Hundredths.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be small and not negative"
)]
fn centi(value: f64) -> u16 {
    (value * 100.0).round() as u16
}

/// Percent.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be from 0 to 1"
)]
fn percent(share: f64) -> u8 {
    (share * 100.0).round() as u8
}

fn on_site(field: &'static str, place: [f64; 2]) -> Result<[f64; 2], NoZone> {
    if is_near(place) {
        Ok(place)
    } else {
        Err(NoZone::Place { field, place })
    }
}

fn polygon_on_site(field: &'static str, corners: Vec<[f64; 2]>) -> Result<Area, NoZone> {
    for corner in &corners {
        on_site(field, *corner)?;
    }
    Ok(polygon(field, corners)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::rows;

    fn zone(text: &str, is_autopilot: bool) -> Result<(Zone, Option<[Place; 2]>), String> {
        let table: ZoneTable = toml::from_str(text).map_err(|error| error.to_string())?;
        let checked = table.check(&SiteFile::street(), 0.5, is_autopilot);
        checked.map_err(|error| error.to_string())
    }

    const ROAD: &str = "road_m = [[-3, 0], [5, 0], [5, 7], [-3, 7]]\n";

    #[test]
    fn a_zone_is_a_polygon_or_a_place_with_a_radius() {
        let (round, kerbs) =
            zone(&format!("{ROAD}place_m = [1, -1.5]\nradius_m = 2"), true).unwrap();
        assert_eq!(kerbs, None);
        assert!(round.waiting.unwrap().contains([1.0, -3.4]));
        assert!(round.road.unwrap().contains([4.9, 6.9]));
        assert_eq!(round.rules, WaitingRules::default());
        let text = "polygon_m = [[-3, -2.5], [5, -2.5], [5, 9.5], [-3, 9.5]]\nescort_m = [[0, -1], [0, 8]]\n\
                    dwell_s = 2.0\nspeed_max_mps = 0.3\napproach_s = 0\nclear_s = 5";
        let (corners, kerbs) = zone(&format!("{ROAD}{text}"), false).unwrap();
        assert_eq!(kerbs, Some([Place::new(0.0, -1.0), Place::new(0.0, 8.0)]));
        assert!(corners.waiting.unwrap().contains([4.0, 9.0]));
        let rules = WaitingRules {
            dwell: Millis(2_000),
            speed_max_cmps: 30,
            approach: Millis(0),
            clear: Millis(5_000),
            ..WaitingRules::default()
        };
        assert_eq!(corners.rules, rules);
        assert!(zone(ROAD, false).unwrap().0.waiting.is_none());
    }

    #[test]
    fn the_kerbs_of_a_site_are_a_zone() {
        let (zone, escort) = zone("pavement_m = 2.5", true).unwrap();
        let (waiting, road) = (zone.waiting.unwrap(), zone.road.unwrap());
        for (place, waits, is_on_road) in [
            ([1.0, -2.4], true, false),
            ([1.0, 9.4], true, false),
            ([1.0, 3.0], true, true),
            ([1.0, -2.6], false, false),
            ([1.0, 9.6], false, false),
            // The carriageway goes on beside the crossing.
            ([5.1, 3.0], false, true),
            ([15.1, 3.0], false, false),
        ] {
            let found = (waiting.contains(place), road.contains(place));
            assert_eq!(found, (waits, is_on_road), "{place:?}");
        }
        let escort = escort.unwrap().map(|place| (place.east, place.north));
        assert_eq!(escort, [(1.0, 8.0), (1.0, -1.0)]);
    }

    /// A table `[zone]`, and what is said of it. `CIRCLE` stands for where people wait, `ROAD` for the carriageway.
    const MISFITS: &str = r"
                                                 | wants one of 'pavement_m', 'polygon_m', and 'place_m'
place_m = [1, 2]                                 | wants one of 'pavement_m'
radius_m = 2                                     | wants one of 'pavement_m'
pavement_m = 2\nradius_m = 2                     | wants one of 'pavement_m'
pavement_m = 0.1                                 | pavement_m is 0.1: 0.5 to 20 m is wanted
polygon_m = [[0, 0], [1, 1]]                     | polygon_m has 2 corners: 3 to 64 are possible
polygon_m = [[0, 0], [1, 1], [0, 1e9]]           | polygon_m: [0, 1000000000] is no place: metres on the site
road_m = [[0, 0], [1, 1], [0, -1e308]]           | road_m: [0, -1e308] is no place: metres on the site
polygon_m = [[0, 0], [2, 2], [2, 0], [0, 2]]     | polygon_m: its sides 1 and 3 cross
road_m = [[0, 0], [2, 0], [4, 0]]                | road_m: its corners enclose nothing
place_m = [1, 2]\nradius_m = 0                   | radius_m is 0: 0.1 to 1000 m is wanted
CIRCLE\nroad_m = [[30, 0], [40, 0], [40, 7], [30, 7]] | people wait more than 20 m from road_m
CIRCLE                                           | has no 'road_m'
CIRCLE\nROAD\ndwell_s = -1                       | dwell_s is -1: 0 to 60 s is wanted
CIRCLE\nROAD\nspeed_max_mps = nan                | speed_max_mps is NaN: 0.05 to 2 m/s
CIRCLE\ndwel_s = 1                               | unknown field `dwel_s`
CIRCLE\nescort_m = [[0, 0]]                      | escort_m
";

    #[test]
    fn what_is_no_zone_is_refused_by_the_name_of_its_field() {
        for [text, cause] in rows(MISFITS) {
            let circle = "place_m = [1, -1.5]\nradius_m = 2";
            let full = text.replace("CIRCLE", circle).replace("ROAD", ROAD);
            let error = zone(&full, false).unwrap_err();
            assert!(error.contains(&cause), "{text}: {error}");
        }
        assert!(zone(ROAD, true).unwrap_err().contains("has 'road_m' alone"));
    }
}
