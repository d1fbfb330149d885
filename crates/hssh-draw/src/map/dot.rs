//! One map as a Graphviz graph.

use std::fmt::Write;

use hssh_topology::{MapOlp, StarCatalog, TopologicalMap};

use super::{MapOptions, measure_line};
use crate::palette::{Palette, PathStyle};

/// A map in Graphviz's language: links with the names of their ends, in the color of their path; pending
/// gateways as arrows to small points, closed ends as bars. `catalog` holds the stars of the map.
///
/// `neato` and `fdp` draw it well, but Graphviz does not keep the clockwise order of the ends: the labels
/// tell it, [`draw_map`](crate::draw_map) shows it.
///
/// # Panics
/// If a star of the map is not from the catalog.
#[must_use]
pub fn map_to_dot(map: &TopologicalMap, catalog: &StarCatalog, options: &MapOptions) -> String {
    let palette = Palette::of(map);
    let name = |olp: MapOlp| catalog.star(map.star(map.place(olp))).name(map.local(olp));
    let mut dot = String::from("digraph map {\n");
    let label: Vec<String> =
        options.title.iter().cloned().chain(options.measure.then(|| measure_line(map))).collect();
    let _ = writeln!(
        dot,
        "  graph [label={}, fontname=\"Helvetica\", overlap=false, splines=true];",
        quoted(&label.join("\n"))
    );
    dot.push_str("  node [shape=circle, fontname=\"Helvetica\"];\n");
    dot.push_str("  edge [dir=none, fontname=\"Helvetica\", fontsize=9, penwidth=2];\n");

    for place in map.places() {
        let star = options.star_name(map.star(place)).map(|name| format!("\n{name}")).unwrap_or_default();
        let label = quoted(&format!("{place}{star}"));
        let current =
            if options.current == Some(place) { ", style=filled, fillcolor=\"#ffe08a\"" } else { "" };
        let _ = writeln!(dot, "  p{place} [label={label}{current}];");
    }
    for (from, to) in map.links() {
        let (start, end) = (map.place(from), map.place(to));
        let style = style(palette.style(map.path(from)));
        let (tail, head) = (name(from), name(to));
        let _ = writeln!(dot, "  p{start} -> p{end} [taillabel=\"{tail}\", headlabel=\"{head}\", {style}];");
    }
    for olp in map.places().flat_map(|place| map.olps_of(place)) {
        let arrow = match (map.is_pending(olp), map.linked(olp)) {
            (true, _) => "empty",
            (false, None) => "tee",
            (false, Some(_)) => continue,
        };
        let shape =
            if arrow == "empty" { "point, width=0.05" } else { "none, label=\"\", width=0.05, height=0.05" };
        let style = style(palette.style(map.path(olp)));
        let _ = writeln!(dot, "  e{olp} [shape={shape}];");
        let _ = writeln!(
            dot,
            "  p{} -> e{olp} [dir=forward, arrowhead={arrow}, taillabel=\"{}\", len=0.5, {style}];",
            map.place(olp),
            name(olp)
        );
    }
    dot.push_str("}\n");
    dot
}

fn style(PathStyle { color, dashes }: PathStyle) -> String {
    let dashed = match dashes {
        [] => "",
        [long, ..] if *long > 2.0 => ", style=dashed",
        _ => ", style=dotted",
    };
    format!("color=\"{color}\"{dashed}")
}

/// A text as a quoted string of Graphviz's language.
pub(crate) fn quoted(text: &str) -> String {
    let escaped = text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n");
    format!("\"{escaped}\"")
}
