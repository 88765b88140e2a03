//! The hazards in words, from the table in `hazards.toml`.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::hazards::{Hazard, HazardKind, Passage};
use super::readings::OtherReading;

/// Texts on a hazard.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(rename_all(serialize = "camelCase"))]
pub struct Text {
    /// Its id.
    pub id: String,
    /// Its name, in a few words.
    pub title: String,
    /// The text's relation to it.
    pub kind: HazardKind,
    /// Where the text says it, or would have to.
    #[serde(flatten)]
    pub passage: Passage,
    /// The property that it breaks.
    pub statement: String,
    /// How it comes about.
    pub explanation: String,
    /// Its meaning for a person on the road or at the kerb.
    pub person: String,
    /// The rule of the protocol that closes it, with the ids of the properties that verify it.
    pub closed_by: String,
    /// A reading of the text that says more, and what becomes of the hazard in it.
    #[serde(skip_serializing)]
    pub other_reading: Option<OtherReading>,
}

/// The file: the hazards in the order of [`Hazard::ALL`], and W1 beside a guard that blocks.
#[derive(Deserialize)]
struct Texts {
    hazard: [Text; Hazard::ALL.len() + 1],
}

static TEXTS: LazyLock<Texts> = LazyLock::new(|| {
    toml::from_str(include_str!("hazards.toml")).expect("the table of hazards is well-formed")
});

impl Hazard {
    /// Its texts.
    ///
    /// # Panics
    /// Never: a test reads the table.
    #[must_use]
    pub fn text(self) -> &'static Text {
        &TEXTS.hazard[self as usize]
    }

    /// Texts on a run that brings it about, beside an escort or not.
    pub(super) fn text_beside(self, is_escorted: bool) -> &'static Text {
        match self {
            Self::W1 if !is_escorted => &TEXTS.hazard[Self::ALL.len()],
            _ => self.text(),
        }
    }
}
