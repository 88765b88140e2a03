//! Traits of a robot and state of its battery, from its robot file and its operator: they stand in every RAM.

use crossguard_codec::{Battery, Capabilities, Dimensions, JobRole, RobotState, SignalMeans};
use crossguard_protocol::{Availability, Event, Unavailability};

use super::{Application, Stimulus, micros};
use crate::runtime::Order;
use crate::sign::Shown;
use crate::street::Road;

/// A robot whose battery was low is available again this much above the limit, in percent.
const RECOVERY_PERCENT: f64 = 5.0;

/// Traits that a robot reports besides its body's state.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Traits {
    /// The job that it is there for; `None` for that of its build.
    pub job: Option<JobRole>,
    /// The box around it; `None` for that of its build.
    pub dimensions: Option<Dimensions>,
    /// Its battery; `None` while only its body may know.
    pub battery: Option<Battery>,
    /// Below this charge the robot takes no part in coordination, in percent.
    pub low_percent: f64,
    /// After so long without a word of the battery it counts as low, in seconds; `None` where its last word stands.
    pub battery_silence_s: Option<f64>,
}

impl Default for Traits {
    fn default() -> Self {
        Self {
            job: None,
            dimensions: None,
            battery: None,
            low_percent: 10.0,
            battery_silence_s: None,
        }
    }
}

impl Application {
    /// The same, which says this of itself.
    #[must_use]
    pub fn with_traits(self, traits: Traits) -> Self {
        Self { traits, ..self }
    }

    /// The same, which shows signals to people by these means, if by any.
    #[must_use]
    pub fn showing_by(self, means: Option<SignalMeans>) -> Self {
        let shown = Shown::by(means);
        Self { shown, ..self }
    }

    /// What it can do besides maneuvers: by its sensors, its plan, and the means by which it shows signals.
    fn capabilities(&self) -> Capabilities {
        let means = self.shown.means();
        let has_sensors = !matches!(self.road, Road::Unknown | Road::Heard(_));
        let can = [
            (has_sensors, Capabilities::PEDESTRIAN_DETECTION),
            (self.plan.is_some() || self.counts, Capabilities::LEADING),
            (means.contains(SignalMeans::GESTURE), Capabilities::GESTURES),
            (means.contains(SignalMeans::DISPLAY), Capabilities::DISPLAY),
            (means.contains(SignalMeans::SPEECH), Capabilities::SPEECH),
        ];
        let can = can.into_iter().filter(|(is_so, _)| *is_so);
        can.fold(Capabilities(0), |all, (_, it)| all.union(it))
    }

    /// How the robot is: what the body's sensors say, its traits, and what it shows to people.
    #[must_use]
    pub fn state(&self) -> RobotState {
        let mut state = self.body.state();
        if let Some(slow) = &mut state.slow {
            let shows_go = self.sign.shows_go(micros(self.at_s));
            slow.capabilities = self.capabilities();
            slow.signals = self.shown.told(self.faces_people.then_some(shows_go));
            slow.area = self.site.map_place;
        }
        RobotState {
            job_role: self.traits.job.unwrap_or(state.job_role),
            dimensions: self.traits.dimensions.unwrap_or(state.dimensions),
            battery: match self.traits.battery.unwrap_or(state.battery) {
                _ if self.is_battery_silent() => Battery::default(),
                battery => battery,
            },
            ..state
        }
    }

    fn is_battery_silent(&self) -> bool {
        let heard_s = self.battery_heard_s.unwrap_or(self.at_s);
        let silence_s = self.traits.battery_silence_s;
        silence_s.is_some_and(|it| self.at_s - heard_s > it)
    }

    /// Carries out an order that is for the application alone; any other one changes nothing. What is shown to
    /// pedestrians is what the sign says while the robot asks for help or leads.
    pub fn obey(&mut self, order: Order) {
        match order {
            Order::LookedInVain(why) => self.look_in_vain(why),
            Order::Battery(battery) => {
                self.traits.battery = Some(battery);
                self.battery_heard_s = Some(self.at_s);
            }
            Order::Show(signals) => self.shown.show(signals),
            Order::Job(job) => self.traits.job = Some(job),
            Order::Serve(place) => {
                self.site.map_place = place;
                if let Some(plan) = &mut self.plan {
                    plan.site.map_place = place;
                }
            }
            Order::Reset => self.body.carry_to_safe_place(),
            _ => {}
        }
    }

    /// Says that the battery is low, or is not any more. Another reason to be unavailable stands.
    pub(super) fn watch_battery(&mut self) {
        let low = Availability::Unavailable(Unavailability::LowBattery);
        self.battery_heard_s.get_or_insert(self.at_s);
        let charge = self.state().battery.state_of_charge;
        let Some(percent) = charge.or(self.is_battery_silent().then_some(f64::NEG_INFINITY)) else {
            return;
        };
        let limit = self.traits.low_percent;
        let changed = if percent < limit && self.availability == Availability::Available {
            low
        } else if percent >= limit + RECOVERY_PERCENT && self.availability == low && self.was_low {
            Availability::Available
        } else {
            return;
        };
        self.was_low = changed == low;
        self.wish(Stimulus::Event(Event::AvailabilityChanged(changed)));
    }
}
