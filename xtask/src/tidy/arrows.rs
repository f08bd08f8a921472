//! Who may depend on whom: the arrows of ARCHITECTURE.md, by their numbers there.

use super::Finding;
use crate::workspace::{Dependency, Package};

/// Where a package stands; what stands higher may see more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Layer {
    Core,
    /// pf-grid, pf-geom.
    Problem,
    Planner,
    /// pf-io, pf-render, pf-external.
    Port,
    Conformance,
    Registry,
    /// pf-bench, pf-papers, pf-suite.
    Study,
    Program,
    /// xtask, pf-tests.
    Top,
}

/// A package nobody told us about is a planner's, so that a new one is held to the strictest rules.
fn layer(name: &str) -> Layer {
    match name {
        "pf-core" => Layer::Core,
        "pf-grid" | "pf-geom" => Layer::Problem,
        "pf-io" | "pf-render" | "pf-external" => Layer::Port,
        "pf-conformance" => Layer::Conformance,
        "pf-planners" => Layer::Registry,
        "pf-bench" | "pf-papers" | "pf-suite" => Layer::Study,
        "pf-cli" => Layer::Program,
        "pf-tests" | "xtask" => Layer::Top,
        _ => Layer::Planner,
    }
}

/// Whether this is a package in which a planner's algorithm may stand.
pub(super) fn is_planner(name: &str) -> bool {
    layer(name) == Layer::Planner
}

/// Whether this is a package of kernels or planners: no clock, no chance, no file, no print.
pub(super) fn is_sealed(name: &str) -> bool {
    matches!(layer(name), Layer::Core | Layer::Problem | Layer::Planner)
}

/// The rule the dependency breaks, if any.
fn broken(from: &str, to: &str, only_in_tests: bool) -> Option<&'static str> {
    use Layer::{Conformance, Core, Planner, Port, Problem, Program, Registry, Study, Top};
    let rule = match (layer(from), layer(to)) {
        (Planner, Planner) => "2-planner-to-planner",
        (Planner, Conformance) if !only_in_tests => "3-conformance-only-in-tests",
        (Port, Planner) | (Planner, Port) => "6-drawing-and-planning-apart",
        (Core | Problem | Planner | Port | Conformance, Registry | Study | Program | Top) => {
            "7-library-to-tool"
        }
        (Conformance, Planner) => "8-conformance-to-planner",
        (Core, _)
        | (Problem, Planner | Port)
        | (Port | Conformance, Port)
        | (Registry, Study | Program | Top)
        | (Study, Program | Top)
        | (Program, Top) => "arrows-point-down",
        (Problem, Problem) if from == "pf-grid" => "arrows-point-down",
        // Conformance tests of a crate it does not depend on make no circle.
        (Problem | Port, Conformance) if !only_in_tests => "arrows-point-down",
        _ => return None,
    };
    Some(rule)
}

pub(super) fn check(packages: &[Package]) -> Vec<Finding> {
    let mut findings = Vec::new();
    for package in packages {
        for dependency in &package.dependencies {
            findings.extend(check_dependency(package, dependency, packages));
        }
        findings.extend(lean_default_features(package));
        if !inherits_lints(&package.manifest) {
            let what = "no `[lints]` table with `workspace = true`";
            findings.push(at(package, "lints-are-inherited", "[package]", what));
        }
    }
    findings
}

fn check_dependency(
    package: &Package,
    dependency: &Dependency,
    packages: &[Package],
) -> Option<Finding> {
    let (from, to) = (package.name.as_str(), dependency.name.as_str());
    let ours = packages.iter().any(|package| package.name == to);
    let rule = if ours {
        broken(from, to, dependency.only_in_tests)?
    } else if layer(from) == Layer::Core
        && !dependency.only_in_tests
        && !matches!(to, "rand" | "thiserror")
    {
        "1-core-stays-lean"
    } else if to.starts_with("parry") && !["pf-geom", "pf-bench"].contains(&from) {
        // In pf-bench it is a peer, measured beside our own kernels.
        "4-parry-only-in-geom"
    } else {
        return None;
    };
    let what = format!("`{from}` may not depend on `{to}`");
    Some(at(package, rule, to, what))
}

/// (10) No default feature adds a dependency.
fn lean_default_features(package: &Package) -> Option<Finding> {
    let mut reached = vec!["default"];
    let mut next = 0;
    while let Some(&feature) = reached.get(next) {
        next += 1;
        for name in package.features.get(feature).into_iter().flatten() {
            let optional = package.dependencies.iter().any(|dependency| {
                let name = name.strip_prefix("dep:").unwrap_or(name);
                let name = name.split('/').next().unwrap_or(name);
                dependency.optional && dependency.name == name.trim_end_matches('?')
            });
            if optional && !name.contains("?/") {
                let what = format!("a default feature brings in `{name}`");
                return Some(at(package, "10-lean-default-features", "default", what));
            }
            if !reached.contains(&name.as_str()) {
                reached.push(name);
            }
        }
    }
    None
}

fn inherits_lints(manifest: &str) -> bool {
    let mut lines = manifest.lines().map(str::trim);
    lines.any(|line| line == "[lints]") && lines.next() == Some("workspace = true")
}

