//! Redlarski, Dabkowski, Palkowski: *Generating optimal paths in dynamic environments using River
//! Formation Dynamics algorithm*. Nine maps, 45 cases in five tables.
//!
//! Table 1 plans; in Tables 2 to 5 the goal moves, obstacles come, go, or much changes at once, each
//! time from the state after Table 1.

mod cases;
mod contenders;
mod figures;
mod heat;
mod measure;
mod report;
mod text;
pub mod tune;

pub use cases::{MAPS, Printed, Published, Story, stories};
pub use contenders::{CONTENDERS, Contender, Live};
pub use figures::{Figure, figures};
pub use measure::{Measured, Options, Row, Said, run};
pub use report::write_report;
pub use text::{summary, tables};
