//! Files that are written whole or not at all.

use crate::FileError;
use std::{
    fs,
    io::{self, BufWriter, Write},
    path::Path,
};

/// Writes a file by way of a temporary one beside it, which takes its name once it is complete:
/// whoever looks sees the old file or the new one, never half of either.
///
/// What exists and is no regular file (`/dev/stdout`) is written directly.
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
    if fs::metadata(path).is_ok_and(|facts| !facts.is_file()) {
        let mut out = BufWriter::new(fs::OpenOptions::new().write(true).open(path)?);
        content(&mut out)?;
        return out.flush();
    }
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".pf-");
    #[cfg(unix)]
    {
        // Temporary files are private by default; this one becomes an ordinary file.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut out = BufWriter::new(builder.tempfile_in(folder)?);
    content(&mut out)?;
    let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.persist(path)?;
    Ok(())
}
