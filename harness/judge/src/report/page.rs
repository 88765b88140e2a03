//! The page itself.

use std::collections::BTreeSet;
use std::time::{Duration, UNIX_EPOCH};

use crossguard_robot::around::Nearest;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::collect::Run;
use super::{Report, Validity, bounds, messages, people, street, timeline};
use crate::timing::{Statistic, Summary, offsets_in_words};
use crate::verdict;

const STYLE: &str = include_str!("style.css");

/// Nothing is loaded from anywhere, and nothing runs.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'";

/// The page of a run.
pub(super) fn page(report: &Report, run: &Run) -> Markup {
    let street = street::street(run, report.site);
    let sections = [
        ("states", "States", Some(timeline::timeline(run))),
        (
            "map",
            "Map",
            Some(street.unwrap_or_else(|| html! { p { "No robot says where it is." } })),
        ),
        ("people", "People", people::table(run)),
        ("around", "Who was around", around(run)),
        ("times", "Times", Some(times(report, run))),
        ("bounds", "Longest times", bounds::table(run)),
        ("nothing", "Dropped or ignored", Some(counters(run))),
        ("properties", "Properties", properties(report)),
        ("robots", "Robots", Some(robots(run))),
        (
            "sequence",
            "Sequence of messages",
            Some(messages::messages(&run.playback)),
        ),
    ];
    let sections: Vec<_> = sections
        .into_iter()
        .filter_map(|(id, name, it)| Some((id, name, it?)))
        .collect();
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="generator" content=(concat!("crossguard ", env!("CARGO_PKG_VERSION")));
                title { (report.title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { (report.title) }
                    p.faint { (when(run)) }
                    (outcome(report))
                    nav aria-label="Contents" { ul {
                        @for (id, name, _) in &sections { li { a href=(format!("#{id}")) { (name) } } }
                    } }
                }
                main {
                    @for (id, name, section) in &sections {
                        section id=(id) aria-labelledby=(format!("{id}-title")) {
                            h2 id=(format!("{id}-title")) { (name) }
                            (section)
                        }
                    }
                }
                footer {
                    p { "Made by Crossguard " (env!("CARGO_PKG_VERSION")) " of " (report.logs.join(", ")) "." }
                }
            }
        }
    }
}

fn when(run: &Run) -> String {
    let began = UNIX_EPOCH + Duration::from_micros(run.from_us);
    let lasted = Duration::from_micros(run.to_us.saturating_sub(run.from_us));
    let names: Vec<_> = run.robots.iter().map(|robot| robot.name.as_str()).collect();
    format!(
        "{} · {:.1} s · {}",
        humantime::format_rfc3339_seconds(began)
            .to_string()
            .replace('T', " ")
            .replace('Z', " UTC"),
        lasted.as_secs_f64(),
        names.join(", ")
    )
}

fn outcome(report: &Report) -> Markup {
    let (class, word) = match report.outcome() {
        Validity::Valid => ("valid", "✓ Valid"),
        Validity::Incomplete => ("incomplete", "! Valid, and not all of it is there"),
        Validity::Invalid if report.finding.is_some() => ("invalid", "✗ A property was broken"),
        Validity::Invalid => ("invalid", "✗ Not valid"),
    };
    html! {
        div.verdict.(class) role="status" {
            strong { (word) }
            @if let Some(finding) = report.finding { p { (finding) } }
            @match report.verdict {
                Ok(valid) => {
                    (verdict::sentences(valid).join(" "))
                }
                Err(invalid) => { (invalid) "." }
            }
            @if let Some(command) = report.reproduce { p { "It runs again by " code { (command) } } }
        }
    }
}

fn times(report: &Report, run: &Run) -> Markup {
    let summaries = run.timing.summaries(report.time_scale);
    let time_scale = report.time_scale.unwrap_or(run.timing.time_scale());
    if summaries.is_empty() {
        return html! { p { "No maneuver was completed." } };
    }
    html! {
        div.scroll tabindex="0" role="group" aria-label="Times of maneuvers" {
            table {
                thead { tr {
                    th scope="col" { "maneuver" } th.n scope="col" { "completed" } th.n scope="col" { "T_neg [s]" }
                    th.n scope="col" { "round trip [s]" } th.n scope="col" { "T_exec [s]" } th.n scope="col" { "T_TMCT [s]" }
                } }
                tbody { @for summary in &summaries { (time_row(summary)) } }
            }
        }
        p.faint {
            "T_neg: from the leader's first transmission of the command to its reception at the follower, one way. "
            "Round trip: from that transmission to the acknowledgement. T_exec: from its start at the follower to its "
            "end, in the robots' own time" @if time_scale > 1.0 { ", which passes " (time_scale) " times as fast" }
            ". T_TMCT = T_neg + T_exec. Mean ± standard deviation."
        }
        @for line in offsets_in_words(&run.timing, report.logs) { p.faint { (line) "." } }
    }
}

