//! The crossing from above: ways of the robots, and where they were to go.

use crossguard_protocol::TaskType;
use crossguard_robot::site::{Place, Site};
use crossguard_robot::site_file::SiteFile;
use maud::{Markup, html};

use super::charts::{Look, number, step};
use super::collect::Run;
use super::people;
use crate::facts::Area;

/// Width of the picture, largest height, and room around what it shows, in pixels.
const WIDTH: f64 = 640.0;
const HEIGHT_MAX: f64 = 520.0;
const MARGIN: f64 = 56.0;

/// The smallest stretch of street that is shown, in metres.
const EXTENT_MIN_M: f64 = 6.0;

/// How wide the way of an escort is drawn, in metres.
const WAY_M: f64 = 1.5;

/// From degrees to pixels.
struct Projection {
    site: Site,
    west: f64,
    north: f64,
    pixels_per_m: f64,
    height: f64,
}

impl Projection {
    fn of(run: &Run, street: Option<&SiteFile>) -> Option<Self> {
        let ways = run.robots.iter().flat_map(|robot| robot.way.iter());
        let goals = run.areas.iter().map(|area| &area.to);
        let people = run.robots.iter().flat_map(|robot| robot.people.points());
        let points: Vec<_> = ways.chain(goals).chain(people).copied().collect();
        let &(latitude, longitude) = points.first()?;
        let site = street.map_or_else(
            || Site {
                latitude,
                longitude,
                ..Site::default()
            },
            |street| street.site,
        );
        let mut places: Vec<_> = points.iter().map(|at| site.place(at.0, at.1)).collect();
        places.extend(
            street
                .iter()
                .flat_map(|street| street.kerbs.iter().flatten()),
        );
        let range = |of: fn(&Place) -> f64| {
            let values = places.iter().map(of);
            let (min, max) = values.fold((f64::MAX, f64::MIN), |(min, max), it| {
                (min.min(it), max.max(it))
            });
            let lacking = (EXTENT_MIN_M - (max - min)).max(0.0) / 2.0;
            (min - lacking, max + lacking)
        };
        let (west, east) = range(|place| place.east);
        let (south, north) = range(|place| place.north);
        let room = (WIDTH - 2.0 * MARGIN, HEIGHT_MAX - 2.0 * MARGIN);
        let pixels_per_m = (room.0 / (east - west)).min(room.1 / (north - south));
        // What is narrower than the picture stands in its middle.
        let spare = room.0 / pixels_per_m - (east - west);
        Some(Self {
            site,
            west: west - spare / 2.0,
            north,
            pixels_per_m,
            height: (north - south) * pixels_per_m + 2.0 * MARGIN,
        })
    }

    fn pixel(&self, (latitude, longitude): (f64, f64)) -> (f64, f64) {
        self.pixel_of(self.site.place(latitude, longitude))
    }

    /// The pixel of a place on the site.
    fn pixel_of(&self, place: Place) -> (f64, f64) {
        (
            MARGIN + (place.east - self.west) * self.pixels_per_m,
            MARGIN + (self.north - place.north) * self.pixels_per_m,
        )
    }
}

/// The map; `None` where no robot says where it is.
pub(super) fn street(run: &Run, site: Option<&SiteFile>) -> Option<Markup> {
    let view = Projection::of(run, site)?;
    let bar_m = step(WIDTH / view.pixels_per_m, 6.0);
    let bar = bar_m * view.pixels_per_m;
    Some(html! {
        div.scroll tabindex="0" role="group" aria-label="Map of the crossing" {
            svg.map role="img" aria-labelledby="map-title map-text" viewBox=(format!("0 0 {WIDTH} {:.0}", view.height))
                width=(WIDTH) height=(format!("{:.0}", view.height)) {
                title id="map-title" { "The crossing from above" }
                desc id="map-text" { (description(run)) }
                rect.street width="100%" height="100%" {}
                (road(&view, site))
                (people::zones(run, |at| view.pixel(at)))
                (grid(&view, bar_m))
                @for area in &run.areas { (place(&view, area)) }
                @for (number, robot) in run.robots.iter().enumerate() { (way(&view, Look::of(number), &robot.way)) }
                (people::people(run, |at| view.pixel(at)))
                (names(run, &view))
                path.scale d=(format!("M16 {y:.1}v6h{bar:.1}v-6", y = view.height - 26.0)) {}
                text x=(format!("{:.1}", 22.0 + bar)) y=(format!("{:.1}", view.height - 18.0)) { (number(bar_m)) " m" }
                path.north d="M616 44v-26m-6 9l6 -9l6 9" {}
                text x="616" y="58" text-anchor="middle" { "N" }
            }
        }
        ul.legend {
            @if site.is_some_and(|site| !site.kerbs.is_empty()) {
                li { svg.key viewBox="0 0 44 20" width="44" height="20" aria-hidden="true" { path.kerb d="M2 10H42" {} }
                    "kerb between which people cross" }
            }
            @for (number, robot) in run.robots.iter().enumerate() {
                @let look = Look::of(number);
                li {
                    svg.key viewBox="0 0 44 20" width="44" height="20" aria-hidden="true" {
                        path.way d="M2 10H42" stroke=(look.color) stroke-dasharray=(look.dashes) {}
                        path d=(look.outline((34.0, 10.0))) fill=(look.color) {}
                    }
                    (robot.name) ": hollow where it began, filled where it ended"
                }
            }
            @if run.areas.iter().any(|area| area.task == TaskType::MOVE) {
                li { svg.key viewBox="0 0 44 20" width="44" height="20" aria-hidden="true" { rect.corridor x="2" y="3" width="40" height="14" {} }
                    "way along which the pedestrian is escorted" }
            }
            li { svg.key viewBox="0 0 44 20" width="44" height="20" aria-hidden="true" { circle.goal cx="22" cy="10" r="8" {} }
                "place that a follower was commanded to" }
            (people::legend(run))
        }
    })
}

