/// 64 bits of a row of words, from one on, the first the lowest; beyond the last all are zero.
///
/// ```
/// let words = [1 << 63, 0b101];
/// assert_eq!(pf_grid::bits_from(&words, 63), 0b1011);
/// assert_eq!(pf_grid::bits_from(&words, 128), 0);
/// ```
#[inline]
#[must_use]
pub fn bits_from(words: &[u64], first: u32) -> u64 {
    let (at, shift) = (first as usize / 64, first % 64);
    let word = |at| words.get(at).copied().unwrap_or(0);
    // By 63 and one more, as nothing shifts by 64.
    word(at) >> shift | word(at + 1) << (63 - shift) << 1
}
