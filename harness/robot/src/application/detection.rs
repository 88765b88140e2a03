//! What a robot does about the people at its crossing: it calls for help when somebody waits, ends a call that
//! nobody needs any more, and says what its sensors have.

use std::collections::BTreeMap;

use crossguard_endpoint::ras::clustering::PerceivedVru;
use crossguard_protocol::{Availability, Corridor, Event, HelpRequest, Phase, Robot};

use super::{Application, Stimulus};
use crate::plan::Plan;
use crate::sight::{Seen, Sight};
use crate::site::Place;
use crate::street::Road;
use crate::zone::{Conduct, SENSORS_LAST_S};

/// How long a robot waits after a call before it calls again, in seconds.
const CALL_PERIOD_S: f64 = 2.0;

/// Shortest time between two sights, in seconds.
const SIGHT_PERIOD_S: f64 = 0.2;

/// Capacity for people in a sight.
const SEEN_MAX: usize = 256;

/// What a robot calls for, and what it sees.
#[derive(Debug, Default)]
pub(super) struct Detection {
    /// What its session stands at.
    session: Standing,
    /// When it called last, or a session that it called for ended.
    called_s: Option<f64>,
    /// Whether the session is one that the zone called for.
    is_called: bool,
    /// Whether somebody was let across in the session.
    has_opened: bool,
    people: BTreeMap<u32, (PerceivedVru, f64)>,
    /// What was said last, and when.
    said: Option<(f64, Sight)>,
}

/// What the robot may do about a call.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
enum Standing {
    /// It may call.
    #[default]
    Free,
    /// It asks for help.
    Requesting,
    /// It leads.
    Leading,
    /// It has a part in another robot's session, a duty, or is unavailable.
    Bound,
}

impl Detection {
    /// Takes in what the protocol knows after a step, at `now_s`.
    pub(super) fn learn(&mut self, now_s: f64, robot: &Robot) {
        let is_available = robot.availability() == Availability::Available;
        let standing = match robot.phase() {
            Phase::Idle if is_available && robot.duty().is_none() => Standing::Free,
            Phase::Requesting(_) => Standing::Requesting,
            Phase::Leading(_) => Standing::Leading,
            Phase::Idle | Phase::Offering(_) | Phase::Following(_) => Standing::Bound,
        };
        let before = std::mem::replace(&mut self.session, standing);
        let was_own = matches!(before, Standing::Requesting | Standing::Leading);
        if was_own && matches!(standing, Standing::Free | Standing::Bound) {
            self.end(now_s);
        }
    }

    /// The corridor is open.
    pub(super) const fn open(&mut self) {
        self.has_opened = true;
    }

    /// The call is over, or had no effect.
    pub(super) fn end(&mut self, now_s: f64) {
        (self.is_called, self.has_opened) = (false, false);
        self.called_s = Some(now_s);
    }

    fn may_call(&self, now_s: f64) -> bool {
        let is_past = |called_s| now_s - called_s >= CALL_PERIOD_S;
        self.session == Standing::Free && !self.is_called && self.called_s.is_none_or(is_past)
    }
}

impl Application {
    /// The sensors have somebody, at a place on the site.
    pub fn perceive(&mut self, vru: &PerceivedVru) {
        if let Road::Watched(watched) = &mut self.road {
            watched.perceive(self.at_s, vru);
        }
        let people = &mut self.detection.people;
        if people.len() < SEEN_MAX || people.contains_key(&vru.id) {
            people.insert(vru.id, (*vru, self.at_s));
        }
    }

    /// The sensors work, and have nobody.
    pub fn perceive_nobody(&mut self) {
        if let Road::Watched(watched) = &mut self.road {
            watched.perceive_nobody(self.at_s);
        }
    }

    /// Calls for help when somebody waits to cross, and ends the call when everybody has left before they were
    /// let across.
    pub(super) fn watch_zone(&mut self) {
        let (now_s, is_preparing) = (self.at_s, self.is_preparing());
        let Road::Watched(watched) = &mut self.road else {
            return;
        };
        watched.elapse(now_s);
        let detection = &mut self.detection;
        if let Some(urgency) = watched.urgency(now_s)
            && detection.may_call(now_s)
        {
            (detection.is_called, detection.called_s) = (true, Some(now_s));
            if let (Some(plan), Some(place)) = (&mut self.plan, watched.middle(now_s)) {
                plan.begin_near(place);
            }
            let request = match &self.plan {
                Some(plan) => plan.request(),
                None => Plan::crossing(self.site).request(),
            };
            let request = HelpRequest { urgency, ..request };
            self.wish(Stimulus::Event(Event::PedestrianDetected(request)));
            return;
        }
        let is_own = match detection.session {
            Standing::Requesting => true,
            // Once guards are commanded the plan goes to its end, and they are free then: a session that is left
            // would have them wait for somebody's word that the road is clear. Without a plan, somebody else says
            // when the task is over.
            Standing::Leading => is_preparing && self.corridor == Corridor::Clear,
            Standing::Free | Standing::Bound => false,
        };
        if detection.is_called && is_own && !detection.has_opened && watched.is_deserted(now_s) {
            self.wish(Stimulus::Event(Event::LeaveRequested));
        }
    }

    /// Whether its plan has stages before the last one, in which nobody crosses.
    fn is_preparing(&self) -> bool {
        let stages = self.plan.as_ref().map(|plan| plan.stages.len());
        let stage = self.errand.as_ref().map(|errand| errand.stage + 1);
        stage.is_some() && stage < stages
    }

    /// What the sensors have now, if that has changed since it was said last.
    pub fn next_sight(&mut self) -> Option<Sight> {
        let now_s = self.at_s;
        let said_s = self.detection.said.as_ref().map(|(said_s, _)| *said_s);
        if said_s.is_some_and(|said_s| now_s - said_s < SIGHT_PERIOD_S) {
            return None;
        }
        let people = &mut self.detection.people;
        people.retain(|_, (_, told_s)| now_s - *told_s <= SENSORS_LAST_S);
        let conduct = |id| match &self.road {
            Road::Watched(watched) => watched.conduct(now_s, id),
            Road::Unknown | Road::Known(_) | Road::Own(_) => Conduct::Elsewhere,
        };
        let people = people.iter().map(|(id, (vru, _))| {
            let [east, north] = vru.position_m;
            Seen {
                place: self.site.coordinates(Place::new(east, north)),
                class: vru.class,
                conduct: conduct(*id),
            }
        });
        let sight = Sight {
            people: people.collect(),
        };
        let said = self.detection.said.as_ref();
        let is_new = said.map_or(!sight.people.is_empty(), |(_, said)| *said != sight);
        is_new.then(|| {
            self.detection.said = Some((now_s, sight.clone()));
            sight
        })
    }
}
