//! Mistakes in a scenario file, with their places.

pub(crate) enum Location {
    Offset(usize),
    Key(&'static str),
}

pub(crate) struct Wrong {
    pub(super) at: Location,
    pub(super) cause: String,
}

impl Wrong {
    pub(crate) fn new(at: Location, cause: impl Into<String>) -> Self {
        let cause = cause.into();
        Self { at, cause }
    }

    pub(crate) fn key(key: &'static str, cause: impl Into<String>) -> Self {
        Self::new(Location::Key(key), cause)
    }
}

impl Location {
    /// The line, counted from 1.
    pub(super) fn line_in(&self, text: &str) -> usize {
        let offset = match self {
            Self::Offset(offset) => *offset,
            Self::Key(key) => text
                .lines()
                .scan(0, |start, line| {
                    let this = *start;
                    *start += line.len() + 1;
                    Some((this, line))
                })
                .find(|(_, line)| line.trim_start().trim_start_matches('[').starts_with(key))
                .map_or(0, |(start, _)| start),
        };
        text[..offset.min(text.len())].matches('\n').count() + 1
    }
}
