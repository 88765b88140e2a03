//! What a robot does, as lines for `crossguard validate`: one JSON object each.
//!
//! The harness of the kit reads these records; a test holds the two against each other.

use core::fmt::Display;

use crossguard_codec::{Identifiers, Service};
use crossguard_protocol::{Input, Outputs, Robot, Settings, StationId};

use crossguard_endpoint::cause::Cause;
use crossguard_endpoint::ras::generation::Trigger;

use crate::counters::Counters;

/// What a robot did.
#[cfg_attr(not(feature = "trace"), expect(dead_code, reason = "nobody reads it"))]
pub(crate) enum Entry<'a> {
    Started {
        robot: &'a Robot,
        settings: &'a Settings,
        identifiers: &'a Identifiers,
        unix_ms: u64,
    },
    Step {
        input: &'a Input,
        outputs: &'a Outputs,
        state: &'a Robot,
    },
    Sent {
        message: Service,
        trigger: Trigger,
        octets: &'a [u8],
    },
    Heard {
        message: Service,
        from: StationId,
        /// For how long it waited, in ms, where that is known.
        waited_ms: Option<u64>,
        octets: &'a [u8],
    },
    Dropped {
        cause: Cause,
        detail: &'a dyn Display,
        octets: &'a [u8],
    },
    Stopped {
        counters: &'a Counters,
    },
}

/// The room for lines, and how many have found none.
pub(crate) struct Lines<'a> {
    #[cfg_attr(
        not(feature = "trace"),
        expect(dead_code, reason = "nothing is written")
    )]
    room: Option<&'a mut [u8]>,
    length: usize,
    lost: u32,
}

impl<'a> Lines<'a> {
    pub(crate) const fn new(room: Option<&'a mut [u8]>) -> Self {
        Self {
            room,
            length: 0,
            lost: 0,
        }
    }

    pub(crate) const fn length(&self) -> usize {
        self.length
    }

    pub(crate) const fn lost(&self) -> u32 {
        self.lost
    }

    /// Adds a line. Whether it was lost for want of room.
    #[cfg(not(feature = "trace"))]
    #[expect(
        clippy::unused_self,
        reason = "there is nothing to write without the feature"
    )]
    pub(crate) const fn write(&mut self, _at_us: u64, _robot: &str, _entry: &Entry<'_>) -> bool {
        false
    }
}

#[cfg(feature = "trace")]
mod json {
    use core::fmt::{self, Display, Formatter};

    use crossguard_endpoint::cause::Layer;
    use ser_write_json::ser_write::SerError;
    use ser_write_json::{SerWrite, to_writer};
    use serde::ser::SerializeMap;
    use serde::{Serialize, Serializer};

    use super::{Entry, Lines};
    use crate::abi::CROSSGUARD_CAUSE_LEN;
    use crate::counters::{Counters, Text};

