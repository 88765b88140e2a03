//! The paper's statements on its simulation, as values in one place.
//!
//! Only text is quoted; bars of the paper's figures are not read off. [`statements`](super::statements) compares
//! these with a run.

use serde::Serialize;

/// A range that the paper states, in percent.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct StatedRange {
    /// Its lower end.
    pub least: f64,
    /// Its upper end; the lower one for a single number.
    pub most: f64,
    /// Half a unit of its last digit.
    pub rounding: f64,
}

/// Values of the paper's simulation (section III-B).
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct PaperSimulation {
    /// Intersections along a side of the grid.
    pub nodes_per_side: u32,
    /// Length of a road segment in metres.
    pub segment_m: f64,
    /// Vehicles.
    pub vehicles: usize,
    /// Numbers of pedestrians.
    pub pedestrians: [usize; 3],
    /// Numbers of robots.
    pub robots: [usize; 3],
    /// Sensing radii in metres.
    pub radii_m: [f64; 2],
    /// Column and row, from 1, of the intersection at which a single robot is.
    pub central_intersection: [usize; 2],
    /// Transmission power in milliwatts.
    pub power_mw: f64,
    /// Carrier frequency in gigahertz.
    pub frequency_ghz: f64,
    /// Width of the channel in megahertz.
    pub channel_mhz: u64,
    /// Coverage of one robot at the larger radius, in percent, whatever the number of pedestrians.
    pub coverage_of_one_percent: StatedRange,
    /// The same of nine robots.
    pub coverage_of_nine_percent: StatedRange,
    /// Largest reduction of the mean channel busy ratio, in percent: by nine robots at the larger radius with 100
    /// pedestrians.
    pub reduction_most_percent: StatedRange,
}

/// The paper's values.
pub const PAPER: PaperSimulation = PaperSimulation {
    nodes_per_side: 3,
    segment_m: 100.0,
    vehicles: 20,
    pedestrians: [20, 50, 100],
    robots: [0, 1, 9],
    radii_m: [10.0, 15.0],
    central_intersection: [2, 2],
    power_mw: 200.0,
    frequency_ghz: 5.9,
    channel_mhz: 10,
    coverage_of_one_percent: StatedRange {
        least: 5.0,
        most: 6.0,
        rounding: 0.5,
    },
    coverage_of_nine_percent: StatedRange {
        least: 17.0,
        most: 18.0,
        rounding: 0.5,
    },
    reduction_most_percent: StatedRange {
        least: 16.3,
        most: 16.3,
        rounding: 0.05,
    },
};
