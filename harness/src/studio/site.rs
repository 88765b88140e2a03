//! A site file on its street: points are moved on the page, and the file is written when the site fits.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use crossguard_judge::playback::Recent;
use crossguard_robot::site_file::{Draft, SiteFile};
use serde::Deserialize;
use serde_json::{Value, json};

use super::shell::{Page, Refusal, Skip, View};

static PAGE: Page = Page {
    name: "site",
    title: "Site",
    about: "A site file on its street: move kerbs, lanes and places, see whether the site fits, and save the file.",
    skip: Skip {
        to: "said-title",
        words: "Skip to what the kit says",
    },
    content: include_str!("site/content.html"),
    shared_style: Some("run.css"),
    files: &[
        ("site.css", include_str!("site/site.css")),
        ("site.js", include_str!("site/site.js")),
    ],
};

/// Says of a site how it fits, or why it does not.
pub(super) type Check = dyn Fn(&SiteFile) -> Result<String, String> + Send + Sync;

/// A site file that the page may write.
pub struct Edited {
    /// The file.
    pub file: PathBuf,
    /// The check that the site has to pass before it is written.
    pub check: Box<Check>,
}

/// A question of the page: the site with points elsewhere.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Question {
    /// The version of the file that the page has shown.
    version: String,
    /// Points by name, in metres to the east and to the north.
    moved: BTreeMap<String, [f64; 2]>,
    /// Whether the file is written.
    save: bool,
}

#[derive(Debug, thiserror::Error)]
enum Trouble {
    #[error("it is no question: {0}")]
    Garbled(#[from] serde_json::Error),
    #[error("{0} has changed since this page read it. Nothing was written: read the file again")]
    Changed(String),
    #[error("{0}")]
    File(String),
    #[error("this studio edits no site: crossguard studio --site FILE, without --address")]
    NoSite,
}

/// The view of a site. One question at a time reads the file, and may write it.
pub(super) struct Site(Option<Mutex<Edited>>);

impl Site {
    pub(super) fn new(edited: Option<Edited>) -> Self {
        Self(edited.map(Mutex::new))
    }
}

fn version(draft: &Draft) -> String {
    let mut hasher = DefaultHasher::new();
    draft.text.hash(&mut hasher);
    hasher.finish().to_string()
}

impl Edited {
    fn read(&self) -> Result<Draft, Trouble> {
        Draft::read(&self.file).map_err(|cause| Trouble::File(cause.to_string()))
    }

    /// First data of the page: the points, and a run without records, whose street has them in the same order.
    fn opening(&self) -> Result<Value, Trouble> {
        let draft = self.read()?;
        let points: Vec<_> = draft.points().collect();
        let run = Recent::default().playback(Some(draft.site.clone()), 0);
        let (file, overview) = (self.file.display().to_string(), run.overview(&[]));
        Ok(
            json!({"file": file, "version": version(&draft), "points": points, "overview": overview}),
        )
    }

    /// Verdict on the site as it would be, and the new version of a file that was written.
    fn answer(&self, question: &[u8]) -> Result<Value, Trouble> {
        let question: Question = serde_json::from_slice(question)?;
        let draft = self.read()?;
        if version(&draft) != question.version {
            return Err(Trouble::Changed(self.file.display().to_string()));
        }
        let moved = draft.moved(&question.moved);
        let moved = moved.map_err(|cause| cause.to_string());
        let (said, draft) = match moved.and_then(|it| Ok(((self.check)(&it.site)?, it))) {
            Err(said) => return Ok(json!({"fits": false, "said": said})),
            Ok(fitting) => fitting,
        };
        let save = |()| draft.save().map(|()| version(&draft));
        let saved = question.save.then_some(()).map(save).transpose();
        let saved = saved.map_err(|cause| Trouble::File(cause.to_string()))?;
        Ok(json!({"fits": true, "said": said, "saved": saved}))
    }
}

impl View for Site {
    fn page(&self) -> &'static Page {
        &PAGE
    }

    fn wants(&self) -> Option<&'static str> {
        self.0.is_none().then_some("crossguard studio --site FILE")
    }

    fn commands(&self) -> Option<&'static str> {
        Some("moved")
    }

    fn ask(&self, what: &str, _query: &str, body: &[u8]) -> Result<String, Refusal> {
        let wrong = |trouble: Trouble| Refusal::Wrong(trouble.to_string());
        let edited = self.0.as_ref().ok_or_else(|| wrong(Trouble::NoSite))?;
        let edited = edited.lock().unwrap_or_else(PoisonError::into_inner);
        let answer = match what {
            "opening" => edited.opening(),
            "moved" => edited.answer(body),
            _ => return Err(Refusal::Unknown),
        };
        answer.map(|it| it.to_string()).map_err(wrong)
    }
}