    impl Lines<'_> {
        /// Adds a line. Whether it was lost for want of room.
        pub(crate) fn write(&mut self, at_us: u64, robot: &str, entry: &Entry<'_>) -> bool {
            let Some(room) = &mut self.room else {
                return false;
            };
            let record = Record {
                at_us,
                robot,
                entry,
            };
            let mut rest = Rest {
                room: &mut room[self.length..],
                length: 0,
            };
            let written = to_writer(&mut rest, &record).is_ok() && rest.write_byte(b'\n').is_ok();
            if written {
                self.length += rest.length;
            } else {
                self.lost += 1;
            }
            !written
        }
    }

    struct Record<'a> {
        at_us: u64,
        robot: &'a str,
        entry: &'a Entry<'a>,
    }

    impl Serialize for Record<'_> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            let mut map = serializer.serialize_map(None)?;
            map.serialize_entry("atUs", &self.at_us)?;
            map.serialize_entry("robot", self.robot)?;
            match *self.entry {
                Entry::Started {
                    robot,
                    settings,
                    identifiers,
                    unix_ms,
                } => {
                    map.serialize_entry("entry", "started")?;
                    map.serialize_entry("station", &robot.station())?;
                    map.serialize_entry("boot", &robot.boot())?;
                    map.serialize_entry("settings", settings)?;
                    map.serialize_entry("identifiers", identifiers)?;
                    map.serialize_entry("unixMs", &unix_ms)?;
                }
                Entry::Step {
                    input,
                    outputs,
                    state,
                } => {
                    map.serialize_entry("entry", "step")?;
                    map.serialize_entry("input", input)?;
                    map.serialize_entry("outputs", outputs)?;
                    map.serialize_entry("state", state)?;
                }
                Entry::Sent {
                    message,
                    trigger,
                    octets,
                } => {
                    map.serialize_entry("entry", "sent")?;
                    map.serialize_entry("message", &message)?;
                    map.serialize_entry("trigger", &trigger)?;
                    map.serialize_entry("octets", &Displayed(&Hex(octets)))?;
                }
                Entry::Heard {
                    message,
                    from,
                    waited_ms,
                    octets,
                } => {
                    map.serialize_entry("entry", "heard")?;
                    map.serialize_entry("message", &message)?;
                    map.serialize_entry("from", &from)?;
                    if let Some(waited_ms) = waited_ms {
                        let reception = Reception {
                            arrived_us: self.at_us.saturating_sub(waited_ms * 1_000),
                            told_us: self.at_us,
                        };
                        map.serialize_entry("reception", &reception)?;
                    }
                    map.serialize_entry("octets", &Displayed(&Hex(octets)))?;
                }
                Entry::Dropped {
                    cause,
                    detail,
                    octets,
                } => {
                    map.serialize_entry("entry", "dropped")?;
                    map.serialize_entry("layer", &cause.layer())?;
                    map.serialize_entry("cause", &Displayed(&cause.reason()))?;
                    map.serialize_entry("detail", &Displayed(detail))?;
                    map.serialize_entry("octets", &Displayed(&Hex(octets)))?;
                }
                Entry::Stopped { counters } => {
                    map.serialize_entry("entry", "stopped")?;
                    map.serialize_entry("counters", &ByName(counters))?;
                }
            }
            map.end()
        }
    }

    /// When a message came in, in microseconds on the log's clock.
    #[derive(Serialize)]
    #[serde(rename_all = "camelCase")]
    struct Reception {
        arrived_us: u64,
        told_us: u64,
    }

    /// A value as the text that it displays as.
    struct Displayed<'a>(&'a dyn Display);

    impl Serialize for Displayed<'_> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.collect_str(self.0)
        }
    }

    /// How often each cause occurred, by layer and reason.
    struct ByName<'a>(&'a Counters);

    impl Serialize for ByName<'_> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            let mut map = serializer.serialize_map(None)?;
            for layer in Layer::ALL {
                if self.0.iter().any(|(cause, _)| cause.layer() == layer) {
                    map.serialize_entry(layer.name(), &OfLayer(layer, self.0))?;
                }
            }
            map.end()
        }
    }

    /// Those of one layer.
    struct OfLayer<'a>(Layer, &'a Counters);

    impl Serialize for OfLayer<'_> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            let mut map = serializer.serialize_map(None)?;
            for (cause, count) in self.1.iter() {
                if cause.layer() == self.0 {
                    let reason = Text::<CROSSGUARD_CAUSE_LEN>::of(&cause.reason());
                    map.serialize_entry(reason.as_str(), &count)?;
                }
            }
            map.end()
        }
    }

    /// Octets, two digits each.
    struct Hex<'a>(&'a [u8]);

    impl Display for Hex<'_> {
        fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
            self.0.iter().try_for_each(|octet| write!(f, "{octet:02x}"))
        }
    }

    /// What is left of a buffer.
    struct Rest<'a> {
        room: &'a mut [u8],
        length: usize,
    }

    impl SerWrite for Rest<'_> {
        type Error = SerError;

        fn write(&mut self, octets: &[u8]) -> Result<(), SerError> {
            let room = self.room.get_mut(self.length..self.length + octets.len());
            room.ok_or(SerError::BufferFull)?.copy_from_slice(octets);
            self.length += octets.len();
            Ok(())
        }
    }
}
