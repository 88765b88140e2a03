//! The links between the lines of a log: each line ends with a digest of itself and of the link before it.
//!
//! ```text
//!   {"atUs":0,…,"part":1,"link":"5a…"}     the first line of a run
//!   {"atUs":40,…,"link":"c1…"}             SHA-256 of "5a…" and of this line up to its link
//! ```
//!
//! So a line that is gone, altered, or put elsewhere is noticed at the line after it. Anybody who can rewrite the whole log
//! can compute all links anew: keep the last one elsewhere where that matters. A log without links is an older one, or
//! one that another program has rewritten, and says nothing of what is missing.

use std::fmt::Write as _;

use sha2::{Digest, Sha256};

/// How many hexadecimal digits a link has: 64 bits.
const DIGITS: usize = 16;
const BEFORE: &[u8] = b",\"link\":\"";
const AFTER: &[u8] = b"\"}\n";

/// Why a line does not follow the line before it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Unchained {
    /// The log begins in the middle of a run.
    #[error("is not the first of its run: the lines before it are missing")]
    NoBeginning,
    /// Its link is another one.
    #[error("does not follow the line before it: lines in between are missing, or one was changed")]
    Gap,
    /// It has no link.
    #[error(
        "has no link, and the line before it has one: it was added or changed by another program"
    )]
    NoLink,
}

/// The links of a log, as far as it has been written or read.
#[derive(Clone, Debug, Default)]
pub(super) struct Chain {
    pub(super) last: Option<[u8; DIGITS]>,
    /// How many lines had a link.
    pub(super) linked: usize,
}

impl Chain {
    /// Adds a link to a line, a JSON object without an end, and `part` where it is the first of a file.
    pub(super) fn link(&mut self, line: &mut Vec<u8>, part: Option<u32>) {
        let closing = line.pop();
        debug_assert_eq!(closing, Some(b'}'), "a JSON object");
        if let Some(part) = part {
            line.extend(format!(",\"part\":{part}").bytes());
            if part == 1 {
                self.last = None;
            }
        }
        let digits = self.next(line);
        line.extend(BEFORE);
        line.extend(digits);
        line.extend(AFTER);
        self.last = Some(digits);
        self.linked += 1;
    }

    /// Whether a line, with its end, follows the lines before it.
    pub(super) fn follow(&mut self, line: &[u8]) -> Result<(), Unchained> {
        let Some((body, digits)) = split(line) else {
            return match self.last {
                None => Ok(()),
                Some(_) => Err(Unchained::NoLink),
            };
        };
        if body.ends_with(b",\"part\":1") {
            self.last = None;
        } else if self.last.is_none() {
            return Err(Unchained::NoBeginning);
        }
        if self.next(body) != digits {
            return Err(Unchained::Gap);
        }
        self.last = Some(digits);
        self.linked += 1;
        Ok(())
    }

    fn next(&self, body: &[u8]) -> [u8; DIGITS] {
        let mut digest = Sha256::new();
        digest.update(self.last.unwrap_or_default());
        digest.update(body);
        let mut digits = String::with_capacity(2 * 32);
        for octet in digest.finalize() {
            let _ = write!(digits, "{octet:02x}");
        }
        let mut link = [0; DIGITS];
        link.copy_from_slice(&digits.as_bytes()[..DIGITS]);
        link
    }
}

/// A line up to its link, and the link.
fn split(line: &[u8]) -> Option<(&[u8], [u8; DIGITS])> {
    let rest = line.strip_suffix(AFTER)?;
    let (rest, digits) = rest.split_last_chunk::<DIGITS>()?;
    Some((rest.strip_suffix(BEFORE)?, *digits))
}

/// Which part of a run a file begins with; `None` where its first line does not say.
pub(super) fn part_of(first: &[u8]) -> Option<u32> {
    let (body, _) = split(first)?;
    let at = body.iter().rposition(|octet| *octet == b':')?;
    body[..=at].strip_suffix(b",\"part\":")?;
    std::str::from_utf8(&body[at + 1..]).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(count: usize) -> Vec<Vec<u8>> {
        let mut chain = Chain::default();
        let line = |number: usize| {
            let mut line = format!("{{\"atUs\":{number}}}").into_bytes();
            chain.link(&mut line, (number == 0).then_some(1));
            line
        };
        (0..count).map(line).collect()
    }

    fn read<'a>(lines: impl IntoIterator<Item = &'a Vec<u8>>) -> Result<usize, Unchained> {
        let mut chain = Chain::default();
        for line in lines {
            chain.follow(line)?;
        }
        Ok(chain.linked)
    }

    #[test]
    fn every_line_that_is_gone_moved_or_changed_is_noticed() {
        let lines = lines(6);
        assert_eq!(read(&lines), Ok(6));
        assert_eq!(read(&lines[1..]), Err(Unchained::NoBeginning));
        for gone in 1..5 {
            let others = lines.iter().enumerate().filter(|(at, _)| *at != gone);
            assert_eq!(read(others.map(|(_, line)| line)), Err(Unchained::Gap));
        }
        for at in 0..6 {
            for octet in 0..lines[at].len() - AFTER.len() {
                let mut changed = lines.clone();
                changed[at][octet] ^= 1;
                assert!(read(&changed).is_err(), "line {at}, octet {octet}");
            }
        }
        let mut swapped = lines.clone();
        swapped.swap(2, 3);
        assert_eq!(read(&swapped), Err(Unchained::Gap));
        // Another run after it.
        let both: Vec<_> = lines.iter().chain(&lines).collect();
        assert_eq!(read(both), Ok(12));
    }

    #[test]
    fn an_older_log_has_no_links_and_nothing_is_added_to_a_newer_one() {
        let old = b"{\"atUs\":0}\n".to_vec();
        assert_eq!(read([&old, &old]), Ok(0));
        let mut lines = lines(2);
        lines.push(old);
        assert_eq!(read(&lines), Err(Unchained::NoLink));
    }

    #[test]
    fn a_file_says_which_part_of_a_run_it_begins_with() {
        let mut chain = Chain::default();
        for part in [1, 2, 17] {
            let mut line = b"{\"atUs\":5}".to_vec();
            chain.link(&mut line, Some(part));
            assert_eq!(part_of(&line), Some(part));
        }
        let mut line = b"{\"atUs\":5}".to_vec();
        chain.link(&mut line, None);
        assert_eq!(part_of(&line), None);
        assert_eq!(part_of(b"{\"part\":3}\n"), None);
    }
}
