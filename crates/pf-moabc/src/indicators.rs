//! How good a front is, in one number. Every objective is to be small.
//!
//! ```
//! use pf_moabc::indicators::hypervolume;
//! let front = [[1.0, 3.0], [2.0, 2.0], [3.0, 1.0]];
//! assert_eq!(hypervolume(&front, &[4.0, 4.0]), 6.0);
//! ```

/// The volume that the front dominates and the reference point bounds, exactly. Points that do not
/// beat the reference in every objective add nothing, nor do dominated ones and those that are not
/// numbers.
///
/// Sweeps with a staircase for up to three objectives, slices of fewer objectives beyond (Zitzler and
/// Thiele 1998; While et al. 2006): O(n log n) for two, O(n^2) for three, a factor n for each more.
#[must_use]
pub fn hypervolume<const N: usize>(front: &[[f64; N]], reference: &[f64; N]) -> f64 {
    let inside = front
        .iter()
        .filter(|point| (0..N).all(|k| point[k] < reference[k]));
    let mut points: Vec<&[f64]> = inside.map(<[f64; N]>::as_slice).collect();
    volume(&mut points, reference)
}

/// The same for points all of which beat the reference, in the first of their coordinates.
fn volume(points: &mut [&[f64]], reference: &[f64]) -> f64 {
    let last = match reference.len() {
        0 => return 0.0,
        1 => {
            let least = points.iter().fold(reference[0], |least, p| least.min(p[0]));
            return reference[0] - least;
        }
        2 => return area(points, reference),
        n => n - 1,
    };
    points.sort_unstable_by(|a, b| a[last].total_cmp(&b[last]));
    if last == 2 {
        return sweep(points, reference);
    }
    let mut sum = 0.0;
    let mut slice: Vec<&[f64]> = Vec::new();
    for (i, point) in points.iter().enumerate() {
        slice.push(point);
        let next = points.get(i + 1).map_or(reference[last], |next| next[last]);
        if next > point[last] {
            sum += volume(&mut slice, &reference[..last]) * (next - point[last]);
        }
    }
    sum
}

fn area(points: &mut [&[f64]], reference: &[f64]) -> f64 {
    points.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let (mut sum, mut lowest) = (0.0, reference[1]);
    for point in points.iter() {
        if point[1] < lowest {
            sum += (reference[0] - point[0]) * (lowest - point[1]);
            lowest = point[1];
        }
    }
    sum
}

/// Three objectives, the points in the order of the third: the stairs of the first two grow, and
/// their area with them.
fn sweep(points: &[&[f64]], reference: &[f64]) -> f64 {
    let mut stairs: Vec<[f64; 2]> = Vec::new();
    let (mut sum, mut covered) = (0.0, 0.0);
    for (i, point) in points.iter().enumerate() {
        let (x, y) = (point[0], point[1]);
        let before = stairs.partition_point(|step| step[0] <= x);
        let mut height = match before {
            0 => reference[1],
            before => stairs[before - 1][1],
        };
        if y < height {
            let from = stairs.partition_point(|step| step[0] < x);
            let beaten = stairs[from..]
                .iter()
                .take_while(|step| step[1] >= y)
                .count();
            let mut left = x;
            for step in &stairs[from..from + beaten] {
                covered += (step[0] - left) * (height - y).max(0.0);
                (left, height) = (step[0], step[1]);
            }
            let right = stairs
                .get(from + beaten)
                .map_or(reference[0], |step| step[0]);
            covered += (right - left) * (height - y).max(0.0);
            stairs.splice(from..from + beaten, [[x, y]]);
        }
        let next = points.get(i + 1).map_or(reference[2], |next| next[2]);
        sum += covered * (next - point[2]);
    }
    sum
}

