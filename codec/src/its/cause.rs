//! What the causes of events are called (TS 102 894-2 v2.4.1, `CauseCodeV2` and its sub causes).

use std::fmt;

use serde::Serialize;

use crate::asn1::cam::CauseCodeV2;

/// What an event is: the numbers, and what the dictionary calls them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Cause {
    /// The cause; those from 129 on are of release 1 and have no name.
    pub code: u8,
    /// Its name, if the dictionary has assigned one.
    pub name: Option<&'static str>,
    /// The sub cause, whose meaning depends on the cause; 0 is none.
    pub sub_code: u8,
    /// Its name, if the dictionary has assigned one.
    pub sub_name: Option<&'static str>,
}

impl From<&CauseCodeV2> for Cause {
    fn from(pair: &CauseCodeV2) -> Self {
        let (code, sub_code) = (pair.cause_code, pair.sub_cause_code);
        let (name, sub_name) = match names(code) {
            Some((name, mut sub_causes)) => (Some(name), sub_causes.nth(sub_code.into())),
            None => (None, None),
        };
        Self {
            code,
            name,
            sub_code,
            sub_name,
        }
    }
}

/// `collisionRisk (vulnerableRoadUser)`, and numbers for what has no name.
impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.name {
            Some(name) => f.write_str(name)?,
            None => write!(f, "cause {}", self.code)?,
        }
        match (self.sub_code, self.sub_name) {
            (0, _) => Ok(()),
            (_, Some(name)) => write!(f, " ({name})"),
            (number, None) => write!(f, " ({number})"),
        }
    }
}

/// The causes of the dictionary: each in a line with its number, its name, and the names of its sub causes from 0 on.
const CAUSES: &str = include_str!("causes.txt");

/// The name of a cause, and those of its sub causes from 0 on.
fn names(cause: u8) -> Option<(&'static str, impl Iterator<Item = &'static str>)> {
    CAUSES.lines().find_map(|line| {
        let mut words = line.split(' ');
        (words.next()?.parse() == Ok(cause)).then_some(())?;
        Some((words.next()?, words))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cause_is_called_what_the_dictionary_calls_it() {
        let text = |cause, sub_cause| Cause::from(&CauseCodeV2::new(cause, sub_cause)).to_string();
        assert_eq!(text(97, 4), "collisionRisk (vulnerableRoadUser)");
        assert_eq!(text(97, 0), "collisionRisk");
        assert_eq!(text(97, 200), "collisionRisk (200)");
        assert_eq!(text(7, 1), "aquaplaning (1)");
        assert_eq!(text(0, 0), "cause 0");
        assert_eq!(text(128, 3), "cause 128 (3)");
        let person = Cause::from(&CauseCodeV2::new(12, 0));
        assert_eq!(person.sub_name, Some("unavailable"));
    }
}
