//! Counterexamples as numbered sequence charts: as text, as Mermaid, as SVG.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

/// One step of a run.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct ChartStep {
    /// Where in the chart it stands.
    pub place: ChartPlace,
    /// What happened.
    pub action: String,
    /// What the robot that took the step put out.
    pub outputs: Vec<String>,
}

/// Where in a chart something stands. Robots are named by their places in the scenario, from 0.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum ChartPlace {
    /// At one robot.
    At(usize),
    /// On the way from one robot to another.
    Between {
        /// The sender.
        from: usize,
        /// The receiver.
        to: usize,
        /// What becomes of the message.
        fate: Fate,
    },
    /// On the way from one robot to several at once.
    Among {
        /// The sender.
        from: usize,
        /// The receivers, and what becomes of the message on the way to each.
        to: Vec<(usize, Fate)>,
    },
}

/// What becomes of a message.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Fate {
    /// It arrives at once.
    Arrives,
    /// It arrives late.
    ArrivesLate,
    /// It arrives late, and not for the last time.
    ArrivesLateAndAgain,
    /// It is lost.
    Lost,
    /// It is delayed.
    Delayed,
}

impl Fate {
    const fn remark(self) -> &'static str {
        match self {
            Self::Arrives => "",
            Self::ArrivesLate => " (late)",
            Self::ArrivesLateAndAgain => " (late, and not for the last time)",
            Self::Lost => " (lost)",
            Self::Delayed => " (delayed)",
        }
    }

    /// Its arrow in Mermaid.
    const fn mermaid(self) -> &'static str {
        match self {
            Self::Lost => "-x",
            Self::Delayed => "--)",
            _ => "->>",
        }
    }

    /// Whether the message reaches its receiver in this step.
    const fn arrives(self) -> bool {
        !matches!(self, Self::Lost | Self::Delayed)
    }
}

/// A run, to be drawn.
#[derive(Clone, Copy, Debug)]
pub struct Chart<'a> {
    /// What it shows.
    pub title: &'a str,
    /// The robots' names.
    pub robots: &'a [String],
    /// What happens, in order.
    pub steps: &'a [ChartStep],
    /// How many steps come before the steps that are repeated for ever, where the run is without end.
    pub repeats_after: Option<usize>,
}

impl ChartStep {
    /// What happened, in one line.
    #[must_use]
    pub fn line(&self, robots: &[String]) -> String {
        match &self.place {
            ChartPlace::At(robot) => format!("{}: {}", robots[*robot], self.action),
            ChartPlace::Between { from, to, fate } => {
                let arrow = if fate.arrives() { "->" } else { "-x" };
                let (from, to) = (&robots[*from], &robots[*to]);
                format!("{from} {arrow} {to}: {}{}", self.action, fate.remark())
            }
            ChartPlace::Among { from, to } => {
                let heads = to.iter().map(|(to, fate)| {
                    let arrow = if fate.arrives() { "->" } else { "-x" };
                    format!("{arrow} {}{}", robots[*to], fate.remark())
                });
                let heads = heads.collect::<Vec<_>>().join(" ");
                format!("{} {heads}: {}", robots[*from], self.action)
            }
        }
    }

    /// The robot that the step is one of: the receiver of a message, of several the first.
    fn robot(&self) -> usize {
        match &self.place {
            ChartPlace::At(robot) | ChartPlace::Between { to: robot, .. } => *robot,
            ChartPlace::Among { from, to } => to.first().map_or(*from, |(to, _)| *to),
        }
    }
}

const FOR_EVER: &str = "from here on for ever";
const NOTHING_MORE: &str = "and then nothing happens any more";

