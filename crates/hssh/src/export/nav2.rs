//! The graph of nav2's Route Server: GeoJSON points and directed edges.

use serde_json::{Map, Value, json};

use super::drive_graph::{DriveGraph, DriveLeg};

/// A graph that nav2's Route Server loads. It drives straight from node to node, so that the corners of a way are nodes, too; each leg
/// is two edges, one for each direction, and all ids are different. Of the file it reads `features` only.
#[must_use]
pub fn nav2_graph(graph: &DriveGraph<'_>) -> String {
    let points = (0..).zip(&graph.points).map(|(id, point): (u64, _)| {
        let node = graph.routes.nodes.get(id as usize);
        let kind = node.map_or("corner", |node| &node.kind);
        let mut metadata =
            Map::from_iter([("name".to_owned(), json!(point.name)), ("kind".to_owned(), json!(kind))]);
        if let Some(way) = point.way {
            metadata.insert("way".to_owned(), json!(way as u64));
        }
        if let Some(star) = node.and_then(|node| node.star.as_ref()) {
            metadata.insert("star".to_owned(), json!(star));
        }
        json!({
            "type": "Feature",
            "properties": { "id": id, "frame": "map", "metadata": metadata },
            "geometry": { "type": "Point", "coordinates": point.position },
        })
    });
    let directed = graph.legs.iter().flat_map(|leg| {
        let [from, to] = leg.ends;
        [(leg, [from, to]), (leg, [to, from])]
    });
    let edges =
        (graph.points.len() as u64..).zip(directed).map(|(id, (leg, ends))| edge(graph, id, leg, ends));
    let features: Vec<Value> = points.chain(edges).collect();
    let file = json!({
        "type": "FeatureCollection",
        "name": graph.routes.provenance.source,
        "hssh": graph.routes.provenance,
        "features": features,
    });
    file.to_string() + "\n"
}

fn edge(graph: &DriveGraph<'_>, id: u64, leg: &DriveLeg, ends: [usize; 2]) -> Value {
    let way = &graph.routes.ways[leg.way];
    let mut metadata = Map::from_iter([
        ("way".to_owned(), json!(leg.way as u64)),
        ("line".to_owned(), json!(way.origin.name())),
    ]);
    if let Some(width) = way.width.filter(|width| width.is_finite()) {
        metadata.insert("width".to_owned(), json!(width));
    }
    json!({
        "type": "Feature",
        "properties": {
            "id": id,
            "startid": ends[0] as u64,
            "endid": ends[1] as u64,
            "cost": graph.length(leg),
            "overridable": true,
            "metadata": metadata,
        },
        "geometry": { "type": "MultiLineString", "coordinates": [ends.map(|end| graph.points[end].position)] },
    })
}
