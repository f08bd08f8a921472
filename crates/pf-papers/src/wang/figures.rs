//! The paper's figures, drawn again.

use super::{LARGE, SMALL, Trial, concave, contenders, four_discs, three_discs};
use crate::{
    PaperError,
    page::Figure,
    plot::{Series, dots},
    row::Row,
};
use pf_core::{CancelToken, Front};
use pf_moabc::Preference;
use pf_render::TeamSheet;

/// Fig. 3 to 5 and 8 to 10: the fronts of both experiments and their shortest, safest and smoothest
/// members, by our bees and their mending variant, 100,000 evaluations; and the hypervolumes of `rows`.
///
/// # Errors
/// [`PaperError`] if what the program carries is broken.
pub fn figures(rows: &[Row]) -> Result<Vec<Figure>, PaperError> {
    let mut figures = Vec::new();
    for (number, trial) in [
        ("fig3", concave()?),
        ("fig5", three_discs()?),
        ("fig8", four_discs()?),
    ] {
        for contender in contenders().into_iter().take(2) {
            let run = contender.run(&trial, LARGE, 0, &CancelToken::default())?;
            figures.extend(members(number, &trial, contender.variant, &run));
        }
    }
    figures.push(volumes(rows));
    Ok(figures)
}

/// A sheet for the shortest, the safest and the smoothest member of a front.
fn members(
    number: &str,
    trial: &Trial,
    variant: &str,
    run: &super::contenders::Run,
) -> Vec<Figure> {
    let named = |first: Preference| -> Vec<(String, usize)> {
        let others = Preference::ALL.into_iter().filter(|other| *other != first);
        let all = [first].into_iter().chain(others);
        all.filter_map(|one| Some((one.word().to_owned(), one.choose(&run.front)?)))
            .collect()
    };
    let (plans, costs) = (
        Front::unchecked(run.plans.clone()),
        Front::unchecked(run.front.clone()),
    );
    let wanted = [Preference::Length, Preference::Safety, Preference::Smooth];
    let sheet = |preference: Preference| {
        let title = format!(
            "{}, {variant}: the best of {} plans for {preference}",
            trial.name,
            run.front.len()
        );
        let svg = TeamSheet {
            problem: &trial.problem,
            plans: &plans,
            costs: &costs,
            named: &named(preference),
            title: &title,
        };
        Figure {
            name: format!("{number}-{}-{variant}-{preference}", trial.name),
            svg: svg.svg(),
            title,
        }
    };
    wanted.map(sheet).into_iter().collect()
}

/// The median hypervolume of every contender, case by case.
fn volumes(rows: &[Row]) -> Figure {
    let mut cases: Vec<&str> = Vec::new();
    for row in rows
        .iter()
        .filter(|row| row.case.ends_with(&SMALL.to_string()))
    {
        if !cases.contains(&row.case.as_str()) {
            cases.push(&row.case);
        }
    }
    let series = contenders().map(|contender| {
        let of = |(i, case): (u32, &&str)| {
            let own = rows.iter().find(|row| {
                row.case == **case
                    && row.planner == contender.planner
                    && row.variant == contender.variant
            });
            Some([f64::from(i), own?.measured.number("hypervolume")?])
        };
        Series {
            name: format!("{} {}", contender.planner, contender.variant),
            points: (0..).zip(&cases).filter_map(of).collect(),
        }
    });
    let name = |case: &&str| {
        case.trim_end_matches(&SMALL.to_string())
            .trim_end()
            .to_owned()
    };
    let names: Vec<_> = cases.iter().map(name).collect();
    let title = "Hypervolume after 20,000 evaluations, median, problem by problem";
    Figure {
        name: "hypervolume".into(),
        title: title.into(),
        svg: dots(title, "hypervolume", &names, &series),
    }
}
