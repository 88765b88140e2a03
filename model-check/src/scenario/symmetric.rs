//! Whether the robots that a scenario calls symmetric are; [`symmetry`](crate::symmetry) says what that is.

use crossguard_protocol::StationId;
use toml::Spanned;

use super::location::{Location, Wrong};
use super::setup::{Bounds, RobotSetup};
use crate::properties::PropertyId;

/// The part of a scenario that decides whether its robots are symmetric.
pub(super) struct SymmetryClaim<'a> {
    pub(super) robots: &'a [RobotSetup],
    pub(super) followers: u8,
    pub(super) bounds: Bounds,
    pub(super) is_timed: bool,
    pub(super) properties: &'a [Spanned<String>],
}

impl SymmetryClaim<'_> {
    /// The station ids, if the robots are symmetric.
    pub(super) fn check(&self, stations: &[Spanned<StationId>]) -> Result<Vec<StationId>, Wrong> {
        for (i, spanned) in stations.iter().enumerate() {
            let station = *spanned.get_ref();
            let named = stations[..i].iter().map(Spanned::get_ref);
            let robot = self.robots.iter().find(|robot| robot.station == station);
            let cause = match robot {
                None => format!("no robot has station id {station}, so it cannot be symmetric"),
                Some(_) if named.into_iter().any(|other| *other == station) => {
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
        if !stations.is_empty() {
            self.check_surroundings()?;
        }
        Ok(stations.iter().map(|station| *station.get_ref()).collect())
    }

    fn check_surroundings(&self) -> Result<(), Wrong> {
        if self.is_timed {
            let cause = "symmetric robots have no place in a timed scenario: its model treats every robot as different";
            return Err(Wrong::key("symmetric", cause));
        }
        let (followers, needed) = (self.followers, self.robots.len() - 1);
        if usize::from(followers) != needed {
            let cause = format!(
                "followers = {followers}: where a requester may choose, the station ids decide, so \
                 symmetric robots need followers = {needed}, all robots but the requester"
            );
            return Err(Wrong::key("followers", cause));
        }
        if self.bounds.disturbances > 0 {
            let cause = format!(
                "disturbances = {}: a robot that offers under two pseudonyms gives a requester a choice, and \
                 the station ids decide; symmetric robots need disturbances = 0",
                self.bounds.disturbances
            );
            return Err(Wrong::key("disturbances", cause));
        }
        for name in self.properties {
            if let Ok(id) = name.get_ref().parse::<PropertyId>()
                && id.is_of_runs()
            {
                let cause = format!(
                    "{id} assumes fairness to each robot by itself, which symmetric robots do not show"
                );
                return Err(Wrong::new(Location::Offset(name.span().start), cause));
            }
        }
        Ok(())
    }
}
