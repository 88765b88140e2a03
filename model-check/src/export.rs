//! State graphs in files, for other tools.

use std::io::{self, Write};

use crate::check::{Options, label};
use crate::fairness::Runs;
use crate::graph::Graph;
use crate::model::Model;
use crate::report::CutOff;

/// The form of a file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Format {
    /// A digraph of Graphviz.
    Dot,
    /// Aldébaran, which CADP and mCRL2 read.
    Aut,
}

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
    format: Format,
    to: &mut impl Write,
) -> io::Result<Option<CutOff>> {
    let graph = Graph::build(model, &options.limits(), &mut |_| false);
    if graph.cut_off().is_some() {
        return Ok(graph.cut_off());
    }
    let runs = Runs {
        model,
        graph: &graph,
    };
    let states = u32::try_from(graph.states()).expect("fewer than 2^32 states");
    match format {
        Format::Dot => writeln!(to, "digraph \"{}\" {{", model.scenario().name)?,
        Format::Aut => {
            let transitions: usize = (0..states).map(|state| runs.transitions(state).len()).sum();
            writeln!(to, "des (0, {transitions}, {states})")?;
        }
    }
    for from in 0..states {
        for (action, edge) in runs.transitions(from) {
            let (what, to_state) = (label(model, action).replace('"', "'"), edge.to);
            match format {
                Format::Dot => writeln!(to, "  {from} -> {to_state} [label=\"{what}\"];")?,
                Format::Aut => writeln!(to, "({from}, \"{what}\", {to_state})")?,
            }
        }
    }
    if format == Format::Dot {
        writeln!(to, "}}")?;
    }
    Ok(None)
}
