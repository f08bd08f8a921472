//! The exact shortest path among obstacles: a taut visibility graph, made as it is needed.
//!
//! The shortest path of a disc among shapes is taut: straight pieces that touch the grown
//! obstacles, joined by arcs on their round parts. So the graph has a node for each disc and
//! direction round it, and an edge for each common tangent of two; whether a tangent is free is
//! looked up when a path over it becomes the most promising one, and remembered.
//!
//! The ways from one end, the root, are kept as well: how long they are does not depend on where
//! they lead in the end, so while the root stays, another end only goes on where the last stopped.
//!
//! Sources: Lozano-Perez and Wesley 1979 (visibility graphs); Liu and Arimoto 1992 (tangent graphs
//! of discs and polygons); Hart, Nilsson, Raphael 1968 (A*); Sun, Yeoh,
//! Koenig 2009 (keeping the tree of A* when the goal moves).

mod disc;
mod route;
mod search;
mod tree;

use crate::{Point, Segment, ShapeId, WorldProblem};
use disc::{Disc, Group, Room, SAME_ANGLE, Tangent, Turn, discs};
use pf_core::{Context, Stamp};
pub use route::{Bend, Route};
use std::{collections::BinaryHeap, ops::Range};
use tree::{Candidate, Label, Next, Tree, Way};

/// The graph of a world for a robot, kept from query to query while the world stays as it is.
#[derive(Clone, Debug, Default)]
pub struct TangentGraph {
    /// The world and the robot's radius.
    of: Option<(Stamp, f64)>,
    /// The last is the root's, a point.
    discs: Vec<Disc>,
    /// The discs by obstacle.
    groups: Vec<Group>,
    /// By disc; unknown until asked for.
    rooms: Vec<Option<Room>>,
    /// By disc: what was last in the way. Often it is again.
    in_the_way: Vec<[ShapeId; 2]>,
    /// By node, disc and turn: where its row of `fans` begins; none until it is first expanded.
    rows: Vec<Option<u32>>,
    /// By row and group: which `edges` lead there; unknown until asked for.
    fans: Vec<Option<(u32, u32)>>,
    edges: Vec<Edge>,
    /// How many of them lead from roots that are no more.
    stale: usize,
    /// The goal last asked for.
    last_goal: Option<Point>,
    tree: Tree,
    /// By group: how far its middle is from the end asked for.
    to_end: Vec<f64>,
    open: BinaryHeap<Candidate>,
    /// Labels seen before anything was pushed behind them.
    reached: Vec<u32>,
    /// For the next route.
    spare: Vec<Bend>,
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    from: u32,
    to: u32,
    free: Option<bool>,
    tangent: Tangent,
}

/// What a query came to.
#[derive(Clone, Debug)]
pub enum Answer {
    /// The shortest path.
    Route(Route),
    /// Proof that there is none.
    Nothing,
    /// The caller wanted no more.
    Cut,
}

impl TangentGraph {
    /// The shortest path of a problem. What is learnt of the world is kept for the next query in
    /// it, and the ways from one end for the next query that has this end. One iteration is one way
    /// looked at.
    pub fn shortest(
        &mut self,
        problem: &WorldProblem,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Answer {
        self.prepare(problem);
        let (start, goal) = (problem.start(), problem.goal());
        if !problem.is_free(start, start) || !problem.is_free(goal, goal) {
            return Answer::Nothing;
        }
        let backwards = self.grows_from_goal(start, goal);
        self.last_goal = Some(goal);
        let (root, end) = if backwards {
            (goal, start)
        } else {
            (start, goal)
        };
        self.look_from(root);
        match self.search(problem, &Disc::point(end), cx) {
            Answer::Route(route) if backwards => Answer::Route(route.reversed()),
            answer => answer,
        }
    }

    /// Takes back the memory of a route that nobody needs any more: the next one will use it.
    pub fn reclaim(&mut self, route: Route) {
        self.spare = route.bends;
    }

    /// Forgets the ways and which straight pieces are free, so that the next query takes as many
    /// iterations as if it were the first.
    pub fn forget(&mut self) {
        self.tree.clear();
        for edge in &mut self.edges {
            edge.free = None;
        }
    }

    /// How many bends a path could have: corners and round obstacles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.discs.len().saturating_sub(1)
    }

