//! The words of the protocol: its events, outputs, notices and reasons, each declared once.
//!
//! `words!` declares an enumeration and writes down what others need to know of it: how each variant is called in
//! JSON, its number on interfaces without names, what it means, what comes with it, and its text. C, C++, Python and
//! ROS 2 are written from [`TABLE`]; laws, checker and tests take their lists from `ALL`.
//!
//! A variant is one row: `Name(field: Type) = code, "text with {field}";`. Without a text, the name is the text.

use crate::config::Inequality;
use crate::id::{ManeuverId, RequestId, SessionId, SessionNumber, StationId, UniqueNumber};
use crate::input::{Event, Timer};
use crate::message::{Answer, Command, Ending, Failure, Progress, Rejection, Rmcm, Verdict};
use crate::output::{
    CorridorClosure, Disengagement, EndReason, GoneReason, Ignored, Maneuver, Notice, NoticeKind,
    Output, OutputKind, ReleaseReason, StopReason,
};
use crate::state::{Corridor, Role, State};
use crate::task::{
    Availability, FallbackPolicy, HelpRequest, Place, TaskSet, TaskType, Unavailability, Urgency,
};
use crate::time::Millis;

/// An enumeration of words.
#[derive(Clone, Copy, Debug)]
pub struct Words {
    /// Its name in Rust.
    pub name: &'static str,
    /// Its meaning, in one paragraph.
    pub meaning: &'static str,
    /// Its words, in order.
    pub words: &'static [Word],
}

/// A word: one variant of an enumeration.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Word {
    /// Its name in Rust.
    pub variant: &'static str,
    /// Its name in JSON.
    pub name: &'static str,
    /// Its number in the enumeration. The numbers of all [reasons](REASONS) are one space: a code has one name, and a
    /// word that only carries another reason has code 0.
    pub code: u8,
    /// The meaning, in one paragraph.
    pub meaning: &'static str,
    /// Its fields, in order.
    pub fields: &'static [Field],
    /// True if JSON names the fields: one field is not named otherwise, and several are a list.
    pub names_fields: bool,
}

/// A field of a word.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// Its type in Rust, like `Option<UniqueNumber>`.
    pub of: &'static str,
}

/// The content of an output, with one place for each thing that outputs come with: for interfaces of plain records.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Said {
    /// Which output it is.
    pub kind: OutputKind,
    /// The news, if it is that.
    pub notice: Option<NoticeKind>,
    /// Why, where that is said: the word of the innermost reason that is no [`Unavailability`].
    pub reason: Option<&'static Word>,
    /// Why somebody is unavailable, if that is the reason.
    pub unavailability: Option<Unavailability>,
    /// The policy of a fallback.
    pub policy: Option<FallbackPolicy>,
    /// The task of a maneuver or command.
    pub task: Option<TaskType>,
    /// The number of the maneuver or command.
    pub request: Option<RequestId>,
    /// The station that it is about, besides this robot.
    pub station: Option<StationId>,
    /// The session.
    pub session: Option<SessionId>,
    /// For how long the corridor is open.
    pub open: Option<Millis>,
}

impl Said {
    /// The content of `output`.
    #[must_use]
    pub fn by(output: &Output) -> Self {
        let mut said = Self {
            kind: output.kind(),
            notice: None,
            reason: None,
            unavailability: None,
            policy: None,
            task: None,
            request: None,
            station: None,
            session: None,
            open: None,
        };
        output.tell(&mut said);
        said
    }
}

/// A type of values that come with words.
pub(crate) trait Content {
    /// A value for examples.
    const SAMPLE: Self;

    /// Notes what it says.
    fn tell(&self, _: &mut Said) {}
}

/// Declares what can come with a word: a value for examples, and what it says.
macro_rules! contents {
    ($($type:ty = $sample:expr $(, |$it:ident, $said:ident| $tell:expr)?;)+) => {$(
        impl Content for $type {
            const SAMPLE: Self = $sample;
            $(fn tell(&self, $said: &mut Said) {
                let $it = self;
                $tell;
            })?
        }
    )+};
}

