//! What may not stand in the sources.

use super::{
    Finding,
    arrows::{is_planner, is_sealed},
};
use crate::workspace::{Package, Source};
use anyhow::{Result, anyhow};
use proc_macro2::{Delimiter, TokenStream, TokenTree};

const LONGEST_FILE: usize = 800;
const LONG_FILE: usize = 500;

/// The clock of the workspace.
const CLOCK: &str = "crates/pf-core/src/clock.rs";

/// Names through which a planner would reach past its context.
const SIDE_DOORS: &[(&str, &str)] = &[
    ("Instant", "time comes from the context"),
    ("SystemTime", "time comes from the context"),
    ("HashMap", "its order differs from run to run"),
    ("HashSet", "its order differs from run to run"),
    ("RandomState", "it differs from run to run"),
    ("StdRng", "chance comes from the context"),
    ("SmallRng", "chance comes from the context"),
    ("ThreadRng", "chance comes from the context"),
    ("OsRng", "chance comes from the context"),
    ("SysRng", "chance comes from the context"),
    ("getrandom", "chance comes from the context"),
];
const SIDE_DOOR_MODULES: &[&str] = &["env", "fs", "io", "net", "os", "process"];
const PRINTS: &[&str] = &["print", "println", "eprint", "eprintln", "dbg"];

pub(super) fn check(packages: &[Package], sources: &[Source]) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for source in sources.iter().filter(|source| source.is_a("rs")) {
        findings.extend(length(source));
        let all = tokens(source, true)?;
        findings.extend(no_unsafe(&source.path, &all));
        findings.extend(silenced_without_reason(&source.path, &all));
        let Some(package) = package_of(source, packages) else {
            continue;
        };
        let code = tokens(source, false)?;
        if is_sealed(&package.name) && source.path != CLOCK {
            findings.extend(no_side_door(&source.path, &code));
        }
        if is_planner(&package.name) {
            findings.extend(caller_owns_the_world(&source.path, &code));
        }
    }
    Ok(findings)
}

/// The package to whose library or program the file belongs; tests and examples belong to none.
fn package_of<'p>(source: &Source, packages: &'p [Package]) -> Option<&'p Package> {
    packages
        .iter()
        .find(|package| source.path.starts_with(&format!("{}/src/", package.folder)))
}

/// An identifier or a sign, and its line.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Token {
    text: String,
    line: usize,
}

/// The code of a file without comments and literals, with or without its test modules.
fn tokens(source: &Source, with_tests: bool) -> Result<Vec<Token>> {
    let stream: TokenStream = source
        .text
        .parse()
        .map_err(|error| anyhow!("{}: {error}", source.path))?;
    let mut tokens = Vec::new();
    flatten(stream, with_tests, &mut tokens);
    Ok(tokens)
}

fn flatten(stream: TokenStream, with_tests: bool, into: &mut Vec<Token>) {
    let mut trees = stream.into_iter().peekable();
    while let Some(tree) = trees.next() {
        let line = tree.span().start().line;
        let mut push = |text: String, line| into.push(Token { text, line });
        match tree {
            TokenTree::Group(group) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Parenthesis => ("(", ")"),
                    Delimiter::Brace => ("{", "}"),
                    Delimiter::Bracket => ("[", "]"),
                    Delimiter::None => ("", ""),
                };
                push(open.into(), line);
                flatten(group.stream(), with_tests, into);
                let line = group.span_close().start().line;
                into.push(Token {
                    text: close.into(),
                    line,
                });
            }
            TokenTree::Punct(sign) if sign.as_char() == '#' && !with_tests => {
                let test = matches!(trees.peek(), Some(TokenTree::Group(group))
                    if group.stream().to_string().replace(' ', "") == "cfg(test)");
                if test {
                    skip_item(&mut trees);
                }
            }
            TokenTree::Literal(_) => {}
            other => push(other.to_string(), line),
        }
    }
}

/// Goes past the item that an attribute stands before.
fn skip_item(trees: &mut impl Iterator<Item = TokenTree>) {
    for tree in trees {
        match tree {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => return,
            TokenTree::Punct(sign) if sign.as_char() == ';' => return,
            _ => {}
        }
    }
}

