//! Golden files: what the code said when somebody last looked and agreed.

use std::{fs, path::PathBuf};

/// Compares `text` with `tests/golden/NAME.txt`, or writes it there where `PF_BLESS` is set
/// (`cargo xtask bless`).
///
/// # Panics
/// If they differ; the message names the first line that does.
#[track_caller]
pub fn check(name: &str, text: &str) {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("golden/{name}.txt"));
    if std::env::var_os("PF_BLESS").is_some() {
        fs::write(&file, text).expect("the golden folder takes files");
        return;
    }
    let blessed = fs::read_to_string(&file).unwrap_or_default();
    if let Some(difference) = first_difference(&blessed, text) {
        panic!("tests/golden/{name}.txt, {difference}\nif that is right: cargo xtask bless");
    }
}

/// Where two texts part, in words; line ends do not count.
fn first_difference(blessed: &str, now: &str) -> Option<String> {
    let (mut left, mut right) = (blessed.lines(), now.lines());
    for line in 1.. {
        match (left.next(), right.next()) {
            (None, None) => break,
            (was, is) if was == is => {}
            (was, is) => {
                let (was, is) = (was.unwrap_or("(nothing)"), is.unwrap_or("(nothing)"));
                return Some(format!("line {line}:\n  was {was}\n  is  {is}"));
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_that_differs_is_named() {
        let differs = |was, is| first_difference(was, is).unwrap_or_default();
        assert_eq!(differs("a\nb\n", "a\r\nb"), "");
        assert_eq!(differs("a\nb", "a\nc"), "line 2:\n  was b\n  is  c");
        assert_eq!(differs("a", "a\nc"), "line 2:\n  was (nothing)\n  is  c");
        assert_eq!(differs("a\nb", "a"), "line 2:\n  was b\n  is  (nothing)");
    }
}
