//! The critical-difference diagram.
//!
//! Source: Demsar, *Statistical Comparisons of Classifiers over Multiple Data Sets*, 2006, figure 1.

use super::{
    Figure,
    chart::{Area, Drawn, FONT, colour, fitted, label, sheet},
    data::Data,
    tables::Ranking,
};
use crate::SuiteError;
use plotters::{prelude::*, style::text_anchor::HPos};

const LEFT: f64 = 260.0;
const RIGHT: f64 = 600.0;
const AXIS: i32 = 70;
const ROW: i32 = 24;
const BAR: i32 = 9;

pub(crate) fn figure(data: &Data<'_>, ranking: &Ranking) -> Result<Figure, SuiteError> {
    let groups = groups(&ranking.order, ranking.critical);
    let count = |n: usize| i32::try_from(n).unwrap_or(i32::MAX / 64);
    let rows = count(ranking.order.len().div_ceil(2));
    let below = AXIS + 16 + BAR * count(groups.len());
    let height = u32::try_from(below + ROW * rows + 16).unwrap_or(400);
    let svg = sheet(height, |area| {
        axis(area, ranking)?;
        names(area, data, ranking, below)?;
        for (k, (first, last)) in groups.iter().enumerate() {
            let y = AXIS + 12 + BAR * count(k);
            let ends = [first, last].map(|&place| across(ranking, ranking.order[place].1));
            let bar = vec![(ends[0] - 4, y), (ends[1] + 4, y)];
            area.draw(&PathElement::new(bar, BLACK.stroke_width(4)))?;
        }
        Ok(())
    })?;
    Ok(Figure {
        name: "critical-difference".to_owned(),
        title: "Critical differences".to_owned(),
        words: format!(
            "Mean ranks over {} problems, the best on the left. Contenders under one bar do not differ at \
             5 % (Nemenyi): their ranks are less than CD = {:.2} apart.",
            ranking.problems, ranking.critical
        ),
        svg,
    })
}

/// Contenders in a row that do not differ, as places of the first and the last: none inside another.
fn groups(order: &[(usize, f64)], critical: f64) -> Vec<(usize, usize)> {
    let mut groups: Vec<(usize, usize)> = Vec::new();
    for first in 0..order.len() {
        let near = |(_, rank): &&(usize, f64)| rank - order[first].1 < critical;
        let last = first + order[first..].iter().take_while(near).count() - 1;
        if last > first && groups.last().is_none_or(|group| last > group.1) {
            groups.push((first, last));
        }
    }
    groups
}

#[expect(clippy::cast_possible_truncation, reason = "pixels of a sheet")]
fn pixel(x: f64) -> i32 {
    x.round() as i32
}

/// Where a rank is.
#[expect(clippy::cast_precision_loss, reason = "a number of contenders")]
fn across(ranking: &Ranking, rank: f64) -> i32 {
    let last = (ranking.order.len() as f64).max(2.0);
    pixel(LEFT + (rank - 1.0) / (last - 1.0) * (RIGHT - LEFT))
}

fn axis(area: &Area<'_>, ranking: &Ranking) -> Drawn {
    let last = u32::try_from(ranking.order.len()).unwrap_or(u32::MAX);
    let line = |points: Vec<(i32, i32)>, width| PathElement::new(points, BLACK.stroke_width(width));
    let ends = [1, last].map(|rank| across(ranking, f64::from(rank)));
    area.draw(&line(vec![(ends[0], AXIS), (ends[1], AXIS)], 1))?;
    for rank in 1..=last {
        let x = across(ranking, f64::from(rank));
        area.draw(&line(vec![(x, AXIS - 6), (x, AXIS)], 1))?;
        let words = rank.to_string();
        let wide = pixel(4.0 * f64::from(u32::try_from(words.len()).unwrap_or(1)));
        area.draw(&Text::new(words, (x - wide, AXIS - 22), (FONT, 13)))?;
    }
    let cd = across(ranking, 1.0 + ranking.critical);
    let y = 22;
    area.draw(&line(vec![(ends[0], y), (cd, y)], 2))?;
    for x in [ends[0], cd] {
        area.draw(&line(vec![(x, y - 5), (x, y + 5)], 2))?;
    }
    let words = format!("CD = {:.2}", ranking.critical);
    area.draw(&Text::new(words, (cd + 10, y - 7), (FONT, 13)))?;
    Ok(())
}

/// The better half on the left, the others on the right, each with a line to its rank.
fn names(area: &Area<'_>, data: &Data<'_>, ranking: &Ranking, below: i32) -> Drawn {
    let half = ranking.order.len().div_ceil(2);
    for (place, &(contender, rank)) in ranking.order.iter().enumerate() {
        let x = across(ranking, rank);
        let left = place < half;
        let row = if left {
            place
        } else {
            ranking.order.len() - 1 - place
        };
        let y = below + ROW * i32::try_from(row).unwrap_or(0) + 6;
        let end = if left {
            pixel(LEFT) - 14
        } else {
            pixel(RIGHT) + 14
        };
        let stroke = colour(contender).stroke_width(2);
        area.draw(&PathElement::new(vec![(x, AXIS), (x, y), (end, y)], stroke))?;
        let name = format!("{} ({rank:.2})", fitted(&data.contenders[contender]));
        let (at, side) = if left {
            (end - 6, HPos::Right)
        } else {
            (end + 6, HPos::Left)
        };
        area.draw(&label(name, (at, y), side))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_join_neighbours_and_are_not_inside_each_other() {
        let order: Vec<_> = [1.0, 1.5, 2.2, 4.0, 4.1].into_iter().enumerate().collect();
        assert_eq!(groups(&order, 1.0), [(0, 1), (1, 2), (3, 4)]);
        assert_eq!(groups(&order, 0.05), []);
        assert_eq!(groups(&order, 10.0), [(0, 4)]);
    }
}
