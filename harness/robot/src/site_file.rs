//! A site as a file: the crossing with its kerbs, the lanes, and the places where robots wait, guard and cross.
//!
//! ```toml
//! [origin]
//! latitude = 49.0101
//! longitude = 8.4124
//!
//! [crossing]
//! reference = "276:4711"
//! kerbs_m = [[[-3.0, 0.0], [5.0, 0.0]], [[-3.0, 7.0], [5.0, 7.0]]]
//! along_m = 10.0
//!
//! [[lanes]]
//! name = "near"
//! from_m = [-20.0, 1.75]
//! to_m = [20.0, 1.75]
//! width_m = 3.5
//!
//! [places]
//! near-kerb = { at_m = [1.0, -1.0], for = "cross" }
//! near-lane = { at_m = [-4.0, 2.0], for = "guard" }
//! ```

use std::collections::BTreeMap;
use std::path::Path;

use crossguard_crossing::Setup;
use serde::Deserialize;
use toml::Spanned;

use crate::located::{self, Exact, FileError, Misfit, Point};
use crate::site::{Place, Site, crossing_named};

mod carriageway;
mod draft;

pub use carriageway::Carriageway;
#[cfg(feature = "full")]
pub(crate) use carriageway::between;
pub use draft::Draft;
use draft::Points;

/// A site, checked: every guard stands on a lane, nobody waits or begins to cross on one.
#[derive(Clone, PartialEq, Debug)]
pub struct SiteFile {
    /// Its name.
    pub name: String,
    /// Where it is on earth, and what maps call it.
    pub site: Site,
    /// The edges of the carriageway between which people cross; `None` for a site without a crossing.
    pub kerbs: Option<[[Place; 2]; 2]>,
    /// How far the carriageway goes on beside the crossing, on either side, in metres.
    pub along_m: f64,
    /// The lanes.
    pub lanes: Vec<Lane>,
    /// The places of robots, by name.
    pub places: BTreeMap<String, Spot>,
}

/// A lane.
#[derive(Clone, PartialEq, Debug)]
pub struct Lane {
    /// Its name.
    pub name: String,
    /// Where its middle begins, in the direction of its traffic.
    pub from: Place,
    /// Where its middle ends.
    pub to: Place,
    /// Its width in metres.
    pub width_m: f64,
}

/// A place of robots.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Spot {
    /// Where it is.
    pub place: Place,
    /// Its purpose.
    pub purpose: Purpose,
}

