//! `cargo xtask new-planner`: a crate that compiles, for a planner that is still to be written.

use crate::{
    steps::{Verdict, cargo, passes},
    workspace::{self, root},
};
use anyhow::{Context as _, Result, bail, ensure};
use std::{fs, path::Path};
use toml_edit::{Array, DocumentMut, InlineTable, Item, Value};

#[derive(clap::Args)]
pub(crate) struct Args {
    /// The crate's name, as in `pf-wave`: lower case, words joined by `-`
    #[arg(value_parser = Names::of)]
    name: Names,
    /// What it plans on
    #[arg(long)]
    on: On,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum On {
    /// Grids: `Planner<GridProblem>`
    Grid,
    /// Worlds of shapes; comes with pf-geom
    World,
    /// Several robots; comes with pf-geom
    Team,
}

/// What a new crate consists of; `{crate}`, `{lib}`, `{type}` and `{name}` stand for its names.
const FILES: [(&str, &str); 4] = [
    ("Cargo.toml", include_str!("new_planner/Cargo.toml.in")),
    ("README.md", include_str!("new_planner/README.md.in")),
    ("src/lib.rs", include_str!("new_planner/lib.rs.in")),
    (
        "tests/conformance.rs",
        include_str!("new_planner/conformance.rs.in"),
    ),
];

pub(crate) fn run(args: &Args) -> Result<Verdict> {
    if args.on != On::Grid {
        let kind = format!("{:?}", args.on).to_lowercase();
        bail!("planners on a {kind} come with pf-geom, which is not there yet; `--on grid` is");
    }
    let names = &args.name;
    generate(root(), names)?;
    println!(
        "Made crates/{0}, listed in Cargo.toml. Now:\n\
         \x20 cargo test -p {0}    # fails at the law its planner breaks, until it is written\n\
         \x20 crates/{0}/src/lib.rs: write `{1}::plan`, claim only what it keeps\n\
         \x20 crates/pf-planners: one line makes it known to pf (see CONTRIBUTING.md)",
        names.package, names.kind
    );
    Ok(Verdict::Passed)
}

/// The names of one planner.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Names {
    /// `pf-wave-front`
    package: String,
    /// `pf_wave_front`
    library: String,
    /// `WaveFront`
    kind: String,
    /// `wave-front`
    short: String,
}

impl Names {
    fn of(package: &str) -> Result<Self> {
        let short = package.strip_prefix("pf-").unwrap_or(package);
        let word = |word: &str| {
            let signs = word.chars();
            !word.is_empty() && { signs }.all(|c| c.is_ascii_lowercase() || c.is_ascii_digit())
        };
        ensure!(
            short.starts_with(|c: char| c.is_ascii_lowercase())
                && short.split('-').all(word)
                && package.len() <= 64,
            "`{package}` is no name for a crate here: expected words of a-z and 0-9 joined by `-`, \
             as in pf-wave"
        );
        // What would hide the language's own crates, or is none of ours to take.
        let taken = ["alloc", "core", "proc-macro", "std", "test"];
        ensure!(
            !taken.contains(&package),
            "`{package}` is a crate of the language"
        );
        let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
        Ok(Self {
            package: package.to_owned(),
            library: package.replace('-', "_"),
            kind: short.split('-').map(capital).collect(),
            short: short.to_owned(),
        })
    }

    fn fill_in(&self, template: &str) -> String {
        template
            .replace("{crate}", &self.package)
            .replace("{lib}", &self.library)
            .replace("{type}", &self.kind)
            .replace("{name}", &self.short)
    }
}

/// Makes the crate in the workspace at `root`, whole or not at all.
fn generate(root: &Path, names: &Names) -> Result<()> {
    let package = &names.package;
    let folder = root.join("crates").join(package);
    ensure!(!folder.exists(), "crates/{package} is there already");
    let manifest = root.join("Cargo.toml");
    let text = fs::read_to_string(&manifest)?;
    let text = with_member(&text, package)?;

    fs::create_dir_all(root.join("target"))?;
    let draft = tempfile::tempdir_in(root.join("target"))?;
    for (path, template) in FILES {
        workspace::write(&draft.path().join(path), &names.fill_in(template))?;
    }
    fs::rename(draft.keep(), &folder).with_context(|| format!("crates/{package}"))?;
    workspace::write(&manifest, &text)?;
    // Names differ in length, so lines do. Without rustfmt they stay as they are.
    let _ = cargo(["fmt", "--package", package])
        .current_dir(root)
        .output();
    Ok(())
}

