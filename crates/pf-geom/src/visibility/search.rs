//! A* over the tangent graph, which goes on where the last one from the same end stopped.

use super::{
    Answer, Bend, Disc, Group, Label, Next, Room, Route, SAME_ANGLE, Tangent, TangentGraph, Turn,
    Way, index, is_free, tangents, tree::Candidate, turn_of,
};
use crate::{Point, Vector, WorldProblem, cross};
use pf_core::Context;

/// How many last pieces are tried before the search, for a bound on what it may cost.
const TRIALS: u32 = 24;
/// [`Aim::step`] as a share of the straight line.
const STEP: f64 = 0.02;

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

impl TangentGraph {
    pub(super) fn search(
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
        let mut reached = std::mem::take(&mut self.reached);
        reached.clear();
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
        for &label in &reached {
            self.reopen(label, &aim);
        }
        self.reached = reached;
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
    pub(super) fn settle(&mut self, label: Label) -> u32 {
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
    fn route(&mut self, label: u32, target: &Disc, length: f64) -> Route {
        let mut bends = std::mem::take(&mut self.spare);
        bends.clear();
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
