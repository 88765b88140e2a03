//! Loss rate against probability and time, drawn.

use std::path::Path;

use crossguard_evaluation::plot::{Band, Line, LineChart, Panel};
use crossguard_model_check::odds::{Enclosure, LossOdds, Milestone};

use super::{Failure, OddsReport, SettingsOdds};

/// Draws the report, if that was asked for.
pub(super) fn write(path: Option<&Path>, report: &OddsReport) -> Result<(), Failure> {
    let Some(path) = path else {
        return Ok(());
    };
    std::fs::write(path, chart(report).to_svg())
        .map_err(|cause| Failure::Input(format!("{}: {cause}", path.display())))
}

fn chart(report: &OddsReport) -> LineChart {
    let channel = match report.burst_ms {
        Some(burst) => format!("bursts of {burst} ms on average"),
        None => "independent losses".to_owned(),
    };
    LineChart {
        title: match report.followers {
            1 => "A crossing with one follower under loss".to_owned(),
            followers => format!("A crossing with {followers} followers under loss"),
        },
        subtitle: format!(
            "{channel}; each message takes {} ms; the maneuver takes {:.1} s",
            report.delay_ms,
            f64::from(report.hold_ms) / 1e3
        ),
        x_axis: "share of messages lost".to_owned(),
        panels: vec![probabilities(report), times(report)],
    }
}

/// What a value of a loss rate is, where there is one.
type Value = fn(&LossOdds) -> Option<f64>;

fn lines(report: &OddsReport, values: &[(&str, Value)]) -> Vec<Line> {
    let of = |odds: &SettingsOdds, (name, value): &(&str, Value)| {
        let points = odds
            .team
            .losses
            .iter()
            .filter_map(|loss| Some([loss.loss, value(loss)?]));
        let mut points: Vec<_> = points.collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Line {
            name: match differing(report, odds) {
                Some(settings) => format!("{name}, {settings}"),
                None => (*name).to_owned(),
            },
            points,
        }
    };
    let all = report
        .odds
        .iter()
        .flat_map(|odds| values.iter().map(move |value| of(odds, value)));
    all.filter(|line| !line.points.is_empty()).collect()
}

/// The setting by which these are told from the others.
fn differing(report: &OddsReport, odds: &SettingsOdds) -> Option<String> {
    let words = odds.settings();
    let others: Vec<String> = report.odds.iter().map(SettingsOdds::settings).collect();
    let differs = |word: &&str| {
        others
            .iter()
            .any(|other| !other.split(' ').any(|it| it == *word))
    };
    words.split(' ').find(differs).map(str::to_owned)
}

fn probability(loss: &LossOdds, milestone: Milestone) -> Option<f64> {
    Some(loss.milestone(milestone)?.probability.middle())
}

fn probabilities(report: &OddsReport) -> Panel {
    let one: &[(&str, Value)] = &[
        ("full team", |it| probability(it, Milestone::Team)),
        ("acknowledged", |it| {
            probability(it, Milestone::Acknowledged)
        }),
        ("not interrupted", |it| {
            let interrupted = it.milestone(Milestone::Interrupted)?.probability;
            Some(interrupted.complement().middle())
        }),
        ("no fallback", |it| {
            Some(1.0 - probability(it, Milestone::FellBack)?)
        }),
        ("crossing goes well", |it| Some(it.crossing.middle())),
    ];
    let several: &[(&str, Value)] = &[("crossing", |it| Some(it.crossing.middle()))];
    Panel {
        y_axis: "probability".to_owned(),
        lines: lines(report, if report.odds.len() == 1 { one } else { several }),
        bands: Vec::new(),
        most: Some(1.0),
    }
}

fn mean(loss: &LossOdds, milestone: Milestone) -> Option<f64> {
    loss.milestone(milestone)?.mean_ms.map(Enclosure::middle)
}

fn times(report: &OddsReport) -> Panel {
    let one: &[(&str, Value)] = &[
        ("full team, mean", |it| mean(it, Milestone::Team)),
        ("received, mean", |it| mean(it, Milestone::Received)),
        ("acknowledged, mean", |it| mean(it, Milestone::Acknowledged)),
    ];
    let several: &[(&str, Value)] = &[
        ("team", |it| mean(it, Milestone::Team)),
        ("received", |it| mean(it, Milestone::Received)),
    ];
    let band = |name: &str, mean: f64, deviation: f64| Band {
        name: name.to_owned(),
        range: [mean - deviation, mean + deviation],
    };
    Panel {
        y_axis: "time in ms".to_owned(),
        lines: lines(report, if report.odds.len() == 1 { one } else { several }),
        bands: vec![
            band("paper: 74 ± 15 ms, received", 74.0, 15.0),
            band("paper: 129 ± 102 ms", 129.0, 102.0),
        ],
        most: None,
    }
}
