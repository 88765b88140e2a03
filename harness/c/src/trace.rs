//! Steps of a robot, as lines for `crossguard validate`: one JSON object each.
//!
//! The harness of the kit reads these records; a test holds the two against each other.

use core::fmt::{self, Display, Formatter};

use crossguard_codec::{Identifiers, Service};
use crossguard_endpoint::cause::{Layer, Reason};
use crossguard_endpoint::ras::generation::Trigger;
use crossguard_protocol::{Input, Outputs, Robot, Settings, StationId};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use crate::abi::CROSSGUARD_CAUSE_LEN;
use crate::counters::{Counters, Text};

#[derive(Serialize)]
#[serde(
    tag = "entry",
    rename_all = "camelCase",
    rename_all_fields = "camelCase"
)]
pub(crate) enum Entry<'a> {
    Started {
        station: StationId,
        boot: u16,
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
        octets: Hex<'a>,
    },
    Heard {
        message: Service,
        from: StationId,
        #[serde(skip_serializing_if = "Option::is_none")]
        reception: Option<Reception>,
        octets: Hex<'a>,
    },
    Dropped {
        layer: Layer,
        #[serde(serialize_with = "displayed")]
        cause: Reason,
        #[serde(serialize_with = "displayed")]
        detail: &'a dyn Display,
        octets: Hex<'a>,
    },
    Stopped {
        counters: ByName<'a>,
    },
}

/// When a message came in, in microseconds on the log's clock, where that is known.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Reception {
    pub(crate) arrived_us: u64,
    pub(crate) told_us: u64,
}

/// Octets, two digits each.
pub(crate) struct Hex<'a>(pub(crate) &'a [u8]);

impl Display for Hex<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|octet| write!(f, "{octet:02x}"))
    }
}

impl Serialize for Hex<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        displayed(self, serializer)
    }
}

fn displayed<S: Serializer>(value: &impl Display, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(value)
}

/// How often each cause occurred, by layer and reason.
pub(crate) struct ByName<'a>(pub(crate) &'a Counters);

impl Serialize for ByName<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let occurred = |layer: &Layer| self.0.iter().any(|(cause, _)| cause.layer() == *layer);
        let layers = Layer::ALL.into_iter().filter(occurred);
        serializer.collect_map(layers.map(|layer| (layer.name(), OfLayer(layer, self.0))))
    }
}

/// The causes of one layer.
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
    use ser_write_json::ser_write::SerError;
    use ser_write_json::{SerWrite, to_writer};
    use serde::Serialize;

    use super::{Entry, Lines};

    impl Lines<'_> {
        /// Adds a line. Whether it was lost for want of room.
        pub(crate) fn write(&mut self, at_us: u64, robot: &str, entry: &Entry<'_>) -> bool {
            let Some(room) = &mut self.room else {
                return false;
            };
            let mut rest = Rest {
                room: &mut room[self.length..],
                length: 0,
            };
            let record = Record { at_us, robot };
            let written = rest.write_joined(&record, entry).is_some();
            if written {
                self.length += rest.length;
            } else {
                self.lost += 1;
            }
            !written
        }
    }

    #[derive(Serialize)]
    #[serde(rename_all = "camelCase")]
    struct Record<'a> {
        at_us: u64,
        robot: &'a str,
    }

    struct Rest<'a> {
        room: &'a mut [u8],
        length: usize,
    }

    impl Rest<'_> {
        /// Writes a line with one object that has the fields of both, if there is room: to flatten one into the other,
        /// serde needs a heap.
        fn write_joined(&mut self, record: &Record<'_>, entry: &Entry<'_>) -> Option<()> {
            to_writer(&mut *self, record).ok()?;
            // The comma takes the place of `}` and `{`.
            self.length -= 1;
            let joint = self.length;
            to_writer(&mut *self, entry).ok()?;
            self.room[joint] = b',';
            self.write_byte(b'\n').ok()
        }
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
