//! The studio: pages on which the protocol and its runs are looked at, served to a browser on this machine.
//!
//! The shell serves the files and keeps strangers out; each view is a page and what it asks the server.

mod after;
mod explore;
mod live;
mod play;
mod shell;
mod site;

pub use after::{Studied, Study, saved};
pub use explore::GivenRun;
pub use live::Followed;
pub use shell::{publish, serve};
pub use site::Edited;

use shell::View;

/// Content of a studio.
#[derive(Default)]
pub struct Studio {
    /// A run after it happened.
    pub run: Option<Studied>,
    /// Reader of logs that somebody opens on the page; without it none are taken.
    pub study: Option<Box<Study>>,
    /// Logs of robots that run.
    pub live: Option<Followed>,
    /// Runs through scenarios, from files.
    pub given: Vec<GivenRun>,
    /// A site file that may be written.
    pub site: Option<Edited>,
}

impl Studio {
    /// All views, in the order of the page's head; with nothing to show where this studio was given nothing for it.
    fn views(self) -> Vec<Box<dyn View>> {
        vec![
            Box::new(live::Live::new(self.live)),
            Box::new(play::Play),
            Box::new(explore::Explore::new(self.given)),
            Box::new(after::After::new(self.run, self.study)),
            Box::new(site::Site::new(self.site)),
        ]
    }
}
