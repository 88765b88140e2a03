//! Figures from the JSON of `crossguard odds` and `crossguard simulate`.

use serde::{Deserialize, Serialize};

/// The paper's time from a command sent to the command received, in ms: mean and deviation, for `initialPos`.
const PAPER_INITIAL_POS: (f64, f64) = (74.0, 15.0);
/// The same for `Move`.
const PAPER_MOVE: (f64, f64) = (129.0, 102.0);

/// The largest number that can be drawn; far above each that is measured.
const NUMBER_MAX: f64 = 1e12;

/// A file, as figures.
#[derive(Clone, Debug, Serialize)]
pub struct Numbered {
    /// The name of the file.
    pub file: String,
    /// What it holds, in a line.
    pub about: String,
    /// Its figures.
    pub figures: Vec<Figure>,
    /// What the paper says, and what was measured.
    pub statements: Vec<Statement>,
}

/// A plot.
#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    /// What it shows.
    pub title: String,
    /// What the horizontal axis is, with its unit.
    pub x: &'static str,
    /// What the vertical axis is, with its unit.
    pub y: &'static str,
    /// Whether the vertical axis is logarithmic.
    pub is_log: bool,
    /// What the bars at points are.
    pub spread: &'static str,
    /// The curves.
    pub series: Vec<Series>,
    /// Ranges of the vertical axis that the paper gives.
    pub bands: Vec<Band>,
}

/// A curve.
#[derive(Clone, Debug, Serialize)]
pub struct Series {
    /// Its name.
    pub name: String,
    /// Its points, by their horizontal place: place, value, lower end, upper end.
    pub points: Vec<[f64; 4]>,
}

/// A range that the paper gives.
#[derive(Clone, Debug, Serialize)]
pub struct Band {
    /// What it is.
    pub name: &'static str,
    /// From.
    pub from: f64,
    /// To.
    pub to: f64,
}

/// Something that the paper says, and what was measured.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Statement {
    /// What it is about.
    pub about: String,
    /// What the paper says.
    pub paper: String,
    /// What was measured.
    pub measured: String,
    /// How the two are compared.
    pub rule: String,
    /// What came out.
    pub outcome: String,
}

/// Why a file gives no figures.
#[derive(Debug, thiserror::Error)]
pub enum NoNumbers {
    /// It is no JSON of the kind.
    #[error(
        "{0}; wanted is what `crossguard odds --json`, `crossguard simulate obs --json` or \
         `crossguard simulate cbr --json` prints"
    )]
    Syntax(serde_json::Error),
    /// It has a number that no result has.
    #[error("figure '{0}' has a value beyond ±{NUMBER_MAX:e}, which no result has")]
    Absurd(String),
    /// It has no numbers.
    #[error("it holds no results")]
    Empty,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Results {
    Odds {
        followers: u8,
        odds: Vec<Setting>,
    },
    Evaluation {
        preset: String,
        cells: Vec<Cell>,
        #[serde(default)]
        statements: Vec<Statement>,
    },
}

#[derive(Deserialize)]
struct Setting {
    ram_period_ms: u64,
    t_ack_ms: u64,
    n_ack: u64,
    t_safety_ms: u64,
    losses: Vec<AtLoss>,
}

#[derive(Deserialize)]
struct AtLoss {
    loss: f64,
    crossing: Bounds,
    milestones: Vec<Milestone>,
}

#[derive(Clone, Copy, Deserialize)]
struct Bounds {
    lower: f64,
    upper: f64,
}

#[derive(Deserialize)]
struct Milestone {
    #[serde(rename = "milestone")]
    id: String,
    probability: Bounds,
    mean_ms: Option<Bounds>,
    deviation_ms: Option<f64>,
    distribution: Vec<ByThen>,
}

#[derive(Deserialize)]
struct ByThen {
    ms: f64,
    lower: f64,
    upper: f64,
}

#[derive(Deserialize)]
struct Cell {
    robots: u32,
    pedestrians: u32,
    radius_m: f64,
    obs_percent: Option<Mean>,
    mcbr: Option<Mean>,
    reduction_percent: Option<Mean>,
    vam_share_percent: Option<Mean>,
}

#[derive(Clone, Copy, Deserialize)]
struct Mean {
    mean: f64,
    sd: f64,
}

impl Figure {
    fn is_absurd(&self) -> bool {
        let points = self.series.iter().flat_map(|series| &series.points);
        let mut values = points.flatten();
        !values.all(|value| value.abs() <= NUMBER_MAX)
    }
}

impl Bounds {
    /// A point at `x`, between its bounds.
    const fn at(self, x: f64) -> [f64; 4] {
        [
            x,
            f64::midpoint(self.lower, self.upper),
            self.lower,
            self.upper,
        ]
    }
}

