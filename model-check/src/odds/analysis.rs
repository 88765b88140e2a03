//! The stages of a crossing one after the other, at all loss rates.

use crossguard_protocol::Millis;
use serde::Serialize;

use super::enclosure::Enclosure;
use super::figures::{Beginning, Frame, LossOdds, MilestoneOdds, StageSize};
use super::flow::{Flow, FlowCut, FlowLimits, flow};
use super::setup::{Coupling, OddsImpossibility, OddsSetup};
use super::space::StageSpace;
use super::stage::{Milestone, Stage};
use super::team::{TeamModel, TeamState};
use crate::exploration::Stop;
use crate::node::{Protocol, Rules};

/// A team whose chances are worked out.
pub struct OddsModel(TeamModel);

/// Odds of a team.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct TeamOdds {
    /// The stages that were looked at.
    pub sizes: Vec<StageSize>,
    /// For each loss rate, in the order in which they were asked for.
    pub losses: Vec<LossOdds>,
}

/// How far an analysis is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OddsProgress {
    /// The stage that is worked on.
    pub stage: Stage,
    /// The loss rate.
    pub loss: f64,
    /// How many of all stages at all rates are done.
    pub done: usize,
    /// How many there are.
    pub of: usize,
}

/// Why nothing can be said of a team.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum OddsError {
    /// There is no such channel.
    #[error(transparent)]
    Impossible(#[from] OddsImpossibility),
    /// It was given up.
    #[error(transparent)]
    Cut(#[from] FlowCut),
}

/// Results so far at one loss rate, between two stages.
struct Interim {
    odds: LossOdds,
    /// The states in which the stage before was completed.
    completed: Vec<(TeamState, f64)>,
}

impl OddsModel {
    /// The model of a team with the transition function of the kit.
    #[must_use]
    pub fn new(setup: OddsSetup) -> Self {
        Self::with_rules(setup, Protocol)
    }

    /// The model with another transition function in place of the kit's.
    #[must_use]
    pub fn with_rules(setup: OddsSetup, rules: impl Rules + 'static) -> Self {
        Self(TeamModel::new(setup, Box::new(rules)))
    }

    /// Odds of the team at these loss rates. `watch` receives the progress.
    ///
    /// # Errors
    /// There is no such channel, or it was given up.
    pub fn odds(
        &mut self,
        losses: &[f64],
        stop: &Stop,
        watch: &mut dyn FnMut(OddsProgress),
    ) -> Result<TeamOdds, OddsError> {
        for &loss in losses {
            self.0.setup().check_loss(loss)?;
        }
        let joint = self.setup().coupling() == Coupling::Joint;
        let stages = Stage::ALL;
        // One link at a time begins anew, so that its states are its own.
        let again = usize::from(!joint);
        let of = (stages.len() + again) * losses.len();
        let mut done = 0;
        let mut tell = |stage, loss| {
            watch(OddsProgress {
                stage,
                loss,
                done,
                of,
            });
            done += 1;
        };
        let of_all = if joint { &stages[..] } else { &stages[..1] };
        let mut odds = self.go_through(losses, of_all, 1, stop, &mut tell)?;
        if again > 0 {
            let links = self.setup().followers;
            self.0.look_at_one_link(true);
            let one = self.go_through(losses, &stages, links, stop, &mut tell);
            self.0.look_at_one_link(false);
            odds.add_link_by_link(one?);
        }
        Ok(odds)
    }

    /// The figures of these stages; of `links` independent links one is looked at.
    fn go_through(
        &mut self,
        losses: &[f64],
        stages: &[Stage],
        links: u8,
        stop: &Stop,
        tell: &mut dyn FnMut(Stage, f64),
    ) -> Result<TeamOdds, FlowCut> {
        let mut interim: Vec<Interim> = losses.iter().map(|&loss| Interim::at(loss)).collect();
        let mut sizes = Vec::new();
        for &stage in stages {
            let limits = self.limits(stage);
            let frame = self.frame(links);
            let mut space = StageSpace::new(&mut self.0, stage);
            for interim in &mut interim {
                tell(stage, interim.odds.loss);
                interim.go_through(&mut space, limits, frame, stop)?;
            }
            sizes.push(StageSize {
                stage,
                states: space.states(),
                transitions: space.transitions(),
            });
        }
        let losses = interim.into_iter().map(|it| it.odds).collect();
        Ok(TeamOdds { sizes, losses })
    }

    /// The team and its surroundings.
    #[must_use]
    pub const fn setup(&self) -> &OddsSetup {
        self.0.setup()
    }

    fn limits(&self, stage: Stage) -> FlowLimits {
        let (setup, settings) = (self.setup(), self.setup().config.settings());
        let ticks = |time| setup.grid().ticks(time);
        FlowLimits {
            horizon: (stage == Stage::Holding).then(|| ticks(setup.hold())),
            width: self.0.width() / 3.0,
            help: (stage == Stage::Gathering).then(|| ticks(settings.t_help)),
        }
    }

    /// Parameters of a stage's figures, where one of `links` independent links is looked at.
    fn frame(&self, links: u8) -> Frame {
        Frame {
            grid: self.setup().grid(),
            latest: self.latest(),
            links,
        }
    }

    /// A time after which neither of the first two stages goes on: a request, a member that does not join, the
    /// repetitions of a command, a lease and a follower without one all come to an end.
    fn latest(&self) -> Millis {
        let (setup, settings) = (self.setup(), self.setup().config.settings());
        let repeated = settings
            .t_ack
            .0
            .saturating_mul(u32::from(settings.n_ack) + 1);
        let times = [
            settings.t_help,
            setup.config.t_lost(),
            Millis(repeated),
            settings.t_lease,
            // Each of them up to a tick late, and messages on their way.
            Millis(setup.grid().tick.0.saturating_mul(20)),
            Millis(setup.grid().delay.0.saturating_mul(4)),
        ];
        times.into_iter().fold(Millis::ZERO, Millis::saturating_add)
    }
}

impl Interim {
    const fn at(loss: f64) -> Self {
        let odds = LossOdds {
            loss,
            crossing: Enclosure {
                lower: 0.0,
                upper: 1.0,
            },
            milestones: Vec::new(),
            not_followed: 0.0,
        };
        let completed = Vec::new();
        Self { odds, completed }
    }

    fn go_through(
        &mut self,
        space: &mut StageSpace<'_>,
        limits: FlowLimits,
        frame: Frame,
        stop: &Stop,
    ) -> Result<(), FlowCut> {
        let odds = &mut self.odds;
        let start = if space.stage == Stage::Gathering {
            space.start(odds.loss)
        } else {
            space.enter(&self.completed)
        };
        let beginning = Beginning {
            mass: start.iter().map(|(_, mass)| mass).sum(),
            unknown: odds.not_followed,
        };
        let flow = flow(space, odds.loss, &start, limits, stop)?;
        let unknown = flow.unknown.last().copied().unwrap_or(0.0);
        if beginning.mass > 0.0 {
            for (milestone, curve) in &flow.reached {
                let reached = MilestoneOdds::of(*milestone, curve, &flow, beginning, frame);
                odds.milestones.push(reached);
            }
        }
        if space.stage == Stage::Holding {
            odds.crossing = uninterrupted(&flow, beginning, unknown);
        }
        odds.not_followed += unknown;
        self.completed = flow.completed;
        Ok(())
    }
}

/// The probability that the last stage begins and nothing interrupts it.
fn uninterrupted(flow: &Flow, beginning: Beginning, unknown: f64) -> Enclosure {
    let interrupted = flow
        .reached
        .iter()
        .find(|(milestone, _)| *milestone == Milestone::Interrupted)
        .and_then(|(_, curve)| curve.last().copied())
        .unwrap_or(0.0);
    let goes_on = beginning.mass - interrupted;
    Enclosure::probability(goes_on - unknown, goes_on + beginning.unknown)
}

impl TeamOdds {
    /// Takes over what is known of the stages after the first one from an analysis link by link.
    fn add_link_by_link(&mut self, one: Self) {
        let is_later = |stage: Stage| stage != Stage::Gathering;
        self.sizes
            .extend(one.sizes.into_iter().filter(|size| is_later(size.stage)));
        for (all, one) in self.losses.iter_mut().zip(one.losses) {
            let later = one.milestones.into_iter().filter(|it| is_later(it.stage));
            all.milestones.extend(later);
            all.not_followed += one.not_followed;
            all.crossing = all.product();
        }
    }
}

impl LossOdds {
    /// Odds of a milestone.
    #[must_use]
    pub fn milestone(&self, milestone: Milestone) -> Option<&MilestoneOdds> {
        self.milestones.iter().find(|it| it.milestone == milestone)
    }

    /// The probability that one stage after the other goes well.
    fn product(&self) -> Enclosure {
        let of = |milestone| self.milestone(milestone).map(|it| it.probability);
        let uninterrupted = of(Milestone::Interrupted).map(Enclosure::complement);
        let factors = [of(Milestone::Team), of(Milestone::Open), uninterrupted];
        let mut product = Enclosure::probability(1.0, 1.0);
        for factor in factors {
            // A stage that never begins never ends well.
            let factor = factor.unwrap_or(Enclosure::probability(0.0, self.not_followed));
            product.lower *= factor.lower;
            product.upper *= factor.upper;
        }
        product
    }
}
