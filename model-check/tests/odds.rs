//! Probabilities and times under loss, against what can be worked out by hand.

use crossguard_model_check::check::Stop;
use crossguard_model_check::node::Rules;
use crossguard_model_check::odds::{
    Coupling, Enclosure, LossOdds, Milestone, MilestoneOdds, OddsModel, OddsSetup, TimeGrid,
};
use crossguard_protocol::{Config, Input, Millis, Output, Outputs, Rmcm, Robot, Settings};

const DELAY: Millis = Millis(50);
const HOLD: Millis = Millis(21_600);

fn setup(config: Config, followers: u8) -> OddsSetup {
    let grid = TimeGrid::coarsest(&config, DELAY);
    OddsSetup::new(config, followers, grid, None, HOLD).unwrap()
}

fn odds_of(mut model: OddsModel, losses: &[f64]) -> Vec<LossOdds> {
    let odds = model.odds(losses, &Stop::default(), &mut |_| ());
    odds.unwrap().losses
}

fn pair(losses: &[f64]) -> Vec<LossOdds> {
    odds_of(OddsModel::new(setup(Config::default(), 1)), losses)
}

fn of(odds: &LossOdds, milestone: Milestone) -> &MilestoneOdds {
    odds.milestone(milestone).unwrap()
}

#[track_caller]
fn assert_encloses(found: Enclosure, by_hand: f64, tolerance: f64) {
    let is_inside = found.lower - tolerance <= by_hand && by_hand <= found.upper + tolerance;
    assert!(is_inside, "{found}, not {by_hand}");
}

#[test]
fn without_loss_everything_happens_for_certain_and_at_once() {
    for followers in [1, 2, 3] {
        let model = OddsModel::new(setup(Config::default(), followers));
        let [odds] = &odds_of(model, &[0.0])[..] else {
            panic!("one loss rate");
        };
        let (lower, upper) = (1.0, 1.0);
        assert_eq!(odds.crossing, Enclosure { lower, upper });
        // Request, offer, list of followers, echo; command and acknowledgement: a delay each.
        let times = [
            (Milestone::Team, 4 * 50),
            (Milestone::Received, 50),
            (Milestone::Acknowledged, 2 * 50),
            (Milestone::Open, 2 * 50),
        ];
        for (milestone, ms) in times {
            let odds = of(odds, milestone);
            assert_encloses(odds.probability, 1.0, 0.0);
            let mut quantiles = odds.quantiles.iter();
            assert!(quantiles.all(|it| it.ms == Some(ms)), "{odds:?}");
        }
        for milestone in [Milestone::Interrupted, Milestone::FellBack] {
            let probability = of(odds, milestone).probability;
            assert!(probability.upper <= 0.0, "{milestone:?}");
        }
    }
}

#[test]
fn a_command_arrives_as_often_as_the_geometric_series_of_its_repetitions_says() {
    for n_ack in [1, 3, 5] {
        let settings = Settings {
            n_ack,
            ..Settings::default()
        };
        let model = OddsModel::new(setup(Config::new(settings).unwrap(), 1));
        let losses = [0.1, 0.3, 0.6];
        for (odds, loss) in odds_of(model, &losses).iter().zip(losses) {
            let received = of(odds, Milestone::Received);
            // The first try takes the delay, each other one comes t_ack later.
            for repeats in 0..=i32::from(n_ack) {
                let ms = 50 + 600 * u64::try_from(repeats).unwrap();
                assert_encloses(received.within(ms), 1.0 - loss.powi(repeats + 1), 1e-8);
                // And no sooner than that.
                assert_encloses(received.within(ms - 1), 1.0 - loss.powi(repeats), 1e-8);
            }
            assert!(received.probability.width() < 1e-8);
        }
    }
}

#[test]
fn a_pair_is_gathered_in_four_messages_of_which_each_is_repeated_until_it_arrives() {
    let losses = [0.1, 0.3, 0.5];
    for (odds, loss) in pair(&losses).iter().zip(losses) {
        // Four geometric numbers of periods of 100 ms, and four delays.
        let by_hand = 4.0 * 50.0 + 4.0 * 100.0 * loss / (1.0 - loss);
        let mean = of(odds, Milestone::Team).mean_ms.unwrap();
        // By t_help of 10 s the request may have ended, and an offer by 3 s, which happens hardly ever.
        assert_encloses(mean, by_hand, 0.01);
        let deviation = of(odds, Milestone::Team).deviation_ms.unwrap();
        let by_hand = 100.0 * (4.0 * loss).sqrt() / (1.0 - loss);
        assert!(
            (deviation - by_hand).abs() < 0.1,
            "{loss}: {deviation}, not {by_hand}"
        );
    }
}

crossguard_testkit::weakenings! {
    /// A leader that never repeats a command.
    Unrepeating(robot, config, input) {
        let outputs = robot.step(config, input);
        let is_repetition = |output: &&Output| {
            matches!(input, Input::Elapsed(_))
                && matches!(output, Output::SendRmcm(Rmcm::Command(_)))
        };
        let kept = outputs.iter().filter(|output| !is_repetition(output));
        kept.copied().collect()
    }
}

#[test]
fn a_leader_that_does_not_repeat_its_command_is_told_by_the_numbers() {
    let weak = OddsModel::with_rules(setup(Config::default(), 1), Unrepeating);
    let weak = odds_of(weak, &[0.3]);
    let received = of(&weak[0], Milestone::Received).probability;
    assert_encloses(received, 0.7, 1e-8);
    let sound = pair(&[0.3]);
    let sound = of(&sound[0], Milestone::Received).probability;
    assert_encloses(sound, 1.0 - 0.3_f64.powi(4), 1e-8);
}

#[test]
fn bursts_interrupt_where_as_many_single_losses_do_not() {
    let config = Config::default();
    let grid = TimeGrid::coarsest(&config, DELAY);
    let bursty = OddsSetup::new(config, 1, grid, Some(Millis(500)), HOLD).unwrap();
    let bursty = odds_of(OddsModel::new(bursty), &[0.1]);
    let interrupted = |odds: &[LossOdds]| of(&odds[0], Milestone::Interrupted).probability;
    let (bursty, single) = (interrupted(&bursty), interrupted(&pair(&[0.1])));
    assert!(bursty.lower > 0.05, "{bursty}");
    assert!(single.upper < 1e-6, "{single}");
}

#[test]
fn links_one_at_a_time_come_to_what_all_together_come_to() {
    // Few repetitions and a short lease keep the states of two followers few.
    let settings = Settings {
        n_ack: 1,
        t_ack: Millis(200),
        t_lease: Millis(500),
        t_safety: Millis(600),
        t_leave: Millis(500),
        ..Settings::default()
    };
    let config = Config::new(settings).unwrap();
    let trio = |coupling| {
        let setup = setup(config.clone(), 2)
            .with_coupling(coupling)
            .with_width(1e-5);
        odds_of(OddsModel::new(setup), &[0.3])
    };
    let (joint, link_by_link) = (trio(Coupling::Joint), trio(Coupling::LinkByLink));
    for milestone in Milestone::ALL {
        let [joint, one] = [&joint, &link_by_link].map(|odds| of(&odds[0], milestone).probability);
        let difference = (joint.middle() - one.middle()).abs();
        assert!(difference < 2e-3, "{milestone:?}: {joint} and {one}");
    }
    let received = of(&joint[0], Milestone::Received).probability;
    assert_encloses(received, (1.0 - 0.3_f64.powi(2)).powi(2), 1e-4);
}