contents! {
    u16 = 4;
    StationId = Self(2), |it, said| said.station = Some(*it);
    UniqueNumber = Self { boot: 3, count: 4 };
    Option<UniqueNumber> = Some(UniqueNumber::SAMPLE);
    SessionId = Self { leader: StationId(1), number: SessionNumber(UniqueNumber::SAMPLE) },
        |it, said| said.session = Some(*it);
    ManeuverId = Self { session: SessionId::SAMPLE, request: RequestId(7) },
        |it, said| (said.session, said.request) = (Some(it.session), Some(it.request));
    TaskType = Self::MOVE, |it, said| said.task = Some(*it);
    Maneuver = Self { id: ManeuverId::SAMPLE, task: TaskType::SAMPLE }, |it, said| {
        it.id.tell(said);
        it.task.tell(said);
    };
    Millis = Self(1_900), |it, said| said.open = Some(*it);
    HelpRequest = Self {
        urgency: Urgency::High,
        followers: 2,
        tasks: TaskSet::of(&[TaskType::INITIAL_POS, TaskType::MOVE]),
        place: Place(0x0005_0007),
    };
    Availability = Self::Unavailable(Unavailability::SAMPLE);
    Command = Self {
        session: SessionId::SAMPLE,
        to: StationId::SAMPLE,
        request: RequestId(7),
        task: TaskType::SAMPLE,
    }, |it, said| {
        (said.session, said.request) = (Some(it.session), Some(it.request));
        it.to.tell(said);
        it.task.tell(said);
    };
    Answer = Self {
        from: StationId::SAMPLE,
        session: SessionId::SAMPLE,
        request: RequestId(7),
        verdict: Verdict::Accepted,
    }, |it, said| {
        (said.session, said.request) = (Some(it.session), Some(it.request));
        if let Verdict::Rejected(why) = it.verdict {
            why.tell(said);
        }
    };
    Rmcm = Self::Command(Command::SAMPLE), |it, said| match it {
        Self::Command(command) => command.tell(said),
        Self::Answer(answer) => answer.tell(said),
    };
}

/// Makes an enumeration what can come with a word: the first word is the example. It notes itself, then its fields do.
macro_rules! content {
    ($name:ident { $(|$kind:ident, $said:ident| $tell:expr)? }) => {
        impl Content for $name {
            const SAMPLE: Self = Self::SAMPLES[0];

            fn tell(&self, said: &mut Said) {
                $(
                    let ($kind, $said) = (self.kind(), &mut *said);
                    $tell;
                )?
                self.tell_fields(said);
            }
        }
    };
}

/// Lists all enumerations, and what their words note of themselves.
macro_rules! enumerations {
    (
        reasons: $($reason:ident)+;
        $($($name:ident)+ => $note:tt)+
    ) => {
        /// All enumerations.
        pub const TABLE: &[&Words] = &[$($(&$name::WORDS,)+)+ $(&$reason::WORDS),+];
        /// Enumerations of reasons.
        pub const REASONS: &[&Words] = &[$(&$reason::WORDS),+];

        $($(content!($name $note);)+)+
        $(content!($reason { |kind, said| said.reason = Some(kind.word()) });)+
    };
}

enumerations! {
    reasons: Ignored StopReason ReleaseReason EndReason GoneReason CorridorClosure Disengagement Failure Rejection;
    Event Output Timer State Role Corridor Urgency Ending Progress Inequality => {}
    Notice => { |kind, said| said.notice = Some(kind) }
    Unavailability => { |why, said| said.unavailability = Some(why) }
    FallbackPolicy => { |policy, said| said.policy = Some(policy) }
}

/// How many letters [`letters`] gives.
pub(crate) const fn length(variant: &str, case: &str) -> usize {
    let (from, mut i, mut length) = (variant.as_bytes(), 0, 0);
    while i < from.len() {
        length += if is_parted(from, i, case) { 2 } else { 1 };
        i += 1;
    }
    length
}

/// The name of a variant in this case: one of serde's, or `words`.
pub(crate) const fn letters<const N: usize>(variant: &str, case: &str) -> [u8; N] {
    let (from, mut to) = (variant.as_bytes(), [0; N]);
    let (mut i, mut n) = (0, 0);
    while i < from.len() {
        if is_parted(from, i, case) {
            to[n] = separator(case);
            n += 1;
        }
        let is_kept = separator(case) == 0 && (i > 0 || case.as_bytes()[0] == b'P');
        to[n] = from[i];
        if !is_kept {
            to[n].make_ascii_lowercase();
        }
        n += 1;
        i += 1;
    }
    to
}

/// The character between two words of a name; 0 for none.
const fn separator(case: &str) -> u8 {
    match case.as_bytes() {
        b"kebab-case" => b'-',
        b"words" => b' ',
        _ => 0,
    }
}

const fn is_parted(variant: &[u8], i: usize, case: &str) -> bool {
    separator(case) != 0 && i > 0 && variant[i].is_ascii_uppercase()
}

