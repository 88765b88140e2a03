//! Whether the robots that a scenario calls symmetric are; [`symmetry`](crate::symmetry) says what that is.

use crossguard_protocol::StationId;
use toml::Spanned;

use super::location::Location;
use super::setup::{Bounds, RobotSetup};
use crate::properties::PropertyId;

/// What is wrong with the symmetry that a scenario claims.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Asymmetry {
    /// Not the station id of a robot.
    #[error("no robot has station id {0}, so it cannot be symmetric")]
    NoRobot(StationId),
    /// A robot that is named twice.
    #[error("robot {0} is named twice")]
    Twice(StationId),
    /// A single robot.
    #[error("robot {0} is the only symmetric one: name two robots or more")]
    Alone(StationId),
    /// A robot that may detect a pedestrian.
    #[error("robot {0} detects: the station ids decide which of two requesters goes before")]
    Detects(StationId),
    /// A requester may choose.
    #[error(
        "followers = {followers}: where a requester may choose, the station ids decide, so \
         symmetric robots need followers = {needed}, all robots but the requester"
    )]
    Chosen {
        /// How many are asked for.
        followers: u8,
        /// How many must be asked for.
        needed: usize,
    },
    /// A robot may change its pseudonym.
    #[error(
        "disturbances = {0}: a robot that offers under two pseudonyms gives a requester a choice, and \
         the station ids decide; symmetric robots need disturbances = 0"
    )]
    Pseudonyms(u8),
    /// A timed scenario.
    #[error(
        "symmetric robots have no place in a timed scenario: its model treats every robot as different"
    )]
    Timed,
    /// A property under fairness.
    #[error("{0} assumes fairness to each robot by itself, which symmetric robots do not show")]
    Fairness(PropertyId),
}

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
    pub(super) fn check(
        &self,
        stations: &[Spanned<StationId>],
    ) -> Result<Vec<StationId>, (Location, Asymmetry)> {
        for (i, spanned) in stations.iter().enumerate() {
            let station = *spanned.get_ref();
            let named = stations[..i].iter().map(Spanned::get_ref);
            let robot = self.robots.iter().find(|robot| robot.station == station);
            let cause = match robot {
                None => Asymmetry::NoRobot(station),
                Some(_) if named.into_iter().any(|other| *other == station) => {
                    Asymmetry::Twice(station)
                }
                Some(robot) if robot.detects => Asymmetry::Detects(station),
                Some(_) if stations.len() == 1 => Asymmetry::Alone(station),
                Some(_) => continue,
            };
            return Err((Location::Offset(spanned.span().start), cause));
        }
        if !stations.is_empty() {
            self.check_surroundings()?;
        }
        Ok(stations.iter().map(|station| *station.get_ref()).collect())
    }

    fn check_surroundings(&self) -> Result<(), (Location, Asymmetry)> {
        if self.is_timed {
            return Err((Location::Key("symmetric"), Asymmetry::Timed));
        }
        let (followers, needed) = (self.followers, self.robots.len() - 1);
        if usize::from(followers) != needed {
            let cause = Asymmetry::Chosen { followers, needed };
            return Err((Location::Key("followers"), cause));
        }
        if self.bounds.disturbances > 0 {
            let cause = Asymmetry::Pseudonyms(self.bounds.disturbances);
            return Err((Location::Key("disturbances"), cause));
        }
        for name in self.properties {
            if let Ok(id) = name.get_ref().parse::<PropertyId>()
                && id.is_of_runs()
            {
                return Err((Location::Offset(name.span().start), Asymmetry::Fairness(id)));
            }
        }
        Ok(())
    }
}
