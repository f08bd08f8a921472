//! The exact shortest path among shapes, by a visibility graph made as it is needed.

use pf_core::{
    Claims, Context, InvalidParams, Outcome, Planner, Problem, Proof, Replanner, Report, Revision,
    Unsupported, params,
};
use pf_geom::{Answer, Route, TangentGraph, WorldProblem};

/// How a [`VisibilityGraph`] hands out its path.
#[derive(Clone, Debug, PartialEq)]
pub struct VisibilityGraphParams {
    /// How much longer than the shortest path the polyline may be for its arcs being cut into
    /// pieces, in the world's unit.
    pub excess: f64,
}

impl Default for VisibilityGraphParams {
    fn default() -> Self {
        Self { excess: 1e-4 }
    }
}

params!(VisibilityGraphParams {
    excess: f64 = "how much longer the polyline may be than the shortest path with its arcs",
});

/// The shortest path of a round robot among shapes: straight pieces and arcs, exact but for the
/// arcs' being cut into pieces outside them ([`VisibilityGraphParams::excess`]).
///
/// What is learnt of a world is kept while the world stays as it is, so another start or goal in
/// it is answered faster; a changed world is learnt anew. One iteration is one way looked at.
///
/// Sources: Lozano-Perez and Wesley 1979; Liu and Arimoto 1992 (tangent graphs); see
/// [`pf_geom::TangentGraph`].
///
/// ```
/// use pf_classic::VisibilityGraph;
/// use pf_core::{Context, Planner};
/// use pf_geom::{Circle, Point, Rectangle, World, WorldProblem};
///
/// let bounds = Rectangle::new(Point::new(-5.0, -5.0), Point::new(5.0, 5.0)).unwrap();
/// let circle = Circle::new(Point::origin(), 1.0).unwrap();
/// let world = World::with_shapes(bounds, [circle.into()]);
/// let (start, goal) = (Point::new(-2.0, 0.0), Point::new(2.0, 0.0));
/// let problem = WorldProblem::new(world, 0.0, start, goal).unwrap();
///
/// let report = VisibilityGraph::default().plan(&problem, &mut Context::seeded(0)).unwrap();
/// let length = report.outcome.solved().unwrap().cost;
/// let exact = 2.0 * 3f64.sqrt() + std::f64::consts::FRAC_PI_3;
/// assert!(exact <= length && length <= exact + 1e-4);
/// ```
#[derive(Clone, Debug, Default)]
pub struct VisibilityGraph {
    params: VisibilityGraphParams,
    graph: TangentGraph,
}

impl VisibilityGraph {
    /// A planner that hands out its path as `params` say.
    ///
    /// # Errors
    /// [`InvalidParams`] if the excess is not a positive number.
    pub fn new(params: VisibilityGraphParams) -> Result<Self, InvalidParams> {
        if !(params.excess > 0.0 && params.excess.is_finite()) {
            let value = params.excess.to_string();
            return Err(InvalidParams::bad("excess", &value, "a positive number"));
        }
        Ok(Self {
            params,
            graph: TangentGraph::default(),
        })
    }

    /// The graph as far as it is known, for drawing.
    #[must_use]
    pub fn graph(&self) -> &TangentGraph {
        &self.graph
    }

    fn answer(
        &mut self,
        problem: &WorldProblem,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Report<WorldProblem> {
        let answer = self.graph.shortest(problem, cx);
        if cx.listening() {
            for piece in self.graph.free_pieces() {
                cx.points("free piece", || vec![piece.a, piece.b]);
            }
        }
        match answer {
            Answer::Route(route) => {
                let path = self.flattened(problem, &route);
                cx.answer(problem, path, Proof::Optimal)
            }
            Answer::Nothing => cx.report(Outcome::Infeasible),
            Answer::Cut => cx.report(Outcome::Unknown { attempt: None }),
        }
    }

    /// The route as a polyline that keeps clear: where a piece outside an arc would touch
    /// something else, the pieces are made smaller.
    fn flattened(&self, problem: &WorldProblem, route: &Route) -> Vec<pf_geom::Point> {
        let mut excess = self.params.excess;
        loop {
            let path = route.flattened(excess);
            if excess < self.params.excess * 1e-9 || problem.judge(&path).is_ok() {
                return path;
            }
            excess /= 8.0;
        }
    }
}

impl Planner<WorldProblem> for VisibilityGraph {
    fn name(&self) -> &'static str {
        "visibility graph"
    }

    fn claims(&self) -> Claims {
        Claims::NONE.complete().optimal().deterministic()
    }

    fn plan(
        &mut self,
        problem: &WorldProblem,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Result<Report<WorldProblem>, Unsupported> {
        self.graph.forget();
        Ok(self.answer(problem, cx))
    }
}

/// The graph is kept by the world's stamp, so a revision needs no looking into.
impl Replanner<WorldProblem> for VisibilityGraph {
    fn replan(
        &mut self,
        revision: &Revision<'_, WorldProblem>,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Result<Report<WorldProblem>, Unsupported> {
        Ok(self.answer(revision.problem(), cx))
    }
}
