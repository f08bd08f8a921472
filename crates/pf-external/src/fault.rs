//! What another program may do wrong.

/// What a program did wrong, in words for its author.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The command is none, or cannot be run.
    #[error("`{command}` does not start: {why}")]
    NotStarted {
        /// The command.
        command: String,
        /// Why.
        why: String,
    },
    /// It took too long.
    #[error("gave no answer within {seconds} s, and was stopped")]
    Hung {
        /// The limit.
        seconds: f64,
    },
    /// It ended, or closed its output, when an answer was due.
    #[error("crashed: {status}{}", last_words(.said))]
    Crashed {
        /// How it ended.
        status: String,
        /// The end of what it wrote to standard error.
        said: String,
    },
    /// It printed what is no answer.
    #[error("printed `{line}`, expected {expected}")]
    Garbage {
        /// The beginning of the line.
        line: String,
        /// What would have been an answer.
        expected: String,
    },
    /// Its solution breaks a rule of the problem.
    #[error("its path is none: {0}")]
    BadPath(String),
    /// It says what is not so.
    #[error("says that its path costs {said}, and it costs {judged}")]
    WrongCost {
        /// What it says.
        said: f64,
        /// What the judge says.
        judged: f64,
    },
}

fn last_words(said: &str) -> String {
    let said = said.trim();
    if said.is_empty() {
        return String::new();
    }
    format!("; it said: {said}")
}
