//! Powers of two by additions and multiplications alone: the same bits on every machine, which a
//! mathematical library does not promise.

use std::f64::consts::LN_2;

/// Added and taken away again it rounds to a whole number: 1.5 * 2^52 leaves no bits for a fraction.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// 2^x to some ten digits, 0 below -1000; `x` at most 1000.
#[inline]
pub(crate) fn exp2(x: f64) -> f64 {
    // The Taylor series of e^(f ln 2) for |f| <= 1/2.
    const C: [f64; 10] = [
        1.0,
        LN_2,
        0.240_226_506_959_100_7,
        0.055_504_108_664_821_58,
        0.009_618_129_107_628_477,
        0.001_333_355_814_642_844_3,
        0.000_154_035_303_933_816_1,
        0.000_015_252_733_804_059_84,
        0.000_001_321_548_679_014_43,
        0.000_000_101_780_860_092_4,
    ];
    let x = x.clamp(-1000.0, 1000.0);
    let whole = (x + ROUND) - ROUND;
    let f = x - whole;
    let series = C.iter().rev().fold(0.0, |sum, c| sum * f + c);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "from 23 to 2023"
    )]
    let scale = f64::from_bits(((whole as i64 + 1023) as u64) << 52);
    series * scale
}

#[cfg(test)]
mod tests {
    use super::exp2;

    #[test]
    fn it_agrees_with_the_library() {
        for i in -2000..2000 {
            let x = f64::from(i) * 0.137;
            let (ours, theirs) = (exp2(x), x.exp2());
            assert!(
                (ours - theirs).abs() <= 1e-9 * theirs,
                "{x}: {ours} {theirs}"
            );
        }
        assert!(exp2(-1e9) < 1e-300 && exp2(1e9) > 1e300);
    }
}