    /// Whether there is nothing to bend around.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The straight pieces known to be free, for drawing.
    pub fn free_pieces(&self) -> impl Iterator<Item = Segment> + '_ {
        let rows = self.rows.iter().flatten();
        let fans = rows.flat_map(|&row| &self.fans[row as usize..][..self.groups.len()]);
        let edges = fans
            .flatten()
            .flat_map(|&(first, last)| &self.edges[first as usize..last as usize]);
        edges.filter(|edge| edge.free == Some(true)).map(|edge| {
            let (from, to) = (edge.from as usize / 2, edge.to as usize / 2);
            edge.tangent.segment(&self.discs[from], &self.discs[to])
        })
    }

    /// Forgets the world if it is another now.
    fn prepare(&mut self, problem: &WorldProblem) {
        let of = Some((problem.world().stamp(), problem.radius()));
        if self.of == of {
            return;
        }
        self.of = of;
        self.discs.clear();
        self.groups.clear();
        for (id, shape) in problem.world().shapes() {
            let first = self.discs.len();
            discs(id, shape, problem.radius(), &mut self.discs);
            let range = first..self.discs.len();
            self.groups.extend(Group::of(&self.discs, range));
        }
        self.discs.push(Disc::point(problem.start()));
        let discs = self.discs.len();
        self.rooms.clear();
        self.rooms.resize(discs, None);
        self.rooms[discs - 1] = Some(Room::All);
        self.in_the_way.clear();
        self.in_the_way.resize(discs, [ShapeId::MAX; 2]);
        self.forget_edges();
        self.tree.fit(2 * discs, self.groups.len());
    }

    /// Whether the ways are to begin at the goal: at the end that is kept, if one is.
    fn grows_from_goal(&self, start: Point, goal: Point) -> bool {
        match self.tree.root() {
            Some(root) if root == start => false,
            Some(root) => root == goal || self.last_goal == Some(goal),
            None => false,
        }
    }

    /// Makes `root` the end from which ways are kept.
    fn look_from(&mut self, root: Point) {
        if self.tree.root() == Some(root) {
            return;
        }
        let last = self.discs.len() - 1;
        let node = node_of(last, Turn::Left);
        if let Some(row) = self.rows[node as usize] {
            let fans = &mut self.fans[row as usize..][..self.groups.len()];
            let edges = |fan: &Option<(u32, u32)>| fan.map_or(0, |(first, last)| last - first);
            self.stale += fans.iter().map(|fan| edges(fan) as usize).sum::<usize>();
            fans.fill(None);
        }
        if 2 * self.stale > self.edges.len() {
            self.forget_edges();
        }
        self.discs[last] = Disc::point(root);
        self.in_the_way[last] = [ShapeId::MAX; 2];
        self.tree.clear();
        self.settle(Label::root(node, root));
    }

    fn forget_edges(&mut self) {
        self.stale = 0;
        self.edges.clear();
        self.fans.clear();
        self.rows.clear();
        self.rows.resize(2 * self.discs.len(), None);
    }
}

/// Whether the robot can go along a piece; what was in the way last is looked at first.
fn is_free(problem: &WorldProblem, piece: &Segment, in_the_way: &mut [ShapeId; 2]) -> bool {
    let (world, radius) = (problem.world(), problem.radius());
    let again = |&id: &ShapeId| world.shape(id).is_some_and(|s| s.blocks(piece, radius));
    if in_the_way.iter().any(again) {
        return false;
    }
    if let Some(id) = world.blocker(piece, radius) {
        *in_the_way = [id, in_the_way[0]];
        return false;
    }
    world.is_within_bounds(piece)
}

fn turn_of(node: u32) -> Turn {
    Turn::BOTH[node as usize % 2]
}

fn node_of(disc: usize, turn: Turn) -> u32 {
    index(2 * disc + usize::from(turn == Turn::Right))
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "as many of anything fit no memory"
)]
fn index(k: usize) -> u32 {
    k as u32
}

/// The tangents from a node to some of the discs.
fn tangents(discs: &[Disc], node: u32, to: Range<usize>) -> impl Iterator<Item = Edge> + '_ {
    let (from, out) = (&discs[node as usize / 2], turn_of(node));
    to.flat_map(move |k| {
        Turn::BOTH.into_iter().filter_map(move |into| {
            let tangent = Tangent::between(from, out, &discs[k], into)?;
            Some(Edge {
                from: node,
                to: node_of(k, into),
                free: None,
                tangent,
            })
        })
    })
}
