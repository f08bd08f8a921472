use pf_core::*; use pf_geom::*; use std::time::Instant;
struct R(u64);
impl R { fn f(&mut self) -> f64 { self.0 ^= self.0 << 13; self.0 ^= self.0 >> 7; self.0 ^= self.0 << 17; (self.0 >> 11) as f64 / (1u64 << 53) as f64 } fn r(&mut self, a: f64, b: f64) -> f64 { a + (b - a) * self.f() } }
fn world(r: &mut R, n: usize, side: f64) -> World {
    let b = Rectangle::new(Point::new(0.0, 0.0), Point::new(side, side)).unwrap();
    let s = side / (n as f64).sqrt() * 0.35;
    World::with_shapes(b, (0..n).map(|_| {
        let c = Point::new(r.r(0.0, side), r.r(0.0, side));
        match (r.f() * 4.0) as u32 {
            0 => Circle::new(c, r.r(0.2, 1.0) * s).unwrap().into(),
            1 => { let h = Vector::new(r.r(0.2, 1.0) * s, r.r(0.2, 1.0) * s); Rectangle::new(c - h, c + h).unwrap().into() }
            k => { let m = 3 + (r.f() * 5.0) as usize; let nonconvex = k == 3;
                let ph = r.f();
                let pts = (0..m).map(|i| { let a = (i as f64 + 0.8 * ph) / m as f64 * std::f64::consts::TAU; let q = if nonconvex && i % 2 == 1 { 0.3 } else { 1.0 }; c + Vector::new(a.cos(), a.sin()) * s * q }).collect();
                Polygon::new(pts).unwrap().into() }
        }
    }))
}
fn main() {
    let mut r = R(88172645463325252);
    for n in [10, 50, 200, 1000] {
        let (mut t, mut t2, mut solved, mut bad, mut inf, mut pops, mut exp) = (0.0, 0.0, 0, 0, 0, 0, 0);
        let q = 100;
        for i in 0..q {
            let w = world(&mut r, n, 100.0);
            let rad = if i % 2 == 0 { 0.0 } else { r.r(0.0, 1.0) };
            let p = loop { let (a, b) = (Point::new(r.r(0.0, 100.0), r.r(0.0, 100.0)), Point::new(r.r(0.0, 100.0), r.r(0.0, 100.0)));
                let p = WorldProblem::new(w.clone(), rad, a, b).unwrap(); if p.is_free(a, a) && p.is_free(b, b) { break p } };
            let mut g = TangentGraph::default();
            let mut cx = Context::seeded(0);
            let b = Instant::now();
            let a = g.shortest(&p, &mut cx);
            t += b.elapsed().as_secs_f64();
            pops += cx.stats().iterations; exp += cx.stats().expanded;
            match a { Answer::Route(route) => { solved += 1; let f = route.flattened(1e-4);
                match p.judge(&f) { Ok(l) if (l - route.length()).abs() < 1.01e-4 => {}, e => { bad += 1; if bad < 5 { println!("{e:?} {} rad {rad} bends {}", route.length(), route.bends().len()); } } } }
                _ => inf += 1 }
            let mut p2 = p.clone();
            let ng = loop { let a = Point::new(r.r(0.0, 100.0), r.r(0.0, 100.0)); if p.is_free(a, a) { break a } };
            p2.apply(&[WorldChange::GoalMoved(ng)]).unwrap();
            let b = Instant::now();
            g.shortest(&p2, &mut Context::seeded(0));
            t2 += b.elapsed().as_secs_f64();
        }
        println!("{n}: cold {:.1} us, moved goal {:.1} us, solved {solved} inf {inf} bad {bad} pops {} expanded {}", t / q as f64 * 1e6, t2 / q as f64 * 1e6, pops / q, exp / q);
    }
}
