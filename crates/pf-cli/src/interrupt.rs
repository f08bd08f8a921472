use crate::failure::{Failure, Status};
use pf_core::CancelToken;
use pf_io::between_writes;

/// A token that Ctrl-C cancels: planners stop and the best so far is reported. A second Ctrl-C
/// ends the program at once, or as soon as a file that is being written is whole.
pub(crate) fn token() -> Result<CancelToken, Failure> {
    let token = CancelToken::default();
    let pressed = token.clone();
    ctrlc::set_handler(move || {
        if pressed.is_cancelled() {
            between_writes(|| std::process::exit(i32::from(Status::Interrupted.code())));
        }
        pressed.cancel();
    })
    .map_err(|error| Failure::Internal(format!("cannot listen to Ctrl-C: {error}")))?;
    Ok(token)
}
