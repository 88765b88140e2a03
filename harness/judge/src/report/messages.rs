//! The sequence of messages: a row for each broadcast with all robots that heard it, trial by trial.

use std::fmt::Write as _;
use std::time::Duration;

use maud::{Markup, PreEscaped, html};

use super::charts::Look;
use crate::playback::{MessageRow, Overview, Playback, Stretch, Trial};

/// How many rows of a part are shown at its beginning, and at its end.
const ROWS: usize = 200;

/// The height of a row, in pixels.
const HEIGHT: f64 = 24.0;

/// A stretch of the run with its rows.
struct Part {
    name: String,
    rows: Vec<MessageRow>,
}

/// The section of the page.
pub(super) fn messages(run: &Playback) -> Markup {
    let overview = run.overview(&[]);
    let parts = parts(run, &overview);
    // Of one trial there is nothing to choose.
    let is_one = overview.trials.len() <= 1;
    html! {
        p {
            "Each broadcast is one row, with all robots that heard it; a cross stands where it was lost. Of the RAM that \
             repeat what is known, only the first is shown. Times are seconds since the first record."
        }
        ul.legend aria-label="Columns from left to right" {
            @for (lane, name) in overview.lanes.iter().enumerate() { li { (key(lane)) (name) } }
        }
        @for (place, part) in parts.iter().enumerate() {
            details open[is_one && place == 0] {
                summary { (part.name) }
                ol.sequence { (rows(part, &overview.lanes)) }
            }
        }
        details {
            summary { "As text" }
            pre tabindex="0" { (text(&parts, &overview.lanes)) }
        }
    }
}

/// The trials, and what happened before, between and after them.
fn parts(run: &Playback, overview: &Overview) -> Vec<Part> {
    let whole = Stretch {
        from: 0,
        to: overview.lasted,
    };
    let mut rest = run.rows(whole);
    let mut parts = Vec::new();
    for (place, trial) in overview.trials.iter().enumerate() {
        let is_in = |row: &MessageRow| trial.from <= row.at && row.at <= trial.to;
        let (rows, others) = rest.into_iter().partition(is_in);
        rest = others;
        let name = named(place + 1, trial);
        parts.push(Part { name, rows });
    }
    if !rest.is_empty() || parts.is_empty() {
        let name = if parts.is_empty() {
            "The whole run"
        } else {
            "Before, between and after the trials"
        };
        parts.push(Part {
            name: name.to_owned(),
            rows: rest,
        });
    }
    parts.retain(|part| !part.rows.is_empty());
    for part in &mut parts {
        let _ = write!(part.name, ": {} rows", part.rows.len());
    }
    parts
}

fn named(number: usize, trial: &Trial) -> String {
    let leader = if trial.leader.is_empty() {
        &trial.session
    } else {
        &trial.leader
    };
    let team = if trial.team.is_empty() {
        String::new()
    } else {
        format!(" with {}", trial.team.join(", "))
    };
    format!(
        "Trial {number}: {leader}{team}, {:.1} to {:.1} s",
        seconds(trial.from),
        seconds(trial.to)
    )
}

fn seconds(us: u64) -> f64 {
    Duration::from_micros(us).as_secs_f64()
}

fn rows(part: &Part, lanes: &[String]) -> Markup {
    let (first, last) = shown(&part.rows);
    let left_out = part.rows.len() - first.len() - last.len();
    html! {
        @for it in first { (row(it, lanes)) }
        @if left_out > 0 { li { span.at {} span.text { "… " (left_out) " rows are left out here …" } } }
        @for it in last { (row(it, lanes)) }
    }
}

/// The rows at the beginning and at the end that are shown.
fn shown(rows: &[MessageRow]) -> (&[MessageRow], &[MessageRow]) {
    if rows.len() <= 2 * ROWS {
        return (rows, &[]);
    }
    (&rows[..ROWS], &rows[rows.len() - ROWS..])
}

