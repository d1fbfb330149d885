//! An experiment as a table on the terminal: runs side by side, measured beside expected.

use crate::experiment::outcome::{Cell, LEVELS, Outcome};
use crate::experiment::schema::Experiment;
use crate::table::{aligned, grouped};

/// Columns of a terminal.
const WIDTH: usize = 110;

/// The table without anything that depends on the machine.
pub(crate) fn table(experiment: &Experiment, outcomes: &[Outcome]) -> String {
    let mut text = format!("{}\n", experiment.title);
    if !experiment.about.is_empty() {
        text += &format!("{}\n", experiment.about);
    }
    let sources = sources(outcomes);
    let (present, missing): (Vec<_>, Vec<_>) = outcomes.iter().partition(|outcome| outcome.missing.is_none());
    for run in missing {
        let file = run.missing.as_deref().unwrap_or_default();
        text += &format!("\n{}: skipped: needs DATA/{file}; pass --data DATA\n", run.name);
    }
    let mut rest = &present[..];
    while !rest.is_empty() {
        let together = side_by_side(rest, &sources);
        text += &format!("\n{}", block(&rest[..together], &sources));
        rest = &rest[together..];
    }
    for (number, source) in sources.iter().enumerate() {
        text += &format!("{}[{}] {source}\n", if number == 0 { "\n" } else { "" }, number + 1);
    }
    text
}

/// Seconds and speed of each run.
pub(crate) fn times(outcomes: &[Outcome]) -> String {
    let row = |outcome: &Outcome| {
        let report = outcome.report.as_ref()?;
        let speed = grouped((report.nodes as f64 / report.seconds.max(1e-9)) as u64);
        Some(vec![outcome.name.clone(), format!("{:.4} s", report.seconds), format!("{speed} nodes/s")])
    };
    aligned(&outcomes.iter().filter_map(row).collect::<Vec<_>>())
}

/// All sources in the order in which they are first named.
fn sources(outcomes: &[Outcome]) -> Vec<&str> {
    let mut sources: Vec<&str> = Vec::new();
    for claim in outcomes.iter().flat_map(|outcome| &outcome.cells).flat_map(|cell| &cell.expected) {
        if !sources.contains(&claim.source.as_str()) {
            sources.push(&claim.source);
        }
    }
    sources
}

/// How many of the runs fit on a line, at least one.
fn side_by_side(runs: &[&Outcome], sources: &[&str]) -> usize {
    let width = |count: usize| {
        let text = block(&runs[..count], sources);
        let line = |line: &str| line.chars().count();
        text.lines().filter(|line| !line.starts_with(LEVELS)).map(line).max().unwrap_or(0)
    };
    (1..=runs.len()).take_while(|&count| width(count) <= WIDTH).last().unwrap_or(1)
}

fn block(runs: &[&Outcome], sources: &[&str]) -> String {
    let mut quantities: Vec<&str> = Vec::new();
    for cell in runs.iter().flat_map(|run| &run.cells).filter(|cell| cell.quantity != LEVELS) {
        if !quantities.contains(&cell.quantity) {
            quantities.push(cell.quantity);
        }
    }
    let mut columns = vec![left(&quantities)];
    for run in runs {
        let by_quantity = |&quantity: &&str| run.cells.iter().find(|cell| cell.quantity == quantity);
        let cells: Vec<Option<&Cell>> = quantities.iter().map(by_quantity).collect();
        columns.push(column(&run.name, &cells, sources));
    }
    let line = |row: usize| {
        let parts: Vec<&str> = columns.iter().map(|column| column[row].as_str()).collect();
        format!("{}\n", parts.join("   ").trim_end())
    };
    let mut text: String = (0..columns[0].len()).map(line).collect();
    for run in runs {
        for cell in run.cells.iter().filter(|cell| cell.quantity == LEVELS) {
            text += &format!("{LEVELS}, {}: {}  {}\n", run.name, cell.measured, mark(cell, sources));
        }
    }
    text
}

/// The first column: two lines of heads and the names of the rows.
fn left(quantities: &[&str]) -> Vec<String> {
    let names = ["", ""].into_iter().chain(quantities.iter().copied());
    let width = quantities.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    names.map(|name| format!("{name:<width$}")).collect()
}

/// The columns of one run: measured, expected and whether they agree.
fn column(name: &str, cells: &[Option<&Cell>], sources: &[&str]) -> Vec<String> {
    let mut rows = vec![["measured".to_owned(), "expected".to_owned(), String::new()]];
    for cell in cells {
        rows.push(match cell {
            None => Default::default(),
            Some(cell) => {
                let wrong = cell.expected.iter().find(|claim| !claim.holds);
                let shown = wrong.or(cell.expected.first());
                let expected = shown.map_or_else(String::new, |claim| claim.value.clone());
                [cell.measured.clone(), expected, mark(cell, sources)]
            }
        });
    }
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let [first, second, third] = [width(0), width(1), width(2)];
    let body: Vec<String> =
        rows.iter().map(|[a, b, c]| format!("{a:>first$}  {b:>second$}  {c:<third$}")).collect();
    let whole = body[0].chars().count().max(name.chars().count());
    let head = format!("{name:^whole$}");
    std::iter::once(head).chain(body.iter().map(|line| format!("{line:<whole$}"))).collect()
}

/// Whether a value is as expected, and by which sources.
fn mark(cell: &Cell, sources: &[&str]) -> String {
    if cell.expected.is_empty() {
        return String::new();
    }
    let number =
        |named: &str| sources.iter().position(|source| *source == named).map_or(0, |place| place + 1);
    let numbers: String = cell.expected.iter().map(|claim| format!("[{}]", number(&claim.source))).collect();
    format!("{} {numbers}", if cell.agrees() { "ok" } else { "DIFFERS" })
}
