use crate::{Changes, Scene};
use pf_core::{InvalidProblem, Note, Problem, Solved};
use pf_geom::Raster;

/// A scene as a problem of one kind.
///
/// A scene of another kind is cautiously converted: a solution holds, for the scene's own judge
/// marks it; a proof does not, so what is optimal or infeasible here is feasible or unknown there
/// ([`Outcome::converted`](pf_core::Outcome::converted)).
#[derive(Debug)]
pub struct Posed<P: Problem> {
    /// What the planner is asked.
    pub problem: P,
    /// How it came to be, if it is not the scene itself.
    pub conversion: Option<Conversion>,
}

/// How a scene became a problem of another kind.
#[derive(Debug)]
pub enum Conversion {
    /// A world became cells.
    Cells(Box<Raster>),
    /// A grid became a world with so many rectangles.
    Shapes(usize),
}

impl<P: Problem> Posed<P> {
    pub(crate) fn exactly(problem: P) -> Self {
        Self {
            problem,
            conversion: None,
        }
    }
}

/// Points in the map's units: in a world its own; on a grid column and row of a cell, or between
/// them.
pub type Line = Vec<[f64; 2]>;

/// A solution of a problem, read as one of the scene it was made of.
#[derive(Clone, Debug)]
pub struct Found {
    /// A number per objective.
    pub costs: Vec<f64>,
    /// A line per robot or alternative.
    pub lines: Vec<Line>,
}

/// A problem that can be read out of a scene, and whose answers can be shown.
pub trait FromScene: Problem {
    /// Its name: `grid`, `world`.
    const KIND: &'static str;

    /// The problem that the scene poses.
    ///
    /// # Errors
    /// [`InvalidProblem`] if the scene makes no sense as such a problem.
    fn pose(scene: &Scene) -> Result<Posed<Self>, InvalidProblem>;

    /// What happened in the scene, which now is as given, as changes of the problem.
    ///
    /// # Errors
    /// [`InvalidProblem`] if the scene makes no sense any more as such a problem.
    fn follow(
        posed: &mut Posed<Self>,
        scene: &Scene,
        changes: &Changes,
    ) -> Result<Vec<Self::Change>, InvalidProblem>;

    /// A solution as one of the scene; `None` if the scene does not accept it.
    fn read(posed: &Posed<Self>, scene: &Scene, solved: &Solved<Self>) -> Option<Found>;

    /// A planner's note in the scene's units.
    #[must_use]
    fn reword(_posed: &Posed<Self>, note: Note) -> Note {
        note
    }
}
