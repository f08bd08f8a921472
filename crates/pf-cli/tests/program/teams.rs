//! `pf team`.

use crate::{Folder, pf};
use serde_json::{Value, json};

const THREE: &str = "maps/scenarios/three-robots.toml";

fn team(args: &[&str], code: i32) -> Value {
    let run = pf(&[&["team"], args, &["--json"]].concat()).ends(code);
    serde_json::from_str(&run.out).expect("one object")
}

/// Where a robot is at a time, by its printed path.
fn at(path: &Value, time: f64) -> (f64, f64) {
    let point = |p: &Value| [0, 1, 2].map(|k| p[k].as_f64().expect("a number"));
    let points: Vec<_> = path.as_array().expect("points").iter().map(point).collect();
    let last = points[points.len() - 1];
    let leg = points.windows(2).find(|leg| time < leg[1][2]);
    leg.map_or((last[0], last[1]), |leg| {
        let part = ((time - leg[0][2]) / (leg[1][2] - leg[0][2])).clamp(0.0, 1.0);
        let between = |k: usize| leg[0][k] + part * (leg[1][k] - leg[0][k]);
        (between(0), between(1))
    })
}

#[test]
fn robots_arrive_and_keep_apart_whatever_is_preferred() {
    let ends = [
        ([10.0, 10.0], [90.0, 90.0]),
        ([20.0, 40.0], [85.0, 55.0]),
        ([15.0, 90.0], [80.0, 20.0]),
    ];
    let mut lengths = vec![];
    for prefer in ["length", "safety", "smooth", "knee"] {
        let answer = team(&[THREE, "--evaluations", "4000", "--prefer", prefer], 0);
        assert_eq!(answer["problem"], "team");
        assert_eq!(answer["stats"]["evaluated"], 4000);
        assert_eq!(answer["prefer"], prefer);
        assert!(
            answer["front"]
                .as_array()
                .unwrap()
                .contains(&answer["cost"])
        );
        let paths = answer["paths"].as_array().unwrap();
        for (path, (start, goal)) in paths.iter().zip(ends) {
            let path = path.as_array().unwrap();
            assert_eq!(path[0], json!([start[0], start[1], 0.0]));
            assert_eq!(
                path[path.len() - 1].as_array().unwrap()[..2],
                [json!(goal[0]), json!(goal[1])]
            );
        }
        for tick in 0..2000 {
            let time = f64::from(tick) * 0.1;
            let places: Vec<_> = paths.iter().map(|path| at(path, time)).collect();
            for (i, a) in places.iter().enumerate() {
                for b in &places[i + 1..] {
                    let far = (a.0 - b.0).hypot(a.1 - b.1);
                    assert!(far > 4.0 - 1e-6, "{far} apart at {time}");
                }
            }
        }
        lengths.push(answer["length"].as_f64().unwrap());
    }
    assert!(
        lengths[1..].iter().all(|&other| lengths[0] <= other),
        "{lengths:?}"
    );
}

#[test]
fn one_seed_gives_one_front_whatever_the_threads() {
    let ask = |seed, threads| {
        let args = [
            THREE,
            "--evaluations",
            "1500",
            "--seed",
            seed,
            "--threads",
            threads,
        ];
        let mut answer = team(&args, 0);
        answer["stats"]["elapsed_us"] = 0.into();
        answer
    };
    assert_eq!(ask("4", "1"), ask("4", "2"));
    assert_ne!(ask("4", "1")["front"], ask("5", "1")["front"]);
}

#[test]
fn every_planner_for_teams_draws_its_front() {
    let folder = Folder::with(&[]);
    for planner in ["moabc", "nsga2", "moead", "random-search", "prioritised"] {
        let png = folder.name(&format!("{planner}.png"));
        let svg = folder.name(&format!("{planner}.svg"));
        let mut args = vec![
            "team",
            THREE,
            "--planner",
            planner,
            "--png",
            &png,
            "--svg",
            &svg,
        ];
        args.extend(["--evaluations", "1500", "--rows", "5"]);
        let run = pf(&args).ends(0);
        assert!(run.out.contains("preferred (knee): plan "), "{}", run.out);
        assert!(std::fs::read(png).unwrap().starts_with(b"\x89PNG"));
        assert!(
            std::fs::read_to_string(svg)
                .unwrap()
                .trim_end()
                .ends_with("</svg>")
        );
    }
}

#[test]
fn what_no_team_can_do_is_said_and_not_suffered() {
    let robot = |start: &str, goal: &str| {
        format!("[[robot]]\nradius = 1\nstart = {start}\ngoal = {goal}\n")
    };
    let world =
        |rest: String| format!("bounds = {{ min = [0, 0], max = [20, 20] }}\n{rest}").into_bytes();
    let wall = "[[rectangle]]\nmin = [9, 0]\nmax = [11, 20]\n";
    let folder = Folder::with(&[
        ("none.toml", &world(wall.to_owned())),
        ("walled.toml", &world(robot("[2, 2]", "[18, 2]") + wall)),
        (
            "same.toml",
            &world(robot("[2, 2]", "[18, 2]") + &robot("[3, 2]", "[18, 18]")),
        ),
        ("broken.toml", &world(robot("[2, 2]", "[18, nan]"))),
    ]);
    let ask = |name: &str| pf(&["team", &folder.name(name), "--evaluations", "1000"]);
    ask("none.toml")
        .ends(3)
        .says(&["none.toml", "no [[robot]]"]);
    ask("broken.toml").ends(3).says(&["broken.toml"]);
    let walled = ask("walled.toml").ends(4);
    assert!(
        walled.out.contains("robot 0 has no path even alone"),
        "{}",
        walled.out
    );
    ask("same.toml").ends(4);
    pf(&["team", THREE, "--planner", "moacb"])
        .ends(2)
        .says(&["did you mean `moabc`"]);
    pf(&["team", THREE, "--planner", "astar"])
        .ends(2)
        .says(&["does not plan for teams"]);
    pf(&["team", THREE, "--set", "populaton=5"])
        .ends(2)
        .says(&["population"]);
}
