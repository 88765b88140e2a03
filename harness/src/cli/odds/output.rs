//! How odds are printed.

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, ContentArrangement, Table};
use crossguard_model_check::odds::{
    Coupling, Enclosure, LossOdds, Milestone, MilestoneOdds, TeamOdds,
};

use super::{Failure, OddsReport, print};

/// Prints the settings, the table, and what they are of.
pub(super) fn print_table(report: &OddsReport) -> Result<(), Failure> {
    print(format_args!(
        "ram_period={} t_ack={} n_ack={} t_safety={}:",
        report.ram_period_ms, report.t_ack_ms, report.n_ack, report.t_safety_ms
    ))?;
    print(table(&report.team))?;
    let sizes = report.team.sizes.iter().map(|size| {
        let (name, states, transitions) = (size.stage.name(), size.states, size.transitions);
        format!("{name} {states} states and {transitions} transitions")
    });
    print(format_args!(
        "{}; bounds are at most {:.0e} apart; grid {} ms.\n",
        sizes.collect::<Vec<_>>().join(", "),
        widest(&report.team),
        report.tick_ms
    ))?;
    let channel = match report.burst_ms {
        Some(burst) => format!("losses come in bursts of {burst} ms on average"),
        None => "each message is lost independently".to_owned(),
    };
    print(format_args!(
        "{} and a leader; each message takes {} ms, and {channel}. Times are from the detection to the full team, and \
         from the command on.\nInterrupted: the corridor closes within {:.1} s of being open. Crossing: all goes well from \
         the detection on.",
        if report.followers == 1 {
            "1 follower".to_owned()
        } else {
            format!("{} followers", report.followers)
        },
        report.delay_ms,
        f64::from(report.hold_ms) / 1e3,
    ))?;
    if report.followers > 1 && report.coupling == Coupling::LinkByLink {
        print(
            "After the team is full, links are taken one at a time, as independent ones; --joint takes them together.",
        )?;
    }
    Ok(())
}

/// How far apart the bounds of any probability are.
fn widest(team: &TeamOdds) -> f64 {
    let all = team.losses.iter().flat_map(|loss| {
        let milestones = loss.milestones.iter().map(|it| it.probability);
        milestones.chain([loss.crossing])
    });
    all.map(Enclosure::width).fold(0.0, f64::max)
}

fn table(team: &TeamOdds) -> Table {
    let mut table = Table::new();
    table
        .load_style(NOTHING)
        .set_content_arrangement(ContentArrangement::Disabled)
        .set_header([
            "loss",
            "team",
            "mean",
            "99 %",
            "received",
            "mean ± sd",
            "acknowledged",
            "mean",
            "99 %",
            "interrupted",
            "falls back",
            "crossing",
        ]);
    for loss in &team.losses {
        table.add_row(row(loss));
    }
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn row(loss: &LossOdds) -> Vec<String> {
    let of = |milestone| loss.milestone(milestone);
    let probability = |milestone| of(milestone).map_or("-".to_owned(), |it| shown(it.probability));
    let ms = |ms: Option<u64>| ms.map_or("never".to_owned(), |ms| format!("{ms} ms"));
    let mean = |milestone| {
        let mean = of(milestone).and_then(|it| it.mean_ms);
        mean.map_or("-".to_owned(), |mean| format!("{:.0} ms", mean.middle()))
    };
    let spread = of(Milestone::Received).and_then(|it| Some((it.mean_ms?, it.deviation_ms?)));
    let spread = spread.map_or("-".to_owned(), |(mean, deviation)| {
        format!("{:.0} ± {deviation:.0} ms", mean.middle())
    });
    let by = |milestone| of(milestone).map_or("-".to_owned(), |it| ms(quantile(it, 0.99)));
    vec![
        loss.loss.to_string(),
        probability(Milestone::Team),
        mean(Milestone::Team),
        by(Milestone::Team),
        probability(Milestone::Received),
        spread,
        probability(Milestone::Acknowledged),
        mean(Milestone::Acknowledged),
        by(Milestone::Acknowledged),
        probability(Milestone::Interrupted),
        probability(Milestone::FellBack),
        shown(loss.crossing),
    ]
}

fn quantile(odds: &MilestoneOdds, probability: f64) -> Option<u64> {
    let mut quantiles = odds.quantiles.iter();
    quantiles
        .find(|it| (it.probability - probability).abs() < 1e-12)?
        .ms
}

/// A probability in a few digits, of which none is more than the bounds know. Small ones and those close to 1 are told
/// by their distance.
fn shown(probability: Enclosure) -> String {
    let Enclosure { lower, upper } = probability;
    if lower >= 1.0 {
        return "1".to_owned();
    }
    if upper <= 0.0 {
        return "0".to_owned();
    }
    let rest = probability.complement();
    if upper < 1e-3 {
        return small(probability);
    }
    if rest.upper < 1e-3 {
        return format!("1 - {}", small(rest)).replace("- < ", "- <");
    }
    // Bounds that agree in no digit have none to show.
    let digits = (-probability.width().max(1e-6).log10())
        .floor()
        .clamp(0.0, 6.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "0 to 6"
    )]
    let digits = digits as usize;
    format!("{:.digits$}", probability.middle())
}

fn small(probability: Enclosure) -> String {
    if probability.width() > 0.1 * probability.upper {
        format!("< {:.0e}", probability.upper * 1.0001)
    } else {
        format!("{:.1e}", probability.middle())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_are_shown_in_digits_that_are_known() {
        let of = |lower, upper| shown(Enclosure { lower, upper });
        assert_eq!(of(1.0, 1.0), "1");
        assert_eq!(of(0.0, 0.0), "0");
        assert_eq!(of(0.25, 0.25), "0.250000");
        assert_eq!(of(0.25, 0.2505), "0.250");
        assert_eq!(of(0.0, 2e-9), "< 2e-9");
        assert_eq!(of(1.234e-5, 1.234e-5), "1.2e-5");
        assert_eq!(of(1.0 - 1e-4, 1.0 - 1e-4), "1 - 1.0e-4");
        assert_eq!(of(1.0 - 3e-9, 1.0), "1 - <3e-9");
    }
}
