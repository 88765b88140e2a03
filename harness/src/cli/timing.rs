//! `crossguard timing`, and the table of times.

use std::path::PathBuf;

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table};
use crossguard_judge::timing::{
    NoOffset, Offset, Statistic, Summary, TeamSummary, Timing, offsets_in_words,
};
use crossguard_robot::trace::{Merged, Timed};
use serde::Serialize;

use super::ranges::speed;
use super::{Failure, open_logs, print, print_json};

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Arguments {
    /// The logs: of one robot or of several, from one machine or from several.
    #[arg(required = true, value_name = "LOG")]
    logs: Vec<PathBuf>,
    /// How many times as fast as real the robots' bodies moved, where their logs do not say it, or wrongly.
    #[arg(long, value_name = "N", value_parser = speed)]
    speed: Option<f64>,
    /// Print the results as JSON, and nothing else.
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Takes the paper's times from logs: negotiation one way (T_neg), execution (T_exec) and both together (T_TMCT), and \
the round trip from command to acknowledgement. It takes the logs of a leader and of its followers. Robots with logs \
of their own may have clocks that are apart: the difference is estimated from the messages that went both ways, \
taken off T_neg, and printed with what it can be wrong by. The exit code is 3 if maneuvers are left out because the \
clocks of their robots cannot be compared.";

/// The results as JSON.
#[derive(Serialize)]
struct TimingReport {
    maneuvers: Vec<Summary>,
    teams: Vec<TeamSummary>,
    clocks: Vec<ClockReport>,
}

/// How far the clocks of a leader's and a follower's log are apart.
#[derive(Serialize)]
struct ClockReport {
    leader: String,
    follower: String,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    follower_ahead: Option<Offset>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut logs = Merged::new(open_logs(&arguments.logs)?).map_err(Failure::input)?;
    let mut timing = Timing::default();
    while let Some(Timed { log, at_us, record }) = logs.take().map_err(Failure::input)? {
        timing.record(log, at_us, &record);
    }
    let names: Vec<_> = arguments
        .logs
        .iter()
        .map(|path| path.display().to_string())
        .collect();
    let maneuvers = timing.summaries(arguments.speed);
    if arguments.json {
        let clocks = clocks(&timing, &names);
        let teams = timing.teams();
        print_json(&TimingReport {
            maneuvers,
            teams,
            clocks,
        })?;
    } else if maneuvers.is_empty() && timing.offsets().is_empty() {
        print("No maneuver was completed between robots whose logs are here.")?;
    } else {
        print(table(&maneuvers))?;
        print(LEGEND)?;
        for team in timing.teams() {
            print(format_args!("{team}."))?;
        }
        for line in offsets_in_words(&timing, &names) {
            print(format_args!("{line}."))?;
        }
    }
    if timing.offsets().values().any(Result::is_err) {
        return Err(Failure::Incomplete);
    }
    Ok(())
}

fn clocks(timing: &Timing, names: &[String]) -> Vec<ClockReport> {
    let report =
        |((leader, follower), offset): ((usize, usize), Result<Offset, NoOffset>)| ClockReport {
            leader: names[leader].clone(),
            follower: names[follower].clone(),
            follower_ahead: offset.ok(),
            error: offset.err().map(|why| why.to_string()),
        };
    timing.offsets().into_iter().map(report).collect()
}

/// What the columns of [`table`] mean.
pub(super) const LEGEND: &str = "\
T_neg: from the leader's first transmission of the command to its reception at the follower, one way; the paper's \
went\nover IEEE 802.11p. Round trip: from that transmission to the acknowledgement at the leader. T_exec: the motion, \
in the\nrobots' own time; of a block, how long it was held. T_TMCT = T_neg + T_exec. Mean ± standard deviation.";

/// The times of maneuvers, each beside the paper's.
pub(super) fn table(summaries: &[Summary]) -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING).set_header([
        "maneuver",
        "completed",
        "T_neg [s]",
        "round trip [s]",
        "T_exec [s]",
        "T_TMCT [s]",
    ]);
    for summary in summaries {
        table.add_row([
            summary.task.clone(),
            summary.trials.to_string(),
            statistic(summary.t_neg_s, 4),
            statistic(summary.round_trip_s, 4),
            statistic(summary.t_exec_s, 2),
            statistic(summary.t_tmct_s, 3),
        ]);
        if let Some(paper) = &summary.paper {
            table.add_row([
                "  in the paper".to_owned(),
                paper.trials.to_string(),
                statistic(paper.t_neg_s, 3),
                String::new(),
                format!("{:.2}", paper.t_exec_s),
                statistic(paper.t_tmct_s, 3),
            ]);
        }
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn statistic(statistic: Statistic, digits: usize) -> String {
    format!("{:.digits$} ± {:.digits$}", statistic.mean, statistic.sd)
}
