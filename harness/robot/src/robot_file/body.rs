//! The table `[body]` of a robot file: where a body that is another process connects.
//!
//! ```toml
//! [body]
//! listen = "unix:go2.sock"
//! silence_ms = 500
//! simulated_people = false
//! ```

use std::path::Path;
use std::time::Duration;

use serde::Deserialize;

use crate::body::BodyPort;
use crate::located::{Impossible, possible};
use crate::port::{NoAddress, PortAddress};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyTable {
    listen: String,
    #[serde(default = "silence_ms")]
    silence_ms: u32,
    /// Whether a robot that leads without a zone has simulated people on purpose.
    #[serde(default)]
    pub(super) simulated_people: bool,
}

const fn silence_ms() -> u32 {
    500
}

/// Why no body can be reached like that.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum NoBody {
    /// It is no UNIX socket.
    #[error(transparent)]
    Address(#[from] NoAddress),
    /// The time of silence is out of range.
    #[error(transparent)]
    Number(#[from] Impossible),
    /// It leads people, and nothing sees them.
    #[error(
        "a real body that leads ('autopilot' or a plan) wants a table [zone], and frames of sensors: without it, its guards leave \
         the road when simulated people are across; for a trial without people say 'simulated_people = true' under [body]"
    )]
    SeesNobody,
    /// People are said to be simulated, and sensors see people.
    #[error(
        "'simulated_people = true' beside [zone]: a robot with a zone goes by the people in frames of its sensors; leave one of the two out"
    )]
    TwoPeoples,
    /// Its places would be metres from a corner of another town, and vehicles that it hears far away.
    #[error(
        "a real body wants a site: 'site_file', as 'crossguard new' writes one, or [site] with 'latitude' and 'longitude' of the \
         origin of its places; without it, the vehicles and people that it hears would be far away"
    )]
    NoSite,
}

impl BodyTable {
    pub(super) fn check(self, folder: &Path, is_sited: bool) -> Result<BodyPort, NoBody> {
        let silence_ms = f64::from(self.silence_ms);
        possible("silence_ms", silence_ms, 200.0..=5_000.0, "200 to 5000")?;
        let address = PortAddress::parse(&self.listen, folder)?;
        if !is_sited {
            return Err(NoBody::NoSite);
        }
        Ok(BodyPort {
            address,
            silence: Duration::from_millis(self.silence_ms.into()),
        })
    }
}
