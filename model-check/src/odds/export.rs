//! Chains as other model checkers read them: PRISM's explicit files, and DRN, which Storm reads.
//!
//! The states of both are numbered as in the chain. The label `init` is on the first one, `over` on those in which
//! the chain stays. A step costs 1 in the reward structure `steps` until then.

use std::io::{self, Write};

use super::chain::MarkovChain;

/// A file of an export.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ChainFormat {
    /// Transitions, for PRISM.
    Tra,
    /// Labels, for PRISM.
    Lab,
    /// States, for PRISM.
    Sta,
    /// Rewards of states, for PRISM.
    Srew,
    /// Everything, for Storm.
    Drn,
}

impl ChainFormat {
    /// All files.
    pub const ALL: [Self; 5] = [Self::Tra, Self::Lab, Self::Sta, Self::Srew, Self::Drn];

    /// What the name of such a file ends with.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Tra => "tra",
            Self::Lab => "lab",
            Self::Sta => "sta",
            Self::Srew => "srew",
            Self::Drn => "drn",
        }
    }

    /// Writes a chain.
    ///
    /// # Errors
    /// It cannot be written to `to`.
    pub fn write(self, chain: &MarkovChain, to: &mut impl Write) -> io::Result<()> {
        match self {
            Self::Tra => write_tra(chain, to),
            Self::Lab => write_lab(chain, to),
            Self::Sta => write_sta(chain, to),
            Self::Srew => write_srew(chain, to),
            Self::Drn => write_drn(chain, to),
        }
    }
}

/// The labels of a state besides `init`, each with its number.
fn labels(chain: &MarkovChain, state: usize) -> impl Iterator<Item = (usize, &str)> {
    let names = chain.label_names().iter().enumerate();
    let of_chain = names
        .filter(move |(label, _)| chain.has(state, *label))
        .map(|(label, name)| (label + 2, name.as_str()));
    chain
        .is_absorbing(state)
        .then_some((1, "over"))
        .into_iter()
        .chain(of_chain)
}

fn write_tra(chain: &MarkovChain, to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "{} {}", chain.states(), chain.transitions())?;
    for state in 0..chain.states() {
        for (next, probability) in sorted(chain, state) {
            writeln!(to, "{state} {next} {probability}")?;
        }
    }
    Ok(())
}

fn write_lab(chain: &MarkovChain, to: &mut impl Write) -> io::Result<()> {
    write!(to, "0=\"init\" 1=\"over\"")?;
    for (label, name) in chain.label_names().iter().enumerate() {
        write!(to, " {}=\"{name}\"", label + 2)?;
    }
    writeln!(to)?;
    for state in 0..chain.states() {
        let init = (state == 0).then_some(0);
        let all = init
            .into_iter()
            .chain(labels(chain, state).map(|(label, _)| label));
        let all: Vec<String> = all.map(|label| label.to_string()).collect();
        if !all.is_empty() {
            writeln!(to, "{state}: {}", all.join(" "))?;
        }
    }
    Ok(())
}

fn write_sta(chain: &MarkovChain, to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "(s)")?;
    for state in 0..chain.states() {
        writeln!(to, "{state}:({state})")?;
    }
    Ok(())
}

fn write_srew(chain: &MarkovChain, to: &mut impl Write) -> io::Result<()> {
    let costs = |state: &usize| !chain.is_absorbing(*state);
    let count = (0..chain.states()).filter(costs).count();
    writeln!(to, "{} {count}", chain.states())?;
    for state in (0..chain.states()).filter(costs) {
        writeln!(to, "{state} 1")?;
    }
    Ok(())
}

fn write_drn(chain: &MarkovChain, to: &mut impl Write) -> io::Result<()> {
    let states = chain.states();
    writeln!(to, "@type: DTMC\n@parameters\n\n@reward_models\nsteps")?;
    writeln!(to, "@nr_states\n{states}\n@nr_choices\n{states}\n@model")?;
    for state in 0..states {
        write!(
            to,
            "state {state} [{}]",
            u8::from(!chain.is_absorbing(state))
        )?;
        if state == 0 {
            write!(to, " init")?;
        }
        for (_, name) in labels(chain, state) {
            write!(to, " {name}")?;
        }
        writeln!(to, "\n\taction 0 [0]")?;
        for (next, probability) in sorted(chain, state) {
            writeln!(to, "\t\t{next} : {probability}")?;
        }
    }
    Ok(())
}

/// The transitions of a state, in the order of where they lead.
fn sorted(chain: &MarkovChain, state: usize) -> Vec<(u32, f64)> {
    let mut row = chain.row(state).to_vec();
    row.sort_by_key(|(next, _)| *next);
    row
}
