//! What a demonstration can show: who takes part, and how it is to end.

use crossguard_protocol::{EndReason, ReleaseReason, StationId};
use serde::Serialize;

use crossguard_robot::body::Build;
use crossguard_robot::plan::{self, Plan};
use crossguard_robot::site::{Place, Site};

/// What happens.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Scenario {
    /// The paper's proof of concept: a humanoid leads, and a dog escorts the pedestrian across.
    #[default]
    Crossing,
    /// Two humanoids block a lane each, and the pedestrian crosses between them.
    Bilateral,
    /// A humanoid leads and blocks a lane, a second one blocks the other, and a dog escorts.
    Trio,
    /// A humanoid leads --followers others: humanoids that block the lanes, and a dog that escorts.
    Team,
    /// The dog loses power while it escorts the pedestrian.
    FollowerDies,
    /// The humanoid that leads loses power while the dog escorts.
    LeaderDies,
    /// Two humanoids detect the same pedestrian at once; a dog is there to help.
    TwoDetect,
}

/// One robot of a scenario.
#[derive(Clone, Debug)]
pub struct Participant {
    /// Its name.
    pub name: &'static str,
    /// Its station id.
    pub station: StationId,
    pub(super) build: Build,
    pub(super) place: Place,
    /// What it does when it leads; it detects the pedestrian if it has one.
    pub(super) plan: Option<Plan>,
}

/// How a crossing ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum End {
    /// The leader ended the session.
    Session(EndReason),
    /// Nobody ended it; the followers left.
    Released(ReleaseReason),
}

/// Where the dog waits: 11 cm from the place from which it escorts, since the paper's `initialPos` took about 0.50 s
/// (section III-A).
const AT_LEAD_POSITION: Place = Place::new(1.0, -1.11);

const ARI: StationId = StationId(1);
const GO2: StationId = StationId(2);
const SECOND: StationId = StationId(3);

/// The humanoids besides the first.
const OTHERS: [(&str, StationId); 15] = [
    ("ARI-2", SECOND),
    ("ARI-3", StationId(4)),
    ("ARI-4", StationId(5)),
    ("ARI-5", StationId(6)),
    ("ARI-6", StationId(7)),
    ("ARI-7", StationId(8)),
    ("ARI-8", StationId(9)),
    ("ARI-9", StationId(10)),
    ("ARI-10", StationId(11)),
    ("ARI-11", StationId(12)),
    ("ARI-12", StationId(13)),
    ("ARI-13", StationId(14)),
    ("ARI-14", StationId(15)),
    ("ARI-15", StationId(16)),
    ("ARI-16", StationId(17)),
];

/// Where the guard of this number blocks, and where it waits on the pavement beside: by turns in the far and in the
/// near lane, each 1.5 m farther from the crossing than the one before it in its lane.
fn guard(number: u8) -> (Place, Place) {
    let farther = 1.5 * f64::from(number / 2);
    let (lane, away, pavement) = match number % 2 {
        0 => (plan::FAR_LANE, farther, 8.2),
        _ => (plan::NEAR_LANE, -farther, -0.8),
    };
    let east = lane.east + away;
    (Place::new(east, lane.north), Place::new(east, pavement))
}

impl Scenario {
    /// What happens, in a sentence.
    #[must_use]
    pub const fn summary(self) -> &'static str {
        match self {
            Self::Crossing => "ARI leads, and Go2 escorts the pedestrian across.",
            Self::Bilateral => {
                "ARI and ARI-2 block a lane each, and the pedestrian crosses between them."
            }
            Self::Trio => "ARI leads and blocks a lane, ARI-2 blocks the other, and Go2 escorts.",
            Self::Team => "ARI leads three: ARI-2 and ARI-3 block a lane each, and Go2 escorts.",
            Self::FollowerDies => "Go2 loses power in the middle of the road.",
            Self::LeaderDies => "ARI, which leads, loses power while Go2 is on the road.",
            Self::TwoDetect => "ARI and ARI-2 see the same pedestrian at once; Go2 can help.",
        }
    }

    /// The robots, from left to right. A [`Team`](Self::Team) has this many followers, 1 to 16.
    #[must_use]
    pub fn participants(self, followers: u8) -> Vec<Participant> {
        let site = Site::default();
        let robot = |(name, station), build, place| Participant {
            name,
            station,
            build,
            place,
            plan: None,
        };
        let humanoid = |id, place| robot(id, Build::Humanoid, place);
        let leads = |id, place, plan| Participant {
            plan: Some(plan),
            ..humanoid(id, place)
        };
        let (ari, go2) = (("ARI", ARI), ("Go2", GO2));
        let second = OTHERS[0];
        let corner = Place::new(0.0, -1.5);
        let dog = robot(go2, Build::Quadruped, AT_LEAD_POSITION);
        let crossing = || Plan::crossing(site);
        // Each waits on the pavement beside the lane that it is going to block.
        let at_near_lane = Place::new(plan::NEAR_LANE.east, -0.8);
        let at_far_lane = humanoid(second, Place::new(plan::FAR_LANE.east, 8.2));
        match self {
            Self::Crossing | Self::FollowerDies | Self::LeaderDies => {
                vec![leads(ari, corner, crossing()), dog]
            }
            Self::Bilateral => {
                let plan = Plan::bilateral(site, SECOND);
                vec![leads(ari, at_near_lane, plan), at_far_lane]
            }
            Self::Trio => {
                let plan = Plan::trio(site, SECOND, GO2);
                vec![leads(ari, at_near_lane, plan), at_far_lane, dog]
            }
            Self::Team => {
                let blockers = usize::from(followers).saturating_sub(1);
                let blockers: Vec<_> = (0..).map(guard).zip(OTHERS).take(blockers).collect();
                let places: Vec<_> = blockers
                    .iter()
                    .map(|&((place, _), (_, station))| (station, place))
                    .collect();
                let plan = Plan::team(site, &places, GO2);
                let mut robots = vec![leads(ari, corner, plan)];
                let waiting = blockers.iter();
                robots.extend(waiting.map(|&((_, waits_at), id)| humanoid(id, waits_at)));
                robots.push(dog);
                robots
            }
            Self::TwoDetect => {
                let rival = leads(second, Place::new(3.0, -1.5), crossing());
                vec![leads(ari, corner, crossing()), rival, dog]
            }
        }
    }

    /// Name of the robot that loses power once the corridor is open.
    #[must_use]
    pub const fn victim(self) -> Option<&'static str> {
        match self {
            Self::FollowerDies => Some("Go2"),
            Self::LeaderDies => Some("ARI"),
            _ => None,
        }
    }

    /// How it is to end.
    pub(super) const fn end(self) -> End {
        match self {
            Self::FollowerDies => End::Session(EndReason::NoFollowers),
            Self::LeaderDies => End::Released(ReleaseReason::ContactLost),
            _ => End::Session(EndReason::TaskCompleted),
        }
    }
}
