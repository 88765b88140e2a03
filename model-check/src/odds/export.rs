//! Chains in DRN, which Storm reads.
//!
//! States are numbered as in the chain. The label `init` is on the first one, `over` on those in which the chain stays. A
//! step costs 1 in the reward structure `steps` until then.

use std::io::{self, Write};

use super::chain::MarkovChain;

/// Writes a chain in DRN.
///
/// # Errors
/// It cannot be written to `to`.
pub fn write_drn(chain: &MarkovChain, to: &mut impl Write) -> io::Result<()> {
    let states = chain.states();
    writeln!(to, "@type: DTMC\n@parameters\n\n@reward_models\nsteps")?;
    writeln!(to, "@nr_states\n{states}\n@nr_choices\n{states}\n@model")?;
    for state in 0..states {
        let is_over = chain.is_absorbing(state);
        write!(to, "state {state} [{}]", u8::from(!is_over))?;
        if state == 0 {
            write!(to, " init")?;
        }
        if is_over {
            write!(to, " over")?;
        }
        for (label, name) in chain.label_names().iter().enumerate() {
            if chain.has(state, label) {
                write!(to, " {name}")?;
            }
        }
        writeln!(to, "\n\taction 0 [0]")?;
        let mut row = chain.row(state).to_vec();
        row.sort_by_key(|(next, _)| *next);
        for (next, probability) in row {
            writeln!(to, "\t\t{next} : {probability}")?;
        }
    }
    Ok(())
}
