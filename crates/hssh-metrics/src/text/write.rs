//! Writing pose graphs as g2o and TORO text; numbers are written so that reading gives the same bits.

use std::fmt::{self, Write};

use super::file::GraphFile;
use crate::graph::Edge;
use crate::pose::Pose;

impl GraphFile {
    /// The graph as g2o text: vertices, then `FIX` for the anchored poses, then edges.
    #[must_use]
    pub fn to_g2o(&self) -> String {
        self.write("VERTEX_SE2", true, |out, edge, [from, to]| {
            let m = edge.information.matrix();
            let Pose { x, y, theta } = edge.relative_pose;
            write!(out, "EDGE_SE2 {from} {to} {x} {y} {theta} {} {} {} ", m.m11, m.m12, m.m13)?;
            writeln!(out, "{} {} {}", m.m22, m.m23, m.m33)
        })
    }

    /// The graph as TORO text. TORO has no word for an anchor, so anchors are left out.
    #[must_use]
    pub fn to_toro(&self) -> String {
        self.write("VERTEX2", false, |out, edge, [from, to]| {
            let m = edge.information.matrix();
            let Pose { x, y, theta } = edge.relative_pose;
            write!(out, "EDGE2 {from} {to} {x} {y} {theta} {} {} {} ", m.m11, m.m12, m.m22)?;
            writeln!(out, "{} {} {}", m.m33, m.m13, m.m23)
        })
    }

    fn write(
        &self,
        vertex: &str,
        fix: bool,
        write_edge: impl Fn(&mut String, &Edge, [u64; 2]) -> fmt::Result,
    ) -> String {
        let mut out = String::new();
        let mut write_all = || {
            for (label, Pose { x, y, theta }) in self.labels.iter().zip(self.graph.poses()) {
                writeln!(out, "{vertex} {label} {x} {y} {theta}")?;
            }
            for pose in self.graph.pose_ids().filter(|&pose| fix && self.graph.is_anchored(pose)) {
                writeln!(out, "FIX {}", self.labels[pose.index()])?;
            }
            self.graph.edges().iter().try_for_each(|edge| {
                write_edge(&mut out, edge, [edge.from, edge.to].map(|pose| self.labels[pose.index()]))
            })
        };
        write_all().expect("a String takes everything that is written to it");
        out
    }
}
