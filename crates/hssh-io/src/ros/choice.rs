//! Which of several lasers and odometries is used, and where the laser sits.

use hssh_metrics::Pose;

use crate::ros::error::RecordingError;
use crate::ros::gather::{Gathered, Laser, Moment, Wheels, namespace, planar};
use crate::ros::sweep::Mount;

/// Frames that robots call the one of their body.
const BASES: [&str; 4] = ["base_link", "base_footprint", "base", "base_stabilized"];
/// Frames in which poses were corrected by somebody's map.
const MAPS: [&str; 3] = ["map", "world", "earth"];
/// What moves by less than this all the time stands: metres and radians.
const STILL: (f64, f64) = (0.02, 0.02);

/// What is known beside the recording, and what of it is to be used.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct RecordingOptions {
    /// The topic of the laser; of several lasers that are to be one, their topics with commas between them.
    pub scan: Option<String>,
    /// The topic of odometry, or the frame of `/tf` in which the robot moves; `none` for scan matching alone.
    pub odometry: Option<String>,
    /// The frame of the robot that odometry moves.
    pub base_frame: Option<String>,
    /// The laser in the robot's frame.
    pub laser: Option<Pose>,
}

/// Where poses of the robot come from.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Odometry<'a> {
    Topic(&'a Wheels),
    /// A frame that moves in another, by `/tf`.
    Frames {
        parent: &'a str,
        child: &'a str,
        poses: Vec<(Moment, Pose)>,
    },
    None,
}

/// What is used.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Choice<'a> {
    pub(crate) laser: &'a Laser,
    pub(crate) odometry: Odometry<'a>,
    pub(crate) mount: Mount,
    /// Lasers whose scans are to be merged with those of the first, and where they sit.
    pub(crate) others: Vec<(&'a Laser, Mount)>,
    /// Whether the options say where the laser sits.
    pub(crate) is_laser_given: bool,
    /// What was not certain.
    pub(crate) doubts: Vec<String>,
}

impl Odometry<'_> {
    pub(crate) fn poses(&self) -> &[(Moment, Pose)] {
        match self {
            Odometry::Topic(wheels) => &wheels.poses,
            Odometry::Frames { poses, .. } => poses,
            Odometry::None => &[],
        }
    }

    fn child(&self) -> Option<&str> {
        match self {
            Odometry::Topic(wheels) => Some(wheels.child.as_str()).filter(|child| !child.is_empty()),
            Odometry::Frames { child, .. } => Some(child),
            Odometry::None => None,
        }
    }
}

/// Chooses a laser, odometry that moves it, and where the one sits on the other.
pub(crate) fn choose<'a>(
    gathered: &'a Gathered,
    options: &RecordingOptions,
) -> Result<Choice<'a>, RecordingError> {
    let mut doubts = Vec::new();
    let (laser, others) = lasers(gathered, options)?;
    let odometry = odometry(gathered, laser, options)?;
    if let Odometry::Frames { parent, child, .. } = &odometry
        && MAPS.contains(parent)
    {
        doubts.push(format!(
            "the only poses are those of `{child}` in `{parent}`: they were corrected by somebody's map, and jump where it was"
        ));
    }
    let base =
        options.base_frame.as_deref().or_else(|| odometry.child()).map(|base| base.trim_start_matches('/'));
    let mount_of = |laser: &Laser, options: &RecordingOptions, doubts: &mut Vec<String>| {
        mount(gathered, laser, base, options, doubts)
    };
    let mount = mount_of(laser, options, &mut doubts)?;
    // Options say where the first one sits.
    let unsaid = RecordingOptions { laser: None, ..options.clone() };
    let others = others.into_iter().map(|laser| Ok((laser, mount_of(laser, &unsaid, &mut doubts)?)));
    let others = others.collect::<Result<_, RecordingError>>()?;
    Ok(Choice { laser, odometry, mount, others, is_laser_given: options.laser.is_some(), doubts })
}

