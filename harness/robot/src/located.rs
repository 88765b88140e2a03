//! Files of sites and plans: how they are read, and what is wrong with one, by its line.

use std::fmt;
use std::ops::{Range, RangeInclusive};
use std::path::Path;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::files;
use crate::site::Place;

/// Farthest place of a configuration from the origin of its site, in metres: the crossing is there, and nobody has to do
/// with it from farther off.
pub(crate) const NEAR_M: f64 = 1_000.0;

/// An array of a file with exactly as many elements as are wanted: without it, what is too many is left out without a word.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Exact<T, const N: usize>(pub(crate) [T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Exact<T, N> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let elements = Vec::<T>::deserialize(from)?;
        let count = elements.len();
        let exact = elements.try_into().map(Self);
        exact.map_err(|_| {
            D::Error::custom(format!(
                "{count} elements are here, and {N} are wanted; decimals have a point, like 1.5"
            ))
        })
    }
}

/// A place in a text, by its metres to the east and to the north.
pub(crate) type Point = toml::Spanned<Exact<toml::Spanned<f64>, 2>>;

/// A file of a site or a plan that cannot be used.
#[derive(Debug, thiserror::Error)]
pub struct FileError {
    /// Its path, or the name of a shipped one.
    pub file: String,
    /// The line, from 1 on; `None` where the whole file is meant.
    pub line: Option<usize>,
    /// The fault there.
    pub what: String,
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}: {}", self.file, self.what),
            None => write!(f, "{}: {}", self.file, self.what),
        }
    }
}

/// Fault of a text, and where it is.
#[derive(Debug)]
pub(crate) struct Misfit {
    pub(crate) span: Option<Range<usize>>,
    pub(crate) what: String,
}

impl Misfit {
    pub(crate) fn at<T>(spanned: &toml::Spanned<T>, what: impl Into<String>) -> Self {
        Self {
            span: Some(spanned.span()),
            what: what.into(),
        }
    }

    /// The same at what may be left out: without it, the whole file is meant.
    pub(crate) fn at_any<T>(spanned: Option<&toml::Spanned<T>>, what: impl Into<String>) -> Self {
        Self {
            span: spanned.map(toml::Spanned::span),
            what: what.into(),
        }
    }

    pub(crate) fn whole(what: impl Into<String>) -> Self {
        Self {
            span: None,
            what: what.into(),
        }
    }

    pub(crate) fn of(self, file: &str, text: &str) -> FileError {
        FileError {
            file: file.to_owned(),
            line: self.span.map(|span| line_of(text, span.start)),
            what: self.what,
        }
    }
}

pub(crate) fn read(path: &Path) -> Result<String, FileError> {
    files::text(path, files::TEXT_MAX).map_err(|cause| FileError {
        file: path.display().to_string(),
        line: None,
        what: cause.to_string(),
    })
}

pub(crate) fn parse<'a, T: Deserialize<'a>>(text: &'a str) -> Result<T, Misfit> {
    toml::from_str(text).map_err(|cause| Misfit {
        span: cause.span(),
        what: cut(cause.message()),
    })
}

fn line_of(text: &str, offset: usize) -> usize {
    let before = text.as_bytes().iter().take(offset);
    before.filter(|octet| **octet == b'\n').count() + 1
}

/// A number in a text: a very large or small one by its power of ten, not by hundreds of digits.
pub(crate) struct Number<'a>(pub(crate) &'a f64);

impl fmt::Display for Number<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size > 0.0 && size < 1e-6 || size >= 1e15 && size.is_finite() {
            write!(f, "{:e}", self.0)
        } else {
            write!(f, "{}", self.0)
        }
    }
}

/// Longest line that a person is shown of a file, in characters.
const LINE_MAX: usize = 300;

/// A text with the end of each long line left out.
pub(crate) fn cut(text: &str) -> String {
    let lines = text.split('\n').map(|line| {
        let end = line.char_indices().nth(LINE_MAX);
        end.map_or_else(|| line.to_owned(), |(end, _)| format!("{} …", &line[..end]))
    });
    lines.collect::<Vec<_>>().join("\n")
}

pub(crate) fn place(at: &Point) -> Result<Place, Misfit> {
    let Exact(metres) = at.get_ref();
    place_at(at, metres.each_ref().map(|it| *it.get_ref()))
}

/// A place on the site, which stands there.
pub(crate) fn place_at<T>(
    there: &toml::Spanned<T>,
    [east, north]: [f64; 2],
) -> Result<Place, Misfit> {
    if is_near([east, north]) {
        return Ok(Place::new(east, north));
    }
    let what = format!(
        "[{}, {}] is no place: metres east and north of the origin, at most {NEAR_M}, are wanted",
        Number(&east),
        Number(&north)
    );
    Err(Misfit::at(there, what))
}

/// Whether a place of a configuration is near the origin of its site.
pub(crate) fn is_near(place: [f64; 2]) -> bool {
    place.iter().all(|metres| metres.abs() <= NEAR_M)
}

pub(crate) fn within(
    value: &toml::Spanned<f64>,
    possible: RangeInclusive<f64>,
    unit: &str,
) -> Result<f64, Misfit> {
    let number = *value.get_ref();
    if possible.contains(&number) {
        Ok(number)
    } else {
        let (least, most) = possible.into_inner();
        let number = Number(&number);
        let what = format!("{number} is not possible: {least} to {most} {unit} is wanted");
        Err(Misfit::at(value, what))
    }
}

/// A number within a range, if it is there.
pub(crate) fn within_if_any(
    value: Option<&toml::Spanned<f64>>,
    possible: RangeInclusive<f64>,
    unit: &str,
) -> Result<Option<f64>, Misfit> {
    value.map(|value| within(value, possible, unit)).transpose()
}

/// A number that is not possible, in a file or in a line.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[error("{name} is {}: {wanted} is wanted", Number(value))]
pub struct Impossible {
    /// Its name there.
    pub name: &'static str,
    /// The number.
    pub value: f64,
    /// Possible values, in words.
    pub wanted: &'static str,
}

/// A number of this name within a range.
pub(crate) fn possible(
    name: &'static str,
    value: f64,
    possible: RangeInclusive<f64>,
    wanted: &'static str,
) -> Result<f64, Impossible> {
    if possible.contains(&value) {
        return Ok(value);
    }
    Err(Impossible {
        name,
        value,
        wanted,
    })
}
