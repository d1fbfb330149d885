//! The topological map of ROS topological_navigation, version 2.

use std::f64::consts::FRAC_PI_4;
use std::fmt::Write;

use super::{ExportError, node_names, quoted, roadmap};
use crate::account::PlacesAccount;

/// When the map was made, as the format demands it: equal maps give equal files, so that it is no date at all.
const NO_DATE: &str = "1970-01-01_00-00-00";

/// A roadmap as a map of topological_navigation: its nodes with edges to those that a way leads to; a robot is at a
/// node within an octagon as large as the robot.
///
/// # Errors
/// If there is no way.
pub fn topological_map(account: &PlacesAccount) -> Result<String, ExportError> {
    let roadmap = roadmap(account)?;
    let names: Vec<String> =
        node_names(account, roadmap).iter().map(|name| name.replace([' ', '(', ')'], "")).collect();
    let name = quoted(&account.name);
    let mut text = format!(
        "meta: {{last_updated: \"{NO_DATE}\"}}\nmetric_map: {name}\nname: {name}\npointset: {name}\nnodes:\n"
    );
    for (number, node) in roadmap.nodes.iter().enumerate() {
        let [x, y] = node.position;
        let own = quoted(&names[number]);
        let _ = writeln!(text, "- meta: {{map: {name}, node: {own}, pointset: {name}}}");
        let _ = writeln!(text, "  node:\n    name: {own}\n    parent_frame: map");
        let _ = writeln!(
            text,
            "    pose: {{position: {{x: {x:.3}, y: {y:.3}, z: 0.0}}, orientation: {{w: 1.0, x: 0.0, y: 0.0, z: 0.0}}}}"
        );
        text += "    properties: {xy_goal_tolerance: 0.3, yaw_goal_tolerance: 0.1}\n    verts:\n";
        for corner in 0..8 {
            let (sin, cos) = (FRAC_PI_4 * (f64::from(corner) + 0.5)).sin_cos();
            let _ =
                writeln!(text, "    - {{x: {:.3}, y: {:.3}}}", roadmap.radius * cos, roadmap.radius * sin);
        }
        text += "    restrictions_planning: \"True\"\n    restrictions_runtime: \"True\"\n";
        let mut others: Vec<usize> = roadmap
            .ways
            .iter()
            .flat_map(|way| [way.ends, [way.ends[1], way.ends[0]]])
            .filter(|&[from, to]| from as usize == number && to != from)
            .map(|[_, to]| to as usize)
            .collect();
        others.sort_unstable();
        others.dedup();
        text += if others.is_empty() { "    edges: []\n" } else { "    edges:\n" };
        for other in others {
            let id = quoted(&format!("{}_{}", names[number], names[other]));
            let _ = writeln!(
                text,
                "    - {{edge_id: {id}, node: {}, action: NavigateToPose, action_type: geometry_msgs/PoseStamped, \
                 fluid_navigation: true, restrictions_planning: \"True\", restrictions_runtime: \"True\"}}",
                quoted(&names[other])
            );
        }
    }
    Ok(text)
}
