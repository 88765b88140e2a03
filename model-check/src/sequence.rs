//! Counterexamples as numbered sequence charts: as text and as Mermaid.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

/// One step of a run.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct ChartStep {
    /// Where in the chart it stands.
    pub place: ChartPlace,
    /// The action, in words.
    pub action: String,
    /// Outputs of the robot that took the step.
    pub outputs: Vec<String>,
}

/// Where in a chart something stands. Robots are named by their places in the scenario, from 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
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
        /// Fate of the message.
        fate: Fate,
    },
}

/// Fate of a message.
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
    /// Its title.
    pub title: &'a str,
    /// The robots' names.
    pub robots: &'a [String],
    /// Its steps, in order.
    pub steps: &'a [ChartStep],
    /// How many steps come before the steps that are repeated for ever, where the run is without end.
    pub repeats_after: Option<usize>,
}

impl ChartStep {
    /// The step in one line.
    #[must_use]
    pub fn line(&self, robots: &[String]) -> String {
        match self.place {
            ChartPlace::At(robot) => format!("{}: {}", robots[robot], self.action),
            ChartPlace::Between { from, to, fate } => {
                let arrow = if fate.arrives() { "->" } else { "-x" };
                let (from, to) = (&robots[from], &robots[to]);
                format!("{from} {arrow} {to}: {}{}", self.action, fate.remark())
            }
        }
    }

    /// The robot that the step is one of: the receiver of a message.
    const fn robot(&self) -> usize {
        match self.place {
            ChartPlace::At(robot) | ChartPlace::Between { to: robot, .. } => robot,
        }
    }
}

const FOR_EVER: &str = "from here on for ever";
const NOTHING_MORE: &str = "and then nothing happens any more";

impl Chart<'_> {
    /// The words before the step of this number, if the run without end turns there.
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
            let _ = match step.place {
                ChartPlace::At(robot) => writeln!(chart, "    Note over r{robot}: {what}"),
                ChartPlace::Between { from, to, fate } => {
                    let (arrow, remark) = (fate.mermaid(), fate.remark());
                    writeln!(chart, "    r{from}{arrow}r{to}: {what}{remark}")
                }
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
    fn in_mermaid_nothing_of_a_text_is_taken_for_syntax() {
        let chart = with_chart(None, |chart| chart.mermaid());
        assert!(chart.contains("    r0-xr1: RAM needHelp 1#35;1.0 (lost)\n"));
        assert!(chart.contains("RAM <none>#59; & so on"));
        assert!(chart.ends_with("Note over r0,r1: L1\n"));
    }
}
