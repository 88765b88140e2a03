//! SUMO's files: XML, plain or packed by gzip, element by element.

use std::borrow::Cow;
use std::io::{BufRead, BufReader, Read};

use flate2::bufread::MultiGzDecoder;
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

/// Why a file of SUMO cannot be used. Each says what to do.
#[derive(Debug, thiserror::Error)]
pub enum SumoFileError {
    /// It cannot be read or unpacked.
    #[error("cannot be read: {0}; SUMO's XML is wanted, plain or packed by gzip")]
    Unreadable(#[from] std::io::Error),
    /// It is not XML.
    #[error("is not XML at octet {at}: {cause}; SUMO's XML is wanted, plain or packed by gzip")]
    NotXml {
        /// Where, in octets from the beginning.
        at: u64,
        /// Why.
        cause: quick_xml::Error,
    },
    /// Its root is another element, or its end is missing.
    #[error("{0}")]
    Root(String),
    /// An attribute is missing or is no number.
    #[error("<{element}> at octet {at} has no usable {attribute}: {wanted} is wanted")]
    Attribute {
        /// The element's name.
        element: String,
        /// Where its end is, in octets from the beginning.
        at: u64,
        /// Which attribute.
        attribute: &'static str,
        /// The wanted value.
        wanted: &'static str,
    },
    /// Its numbers do not fit.
    #[error("{0}")]
    Misfit(String),
}

pub(super) struct Element<'a> {
    start: &'a BytesStart<'a>,
    at: u64,
}

impl Element<'_> {
    pub(super) fn is(&self, name: &str) -> bool {
        self.start.name().as_ref() == name.as_bytes()
    }

    /// The text of an attribute; empty without it.
    pub(super) fn text(&self, attribute: &'static str) -> String {
        let found = self.start.try_get_attribute(attribute).ok().flatten();
        let text = found.and_then(|it| {
            let value = it.normalized_value(XmlVersion::Implicit1_0);
            value.map(Cow::into_owned).ok()
        });
        text.unwrap_or_default()
    }

    /// Value of an attribute, by `of`.
    pub(super) fn value<T>(
        &self,
        attribute: &'static str,
        wanted: &'static str,
        of: impl Fn(&str) -> Option<T>,
    ) -> Result<T, SumoFileError> {
        of(&self.text(attribute)).ok_or_else(|| SumoFileError::Attribute {
            element: String::from_utf8_lossy(self.start.name().as_ref()).into_owned(),
            at: self.at,
            attribute,
            wanted,
        })
    }

    pub(super) fn number(&self, attribute: &'static str) -> Result<f64, SumoFileError> {
        let finite = |text: &str| text.parse().ok().filter(|it: &f64| it.is_finite());
        self.value(attribute, "a number", finite)
    }
}

/// The longest element, comment or text between elements, in octets.
const EVENT_MAX: u64 = 1 << 20;

/// How many elements may be in one another.
const DEPTH_MAX: u32 = 64;

/// Calls `each` for every element below the root, which has this name.
pub(super) fn elements(
    from: impl Read,
    root: &str,
    mut each: impl FnMut(&Element<'_>) -> Result<(), SumoFileError>,
) -> Result<(), SumoFileError> {
    let mut from = BufReader::new(from);
    let is_packed = from.fill_buf()?.starts_with(&[0x1f, 0x8b]);
    let from: Box<dyn BufRead> = if is_packed {
        Box::new(BufReader::new(MultiGzDecoder::new(from)))
    } else {
        Box::new(from)
    };
    // Without limits, a device without an end or a small packed file fills the memory.
    let mut reader = Reader::from_reader(from.take(EVENT_MAX));
    let (mut buffer, mut depth, mut is_whole) = (Vec::new(), 0_u32, false);
    loop {
        buffer.clear();
        reader.get_mut().set_limit(EVENT_MAX);
        let event = reader.read_event_into(&mut buffer);
        let at = reader.buffer_position();
        let too_much = match reader.get_ref().limit() {
            0 => Some(format!(
                "an element or a text of more than {EVENT_MAX} octets"
            )),
            _ => (depth > DEPTH_MAX)
                .then(|| format!("more than {DEPTH_MAX} elements in one another")),
        };
        if let Some(what) = too_much {
            let why = format!("has {what} at octet {at}: a file that SUMO wrote is wanted");
            return Err(SumoFileError::Root(why));
        }
        let event = event.map_err(|cause| SumoFileError::NotXml { at, cause })?;
        if let Event::Start(start) | Event::Empty(start) = &event {
            let element = Element { start, at };
            if depth > 0 {
                each(&element)?;
            } else if !element.is(root) {
                let name = String::from_utf8_lossy(start.name().as_ref()).into_owned();
                let why = format!("is a <{name}> of SUMO, and a <{root}> is wanted");
                return Err(SumoFileError::Root(why));
            }
        }
        match event {
            Event::Start(_) => depth += 1,
            Event::End(_) => {
                depth = depth.saturating_sub(1);
                is_whole = depth == 0;
            }
            Event::Eof if is_whole => return Ok(()),
            Event::Eof => {
                let why = format!("ends after {at} octets without </{root}>: write it anew");
                return Err(SumoFileError::Root(why));
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hazard: a small packed file, or a device without an end, takes all the memory of the machine.
    #[test]
    fn what_has_no_end_is_refused() {
        let text = std::io::repeat(b'a').take(1 << 30);
        let name = b"<".chain(std::io::repeat(b'a'));
        let nested = format!("<net>{}", "<a>".repeat(1 << 10));
        for from in [
            &mut b"<net>".chain(text) as &mut dyn Read,
            &mut { name },
            &mut nested.as_bytes(),
        ] {
            let error = elements(from, "net", |_| Ok(())).unwrap_err().to_string();
            assert!(
                error.contains(" of more than ") || error.contains("in one another"),
                "{error}"
            );
        }
    }
}
