//! A simple polygon as few convex ones: ears are cut off, then joined where the whole stays convex
//! (Hertel and Mehlhorn 1983).

use pf_geom::{Point, cross};

/// Convex polygons, counterclockwise, that make up one that is simple and counterclockwise.
pub(super) fn convex_parts(corners: &[Point]) -> Vec<Vec<Point>> {
    let mut parts: Vec<Vec<usize>> = Vec::new();
    let mut left: Vec<usize> = (0..corners.len()).collect();
    while left.len() > 3 {
        let n = left.len();
        let ear = |k: usize| [left[(k + n - 1) % n], left[k], left[(k + 1) % n]];
        let cut = (0..n).find(|&k| is_ear(corners, &left, ear(k)));
        // By rounding there may seem to be none; then the flattest corner goes.
        let cut = cut.unwrap_or_else(|| {
            let area = |k: &usize| turn(corners, ear(*k)).abs();
            (0..n)
                .min_by(|a, b| area(a).total_cmp(&area(b)))
                .unwrap_or(0)
        });
        let triangle = ear(cut);
        if turn(corners, triangle) > 0.0 {
            parts.push(triangle.to_vec());
        }
        left.remove(cut);
    }
    parts.push(left);
    join(corners, &mut parts);
    let placed = |part: Vec<usize>| part.into_iter().map(|k| corners[k]).collect();
    parts.into_iter().map(placed).collect()
}

fn turn(corners: &[Point], [a, b, c]: [usize; 3]) -> f64 {
    cross(corners[b] - corners[a], corners[c] - corners[b])
}

fn is_ear(corners: &[Point], left: &[usize], ear @ [a, b, c]: [usize; 3]) -> bool {
    let inside = |p: usize| {
        [[a, b], [b, c], [c, a]]
            .iter()
            .all(|[from, to]| turn(corners, [*from, *to, p]) >= 0.0)
    };
    turn(corners, ear) > 0.0 && !left.iter().any(|&p| !ear.contains(&p) && inside(p))
}

/// Joins parts with a common side as long as any two make a convex one.
fn join(corners: &[Point], parts: &mut Vec<Vec<usize>>) {
    let mut one = 0;
    while one < parts.len() {
        let joined = (one + 1..parts.len())
            .find_map(|other| Some((other, together(corners, &parts[one], &parts[other])?)));
        match joined {
            Some((other, whole)) => {
                parts[one] = whole;
                parts.swap_remove(other);
            }
            None => one += 1,
        }
    }
}

/// Two convex polygons with a common side as one, if that is convex.
fn together(corners: &[Point], one: &[usize], other: &[usize]) -> Option<Vec<usize>> {
    let (n, m) = (one.len(), other.len());
    for i in 0..n {
        let (from, to) = (one[i], one[(i + 1) % n]);
        let Some(j) = (0..m).find(|&j| other[j] == to && other[(j + 1) % m] == from) else {
            continue;
        };
        // Round the one from `to` to `from`, then round the other from there.
        let first = (0..n).map(|k| one[(i + 1 + k) % n]);
        let rest = (1..m - 1).map(|k| other[(j + 1 + k) % m]);
        let whole: Vec<usize> = first.chain(rest).collect();
        let count = whole.len();
        let at = |k: usize| [whole[k], whole[(k + 1) % count], whole[(k + 2) % count]];
        return (0..count)
            .all(|k| turn(corners, at(k)) >= 0.0)
            .then_some(whole);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: &[Point]) -> f64 {
        let n = corners.len();
        let sum = |k: usize| cross(corners[k].coords, corners[(k + 1) % n].coords);
        (0..n).map(sum).sum::<f64>() / 2.0
    }

    #[test]
    fn parts_are_convex_and_make_up_the_whole() {
        let u = [
            (0., 0.),
            (6., 0.),
            (6., 5.),
            (4., 5.),
            (4., 2.),
            (2., 2.),
            (2., 5.),
            (0., 5.),
        ];
        let star = [
            (0., 0.),
            (4., 1.),
            (8., 0.),
            (7., 4.),
            (8., 8.),
            (4., 7.),
            (0., 8.),
            (1., 4.),
        ];
        for corners in [&u[..], &star[..]] {
            let corners: Vec<_> = corners.iter().map(|&(x, y)| Point::new(x, y)).collect();
            let parts = convex_parts(&corners);
            let total: f64 = parts.iter().map(|part| area(part)).sum();
            assert!((total - area(&corners)).abs() < 1e-12);
            assert!(parts.len() <= 5, "{}", parts.len());
            for part in &parts {
                let n = part.len();
                let order: Vec<usize> = (0..n).collect();
                assert!((0..n).all(|k| turn(part, [order[k], (k + 1) % n, (k + 2) % n]) >= 0.0));
            }
        }
    }
}
