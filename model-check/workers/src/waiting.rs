//! States that wait to be expanded. All but some lie in a file, so that memory is left for what was found.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use crossguard_model_check::model::ModelState;

use crate::table::Hint;

pub(crate) type Waiting = (ModelState, Hint);

/// How many states are kept as they are.
const OPEN: usize = 1 << 15;

/// States in no order that matters.
#[derive(Default)]
pub(crate) struct Queue {
    open: Vec<Waiting>,
    written: Vec<Written>,
    file: Option<File>,
}

/// Where some states were written to.
enum Written {
    /// So many octets of the file, from this one on.
    File { begin: u64, len: usize },
    /// The file could not be written.
    Memory(Box<[u8]>),
}

impl Queue {
    pub(crate) fn push(&mut self, state: Waiting) {
        self.open.push(state);
        if self.open.len() == OPEN {
            let written = postcard::to_allocvec(&self.open).expect("states can be written");
            let written = self.put_aside(written.into());
            self.written.push(written);
            self.open.clear();
        }
    }

    /// # Panics
    /// Where the file of the process cannot be read any more. The panic ends the check as incomplete.
    pub(crate) fn pop(&mut self) -> Option<Waiting> {
        if self.open.is_empty()
            && let Some(written) = self.written.pop()
        {
            let written = self.fetch(written);
            let written = written.expect("the temporary file of waiting states can be read");
            self.open = postcard::from_bytes(&written).expect("it was written here");
        }
        self.open.pop()
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.open.is_empty() && self.written.is_empty()
    }

    fn put_aside(&mut self, states: Box<[u8]>) -> Written {
        match self.write(&states) {
            Ok(begin) => Written::File {
                begin,
                len: states.len(),
            },
            Err(_) => Written::Memory(states),
        }
    }

    fn write(&mut self, states: &[u8]) -> io::Result<u64> {
        let needed = self.written.iter().rev().find_map(|written| match written {
            Written::File { begin, len } => Some(begin + *len as u64),
            Written::Memory(_) => None,
        });
        let begin = needed.unwrap_or(0);
        let file = match &mut self.file {
            Some(file) => file,
            // It has no name any more, so it goes with the process, however that ends.
            none => none.insert(tempfile::tempfile()?),
        };
        file.seek(SeekFrom::Start(begin))?;
        file.write_all(states)?;
        Ok(begin)
    }

    fn fetch(&mut self, written: Written) -> io::Result<Box<[u8]>> {
        match (written, &mut self.file) {
            (Written::File { begin, len }, Some(file)) => {
                let mut states = vec![0; len];
                file.seek(SeekFrom::Start(begin))?;
                file.read_exact(&mut states)?;
                Ok(states.into())
            }
            (Written::File { .. }, None) => Err(io::ErrorKind::NotFound.into()),
            (Written::Memory(states), _) => Ok(states),
        }
    }
}

#[cfg(test)]
mod tests {
    use crossguard_model_check::model::Model;
    use crossguard_model_check::scenario::Scenario;

    use super::*;
    use crate::table::Fingerprint;

    #[test]
    fn what_is_pushed_is_popped_once() {
        let state = Model::new(Scenario::load("stable").unwrap()).initial();
        let count = u32::try_from(3 * OPEN + 5).unwrap();
        let hint = |n: u32| Fingerprint::of_hash(u128::from(n + 1) << 68).hint();
        let mut queue = Queue::default();
        for n in 0..count {
            queue.push((state.clone(), hint(n)));
        }
        assert_eq!(queue.written.len(), 3);
        let mut popped: Vec<_> = std::iter::from_fn(|| queue.pop()).collect();
        popped.sort_by_key(|(_, hint)| *hint);
        let pushed: Vec<_> = (0..count).map(|n| (state.clone(), hint(n))).collect();
        assert!(popped == pushed && queue.is_empty());
    }

    #[test]
    fn what_cannot_go_to_a_file_stays_in_memory() {
        let state = Model::new(Scenario::load("stable").unwrap()).initial();
        let readable = tempfile::NamedTempFile::new().unwrap();
        let mut queue = Queue {
            file: Some(File::open(readable.path()).unwrap()),
            ..Queue::default()
        };
        let waiting = (state, Fingerprint::of_hash(u128::MAX).hint());
        for _ in 0..OPEN {
            queue.push(waiting.clone());
        }
        assert!(matches!(&queue.written[..], [Written::Memory(_)]));
        let popped = std::iter::from_fn(|| queue.pop());
        assert_eq!(popped.filter(|popped| *popped == waiting).count(), OPEN);
    }

    #[test]
    fn a_file_is_as_long_as_what_waited_at_once() {
        let state = Model::new(Scenario::load("stable").unwrap()).initial();
        let mut queue = Queue::default();
        for _ in 0..5 {
            for _ in 0..2 * OPEN {
                queue.push((state.clone(), Fingerprint::of_hash(u128::MAX).hint()));
            }
            while queue.pop().is_some() {}
        }
        let len = queue.file.unwrap().metadata().unwrap().len();
        // Written, they take less than two thirds of what they take as they are.
        assert!(usize::try_from(len).unwrap() * 3 < 2 * (2 * OPEN) * size_of::<Waiting>());
    }
}
