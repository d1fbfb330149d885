//! The graph of nav2's Route Server: GeoJSON points and directed edges.

use serde_json::{Value, json};

use super::{ExportError, node_names, roadmap};
use crate::account::PlacesAccount;

/// A roadmap as a graph that nav2's Route Server loads. It drives straight from node to node, so that the corners of a
/// way are nodes, too; each way is two edges, one for each direction, and all ids are different.
///
/// # Errors
/// If there is no way.
pub fn nav2_graph(account: &PlacesAccount) -> Result<String, ExportError> {
    let roadmap = roadmap(account)?;
    let names = node_names(account, roadmap);
    let mut points: Vec<([f64; 2], Value)> = roadmap
        .nodes
        .iter()
        .zip(names)
        .map(|(node, name)| (node.position, json!({ "name": name, "kind": node.kind })))
        .collect();
    let mut legs = Vec::new();
    for way in &roadmap.ways {
        let [from, to] = way.ends.map(|end| end as usize);
        let inner = way.line.len().saturating_sub(2);
        let first = points.len();
        points
            .extend(way.line.iter().skip(1).take(inner).map(|&corner| (corner, json!({ "kind": "corner" }))));
        let chain: Vec<usize> =
            std::iter::once(from).chain(first..first + inner).chain(std::iter::once(to)).collect();
        legs.extend(chain.windows(2).map(|pair| ([pair[0], pair[1]], way.width)));
    }
    let mut features: Vec<Value> = (0..)
        .zip(&points)
        .map(|(id, (position, metadata)): (u64, _)| {
            json!({
                "type": "Feature",
                "properties": { "id": id, "frame": "map", "metadata": metadata },
                "geometry": { "type": "Point", "coordinates": position },
            })
        })
        .collect();
    let directed = legs.iter().flat_map(|&([a, b], width)| [([a, b], width), ([b, a], width)]);
    for (id, ([from, to], width)) in (points.len() as u64..).zip(directed) {
        let [start, end] = [points[from].0, points[to].0];
        let length = (start[0] - end[0]).hypot(start[1] - end[1]);
        features.push(json!({
            "type": "Feature",
            "properties": {
                "id": id, "startid": from as u64, "endid": to as u64, "cost": length, "overridable": true,
                "metadata": { "width": width },
            },
            "geometry": { "type": "MultiLineString", "coordinates": [[start, end]] },
        }));
    }
    let graph = json!({ "type": "FeatureCollection", "name": account.name, "features": features });
    Ok(graph.to_string() + "\n")
}
