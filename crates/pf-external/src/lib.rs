//! A planner in another program, in any language, asked over JSON lines: a third planner in every
//! comparison, judged like any other.
//!
//! The program is started once and asked a line at a time on its standard input; it answers a line at a
//! time on its standard output. What it writes to its standard error is shown if it crashes. The
//! protocol is described in `docs/external.md`, with a planner of forty lines of Python.
//!
//! Whatever it does is reported and not suffered: a program that does not start, hangs, crashes,
//! prints what is no answer, goes through an obstacle or states a cost that its path has not is a
//! [`Fault`], in a note of the report; the next question starts it anew.

mod fault;
mod planner;
mod program;
mod wire;

pub use fault::Fault;
pub use planner::{External, ExternalParams, FAULT, Introduction};
pub use wire::Wire;