/// The laser that is asked for and others to merge with it, or the one that looks widest, of those the one with most beams and scans.
fn lasers<'a>(
    gathered: &'a Gathered,
    options: &RecordingOptions,
) -> Result<(&'a Laser, Vec<&'a Laser>), RecordingError> {
    let usable = || gathered.lasers.iter().filter(|laser| !laser.sweeps.is_empty());
    if let Some(asked) = &options.scan {
        let mut found: Vec<&Laser> = Vec::new();
        for asked in asked.split(',').map(str::trim) {
            let Some(laser) = usable().find(|laser| is_topic(&laser.topic, asked)) else {
                let known = usable().map(|laser| laser.topic.clone()).collect();
                return Err(RecordingError::NoSuchScan { asked: asked.to_owned(), known });
            };
            if found.iter().all(|other| other.topic != laser.topic) {
                found.push(laser);
            }
        }
        return Ok((found.remove(0), found));
    }
    let is_level = |laser: &Laser| {
        let above = gathered.frames_of(laser).above(laser.frame());
        above.last().is_none_or(|(_, pose)| Mount::of(pose).is_level())
    };
    let widest = usable().max_by(|one, other| {
        let merit =
            |laser: &Laser| (is_level(laser), laser.view().round() as i64, laser.beams(), laser.sweeps.len());
        // Of equal ones the first.
        merit(one).cmp(&merit(other)).then(other.topic.cmp(&one.topic))
    });
    widest.map(|laser| (laser, Vec::new())).ok_or_else(|| RecordingError::no_laser(gathered))
}

/// Whether two topics have the same first name before their own.
pub(crate) fn is_of_one_robot(one: &str, other: &str) -> bool {
    let first = |topic| namespace(topic).split('/').next().unwrap_or_default();
    first(one) == first(other)
}

fn is_topic(topic: &str, asked: &str) -> bool {
    topic.trim_start_matches('/') == asked.trim_start_matches('/')
}

fn odometry<'a>(
    gathered: &'a Gathered,
    laser: &'a Laser,
    options: &RecordingOptions,
) -> Result<Odometry<'a>, RecordingError> {
    let frames = moving_frames(gathered, laser, options.base_frame.as_deref());
    if let Some(asked) = options.odometry.as_deref() {
        if asked == "none" {
            return Ok(Odometry::None);
        }
        let topic =
            gathered.wheels.iter().find(|wheels| is_topic(&wheels.topic, asked) && !wheels.poses.is_empty());
        if let Some(wheels) = topic {
            return Ok(Odometry::Topic(wheels));
        }
        let known: Vec<String> = gathered
            .wheels
            .iter()
            .map(|wheels| wheels.topic.clone())
            .chain(frames.iter().filter_map(|frames| match frames {
                Odometry::Frames { parent, .. } => Some((*parent).to_owned()),
                _ => None,
            }))
            .collect();
        let asked_frame = asked.trim_start_matches('/');
        let found = frames
            .into_iter()
            .find(|frames| matches!(frames, Odometry::Frames { parent, .. } if asked == "/tf" || *parent == asked_frame));
        return found.ok_or_else(|| RecordingError::NoSuchOdometry { asked: asked.to_owned(), known });
    }
    // Best first: odometry of the laser's own body that moves, by a topic, by /tf; then what may be of another body.
    let is_own = |child: &str| gathered.frames_of(laser).between(child, laser.frame()).is_some();
    let is_map = |frame: &str| MAPS.contains(&frame);
    let mut candidates: Vec<(u8, Odometry<'a>)> = Vec::new();
    for wheels in gathered.wheels.iter().filter(|wheels| !wheels.poses.is_empty()) {
        let moves = moves(&wheels.poses);
        let rank = match (moves, is_map(&wheels.frame), is_own(&wheels.child)) {
            (true, false, true) => 0,
            (true, false, false) => 2,
            (true, true, _) => 4,
            (false, ..) => 6,
        };
        candidates.push((rank, Odometry::Topic(wheels)));
    }
    for moving in frames {
        let rank = match &moving {
            Odometry::Frames { parent, .. } if parent.contains("odom") => 1,
            Odometry::Frames { parent, .. } if !is_map(parent) => 3,
            _ => 5,
        };
        candidates.push((rank, moving));
    }
    // Of several robots that one whose laser it is.
    let is_elsewhere = |odometry: &Odometry<'_>| match odometry {
        Odometry::Topic(wheels) => !is_of_one_robot(&wheels.topic, &laser.topic),
        _ => false,
    };
    let best = candidates.into_iter().min_by_key(|(rank, odometry)| {
        (*rank, is_elsewhere(odometry), std::cmp::Reverse(odometry.poses().len()))
    });
    Ok(best.map_or(Odometry::None, |(_, odometry)| odometry))
}