/// The workspace's manifest with one more planner among its members and dependencies.
fn with_member(manifest: &str, package: &str) -> Result<String> {
    let mut document: DocumentMut = manifest.parse()?;
    let workspace = document["workspace"]
        .as_table_mut()
        .context("Cargo.toml has no [workspace]")?;

    let dependencies = workspace["dependencies"]
        .as_table_mut()
        .context("Cargo.toml has no [workspace.dependencies]")?;
    ensure!(
        !dependencies.contains_key(package),
        "there is a crate {package} already"
    );
    let mut line = InlineTable::new();
    line.insert("path", format!("crates/{package}").into());
    line.insert("version", "0.1.0".into());
    dependencies.insert(package, Item::Value(Value::InlineTable(line)));

    let members = workspace["default-members"]
        .as_array_mut()
        .context("Cargo.toml has no default-members")?;
    insert_line(members, &format!("crates/{package}"));
    Ok(document.to_string())
}

/// Puts `entry` behind the last crate of an array that is written one entry a line.
fn insert_line(array: &mut Array, entry: &str) {
    let is_crate = |value: &Value| {
        let path = value.as_str();
        path.is_some_and(|path| path.starts_with("crates/"))
    };
    let crates = array
        .iter()
        .enumerate()
        .filter(|(_, value)| is_crate(value));
    let at = crates.last().map_or(0, |(last, _)| last + 1);
    let mut value = Value::from(entry);
    value.decor_mut().set_prefix("\n    ");
    array.insert_formatted(at, value);
}

/// Makes a planner in a copy of the workspace, and sees that it is clean, that its README's example
/// works, and that its conformance test fails for the right reason.
pub(crate) fn rehearse() -> Result<Verdict> {
    const NAME: &str = "pf-rehearsal";
    let copy = root().join("target/rehearsal");
    if copy.exists() {
        fs::remove_dir_all(&copy)?;
    }
    for path in workspace::tracked(root())? {
        let to = copy.join(&path);
        fs::create_dir_all(to.parent().context("a file has a folder")?)?;
        fs::copy(root().join(&path), to)?;
    }
    generate(&copy, &Names::of(NAME)?)?;
    let command = |args: &[&str]| {
        let mut command = cargo(args);
        command
            .current_dir(&copy)
            .env("CARGO_TARGET_DIR", root().join("target"));
        command
    };
    for clean in [
        &["fmt", "--package", NAME, "--check"][..],
        &[
            "clippy",
            "--quiet",
            "-p",
            NAME,
            "--all-targets",
            "--",
            "-D",
            "warnings",
        ],
        &["test", "--quiet", "-p", NAME, "--doc"],
    ] {
        if passes(&mut command(clean))? == Verdict::Failed {
            return Ok(Verdict::Failed);
        }
    }
    let test = command(&["test", "--quiet", "-p", NAME, "--test", "conformance"]).output()?;
    let said = String::from_utf8_lossy(&test.stdout) + String::from_utf8_lossy(&test.stderr);
    let bites = !test.status.success() && said.contains("laws broken") && said.contains("complete");
    if !bites {
        println!("{said}\nthe conformance test of an unwritten planner must fail at `complete`");
    }
    Ok(Verdict::passed_if(bites))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_follow_from_the_crate() {
        let names = Names::of("pf-wave-front").unwrap();
        assert_eq!(names.fill_in("{crate} {lib} {type} {name}"), {
            "pf-wave-front pf_wave_front WaveFront wave-front"
        });
        assert_eq!(Names::of("bug2").unwrap().kind, "Bug2");
    }

    #[test]
    fn nonsense_names_are_refused() {
        for name in [
            "", "-", "pf-", "Pf-Wave", "pf_wave", "pf-2d", "pf--x", "x/../y", "wave ", "wäve",
            "core",
        ] {
            let error = Names::of(name).unwrap_err().to_string();
            assert!(error.contains(&format!("`{name}`")), "{error}");
        }
        assert!(Names::of(&"x".repeat(65)).is_err());
    }

    #[test]
    fn the_manifest_gains_two_lines_and_keeps_the_rest() {
        let before = fs::read_to_string(root().join("Cargo.toml")).unwrap();
        let after = with_member(&before, "pf-wave").unwrap();
        let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
        let (old, mut new) = (lines(&before), lines(&after));
        let gained = [
            "    \"crates/pf-wave\",",
            "pf-wave = { path = \"crates/pf-wave\", version = \"0.1.0\" }",
        ];
        for line in gained {
            let at = new.iter().position(|l| l == line);
            new.remove(at.unwrap_or_else(|| panic!("no {line} in {after}")));
        }
        assert_eq!(old, new);
        let twice = with_member(&after, "pf-wave").unwrap_err().to_string();
        assert!(twice.contains("already"), "{twice}");
    }

    #[test]
    fn nothing_is_overwritten() {
        let core = Names::of("pf-core").unwrap();
        let error = generate(root(), &core).unwrap_err().to_string();
        assert_eq!(error, "crates/pf-core is there already");
    }
}
