//! Which robots of a timed scenario belong together.

use crate::scenario::setup::{MAX_ROBOTS, RobotSetup};

pub(crate) const MAX_TEAMS: usize = 2;

/// Which robots belong together. Where two detect, each leads a team of its own, which is itself and the
/// robots that are listed after it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Teams {
    leaders: Vec<u8>,
    /// By place.
    of: [usize; MAX_ROBOTS],
}

impl Teams {
    pub(super) fn of(robots: &[RobotSetup]) -> Option<Self> {
        let detects = |place: &u8| robots[usize::from(*place)].detects;
        let leaders: Vec<u8> = (0..).take(robots.len()).filter(detects).collect();
        let begins = |place: u8| leaders.iter().filter(|leader| **leader <= place).count();
        let mut of = [0; MAX_ROBOTS];
        match leaders.len() {
            1 => {}
            2 if leaders[0] == 0 => {
                for (place, team) in (0..).zip(&mut of) {
                    *team = begins(place) - 1;
                }
            }
            _ => return None,
        }
        Some(Self { leaders, of })
    }

    pub(crate) fn leaders(&self) -> &[u8] {
        &self.leaders
    }

    pub(crate) fn leads(&self, place: u8) -> bool {
        self.leaders.contains(&place)
    }

    /// The team of the robot at `place`, from 0.
    pub(crate) const fn team_of(&self, place: u8) -> usize {
        self.of[place as usize]
    }

    pub(crate) const fn are_two(&self) -> bool {
        self.leaders.len() == 2
    }
}
