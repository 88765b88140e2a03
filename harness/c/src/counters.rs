//! How often each cause of a drop occurred, without a heap, and texts in buffers of fixed length.

use core::fmt::{self, Display, Write};

use crossguard_endpoint::cause::Cause;

/// More causes than there are.
const CAUSES: usize = 96;

/// How often each cause occurred.
#[derive(Clone)]
pub(crate) struct Counters([Option<(Cause, u64)>; CAUSES]);

impl Counters {
    pub(crate) const NONE: Self = Self([None; CAUSES]);

    pub(crate) fn count(&mut self, cause: Cause) {
        for slot in &mut self.0 {
            match slot {
                Some((counted, count)) if *counted == cause => {
                    *count = count.saturating_add(1);
                    return;
                }
                Some(_) => {}
                None => {
                    *slot = Some((cause, 1));
                    return;
                }
            }
        }
    }

    /// The causes that occurred, in the order in which each first did.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Cause, u64)> + Clone {
        self.0.iter().map_while(|counted| *counted)
    }
}

/// Text that ends where its buffer does.
pub(crate) struct Text<const N: usize> {
    octets: [u8; N],
    length: usize,
}

impl<const N: usize> Text<N> {
    pub(crate) fn of(value: &impl Display) -> Self {
        let mut text = Self {
            octets: [0; N],
            length: 0,
        };
        // It is cut, which is not an error.
        let _ = write!(text, "{value}");
        text
    }

    pub(crate) fn as_str(&self) -> &str {
        core::str::from_utf8(&self.octets[..self.length]).unwrap_or_default()
    }
}

impl<const N: usize> Write for Text<N> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for character in text.chars() {
            let end = self.length + character.len_utf8();
            let room = self.octets.get_mut(self.length..end).ok_or(fmt::Error)?;
            character.encode_utf8(room);
            self.length = end;
        }
        Ok(())
    }
}