fn time_row(summary: &Summary) -> Markup {
    let statistic =
        |it: Statistic, digits: usize| format!("{:.digits$} ± {:.digits$}", it.mean, it.sd);
    html! {
        tr {
            th scope="row" { (summary.task) }
            td.n { (summary.trials) }
            td.n { (statistic(summary.t_neg_s, 4)) }
            td.n { (statistic(summary.round_trip_s, 4)) }
            td.n { (statistic(summary.t_exec_s, 2)) }
            td.n { (statistic(summary.t_tmct_s, 3)) }
        }
        @if let Some(paper) = &summary.paper {
            tr.faint {
                th scope="row" { (summary.task) " in the paper" }
                td.n { (paper.trials) }
                td.n { (statistic(paper.t_neg_s, 3)) }
                td.n {}
                td.n { (format!("{:.2}", paper.t_exec_s)) }
                td.n { (statistic(paper.t_tmct_s, 3)) }
            }
        }
    }
}

/// Who was around each robot; nothing where no robot had anybody on its map.
fn around(run: &Run) -> Option<Markup> {
    let rows = || {
        let robots = run.robots.iter();
        robots.flat_map(|robot| robot.around.0.iter().map(move |of_kind| (robot, of_kind)))
    };
    rows().next()?;
    let seconds = |us: u64| Duration::from_micros(us.saturating_sub(run.from_us)).as_secs_f64();
    Some(html! {
        div.scroll tabindex="0" role="group" aria-label="Who was around" {
            table {
                thead { tr {
                    th scope="col" { "robot" } th scope="col" { "kind" } th.n scope="col" { "at a time" }
                    th scope="col" { "nearest" } th.n scope="col" { "longest without news [s]" }
                    th scope="col" { "on the map [s]" }
                } }
                tbody {
                    @for (robot, of_kind) in rows() {
                        tr {
                            th scope="row" { (robot.name) }
                            td { (of_kind.kind) }
                            td.n { (of_kind.most) }
                            td { @if let Some((Nearest { who, distance_m }, at_us)) = of_kind.nearest {
                                (who) ", " (format!("{distance_m:.1} m at {:.1} s", seconds(at_us)))
                            } @else { "no distance is known" } }
                            td.n { (format!("{:.1}", Duration::from_millis(of_kind.oldest_ms).as_secs_f64())) }
                            td { (format!("{:.1} to {:.1}", seconds(of_kind.from_us), seconds(of_kind.to_us))) }
                        }
                    }
                }
            }
        }
        p.faint { "From the local dynamic map, once a second: the robots, vehicles, people and clusters that RAM, CAM, VAM and CPM told of. Times are seconds since the beginning." }
    })
}

fn counters(run: &Run) -> Markup {
    let causes: BTreeSet<_> = run
        .robots
        .iter()
        .flat_map(|robot| robot.counters.keys())
        .collect();
    if causes.is_empty() {
        return html! { p { "Nothing." } };
    }
    html! {
        p { "Every message and event without effect, by its cause. Most are repetitions, which is how the protocol works." }
        div.scroll tabindex="0" role="group" aria-label="Counters" {
            table {
                thead { tr {
                    th scope="col" { "layer" }
                    th scope="col" { "cause" }
                    @for robot in &run.robots { th.n scope="col" { (robot.name) } }
                } }
                tbody {
                    @for cause in causes {
                        tr {
                            td { (cause.layer) }
                            th scope="row" { (cause.reason) }
                            @for robot in &run.robots { td.n { (robot.counters.get(cause).copied().unwrap_or(0)) } }
                        }
                    }
                }
            }
        }
    }
}

/// What became of each property; nothing where the logs could not be judged by them.
fn properties(report: &Report) -> Option<Markup> {
    let properties = verdict::properties(report.verdict);
    if properties.is_empty() {
        return None;
    }
    Some(html! {
        div.scroll tabindex="0" role="group" aria-label="Properties" {
            table {
                thead { tr { th scope="col" { "property" } th scope="col" { "verdict" } th scope="col" { "what it says" } } }
                tbody {
                    @for property in properties {
                        tr {
                            th scope="row" { (property.id) }
                            td { @if property.is_broken { "✗ broken" } @else { "✓ kept" } }
                            td { (property.statement) }
                        }
                    }
                }
            }
        }
        p.faint { "Properties that had nothing to say in this run are left out." }
    })
}

fn robots(run: &Run) -> Markup {
    html! {
        div.scroll tabindex="0" role="group" aria-label="Robots" {
            table {
                thead { tr {
                    th scope="col" { "robot" } th scope="col" { "station" } th scope="col" { "boots" } th.n scope="col" { "sent" }
                    th.n scope="col" { "heard" } th.n scope="col" { "lost on the way" } th.n scope="col" { "records" }
                    th scope="col" { "in the end" }
                } }
                tbody {
                    @for robot in &run.robots {
                        tr {
                            th scope="row" { (robot.name) }
                            td { (list(&robot.stations)) }
                            td { (list(&robot.boots)) }
                            td.n { (robot.sent) }
                            td.n { (robot.heard) }
                            td.n { (robot.lost) }
                            td.n { (robot.records) }
                            td {
                                @if let Some(last) = robot.states.last() { (format!("{:?}", last.what.state)) }
                                @if robot.has_stopped { ", stopped in order" } @else { ", cut off" }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn list(items: &[impl ToString]) -> String {
    items
        .iter()
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join(", ")
}
