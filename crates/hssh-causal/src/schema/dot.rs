//! The view graph as Graphviz DOT: views as nodes, schemas as edges, contradictions in red.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::{Action, Trace, View};

/// The views of a trace with their numbers, in the order of sight.
#[must_use]
pub fn numbered_views(trace: &Trace) -> BTreeMap<&View, u32> {
    let mut numbers = BTreeMap::new();
    for view in trace.views() {
        let next = numbers.len() as u32 + 1;
        numbers.entry(view).or_insert(next);
    }
    numbers
}

/// The view graph of a trace: one node per view, one edge per different schema, with how often it occurred.
///
/// Where one action leads from one view to different ones, that view belongs to more than one distinctive
/// state. Those edges are red.
#[must_use]
pub fn view_graph_dot(trace: &Trace) -> String {
    let numbers = numbered_views(trace);
    let mut times: BTreeMap<(u32, Action, u32), usize> = BTreeMap::new();
    for schema in trace.schemas() {
        *times.entry((numbers[schema.from], schema.action, numbers[schema.to])).or_default() += 1;
    }
    let mut outcomes: BTreeMap<(u32, Action), usize> = BTreeMap::new();
    times.keys().for_each(|&(from, action, _)| *outcomes.entry((from, action)).or_default() += 1);

    let mut by_number: Vec<(u32, &View)> = numbers.iter().map(|(&view, &number)| (number, view)).collect();
    by_number.sort_unstable();
    let mut dot = String::from(
        "digraph views {\n  node [shape=box, fontname=\"sans-serif\"];\n  edge [fontname=\"sans-serif\"];\n",
    );
    for (number, view) in by_number {
        let text = escaped(&view.to_string());
        let first = if number == 1 { ", penwidth=2" } else { "" };
        let _ = writeln!(dot, "  v{number} [label=\"v{number}\\n{text}\"{first}];");
    }
    for ((from, action, to), times) in &times {
        let often = if *times == 1 { String::new() } else { format!(" ×{times}") };
        let style = if action.is_travel() { "" } else { ", style=dashed" };
        let color = if outcomes[&(*from, *action)] > 1 { ", color=red" } else { "" };
        let _ = writeln!(dot, "  v{from} -> v{to} [label=\"{action}{often}\"{style}{color}];");
    }
    dot + "}\n"
}

fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"")
}
