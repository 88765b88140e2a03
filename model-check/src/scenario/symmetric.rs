//! Whether the robots that a scenario calls symmetric are; [`symmetry`](crate::symmetry) says what that is.

use toml::Spanned;

use super::file::File;
use super::location::{Location, Wrong};

pub(super) fn check(file: &File) -> Result<(), Wrong> {
    let stations = &file.symmetric;
    for (i, spanned) in stations.iter().enumerate() {
        let station = *spanned.get_ref();
        let mut named = stations[..i].iter().map(Spanned::get_ref);
        let robot = file.robots.iter().find(|robot| robot.station == station);
        let cause = match robot {
            None => format!("no robot has station id {station}, so it cannot be symmetric"),
            Some(_) if named.any(|other| *other == station) => {
                format!("robot {station} is named twice")
            }
            Some(robot) if robot.detects => format!(
                "robot {station} detects: the station ids decide which of two requesters goes before"
            ),
            Some(_) if stations.len() == 1 => {
                format!("robot {station} is the only symmetric one: name two robots or more")
            }
            Some(_) => continue,
        };
        return Err(Wrong::new(Location::Offset(spanned.span().start), cause));
    }
    if stations.is_empty() {
        return Ok(());
    }
    if file.timed.is_some() {
        let cause = "symmetric robots have no place in a timed scenario: its model treats every robot as different";
        return Err(Wrong::key("symmetric", cause));
    }
    let (followers, needed) = (*file.request.followers.get_ref(), file.robots.len() - 1);
    if usize::from(followers) != needed {
        let cause = format!(
            "followers = {followers}: where a requester may choose, the station ids decide, so \
             symmetric robots need followers = {needed}, all robots but the requester"
        );
        return Err(Wrong::key("followers", cause));
    }
    let disturbances = file.bounds.disturbances;
    if disturbances > 0 {
        let cause = format!(
            "disturbances = {disturbances}: a robot that offers under two pseudonyms gives a requester a choice, and \
             the station ids decide; symmetric robots need disturbances = 0"
        );
        return Err(Wrong::key("disturbances", cause));
    }
    file.refuse(|id| {
        id.is_of_runs().then(|| {
            format!(
                "{id} assumes fairness to each robot by itself, which symmetric robots do not show"
            )
        })
    })
}