impl Chart<'_> {
    /// What stands before the step of this number, if the run without end turns there.
    fn turn(&self, step: usize) -> Option<&'static str> {
        (self.repeats_after == Some(step)).then_some(if step == self.steps.len() {
            NOTHING_MORE
        } else {
            FOR_EVER
        })
    }

    /// Numbered lines.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        for (i, step) in self.steps.iter().enumerate() {
            if let Some(turn) = self.turn(i) {
                let _ = writeln!(text, "      {turn}:");
            }
            let _ = writeln!(text, "{:>4}. {}", i + 1, step.line(self.robots));
            for output in &step.outputs {
                let _ = writeln!(text, "        {}: {output}", self.robots[step.robot()]);
            }
        }
        if let Some(turn) = self.turn(self.steps.len()) {
            let _ = writeln!(text, "      {turn}.");
        }
        text
    }

    /// A Mermaid sequence diagram.
    #[must_use]
    pub fn mermaid(&self) -> String {
        let mut chart = "sequenceDiagram\n    autonumber\n".to_owned();
        for (i, name) in self.robots.iter().enumerate() {
            let _ = writeln!(chart, "    participant r{i} as {name}");
        }
        let everywhere = format!("r0,r{}", self.robots.len() - 1);
        for (i, step) in self.steps.iter().enumerate() {
            if let Some(turn) = self.turn(i) {
                let _ = writeln!(chart, "    Note over {everywhere}: {turn}");
            }
            let what = escaped(&step.action);
            let _ = match &step.place {
                ChartPlace::At(robot) => writeln!(chart, "    Note over r{robot}: {what}"),
                ChartPlace::Between { from, to, fate } => {
                    let (arrow, remark) = (fate.mermaid(), fate.remark());
                    writeln!(chart, "    r{from}{arrow}r{to}: {what}{remark}")
                }
                ChartPlace::Among { from, to } => self.mermaid_among(&mut chart, *from, to, &what),
            };
            if !step.outputs.is_empty() {
                let outputs: Vec<_> = step.outputs.iter().map(|output| escaped(output)).collect();
                let _ = writeln!(
                    chart,
                    "    Note over r{}: {}",
                    step.robot(),
                    outputs.join("<br>")
                );
            }
        }
        let last = self.turn(self.steps.len()).unwrap_or(self.title);
        let _ = writeln!(chart, "    Note over {everywhere}: {}", escaped(last));
        chart
    }

    /// Mermaid knows no arrow with several heads: the one to the farthest receiver names the others.
    fn mermaid_among(
        &self,
        chart: &mut String,
        from: usize,
        to: &[(usize, Fate)],
        what: &str,
    ) -> std::fmt::Result {
        let farthest = to
            .iter()
            .max_by_key(|(to, fate)| (fate.arrives(), to.abs_diff(from)));
        let Some((farthest, fate)) = farthest else {
            return Ok(());
        };
        let (arrow, remark) = (fate.mermaid(), fate.remark());
        let others = to.iter().filter(|(to, _)| to != farthest);
        let others = others.map(|(to, fate)| {
            let name = escaped(&self.robots[*to]);
            format!("{name}{}", fate.remark())
        });
        let others = others.collect::<Vec<_>>().join(", ");
        writeln!(
            chart,
            "    r{from}{arrow}r{farthest}: {what}{remark}<br>also to {others}"
        )
    }

    /// A picture.
    #[must_use]
    pub fn svg(&self) -> String {
        let mut drawing = Drawing {
            rows: String::new(),
            y: 60,
        };
        for (i, step) in self.steps.iter().enumerate() {
            if let Some(turn) = self.turn(i) {
                drawing.turn(turn);
            }
            drawing.step(i + 1, step);
        }
        if let Some(turn) = self.turn(self.steps.len()) {
            drawing.turn(turn);
        }
        drawing.finish(self.title, self.robots)
    }
}

/// Mermaid ends a statement at a semicolon, and takes a hash for the begin of a character's code.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '#' => escaped.push_str("#35;"),
            ';' => escaped.push_str("#59;"),
            _ => escaped.push(c),
        }
    }
    escaped
}

/// A picture in the making, from top to bottom; in pixels.
struct Drawing {
    rows: String,
    y: usize,
}

impl Drawing {
    const LANE: usize = 420;
    const LINE: usize = 17;
    /// How wide a character is, about.
    const CHARACTER: usize = 6;
    /// For the picture alone, also where it is part of a page; dark where that is wanted.
    const STYLE: &'static str = ".sequence{--ink:#222;--paper:#fff;--faint:#888;--lane:#bbb;--lost:#c00;\
        --delayed:#b60;--late:#06c;--output:#074}\
        @media screen and (prefers-color-scheme:dark){.sequence{--ink:#ddd;--paper:#16181c;--faint:#999;\
        --lane:#555;--lost:#ff7b72;--delayed:#e3a34f;--late:#79b8ff;--output:#5fd39a}}\
        .sequence .paper{fill:var(--paper)}\
        .sequence text{font:13px sans-serif;fill:var(--ink);paint-order:stroke;stroke:var(--paper);\
        stroke-width:4px}.sequence .name{font-weight:bold}\
        .sequence .number{fill:var(--faint);font-size:11px}.sequence .output{fill:var(--output)}\
        .sequence .turn{fill:var(--lost);font-weight:bold}.sequence line{stroke:var(--lane)}\
        .sequence .sender{fill:var(--ink)}.sequence .message{stroke:var(--ink);stroke-width:1.3}\
        .sequence .lost{stroke:var(--lost);stroke-dasharray:5 3}\
        .sequence .delayed{stroke:var(--delayed)}.sequence .late{stroke:var(--late)}\
        .sequence path{fill:none;stroke-dasharray:none!important}";

