//! A* over places and their safe intervals (Phillips and Likhachev 2011).

use super::{
    intervals::{Interval, Traffic},
    lattice::Lattice,
};
use pf_geom::{Point, TeamProblem, TimedPath, TimedPoint};
use std::{cmp::Ordering, collections::BinaryHeap};

/// How often a robot looks whether it can set out, for each time it takes to the next place.
const LOOKS: f64 = 4.0;

/// How often at most for one move.
const MOST_LOOKS: u32 = 400;

/// A place in one of its safe intervals, and how it was reached first.
#[derive(Clone, Copy, Debug)]
struct State {
    place: usize,
    interval: Interval,
    arrival: f64,
    /// From which state, and when it was left.
    from: Option<(usize, f64)>,
    closed: bool,
}

/// What is next to look at: the state with the least time in all.
#[derive(Clone, Copy, Debug)]
struct Open {
    total: f64,
    state: usize,
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .total
            .total_cmp(&self.total)
            .then(other.state.cmp(&self.state))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Open {}

/// The way of one robot through the traffic. The start and the goal are places too, after those of
/// the lattice.
pub(super) struct Search<'a> {
    lattice: &'a Lattice,
    traffic: &'a Traffic,
    ends: [Point; 2],
    near: [Vec<usize>; 2],
    /// Whether there is a straight way between the ends.
    straight: bool,
    speed: f64,
    states: Vec<State>,
    /// By place: its states, one an interval, once it was reached.
    first: Vec<Option<(usize, usize)>>,
    open: BinaryHeap<Open>,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        problem: &TeamProblem,
        robot: usize,
        lattice: &'a Lattice,
        traffic: &'a Traffic,
    ) -> Self {
        let robot = problem.robots()[robot];
        let ends = [robot.start, robot.goal];
        let segment = pf_geom::Segment::new(ends[0], ends[1]);
        Self {
            lattice,
            traffic,
            ends,
            near: ends.map(|end| lattice.near(problem, robot.radius, end)),
            straight: problem.world().is_free(&segment, robot.radius),
            speed: robot.speed,
            states: Vec::new(),
            first: vec![None; lattice.len() + 2],
            open: BinaryHeap::new(),
        }
    }

    fn start(&self) -> usize {
        self.lattice.len()
    }

    fn goal(&self) -> usize {
        self.lattice.len() + 1
    }

    fn place(&self, number: usize) -> Point {
        match number.checked_sub(self.lattice.len()) {
            None => self.lattice.place(number),
            Some(end) => self.ends[end],
        }
    }

    /// The earliest path of a robot that does not set out before a time; none if there is none over
    /// these places.
    pub(super) fn path(mut self, begin: f64) -> Option<TimedPath> {
        let (first, count) = self.states_of(self.start());
        let state = (first..first + count).find(|&s| self.states[s].interval.0 <= 0.0)?;
        let begin = if begin < self.states[state].interval.1 {
            begin
        } else {
            0.0
        };
        self.reach(state, begin, None);
        while let Some(Open { state, .. }) = self.open.pop() {
            if self.states[state].closed {
                continue;
            }
            self.states[state].closed = true;
            let State {
                place, interval, ..
            } = self.states[state];
            if place == self.goal() && interval.1 == f64::INFINITY {
                return Some(self.trace(state));
            }
            self.expand(state, place);
        }
        None
    }

    fn expand(&mut self, state: usize, place: usize) {
        let mut next: Vec<usize> = Vec::with_capacity(16);
        if place == self.start() {
            next.extend_from_slice(&self.near[0]);
            if self.straight {
                next.push(self.goal());
            }
        } else if place != self.goal() {
            next.extend(self.lattice.next(place));
            if self.near[1].contains(&place) {
                next.push(self.goal());
            }
        } else {
            next.extend_from_slice(&self.near[1]);
        }
        for to in next {
            let (first, count) = self.states_of(to);
            for target in first..first + count {
                if !self.states[target].closed {
                    self.step(state, target);
                }
            }
        }
    }

    /// Looks for the earliest move from a state to another.
    fn step(&mut self, from: usize, to: usize) {
        let (here, there) = (self.states[from], self.states[to]);
        let (a, b) = (self.place(here.place), self.place(there.place));
        let takes = (b - a).norm() / self.speed;
        let latest = here.interval.1.min(there.interval.1 - takes);
        // When all others rest, waiting does not help.
        let latest = latest.min(self.traffic.settled().max(here.arrival));
        let mut leave = here.arrival.max(there.interval.0 - takes);
        let pause = (takes / LOOKS).max(1e-9);
        for _ in 0..MOST_LOOKS {
            if leave > latest || leave + takes >= there.arrival {
                return;
            }
            let (begin, end) = (leave, leave + takes);
            let set_out = TimedPoint { at: a, time: begin };
            let arrive = TimedPoint { at: b, time: end };
            if end < there.interval.1 && self.traffic.is_clear(&set_out, &arrive) {
                self.reach(to, end, Some((from, leave)));
                return;
            }
            leave += pause;
        }
    }

    fn reach(&mut self, state: usize, arrival: f64, from: Option<(usize, f64)>) {
        let place = self.place(self.states[state].place);
        let rest = (self.ends[1] - place).norm() / self.speed;
        let reached = &mut self.states[state];
        reached.arrival = arrival;
        reached.from = from;
        let total = arrival + rest;
        self.open.push(Open { total, state });
    }

    /// The states of a place: the first, and how many.
    fn states_of(&mut self, place: usize) -> (usize, usize) {
        if let Some(known) = self.first[place] {
            return known;
        }
        let mut intervals = Vec::new();
        self.traffic.safe(self.place(place), &mut intervals);
        let known = (self.states.len(), intervals.len());
        self.first[place] = Some(known);
        self.states
            .extend(intervals.into_iter().map(|interval| State {
                place,
                interval,
                arrival: f64::INFINITY,
                from: None,
                closed: false,
            }));
        known
    }

    /// The way that led to a state.
    fn trace(&self, state: usize) -> TimedPath {
        let mut path = Vec::new();
        let (mut state, mut left) = (state, f64::INFINITY);
        loop {
            let State {
                place,
                arrival,
                from,
                ..
            } = self.states[state];
            let at = self.place(place);
            if left < f64::INFINITY && left > arrival {
                path.push(TimedPoint { at, time: left });
            }
            path.push(TimedPoint { at, time: arrival });
            let Some((before, time)) = from else {
                if arrival > 0.0 {
                    path.push(TimedPoint { at, time: 0.0 });
                }
                break;
            };
            (state, left) = (before, time);
        }
        path.reverse();
        path
    }
}