fn length(source: &Source) -> Option<Finding> {
    let lines = source.text.lines().count();
    let finding = |limit| {
        let what = format!("{lines} lines; a file holds one idea and at most {limit} lines");
        Finding::new("file-length", &source.path, lines, what)
    };
    if lines > LONGEST_FILE {
        Some(finding(LONGEST_FILE))
    } else if lines > LONG_FILE {
        Some(Finding {
            only_a_warning: true,
            ..finding(LONG_FILE)
        })
    } else {
        None
    }
}

fn no_unsafe(path: &str, tokens: &[Token]) -> Vec<Finding> {
    let found = tokens.iter().filter(|token| token.text == "unsafe");
    found
        .map(|token| Finding::new("no-unsafe", path, token.line, "`unsafe` is forbidden"))
        .collect()
}

/// `#[expect(…, reason = "…")]` tells when it is no longer needed; where a macro's text needs
/// `#[allow]`, it gives a reason too.
fn silenced_without_reason(path: &str, tokens: &[Token]) -> Vec<Finding> {
    let text = |at: usize| tokens.get(at).map_or("", |token| &*token.text);
    let mut findings = Vec::new();
    for at in 1..tokens.len() {
        if text(at - 1) != "[" || !matches!(text(at), "allow" | "expect") || text(at + 1) != "(" {
            continue;
        }
        let words = tokens[at..].iter().map(|token| &*token.text);
        if !words
            .take_while(|word| *word != "]")
            .any(|word| word == "reason")
        {
            let what = "a lint is silenced by `#[expect(…, reason = \"…\")]`";
            findings.push(Finding::new(
                "silence-gives-a-reason",
                path,
                tokens[at].line,
                what,
            ));
        }
    }
    findings
}

/// (5) No clock, entropy, file, environment, print, `HashMap`.
fn no_side_door(path: &str, tokens: &[Token]) -> Vec<Finding> {
    let text = |at: usize| tokens.get(at).map_or("", |token| &*token.text);
    let mut findings = Vec::new();
    let mut find = |at: usize, why: &str| {
        let what = format!("`{}`: {why}", text(at));
        findings.push(Finding::new("5-no-side-door", path, tokens[at].line, what));
    };
    for at in 0..tokens.len() {
        if let Some((_, why)) = SIDE_DOORS.iter().find(|(name, _)| *name == text(at)) {
            find(at, why);
        }
        if PRINTS.contains(&text(at)) && text(at + 1) == "!" {
            find(at, "planners do not print; tell the context");
        }
        if text(at) == "std" && text(at + 1) == ":" && text(at + 2) == ":" {
            for module in modules(tokens, at + 3) {
                if SIDE_DOOR_MODULES.contains(&text(module)) {
                    find(module, "planners do not reach outside");
                }
            }
        }
    }
    findings
}

/// Where the first names after a `std::` stand: one, or those of a `{…}`.
fn modules(tokens: &[Token], from: usize) -> Vec<usize> {
    if tokens.get(from).is_none_or(|token| token.text != "{") {
        return vec![from];
    }
    let mut depth = 0;
    let mut starts = Vec::new();
    for (at, token) in tokens.iter().enumerate().skip(from) {
        match token.text.as_str() {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            break;
        }
        if depth == 1 && matches!(token.text.as_str(), "{" | ",") {
            starts.push(at + 1);
        }
    }
    starts
}

