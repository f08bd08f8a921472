use crate::failure::{Failure, Status};
use pf_core::CancelToken;
use pf_io::between_writes;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether nobody looks at the token any more.
static AT_ONCE: AtomicBool = AtomicBool::new(false);

/// A token that Ctrl-C cancels: planners stop and the best so far is reported. A second Ctrl-C
/// ends the program at once, or as soon as a file that is being written is whole.
pub(crate) fn token() -> Result<CancelToken, Failure> {
    let token = CancelToken::default();
    let pressed = token.clone();
    ctrlc::set_handler(move || {
        let again = pressed.is_cancelled();
        pressed.cancel();
        if again || AT_ONCE.load(Ordering::SeqCst) {
            between_writes(|| std::process::exit(i32::from(Status::Interrupted.code())));
        }
    })
    .map_err(|error| Failure::Internal(format!("cannot listen to Ctrl-C: {error}")))?;
    Ok(token)
}

/// From now on the first Ctrl-C does what the second does otherwise: for work that only reads, draws and
/// writes, and has nothing to report when it is stopped. Says whether it was pressed before.
pub(crate) fn at_once(cancel: &CancelToken) -> bool {
    AT_ONCE.store(true, Ordering::SeqCst);
    cancel.is_cancelled()
}