/// Frames on the laser's body that move in another one.
fn moving_frames<'a>(gathered: &'a Gathered, laser: &'a Laser, base: Option<&str>) -> Vec<Odometry<'a>> {
    let body = gathered.frames_of(laser).above(laser.frame());
    let is_of_body = |child: &str| {
        let asked = base.map(|base| base.trim_start_matches('/'));
        asked.map_or_else(|| body.iter().any(|(name, _)| *name == child), |base| base == child)
    };
    let links = gathered.frames_of(laser).links().filter(|(child, link)| link.moves() && is_of_body(child));
    links
        .map(|(child, link)| {
            let pose = |&(stamp, recorded, pose): &(i64, i64, nalgebra::Isometry3<f64>)| {
                (Moment { stamp, recorded }, planar(&pose))
            };
            Odometry::Frames { parent: &link.parent, child, poses: link.poses.iter().map(pose).collect() }
        })
        .collect()
}

fn moves(poses: &[(Moment, Pose)]) -> bool {
    let Some((_, first)) = poses.first() else { return false };
    poses.iter().any(|(_, pose)| {
        let off = first.between(*pose);
        off.translation().norm() > STILL.0 || off.theta.abs() > STILL.1
    })
}

/// Where the laser sits in the frame that odometry moves.
fn mount(
    gathered: &Gathered,
    laser: &Laser,
    base: Option<&str>,
    options: &RecordingOptions,
    doubts: &mut Vec<String>,
) -> Result<Mount, RecordingError> {
    let frame = laser.frame();
    let above = gathered.frames_of(laser).above(frame);
    let is_base = |name: &str| BASES.iter().any(|base| name.rsplit('/').next() == Some(base));
    let told = match base {
        Some(base) => gathered.frames_of(laser).between(base, frame).or_else(|| {
            // Another name for the body: base_footprint where the tree of the laser ends in base_link.
            let (name, pose) = above.last().filter(|(name, _)| is_base(name) && *name != frame)?;
            doubts.push(format!(
                "no transform says where `{name}` is in `{base}`: they are taken to be the same"
            ));
            Some(*pose)
        }),
        None => above.iter().find(|(name, _)| is_base(name)).or(above.last()).map(|(_, pose)| *pose),
    };
    let mut mount = match &told {
        Some(pose) => Mount::of(pose),
        None => {
            if options.laser.is_none() && base.is_some_and(|base| base != frame) {
                doubts.push(format!(
                    "no transform says where the laser's frame `{frame}` is in `{}`: it is taken to sit at the robot's axis and to \
                     look ahead; --laser-pose says otherwise",
                    base.unwrap_or_default()
                ));
            }
            Mount::USUAL
        }
    };
    if let Some(pose) = options.laser {
        mount = Mount { at: [pose.x, pose.y], turn: pose.theta, ..mount };
    }
    if !mount.is_level() {
        let (topic, degrees) = (laser.topic.clone(), mount.lean.to_degrees());
        return Err(RecordingError::Leaning { topic, degrees });
    }
    Ok(mount)
}