impl ByThen {
    const fn bounds(&self) -> Bounds {
        Bounds {
            lower: self.lower,
            upper: self.upper,
        }
    }
}

impl Mean {
    /// A point at `x`, one standard deviation to each side.
    const fn at(self, x: f64) -> [f64; 4] {
        [x, self.mean, self.mean - self.sd, self.mean + self.sd]
    }
}

impl Numbered {
    /// The figures of a file.
    ///
    /// # Errors
    /// Why there are none.
    pub fn of(file: &str, text: &str) -> Result<Self, NoNumbers> {
        // What is told of a wrong file is where it is wrong, not that it is neither of two kinds.
        let read: Results =
            serde_json::from_str(text).map_err(|cause| {
                match serde_json::from_str::<serde::de::IgnoredAny>(text) {
                    Err(syntax) => NoNumbers::Syntax(syntax),
                    Ok(_) => NoNumbers::Syntax(cause),
                }
            })?;
        let (about, figures, statements) = match read {
            Results::Odds { followers, odds } => {
                let about = format!(
                    "Odds with {followers} follower{}",
                    if followers == 1 { "" } else { "s" }
                );
                let figures = odds.iter().flat_map(of_odds).collect();
                (about, figures, Vec::new())
            }
            Results::Evaluation {
                preset,
                cells,
                statements,
            } => (
                format!("Evaluation, preset {preset}"),
                of_cells(&cells),
                statements,
            ),
        };
        let figures: Vec<Figure> = figures;
        if figures.is_empty() {
            return Err(NoNumbers::Empty);
        }
        if let Some(figure) = figures.iter().find(|figure| figure.is_absurd()) {
            return Err(NoNumbers::Absurd(figure.title.clone()));
        }
        Ok(Self {
            file: file.to_owned(),
            about,
            figures,
            statements,
        })
    }
}

const BOUNDS: &str = "lower and upper bound";
const DEVIATION: &str = "one standard deviation";

/// What a milestone is, in words; `None` for one that this page does not know.
fn words(milestone: &str) -> Option<&'static str> {
    Some(match milestone {
        "team" => "the team is there",
        "received" => "a command is received",
        "acknowledged" => "a command is acknowledged",
        "open" => "the corridor is open",
        "interrupted" => "the corridor closes while guards hold",
        "fell-back" => "a guard falls back",
        _ => return None,
    })
}

fn is_harm(milestone: &str) -> bool {
    matches!(milestone, "interrupted" | "fell-back")
}

impl Setting {
    fn figure(&self, title: &str, y: &'static str, series: Vec<Series>) -> Figure {
        let Self {
            ram_period_ms,
            t_ack_ms,
            n_ack,
            t_safety_ms,
            ..
        } = self;
        Figure {
            title: format!(
                "{title} (RAM every {ram_period_ms} ms, t_ack {t_ack_ms} ms, n_ack {n_ack}, t_safety {t_safety_ms} ms)"
            ),
            x: "loss rate in %",
            y,
            is_log: false,
            spread: BOUNDS,
            series,
            bands: Vec::new(),
        }
    }

    /// A curve along the loss rates for each milestone that is wanted.
    fn along(
        &self,
        is_wanted: fn(&str) -> bool,
        point: fn(f64, &Milestone) -> Option<[f64; 4]>,
    ) -> Vec<Series> {
        let first = self.losses.first().map_or(&[][..], |at| &at.milestones);
        let wanted = first.iter().map(|it| it.id.as_str());
        let curve = |id: &str| {
            let points = self.losses.iter().filter_map(|at| {
                let found = at.milestones.iter().find(|it| it.id == id)?;
                point(at.loss * 100.0, found)
            });
            Series {
                name: words(id).unwrap_or(id).to_owned(),
                points: points.collect(),
            }
        };
        let series = wanted.filter(|id| is_wanted(id)).map(curve);
        series.filter(|series| !series.points.is_empty()).collect()
    }

    /// The distribution of a time: a curve for each loss rate.
    fn by_then(&self, id: &str) -> Figure {
        let series = self.losses.iter().filter_map(|at| {
            let found = at.milestones.iter().find(|it| it.id == id)?;
            let points = found.distribution.iter();
            Some(Series {
                name: format!("loss {:.0} %", at.loss * 100.0),
                points: points.map(|it| it.bounds().at(it.ms)).collect(),
            })
        });
        let title = format!("Probability that {} by then", words(id).unwrap_or(id));
        Figure {
            x: "time in ms",
            ..self.figure(&title, "probability", series.collect())
        }
    }
}