/// A finding in the package's manifest, at the line that begins with `key`.
fn at(package: &Package, rule: &'static str, key: &str, what: impl Into<String>) -> Finding {
    let line = package
        .manifest
        .lines()
        .position(|line| line.starts_with(key));
    let file = format!("{}/Cargo.toml", package.folder);
    Finding::new(rule, &file, line.map_or(1, |line| line + 1), what)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    fn package(name: &str, dependencies: &[(&str, bool)]) -> Package {
        let line = |(name, _): &(&str, bool)| format!("{name}.workspace = true\n");
        Package {
            name: name.into(),
            folder: format!("crates/{name}"),
            manifest: format!(
                "[package]\n[lints]\nworkspace = true\n[dependencies]\n{}",
                dependencies.iter().map(line).collect::<String>()
            ),
            dependencies: dependencies
                .iter()
                .map(|&(name, only_in_tests)| Dependency {
                    name: name.into(),
                    only_in_tests,
                    optional: false,
                })
                .collect(),
            features: BTreeMap::new(),
        }
    }

    #[track_caller]
    fn bites(from: &str, to: &str, rule: &str) {
        let packages = [package(from, &[(to, false)]), package(to, &[])];
        let findings = check(&packages);
        assert_eq!(findings.len(), 1, "{from} -> {to}: {findings:?}");
        assert_eq!(findings[0].rule, rule);
        assert_eq!(findings[0].file, format!("crates/{from}/Cargo.toml"));
        assert_eq!(findings[0].line, 5);
    }

    #[test]
    fn every_arrow_that_points_up_is_named() {
        bites("pf-classic", "pf-rfd", "2-planner-to-planner");
        bites(
            "pf-classic",
            "pf-conformance",
            "3-conformance-only-in-tests",
        );
        bites("pf-render", "pf-classic", "6-drawing-and-planning-apart");
        bites("pf-classic", "pf-render", "6-drawing-and-planning-apart");
        bites("pf-io", "pf-cli", "7-library-to-tool");
        bites("pf-grid", "xtask", "7-library-to-tool");
        bites("pf-conformance", "pf-classic", "8-conformance-to-planner");
        bites("pf-core", "pf-grid", "arrows-point-down");
        bites("pf-grid", "pf-geom", "arrows-point-down");
        bites("pf-grid", "pf-classic", "arrows-point-down");
        bites("pf-planners", "pf-cli", "arrows-point-down");
    }

    #[test]
    fn foreign_crates_have_their_place() {
        let findings = |from: &str, to: &str| check(&[package(from, &[(to, false)])]);
        assert_eq!(findings("pf-core", "serde")[0].rule, "1-core-stays-lean");
        let parry = findings("pf-classic", "parry2d-f64");
        assert_eq!(parry[0].rule, "4-parry-only-in-geom");
        assert_eq!(findings("pf-core", "rand"), []);
        assert_eq!(findings("pf-geom", "parry2d-f64"), []);
    }

    #[test]
    fn arrows_that_point_down_are_fine() {
        let below = [("pf-core", false), ("pf-grid", false)];
        let all = |name: &str, more: &[(&str, bool)]| package(name, &[&below, more].concat());
        let packages = [
            package("pf-core", &[("rand", false), ("proptest", true)]),
            package("pf-grid", &below[..1]),
            all("pf-geom", &[]),
            all(
                "pf-classic",
                &[("pf-geom", false), ("pf-conformance", true)],
            ),
            all("pf-conformance", &[("pf-geom", false)]),
            all("pf-render", &[]),
            all(
                "pf-planners",
                &[("pf-classic", false), ("pf-render", false)],
            ),
            all("pf-cli", &[("pf-planners", false), ("pf-bench", false)]),
            all("pf-bench", &[("pf-classic", false)]),
            all("xtask", &[("pf-cli", false), ("pf-tests", false)]),
            all("pf-tests", &[]),
        ];
        assert_eq!(check(&packages), []);
    }

    #[test]
    fn a_default_feature_that_adds_a_dependency_is_found_however_it_is_written() {
        for (feature, bad) in [
            ("serde", true),
            ("dep:serde", true),
            ("serde/derive", true),
            ("serde?/derive", false),
            ("std", false),
            ("more", true),
        ] {
            let mut package = package("pf-aco", &[("serde", false)]);
            package.dependencies[0].optional = true;
            package.features = BTreeMap::from([
                ("default".into(), vec![feature.into()]),
                ("more".into(), vec!["dep:serde".into()]),
                ("std".into(), vec![]),
            ]);
            let rules: Vec<_> = check(&[package]).iter().map(|f| f.rule).collect();
            let expected: &[&str] = if bad {
                &["10-lean-default-features"]
            } else {
                &[]
            };
            assert_eq!(rules, expected, "{feature}");
        }
    }

    #[test]
    fn a_package_without_the_workspace_lints_is_found() {
        let mut package = package("pf-aco", &[]);
        package.manifest = "[package]\nname = \"pf-aco\"\n".into();
        assert_eq!(check(&[package])[0].rule, "lints-are-inherited");
    }
}
