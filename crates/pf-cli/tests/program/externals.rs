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
