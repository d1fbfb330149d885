//! Places and ways as GeoJSON in the frame of the map, for whatever draws points and lines.

use serde_json::{Map, Value, json};

use super::error::ExportError;
use super::route_graph::{RouteGraph, RouteNode, RouteWay};

/// Nodes as points and ways as lines, in their order; coordinates are metres in the frame of the map. What is not known is left out.
///
/// # Errors
/// If a node has no position.
pub fn route_geojson(graph: &RouteGraph) -> Result<String, ExportError> {
    let mut features = Vec::new();
    for (number, node) in graph.nodes.iter().enumerate() {
        features.push(feature(of_node(number, node), "Point", json!(graph.position(number)?)));
    }
    for (number, way) in graph.ways.iter().enumerate().filter(|(_, way)| way.line.len() > 1) {
        features.push(feature(of_way(number, way), "LineString", json!(way.line)));
    }
    let file = json!({
        "type": "FeatureCollection",
        "name": graph.provenance.source,
        "hssh": graph.provenance,
        "features": features,
    });
    Ok(file.to_string() + "\n")
}

pub(super) fn feature(properties: Value, kind: &str, coordinates: Value) -> Value {
    json!({
        "type": "Feature",
        "properties": properties,
        "geometry": { "type": kind, "coordinates": coordinates },
    })
}

fn of_node(number: usize, node: &RouteNode) -> Value {
    known([
        ("what", Some(json!(node.kind))),
        ("number", Some(json!(number))),
        ("name", Some(json!(node.name))),
        ("star", node.star.as_ref().map(|star| json!(star))),
        ("theta", node.heading.map(|theta| json!(theta))),
        ("pending", node.pending.map(|pending| json!(pending))),
    ])
}

fn of_way(number: usize, way: &RouteWay) -> Value {
    known([
        ("what", Some(json!("way"))),
        ("number", Some(json!(number))),
        ("ends", Some(json!(way.ends))),
        ("gateways", way.gateways.as_ref().map(|gateways| json!(gateways))),
        ("origin", Some(json!(way.origin.name()))),
        ("length", way.length().map(|length| json!(length))),
        ("width", way.width.filter(|width| width.is_finite()).map(|width| json!(width))),
    ])
}

fn known<const N: usize>(properties: [(&str, Option<Value>); N]) -> Value {
    let told = properties.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?)));
    Value::Object(told.collect::<Map<_, _>>())
}