/// Lanes and kerbs.
fn road(view: &Projection, site: Option<&SiteFile>) -> Markup {
    let line = |from: Place, to: Place| {
        let ((x1, y1), (x2, y2)) = (view.pixel_of(from), view.pixel_of(to));
        format!("M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}")
    };
    html! {
        @for lane in site.iter().flat_map(|site| &site.lanes) {
            path.lane d=(line(lane.from, lane.to)) stroke-width=(format!("{:.1}", lane.width_m * view.pixels_per_m)) {
                title { "lane " (lane.name) }
            }
            path.lane-middle d=(line(lane.from, lane.to)) {}
        }
        @for kerb in site.iter().flat_map(|site| &site.kerbs) {
            path.kerb d=(line(kerb[0], kerb[1])) {}
        }
    }
}

fn description(run: &Run) -> String {
    let robots = run.robots.iter().map(|robot| {
        let metres = length(&robot.way);
        format!("{} went {metres:.1} m", robot.name)
    });
    let goals = run.areas.iter().map(|area| {
        format!(
            "{} was commanded to {}",
            run.name_of(area.follower),
            area.task
        )
    });
    robots.chain(goals).collect::<Vec<_>>().join("; ")
}

fn length(way: &[(f64, f64)]) -> f64 {
    let pairs = way.windows(2);
    let metres = pairs.map(|pair| {
        let site = Site {
            latitude: pair[0].0,
            longitude: pair[0].1,
            ..Site::default()
        };
        site.place(pair[1].0, pair[1].1).distance(Place::default())
    });
    metres.sum()
}

fn grid(view: &Projection, step_m: f64) -> Markup {
    let step = step_m * view.pixels_per_m;
    let lines = |until: f64| {
        let first = MARGIN % step;
        // Never so fine that the page grows with it.
        (0..100_u8)
            .map(move |number| first + f64::from(number) * step)
            .take_while(move |at| *at < until)
    };
    let across = lines(view.height).map(|y| format!("M0 {y:.1}H{WIDTH}"));
    let along = lines(WIDTH).map(|x| format!("M{x:.1} 0V{:.1}", view.height));
    html! { path.grid d=(across.chain(along).collect::<String>()) {} }
}

fn place(view: &Projection, area: &Area) -> Markup {
    let to = view.pixel(area.to);
    match area.from.map(|from| view.pixel(from)) {
        Some(from) if area.task == TaskType::MOVE => html! {
            path.corridor-way d=(format!("M{:.1} {:.1}L{:.1} {:.1}", from.0, from.1, to.0, to.1))
                stroke-width=(format!("{:.1}", WAY_M * view.pixels_per_m)) {}
        },
        _ => html! {
            circle.goal cx=(format!("{:.1}", to.0)) cy=(format!("{:.1}", to.1)) r="13" {
                title { (area.task) }
            }
        },
    }
}

fn way(view: &Projection, look: Look, way: &[(f64, f64)]) -> Markup {
    let points: Vec<_> = way.iter().map(|at| view.pixel(*at)).collect();
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return html! {};
    };
    let line: Vec<_> = points
        .iter()
        .map(|(x, y)| format!("{x:.1} {y:.1}"))
        .collect();
    html! {
        path.way d=(format!("M{}", line.join("L"))) stroke=(look.color) stroke-dasharray=(look.dashes) {}
        path.first d=(look.outline(*first)) stroke=(look.color) {}
        path.last d=(look.outline(*last)) fill=(look.color) {}
    }
}

/// The names beside where the robots ended, none over another.
fn names(run: &Run, view: &Projection) -> Markup {
    let mut taken: Vec<(f64, f64)> = Vec::new();
    let ends = run.robots.iter().filter_map(|robot| {
        let (x, y) = view.pixel(*robot.way.last()?);
        Some((robot, x, y))
    });
    let mut names = Vec::new();
    for (robot, x, y) in ends {
        let (x, mut y) = (x + 16.0, y + 5.0);
        while taken
            .iter()
            .any(|(x2, y2)| (x2 - x).abs() < 90.0 && (y2 - y).abs() < 16.0)
        {
            y += 16.0;
        }
        taken.push((x, y));
        names.push((robot, x, y));
    }
    html! {
        @for (robot, x, y) in names {
            text.name x=(format!("{x:.1}")) y=(format!("{y:.1}")) { (robot.name) }
        }
    }
}
