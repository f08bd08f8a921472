//! One page that needs nothing else.

use super::{Report, escaped};
use std::fmt::Write;

const STYLE: &str = "\
body { font: 15px/1.5 'DejaVu Sans', Verdana, sans-serif; margin: 0 auto; max-width: 68em; padding: 1em;
  color: #24292f; background: #fff; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 2em; }
p { max-width: 48em; color: #444b55; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .87em; }
td, th { padding: .2em .7em; text-align: right; border-bottom: 1px solid #d9dde3; white-space: nowrap; }
td.name, th.name { text-align: left; }
figure { margin: 2em 0; } figcaption { font-weight: bold; font-size: 1.15em; margin-bottom: .3em; }
svg { max-width: 100%; height: auto; }
";

pub(crate) fn page(report: &Report) -> String {
    let title = escaped(&report.title);
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>{STYLE}</style></head><body>\n<h1>{title}</h1>\n<p>{}</p>\n",
        escaped(&report.words)
    );
    let last = |name: &str| name == "pairs-by-problem";
    let (ends, begins): (Vec<_>, Vec<_>) = report.tables.iter().partition(|t| last(t.name));
    page.extend(begins.iter().map(|table| table.html()));
    for figure in &report.figures {
        // Writing to a string does not fail.
        let _ = write!(
            page,
            "<figure><figcaption>{}</figcaption>\n{}\n<p>{}</p></figure>\n",
            escaped(&figure.title),
            figure.svg,
            escaped(&figure.words)
        );
    }
    page.extend(ends.iter().map(|table| table.html()));
    page.push_str("</body></html>\n");
    page
}
