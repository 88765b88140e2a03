//! A site and a plan to scale: a picture in SVG, and a text.
//!
//! The picture has lanes with the direction of their traffic, kerbs, places, the way of each role from stage to stage,
//! and around each target the distance that bodies are kept apart by.

use std::fmt::Write;

use crossguard_robot::plan::Who;
use crossguard_robot::plan_file::{APART_M, PlanFile, Role};
use crossguard_robot::site::Place;
use crossguard_robot::site_file::{Lane, Purpose, SiteFile};

use labels::{Label, Labels};

mod labels;

/// Pixels for a metre.
const SCALE: f64 = 32.0;

/// How much of the site is shown around its places, in metres.
const MARGIN_M: f64 = 2.5;

/// How much more to the east, for the labels there, in metres.
const LABEL_M: f64 = 3.0;

/// Colours of roles, in their order.
const COLOURS: [&str; 6] = [
    "#0b6e4f", "#1d4e89", "#b3541e", "#6a3d9a", "#8c2d04", "#2f4858",
];

/// What of the site is shown.
struct Frame {
    west: f64,
    north: f64,
    width_m: f64,
    height_m: f64,
}

impl Frame {
    fn around(places: &[Place]) -> Self {
        let east = places.iter().map(|place| place.east);
        let north = places.iter().map(|place| place.north);
        let least = |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(f64::INFINITY, f64::min);
        let most =
            |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(f64::NEG_INFINITY, f64::max);
        let (west, south) = (least(&mut east.clone()), least(&mut north.clone()));
        let (east, north) = (most(&mut { east }), most(&mut { north }));
        Self {
            west: west - MARGIN_M,
            north: north + MARGIN_M,
            width_m: east - west + 2.0 * MARGIN_M + LABEL_M,
            height_m: north - south + 2.0 * MARGIN_M,
        }
    }

    fn at(&self, place: Place) -> (f64, f64) {
        (
            (place.east - self.west) * SCALE,
            (self.north - place.north) * SCALE,
        )
    }
}

/// What a file says may contain what means something in SVG.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

/// The ways of the roles: where each is before, and the targets of its stages, with their numbers and tasks.
fn ways(plan: &PlanFile) -> Vec<(&Role, Vec<(String, Place)>)> {
    let followers = plan.roles.iter().filter(|role| !role.leads);
    let followers = followers.enumerate().map(|(seat, role)| {
        let legs = (1..).zip(&plan.stages).filter_map(|(number, stage)| {
            let mut parts = stage.parts.iter();
            let (_, leg) = parts.find(|(who, _)| *who == Who::Role(seat))?;
            Some((format!("{number} {}", leg.task), leg.to))
        });
        (role, legs.collect())
    });
    let leaders = plan.roles.iter().filter(|role| role.leads);
    let leaders = leaders.map(|role| {
        let stands = role.stands.map(|place| ("leads".to_owned(), place));
        (role, Vec::from_iter(stands))
    });
    leaders.chain(followers).collect()
}

/// The picture.
#[must_use]
pub fn svg(site: &SiteFile, plan: Option<&PlanFile>) -> String {
    let ways = plan.map(ways).unwrap_or_default();
    let mut places: Vec<_> = site.kerbs.iter().flatten().copied().collect();
    places.extend(site.places.values().map(|spot| spot.place));
    for (role, way) in &ways {
        places.extend(role.waits);
        places.extend(way.iter().map(|(_, place)| *place));
    }
    places.push(Place::default());
    let frame = Frame::around(&places);
    let (width, height) = (frame.width_m * SCALE, frame.height_m * SCALE + 56.0);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#f4f1ea\"/>\n"
    );
    for lane in &site.lanes {
        draw_lane(&mut out, &frame, lane);
    }
    let mut labels = Labels::new(width, frame.height_m * SCALE);
    for [from, to] in &site.kerbs {
        let ((x1, y1), (x2, y2)) = (frame.at(*from), frame.at(*to));
        labels.keep_off_line((x1, y1), (x2, y2));
        let _ = writeln!(
            out,
            "<line class=\"kerb\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"#333\" stroke-width=\"5\"/>"
        );
    }
    for ((role, way), colour) in ways.iter().zip(COLOURS.iter().cycle()) {
        draw_way(&mut out, &mut labels, &frame, role, way, colour);
    }
    for (name, spot) in &site.places {
        draw_place(
            &mut out,
            &mut labels,
            &frame,
            name,
            spot.place,
            spot.purpose,
        );
    }
    labels.draw(&mut out);
    draw_legend(&mut out, &frame, site, plan);
    out.push_str("</svg>\n");
    out
}

fn draw_lane(out: &mut String, frame: &Frame, lane: &Lane) {
    let ((x1, y1), (x2, y2)) = (frame.at(lane.from), frame.at(lane.to));
    let width = lane.width_m * SCALE;
    let inside = width - 2.0;
    let _ = writeln!(
        out,
        "<line class=\"lane\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"#fff\" stroke-width=\"{width:.1}\"/>\n\
         <line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"#c9c9c9\" stroke-width=\"{inside:.1}\"/>"
    );
    // An arrow says in which direction its traffic goes.
    let middle = lane
        .from
        .towards(lane.to, lane.from.distance(lane.to) * 0.5);
    let tip = frame.at(middle.towards(lane.to, 0.6));
    let side = |metres: f64| {
        let along = lane.from.bearing(lane.to).to_radians();
        let (east, north) = (along.cos(), -along.sin());
        frame.at(Place::new(
            middle.east + metres * east,
            middle.north + metres * north,
        ))
    };
    let (left, right) = (side(-0.3), side(0.3));
    let name = escaped(&lane.name);
    let _ = writeln!(
        out,
        "<polygon points=\"{:.1},{:.1} {:.1},{:.1} {:.1},{:.1}\" fill=\"#777\"><title>lane {name}</title></polygon>",
        tip.0, tip.1, left.0, left.1, right.0, right.1
    );
}