fn of_odds(setting: &Setting) -> Vec<Figure> {
    let probability = |loss, it: &Milestone| Some(it.probability.at(loss));
    let time = |loss, it: &Milestone| {
        let [x, mean, ..] = it.mean_ms?.at(loss);
        let deviation = it.deviation_ms.unwrap_or(0.0);
        Some([x, mean, (mean - deviation).max(0.0), mean + deviation])
    };
    let crossing = setting.losses.iter();
    let crossing = Series {
        name: "the crossing is not interrupted".to_owned(),
        points: crossing.map(|at| at.crossing.at(at.loss * 100.0)).collect(),
    };
    let mut good = setting.along(|id| !is_harm(id), probability);
    good.push(crossing);
    let harm = setting.along(is_harm, probability);
    let times = setting.along(|id| !is_harm(id), time);
    let mut figures = vec![
        setting.figure("Probability by loss rate", "probability", good),
        Figure {
            is_log: true,
            ..setting.figure(
                "Probability of harm by loss rate",
                "probability, logarithmic",
                harm,
            )
        },
        Figure {
            spread: DEVIATION,
            bands: vec![
                band("paper: initialPos received, 74 ± 15 ms", PAPER_INITIAL_POS),
                band("paper: Move received, 129 ± 102 ms", PAPER_MOVE),
            ],
            ..setting.figure("Mean time by loss rate", "time in ms", times)
        },
        setting.by_then("team"),
        setting.by_then("acknowledged"),
    ];
    figures.retain(|figure| !figure.series.is_empty());
    figures
}

const fn band(name: &'static str, (mean, deviation): (f64, f64)) -> Band {
    Band {
        name,
        from: mean - deviation,
        to: mean + deviation,
    }
}

fn of_cells(cells: &[Cell]) -> Vec<Figure> {
    let mut kinds: Vec<(u32, f64)> = Vec::new();
    for cell in cells {
        let kind = (cell.pedestrians, cell.radius_m);
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    let along = |of: fn(&Cell) -> Option<Mean>| {
        let series = kinds.iter().map(|&(pedestrians, radius_m)| {
            let own = cells
                .iter()
                .filter(|cell| (cell.pedestrians, cell.radius_m) == (pedestrians, radius_m));
            Series {
                name: format!("{pedestrians} people, {radius_m} m"),
                points: own
                    .filter_map(|cell| Some(of(cell)?.at(f64::from(cell.robots))))
                    .collect(),
            }
        });
        series
            .filter(|series| !series.points.is_empty())
            .collect::<Vec<_>>()
    };
    let figure = |title: &str, y, of| Figure {
        title: title.to_owned(),
        x: "robots",
        y,
        is_log: false,
        spread: DEVIATION,
        series: along(of),
        bands: Vec::new(),
    };
    let mut coverage = figure("Observation coverage (OBS)", "people seen in %", |cell| {
        cell.obs_percent
    });
    coverage.bands = vec![
        Band {
            name: "paper: 1 robot, 15 m: 5 to 6 %",
            from: 5.0,
            to: 6.0,
        },
        Band {
            name: "paper: 9 robots, 15 m: 17 to 18 %",
            from: 17.0,
            to: 18.0,
        },
    ];
    let figures = [
        coverage,
        figure("Mean channel busy ratio (mCBR)", "share of time", |cell| {
            cell.mcbr
        }),
        figure(
            "Channel load that robots take away",
            "reduction in %",
            |cell| cell.reduction_percent,
        ),
        figure("Share of VAM in all load", "share in %", |cell| {
            cell.vam_share_percent
        }),
    ];
    let figures = figures.into_iter();
    figures.filter(|figure| !figure.series.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const OBS: &str = r#"{"preset": "kerb", "cells": [
        {"robots": 0, "pedestrians": 20, "radius_m": 10.0, "obs_percent": {"mean": 0.0, "sd": 0.0}},
        {"robots": 9, "pedestrians": 20, "radius_m": 10.0, "obs_percent": {"mean": 12.5, "sd": 1.5}}]}"#;

    #[test]
    fn a_curve_has_the_numbers_of_its_cells() {
        let numbered = Numbered::of("obs.json", OBS).unwrap();
        assert_eq!(numbered.figures.len(), 1);
        let series = &numbered.figures[0].series;
        assert_eq!(series[0].name, "20 people, 10 m");
        assert_eq!(series[0].points, [[0.0; 4], [9.0, 12.5, 11.0, 14.0]]);
    }

    #[test]
    fn what_is_no_result_is_refused_with_what_is_wanted() {
        for text in ["", "{", "{}", "[1]", r#"{"odds": 1}"#] {
            let cause = Numbered::of("x", text).unwrap_err().to_string();
            assert!(cause.contains("crossguard odds --json"), "{text}: {cause}");
        }
        let absurd = OBS.replace("12.5", "1e308");
        let cause = Numbered::of("x", &absurd).unwrap_err().to_string();
        assert!(cause.contains("beyond ±1e12"), "{cause}");
        let cause = Numbered::of("x", r#"{"preset": "kerb", "cells": []}"#).unwrap_err();
        assert_eq!(cause.to_string(), "it holds no results");
    }
}
