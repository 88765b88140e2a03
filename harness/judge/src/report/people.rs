//! The people at a crossing, on the map and in numbers.

use std::collections::BTreeSet;

use crossguard_robot::sight::Degrees;
use crossguard_robot::zone::Conduct;
use maud::{Markup, html};

use super::collect::Run;

/// How a conduct is called.
const fn words(conduct: Conduct) -> &'static str {
    match conduct {
        Conduct::Elsewhere => "elsewhere",
        Conduct::Passing => "in the zone",
        Conduct::Waiting => "waits to cross",
        Conduct::OnRoad => "on the road",
        Conduct::Across => "across",
    }
}

/// The class of the style of a conduct.
const fn class(conduct: Conduct) -> &'static str {
    match conduct {
        Conduct::Elsewhere => "elsewhere",
        Conduct::Passing => "passing",
        Conduct::Waiting => "waiting",
        Conduct::OnRoad => "on-road",
        Conduct::Across => "across",
    }
}

/// The zones below everything else on the map.
pub(super) fn zones(run: &Run, pixel: impl Fn(Degrees) -> (f64, f64)) -> Markup {
    html! {
        @for robot in &run.robots {
            (outline("zone-road", &robot.people.zone.road, &pixel))
            (outline("zone", &robot.people.zone.waiting, &pixel))
        }
    }
}

/// People and their clusters.
pub(super) fn people(run: &Run, pixel: impl Fn(Degrees) -> (f64, f64)) -> Markup {
    html! {
        @for robot in &run.robots {
            @for cluster in robot.people.clusters.values() {
                (outline("cluster", &cluster.corners, &pixel))
            }
            @for (place, conduct) in &robot.people.places {
                @let (x, y) = pixel(*place);
                circle.person.(class(*conduct)) cx=(format!("{x:.1}")) cy=(format!("{y:.1}")) r=(radius(*conduct)) {}
            }
        }
    }
}

/// People who matter most are drawn largest.
const fn radius(conduct: Conduct) -> &'static str {
    match conduct {
        Conduct::Elsewhere | Conduct::Passing => "2",
        Conduct::OnRoad | Conduct::Across => "3",
        Conduct::Waiting => "5",
    }
}

fn outline(class: &str, corners: &[Degrees], pixel: impl Fn(Degrees) -> (f64, f64)) -> Markup {
    if corners.is_empty() {
        return html! {};
    }
    let points = corners.iter().map(|corner| {
        let (x, y) = pixel(*corner);
        format!("{x:.1} {y:.1}")
    });
    let points = points.collect::<Vec<_>>().join("L");
    html! { path.(class) d=(format!("M{points}Z")) {} }
}

/// What the signs on the map mean.
pub(super) fn legend(run: &Run) -> Markup {
    let people = || run.robots.iter().map(|robot| &robot.people);
    let has_zone = people().any(|it| !it.zone.waiting.is_empty());
    let has_road = people().any(|it| !it.zone.road.is_empty());
    let has_clusters = people().any(|it| !it.clusters.is_empty());
    let conducts: BTreeSet<_> = people()
        .flat_map(|it| &it.places)
        .map(|(_, conduct)| *conduct)
        .collect();
    let area = |class: &str| {
        html! {
            svg.key viewBox="0 0 44 20" width="44" height="20" aria-hidden="true" { rect.(class) x="2" y="3" width="40" height="14" {} }
        }
    };
    html! {
        @if has_zone { li { (area("zone")) "crossing zone" } }
        @if has_road { li { (area("zone-road")) "its part of the road" } }
        @if has_clusters { li { (area("cluster")) "cluster of people in RAM, as announced while they waited" } }
        @for conduct in conducts {
            li {
                svg.key viewBox="0 0 44 20" width="44" height="20" aria-hidden="true" {
                    circle.person.(class(conduct)) cx="22" cy="10" r=(radius(conduct)) {}
                }
                "person: " (words(conduct))
            }
        }
    }
}

/// The people in numbers; nothing where no robot had any.
pub(super) fn table(run: &Run) -> Option<Markup> {
    let robots: Vec<_> = run
        .robots
        .iter()
        .filter(|robot| !robot.people.is_empty())
        .collect();
    if robots.is_empty() {
        return None;
    }
    #[expect(clippy::cast_precision_loss, reason = "centuries of microseconds fit")]
    let seconds = |us: u64| format!("{:.1}", us.saturating_sub(run.from_us) as f64 / 1e6);
    Some(html! {
        div.scroll tabindex="0" role="group" aria-label="People at the crossing" {
            table {
                thead { tr {
                    th scope="col" { "robot" } th.n scope="col" { "road users at a time" } th scope="col" { "waited to cross [s]" }
                    th scope="col" { "clusters in RAM: people [s]" } th scope="col" { "corridor open [s]" }
                } }
                tbody {
                    @for robot in robots {
                        @let people = &robot.people;
                        tr {
                            th scope="row" { (robot.name) }
                            td.n { (people.most) }
                            td { @for span in &people.waiting {
                                div { (span.what) ": " (seconds(span.from_us)) " to " (seconds(span.to_us)) }
                            } }
                            td { @for span in &people.announced {
                                div { (span.what) ": " (seconds(span.from_us)) " to " (seconds(span.to_us)) }
                            } }
                            td { @for span in &robot.corridor {
                                div { (seconds(span.from_us)) " to " (seconds(span.to_us)) }
                            } }
                        }
                    }
                }
            }
        }
        p.faint { "Times are seconds since the beginning. The log of a robot has places of people, and nothing that tracks them." }
    })
}