fn row(row: &MessageRow, lanes: &[String]) -> Markup {
    let is_warning = row.is_warning || !row.lost.is_empty();
    html! {
        li {
            span.at { (format!("{:.3}", seconds(row.at))) }
            (PreEscaped(drawing(row, lanes.len())))
            span class=(if is_warning { "text warning" } else { "text" }) {
                b { (name(lanes, row.from)) } " "
                @if row.kind.is_some() { span.reach { (reach(row, lanes)) } " " }
                (row.text)
            }
        }
    }
}

/// Who heard it.
fn reach(row: &MessageRow, lanes: &[String]) -> String {
    let names = |of: &[usize]| {
        let names = of.iter().map(|lane| name(lanes, *lane));
        names.collect::<Vec<_>>().join(", ")
    };
    match (row.heard.is_empty(), row.lost.is_empty()) {
        (true, true) => "→ heard by nobody whose log is here".to_owned(),
        (false, true) => format!("→ {}", names(&row.heard)),
        (true, false) => format!("lost at {}", names(&row.lost)),
        (false, false) => format!("→ {}; lost at {}", names(&row.heard), names(&row.lost)),
    }
}

fn name(lanes: &[String], lane: usize) -> &str {
    lanes.get(lane).map_or("?", String::as_str)
}

fn x(lane: usize, count: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "there are few columns")]
    let (lane, count) = (lane as f64, count.max(1) as f64);
    (lane + 0.5) * (240.0 / count).clamp(18.0, 46.0)
}

/// The row as a picture. Nothing of a log is in it but numbers.
fn drawing(row: &MessageRow, count: usize) -> String {
    let y = HEIGHT / 2.0;
    let mut shapes = String::new();
    for lane in 0..count {
        let x = x(lane, count);
        let _ = write!(
            shapes,
            "<line class='life' x1='{x}' x2='{x}' y1='0' y2='100%'/>"
        );
    }
    let (from, look) = (x(row.from, count), Look::of(row.from));
    let color = look.color;
    let ends = row.heard.iter().chain(&row.lost);
    let ends: Vec<_> = ends.map(|lane| x(*lane, count)).collect();
    let left = ends.iter().copied().fold(from, f64::min);
    let right = ends.iter().copied().fold(from, f64::max);
    if row.kind.is_some() {
        let _ = write!(
            shapes,
            "<line x1='{left}' x2='{right}' y1='{y}' y2='{y}' stroke='{color}' stroke-width='1.6'/>"
        );
    }
    for lane in &row.heard {
        let to = x(*lane, count);
        let back = if from < to { -6 } else { 6 };
        let _ = write!(shapes, "<path d='M{to} {y}l{back} -4v8Z' fill='{color}'/>");
    }
    for lane in &row.lost {
        let to = x(*lane, count);
        let _ = write!(
            shapes,
            "<path class='lost' d='M{} {}l8 8m0 -8l-8 8'/>",
            to - 4.0,
            y - 4.0
        );
    }
    let marker = look.outline((0.0, 0.0));
    let fill = if row.kind.is_some() { color } else { "none" };
    let _ = write!(
        shapes,
        "<path d='{marker}' transform='translate({from} {y}) scale(.55)' fill='{fill}' stroke='{color}' stroke-width='2'/>"
    );
    let width = x(count.max(1) - 1, count) + x(0, count);
    format!("<svg width='{width}' height='{HEIGHT}' aria-hidden='true'>{shapes}</svg>")
}

fn key(lane: usize) -> Markup {
    let look = Look::of(lane);
    let (marker, color) = (look.outline((10.0, 10.0)), look.color);
    PreEscaped(format!(
        "<svg class='key' width='20' height='20' aria-hidden='true'><path d='{marker}' fill='{color}'/></svg>"
    ))
}

fn text(parts: &[Part], lanes: &[String]) -> String {
    let mut text = String::new();
    for part in parts {
        let _ = writeln!(text, "{}", part.name);
        let (first, last) = shown(&part.rows);
        for row in first.iter().chain(last) {
            let who = name(lanes, row.from);
            let reach = if row.kind.is_some() {
                format!(" {}", reach(row, lanes))
            } else {
                String::new()
            };
            let _ = writeln!(text, "{:>10.3} {who}{reach}: {}", seconds(row.at), row.text);
        }
    }
    text
}
