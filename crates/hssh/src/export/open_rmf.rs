//! The navigation graph of Open-RMF.

use std::fmt::Write;

use super::{ExportError, node_names, quoted, roadmap};
use crate::account::PlacesAccount;

/// A roadmap as a navigation graph of Open-RMF: one level, `L1`; lanes lead one way, so that there are two for each
/// straight part of a way; doors are those passages that probably have one.
///
/// # Errors
/// If there is no way.
pub fn open_rmf_graph(account: &PlacesAccount) -> Result<String, ExportError> {
    let roadmap = roadmap(account)?;
    let names = node_names(account, roadmap);
    let door = |node: usize| {
        let passage = roadmap.nodes.get(node).filter(|node| node.kind == "passage")?.number? as usize;
        (account.passages[passage].kind == "door").then(|| names[node].as_str())
    };
    let mut text = format!("building_name: {}\nlevels:\n  L1:\n    vertices:\n", quoted(&account.name));
    for (node, name) in roadmap.nodes.iter().zip(&names) {
        let [x, y] = node.position;
        // Branches are not to be sent to: an empty name.
        let name = if node.kind == "branch" { "" } else { name };
        let _ = writeln!(text, "      - [{x:.3}, {y:.3}, {{name: {}}}]", quoted(name));
    }
    let mut count = roadmap.nodes.len();
    let mut lanes = String::new();
    for way in &roadmap.ways {
        let mut chain = vec![way.ends[0] as usize];
        let inner = way.line.len().saturating_sub(2);
        for [x, y] in way.line.iter().skip(1).take(inner) {
            let _ = writeln!(text, "      - [{x:.3}, {y:.3}, {{name: \"\"}}]");
            chain.push(count);
            count += 1;
        }
        chain.push(way.ends[1] as usize);
        for pair in chain.windows(2) {
            let through = door(pair[0]).or_else(|| door(pair[1]));
            let about = through.map(|name| format!("door_name: {}", quoted(name))).unwrap_or_default();
            let _ = writeln!(lanes, "      - [{}, {}, {{{about}}}]", pair[0], pair[1]);
            let _ = writeln!(lanes, "      - [{}, {}, {{{about}}}]", pair[1], pair[0]);
        }
    }
    text += "    lanes:\n";
    text += &lanes;
    let mut doors = String::new();
    for (number, node) in roadmap.nodes.iter().enumerate() {
        let (Some(name), Some(passage)) = (door(number), node.number) else { continue };
        let [[ax, ay], [bx, by]] = account.passages[passage as usize].gateway.line;
        let _ = writeln!(
            doors,
            "  {}:\n    endpoints: [[{ax:.3}, {ay:.3}], [{bx:.3}, {by:.3}]]\n    map: L1",
            quoted(name)
        );
    }
    text += &if doors.is_empty() { "doors: {}\n".to_owned() } else { format!("doors:\n{doors}") };
    Ok(text + "lifts: {}\n")
}
