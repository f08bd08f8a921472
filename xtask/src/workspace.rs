//! What the workspace consists of: its root, its tracked files, its packages.

use anyhow::{Context as _, Result, bail};
use cargo_metadata::{DependencyKind, MetadataCommand};
use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// Where the workspace lies.
pub(crate) fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// A package, as far as the rules look at it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Package {
    pub(crate) name: String,
    /// Its folder, relative to the root.
    pub(crate) folder: String,
    /// The text of its Cargo.toml.
    pub(crate) manifest: String,
    pub(crate) dependencies: Vec<Dependency>,
    pub(crate) features: BTreeMap<String, Vec<String>>,
}

/// A line of a `[dependencies]` table.
#[derive(Clone, Debug, Default)]
pub(crate) struct Dependency {
    pub(crate) name: String,
    pub(crate) only_in_tests: bool,
    pub(crate) optional: bool,
}

/// A file under version control.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    /// Relative to the root.
    pub(crate) path: String,
    /// Empty if it is not text.
    pub(crate) text: String,
}

impl Source {
    /// Whether the file's name ends so.
    pub(crate) fn is_a(&self, ending: &str) -> bool {
        Path::new(&self.path)
            .extension()
            .is_some_and(|e| e == ending)
    }
}

/// The members of the workspace at `root`.
pub(crate) fn packages(root: &Path) -> Result<Vec<Package>> {
    let metadata = MetadataCommand::new()
        .manifest_path(root.join("Cargo.toml"))
        .no_deps()
        .exec()?;
    let read = |package: cargo_metadata::Package| {
        let folder = package
            .manifest_path
            .parent()
            .and_then(|folder| folder.strip_prefix(&metadata.workspace_root).ok())
            .with_context(|| format!("{} lies outside the workspace", package.name))?;
        let dependencies = package.dependencies.iter().map(|dependency| Dependency {
            name: dependency.name.clone(),
            only_in_tests: dependency.kind == DependencyKind::Development,
            optional: dependency.optional,
        });
        Ok(Package {
            name: package.name.to_string(),
            folder: folder.to_string().replace('\\', "/"),
            manifest: fs::read_to_string(&package.manifest_path)?,
            dependencies: dependencies.collect(),
            features: package.features.clone(),
        })
    };
    metadata.packages.into_iter().map(read).collect()
}

/// The paths under version control, and those about to be: everything that is not ignored.
pub(crate) fn tracked(root: &Path) -> Result<Vec<String>> {
    let output = Command::new("git")
        .args([
            "ls-files",
            "-z",
            "--cached",
            "--others",
            "--exclude-standard",
        ])
        .current_dir(root)
        .output()
        .context("cannot start git")?;
    if !output.status.success() {
        bail!("git ls-files: {}", String::from_utf8_lossy(&output.stderr));
    }
    let paths = String::from_utf8(output.stdout).context("a file name is not UTF-8")?;
    let there = |path: &&str| !path.is_empty() && root.join(path).is_file();
    Ok(paths.split('\0').filter(there).map(str::to_owned).collect())
}

/// The tracked files; of one that is not text only the name.
pub(crate) fn sources(root: &Path) -> Result<Vec<Source>> {
    let mut sources = Vec::new();
    for path in tracked(root)? {
        let text = String::from_utf8(fs::read(root.join(&path))?).unwrap_or_default();
        sources.push(Source { path, text });
    }
    Ok(sources)
}

/// Writes a file of the workspace by way of a temporary one, so that nothing is ever half written.
pub(crate) fn write(path: &Path, text: &str) -> Result<()> {
    let folder: PathBuf = path.parent().context("no folder to write to")?.into();
    fs::create_dir_all(&folder)?;
    let file = tempfile::NamedTempFile::new_in(folder)?;
    fs::write(file.path(), text)?;
    file.persist(path)?;
    Ok(())
}
