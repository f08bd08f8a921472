//! The exact shortest path among obstacles: a taut visibility graph, made as it is needed.
//!
//! The shortest path of a disc among shapes is taut: straight pieces that touch the grown
//! obstacles, joined by arcs on their round parts. So the graph has a node for each disc and
//! direction round it, and an edge for each common tangent of two; whether a tangent is free is
//! looked up when a path over it becomes the most promising one, and remembered.
//!
//! Sources: Lozano-Perez and Wesley 1979 (visibility graphs); Liu and Arimoto 1992 (tangent graphs
//! of discs and polygons); Hart, Nilsson, Raphael 1968 (A*).

mod disc;
mod route;

use crate::{Point, Segment, ShapeId, Vector, WorldProblem, cross};
use disc::{Disc, Group, Room, SAME_ANGLE, Tangent, Turn, discs};
use pf_core::{Context, Stamp};
pub use route::{Bend, Route};
use std::{cmp::Ordering, collections::BinaryHeap};

/// The graph of a world for a robot, kept from query to query while the world stays as it is.
#[derive(Clone, Debug, Default)]
pub struct TangentGraph {
    /// The world and the robot's radius.
    of: Option<(Stamp, f64)>,
    discs: Vec<Disc>,
    /// The discs by obstacle.
    groups: Vec<Group>,
    /// By disc; unknown until asked for.
    rooms: Vec<Option<Room>>,
    /// By disc, and last for the start: what was last in the way. Often it is again.
    in_the_way: Vec<[ShapeId; 2]>,
    /// By node: disc and turn. Unknown until the node is first expanded.
    edges: Vec<Option<Vec<Edge>>>,
    /// From where the start's edges are.
    start: Option<Point>,
    start_edges: Vec<Edge>,
    labels: Vec<Label>,
    /// By node: the labels that were expanded.
    settled: Vec<Vec<u32>>,
    touched: Vec<u32>,
    open: BinaryHeap<Candidate>,
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    to: u32,
    free: Option<bool>,
    tangent: Tangent,
}

/// A way to a node.
#[derive(Clone, Copy, Debug)]
struct Label {
    node: u32,
    parent: u32,
    /// Length of the way so far.
    g: f64,
    /// Where on the disc it arrives.
    arriving: Vector,
    /// Where the parent's disc was left.
    leaving: Vector,
}

/// A way that may turn out to be blocked in its last piece.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    f: f64,
    g: f64,
    parent: u32,
    /// The edge's place in the list of the parent's node; [`TO_GOAL`] for the goal.
    edge: u32,
}