/// Purpose of a place.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Purpose {
    /// Robots wait there, off the lanes.
    Wait,
    /// A robot stands there and holds traffic back, on a lane.
    Guard,
    /// A robot begins or ends an escort there, off the lanes.
    Cross,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SiteTables {
    name: Option<String>,
    origin: Spanned<OriginTable>,
    #[serde(default)]
    crossing: CrossingTable,
    #[serde(default)]
    lanes: Vec<LaneTable>,
    #[serde(default)]
    places: BTreeMap<String, Spanned<SpotTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OriginTable {
    latitude: f64,
    longitude: f64,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct CrossingTable {
    reference: Option<Spanned<String>>,
    map_place: Option<Spanned<String>>,
    kerbs_m: Option<Spanned<Vec<Kerb>>>,
    along_m: Option<Spanned<f64>>,
}

type Kerb = Exact<Point, 2>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LaneTable {
    name: String,
    from_m: Point,
    to_m: Point,
    width_m: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SpotTable {
    at_m: Point,
    #[serde(rename = "for")]
    purpose: Purpose,
}

/// How far the carriageway goes on beside the crossing unless the site says it, in metres.
const ALONG_M: f64 = 10.0;

/// How far apart kerbs are at least, in metres: less is no lane.
const WIDTH_MIN_M: f64 = 2.0;

/// The text of the site of the demonstrations.
pub const STREET: &str = include_str!("../plans/street.toml");

impl SiteFile {
    /// Reads a site.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        Draft::read(path).map(|draft| draft.site)
    }

    /// The street of the demonstrations.
    ///
    /// # Panics
    /// Never: a test reads it.
    #[must_use]
    pub fn street() -> Self {
        let parsed = Self::parse("site street", "street", STREET);
        parsed.expect("a test reads it").0
    }

    /// The same site, whose origin is elsewhere and whose crossing is another one.
    #[must_use]
    pub fn at(self, site: Site) -> Self {
        Self { site, ..self }
    }

    fn parse(file: &str, name: &str, text: &str) -> Result<(Self, Points), FileError> {
        let tables: Result<SiteTables, _> = located::parse(text);
        let checked = tables.and_then(|tables| {
            let points = tables.points();
            Ok((tables.check(name)?, points))
        });
        checked.map_err(|misfit| misfit.of(file, text))
    }

    /// The carriageway at the crossing; `None` for a site without one.
    #[must_use]
    pub fn carriageway(&self) -> Option<Carriageway> {
        self.kerbs
            .map(|[near, far]| Carriageway::new(near, far, self.along_m))
    }

    /// How long a slow walker is on the carriageway, in seconds; `None` for a site without a crossing.
    #[must_use]
    pub fn walk_s(&self) -> Option<f64> {
        let slow_mps = f64::from(Setup::SLOW_CMPS) / 100.0;
        self.carriageway().map(|road| road.width_m() / slow_mps)
    }

    /// Which way a robot faces that holds traffic back at a place, in degrees clockwise from north; `None` beside the
    /// lanes.
    #[must_use]
    pub fn facing_deg(&self, place: Place) -> Option<f64> {
        self.lane_at(place).map(|lane| lane.to.bearing(lane.from))
    }

    /// Why a place is not for this, if it is not.
    pub(crate) fn misfit(&self, name: &str, place: Place, purpose: Purpose) -> Option<String> {
        let lane = self.lane_at(place).map(|lane| &lane.name);
        let road = self.carriageway();
        match (purpose, lane) {
            (Purpose::Guard, None) if !self.lanes.is_empty() => {
                Some(format!("{name} is for guarding, and on no lane"))
            }
            (Purpose::Guard, lane) => road.filter(|road| !road.is_beside(place)).map(|_| {
                let whose = lane.map(|lane| format!("on lane '{lane}', which is "));
                let whose = whose.unwrap_or_default();
                format!(
                    "{name} is {whose}not between the kerbs: people on it would not count as on the road"
                )
            }),
            (Purpose::Wait | Purpose::Cross, Some(lane)) => Some(format!(
                "{name} is on lane '{lane}': only places to guard may be on one"
            )),
            (Purpose::Cross, None) => road.filter(|road| road.has(place)).map(|_| {
                format!("{name} is between the kerbs: a person is escorted from one pavement to the other")
            }),
            (Purpose::Wait, None) => None,
        }
    }

    /// The lane that a place is on.
    #[must_use]
    pub fn lane_at(&self, place: Place) -> Option<&Lane> {
        self.lanes.iter().find(|lane| lane.has(place))
    }
}

impl Lane {
    /// Whether a place is on it.
    #[must_use]
    pub fn has(&self, place: Place) -> bool {
        let length = self.from.distance(self.to);
        let (east, north) = (
            self.to.east - self.from.east,
            self.to.north - self.from.north,
        );
        let (de, dn) = (place.east - self.from.east, place.north - self.from.north);
        let along = (de * east + dn * north) / length;
        let beside = (de * north - dn * east) / length;
        (0.0..=length).contains(&along) && beside.abs() <= self.width_m / 2.0
    }
}

impl SiteTables {
    fn check(self, name: &str) -> Result<SiteFile, Misfit> {
        let site = self.site()?;
        let along_m = self.crossing.along_m.as_ref();
        let along_m = located::within_if_any(along_m, 1.0..=100.0, "m")?;
        let lanes = self.lanes.iter().map(LaneTable::check);
        let mut checked = SiteFile {
            name: self.name.unwrap_or_else(|| name.to_owned()),
            site,
            kerbs: self.crossing.kerbs()?,
            along_m: along_m.unwrap_or(ALONG_M),
            lanes: lanes.collect::<Result<_, _>>()?,
            places: BTreeMap::new(),
        };
        if let Some(kerbs) = &self.crossing.kerbs_m
            && checked.carriageway().is_some_and(|road| !road.is_convex())
        {
            let what = format!(
                "the two kerbs meet, or will within {} m beside the crossing",
                checked.along_m
            );
            return Err(Misfit::at(kerbs, what));
        }
        if let Some((kerbs, road)) = self.crossing.kerbs_m.as_ref().zip(checked.carriageway()) {
            let width_m = road.width_m();
            if width_m < WIDTH_MIN_M {
                let what = format!(
                    "the kerbs are {width_m:.2} m apart: at least {WIDTH_MIN_M} m is wanted"
                );
                return Err(Misfit::at(kerbs, what));
            }
            if let Some(lane) = checked.lanes.iter().find(|lane| road.cuts(lane)) {
                let what = format!(
                    "lane '{}' leads over a kerb: the kerbs are the edges of the carriageway that people step over",
                    lane.name
                );
                return Err(Misfit::at(kerbs, what));
            }
        }
        for (name, spot) in self.places {
            let place = located::place(&spot.get_ref().at_m)?;
            let purpose = spot.get_ref().purpose;
            if let Some(what) = checked.misfit(&format!("place '{name}'"), place, purpose) {
                return Err(Misfit::at(&spot, what));
            }
            checked.places.insert(name, Spot { place, purpose });
        }
        Ok(checked)
    }

    fn site(&self) -> Result<Site, Misfit> {
        let OriginTable {
            latitude,
            longitude,
        } = *self.origin.get_ref();
        let origin = Site::at(latitude, longitude);
        let origin = origin.map_err(|what| Misfit::at(&self.origin, what.to_string()));
        let mut site = origin?;
        if let Some(text) = &self.crossing.reference {
            let named = crossing_named(text.get_ref());
            let named = named.map_err(|error| Misfit::at(text, error.to_string()))?;
            (site.crossing, site.map_place) = (named.0, Some(named.1));
        }
        if let Some(text) = &self.crossing.map_place {
            let named = text.get_ref().parse();
            site.map_place = Some(named.map_err(|error: crossguard_codec::NoMapPlace| {
                Misfit::at(text, error.to_string())
            })?);
        }
        Ok(site)
    }
}

impl CrossingTable {
    fn kerbs(&self) -> Result<Option<[[Place; 2]; 2]>, Misfit> {
        let Some(kerbs) = &self.kerbs_m else {
            return Ok(None);
        };
        let [near, far] = &kerbs.get_ref()[..] else {
            let what = format!(
                "2 kerbs are wanted, not {}: the two edges of the carriageway, each from one place to another; a site \
                 without a crossing has no 'kerbs_m'",
                kerbs.get_ref().len()
            );
            return Err(Misfit::at(kerbs, what));
        };
        let kerb = |Exact([from, to]): &Kerb| {
            let kerb = [located::place(from)?, located::place(to)?];
            if kerb[0].distance(kerb[1]) < 1.0 {
                return Err(Misfit::at(to, "the kerb is shorter than a metre"));
            }
            Ok(kerb)
        };
        Ok(Some([kerb(near)?, kerb(far)?]))
    }
}

impl LaneTable {
    fn check(&self) -> Result<Lane, Misfit> {
        let (from, to) = (located::place(&self.from_m)?, located::place(&self.to_m)?);
        if from.distance(to) < 1.0 {
            let what = format!("lane '{}' is shorter than a metre", self.name);
            return Err(Misfit::at(&self.to_m, what));
        }
        Ok(Lane {
            name: self.name.clone(),
            from,
            to,
            width_m: located::within(&self.width_m, 1.0..=30.0, "m")?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::rows;

    #[test]
    fn the_street_is_a_site() {
        let street = SiteFile::street();
        let map_place = Some("segment 276:12".parse().unwrap());
        let site = Site {
            map_place,
            ..Site::default()
        };
        assert_eq!(street.site, site, "its crossing may be any");
        let facing = |name: &str| street.facing_deg(street.places[name].place);
        let facing = ["near-lane", "far-lane", "near-kerb"].map(facing);
        assert_eq!(facing, [Some(270.0), Some(90.0), None]);
        assert!(street.kerbs.is_some() && street.lanes.len() == 2);
        let lane = |name: &str| {
            let place = street.places[name].place;
            street.lane_at(place).map(|lane| lane.name.clone())
        };
        assert_eq!(lane("near-lane").as_deref(), Some("near"));
        assert_eq!(lane("far-lane").as_deref(), Some("far"));
        assert_eq!(lane("near-kerb"), None);
    }

    /// Replaced text of the street, its replacement, and the error.
    const MISFITS: &str = r#"
latitude = 49    | latitude = 95     | s.toml:5: 95.0101, 8.4124 is no latitude and longitude in degrees
longitude = 8.4124 | longitude = 180.0 | s.toml:5: 49.0101, 180 is no latitude and longitude
longitude = 8.4124 | longitude = 179.99 | s.toml:5: 49.0101, 179.99 is no latitude and longitude
longitude = 8.4124 | longitude = -1e308 | s.toml:5: 49.0101, -1e308 is no latitude and longitude
width_m = 3.5    | width_m = 1e308   | s.toml:20: 1e308 is not possible: 1 to 30 m
width_m = 3.5    | width_m = nan     | s.toml:20: NaN is not possible: 1 to 30 m
[20.0, 1.75]     | [-20.0, 1.75]     | s.toml:19: lane 'near' is shorter than a metre
[-4.0, 2.0]      | [-4.0, 9.0]       | place 'near-lane' is for guarding, and on no lane
[1.0, -1.0]      | [1.0, 1.0]        | place 'near-kerb' is on lane 'near'
[1.0, -1.0]      | [1.0, 1e30]       | is no place: metres east and north
[5.0, 0.0]]      | [-3.0, 0.5]]      | s.toml:10: the kerb is shorter than a metre
[[-3.0, 7.0], [5.0, 7.0]] | [[-3.0, 0.05], [5.0, 0.05]] | s.toml:10: the kerbs are 0.05 m apart: at least 2 m
[[[-3.0, 0.0], [5.0, 0.0]], [[-3.0, 7.0], [5.0, 7.0]]] | [[[0.0, -3.0], [0.0, 5.0]], [[7.0, -3.0], [7.0, 5.0]]] | s.toml:10: lane 'near' leads over a kerb
[[-3.0, 7.0], [5.0, 7.0]] | [[-3.0, 3.5], [5.0, 3.5]] | place 'far-lane' is on lane 'far', which is not between the kerbs
[5.0, 7.0]]      | [5.0, 3.0]]       | s.toml:10: the two kerbs meet, or will within 10 m beside the crossing
[5.0, 7.0]]]     | [5.0, 7.0]], [[0.0, 9.0], [5.0, 9.0]]] | s.toml:10: 2 kerbs are wanted, not 3: the two edges
, [[-3.0, 7.0], [5.0, 7.0]]] | ] | s.toml:10: 2 kerbs are wanted, not 1
# along_m = 10.0 | along_m = -1.0 #  | s.toml:11: -1 is not possible: 1 to 100 m
# along_m = 10.0 | along_m = 0.0 #   | s.toml:11: 0 is not possible: 1 to 100 m
for = "wait"     | for = "rest"      | s.toml:30: unknown variant `rest`
name = "near"    | nam = "near"      | s.toml:17: unknown field `nam`
# reference = "276:4711"       | reference = "0:0"      | s.toml:12: '0:0' is no crossing
map_place = "segment 276:12" | map_place = "street 1" | s.toml:13:
"#;

    #[test]
    fn a_site_that_does_not_fit_is_refused_with_its_line() {
        for [from, to, cause] in rows(MISFITS) {
            assert!(STREET.contains(&from), "{from}");
            let text = STREET.replacen(&from, &to, 1);
            let error = SiteFile::parse("s.toml", "s", &text).unwrap_err();
            assert!(error.to_string().contains(&cause), "{to}: {error}");
        }
        let narrow = STREET.replace("width_m = 3.5", "width_m = 1.0");
        let island = narrow.replacen("[1.0, 8.0]", "[1.0, 3.5]", 1);
        let error = SiteFile::parse("s.toml", "s", &island).unwrap_err();
        let cause = "place 'far-kerb' is between the kerbs";
        assert!(error.to_string().contains(cause), "{error}");
        let (before, lanes) = STREET.split_once("[[lanes]]").unwrap();
        let (_, places) = lanes.split_once("[places]").unwrap();
        let beside = places.replacen("[-4.0, 2.0]", "[-4.0, 9.0]", 1);
        let without_lanes =
            |places: &str| SiteFile::parse("s.toml", "s", &format!("{before}[places]{places}"));
        assert!(without_lanes(places).is_ok());
        let error = without_lanes(&beside).unwrap_err();
        let cause = "place 'near-lane' is not between the kerbs";
        assert!(error.to_string().contains(cause), "{error}");
    }
}
