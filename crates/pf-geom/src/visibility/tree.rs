//! The ways from one end, and what of them was not looked at yet.

use super::{Edge, index};
use crate::{Point, Vector};
use std::cmp::Ordering;

/// Everything known of the ways from one end. It does not depend on the other end: a query only
/// sorts it by where it wants to go.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    /// The first is the root.
    pub(super) labels: Vec<Label>,
    ways: Vec<Way>,
    /// By label and group: no path from the label to the obstacle's circle, and from there on to
    /// somewhere, is shorter than this and the straight line there from the circle's middle.
    /// Infinite for obstacles that are no way on, or the ways to which are known.
    least: Vec<f64>,
    groups: usize,
    /// By node: its labels.
    pub(super) settled: Vec<Vec<u32>>,
}

/// A shortest way to a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Label {
    pub(super) node: u32,
    pub(super) parent: u32,
    /// Length of the way so far.
    pub(super) g: f64,
    /// Where it arrives.
    pub(super) at: Point,
    /// The same, as seen from the disc's centre.
    pub(super) arriving: Vector,
    /// Where the parent's disc was left.
    pub(super) leaving: Vector,
    /// The last of the ways on that were not looked at yet.
    ways: u32,
}

/// A way on from a label that was not looked at yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// Its length.
    pub(super) g: f64,
    /// Where it ends.
    pub(super) at: Point,
    pub(super) edge: u32,
    /// Whose way it is; nobody's once it was taken.
    pub(super) label: u32,
    /// Another way of the same label.
    next: u32,
}

const NONE: u32 = u32::MAX;

impl Label {
    pub(super) fn root(node: u32, at: Point) -> Self {
        Self {
            node,
            parent: NONE,
            g: 0.0,
            at,
            arriving: Vector::zeros(),
            leaving: Vector::zeros(),
            ways: NONE,
        }
    }

    /// The label at the end of a way over an edge.
    pub(super) fn over(edge: &Edge, way: &Way) -> Self {
        Self {
            parent: way.label,
            g: way.g,
            arriving: edge.tangent.arriving,
            leaving: edge.tangent.leaving,
            ..Self::root(edge.to, way.at)
        }
    }

    pub(super) fn is_root(&self) -> bool {
        self.parent == NONE
    }
}

impl Tree {
    pub(super) fn root(&self) -> Option<Point> {
        self.labels.first().map(|label| label.at)
    }

    pub(super) fn clear(&mut self) {
        for label in self.labels.drain(..) {
            self.settled[label.node as usize].clear();
        }
        self.ways.clear();
        self.least.clear();
    }

    /// Forgets all, and makes ready for that many nodes and groups.
    pub(super) fn fit(&mut self, nodes: usize, groups: usize) {
        self.clear();
        self.settled.resize(nodes, Vec::new());
        self.groups = groups;
    }

    /// Adds a label, and by group the least that ways to it and on may cost.
    pub(super) fn add(&mut self, label: Label, least: impl Iterator<Item = f64>) -> u32 {
        let here = index(self.labels.len());
        self.settled[label.node as usize].push(here);
        self.labels.push(label);
        self.least.extend(least);
        here
    }

    /// By group the least that ways from a label may cost, and the place to take it from.
    pub(super) fn least(&self, label: u32) -> impl Iterator<Item = (u32, f64)> {
        let first = label as usize * self.groups;
        let row = &self.least[first..first + self.groups];
        (index(first)..).zip(row.iter().copied())
    }

    /// The least that a path over a label and an obstacle may cost, given how far each obstacle is
    /// from where it is to lead. Four at a time, because most labels are done with after this.
    pub(super) fn least_with(&self, label: u32, to_end: &[f64]) -> f64 {
        let first = label as usize * self.groups;
        let row = &self.least[first..first + self.groups];
        let lesser = |a: f64, b: f64| if b < a { b } else { a };
        let (fours, rest) = row.as_chunks::<4>();
        let (to_fours, to_rest) = to_end.as_chunks::<4>();
        let mut least = [f64::INFINITY; 4];
        for (g, to_end) in fours.iter().zip(to_fours) {
            for k in 0..4 {
                least[k] = lesser(least[k], g[k] + to_end[k]);
            }
        }
        let rest = rest.iter().zip(to_rest).map(|(g, to_end)| g + to_end);
        rest.chain(least).fold(f64::INFINITY, lesser)
    }

    /// The label and the group of such a place, the ways to which are going to be known.
    pub(super) fn take_group(&mut self, place: u32) -> (u32, u32) {
        let groups = index(self.groups);
        self.least[place as usize] = f64::INFINITY;
        (place / groups, place % groups)
    }

    /// Adds a way on from a label.
    pub(super) fn add_way(&mut self, label: u32, edge: u32, g: f64, at: Point) -> u32 {
        let here = index(self.ways.len());
        let next = std::mem::replace(&mut self.labels[label as usize].ways, here);
        self.ways.push(Way {
            g,
            at,
            edge,
            label,
            next,
        });
        here
    }

    /// A way that is now being looked at.
    pub(super) fn take(&mut self, way: u32) -> Way {
        let way = &mut self.ways[way as usize];
        let taken = *way;
        way.label = NONE;
        taken
    }

    /// The ways on from a label that were not looked at yet.
    pub(super) fn each_way(&mut self, label: u32, mut tell: impl FnMut(u32, &Way)) {
        let mut last = NONE;
        let mut k = self.labels[label as usize].ways;
        while k != NONE {
            let way = &self.ways[k as usize];
            let next = way.next;
            if way.label != NONE {
                tell(k, way);
                last = k;
            } else if last == NONE {
                self.labels[label as usize].ways = next;
            } else {
                self.ways[last as usize].next = next;
            }
            k = next;
        }
    }
}

/// What a query looks at next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Next {
    /// All that goes on from a label.
    Label(u32),
    /// The obstacles next to a label that had to wait.
    Ways(u32),
    /// The ways from a label to an obstacle.
    Group(u32),
    /// One of the tree's ways.
    Way(u32),
    /// The last piece, from a label to the end asked for.
    End(u32),
}

/// An entry of the open list.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    /// No path over it is shorter.
    pub(super) f: f64,
    pub(super) next: Next,
}

impl Candidate {
    pub(super) fn new(f: f64, next: Next) -> Self {
        Self { f, next }
    }
}

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
/// The least `f` is the greatest; of equal ones what was learnt last.
impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        (other.f.total_cmp(&self.f)).then(self.next.cmp(&other.next))
    }
}
