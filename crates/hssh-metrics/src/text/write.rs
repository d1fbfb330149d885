//! Writing pose graphs as g2o and TORO text; numbers are written so that reading gives the same bits.

use std::fmt::{self, Write};

use super::file::GraphFile;
use crate::graph::Edge;
use crate::pose::Pose;

impl GraphFile {
    /// The graph as g2o text: vertices, then `FIX` for the anchored poses, then edges. What the file holds for doubtful
    /// is written as plain edges.
    #[must_use]
    pub fn to_g2o(&self) -> String {
        self.write(["VERTEX_SE2", "VERTEX_XY"], true, |out, edge| {
            let m = edge.information.matrix();
            let Pose { x, y, theta } = edge.relative_pose;
            let is_point = self.is_landmark(edge.to) || (self.is_prior(edge) && m.m33 == 0.0);
            let to = self.label(edge.to).unwrap_or_default();
            match self.label(edge.from) {
                Some(from) if is_point => write!(out, "EDGE_SE2_XY {from} {to} {x} {y}"),
                None if is_point => write!(out, "EDGE_PRIOR_SE2_XY {to} {x} {y}"),
                Some(from) => write!(out, "EDGE_SE2 {from} {to} {x} {y} {theta}"),
                None => write!(out, "EDGE_PRIOR_SE2 {to} {x} {y} {theta}"),
            }?;
            match is_point {
                true => writeln!(out, " {} {} {}", m.m11, m.m12, m.m22),
                false => writeln!(out, " {} {} {} {} {} {}", m.m11, m.m12, m.m13, m.m22, m.m23, m.m33),
            }
        })
    }

    /// The graph as TORO text. TORO has no word for an anchor, for a prior and for a landmark, so they are left out.
    #[must_use]
    pub fn to_toro(&self) -> String {
        self.write(["VERTEX2", "#"], false, |out, edge| {
            let m = edge.information.matrix();
            let Pose { x, y, theta } = edge.relative_pose;
            let (Some(from), Some(to)) = (self.label(edge.from), self.label(edge.to)) else { return Ok(()) };
            if self.is_landmark(edge.to) {
                return Ok(());
            }
            write!(out, "EDGE2 {from} {to} {x} {y} {theta} {} {} {} ", m.m11, m.m12, m.m22)?;
            writeln!(out, "{} {} {}", m.m33, m.m13, m.m23)
        })
    }

    fn write(
        &self,
        [vertex, point]: [&str; 2],
        fix: bool,
        write_edge: impl Fn(&mut String, &Edge) -> fmt::Result,
    ) -> String {
        let mut out = String::new();
        let graph = &self.graph;
        let mut write_all = || {
            for ((label, pose), Pose { x, y, theta }) in
                self.labels.iter().zip(graph.pose_ids()).zip(graph.poses())
            {
                match self.is_landmark(pose) {
                    true => writeln!(out, "{point} {label} {x} {y}")?,
                    false => writeln!(out, "{vertex} {label} {x} {y} {theta}")?,
                }
            }
            let anchored = graph.pose_ids().filter(|&pose| fix && graph.is_anchored(pose));
            for label in anchored.filter_map(|pose| self.label(pose)) {
                writeln!(out, "FIX {label}")?;
            }
            graph.edges().iter().try_for_each(|edge| write_edge(&mut out, edge))
        };
        write_all().expect("a String takes everything that is written to it");
        out
    }
}
