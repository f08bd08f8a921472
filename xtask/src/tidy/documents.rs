//! What the documents owe their readers.

use super::Finding;
use crate::workspace::{Package, Source};
use std::collections::BTreeSet;

/// The README fits on two screens.
const README_LINES: usize = 99;

/// How paths of somebody's machine begin; joined here so that this file holds none.
const MACHINE_PATHS: &[&str] = &[
    concat!("/ho", "me/"),
    concat!("/Us", "ers/"),
    concat!("/ro", "ot/"),
    concat!("C:", "\\Users"),
    concat!("file", ":///"),
];

pub(super) fn check(packages: &[Package], sources: &[Source]) -> Vec<Finding> {
    let mut findings = Vec::new();
    for source in sources {
        findings.extend(no_machine_paths(source));
        if source.path == "README.md" {
            findings.extend(short_readme(source));
        }
        if source.is_a("md") {
            findings.extend(links(source, sources));
        }
    }
    findings.extend(
        packages
            .iter()
            .filter_map(|package| explained(package, sources)),
    );
    findings
}

/// A generated page equals what would be generated now.
pub(super) fn fresh(file: &str, page: &str, command: &str, sources: &[Source]) -> Option<Finding> {
    let there = sources.iter().find(|source| source.path == file);
    let text = there.map_or("", |source| &source.text);
    if text == page {
        return None;
    }
    let same = text.lines().zip(page.lines()).take_while(|(a, b)| a == b);
    let what = format!("is stale; run `{command}`");
    Some(Finding::new(
        "generated-pages-are-fresh",
        file,
        same.count() + 1,
        what,
    ))
}

fn short_readme(readme: &Source) -> Option<Finding> {
    let lines = readme.text.lines().count();
    let what = format!("{lines} lines, at most {README_LINES}; the rest belongs in docs/");
    (lines > README_LINES).then(|| Finding::new("short-readme", &readme.path, lines, what))
}

fn no_machine_paths(source: &Source) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (n, line) in source.text.lines().enumerate() {
        for path in MACHINE_PATHS.iter().filter(|path| line.contains(**path)) {
            let what = format!("`{path}…` is a place on one machine");
            findings.push(Finding::new("no-machine-paths", &source.path, n + 1, what));
        }
    }
    findings
}

/// A package says what it is: a README, or docs at the head of its root file.
fn explained(package: &Package, sources: &[Source]) -> Option<Finding> {
    let folder = &package.folder;
    let text = |name: &str| {
        let path = format!("{folder}/{name}");
        let source = sources.iter().find(|source| source.path == path);
        source.map(|source| source.text.as_str())
    };
    let roots = [text("src/lib.rs"), text("src/main.rs")];
    let docs = |text: &&str| text.starts_with("//!") || text.starts_with("#![doc");
    if text("README.md").is_some() || roots.iter().flatten().any(docs) {
        return None;
    }
    let what = "has neither a README.md nor docs at the head of its root file";
    Some(Finding::new(
        "crates-say-what-they-are",
        &format!("{folder}/Cargo.toml"),
        1,
        what,
    ))
}

/// Relative links lead to something that is there.
fn links(page: &Source, sources: &[Source]) -> Vec<Finding> {
    let mut places = BTreeSet::new();
    for source in sources {
        let mut path = source.path.as_str();
        places.insert(path);
        while let Some((folder, _)) = path.rsplit_once('/') {
            places.insert(folder);
            path = folder;
        }
    }
    let folder = page.path.rsplit_once('/').map_or("", |(folder, _)| folder);
    let mut findings = Vec::new();
    for (n, line) in page.text.lines().enumerate() {
        for rest in line.split("](").skip(1) {
            let Some((target, _)) = rest.split_once(')') else {
                continue;
            };
            let path = target.split('#').next().unwrap_or(target);
            let foreign = path.contains("://") || path.starts_with("mailto:");
            let there = resolve(folder, path).is_some_and(|path| places.contains(path.as_str()));
            if !path.is_empty() && !foreign && !there {
                let what = format!("`{target}` leads nowhere");
                findings.push(Finding::new(
                    "links-lead-somewhere",
                    &page.path,
                    n + 1,
                    what,
                ));
            }
        }
    }
    findings
}

/// `path` as seen from `folder`, without dots; none if it leads out of the workspace.
fn resolve(folder: &str, path: &str) -> Option<String> {
    let mut parts: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(path: &str, text: &str) -> Source {
        Source {
            path: path.into(),
            text: text.into(),
        }
    }

    fn rules(packages: &[Package], sources: &[Source]) -> Vec<(&'static str, usize)> {
        let findings = check(packages, sources);
        findings.iter().map(|f| (f.rule, f.line)).collect()
    }

    #[test]
    fn a_readme_of_a_hundred_lines_is_too_long() {
        let readme = |lines| [source("README.md", &"line\n".repeat(lines))];
        assert_eq!(rules(&[], &readme(99)), []);
        assert_eq!(rules(&[], &readme(100)), [("short-readme", 100)]);
        assert_eq!(rules(&[], &[source("docs/a.md", &"\n".repeat(500))]), []);
    }

    #[test]
    fn paths_of_a_machine_are_seen_in_any_file() {
        let text = format!("fine: ../shared\nnot: {}someone/x", MACHINE_PATHS[0]);
        let file = [source("maps/a.toml", &text)];
        assert_eq!(rules(&[], &file), [("no-machine-paths", 2)]);
    }

    #[test]
    fn links_are_followed() {
        let page = |text: &str| [source("docs/page.md", text), source("docs/a/b.md", "")];
        for good in [
            "[b](a/b.md)",
            "[b](a/b.md#head)",
            "[up](../docs/page.md)",
            "[folder](a)",
            "[web](https://example.org/x)",
            "[here](#here)",
        ] {
            assert_eq!(rules(&[], &page(good)), [], "{good}");
        }
        for bad in ["[b](b.md)", "[out](../../x.md)", "[a](a/b.md) [c](c.md)"] {
            assert_eq!(
                rules(&[], &page(bad)),
                [("links-lead-somewhere", 1)],
                "{bad}"
            );
        }
    }

    #[test]
    fn a_crate_without_a_word_is_seen() {
        let package = [Package {
            name: "pf-x".into(),
            folder: "crates/pf-x".into(),
            ..Package::default()
        }];
        let root = |text| [source("crates/pf-x/src/lib.rs", text)];
        let rule = ("crates-say-what-they-are", 1);
        assert_eq!(rules(&package, &root("pub fn f() {}")), [rule]);
        assert_eq!(rules(&package, &root("//! A word.")), []);
        assert_eq!(rules(&package, &[source("crates/pf-x/README.md", "")]), []);
    }

    #[test]
    fn a_stale_page_is_named_with_the_line_and_the_cure() {
        let there = [source("docs/laws.md", "one\ntwo\n")];
        assert_eq!(fresh("docs/laws.md", "one\ntwo\n", "cure", &there), None);
        let stale = fresh("docs/laws.md", "one\n2\n", "cure", &there).unwrap();
        assert_eq!((stale.rule, stale.line), ("generated-pages-are-fresh", 2));
        assert!(stale.what.contains("cure"));
        assert!(fresh("docs/laws.md", "one\n", "cure", &[]).is_some());
    }
}
