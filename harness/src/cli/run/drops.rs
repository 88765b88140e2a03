//! Drops on the console: those of one cause in one instant are one line, and their number is another.

use crossguard_endpoint::counters::CauseName;

/// How long an instant is.
const INSTANT_US: u64 = 1_000_000;

/// The drops that were said last, one of each cause.
#[derive(Default)]
pub(super) struct Drops(Vec<Said>);

struct Said {
    cause: CauseName,
    at_us: u64,
    /// How many followed it in its instant.
    more: u64,
}

impl Drops {
    /// Whether a drop at this time is to be said: it is not the same thing again.
    pub(super) fn is_news(&mut self, at_us: u64, cause: &CauseName) -> bool {
        let is_news = self.0.iter().all(|said| said.cause != *cause);
        self.add(at_us, cause, u64::from(!is_news));
        is_news
    }

    /// Counts drops that nothing else tells of.
    pub(super) fn add(&mut self, at_us: u64, cause: &CauseName, count: u64) {
        if let Some(said) = self.0.iter_mut().find(|said| said.cause == *cause) {
            said.more += count;
        } else {
            let (cause, more) = (cause.clone(), count);
            self.0.push(Said { cause, at_us, more });
        }
    }

    /// Lines to say of instants that are over by this time.
    pub(super) fn over(&mut self, at_us: u64) -> Vec<String> {
        let is_over = |said: &mut Said| at_us >= said.at_us + INSTANT_US;
        let over = self.0.extract_if(.., is_over).filter(|said| said.more > 0);
        over.map(|said| format!("dropped, {}: {} more", said.cause, said.more))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use crossguard_endpoint::cause::Cause;

    use super::*;

    #[test]
    fn point_9_drops_of_one_instant_are_said_once_with_their_number() {
        let (mut drops, late) = (Drops::default(), Cause::WaitedTooLong.into());
        let said: Vec<_> = (0..28)
            .filter(|at_us| drops.is_news(*at_us, &late))
            .collect();
        // Another cause in the same instant takes nothing away.
        let other = Cause::InboxFull.into();
        assert!(drops.is_news(28, &other));
        // Drops without a record count as well.
        drops.add(29, &late, 1_000);
        assert_eq!((said, drops.over(999_999)), (vec![0], vec![]));
        let over = drops.over(1_000_000);
        assert_eq!(over, ["dropped, inbox: waited too long: 1027 more"]);
        // One alone is not said again, and the next one is.
        assert!(drops.is_news(2_000_000, &late));
        assert_eq!(drops.over(4_000_000), [""; 0]);
        assert!(drops.is_news(4_000_000, &late));
    }
}
