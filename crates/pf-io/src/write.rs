//! Files that are written whole or not at all, and folders for them.

use crate::FileError;
use std::{
    fs::{self, File},
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
    sync::{PoisonError, RwLock},
};

/// Whoever has a temporary file shares it.
static WRITING: RwLock<()> = RwLock::new(());

/// Writes a file by way of a temporary one beside it, which takes its name once it is complete:
/// whoever looks sees the old file or the new one, never half of either.
///
/// What exists and is no regular file (`/dev/null`, a pipe) is written directly; of a symbolic link the
/// file that it leads to is replaced.
///
/// # Errors
/// [`FileError`] if the file cannot be written; what was there before is still there.
pub fn whole(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), FileError> {
    attempt(path, content).map_err(|error| FileError::io(path, "written", error))
}

fn attempt(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let Some(path) = replaceable(path) else {
        let mut out = BufWriter::new(File::options().write(true).open(path)?);
        content(&mut out)?;
        return out.flush();
    };
    let _writing = WRITING.read().unwrap_or_else(PoisonError::into_inner);
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    // An ordinary file, while those that `tempfile` makes are private; and errors that do not name it.
    let mut builder = tempfile::Builder::new();
    let mut file = builder
        .prefix(".pf-")
        .make_in(folder, |path| File::create_new(path))?;
    let mut out = BufWriter::new(file.as_file_mut());
    content(&mut out)?;
    out.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.persist(path)?;
    Ok(())
}

/// The file that can be replaced by another one; `None` if there is something and it cannot be.
fn replaceable(path: &Path) -> Option<PathBuf> {
    match fs::metadata(path) {
        // `/dev/stdout` is a link that may lead to a regular file, and perhaps to one without a name.
        Ok(facts) if facts.is_file() => fs::canonicalize(path).ok(),
        Ok(_) => None,
        Err(_) => Some(path.to_owned()),
    }
}

/// Does something while no file is being [written](whole) and none begins to be: what a program does that
/// ends at once and would leave a temporary file behind.
pub fn between_writes<T>(action: impl FnOnce() -> T) -> T {
    let _nobody = WRITING.write().unwrap_or_else(PoisonError::into_inner);
    action()
}

/// Makes a folder, and those that it lies in, unless it is there.
///
/// # Errors
/// [`FileError`] if it cannot be made.
pub fn make_folder(path: &Path) -> Result<(), FileError> {
    fs::create_dir_all(path).map_err(|error| FileError::io(path, "made", error))
}
