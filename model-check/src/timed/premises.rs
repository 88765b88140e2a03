//! Which premises of the properties were met.

use crate::properties::timed_view::{TimedStepView, TimedView};
use crate::properties::{PropertyId, TimedPremise};

/// The premises of the properties of a scenario, part by part.
#[derive(Clone)]
pub(super) struct Premises(Vec<PremisePart>);

#[derive(Clone)]
struct PremisePart {
    property: PropertyId,
    premise: TimedPremise,
    is_met: bool,
}

impl Premises {
    pub(super) fn of(properties: &[PropertyId]) -> Self {
        let parts = properties.iter().flat_map(|&property| {
            let premise = property.timed_rule().map_or(&[][..], |rule| rule.premise);
            premise.iter().map(move |&premise| PremisePart {
                property,
                premise,
                is_met: false,
            })
        });
        Self(parts.collect())
    }

    fn open(&mut self) -> impl Iterator<Item = &mut PremisePart> {
        self.0.iter_mut().filter(|part| !part.is_met)
    }

    pub(super) fn are_met(&self) -> bool {
        self.0.iter().all(|part| part.is_met)
    }

    pub(super) fn note(&mut self, state: &TimedView) {
        for part in self.open() {
            if let TimedPremise::State(is_met) = part.premise {
                part.is_met = is_met(state);
            }
        }
    }

    pub(super) fn note_step(&mut self, step: &TimedStepView) {
        for part in self.open() {
            if let TimedPremise::Step(is_met) = part.premise {
                part.is_met = is_met(step);
            }
        }
    }

    /// Adds what others, of the same properties, have met.
    pub(super) fn add(&mut self, others: &Self) {
        for (part, other) in self.0.iter_mut().zip(&others.0) {
            part.is_met |= other.is_met;
        }
    }

    pub(super) fn met(&self, property: PropertyId) -> bool {
        let mut parts = self.0.iter().filter(|part| part.property == property);
        parts.all(|part| part.is_met)
    }
}
