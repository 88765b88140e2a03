//! Lines of files and pipes that others write: none is read that is longer than any line can be.

use std::io::{BufRead, Read as _};

/// The longest line that is read, in octets: a record of a robot has a few thousand.
pub const LINE_MAX: usize = 1 << 20;

/// Why a line cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum LineError {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// It is longer than any; nothing after it is read.
    #[error("is longer than {LINE_MAX} octets: this is not a file of lines like ours")]
    TooLong,
}

/// Reads a line to its end, which is part of it, or to the end of the file; nothing at the end.
///
/// # Errors
/// Why it cannot be read.
pub fn read_line(from: &mut impl BufRead) -> Result<Vec<u8>, LineError> {
    let mut line = Vec::new();
    // One octet more than the longest.
    let limit = u64::try_from(LINE_MAX + 1).unwrap_or(u64::MAX);
    from.take(limit).read_until(b'\n', &mut line)?;
    if line.len() > LINE_MAX {
        return Err(LineError::TooLong);
    }
    Ok(line)
}

/// The lines of a file, without their ends, up to the first that cannot be read.
pub fn lines(mut from: impl BufRead) -> impl Iterator<Item = Result<Vec<u8>, LineError>> {
    let mut is_over = false;
    std::iter::from_fn(move || {
        if is_over {
            return None;
        }
        let line = read_line(&mut from).map(|mut line| {
            if line.is_empty() {
                is_over = true;
                return None;
            }
            if line.last() == Some(&b'\n') {
                line.pop();
            }
            Some(line)
        });
        is_over |= line.is_err();
        line.transpose()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_read_up_to_one_that_is_too_long() {
        let longest = vec![b'a'; LINE_MAX - 1];
        let file = [b"one\n\n", &longest[..], b"\n", &longest, b"b\nlast\n"].concat();
        let mut read = lines(&file[..]);
        let mut next = || read.next().map(|line| line.map(|line| line.len()));
        assert!(matches!(next(), Some(Ok(3))));
        assert!(matches!(next(), Some(Ok(0))));
        assert!(matches!(next(), Some(Ok(length)) if length == LINE_MAX - 1));
        assert!(matches!(next(), Some(Err(LineError::TooLong))));
        assert!(next().is_none());
    }

    #[test]
    fn a_line_without_an_end_costs_no_more_than_the_longest() {
        /// A file of four hundred million octets and no end of a line, which counts what is read of it.
        struct Endless(u64);
        impl std::io::Read for Endless {
            fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
                let left = usize::try_from(400_000_000 - self.0).unwrap();
                let length = buffer.len().min(left);
                buffer[..length].fill(b'{');
                self.0 += length as u64;
                Ok(length)
            }
        }
        let mut file = std::io::BufReader::new(Endless(0));
        assert!(matches!(read_line(&mut file), Err(LineError::TooLong)));
        assert!(file.get_ref().0 < 2 * LINE_MAX as u64);
    }
}
