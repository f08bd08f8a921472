//! `pf completions` and `pf man`.

use crate::{Folder, pf};
use std::{fs, process::Command};

#[test]
fn every_verb_has_a_manual_page() {
    let folder = Folder::with(&[]);
    let run = pf(&["man", &folder.name("man1")]).ends(0);
    let help = pf(&["help"]).ends(0).out;
    let verbs = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let verbs = verbs.take_while(|line| !line.is_empty());
    let mut count = 0;
    // What is further in goes on with what is above.
    let verbs = verbs.filter(|line| !line.starts_with("   "));
    for verb in verbs.filter_map(|line| line.split_whitespace().next()) {
        if verb == "help" {
            continue;
        }
        let page = fs::read_to_string(folder.path(&format!("man1/pf-{verb}.1"))).unwrap();
        assert!(page.contains(".SH SYNOPSIS"), "{verb}");
        count += 1;
    }
    assert!(count >= 11, "{help}");
    assert_eq!(run.out.lines().count(), count + 1);
    let page = fs::read_to_string(folder.path("man1/pf.1")).unwrap();
    assert!(page.contains("Exit codes"));
    pf(&["man", "/proc/none"])
        .ends(1)
        .says(&["/proc/none: cannot be made"]);
}

#[test]
fn completions_are_those_of_the_shell() {
    for (shell, word) in [
        ("bash", "complete -F"),
        ("zsh", "#compdef pf"),
        ("fish", "complete -c pf"),
    ] {
        let out = pf(&["completions", shell]).ends(0).out;
        assert!(out.contains(word) && out.contains("replan"), "{shell}");
    }
    pf(&["completions", "sh"]).ends(2);
    // What bash makes of it.
    let folder = Folder::with(&[("pf.bash", pf(&["completions", "bash"]).out.as_bytes())]);
    let script = format!(
        "source '{}'; COMP_WORDS=(pf re); COMP_CWORD=1; _pf pf re pf; echo \"${{COMPREPLY[@]}}\"",
        folder.name("pf.bash")
    );
    if let Ok(output) = Command::new("bash").args(["-c", &script]).output() {
        assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), "replan");
    }
}