/// The name of a variant in a case, as a constant.
macro_rules! spelled {
    ($variant:ident, $case:tt) => {{
        const LETTERS: [u8; $crate::words::length(stringify!($variant), $case)] =
            $crate::words::letters(stringify!($variant), $case);
        const NAME: &str = match core::str::from_utf8(&LETTERS) {
            Ok(name) => name,
            Err(_) => panic!("names are ASCII"),
        };
        NAME
    }};
}

/// Writes the text of a row, or the name of its variant in words.
macro_rules! text {
    ($f:ident, $variant:ident) => {
        $f.pad($crate::words::spelled!($variant, "words"))
    };
    ($f:ident, $variant:ident, $($text:tt)+) => {
        write!($f, $($text)+)
    };
}

/// A variant, if nothing comes with it.
macro_rules! bare {
    ($variant:path) => {
        Some($variant)
    };
    ($($variant:tt)+) => {
        None
    };
}

/// Declares an enumeration of words. One with fields has a [kind](Event::kind): the same words without them.
///
/// `in` says how JSON spells its names, where that is not as usual; attributes of the enumeration stand behind it.
macro_rules! words {
    (
        $(#[doc = $about:literal])+
        pub enum $name:ident $(as $kind:ident)? $(#[$attr:meta])* { $($rows:tt)+ }
    ) => {
        // How JSON spells the names of all other enumerations: the one place to change it.
        $crate::words::words! {
            $(#[doc = $about])+
            pub enum $name $(as $kind)? in "camelCase" $(#[$attr])* { $($rows)+ }
        }
    };

    // Words alone.
    (
        $(#[doc = $about:literal])+
        pub enum $name:ident in $case:tt $(#[$attr:meta])* { $(
            $(#[doc = $meaning:literal])+
            $variant:ident = $code:literal $(, $text:literal)?;
        )+ }
    ) => {
        $crate::words::words! { @kinds
            [$(#[doc = $about])+ $(#[$attr])*] [$($about)+] $name of $name in $case
            $([$($meaning)+] $variant = $code $(, $text)?;)+
        }

        impl $name {
            /// One of each word.
            pub const SAMPLES: &'static [Self] = &Self::ALL;

            /// The word itself.
            #[must_use]
            pub const fn kind(self) -> Self {
                self
            }

            #[allow(clippy::unused_self, clippy::trivially_copy_pass_by_ref, reason = "others have fields")]
            pub(crate) fn tell_fields(&self, _: &mut $crate::words::Said) {}
        }

        #[cfg(any(test, feature = "laws"))]
        impl $crate::laws::arbitrary::AnyWord for $name {
            type Kind = Self;
            const COUNT: usize = $name::WORDS.words.len();

            fn any_of(kind: Self, _: &mut impl $crate::laws::Source) -> Self {
                kind
            }

            fn nth(number: u32, _: &mut impl $crate::laws::Source) -> Self {
                $(if number == Self::$variant as u32 {
                    return Self::$variant;
                })+
                Self::ALL[0]
            }
        }
    };

    // Words with fields.
    (
        $(#[doc = $about:literal])+
        pub enum $name:ident as $kind:ident in $case:tt $(#[$attr:meta])* { $(
            $(#[doc = $meaning:literal])+
            $variant:ident
                $(($($field:ident: $of:ty),+))?
                $({ $($(#[doc = $says:literal])+ $named:ident: $type:ty),+ })?
                = $code:literal $(, $text:literal $(, $argument:expr)*)?;
        )+ }
    ) => {
        $(#[doc = $about])+
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        $(#[$attr])*
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(rename_all = $case, rename_all_fields = $case))]
        pub enum $name { $(
            $(#[doc = $meaning])+
            $variant $(($($of),+))? $({ $($(#[doc = $says])+ $named: $type),+ })?,
        )+ }

        $crate::words::words! { @kinds
            [#[doc = concat!("The words of [`", stringify!($name), "`], without what comes with them.")]
            #[derive(PartialOrd, Ord)]]
            [$($about)+] $kind of $name in $case
            $([$($meaning)+] $variant $(($($field: $of),+))? $({ $($named: $type),+ })? = $code;)+
        }

        impl $name {
            /// One of each word, with values for examples.
            pub const SAMPLES: &'static [Self] = {
                use $crate::words::Content;
                &[$(
                    Self::$variant $(($(<$of>::SAMPLE),+))? $({ $($named: <$type>::SAMPLE),+ })?
                ),+]
            };

            /// This word where nothing comes with it: for interfaces of plain records.
            #[must_use]
            pub const fn bare(kind: $kind) -> Option<Self> {
                match kind { $(
                    $kind::$variant => $crate::words::bare!(
                        Self::$variant $(, ($($of),+))? $(, { $($named),+ })?
                    )
                ),+ }
            }

            /// The word, without what comes with it.
            #[must_use]
            pub const fn kind(&self) -> $kind {
                match self { $(Self::$variant { .. } => $kind::$variant),+ }
            }

            pub(crate) fn tell_fields(&self, said: &mut $crate::words::Said) {
                use $crate::words::Content;
                match self { $(
                    Self::$variant $(($($field),+))? $({ $($named),+ })? => {
                        let _: &mut $crate::words::Said = said;
                        $($($field.tell(said);)+)?
                        $($($named.tell(said);)+)?
                    }
                )+ }
            }
        }

        impl core::fmt::Display for $name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                match self { $(
                    Self::$variant $(($($field),+))? $({ $($named),+ })? => {
                        // A text need not tell all.
                        $($(let _ = $field;)+)?
                        $($(let _ = $named;)+)?
                        $crate::words::text!(f, $variant $(, $text $(, $argument)*)?)
                    }
                )+ }
            }
        }

        #[cfg(any(test, feature = "laws"))]
        impl $crate::laws::arbitrary::AnyWord for $name {
            type Kind = $kind;
            const COUNT: usize = $name::WORDS.words.len();

            fn any_of(kind: $kind, source: &mut impl $crate::laws::Source) -> Self {
                use $crate::laws::arbitrary::Any;
                let _ = &source;
                match kind { $(
                    $kind::$variant => Self::$variant
                        $(($(<$of>::any(source)),+))? $({ $($named: <$type>::any(source)),+ })?
                ),+ }
            }

            fn nth(number: u32, source: &mut impl $crate::laws::Source) -> Self {
                $(if number == $kind::$variant as u32 {
                    return Self::any_of($kind::$variant, source);
                })+
                Self::SAMPLES[0]
            }
        }
    };

    (@kinds
        [$(#[$attr:meta])*] [$($about:literal)+] $kind:ident of $name:ident in $case:tt
        $(
            [$($meaning:literal)+] $variant:ident
                $(($($field:ident: $of:ty),+))? $({ $($named:ident: $type:ty),+ })?
                = $code:literal $(, $text:literal)?;
        )+
    ) => {
        $(#[$attr])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(rename_all = $case))]
        #[repr(u8)]
        pub enum $kind { $(
            $(#[doc = $meaning])+
            $variant,
        )+ }

        impl $name {
            /// The enumeration, as a table.
            pub const WORDS: $crate::words::Words = $crate::words::Words {
                name: stringify!($name),
                meaning: concat!($($about),+).trim_ascii_start(),
                words: &[$($crate::words::Word {
                    variant: stringify!($variant),
                    name: $crate::words::spelled!($variant, $case),
                    code: $code,
                    meaning: concat!($($meaning),+).trim_ascii_start(),
                    fields: &[
                        $($($crate::words::Field {
                            name: stringify!($field),
                            of: stringify!($of),
                        }),+)?
                        $($($crate::words::Field {
                            name: stringify!($named),
                            of: stringify!($type),
                        }),+)?
                    ],
                    names_fields: !stringify!($($($named)+)?).is_empty(),
                }),+],
            };
        }

        impl $kind {
            /// All of them, in order.
            pub const ALL: [Self; $name::WORDS.words.len()] = [$(Self::$variant),+];

            /// Its entry in the table.
            #[must_use]
            pub const fn word(self) -> &'static $crate::words::Word {
                &$name::WORDS.words[self as usize]
            }

            /// Its name in JSON.
            #[must_use]
            pub const fn name(self) -> &'static str {
                self.word().name
            }

            /// Its number on interfaces without names.
            #[must_use]
            pub const fn code(self) -> u8 {
                self.word().code
            }

            /// The one of this name.
            #[must_use]
            pub fn named(name: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|it| it.name() == name)
            }

            /// The one of this number.
            #[must_use]
            pub fn of_code(code: u8) -> Option<Self> {
                Self::ALL.into_iter().find(|it| it.code() == code)
            }
        }

        impl core::fmt::Display for $kind {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                match self {
                    $(Self::$variant => $crate::words::text!(f, $variant $(, $text)?)),+
                }
            }
        }
    };
}

pub(crate) use {bare, spelled, text, words};
