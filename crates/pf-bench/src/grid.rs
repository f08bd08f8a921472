//! Probe.
use pf_classic::{AStar, Dijkstra};
use pf_core::{Context, Planner};
use pf_grid::{Cell, DIRECTIONS, Grid, GridProblem};
use std::{hint::black_box, sync::Arc, time::Instant};

/// Probe.
pub fn read(path: &str) -> Arc<Grid> {
    let text = std::fs::read_to_string(path).unwrap();
    let rows: Vec<&str> = text.lines().skip(4).map(str::trim_end).collect();
    Arc::new(
        Grid::new(rows[0].len() as u32, rows.len() as u32, |c| {
            u8::from(matches!(
                rows[c.y as usize].as_bytes()[c.x as usize],
                b'.' | b'G' | b'S'
            ))
        })
        .unwrap(),
    )
}
/// Probe.
pub fn scen(path: &str) -> Vec<(Cell, Cell, f64)> {
    std::fs::read_to_string(path)
        .unwrap()
        .lines()
        .skip(1)
        .map(|l| {
            let f: Vec<&str> = l.split_whitespace().collect();
            let n = |i: usize| f[i].parse::<u32>().unwrap();
            (
                Cell::new(n(4), n(5)),
                Cell::new(n(6), n(7)),
                f[8].parse().unwrap(),
            )
        })
        .collect()
}
/// Probe.
pub fn main() {
    let dir = std::env::args().nth(1).unwrap();
    let every: usize = std::env::args().nth(2).map_or(10, |s| s.parse().unwrap());
    let mut files: Vec<_> = std::fs::read_dir(&dir)
        .unwrap()
        .map(|e| e.unwrap().path())
        .filter(|p| p.extension().is_some_and(|e| e == "map"))
        .collect();
    files.sort();
    let mut product = 0.0;
    let mut n = 0;
    for file in files {
        let name = file.to_str().unwrap();
        let grid = read(name);
        let rows = scen(&format!("{name}.scen"));
        let (mut astar, mut dij) = (AStar::default(), Dijkstra::default());
        let mut t = [0u128; 3];
        let mut exp = [0u64; 2];
        let mut bad = 0;
        for (s, g, opt) in rows.iter().step_by(every) {
            let p = GridProblem::new(Arc::clone(&grid), *s, *g).unwrap();
            let mut best = [u128::MAX; 3];
            for rep in 0..3 {
                let b = Instant::now();
                let r = astar.plan(&p, &mut Context::seeded(0)).unwrap();
                best[0] = best[0].min(b.elapsed().as_nanos());
                if rep == 0 {
                    exp[0] += r.stats.expanded;
                    let len = r.outcome.solved().map_or(-1.0, |s| s.cost.value());
                    if (len - opt).abs() > 1e-5 * opt.max(1.0) {
                        bad += 1;
                    }
                }
                let b = Instant::now();
                let r = dij.plan(&p, &mut Context::seeded(0)).unwrap();
                best[1] = best[1].min(b.elapsed().as_nanos());
                if rep == 0 {
                    exp[1] += r.stats.expanded;
                    let len = r.outcome.solved().map_or(-1.0, |s| s.cost.value());
                    if (len - opt).abs() > 1e-5 * opt.max(1.0) {
                        bad += 1;
                    }
                }
                if every > 1 && rep < 2 {
                    let b = Instant::now();
                    let (w, h) = (grid.width(), grid.height());
                    let r = pathfinding::prelude::astar(
                        s,
                        |c| {
                            let around = grid.around_id(grid.layout().id(*c));
                            let legal = p.moves().legal(around);
                            let c = *c;
                            (0..8).filter(move |k| legal >> k & 1 == 1).map(move |k| {
                                (
                                    Cell::new(
                                        c.x.wrapping_add_signed(DIRECTIONS[k].0),
                                        c.y.wrapping_add_signed(DIRECTIONS[k].1),
                                    ),
                                    if k < 4 { 33461u32 } else { 47321 },
                                )
                            })
                        },
                        |c| {
                            let (dx, dy) = (c.x.abs_diff(g.x), c.y.abs_diff(g.y));
                            33461 * (dx.max(dy) - dx.min(dy)) + 47321 * dx.min(dy)
                        },
                        |c| c == g,
                    );
                    best[2] = best[2].min(b.elapsed().as_nanos());
                    black_box((r, w, h));
                }
            }
            for i in 0..3 {
                t[i] += best[i];
            }
        }
        let q = rows.len().div_ceil(every) as u128;
        let ratio = t[2] as f64 / t[0] as f64;
        product += ratio.ln();
        n += 1;
        println!(
            "{:28} {q:5} bad {bad} A* {:7} us {:5.1} ns/exp {:8} exp | Dij {:7} us {:5.1} ns/exp | pathfinding {:7} us  ratio {ratio:.2}",
            file.file_name().unwrap().to_str().unwrap(),
            t[0] / q / 1000,
            t[0] as f64 / exp[0] as f64,
            exp[0] / q as u64,
            t[1] / q / 1000,
            t[1] as f64 / exp[1] as f64,
            t[2] / q / 1000
        );
    }
    println!("geo {:.2}", (product / n as f64).exp());
}
