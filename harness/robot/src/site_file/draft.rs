//! A site as its file has it, and with points elsewhere: their numbers are exchanged in the text, and nothing else of it.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::io::{Error, ErrorKind, Result as Done};
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};

use toml::Spanned;

use super::{SiteFile, SiteTables};
use crate::located::{self, Exact, FileError, Point};
use crate::{files, pki};

/// The points of a site that can be moved: a name that is unique, and metres to the east and to the north.
pub(super) type Points = Vec<(String, [Spanned<f64>; 2])>;

/// A site file that fits, with its text.
#[derive(Debug)]
pub struct Draft {
    path: PathBuf,
    /// Content of the file.
    before: String,
    /// The text.
    pub text: String,
    /// The site that it says.
    pub site: SiteFile,
    points: Points,
}

impl Draft {
    /// Reads a site file.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let text = located::read(path)?;
        Self::parse(path.to_owned(), text.clone(), text)
    }

    fn parse(path: PathBuf, before: String, text: String) -> Result<Self, FileError> {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let (site, points) = SiteFile::parse(&path.display().to_string(), &stem, &text)?;
        Ok(Self {
            path,
            before,
            text,
            site,
            points,
        })
    }

    /// The points that can be moved, in metres to the east and to the north: ends of kerbs, ends of lanes, and places by name.
    pub fn points(&self) -> impl Iterator<Item = (&str, [f64; 2])> {
        let points = self.points.iter();
        points.map(|(name, at)| (&**name, at.each_ref().map(|it| *it.get_ref())))
    }

    /// The same file with these points elsewhere, in metres to the east and to the north. It is not written.
    ///
    /// # Errors
    /// When there is no such point, or the site does not fit then.
    pub fn moved(&self, to: &BTreeMap<String, [f64; 2]>) -> Result<Self, FileError> {
        let mut numbers = Vec::new();
        for (name, metres) in to {
            let mut points = self.points.iter();
            let Some((_, point)) = points.find(|(it, _)| it == name) else {
                let what = format!("it has no '{}' that can be moved", located::cut(name));
                return Err(self.error(what));
            };
            numbers.extend(point.iter().zip(metres));
        }
        // The last one first: the others are still where they were.
        numbers.sort_by_key(|(number, _)| Reverse(number.span().start));
        let mut text = self.text.clone();
        for (number, metres) in numbers {
            if number.get_ref().total_cmp(metres).is_ne() {
                text.replace_range(number.span(), &format!("{metres:?}"));
            }
        }
        Self::parse(self.path.clone(), self.before.clone(), text)
    }

    /// Writes it in the place of its file: at any moment one of the two is there, whole. A link stays one.
    ///
    /// # Errors
    /// When it cannot be written, or the file is read-only or has changed since it was read.
    pub fn save(&self) -> Result<(), FileError> {
        self.write().map_err(|cause| self.error(cause.to_string()))
    }

    fn write(&self) -> Done<()> {
        let path = self.path.canonicalize()?;
        let permissions = path.metadata()?.permissions();
        if permissions.readonly() {
            return Err(Error::new(ErrorKind::PermissionDenied, "is read-only"));
        }
        let new = pki::unnamed(&path, self.text.as_bytes(), permissions.mode())?;
        // To have it on the disk takes a while.
        if files::text(&path, files::TEXT_MAX)? != self.before {
            return Err(Error::other("has changed since it was read"));
        }
        new.persist(&path)?;
        path.parent().map_or(Ok(()), pki::sync_folder)
    }

    fn error(&self, what: String) -> FileError {
        FileError {
            file: self.path.display().to_string(),
            line: None,
            what,
        }
    }
}

impl SiteTables {
    pub(super) fn points(&self) -> Points {
        let point = |name: String, at: &Point| (name, at.get_ref().0.clone());
        let mut points = Points::new();
        let kerbs = self.crossing.kerbs_m.iter().flat_map(Spanned::get_ref);
        for (nth, Exact([from, to])) in kerbs.enumerate() {
            points.push(point(format!("kerb {} from", nth + 1), from));
            points.push(point(format!("kerb {} to", nth + 1), to));
        }
        for (nth, lane) in self.lanes.iter().enumerate() {
            let name = format!("lane {} ({})", nth + 1, lane.name);
            points.push(point(format!("{name} from"), &lane.from_m));
            points.push(point(format!("{name} to"), &lane.to_m));
        }
        let places = self.places.iter();
        points.extend(places.map(|(name, it)| point(format!("place {name}"), &it.get_ref().at_m)));
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hazard: while the file is written, an editor saves it, and that is lost.
    #[test]
    fn a_file_that_has_changed_since_it_was_read_is_not_written_over() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("site.toml");
        std::fs::write(&path, super::super::STREET).unwrap();
        let draft = Draft::read(&path).unwrap();
        let moved = draft.moved(&[("place corner".to_owned(), [0.5, -1.5])].into());
        let other = format!("{}# more\n", super::super::STREET);
        std::fs::write(&path, &other).unwrap();
        let error = moved.unwrap().save().unwrap_err().to_string();
        assert!(error.ends_with("has changed since it was read"), "{error}");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), other);
        let left = std::fs::read_dir(folder.path()).unwrap().count();
        assert_eq!(left, 1, "nothing is left behind");
    }
}