/// (9) A planner is told of changes; it never makes them.
fn caller_owns_the_world(path: &str, tokens: &[Token]) -> Vec<Finding> {
    let what = "the caller owns the world: planners do not change it";
    let found = tokens.windows(3).filter(|window| {
        matches!(&*window[0].text, "." | ":")
            && matches!(&*window[1].text, "apply" | "revise")
            && window[2].text == "("
    });
    found
        .map(|window| Finding::new("9-caller-owns-the-world", path, window[1].line, what))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rules broken by a file of pf-classic, with their lines.
    fn rules(text: &str) -> Vec<(&'static str, usize)> {
        rules_in("crates/pf-classic/src/a_star.rs", text)
    }

    fn rules_in(path: &str, text: &str) -> Vec<(&'static str, usize)> {
        let package = |name: &str| Package {
            name: name.into(),
            folder: format!("crates/{name}"),
            ..Package::default()
        };
        let source = Source {
            path: path.into(),
            text: text.into(),
        };
        let packages = ["pf-core", "pf-classic", "pf-cli"].map(package);
        let findings = check(&packages, &[source]).unwrap();
        findings.iter().map(|f| (f.rule, f.line)).collect()
    }

    #[test]
    fn every_side_door_is_seen() {
        for text in [
            "use std::time::Instant;",
            "use std::collections::{BTreeMap, HashMap};",
            "fn f() { println!(\"x\"); }",
            "fn f() { let x = std::env::var(\"X\"); }",
            "use std::{fmt, fs::File};",
            "use std::{cmp::{Ordering, Reverse}, io};",
            "use rand::rngs::StdRng;",
        ] {
            assert_eq!(
                rules(&format!("\n{text}")),
                [("5-no-side-door", 2)],
                "{text}"
            );
        }
    }

    #[test]
    fn words_in_comments_strings_and_tests_are_no_side_doors() {
        let text = "
            //! No `HashMap`, no `std::fs`.
            use std::{fmt, time::Duration, collections::{env, BTreeMap}};
            const NAME: &str = \"std::env println!(x) HashMap\";
            #[cfg(test)]
            mod tests {
                use std::{collections::HashMap, fs};
                #[test]
                fn t() { println!(\"{}\", p.revise(&[])); }
            }
        ";
        assert_eq!(rules(text), []);
        assert_eq!(rules("#[cfg(test)] mod tests {} use std::fs;").len(), 1);
    }

    #[test]
    fn the_clock_and_the_tools_may_look_at_the_time() {
        let text = "use std::time::Instant;";
        assert_eq!(rules_in(CLOCK, text), []);
        assert_eq!(rules_in("crates/pf-cli/src/main.rs", text), []);
        assert_eq!(rules_in("crates/pf-classic/tests/t.rs", text), []);
        assert_eq!(rules_in("crates/pf-core/src/context.rs", text).len(), 1);
    }

    #[test]
    fn a_planner_that_changes_the_world_is_seen() {
        let rule = "9-caller-owns-the-world";
        assert_eq!(rules("fn f() { problem.apply(&changes); }"), [(rule, 1)]);
        assert_eq!(rules("fn f() { Problem::apply(&mut p, &c); }"), [(rule, 1)]);
        assert_eq!(rules("fn f() { problem.revise(&changes); }"), [(rule, 1)]);
        assert_eq!(rules("fn apply(x: u8) {}"), []);
    }

    #[test]
    fn unsafe_and_allow_are_seen_in_tests_too() {
        let text = "#[cfg(test)] mod t { #[allow(dead_code)] fn f() { unsafe {} } }";
        assert_eq!(
            rules(text),
            [("no-unsafe", 1), ("silence-gives-a-reason", 1)]
        );
        assert_eq!(rules("#![forbid(unsafe_code)] // unsafe"), []);
        assert_eq!(rules("#[expect(dead_code, reason = \"x\")] fn f() {}"), []);
    }

    #[test]
    fn long_files_are_warned_of_and_longer_ones_refused() {
        let source = |lines| Source {
            path: "a.rs".into(),
            text: "\n".repeat(lines),
        };
        assert_eq!(length(&source(500)), None);
        assert!(length(&source(501)).unwrap().only_a_warning);
        assert!(length(&source(800)).unwrap().only_a_warning);
        assert!(!length(&source(801)).unwrap().only_a_warning);
    }

    #[test]
    fn a_file_that_is_not_rust_is_named() {
        let source = Source {
            path: "crates/pf-core/src/broken.rs".into(),
            text: "fn f( {".into(),
        };
        let error = check(&[], &[source]).unwrap_err().to_string();
        assert!(error.starts_with("crates/pf-core/src/broken.rs"), "{error}");
    }
}