const TO_GOAL: u32 = u32::MAX;
/// Stands for the start among nodes and labels.
const START: u32 = u32::MAX;

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Candidate {}
impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
/// The least `f` is the greatest; of equal ones the furthest on its way.
impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        (other.f.total_cmp(&self.f))
            .then(self.g.total_cmp(&other.g))
            .then(other.parent.cmp(&self.parent))
            .then(other.edge.cmp(&self.edge))
    }
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
    /// it. One iteration is one way looked at.
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
        let target = Disc::point(goal);
        self.look_from(start);
        let straight = (goal - start).norm();
        self.push(straight, straight, START, TO_GOAL);
        for k in 0..self.start_edges.len() {
            let edge = self.start_edges[k];
            if edge.free != Some(false) {
                self.consider(START, k, 0.0, &edge, goal);
            }
        }
        while let Some(way) = self.open.pop() {
            if !cx.proceed() {
                return Answer::Cut;
            }
            if way.edge == TO_GOAL {
                if let Some(route) = self.arrive(problem, &target, &way) {
                    return Answer::Route(route);
                }
                continue;
            }
            let Some(label) = self.follow(problem, &way) else {
                continue;
            };
            let disc = &self.discs[label.node as usize / 2];
            let at = disc.centre + label.arriving * disc.radius;
            cx.expanded(|| at);
            self.expand(problem, &label, &target);
        }
        Answer::Nothing
    }

    /// Forgets which straight pieces are free, so that the next query takes as many iterations as
    /// if it were the first.
    pub fn forget(&mut self) {
        let edges = self.edges.iter_mut().flatten().flatten();
        for edge in edges.chain(&mut self.start_edges) {
            edge.free = None;
        }
    }

    /// How many bends a path could have: corners and round obstacles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.discs.len()
    }

    /// Whether there is nothing to bend around.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.discs.is_empty()
    }

    /// The straight pieces known to be free, for drawing.
    pub fn free_pieces(&self) -> impl Iterator<Item = Segment> + '_ {
        let lists = self.edges.iter().enumerate();
        lists.flat_map(move |(node, edges)| {
            edges
                .iter()
                .flatten()
                .filter(|edge| edge.free == Some(true))
                .map(move |edge| {
                    let to = &self.discs[edge.to as usize / 2];
                    edge.tangent.segment(&self.discs[node / 2], to)
                })
        })
    }

    /// Makes ready for a query: forgets the last one, and the world if it is another now.
    fn prepare(&mut self, problem: &WorldProblem) {
        let of = Some((problem.world().stamp(), problem.radius()));
        if self.of != of {
            self.of = of;
            self.discs.clear();
            self.groups.clear();
            for (id, shape) in problem.world().shapes() {
                let first = self.discs.len();
                discs(id, shape, problem.radius(), &mut self.discs);
                let range = first..self.discs.len();
                self.groups.extend(Group::of(&self.discs, range));
            }
            let nodes = 2 * self.discs.len();
            self.rooms.clear();
            self.rooms.resize(self.discs.len(), None);
            self.in_the_way.clear();
            self.in_the_way
                .resize(self.discs.len() + 1, [ShapeId::MAX; 2]);
            self.edges.clear();
            self.edges.resize(nodes, None);
            self.settled.iter_mut().for_each(Vec::clear);
            self.settled.resize(nodes, Vec::new());
            self.start = None;
            self.touched.clear();
        }
        for node in self.touched.drain(..) {
            self.settled[node as usize].clear();
        }
        self.labels.clear();
        self.open.clear();
    }

    fn look_from(&mut self, start: Point) {
        if self.start != Some(start) {
            self.start = Some(start);
            let from = Disc::point(start);
            self.start_edges = tangents(&self.discs, &self.groups, &from, Turn::Left).collect();
        }
    }

    fn push(&mut self, f: f64, g: f64, parent: u32, edge: u32) {
        self.open.push(Candidate { f, g, parent, edge });
    }

    /// Puts the way over an edge into the open list, its last piece unseen.
    fn consider(&mut self, parent: u32, k: usize, g: f64, edge: &Edge, goal: Point) {
        let to = &self.discs[edge.to as usize / 2];
        let contact = to.centre + edge.tangent.arriving * to.radius;
        let g = g + edge.tangent.length;
        let k = u32::try_from(k).unwrap_or(TO_GOAL);
        self.push(g + (goal - contact).norm(), g, parent, k);
    }

    /// Goes the way to its end, if it is free and better than those that were there before.
    fn follow(&mut self, problem: &WorldProblem, way: &Candidate) -> Option<Label> {
        let start;
        let (from, in_the_way, edge) = if way.parent == START {
            start = Disc::point(problem.start());
            let last = self.discs.len();
            let edge = self.start_edges.get_mut(way.edge as usize)?;
            (&start, &mut self.in_the_way[last], edge)
        } else {
            let node = self.labels[way.parent as usize].node as usize;
            let edge = self.edges[node].as_mut()?.get_mut(way.edge as usize)?;
            let disc = node / 2;
            (&self.discs[disc], &mut self.in_the_way[disc], edge)
        };
        let to = &self.discs[edge.to as usize / 2];
        let free = *edge
            .free
            .get_or_insert_with(|| is_free(problem, &edge.tangent.segment(from, to), in_the_way));
        let edge = *edge;
        let label = Label {
            node: edge.to,
            parent: way.parent,
            g: way.g,
            arriving: edge.tangent.arriving,
            leaving: edge.tangent.leaving,
        };
        let room = free && self.room(problem, edge.to).holds(label.arriving);
        (room && !self.is_dominated(&label)).then_some(label)
    }

    fn room(&mut self, problem: &WorldProblem, node: u32) -> &Room {
        let disc = node as usize / 2;
        let along = || Room::along(&self.discs[disc], problem.world(), problem.radius());
        self.rooms[disc].get_or_insert_with(along)
    }

    /// Whether somebody was there before who can go on as well: from where it came in, round to
    /// here, for no more.
    fn is_dominated(&self, label: &Label) -> bool {
        let node = label.node as usize;
        self.settled[node].iter().any(|&other| {
            let other = self.labels[other as usize];
            self.round(label.node, other.arriving, label.arriving)
                .is_some_and(|arc| other.g + arc <= label.g + 1e-12)
        })
    }

    /// How long the arc is from one contact to another on the disc of `node`, if the robot can go
    /// along it.
    fn round(&self, node: u32, from: Vector, to: Vector) -> Option<f64> {
        let (disc, turn) = (&self.discs[node as usize / 2], turn_of(node));
        if disc.cone.is_some() && turn.sign() * cross(from, to) < -SAME_ANGLE {
            return None;
        }
        let room = self.rooms[node as usize / 2].as_ref()?;
        if disc.radius <= 0.0 {
            return Some(0.0);
        }
        let angle = turn.angle(from, to);
        room.lets_pass(from, angle, turn)
            .then_some(angle * disc.radius)
    }

    fn expand(&mut self, problem: &WorldProblem, label: &Label, target: &Disc) {
        let here = u32::try_from(self.labels.len()).unwrap_or(START);
        self.labels.push(*label);
        let node = label.node as usize;
        self.settled[node].push(here);
        self.touched.push(label.node);
        let (disc, turn) = (&self.discs[node / 2], turn_of(label.node));
        if self.edges[node].is_none() {
            self.edges[node] = Some(tangents(&self.discs, &self.groups, disc, turn).collect());
        }
        if let Some(tangent) = Tangent::between(disc, turn, target, Turn::Left)
            && let Some(arc) = self.round(label.node, label.arriving, tangent.leaving)
        {
            let length = label.g + arc + tangent.length;
            self.push(length, length, here, TO_GOAL);
        }
        let edges = self.edges[node].take().unwrap_or_default();
        for (k, edge) in edges.iter().enumerate() {
            if edge.free != Some(false)
                && let Some(arc) = self.round(label.node, label.arriving, edge.tangent.leaving)
            {
                self.consider(here, k, label.g + arc, edge, problem.goal());
            }
        }
        self.edges[node] = Some(edges);
    }

    /// The last piece, if it is free, and the route behind it.
    fn arrive(&self, problem: &WorldProblem, target: &Disc, way: &Candidate) -> Option<Route> {
        let mut bends = Vec::new();
        let mut last = way.parent;
        if last == START {
            if !problem.is_free(problem.start(), problem.goal()) {
                return None;
            }
        } else {
            let label = self.labels[last as usize];
            let disc = &self.discs[label.node as usize / 2];
            let tangent = Tangent::between(disc, turn_of(label.node), target, Turn::Left)?;
            if !problem
                .world()
                .is_free(&tangent.segment(disc, target), problem.radius())
            {
                return None;
            }
            let mut leaving = tangent.leaving;
            while last != START {
                let label = self.labels[last as usize];
                let (disc, turn) = (&self.discs[label.node as usize / 2], turn_of(label.node));
                let angle = turn.angle(label.arriving, leaving);
                bends.push(Bend::new(disc, label.arriving, angle, turn));
                leaving = label.leaving;
                last = label.parent;
            }
            bends.reverse();
        }
        Some(Route {
            start: problem.start(),
            goal: problem.goal(),
            bends,
            length: way.g,
        })
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

/// All tangents that leave a disc in one direction round it.
fn tangents<'a>(
    discs: &'a [Disc],
    groups: &'a [Group],
    from: &'a Disc,
    out: Turn,
) -> impl Iterator<Item = Edge> + 'a {
    let ahead = groups
        .iter()
        .filter(move |group| group.is_ahead_of(from, out));
    let there = ahead.flat_map(|group| group.discs.clone());
    there.flat_map(move |k| {
        Turn::BOTH.into_iter().filter_map(move |into| {
            let tangent = Tangent::between(from, out, &discs[k], into)?;
            let to = u32::try_from(2 * k + usize::from(into == Turn::Right)).ok()?;
            Some(Edge {
                to,
                free: None,
                tangent,
            })
        })
    })
}
