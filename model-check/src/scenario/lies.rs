//! Whether a scenario fits insiders that lie; [`utterances`](crate::utterances) says what they do.

use super::location::Wrong;
use super::setup::RobotSetup;

/// Whether the robots that lie fit the rest of the scenario.
pub(super) fn check(robots: &[RobotSetup], others: [(&'static str, bool); 4]) -> Result<(), Wrong> {
    const WHY: [&str; 4] = [
        "an insider says again whatever it has said, so its own messages need no such channel",
        "it is not modelled who is who among robots to which a liar says different things",
        "the timed model has no insiders",
        "nothing is assumed of an insider, so nothing comes of cooperation",
    ];
    let mut liars = robots.iter().filter(|robot| robot.lies.is_some());
    if let Some(detects) = liars.clone().find(|robot| robot.detects) {
        let station = detects.station;
        let cause = format!(
            "robot {station} lies, so it detects nobody: it says what it likes without 'detects = true'"
        );
        return Err(Wrong::key("detects", cause));
    }
    if liars.clone().count() == robots.len() {
        return Err(Wrong::key("lies", "all robots lie: at least one must not"));
    }
    if liars.next().is_some()
        && let Some(at) = others.iter().position(|(_, is_set)| *is_set)
    {
        let (key, why) = (others[at].0, WHY[at]);
        let cause = format!("'{key}' and robots that lie exclude each other: {why}");
        return Err(Wrong::key(key, cause));
    }
    Ok(())
}