fn draw_place(
    out: &mut String,
    labels: &mut Labels,
    frame: &Frame,
    name: &str,
    place: Place,
    purpose: Purpose,
) {
    let (x, y) = frame.at(place);
    let fill = match purpose {
        Purpose::Wait => "#9aa5b1",
        Purpose::Guard => "#c0392b",
        Purpose::Cross => "#27ae60",
    };
    let _ = writeln!(
        out,
        "<rect class=\"place\" x=\"{:.1}\" y=\"{:.1}\" width=\"8\" height=\"8\" fill=\"{fill}\"/>",
        x - 4.0,
        y - 4.0,
    );
    labels.keep_off((x, y), 4.0);
    labels.add(Label {
        at: (x, y),
        gap: 6.0,
        size: 10.0,
        colour: "#444",
        text: name.to_owned(),
    });
}

fn draw_way(
    out: &mut String,
    labels: &mut Labels,
    frame: &Frame,
    role: &Role,
    way: &[(String, Place)],
    colour: &'static str,
) {
    let mut points: Vec<_> = role.waits.iter().map(|place| frame.at(*place)).collect();
    points.extend(way.iter().map(|(_, place)| frame.at(*place)));
    let line: Vec<_> = points
        .iter()
        .map(|(x, y)| format!("{x:.1},{y:.1}"))
        .collect();
    let _ = writeln!(
        out,
        "<polyline class=\"way\" points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2.5\"/>",
        line.join(" ")
    );
    for leg in points.windows(2) {
        labels.keep_off_line(leg[0], leg[1]);
    }
    let mut label = |at, gap, text| {
        labels.keep_off(at, gap - 2.0);
        labels.add(Label {
            at,
            gap,
            size: 12.0,
            colour,
            text,
        });
    };
    let radius = APART_M / 2.0 * SCALE;
    for (nth, (_, place)) in way.iter().enumerate() {
        let (x, y) = frame.at(*place);
        let _ = writeln!(
            out,
            "<circle class=\"target\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\" fill=\"{colour}\" fill-opacity=\"0.15\" stroke=\"{colour}\"/>"
        );
        // The first stage at a place names the others there.
        if way[..nth].iter().all(|(_, before)| before != place) {
            let here = way.iter().filter(|(_, other)| other == place);
            let here: Vec<_> = here.map(|(what, _)| what.as_str()).collect();
            let text = format!("{}: {}", role.name, here.join(", "));
            label((x, y), radius + 2.0, text);
        }
    }
    if let Some((x, y)) = role.waits.map(|place| frame.at(place)) {
        let _ = writeln!(
            out,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"6\" fill=\"{colour}\"/>"
        );
        label((x, y), 9.0, role.name.clone());
    }
}

fn draw_legend(out: &mut String, frame: &Frame, site: &SiteFile, plan: Option<&PlanFile>) {
    let y = frame.height_m * SCALE + 14.0;
    let end = 10.0 + 5.0 * SCALE;
    let title = plan.map_or(String::new(), |plan| format!(", plan {}", plan.name));
    let title = escaped(&format!("site {}{title}", site.name));
    let summary = plan.map_or(String::new(), |plan| escaped(&plan.summary));
    let _ = writeln!(
        out,
        "<line x1=\"10\" y1=\"{y:.0}\" x2=\"{end:.0}\" y2=\"{y:.0}\" stroke=\"#000\" stroke-width=\"3\"/>\n\
         <text x=\"{:.0}\" y=\"{:.0}\">5 m; north is up; a circle is {APART_M} m wide</text>\n\
         <text x=\"10\" y=\"{:.0}\" font-weight=\"bold\">{title}</text>\n\
         <text x=\"10\" y=\"{:.0}\" font-size=\"11\">{summary}</text>",
        end + 8.0,
        y + 4.0,
        y + 20.0,
        y + 35.0
    );
}

/// The same as a text.
#[must_use]
pub fn text(site: &SiteFile, plan: Option<&PlanFile>) -> String {
    let mut out = format!(
        "site {} at {:.6}, {:.6}\n",
        site.name, site.site.latitude, site.site.longitude
    );
    for lane in &site.lanes {
        let bearing = lane.from.bearing(lane.to);
        let (name, width) = (&lane.name, lane.width_m);
        let _ = writeln!(
            out,
            "  lane {name}: {width} m wide, traffic towards {bearing:.0} degrees"
        );
    }
    for (name, spot) in &site.places {
        let Place { east, north } = spot.place;
        let purpose = match spot.purpose {
            Purpose::Wait => "wait",
            Purpose::Guard => "guard",
            Purpose::Cross => "cross",
        };
        let _ = writeln!(out, "  {name:<20} {east:>7.2} {north:>7.2}  {purpose}");
    }
    let Some(plan) = plan else { return out };
    let _ = writeln!(out, "plan {}: {}", plan.name, plan.summary);
    for (role, way) in ways(plan) {
        let waits = role.waits.map(|place| ("waits".to_owned(), place));
        for (what, Place { east, north }) in waits.into_iter().chain(way) {
            let name = &role.name;
            let _ = writeln!(out, "  {name:<20} {east:>7.2} {north:>7.2}  {what}");
        }
    }
    out
}
