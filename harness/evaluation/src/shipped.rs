//! The traces that come along, packed into the program.

use super::grid::Preset;
use super::trace::{TraceError, Traces};

/// Numbers of people that traces come along for.
pub const PEDESTRIANS: [usize; 3] = [20, 50, 100];

macro_rules! traces {
    ($preset:literal, $pedestrians:literal) => {
        include_bytes!(concat!(
            "../traces/",
            $preset,
            "-",
            $pedestrians,
            ".json.gz"
        ))
        .as_slice()
    };
}

/// The file of these traces; `None` when there is none.
#[must_use]
pub const fn file(preset: Preset, pedestrians: usize) -> Option<&'static [u8]> {
    Some(match (preset, pedestrians) {
        (Preset::Kerb, 20) => traces!("kerb", "20"),
        (Preset::Kerb, 50) => traces!("kerb", "50"),
        (Preset::Kerb, 100) => traces!("kerb", "100"),
        (Preset::Plain, 20) => traces!("plain", "20"),
        (Preset::Plain, 50) => traces!("plain", "50"),
        (Preset::Plain, 100) => traces!("plain", "100"),
        _ => return None,
    })
}

/// The traces of a preset with this many people; `None` when none come along.
///
/// # Errors
/// When the program is damaged.
pub fn traces(preset: Preset, pedestrians: usize) -> Option<Result<Traces, TraceError>> {
    let traces = file(preset, pedestrians).map(Traces::read)?;
    Some(traces.map(|traces| Traces {
        is_proven: true,
        ..traces
    }))
}

macro_rules! school_street {
    ($($run:literal)*) => {
        /// The people on the school street, as SUMO's floating car data: 20 runs. Its net and demand stand beside them in
        /// `places/school-street`.
        pub const SCHOOL_STREET: &[&[u8]] =
            &[$(include_bytes!(concat!("../places/school-street/", $run, ".xml.gz"))),*];
    };
}

school_street!("1" "2" "3" "4" "5" "6" "7" "8" "9" "10" "11" "12" "13" "14" "15" "16" "17" "18" "19" "20");
