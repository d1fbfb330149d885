//! The topological map of ROS topological_navigation, version 2.

use std::f64::consts::FRAC_PI_4;

use serde::Serialize;
use serde_saphyr::{DoubleQuoted, FlowMap};

use super::drive_graph::DriveGraph;
use super::names::words;
use super::provenance::Provenance;
use super::yaml::{rounded, to_yaml};

/// When the map was made, as the format demands it: equal maps give equal files, so that it is no date at all.
const NO_DATE: &str = "1970-01-01_00-00-00";
/// How far around a node a robot is at it, in metres, if nothing is known of the robot.
const USUAL_RADIUS: f64 = 0.5;

/// What no reader takes for a number, whatever it is.
type Name<'a> = DoubleQuoted<&'a str>;

#[derive(Serialize)]
struct TopologicalMap<'a> {
    meta: MapMeta<'a>,
    metric_map: Name<'a>,
    name: Name<'a>,
    pointset: Name<'a>,
    transformation: Transformation,
    nodes: Vec<Entry<'a>>,
}

#[derive(Serialize)]
struct MapMeta<'a> {
    last_updated: &'static str,
    hssh: &'a Provenance,
}

/// The map is in the frame `map`.
#[derive(Serialize)]
struct Transformation {
    parent: &'static str,
    child: &'static str,
    translation: FlowMap<Vector>,
    rotation: FlowMap<Quaternion>,
}

#[derive(Clone, Copy, Serialize)]
struct Vector {
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Clone, Copy, Serialize)]
struct Quaternion {
    w: f64,
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Serialize)]
struct Entry<'a> {
    meta: FlowMap<EntryMeta<'a>>,
    node: Node<'a>,
}

#[derive(Serialize)]
struct EntryMeta<'a> {
    map: Name<'a>,
    node: Name<'a>,
    pointset: Name<'a>,
}

#[derive(Serialize)]
struct Node<'a> {
    name: Name<'a>,
    parent_frame: &'static str,
    pose: Pose,
    properties: FlowMap<Tolerances>,
    verts: Vec<FlowMap<Corner>>,
    restrictions_planning: &'static str,
    restrictions_runtime: &'static str,
    localise_by_topic: &'static str,
    edges: Vec<Edge<'a>>,
}

#[derive(Serialize)]
struct Pose {
    position: FlowMap<Vector>,
    orientation: FlowMap<Quaternion>,
}

#[derive(Serialize)]
struct Tolerances {
    xy_goal_tolerance: f64,
    yaw_goal_tolerance: f64,
}

#[derive(Serialize)]
struct Corner {
    x: f64,
    y: f64,
}

#[derive(Serialize)]
struct Edge<'a> {
    edge_id: DoubleQuoted<String>,
    node: Name<'a>,
    action: &'static str,
    action_type: &'static str,
    fail_policy: &'static str,
    fluid_navigation: bool,
    recovery_behaviours_config: &'static str,
    restrictions_planning: &'static str,
    restrictions_runtime: &'static str,
}

const UPRIGHT: Quaternion = Quaternion { w: 1.0, x: 0.0, y: 0.0, z: 0.0 };

/// A map of topological_navigation: its nodes with edges to those that a leg leads to; a robot is at a node within an octagon around
/// it. Names are single words.
#[must_use]
pub fn topological_map(graph: &DriveGraph<'_>) -> String {
    let provenance = &graph.routes.provenance;
    let name = || DoubleQuoted(provenance.source.as_str());
    let names = words(graph.points.iter().map(|point| point.name.as_str()));
    let neighbors = neighbors(graph);
    let radius = graph.routes.radius.unwrap_or(USUAL_RADIUS);
    let entry = |(number, point): (usize, &super::DrivePoint)| {
        let own = names[number].as_str();
        let [x, y] = point.position.map(rounded);
        let position = FlowMap(Vector { x, y, z: 0.0 });
        let edge = |&other: &usize| Edge {
            edge_id: DoubleQuoted(format!("{own}_{}", names[other])),
            node: DoubleQuoted(&names[other]),
            action: "NavigateToPose",
            action_type: "geometry_msgs/PoseStamped",
            fail_policy: "fail",
            fluid_navigation: true,
            recovery_behaviours_config: "",
            restrictions_planning: "True",
            restrictions_runtime: "True",
        };
        let node = Node {
            name: DoubleQuoted(own),
            parent_frame: "map",
            pose: Pose { position, orientation: FlowMap(UPRIGHT) },
            properties: FlowMap(Tolerances { xy_goal_tolerance: 0.3, yaw_goal_tolerance: 0.1 }),
            verts: octagon(radius),
            restrictions_planning: "True",
            restrictions_runtime: "True",
            localise_by_topic: "",
            edges: neighbors[number].iter().map(edge).collect(),
        };
        Entry { meta: FlowMap(EntryMeta { map: name(), node: DoubleQuoted(own), pointset: name() }), node }
    };
    let origin = FlowMap(Vector { x: 0.0, y: 0.0, z: 0.0 });
    to_yaml(&TopologicalMap {
        meta: MapMeta { last_updated: NO_DATE, hssh: provenance },
        metric_map: name(),
        name: name(),
        pointset: name(),
        transformation: Transformation {
            parent: "map",
            child: "topo_map",
            translation: origin,
            rotation: FlowMap(UPRIGHT),
        },
        nodes: graph.points.iter().enumerate().map(entry).collect(),
    })
}

/// The points that legs lead to from each point, each once, in order.
fn neighbors(graph: &DriveGraph<'_>) -> Vec<Vec<usize>> {
    let mut neighbors = vec![Vec::new(); graph.points.len()];
    for leg in &graph.legs {
        let [from, to] = leg.ends;
        neighbors[from].push(to);
        neighbors[to].push(from);
    }
    for others in &mut neighbors {
        others.sort_unstable();
        others.dedup();
    }
    neighbors
}

/// Eight corners around a node, relative to it.
fn octagon(radius: f64) -> Vec<FlowMap<Corner>> {
    let corner = |number: u32| {
        let (sin, cos) = (FRAC_PI_4 * (f64::from(number) + 0.5)).sin_cos();
        FlowMap(Corner { x: rounded(radius * cos), y: rounded(radius * sin) })
    };
    (0..8).map(corner).collect()
}
