//! The navigation graph of Open-RMF.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_saphyr::{DoubleQuoted, FlowMap, FlowSeq};

use super::drive_graph::DriveGraph;
use super::yaml::{rounded, to_yaml};

/// What is in a file.
#[derive(Serialize)]
struct NavigationGraph<'a> {
    building_name: DoubleQuoted<&'a str>,
    levels: BTreeMap<&'static str, Level<'a>>,
    doors: BTreeMap<&'a str, Door>,
    lifts: BTreeMap<&'a str, ()>,
}

#[derive(Serialize)]
struct Level<'a> {
    vertices: Vec<FlowSeq<(f64, f64, FlowMap<Vertex<'a>>)>>,
    lanes: Vec<FlowSeq<(usize, usize, FlowMap<Lane<'a>>)>>,
}

#[derive(Serialize)]
struct Vertex<'a> {
    name: DoubleQuoted<&'a str>,
}

#[derive(Serialize)]
struct Lane<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    door_name: Option<DoubleQuoted<&'a str>>,
}

#[derive(Serialize)]
struct Door {
    endpoints: FlowSeq<[FlowSeq<[f64; 2]>; 2]>,
    map: &'static str,
}

/// The one level.
const LEVEL: &str = "L1";

/// A navigation graph of Open-RMF: one level, `L1`; lanes lead one way, so that there are two for each leg; doors are those passages
/// that probably have one, and a lane that leads through one names it. Only places and passages have names, for others are not to be sent to.
#[must_use]
pub fn open_rmf_graph(graph: &DriveGraph<'_>) -> String {
    let routes = graph.routes;
    let node = |point: usize| routes.nodes.get(point);
    let vertex = |(number, point): (usize, &super::DrivePoint)| {
        let called = node(number).filter(|node| node.kind != "branch");
        let name = called.map_or("", |node| &node.name);
        let [x, y] = point.position.map(rounded);
        FlowSeq((x, y, FlowMap(Vertex { name: DoubleQuoted(name) })))
    };
    let lanes = graph.legs.iter().flat_map(|leg| {
        let [from, to] = leg.ends;
        let door = graph.door(leg).map(|door| door.name.as_str());
        [[from, to], [to, from]]
            .map(|[from, to]| FlowSeq((from, to, FlowMap(Lane { door_name: door.map(DoubleQuoted) }))))
    });
    let level =
        Level { vertices: graph.points.iter().enumerate().map(vertex).collect(), lanes: lanes.collect() };
    let doors = routes.doors.iter().map(|door| {
        let endpoints = FlowSeq(door.posts.map(|post| FlowSeq(post.map(rounded))));
        (door.name.as_str(), Door { endpoints, map: LEVEL })
    });
    let file = NavigationGraph {
        building_name: DoubleQuoted(&routes.provenance.source),
        levels: BTreeMap::from([(LEVEL, level)]),
        doors: doors.collect(),
        lifts: BTreeMap::new(),
    };
    routes.provenance.to_comments() + &to_yaml(&file)
}
