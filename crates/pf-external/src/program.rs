//! A program that answers a line with a line.

use crate::Fault;
use std::{
    io::{BufRead, BufReader, Read, Write},
    process::{Child, Command, Stdio},
    sync::{Arc, Mutex, mpsc},
    thread,
    time::Duration,
};

/// The longest line that is read: a path of some millions of cells.
const LONGEST: u64 = 64 << 20;
/// How much of what a program complains is kept.
const COMPLAINTS: usize = 2000;
/// How often somebody who waits looks whether to go on.
const LOOK: Duration = Duration::from_millis(20);
/// How long a program that closed its output may take to end.
const LAST: Duration = Duration::from_millis(500);

/// A program that runs. Reading and writing have threads of their own: a program that neither reads
/// nor writes stops nobody.
#[derive(Debug)]
pub(crate) struct Program {
    child: Child,
    questions: mpsc::Sender<Vec<u8>>,
    answers: mpsc::Receiver<Vec<u8>>,
    complaints: Arc<Mutex<Vec<u8>>>,
}

/// Why there is no answer.
pub(crate) enum Silence {
    /// Whoever asked does not want it any more.
    Unwanted,
    Fault(Fault),
}

impl Program {
    pub(crate) fn start(command: &str) -> Result<Self, Fault> {
        let failed = |why: String| Fault::NotStarted {
            command: command.to_owned(),
            why,
        };
        let words = shell_words::split(command).map_err(|error| failed(error.to_string()))?;
        let Some((name, args)) = words.split_first() else {
            return Err(failed("expected a command".into()));
        };
        let mut program = Command::new(name);
        #[cfg(unix)]
        {
            // What it starts itself goes with it.
            use std::os::unix::process::CommandExt;
            program.process_group(0);
        }
        let mut child = program
            .args(args)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| failed(error.to_string()))?;
        let missing = || failed("its input and output are not there".into());
        let stdin = child.stdin.take().ok_or_else(missing)?;
        let stdout = child.stdout.take().ok_or_else(missing)?;
        let stderr = child.stderr.take().ok_or_else(missing)?;
        let complaints = Arc::default();
        Ok(Self {
            child,
            questions: writer(stdin),
            answers: reader(stdout),
            complaints: listener(stderr, &complaints),
        })
    }

    /// Its answer to a question within a limit, as long as it is to `go_on`.
    pub(crate) fn ask(
        &mut self,
        question: Vec<u8>,
        limit: Duration,
        mut go_on: impl FnMut() -> bool,
    ) -> Result<Vec<u8>, Silence> {
        // If nobody takes it, the program has ended, and the answer says so.
        let _ = self.questions.send(question);
        let mut waited = Duration::ZERO;
        loop {
            let wait = LOOK.min(limit.saturating_sub(waited));
            match self.answers.recv_timeout(wait) {
                Ok(line) => return Ok(line),
                Err(mpsc::RecvTimeoutError::Disconnected) => {
                    return Err(Silence::Fault(self.last_words()));
                }
                Err(mpsc::RecvTimeoutError::Timeout) => {}
            }
            waited += wait;
            if !go_on() {
                return Err(Silence::Unwanted);
            }
            if waited >= limit {
                let seconds = limit.as_secs_f64();
                return Err(Silence::Fault(Fault::Hung { seconds }));
            }
        }
    }

    /// How it ended, and what it said last.
    fn last_words(&mut self) -> Fault {
        let mut waited = Duration::ZERO;
        let status = loop {
            match self.child.try_wait() {
                Ok(Some(status)) => break status.to_string(),
                Ok(None) if waited < LAST => {
                    thread::sleep(LOOK);
                    waited += LOOK;
                }
                _ => break "it closed its output".into(),
            }
        };
        // Its complaints are read by another thread.
        thread::sleep(LOOK);
        let said = self.complaints.lock().map_or_else(
            |_| String::new(),
            |said| String::from_utf8_lossy(&said).into_owned(),
        );
        Fault::Crashed { status, said }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // It may have ended already, or have left others behind.
        #[cfg(unix)]
        let _ = rustix::process::kill_process_group(
            rustix::process::Pid::from_child(&self.child),
            rustix::process::Signal::KILL,
        );
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn writer(mut to: impl Write + Send + 'static) -> mpsc::Sender<Vec<u8>> {
    let (questions, lines) = mpsc::channel::<Vec<u8>>();
    thread::spawn(move || {
        for line in lines {
            if to.write_all(&line).and_then(|()| to.flush()).is_err() {
                return;
            }
        }
    });
    questions
}

fn reader(from: impl Read + Send + 'static) -> mpsc::Receiver<Vec<u8>> {
    // Who says more than it was asked for waits until somebody listens.
    let (lines, answers) = mpsc::sync_channel(1);
    thread::spawn(move || {
        let mut from = BufReader::new(from);
        loop {
            let mut line = Vec::new();
            let read = (&mut from).take(LONGEST).read_until(b'\n', &mut line);
            if !matches!(read, Ok(1..)) || lines.send(line).is_err() {
                return;
            }
        }
    });
    answers
}

/// Keeps the end of what comes.
fn listener(
    mut from: impl Read + Send + 'static,
    complaints: &Arc<Mutex<Vec<u8>>>,
) -> Arc<Mutex<Vec<u8>>> {
    let kept = Arc::clone(complaints);
    thread::spawn(move || {
        let mut buffer = [0; 4096];
        while let Ok(read @ 1..) = from.read(&mut buffer) {
            let Ok(mut kept) = kept.lock() else { return };
            kept.extend_from_slice(&buffer[..read]);
            let over = kept.len().saturating_sub(COMPLAINTS);
            kept.drain(..over);
        }
    });
    Arc::clone(complaints)
}
