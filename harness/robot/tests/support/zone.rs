//! The crossing that a leader watches.

use crossguard_endpoint::ras::area::Area;
use crossguard_robot::zone::Zone;

fn strip(south: f64, north: f64) -> Area {
    let corners = [[-3.0, south], [5.0, south], [5.0, north], [-3.0, north]];
    Area::Polygon(corners.to_vec())
}

/// The carriageway, and the kerbs on either side where people wait.
pub(crate) fn of_the_crossing() -> Zone {
    Zone {
        waiting: Some(strip(-2.5, 9.5)),
        ..Zone::of_road(strip(0.0, 7.0))
    }
}