    const fn x(lane: usize) -> usize {
        Self::LANE / 2 + lane * Self::LANE
    }

    fn step(&mut self, number: usize, step: &ChartStep) {
        self.y += Self::LINE + 6;
        let y = self.y;
        let _ = write!(
            self.rows,
            "<text class='number' x='8' y='{y}'>{number}</text>"
        );
        match &step.place {
            ChartPlace::At(robot) => self.note("", *robot, &step.action),
            ChartPlace::Between { from, to, fate } => {
                let text = format!("{}{}", step.action, fate.remark());
                self.message(*from, &[(*to, *fate)], &text);
            }
            ChartPlace::Among { from, to } => self.message(*from, to, &step.action),
        }
        for output in &step.outputs {
            self.y += Self::LINE;
            self.note("output", step.robot(), output);
        }
        self.rows.push('\n');
    }

    /// One row, with an arrow to each receiver; the text stands between the sender and the nearest of them.
    fn message(&mut self, from: usize, to: &[(usize, Fate)], text: &str) {
        let nearest = to.iter().min_by_key(|(to, _)| to.abs_diff(from));
        let nearest = nearest.map_or(from, |(to, _)| *to);
        let (middle, y) = (usize::midpoint(Self::x(from), Self::x(nearest)), self.y);
        let _ = write!(
            self.rows,
            "<text x='{middle}' y='{y}' text-anchor='middle'>{}</text>",
            markup(text)
        );
        self.y += 7;
        if to.len() > 1 {
            let (x, y) = (Self::x(from), self.y);
            let _ = write!(
                self.rows,
                "<circle class='sender' cx='{x}' cy='{y}' r='4'/>"
            );
        }
        // What is lost is drawn over the line that goes on to others.
        let (arrives, lost): (Vec<_>, Vec<_>) = to.iter().partition(|(_, fate)| fate.arrives());
        for (to, fate) in arrives.into_iter().chain(lost) {
            self.arrow(from, to, fate);
        }
        self.y += 4;
    }

    fn note(&mut self, class: &str, robot: usize, text: &str) {
        let (x, y) = (Self::x(robot), self.y);
        // The numbers of lines stand on the left, and the picture ends on the right.
        let room = Self::LANE - 56;
        let squeeze = if text.chars().count() * Self::CHARACTER > room {
            format!(" textLength='{room}' lengthAdjust='spacingAndGlyphs'")
        } else {
            String::new()
        };
        let _ = write!(
            self.rows,
            "<text class='{class}' x='{x}' y='{y}' text-anchor='middle'{squeeze}>{}</text>",
            markup(text)
        );
    }

    /// An arrow that ends at its receiver, or before it where the message does not arrive.
    fn arrow(&mut self, from: usize, to: usize, fate: Fate) {
        let class = match fate {
            Fate::Arrives => "message",
            Fate::ArrivesLate | Fate::ArrivesLateAndAgain => "message late",
            Fate::Lost => "message lost",
            Fate::Delayed => "message delayed",
        };
        let (start, goal, y) = (Self::x(from), Self::x(to), self.y);
        let back = |x: usize, by: usize| if goal > start { x - by } else { x + by };
        let end = if fate.arrives() {
            goal
        } else {
            back(goal, 120)
        };
        let tail = back(end, 8);
        let head = match fate {
            Fate::Lost => {
                let (above, below) = (y - 5, y + 5);
                format!("M{tail} {above}L{end} {below}M{tail} {below}L{end} {above}")
            }
            _ => format!("M{tail} {}L{end} {y}L{tail} {}", y - 5, y + 5),
        };
        let _ = write!(
            self.rows,
            "<line class='{class}' x1='{start}' y1='{y}' x2='{end}' y2='{y}'/>\
             <path class='{class}' d='{head}'/>"
        );
    }

    fn turn(&mut self, text: &str) {
        self.y += Self::LINE + 8;
        let y = self.y;
        let _ = writeln!(self.rows, "<text class='turn' x='8' y='{y}'>{text}</text>");
    }