/// How far the points of a reference front are from the front, on average: for each the least
/// distance, counting only what the front is worse by (Ishibuchi et al. 2015). Infinite for an empty
/// front; 0 for an empty reference.
#[must_use]
pub fn igd_plus<const N: usize>(front: &[[f64; N]], reference: &[[f64; N]]) -> f64 {
    let worse = |own: &[f64; N], wanted: &[f64; N]| -> f64 {
        let parts = own.iter().zip(wanted).map(|(a, b)| (a - b).max(0.0));
        parts.map(|part| part * part).sum::<f64>().sqrt()
    };
    let least = |wanted: &[f64; N]| {
        let all = front.iter().map(|own| worse(own, wanted));
        all.fold(f64::INFINITY, f64::min)
    };
    average(reference.iter().map(least))
}

/// By how much the front must be shifted in every objective to weakly dominate a reference front:
/// the additive epsilon indicator (Zitzler et al. 2003). Infinite for an empty front.
#[must_use]
pub fn additive_epsilon<const N: usize>(front: &[[f64; N]], reference: &[[f64; N]]) -> f64 {
    let shift = |own: &[f64; N], wanted: &[f64; N]| {
        let parts = own.iter().zip(wanted).map(|(a, b)| a - b);
        parts.fold(f64::NEG_INFINITY, f64::max)
    };
    let least = |wanted: &[f64; N]| {
        let all = front.iter().map(|own| shift(own, wanted));
        all.fold(f64::INFINITY, f64::min)
    };
    reference
        .iter()
        .map(least)
        .fold(f64::NEG_INFINITY, f64::max)
}

/// How unevenly the members lie: the standard deviation of the distances to the next one, in the
/// sum of the differences (Schott 1995). 0 for fewer than three.
#[must_use]
pub fn spacing<const N: usize>(front: &[[f64; N]]) -> f64 {
    let gap = |i: usize| {
        let others = front.iter().enumerate().filter(|(j, _)| *j != i);
        let far = |other: &[f64; N]| -> f64 {
            front[i].iter().zip(other).map(|(a, b)| (a - b).abs()).sum()
        };
        others
            .map(|(_, other)| far(other))
            .fold(f64::INFINITY, f64::min)
    };
    if front.len() < 3 {
        return 0.0;
    }
    let gaps: Vec<f64> = (0..front.len()).map(gap).collect();
    let mean = average(gaps.iter().copied());
    #[expect(clippy::cast_precision_loss, reason = "a number of members")]
    let others = (gaps.len() - 1) as f64;
    let squares = gaps.iter().map(|gap| (gap - mean) * (gap - mean));
    (squares.sum::<f64>() / others).sqrt()
}

/// The paper's breadth (Wang et al., eq. 12): the root of the sum of the objectives' ranges.
///
/// It adds up units that have nothing to do with each other, does not square what it takes the root
/// of, and one outlier makes it large: no measure of quality, and here for comparison alone.
#[must_use]
pub fn breadth<const N: usize>(front: &[[f64; N]]) -> f64 {
    let range = |k: usize| {
        let values = front.iter().map(|point| point[k]);
        let most = values.clone().fold(f64::NEG_INFINITY, f64::max);
        (most - values.fold(f64::INFINITY, f64::min)).max(0.0)
    };
    (0..N).map(range).sum::<f64>().sqrt()
}

/// The paper's error rate (Wang et al., eq. 11): the share of the members that do not lie on the
/// true front.
///
/// Nobody knows the true front; where it is the union of all runs, this says of a front which runs
/// it was compared with, and a member a hair behind counts as one far off.
#[must_use]
pub fn error_rate<const N: usize>(front: &[[f64; N]], truth: &[[f64; N]]) -> f64 {
    let on_it = |point: &&[f64; N]| {
        let equal = |other: &[f64; N]| (0..N).all(|k| point[k].total_cmp(&other[k]).is_eq());
        truth.iter().any(equal)
    };
    let off = front
        .iter()
        .map(|point| if on_it(&point) { 0.0 } else { 1.0 });
    average(off)
}

/// 0 of nothing.
fn average(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0.0, 0.0), |(count, sum), value| (count + 1.0, sum + value));
    if count > 0.0 { sum / count } else { 0.0 }
}
