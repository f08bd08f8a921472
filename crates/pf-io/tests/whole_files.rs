//! How files come to be: links, files without names, and ends in haste.

use pf_io::{between_writes, write_whole};
use std::fs;

#[cfg(unix)]
#[test]
fn a_link_stays_one_and_the_file_it_leads_to_is_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let (file, link) = (folder.path().join("a.txt"), folder.path().join("link"));
    fs::write(&file, "a long old text").unwrap();
    std::os::unix::fs::symlink(&file, &link).unwrap();
    write_whole(&link, |out| write!(out, "new")).unwrap();
    assert_eq!(fs::read_to_string(&file).unwrap(), "new");
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_without_a_name_is_written_where_it_is() {
    use std::{io::Read, os::fd::AsRawFd};
    // As `/dev/stdout` may be one.
    let mut file = tempfile::tempfile().unwrap();
    let path = format!("/proc/self/fd/{}", file.as_raw_fd());
    write_whole(path.as_ref(), |out| write!(out, "new")).unwrap();
    let mut text = String::new();
    file.read_to_string(&mut text).unwrap();
    assert_eq!(text, "new");
}

#[test]
fn who_ends_in_haste_waits_until_the_file_is_whole() {
    use std::{sync::mpsc, thread};
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.txt");
    let (began, begins) = mpsc::channel();
    let (go_on, goes_on) = mpsc::channel::<()>();
    thread::scope(|scope| {
        let path = &file;
        scope.spawn(move || {
            write_whole(path, |out| {
                out.write_all(b"half and ")?;
                began.send(()).unwrap();
                goes_on.recv().unwrap();
                out.write_all(b"half")
            })
            .unwrap();
        });
        begins.recv().unwrap();
        // The end is asked for while half is written, and the other half comes a little later.
        scope.spawn(move || {
            thread::sleep(std::time::Duration::from_millis(50));
            go_on.send(()).unwrap();
        });
        let found = between_writes(|| fs::read_dir(folder.path()).unwrap().count());
        let text = fs::read_to_string(&file).unwrap_or_default();
        assert_eq!((found, text.as_str()), (1, "half and half"));
    });
}
