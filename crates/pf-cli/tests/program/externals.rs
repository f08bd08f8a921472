//! Planners in other programs. Skipped visibly where there is no Python.

use crate::{Folder, map, pf};

const MAP: &str = "....# .##.. .#... ...#.";

#[expect(clippy::print_stdout, reason = "what is skipped is said")]
fn python() -> bool {
    let there = std::process::Command::new("python3")
        .arg("--version")
        .output()
        .is_ok();
    if !there {
        println!("skipped: python3 is missing");
    }
    there
}

/// A planner that answers this to every question `q`.
fn folder_with(reply: &str) -> (Folder, String) {
    let code = format!(
        "import json\ninput()\nprint(json.dumps(dict(name='Py', problem='grid')), flush=True)\n\
         while True:\n q = json.loads(input())\n print(json.dumps({reply}), flush=True)\n"
    );
    let folder = Folder::with(&[("planner.py", code.as_bytes())]);
    let planner = format!("external:python3 '{}'", folder.name("planner.py"));
    (folder, planner)
}

#[test]
fn a_planner_in_python_takes_part() {
    if !python() {
        return;
    }
    let folder = map(MAP);
    let file = folder.name("m.map");
    let ask = |planner: &str, more: &[&str]| {
        let args = [
            "plan",
            &file,
            "--from",
            "0,0",
            "--to",
            "4,3",
            "--planner",
            planner,
            "--json",
        ];
        pf(&[&args, more].concat())
    };
    let example = "external:python3 examples/external/planner.py";
    for moves in ["orthogonal", "always", "one-corner", "no-corner-cutting"] {
        let ours = ask("astar", &["--moves", moves]).ends(0).json().remove(0);
        let theirs = ask(example, &["--moves", moves]).ends(0).json().remove(0);
        assert_eq!(theirs["planner"], example);
        assert_eq!(
            (&theirs["outcome"], &theirs["cost"]),
            (&"feasible".into(), &ours["cost"])
        );
    }
    let world = [
        "plan",
        "maps/worlds/cabc-1.toml",
        "--planner",
        example,
        "--cell",
        "1",
        "--json",
    ];
    let told = pf(&world).ends(0).json().remove(0);
    assert!(
        told["notes"][0].as_str().unwrap().contains("was cut into"),
        "{told}"
    );
}

#[test]
fn what_it_does_wrong_has_an_exit_code_of_its_own() {
    if !python() {
        return;
    }
    let folder = map(MAP);
    let file = folder.name("m.map");
    let ask = |planner: &str| {
        pf(&[
            "plan",
            &file,
            "--from",
            "0,0",
            "--to",
            "4,3",
            "--planner",
            planner,
        ])
    };
    let (_folder, liar) =
        folder_with("dict(id=q['id'], outcome='optimal', path=[q['start'], q['goal']])");
    let run = ask(&liar).ends(6);
    assert!(
        run.out.contains("fault: Py its path is none"),
        "{}",
        run.out
    );
    assert!(run.out.contains("unknown"), "{}", run.out);
    let (_folder, broken) = folder_with("1 / 0");
    let run = ask(&broken).ends(6);
    assert!(run.out.contains("ZeroDivisionError"), "{}", run.out);
    ask("external:/no/such/program")
        .ends(2)
        .says(&["external:/no/such/program", "does not start"]);
    ask("external:").ends(2).says(&["expected a command"]);
}

#[test]
fn a_suite_names_programs_that_fail_and_goes_on() {
    if !python() {
        return;
    }
    // By the seed: a path, a collision, garbage, silence for good, the end.
    let code = "import json, sys, time\ninput()\n\
        print(json.dumps(dict(name='Py', problem='grid')), flush=True)\n\
        while True:\n q = json.loads(input())\n way = [[0, 0], [1, 0], [2, 0]]\n\
        \x20if q['seed'] == 1: way = [[0, 0], [2, 0]]\n\
        \x20if q['seed'] == 2: print('what?', flush=True)\n\
        \x20if q['seed'] == 3: time.sleep(60)\n\
        \x20if q['seed'] == 4: sys.exit(3)\n\
        \x20print(json.dumps(dict(id=q['id'], outcome='feasible', path=way)), flush=True)\n";
    let folder = map("...");
    std::fs::write(folder.path("planner.py"), code).unwrap();
    let planner = format!("external:python3 {}", folder.name("planner.py"));
    let suite = format!(
        "seeds = 5\n[[problem]]\nfile = \"m.map\"\nfrom = [0, 0]\nto = [2, 0]\n\
         [[planner]]\nname = \"astar\"\n\
         [[planner]]\nname = \"{planner}\"\nvariant = \"py\"\nset = {{ limit = 0.5 }}\n"
    );
    std::fs::write(folder.path("s.toml"), suite).unwrap();
    let (suite, out) = (folder.name("s.toml"), folder.name("out"));
    let run = pf(&["bench", &suite, "-o", &out, "--threads", "2"]).ends(6);
    assert!(run.out.contains("10 runs"), "{}", run.out);
    let results = std::fs::read_to_string(folder.path("out/results.csv")).unwrap();
    let outcome = |planner: &str, seed: u64| {
        let head = format!("s,m,grid,{planner},{seed},");
        let line = results.lines().find(|line| line.starts_with(&head));
        let rest = line.map(|line| line[head.len()..].split(',').next());
        rest.flatten().unwrap_or("none").to_owned()
    };
    for seed in 0..5 {
        assert_eq!(outcome("astar,", seed), "optimal");
    }
    let py = format!("{planner},py");
    let told: Vec<_> = (0..5).map(|seed| outcome(&py, seed)).collect();
    assert_eq!(told[0], "feasible", "{results}");
    assert!(told[1..].iter().all(|word| word == "failed"), "{results}");
    assert!(run.err.contains("seed 3: failed"), "{}", run.err);
}
