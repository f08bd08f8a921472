//! Planners in other programs. Skipped visibly where there is no Python.

use crate::{Folder, Run, map, pf};

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

/// Asks a planner for the way from one corner of `MAP` to the other.
fn across(file: &str, planner: &str, more: &[&str]) -> Run {
    let args = [
        "plan",
        file,
        "--from",
        "0,0",
        "--to",
        "4,3",
        "--planner",
        planner,
    ];
    pf(&[&args, more].concat())
}

#[test]
fn a_planner_in_python_takes_part() {
    if !python() {
        return;
    }
    let folder = map(MAP);
    let file = folder.name("m.map");
    let ask = |planner: &str, moves: &str| across(&file, planner, &["--json", "--moves", moves]);
    let example = "external:python3 examples/external/planner.py";
    for moves in ["orthogonal", "always", "one-corner", "no-corner-cutting"] {
        let ours = ask("astar", moves).ends(0).json().remove(0);
        let theirs = ask(example, moves).ends(0).json().remove(0);
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
    let ask = |planner: &str| across(&file, planner, &[]);
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
    // By its argument: a path, a collision, garbage, silence for good, the end.
    let code = "import json, sys, time\nmode = sys.argv[1]\ninput()\n\
        print(json.dumps(dict(name='Py', problem='grid')), flush=True)\n\
        while True:\n q = json.loads(input())\n way = [[0, 0], [1, 0], [2, 0]]\n\
        \x20if mode == 'jumps': way = [[0, 0], [2, 0]]\n\
        \x20if mode == 'babbles': print('what?', flush=True)\n\
        \x20if mode == 'hangs': time.sleep(60)\n\
        \x20if mode == 'ends': sys.exit(3)\n\
        \x20print(json.dumps(dict(id=q['id'], outcome='feasible', path=way)), flush=True)\n";
    let folder = map("...");
    std::fs::write(folder.path("planner.py"), code).unwrap();
    let mut suite = "[[problem]]\nfile = \"m.map\"\nfrom = [0, 0]\nto = [2, 0]\n\
        [[planner]]\nname = \"astar\"\n"
        .to_owned();
    let modes = ["works", "jumps", "babbles", "hangs", "ends"];
    for mode in modes {
        let file = folder.name("planner.py");
        suite += "[[planner]]\nset = { limit = 0.7 }\nvariant = \"py\"\n";
        suite += &["name = \"external:python3 ", &file, " ", mode, "\"\n"].concat();
    }
    std::fs::write(folder.path("s.toml"), suite).unwrap();
    let (suite, out) = (folder.name("s.toml"), folder.name("out"));
    let run = pf(&["bench", &suite, "-o", &out, "--threads", "2"]).ends(6);
    assert!(run.out.contains("6 runs, 4 failed"), "{}", run.out);
    let results = std::fs::read_to_string(folder.path("out/results.csv")).unwrap();
    for mode in modes {
        let word = if mode == "works" {
            "feasible"
        } else {
            "failed"
        };
        let words = format!("planner.py {mode},py,0,{word},");
        assert!(results.contains(&words), "no {words} in {results}");
    }
    assert!(results.contains(",astar,,0,optimal,"), "{results}");
    assert!(
        run.err.contains("hangs py on m, seed 0: failed"),
        "{}",
        run.err
    );
}
