//! One page that needs nothing else.

use super::{Figure, Report, Table, escaped};

const STYLE: &str = "\
body { font: 15px/1.5 'DejaVu Sans', Verdana, sans-serif; margin: 0 auto; max-width: 82em; padding: 1em;
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
    // First what is said in a word or a picture, then the details.
    let figure = |figure: &&Figure| figure.name.starts_with("convergence-");
    let (details, pictures): (Vec<_>, Vec<_>) = report.figures.iter().partition(figure);
    let table = |page: &mut String, name: &str| {
        let tables = report.tables.iter().filter(|table| table.name == name);
        page.extend(tables.map(Table::html));
    };
    table(&mut page, "contenders");
    page.extend(pictures.into_iter().map(drawn));
    for name in ["ranks", "pairs", "problems"] {
        table(&mut page, name);
    }
    page.extend(details.into_iter().map(drawn));
    table(&mut page, "pairs-by-problem");
    page.push_str("</body></html>\n");
    page
}

fn drawn(figure: &Figure) -> String {
    format!(
        "<figure><figcaption>{}</figcaption>\n{}\n<p>{}</p></figure>\n",
        escaped(&figure.title),
        figure.svg,
        escaped(&figure.words)
    )
}
