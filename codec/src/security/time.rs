//! Times of IEEE 1609.2: counted from 2004-01-01T00:00:00Z, leap seconds included.

/// Microseconds since 2004, leap seconds counted (`Time64`).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Time64(pub u64);

impl Time64 {
    /// From `TimestampIts`, which counts milliseconds on the same scale.
    #[must_use]
    pub const fn of_timestamp_its(milliseconds: u64) -> Self {
        Self(milliseconds.saturating_mul(1_000))
    }
}

/// The validity period of a certificate.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Validity {
    /// Its start, in seconds since 2004 (`Time32`).
    pub start: u32,
    /// Its length.
    pub duration: Duration,
}

/// The length of a validity period: a number and its unit.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Duration {
    /// How many.
    pub number: u16,
    /// Seconds, hours or another unit of IEEE 1609.2.
    pub unit: Unit,
}

/// The unit of a [`Duration`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Unit {
    /// Microseconds.
    Microseconds,
    /// Milliseconds.
    Milliseconds,
    /// Seconds.
    Seconds,
    /// Minutes.
    Minutes,
    /// Hours.
    Hours,
    /// Sixty hours.
    SixtyHours,
    /// Years of 31,556,952 s.
    Years,
}

impl Unit {
    /// In the order of their tags.
    pub(super) const ALL: [Self; 7] = [
        Self::Microseconds,
        Self::Milliseconds,
        Self::Seconds,
        Self::Minutes,
        Self::Hours,
        Self::SixtyHours,
        Self::Years,
    ];

    const fn microseconds(self) -> u64 {
        match self {
            Self::Microseconds => 1,
            Self::Milliseconds => 1_000,
            Self::Seconds => 1_000_000,
            Self::Minutes => 60_000_000,
            Self::Hours => 3_600_000_000,
            Self::SixtyHours => 216_000_000_000,
            Self::Years => 31_556_952_000_000,
        }
    }
}

impl Duration {
    /// This many hours.
    #[must_use]
    pub const fn hours(number: u16) -> Self {
        Self {
            number,
            unit: Unit::Hours,
        }
    }

    /// This many years.
    #[must_use]
    pub const fn years(number: u16) -> Self {
        Self {
            number,
            unit: Unit::Years,
        }
    }

    /// In microseconds.
    #[must_use]
    pub const fn microseconds(self) -> u64 {
        self.number as u64 * self.unit.microseconds()
    }
}

impl Validity {
    /// Its first moment.
    #[must_use]
    pub const fn from(&self) -> Time64 {
        Time64(self.start as u64 * 1_000_000)
    }

    /// The moment when it is over.
    #[must_use]
    pub const fn until(&self) -> Time64 {
        Time64(self.from().0 + self.duration.microseconds())
    }

    /// True if all of `other` is in it.
    #[must_use]
    pub fn encloses(&self, other: &Self) -> bool {
        self.from() <= other.from() && other.until() <= self.until()
    }
}
