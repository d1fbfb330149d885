//! How much of the tree best-first with proof expands, and how far it goes.

use std::error::Error;
use std::time::Duration;

use hssh_search::{Limits, Mapper, Order, Score};
use hssh_topology::Axioms;
use hssh_world::{grid, snake, thesis_3x4};

use crate::table::{aligned, grouped};

/// A grid: rows, columns, planarity, the bound on places, and whether a complete search can finish.
struct Case {
    rows: u32,
    columns: u32,
    planar: bool,
    max_places: Option<u32>,
    complete: bool,
}

const fn case(size: (u32, u32), planar: bool, max_places: Option<u32>, complete: bool) -> Case {
    Case { rows: size.0, columns: size.1, planar, max_places, complete }
}

const CASES: [Case; 18] = [
    case((3, 3), false, None, true),
    case((3, 3), true, None, true),
    case((3, 4), false, None, true),
    case((3, 4), true, None, true),
    case((4, 4), false, Some(16), true),
    case((4, 4), true, Some(16), true),
    case((4, 4), false, None, true),
    case((4, 4), true, None, true),
    case((5, 5), true, Some(25), true),
    case((5, 5), true, None, false),
    case((5, 5), false, Some(25), false),
    case((5, 5), false, None, false),
    case((6, 6), true, Some(36), false),
    case((6, 6), true, None, false),
    case((7, 7), true, Some(49), false),
    case((7, 7), true, None, false),
    case((8, 8), true, Some(64), false),
    case((8, 8), true, None, false),
];

/// What a search with proof may use besides its time.
const BYTES: u64 = 4_000_000_000;

/// Each grid by both searches on one thread, the search with proof within the limit.
pub(crate) fn run(limit: Duration) -> Result<(), Box<dyn Error>> {
    println!(
        "Nodes expanded by a complete search, where it finishes, and by best-first with proof within {} s.\n",
        limit.as_secs()
    );
    let heads =
        ["", "complete", "seconds", "with proof", "seconds", "optimal", "best (f1, f2, f3)", "open from"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for case in &CASES {
        rows.push(row(case, limit)?);
    }
    println!("{}", aligned(&rows));
    Ok(())
}

fn row(case: &Case, limit: Duration) -> Result<Vec<String>, Box<dyn Error>> {
    let Case { rows, columns, planar, max_places, complete } = *case;
    let world = grid(rows, columns, 8.0)?;
    let places = if (rows, columns) == (3, 4) { thesis_3x4() } else { snake(rows, columns) };
    let exploration = world.explore(&world.route_through(&places)?)?;
    let axioms = Axioms { max_genus: planar.then_some(0), max_places, ..Axioms::default() };

    let bound = max_places.map_or_else(String::new, |most| format!(" ≤ {most}"));
    let mut cells = vec![format!("{rows}×{columns}{}{bound}", if planar { " planar" } else { "" })];
    let counted = complete.then(|| Mapper::builder().axioms(axioms).count(&exploration));
    match counted.transpose()? {
        Some(report) => cells.extend([grouped(report.expanded), format!("{:.3}", report.seconds)]),
        None => cells.extend(["–".to_owned(), "–".to_owned()]),
    }
    let limits = Limits { time: Some(limit), bytes: Some(BYTES), ..Limits::default() };
    let report =
        Mapper::builder().axioms(axioms).order(Order::Proof).limits(limits).explain(&exploration)?.report();
    let show = |score: Option<Score>| match score {
        Some(Score::Measure(m)) => format!("({}, {}, {})", m.undetermined_boundaries, m.paths, m.places),
        _ => "none".to_owned(),
    };
    let known = report.proof.ok_or("a search by a bound has a proof")?;
    let optimal = if known.proved { grouped(report.finals.optimal) } else { report.stop.to_string() };
    cells.extend([
        grouped(report.expanded),
        format!("{:.3}", report.seconds),
        optimal,
        show(known.best),
        show(known.open_bound),
    ]);
    Ok(cells)
}
