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
mod tree;

use crate::{Point, Segment, ShapeId, Vector, WorldProblem, cross};
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
}

/// What a search is after.
struct Aim {
    end: Point,
    /// Only paths shorter than this are of interest.
    bound: f64,
    /// How much longer than the best hope a path may be for its obstacles to be opened at once.
    step: f64,
}

impl Aim {
    fn through(&self, g: f64, at: Point) -> f64 {
        g + (self.end - at).norm()
    }
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    from: u32,
    to: u32,
    free: Option<bool>,
    tangent: Tangent,
}

/// How many last pieces are tried before the search, for a bound on what it may cost.
const TRIALS: u32 = 24;
/// [`Aim::step`] as a share of the straight line.
const STEP: f64 = 0.02;

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

    fn search(
        &mut self,
        problem: &WorldProblem,
        target: &Disc,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Answer {
        let end = target.centre;
        self.to_end.clear();
        let to_end = |group: &Group| (end - group.centre).norm();
        self.to_end.extend(self.groups.iter().map(to_end));
        let mut aim = Aim {
            end,
            bound: f64::INFINITY,
            step: STEP * (end - self.tree.labels[0].at).norm(),
        };
        self.open.clear();
        for (k, label) in (0..).zip(&self.tree.labels) {
            let f = aim.through(label.g, label.at);
            self.open.push(Candidate::new(f, Next::Label(k)));
        }
        // First by ways that are known: nothing longer is of interest then.
        let mut best = None;
        let mut reached = Vec::new();
        let mut trials = 0;
        while best.is_none()
            && trials < TRIALS
            && let Some(candidate) = self.open.pop()
        {
            match candidate.next {
                Next::Label(label) => {
                    reached.push(label);
                    self.try_end(label, target, &aim);
                }
                Next::End(label) => {
                    if !cx.proceed() {
                        return Answer::Cut;
                    }
                    trials += 1;
                    if self.is_last_piece_free(problem, label, target) {
                        best = Some((candidate.f, label));
                    }
                }
                Next::Ways(_) | Next::Group(_) | Next::Way(_) => {}
            }
        }
        if let Some((length, _)) = best {
            aim.bound = length;
            // They came in their order: none of the others is shorter.
            self.open.clear();
        }
        for label in reached {
            self.reopen(label, &aim);
        }
        while let Some(Candidate { f, next }) = self.open.pop() {
            match next {
                Next::Label(label) => {
                    self.try_end(label, target, &aim);
                    self.reopen(label, &aim);
                }
                Next::Ways(label) => self.open_groups(label, f, &aim),
                Next::Group(place) => {
                    let (label, group) = self.tree.take_group(place);
                    self.fan_out(label, group, &aim);
                }
                Next::End(label) => {
                    if !cx.proceed() {
                        return Answer::Cut;
                    }
                    if self.is_last_piece_free(problem, label, target) {
                        best = Some((f, label));
                        break;
                    }
                }
                Next::Way(way) => {
                    // Only then is it taken: a search cut short must not lose it.
                    if !cx.proceed() {
                        return Answer::Cut;
                    }
                    let way = self.tree.take(way);
                    if let Some(label) = self.follow(problem, &way) {
                        cx.expanded(|| label.at);
                        let here = self.settle(label);
                        self.try_end(here, target, &aim);
                        self.open_groups(here, f64::NEG_INFINITY, &aim);
                    }
                }
            }
        }
        match best {
            Some((length, label)) => Answer::Route(self.route(label, target, length)),
            None => Answer::Nothing,
        }
    }

    /// Goes a way to its end, if it is free and better than those that were there before.
    fn follow(&mut self, problem: &WorldProblem, way: &Way) -> Option<Label> {
        let edge = &mut self.edges[way.edge as usize];
        let disc = edge.from as usize / 2;
        let (from, to) = (&self.discs[disc], &self.discs[edge.to as usize / 2]);
        let in_the_way = &mut self.in_the_way[disc];
        let free = *edge
            .free
            .get_or_insert_with(|| is_free(problem, &edge.tangent.segment(from, to), in_the_way));
        if !free {
            return None;
        }
        let label = Label::over(edge, way);
        let room = self.room(problem, label.node).holds(label.arriving);
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
        self.tree.settled[label.node as usize].iter().any(|&other| {
            let other = &self.tree.labels[other as usize];
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

    /// Puts a label into the tree, and the obstacles that may be next.
    fn settle(&mut self, label: Label) -> u32 {
        let (disc, turn) = (&self.discs[label.node as usize / 2], turn_of(label.node));
        let least = self.groups.iter().map(|group| {
            if group.is_ahead_of(disc, turn) {
                // From the last contact to the obstacle's circle, and on from there.
                let to_circle = (group.centre - label.at).norm() - group.reach;
                label.g + to_circle.max(0.0) - group.reach
            } else {
                f64::INFINITY
            }
        });
        self.tree.add(label, least)
    }

    /// Puts the ways on from a label into the open list, if they may lead to a path that is of
    /// interest.
    fn reopen(&mut self, label: u32, aim: &Aim) {
        let open = &mut self.open;
        self.tree.each_way(label, |k, way| {
            let f = aim.through(way.g, way.at);
            if f < aim.bound {
                open.push(Candidate::new(f, Next::Way(k)));
            }
        });
        self.open_groups(label, f64::NEG_INFINITY, aim);
    }

    /// Puts the obstacles next to a label into the open list, those over which a path may be as
    /// short as `from` or somewhat longer. The rest have to wait: most are never asked for.
    fn open_groups(&mut self, label: u32, from: f64, aim: &Aim) {
        if self.tree.least_with(label, &self.to_end) >= aim.bound {
            return;
        }
        let at = &self.tree.labels[label as usize];
        let hope = aim.through(at.g, at.at);
        let late = (from - hope).max(0.0);
        let upto = hope + 2.0 * late + aim.step;
        let mut rest = f64::INFINITY;
        for ((place, least), to_end) in self.tree.least(label).zip(&self.to_end) {
            let f = least + to_end;
            if f > upto {
                rest = rest.min(f);
            } else if f >= from && f < aim.bound {
                self.open.push(Candidate::new(f, Next::Group(place)));
            }
        }
        if rest < aim.bound {
            self.open.push(Candidate::new(rest, Next::Ways(label)));
        }
    }

    /// Puts the ways from a label to an obstacle into the tree and, if they may lead to a path
    /// that is of interest, into the open list, their pieces unseen.
    fn fan_out(&mut self, label: u32, group: u32, aim: &Aim) {
        let from = self.tree.labels[label as usize];
        let (first, last) = self.fan(from.node, group);
        for k in first..last {
            let edge = &self.edges[k as usize];
            if edge.free != Some(false)
                && let Some(arc) = self.round(from.node, from.arriving, edge.tangent.leaving)
            {
                let to = &self.discs[edge.to as usize / 2];
                let at = to.centre + edge.tangent.arriving * to.radius;
                let g = from.g + arc + edge.tangent.length;
                let way = self.tree.add_way(label, k, g, at);
                let f = aim.through(g, at);
                if f < aim.bound {
                    self.open.push(Candidate::new(f, Next::Way(way)));
                }
            }
        }
    }

    /// The edges from a node to an obstacle.
    fn fan(&mut self, node: u32, group: u32) -> (u32, u32) {
        let groups = self.groups.len();
        let row = *self.rows[node as usize].get_or_insert_with(|| {
            let row = index(self.fans.len());
            self.fans.resize(self.fans.len() + groups, None);
            row
        });
        *self.fans[(row + group) as usize].get_or_insert_with(|| {
            let first = index(self.edges.len());
            let to = self.groups[group as usize].discs.clone();
            self.edges.extend(tangents(&self.discs, node, to));
            (first, index(self.edges.len()))
        })
    }

    /// Puts the last piece from a label into the open list, if there is one, unseen.
    fn try_end(&mut self, label: u32, target: &Disc, aim: &Aim) {
        let from = &self.tree.labels[label as usize];
        if let Some(tangent) = self.last_piece(from, target)
            && let Some(arc) = self.round(from.node, from.arriving, tangent.leaving)
        {
            let length = from.g + arc + tangent.length;
            if length < aim.bound {
                self.open.push(Candidate::new(length, Next::End(label)));
            }
        }
    }

    fn last_piece(&self, from: &Label, target: &Disc) -> Option<Tangent> {
        if from.is_root() {
            return Some(Tangent::straight(from.at, target.centre));
        }
        let disc = &self.discs[from.node as usize / 2];
        Tangent::between(disc, turn_of(from.node), target, Turn::Left)
    }

    fn is_last_piece_free(&mut self, problem: &WorldProblem, label: u32, target: &Disc) -> bool {
        let label = &self.tree.labels[label as usize];
        let disc = label.node as usize / 2;
        self.last_piece(label, target).is_some_and(|tangent| {
            let piece = tangent.segment(&self.discs[disc], target);
            is_free(problem, &piece, &mut self.in_the_way[disc])
        })
    }

    /// The route that goes to a label and from there straight to the target.
    fn route(&self, label: u32, target: &Disc, length: f64) -> Route {
        let mut bends = Vec::new();
        let mut label = &self.tree.labels[label as usize];
        let mut leaving = self
            .last_piece(label, target)
            .map(|tangent| tangent.leaving);
        while let Some(to) = leaving.filter(|_| !label.is_root()) {
            let (disc, turn) = (&self.discs[label.node as usize / 2], turn_of(label.node));
            let angle = turn.angle(label.arriving, to);
            bends.push(Bend::new(disc, label.arriving, angle, turn));
            leaving = Some(label.leaving);
            label = &self.tree.labels[label.parent as usize];
        }
        bends.reverse();
        Route {
            start: label.at,
            goal: target.centre,
            bends,
            length,
        }
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
