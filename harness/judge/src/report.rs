//! A run as one static page: what happened, where, how long it took, and whether it was right.
//!
//! The page needs nothing but itself: no network, no script. It is light or dark as the reader's system
//! is, and can be printed.

mod around;
mod bounds;
mod charts;
mod collect;
mod crowd;
mod messages;
mod page;
mod people;
mod street;
mod timeline;

use crossguard_robot::site_file::SiteFile;
use crossguard_robot::trace::{LogError, Merged};

use crate::validate::{Invalid, Validated};

/// What a page is made of besides the logs.
#[derive(Debug)]
pub struct Report<'a> {
    /// What stands at the top.
    pub title: &'a str,
    /// The names of the logs.
    pub logs: &'a [String],
    /// What validation says of them.
    pub verdict: Result<&'a Validated, &'a Invalid>,
    /// What was found to be wrong while it ran, if something was.
    pub finding: Option<&'a str>,
    /// How many times as fast as real the robots' bodies moved, where the logs do not say it, or wrongly.
    pub time_scale: Option<f64>,
    /// The site, for kerbs and lanes on the map.
    pub site: Option<&'a SiteFile>,
    /// The command that runs it again, where one does.
    pub reproduce: Option<&'a str>,
}

impl Report<'_> {
    /// The page.
    ///
    /// # Errors
    /// When a log cannot be read.
    pub fn page(&self, logs: Merged) -> Result<String, LogError> {
        let run = collect::Run::of(logs)?;
        Ok(page::page(self, &run).into_string())
    }

    /// Whether the logs hold all that happened and nothing in them is wrong.
    fn outcome(&self) -> Validity {
        match self.verdict {
            _ if self.finding.is_some() => Validity::Invalid,
            Ok(validated) if validated.missing > 0 => Validity::Incomplete,
            Ok(_) => Validity::Valid,
            Err(_) => Validity::Invalid,
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Validity {
    Valid,
    Incomplete,
    Invalid,
}
