//! The frames of a robot: what `/tf` and `/tf_static` say of where each sits in which.

use std::collections::BTreeMap;

use nalgebra::Isometry3;

use crate::ros::message::Transform;

/// A frame that turns or moves by more in its parent is one that moves: metres and radians.
const STILL: (f64, f64) = (0.02, 0.02);

/// A frame in its parent, over time.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Link {
    pub(crate) parent: String,
    /// When and where: nanoseconds of the stamps, nanoseconds of recording, the frame in its parent.
    pub(crate) poses: Vec<(i64, i64, Isometry3<f64>)>,
    /// How often its numbers were no pose.
    pub(crate) damaged: u64,
}

impl Link {
    /// Whether it moves in its parent.
    pub(crate) fn moves(&self) -> bool {
        let Some((_, _, first)) = self.poses.first() else { return false };
        self.poses.iter().any(|(_, _, pose)| {
            let off = first.inv_mul(pose);
            off.translation.vector.norm() > STILL.0 || off.rotation.angle() > STILL.1
        })
    }
}

/// All frames that have a parent, each with the parents that some message gives it.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct Frames {
    links: BTreeMap<String, Vec<Link>>,
}

impl Frames {
    pub(crate) fn add(&mut self, transform: Transform, recorded: i64) {
        let links = self.links.entry(transform.child).or_default();
        let parent = transform.header.frame;
        let known = links.iter().position(|link| link.parent == parent);
        let index = known.unwrap_or_else(|| {
            links.push(Link { parent, poses: Vec::new(), damaged: 0 });
            links.len() - 1
        });
        match transform.pose {
            Some(pose) => links[index].poses.push((transform.header.stamp, recorded, pose)),
            None => links[index].damaged += 1,
        }
    }

    /// All links with the name of the child.
    pub(crate) fn links(&self) -> impl Iterator<Item = (&str, &Link)> {
        self.links.iter().flat_map(|(child, links)| links.iter().map(move |link| (child.as_str(), link)))
    }

    /// From a frame up to where nothing is above it, without going up where a frame moves as a robot does: each frame
    /// with the first one seen from it.
    pub(crate) fn above<'a>(&'a self, frame: &'a str) -> Vec<(&'a str, Isometry3<f64>)> {
        let mut way = vec![(frame, Isometry3::identity())];
        while let Some((last, pose)) = way.last().copied() {
            let Some(link) = self.still(last) else { break };
            // A ring of frames has no top.
            if way.iter().any(|(name, _)| *name == link.parent) {
                break;
            }
            way.push((&link.parent, link.poses[0].2 * pose));
        }
        way
    }

    fn still(&self, frame: &str) -> Option<&Link> {
        self.links.get(frame)?.iter().find(|link| !link.poses.is_empty() && !link.moves())
    }

    /// A frame seen from another, if both sit on the same body.
    pub(crate) fn between(&self, from: &str, to: &str) -> Option<Isometry3<f64>> {
        let (one, other) = (self.above(from), self.above(to));
        one.iter().find_map(|(name, from)| {
            let (_, to) = other.iter().find(|(above, _)| above == name)?;
            Some(from.inv_mul(to))
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Translation3, UnitQuaternion};

    use super::*;
    use crate::ros::message::Header;

    fn link(frames: &mut Frames, parent: &str, child: &str, x: f64, yaw: f64) {
        let rotation = UnitQuaternion::from_euler_angles(0.0, 0.0, yaw);
        let pose = Some(Isometry3::from_parts(Translation3::new(x, 0.0, 0.0), rotation));
        frames.add(
            Transform { header: Header { stamp: 0, frame: parent.into() }, child: child.into(), pose },
            0,
        );
    }

    #[test]
    fn a_laser_is_seen_from_the_base_across_the_tree() {
        let mut frames = Frames::default();
        link(&mut frames, "base_footprint", "base_link", 0.0, 0.0);
        link(&mut frames, "base_link", "mast", 0.2, std::f64::consts::FRAC_PI_2);
        link(&mut frames, "mast", "laser", 0.1, 0.0);
        link(&mut frames, "odom", "base_footprint", 0.0, 0.0);
        link(&mut frames, "odom", "base_footprint", 7.0, 0.0);
        let pose = frames.between("base_footprint", "laser").unwrap();
        assert!((pose.translation.vector - nalgebra::vector![0.2, 0.1, 0.0]).norm() < 1e-12);
        assert_eq!(frames.between("laser", "camera"), None);
        assert_eq!(frames.above("laser").last().unwrap().0, "base_footprint", "the robot moves in odom");
        link(&mut frames, "x", "y", 1.0, 0.0);
        link(&mut frames, "y", "x", 1.0, 0.0);
        assert_eq!(frames.above("x").len(), 2);
    }
}
