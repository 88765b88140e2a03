//! Shared parts of unit tests: tables as text, and a maneuver.

use crossguard_protocol::{
    Maneuver, ManeuverId, RequestId, SessionId, SessionNumber, StationId, TaskType, UniqueNumber,
};

/// The first maneuver of the first session of station 1.
pub(crate) const fn maneuver(task: TaskType) -> Maneuver {
    let number = SessionNumber(UniqueNumber { boot: 1, count: 0 });
    let session = SessionId::of(StationId(1), number);
    let id = ManeuverId::of(session, RequestId(0));
    Maneuver { id, task }
}

/// The rows of a table: one in each line, with bars between its cells. A line break in a cell is written `\n`.
pub(crate) fn rows<const CELLS: usize>(table: &str) -> impl Iterator<Item = [String; CELLS]> {
    let lines = table.lines().filter(|line| !line.trim().is_empty());
    lines.map(|line| {
        let cells = line.split('|').map(|cell| cell.trim().replace("\\n", "\n"));
        let cells: Vec<_> = cells.collect();
        cells
            .try_into()
            .unwrap_or_else(|_| panic!("not {CELLS} cells: {line}"))
    })
}
