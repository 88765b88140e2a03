//! The table `[body]` of a robot file: where a body that is another process connects.
//!
//! ```toml
//! [body]
//! listen = "unix:go2.sock" # or "127.0.0.1:47600"
//! silence_ms = 500
//! stands_m = 0.3
//! ```

use std::path::Path;
use std::time::Duration;

use serde::Deserialize;

use crate::body::BodyPort;
use crate::port::{NoAddress, PortAddress};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyTable {
    listen: String,
    #[serde(default = "silence_ms")]
    silence_ms: u64,
    #[serde(default = "stands_m")]
    stands_m: f64,
}

const fn silence_ms() -> u64 {
    500
}

const fn stands_m() -> f64 {
    0.3
}

/// Why no body can be reached like that.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum NoBody {
    /// It is no address of this machine.
    #[error(transparent)]
    Address(#[from] NoAddress),
    /// Nobody is silent so fast, or so slowly.
    #[error("silence_ms is {0}: 200 to 5000 is wanted")]
    Silence(u64),
    /// No body stands like that.
    #[error("stands_m is {0}: 0.01 to 2 is wanted")]
    Stands(f64),
}

impl BodyTable {
    pub(super) fn check(self, folder: &Path) -> Result<BodyPort, NoBody> {
        if !(200..=5_000).contains(&self.silence_ms) {
            return Err(NoBody::Silence(self.silence_ms));
        }
        if !(0.01..=2.0).contains(&self.stands_m) {
            return Err(NoBody::Stands(self.stands_m));
        }
        Ok(BodyPort {
            address: PortAddress::parse(&self.listen, folder)?,
            silence: Duration::from_millis(self.silence_ms),
            stands_m: self.stands_m,
        })
    }
}
