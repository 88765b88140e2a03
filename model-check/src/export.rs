//! State graphs in files of Aldébaran, which CADP and mCRL2 read.

use std::io::{self, Seek, SeekFrom, Write};

use crate::check::label;
use crate::exploration::Options;
use crate::graph::{Graph, Keep};
use crate::model::Model;
use crate::report::CutOff;
use crate::runs::Runs;

/// Writes the state graph of a model, each transition with what happens in it. Says why it is not the
/// whole, where it is not; then nothing has been written. Where robots are symmetric, one state stands
/// for all that differ in which of them is which, and what happens is said of that one.
///
/// # Errors
/// Those of `to`.
///
/// # Panics
/// With 2^32 states or more.
pub fn export(
    model: &Model,
    options: &Options,
    to: &mut (impl Write + Seek),
) -> io::Result<Option<CutOff>> {
    let graph = Graph::build(
        model,
        Keep::Transitions,
        options,
        &options.limits(),
        &mut |_| (),
    );
    if graph.cut_off().is_some() {
        return Ok(graph.cut_off());
    }
    let runs = Runs {
        model,
        graph: &graph,
    };
    let states = u32::try_from(graph.states()).expect("fewer than 2^32 states");
    let header = to.stream_position()?;
    // How many transitions there are is known in the end.
    aut_header(to, 0, states)?;
    let mut transitions = 0;
    for from in 0..states {
        for (action, edge) in runs.transitions(from) {
            transitions += 1;
            let (what, to_state) = (label(model, action).replace('"', "'"), edge.to);
            writeln!(to, "({from}, \"{what}\", {to_state})")?;
        }
    }
    to.seek(SeekFrom::Start(header))?;
    aut_header(to, transitions, states)?;
    to.seek(SeekFrom::End(0))?;
    Ok(None)
}

/// As long for any number of transitions, so that it can be written over.
fn aut_header(to: &mut impl Write, transitions: u64, states: u32) -> io::Result<()> {
    writeln!(to, "des (0, {transitions:>20}, {states})")
}
