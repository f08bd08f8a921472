//! What a planner told, to be compared with what it tells another time.

use std::{
    fmt,
    hash::{DefaultHasher, Hasher},
};

/// Up to here the text itself is kept, to show where two logs part.
const KEPT: usize = 1 << 20;

/// Text of any length in little memory: its beginning in full, of all of it a hash.
#[derive(Debug, Default)]
pub(crate) struct Log {
    beginning: String,
    hasher: DefaultHasher,
}

impl fmt::Write for Log {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        if self.beginning.len() < KEPT {
            self.beginning.push_str(text);
        }
        self.hasher.write(text.as_bytes());
        Ok(())
    }
}

impl Log {
    /// Where this log of events, one a line, and another part; `None` if they are the same.
    pub(crate) fn parts_from(&self, other: &Self) -> Option<String> {
        if self.hasher.finish() == other.hasher.finish() {
            return None;
        }
        let events = self.beginning.lines().zip(other.beginning.lines());
        let parted = events.zip(1..).find(|((a, b), _)| a != b);
        Some(match parted {
            Some(((a, b), n)) => format!("the traces part at event {n}: first {a}, then {b}"),
            None if self.beginning.len().min(other.beginning.len()) < KEPT => {
                "one trace goes on where the other ends".into()
            }
            None => "the traces part late".into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fmt::Write;

    fn log(lines: impl Iterator<Item = u32>) -> Log {
        let mut log = Log::default();
        for line in lines {
            writeln!(log, "{line}").unwrap();
        }
        log
    }

    #[test]
    fn logs_part_where_they_differ_and_late_is_not_too_late() {
        assert_eq!(log(0..9).parts_from(&log(0..9)), None);
        let early = log(0..9).parts_from(&log((0..9).rev())).unwrap();
        assert!(early.contains("event 1: first 0, then 8"), "{early}");
        let short = log(0..9).parts_from(&log(0..8)).unwrap();
        assert!(short.contains("goes on"), "{short}");
        let late = log(0..900_000).parts_from(&log(0..900_001)).unwrap();
        assert!(late.contains("late"), "{late}");
    }
}