    fn finish(self, title: &str, robots: &[String]) -> String {
        let (width, height) = (Self::LANE * robots.len(), self.y + 30);
        let title = markup(title);
        let mut lanes = String::new();
        for (i, name) in robots.iter().enumerate() {
            let (x, bottom, name) = (Self::x(i), self.y + 20, markup(name));
            let _ = writeln!(
                lanes,
                "<line x1='{x}' y1='56' x2='{x}' y2='{bottom}'/>\
                 <text class='name' x='{x}' y='48' text-anchor='middle'>{name}</text>"
            );
        }
        format!(
            "<svg xmlns='http://www.w3.org/2000/svg' class='sequence' role='img' width='{width}' \
             height='{height}' viewBox='0 0 {width} {height}'>\n<title>{title}</title>\n\
             <style>{}</style>\n<rect class='paper' width='100%' height='100%'/>\n\
             <text class='name' x='8' y='20'>{title}</text>\n{lanes}{}</svg>\n",
            Self::STYLE,
            self.rows
        )
    }
}

fn markup(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps() -> Vec<ChartStep> {
        let between = |from, to, fate| ChartPlace::Between { from, to, fate };
        let step = |place, action: &str, outputs: &[&str]| ChartStep {
            place,
            action: action.to_owned(),
            outputs: outputs.iter().map(ToString::to_string).collect(),
        };
        vec![
            step(ChartPlace::At(0), "pedestrian detected", &["send RAM"]),
            step(between(0, 1, Fate::Lost), "RAM needHelp 1#1.0", &[]),
            step(between(1, 0, Fate::ArrivesLate), "RAM <none>; & so on", &[]),
        ]
    }

    fn with_chart<T>(repeats_after: Option<usize>, look: impl Fn(Chart) -> T) -> T {
        let robots = ["ARI".to_owned(), "Go2".to_owned()];
        look(Chart {
            title: "L1",
            robots: &robots,
            steps: &steps(),
            repeats_after,
        })
    }

    #[test]
    fn the_text_is_numbered_and_says_what_is_repeated() {
        let text = with_chart(Some(2), |chart| chart.text());
        let expected = "   1. ARI: pedestrian detected\n        ARI: send RAM\n   \
                        2. ARI -x Go2: RAM needHelp 1#1.0 (lost)\n      from here on for ever:\n   \
                        3. Go2 -> ARI: RAM <none>; & so on (late)\n";
        assert_eq!(text, expected);
        let text = with_chart(Some(3), |chart| chart.text());
        assert!(text.ends_with("and then nothing happens any more.\n"));
    }

    #[test]
    fn a_broadcast_is_one_row_with_an_arrow_to_each_receiver() {
        let robots = ["ARI", "Go2", "Spot", "Tug"].map(str::to_owned);
        let step = ChartStep {
            place: ChartPlace::Among {
                from: 1,
                to: vec![(0, Fate::Arrives), (3, Fate::Arrives), (2, Fate::Lost)],
            },
            action: "RAM leader".to_owned(),
            outputs: Vec::new(),
        };
        let chart = Chart {
            title: "",
            robots: &robots,
            steps: &[step],
            repeats_after: None,
        };
        let text = chart.text();
        assert_eq!(text, "   1. Go2 -> ARI -> Tug -x Spot (lost): RAM leader\n");
        let mermaid = chart.mermaid();
        assert!(mermaid.contains("r1->>r3: RAM leader<br>also to ARI, Spot (lost)\n"));
        assert_eq!(mermaid.matches("RAM leader").count(), 1);
        let svg = chart.svg();
        assert_eq!(svg.matches("RAM leader").count(), 1);
        let heads = ["<path class='message'", "<path class='message lost'"];
        assert_eq!(heads.map(|head| svg.matches(head).count()), [2, 1]);
    }

    #[test]
    fn in_mermaid_nothing_of_a_text_is_taken_for_syntax() {
        let chart = with_chart(None, |chart| chart.mermaid());
        assert!(chart.contains("    r0-xr1: RAM needHelp 1#35;1.0 (lost)\n"));
        assert!(chart.contains("RAM <none>#59; & so on"));
        assert!(chart.ends_with("Note over r0,r1: L1\n"));
    }

    #[test]
    fn in_svg_nothing_of_a_text_is_taken_for_markup() {
        let svg = with_chart(Some(1), |chart| chart.svg());
        assert!(svg.contains("RAM &lt;none>; &amp; so on (late)"));
        assert_eq!(svg.matches("class='turn'").count(), 1);
        assert_eq!(svg.matches("class='message lost'").count(), 2);
    }

    #[test]
    fn in_svg_a_long_note_stays_within_the_picture() {
        let svg = |text: String| {
            let step = ChartStep {
                place: ChartPlace::At(0),
                action: text,
                outputs: Vec::new(),
            };
            let chart = Chart {
                title: "",
                robots: &["ARI".to_owned()],
                steps: &[step],
                repeats_after: None,
            };
            chart.svg()
        };
        assert!(svg("long ".repeat(20)).contains("textLength='364'"));
        assert!(!svg("short".to_owned()).contains("textLength"));
    }
}
