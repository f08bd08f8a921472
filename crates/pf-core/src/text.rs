//! Words of a note.

use std::{fmt, ops::Deref};

/// As many bytes need no memory of their own.
const SHORT: usize = 22;

/// What a note says. Short texts are kept in place: a planner that answers thousands of times a second
/// allocates nothing for them. (This crate depends on little, so it has no library for it.)
#[derive(Clone, PartialEq, Eq)]
pub struct Text(Kept);

#[derive(Clone, PartialEq, Eq)]
enum Kept {
    Short(u8, [u8; SHORT]),
    Long(String),
}

impl Text {
    /// The text of what can be displayed.
    #[must_use]
    pub fn of(said: impl fmt::Display) -> Self {
        let mut text = Self(Kept::Short(0, [0; SHORT]));
        // Only what is said can fail, and then as much as there is of it is kept.
        fmt::write(&mut text, format_args!("{said}")).ok();
        text
    }
}

impl fmt::Write for Text {
    fn write_str(&mut self, more: &str) -> fmt::Result {
        if let Kept::Short(length, bytes) = &mut self.0 {
            let end = usize::from(*length) + more.len();
            if let Some(room) = bytes.get_mut(usize::from(*length)..end) {
                room.copy_from_slice(more.as_bytes());
                #[expect(clippy::cast_possible_truncation, reason = "at most 22")]
                let end = end as u8;
                *length = end;
                return Ok(());
            }
            self.0 = Kept::Long(String::from(&**self));
        }
        if let Kept::Long(text) = &mut self.0 {
            text.push_str(more);
        }
        Ok(())
    }
}

impl Deref for Text {
    type Target = str;

    fn deref(&self) -> &str {
        match &self.0 {
            Kept::Short(length, bytes) => {
                str::from_utf8(&bytes[..usize::from(*length)]).unwrap_or_default()
            }
            Kept::Long(text) => text,
        }
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self)
    }
}

impl fmt::Debug for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&**self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_is_kept() {
        for length in 0..60 {
            let said: String = "aé√".chars().cycle().take(length).collect();
            let text = Text::of(format_args!("{said}{}", 12.5));
            assert_eq!(&*text, format!("{said}12.5"));
            assert_eq!(text, Text::of(format!("{said}12.5")));
        }
    }
}
