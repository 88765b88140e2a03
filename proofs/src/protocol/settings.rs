//! Settings that a robot can have.

use crossguard_protocol::laws::settings as laws;
use crossguard_protocol::{Config, Inequality, Millis, Settings, TaskSet, TaskType};

use crate::harness::harnesses;
use crate::kani;

/// Settings that satisfy every inequality, with times so short that another value of one of them meets each
/// inequality at its edge.
fn short() -> Settings {
    Settings {
        ram_period: Millis(2),
        t_select: Millis(5),
        t_offer: Millis(20),
        t_help: Millis(30),
        t_ack: Millis(3),
        t_safety: Millis(40),
        t_lease: Millis(10),
        t_leave: Millis(5),
        t_farewell: Millis(6),
        t_lock: Millis(69),
        t_cross: Millis(25),
        t_exec: [Millis(30); TaskType::COUNT],
        delay_max: Millis(1),
        drift_ppm: 0,
        ..Settings::default()
    }
}

/// One of the times.
fn time_of(settings: &mut Settings, which: u8) -> &mut Millis {
    match which {
        0 => &mut settings.ram_period,
        1 => &mut settings.t_select,
        2 => &mut settings.t_offer,
        3 => &mut settings.t_help,
        4 => &mut settings.t_ack,
        5 => &mut settings.t_safety,
        6 => &mut settings.t_lease,
        7 => &mut settings.t_leave,
        8 => &mut settings.t_farewell,
        9 => &mut settings.t_lock,
        10 => &mut settings.t_cross,
        11 => &mut settings.delay_max,
        _ => &mut settings.t_exec[usize::from(which) % TaskType::COUNT],
    }
}

/// Any with one other time, perhaps at the edge of what a timer takes, and any drift, repeats and tasks.
fn any_settings() -> Settings {
    let mut settings = short();
    let time = match kani::any::<u8>() % 4 {
        0 => Millis::MAX_TIMER.0 - 1 + u32::from(kani::any::<u8>() % 3),
        1 => settings.ram_period.0 * (1 << 15) - 1 + u32::from(kani::any::<u8>() % 3),
        _ => u32::from(kani::any::<u8>() % 72),
    };
    *time_of(&mut settings, kani::any::<u8>() % 28) = Millis(time);
    if kani::any() {
        settings.drift_ppm = match kani::any::<u8>() % 4 {
            0 => 99_999 + u32::from(kani::any::<u8>() % 3),
            _ => kani::any::<u16>().into(),
        };
    }
    if kani::any() {
        settings.n_ack = kani::any::<u8>() % 32;
    }
    if kani::any() {
        let some = kani::any::<bool>();
        settings.capabilities = if some {
            TaskSet(kani::any())
        } else {
            TaskSet::EMPTY
        };
        settings.guarding = TaskSet(kani::any());
        settings.holding = TaskSet(kani::any());
    }
    settings
}

harnesses! {
    /// Settings around the edge of each inequality.
    #[random_only("divisions and products of times, for each inequality")]
    fn taken_exactly_where_the_inequalities_hold() {
        let settings = any_settings();
        laws::taken_exactly_where_the_inequalities_hold(&settings);
        laws::defaults_are_as_documented(&Settings::default());
        let s = &settings;
        let plain = s.drift_ppm == 0 && Config::new(short()).is_ok();
        kani::cover!(plain && s.t_lease.0 + s.delay_max.0 == s.t_safety.0, "a lease ends with safety");
        kani::cover!(plain && 3 * s.ram_period.0 == s.t_lease.0, "three periods are a lease");
        kani::cover!(plain && s.t_select == s.t_offer, "selection ends with the offer");
        kani::cover!(plain && 3 * s.ram_period.0 + s.delay_max.0 == s.t_offer.0, "three periods are an offer");
        kani::cover!(plain && s.t_offer == s.t_help, "an offer is as long as the request");
        kani::cover!(plain && s.t_farewell.0 == 3 * s.ram_period.0, "three periods are a farewell");
        let session = s.t_help.0 + s.t_farewell.0;
        kani::cover!(plain && session + s.t_exec[2].0 == s.t_lock.0, "a task ends with the lock");
        let broken = Config::new(settings.clone()).err().map(|broken| broken.0);
        let by_lock = broken == Some(Inequality::LockOutlastsTask);
        kani::cover!(by_lock && session == s.t_lock.0 && s.capabilities.is_empty(), "a session ends with the lock");
        let by_cross = broken == Some(Inequality::CrossingWithinLimits);
        kani::cover!(by_cross && s.t_cross.0 + s.t_farewell.0 == s.t_lock.0 && s.capabilities.is_empty(), "a crossing ends with the lock");
        kani::cover!(plain && s.t_cross == s.t_exec[1], "a crossing ends with its task");
        kani::cover!(plain && s.t_lock.0 == 2 << 15, "heartbeats half the number space apart");
        kani::cover!(broken == Some(Inequality::NamedTasksGuard), "a named task that guards nobody");
        kani::cover!(broken == Some(Inequality::BlockHolds), "a block without a place");
        kani::cover!(s.drift_ppm == 100_000, "the largest drift and one more");
        kani::cover!(s.t_leave > Millis::MAX_TIMER, "a timer out of range");
        kani::cover!(s.t_exec[9] > Millis::MAX_TIMER, "a limit out of range");
        kani::cover!(s.delay_max == Millis::MAX_TIMER, "the longest delay");
        kani::cover!(s.delay_max > Millis::MAX_TIMER, "a delay out of range");
    }
}
