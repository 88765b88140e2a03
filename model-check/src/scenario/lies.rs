//! Whether a scenario fits insiders that lie; [`utterances`](crate::utterances) says what they do.

use crossguard_protocol::StationId;

use super::location::Location;
use super::setup::RobotSetup;

/// What does not fit an insider that lies.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unliable {
    /// A robot that lies runs no transition function.
    #[error("robot {0} lies, so it detects nobody: it says what it likes without 'detects = true'")]
    Detects(StationId),
    /// Nobody is there to be lied to.
    #[error("all robots lie: at least one must not")]
    Nobody,
    /// What the model does not have together with liars.
    #[error("'{0}' and robots that lie exclude each other: {1}")]
    With(&'static str, &'static str),
}

/// Whether the robots that lie fit the rest of the scenario.
pub(super) fn check(
    robots: &[RobotSetup],
    others: [(&'static str, bool); 4],
) -> Result<(), (Location, Unliable)> {
    const WHY: [&str; 4] = [
        "an insider says again whatever it has said, so its own messages need no such channel",
        "it is not modelled who is who among robots to which a liar says different things",
        "the timed model has no insiders",
        "nothing is assumed of an insider, so nothing comes of cooperation",
    ];
    let mut liars = robots.iter().filter(|robot| robot.lies.is_some());
    if let Some(detects) = liars.clone().find(|robot| robot.detects) {
        let cause = Unliable::Detects(detects.station);
        return Err((Location::Key("detects"), cause));
    }
    if liars.clone().count() == robots.len() {
        return Err((Location::Key("lies"), Unliable::Nobody));
    }
    if liars.next().is_some()
        && let Some(at) = others.iter().position(|(_, is_set)| *is_set)
    {
        let key = others[at].0;
        return Err((Location::Key(key), Unliable::With(key, WHY[at])));
    }
    Ok(())
}
