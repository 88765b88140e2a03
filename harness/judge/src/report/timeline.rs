//! States over time, a row for each robot. Colour, height and words say the same.

use crossguard_protocol::{Role, State};
use maud::{Markup, html};

use super::charts::{number, step};
use super::collect::{RobotRun, Run};
use super::crowd::Span;
use crate::facts::View;

/// How many rows of the table there are for a robot.
const ROWS: usize = 200;

/// Where things are on the axis of time.
#[derive(Clone, Copy)]
struct Axis {
    from_us: u64,
    us: f64,
}

#[expect(clippy::cast_precision_loss, reason = "centuries of microseconds fit")]
impl Axis {
    fn of(run: &Run) -> Self {
        Self {
            from_us: run.from_us,
            us: (run.to_us.saturating_sub(run.from_us)).max(1_000) as f64,
        }
    }

    /// In percent of the whole.
    fn at(self, at_us: u64) -> f64 {
        at_us.saturating_sub(self.from_us) as f64 / self.us * 100.0
    }

    /// In seconds since the beginning.
    fn seconds(self, at_us: u64) -> f64 {
        at_us.saturating_sub(self.from_us) as f64 / 1e6
    }

    fn place<T>(self, span: &Span<T>) -> String {
        let (left, right) = (self.at(span.from_us), self.at(span.to_us));
        format!("left:{left:.3}%;width:{:.3}%", (right - left).max(0.0))
    }

    /// Round moments, with their places in percent.
    fn ticks(self) -> Vec<(f64, String)> {
        let whole = self.us / 1e6;
        let step = step(whole, 8.0);
        let mut ticks = Vec::new();
        let mut at = 0.0;
        while at <= whole {
            ticks.push((at / whole * 100.0, number(at)));
            at += step;
        }
        ticks
    }
}

/// The timeline, and the same as a table.
pub(super) fn timeline(run: &Run) -> Markup {
    let axis = Axis::of(run);
    html! {
        div.scroll tabindex="0" role="group" aria-label="States of the robots over time; the same is in the table below" {
            div.timeline {
                @for robot in &run.robots {
                    div.row {
                        div.who { (robot.name) }
                        div.track { @for span in &robot.states { (state(axis, span)) } }
                    }
                    @if !robot.people.waiting.is_empty() {
                        div.row.thin {
                            div.who { "people wait" }
                            div.track { @for span in &robot.people.waiting { (waiting(axis, span)) } }
                        }
                    }
                    @if !robot.corridor.is_empty() {
                        div.row.thin {
                            div.who { "corridor" }
                            div.track { @for span in &robot.corridor { (corridor(axis, span)) } }
                        }
                    }
                }
                div.row.axis {
                    div.who { "seconds" }
                    div.track {
                        @for (left, text) in axis.ticks() {
                            span style=(format!("left:{left:.3}%")) { (text) }
                        }
                    }
                }
            }
        }
        ul.legend {
            @for (class, text) in [("idle", "Idle"), ("help", "HelpRequested"), ("role", "RoleEstablished"), ("exec", "ManeuverExecuting")] {
                li { span.key { span.state.(class) {} } (text) }
            }
            li { span.key { span.open {} } "corridor open: the pedestrian may cross" }
            @if run.robots.iter().any(|robot| !robot.people.waiting.is_empty()) {
                li { span.key { span.waits {} } "people wait to cross, as far as the robot's sensors tell" }
            }
        }
        details {
            summary { "As a table" }
            div.scroll tabindex="0" role="group" aria-label="State changes" { (table(run, axis)) }
        }
    }
}

fn class(state: State) -> &'static str {
    match state {
        State::Idle => "idle",
        State::HelpRequested => "help",
        State::RoleEstablished => "role",
        State::ManeuverExecuting => "exec",
    }
}

/// What a block says of a state.
fn words(view: &View) -> String {
    match (view.executes, view.role) {
        (Some(task), _) => format!("{task}"),
        (None, Role::None) if !view.duty.is_empty() => "on duty".to_owned(),
        (None, Role::None) => String::new(),
        (None, role) => role.to_string(),
    }
}

fn state(axis: Axis, span: &Span<View>) -> Markup {
    let view = &span.what;
    let (from, to) = (axis.seconds(span.from_us), axis.seconds(span.to_us));
    let title = format!(
        "{from:.3} s to {to:.3} s: {:?}, {}{}{}",
        view.state,
        words(view),
        if view.duty.is_empty() { "" } else { "; " },
        view.duty
    );
    html! {
        div.state.(class(view.state)) style=(axis.place(span)) title=(title) { span { (words(view)) } }
    }
}

fn waiting(axis: Axis, span: &Span<usize>) -> Markup {
    let (from, to) = (axis.seconds(span.from_us), axis.seconds(span.to_us));
    html! {
        div.waits style=(axis.place(span)) title=(format!("{} waiting from {from:.3} s to {to:.3} s", span.what)) {
            span { (span.what) }
        }
    }
}

fn corridor(axis: Axis, span: &Span<String>) -> Markup {
    let (from, to) = (axis.seconds(span.from_us), axis.seconds(span.to_us));
    let why = if span.what.is_empty() {
        "end of the log"
    } else {
        &span.what
    };
    html! {
        div.open style=(axis.place(span)) title=(format!("open from {from:.3} s to {to:.3} s; closed: {why}")) {
            span { "open" }
        }
    }
}

fn table(run: &Run, axis: Axis) -> Markup {
    html! {
        table {
            thead { tr {
                th scope="col" { "robot" } th.n scope="col" { "from [s]" } th.n scope="col" { "to [s]" }
                th scope="col" { "state" } th scope="col" { "role" } th scope="col" { "session" } th scope="col" { "executes" }
                th scope="col" { "on the road" }
            } }
            tbody {
                @for robot in &run.robots {
                    @for span in robot.states.iter().take(ROWS) {
                        tr {
                            th scope="row" { (robot.name) }
                            td.n { (format!("{:.3}", axis.seconds(span.from_us))) }
                            td.n { (format!("{:.3}", axis.seconds(span.to_us))) }
                            td { (format!("{:?}", span.what.state)) }
                            td { (span.what.role) }
                            td { @if let Some(session) = span.what.session { (session) } }
                            td { @if let Some(task) = span.what.executes { (task) } }
                            td { (span.what.duty) }
                        }
                    }
                    @let more = more(robot);
                    @if more > 0 { tr { th scope="row" { (robot.name) } td colspan="7" { (more) " more are left out" } } }
                }
            }
        }
    }
}

fn more(robot: &RobotRun) -> u64 {
    robot.states_more + robot.states.len().saturating_sub(ROWS) as u64
}
