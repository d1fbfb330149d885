//! The loop over the submaps in the order of the log: look for each among the earlier ones near to where it is
//! believed to be, accept chains of matches, and solve the pose graph anew where they move it.

use hssh_metrics::{
    Covariance, Edge, GraphError, Kernel, Options, Pose, PoseGraph, PoseId, RobustSolution, SolveError,
    UncertainPose, UncertaintyError, reweighted, solve, solve_robustly,
};

use super::chain::{Linked, chain, linked, recent, told};
use super::keyframe::{Keyframe, keyframes};
use super::matching::{Match, find};
use super::options::ClosingOptions;
use super::refine::refine;
use super::scans::all_scans;
use super::search::Window;
use super::submap::{Submap, middles};
use super::ways::{Known, Ways};
use crate::carmen::LaserLog;
use crate::grid::LatticeError;
use crate::matching::Track;
use crate::progress::Reply;

/// How often the log is gone through: what was not found where it was believed to be may be found later.
const SWEEPS: usize = 2;
/// Of one submap at most so many others are looked into.
const MOST_CANDIDATES: usize = 8;
/// Beyond so many doublings of what is well known nothing is known.
const MOST_DOUBLINGS: f64 = 8.0;
/// A closure costs a way so long when it is asked how well two poses are known to one another: metres.
const CLOSURE_LENGTH: f64 = 1.0;
/// Moved farther than this, in metres, the graph is solved anew.
const MOVED: f64 = 0.1;
/// A closure that counts less than this is contradicted: what is near it is not matched.
const BELIEVED: f64 = 0.5;
/// What lies no farther than this from where it is believed to be is there, in metres…
const THERE: f64 = 1.0;
/// …and what lies farther off than so many standard deviations is not.
const POSSIBLE: f64 = 2.5;
/// A closure that fits worse, in standard deviations, begins to count less.
const KERNEL: f64 = 3.0;

/// Two scans that show one place.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Closure {
    /// The earlier scan…
    pub earlier: usize,
    /// …and the later one.
    pub later: usize,
    /// The later pose in the frame of the earlier one, as the laser shows it.
    pub relative: Pose,
    /// The covariance of these three numbers, in the frame of the earlier pose: along a corridor without features nothing is
    /// known.
    pub covariance: Covariance,
    /// Of the walls of each that the other has seen, the part that is where the other has them.
    pub agreement: f64,
    /// How well the later pose was known from the earlier one before any closure here: standard deviation in metres. Where
    /// it is large, what only looks alike may be taken for the same.
    pub spread: f64,
    /// How far the later pose was from where it was believed to be then: metres.
    pub off: f64,
    /// By which factor it counts in the end: near 0 if the rest contradicts it.
    pub weight: f64,
}

/// Scans that look alike: an earlier and a later one each.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Alike {
    /// Where they are believed to be.
    pub expected: Vec<(usize, usize)>,
    /// Elsewhere, but where they may be, as far as that is known: too few or too ambiguous for a return.
    pub possible: Vec<(usize, usize)>,
}

/// A track with its loops closed.
#[derive(Clone, PartialEq, Debug)]
pub struct ClosedTrack {
    /// All scans: a pose for each in the frame of the first, solved; an edge for each tracked step, and one for each match
    /// of a scan with an earlier pass, its information scaled by how much it counts.
    pub graph: PoseGraph,
    /// The returns that were found.
    pub closures: Vec<Closure>,
    /// What looks alike, whether that was enough for a return or not.
    pub alike: Alike,
}

impl ClosedTrack {
    /// The robot at each scan, in the frame of the first.
    #[must_use]
    pub fn poses(&self) -> &[Pose] {
        self.graph.poses()
    }
}

/// Why loops cannot be closed.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum ClosingError {
    /// The options describe no submap.
    #[error("no submap can be made: {0}")]
    Submap(#[from] LatticeError),
    /// A motion that is no edge.
    #[error("the track is no pose graph: {0}")]
    Graph(#[from] GraphError),
    /// A motion that is too uncertain.
    #[error("the track is too uncertain, and is the odometry in metres and radians? {0}")]
    Uncertain(#[from] UncertaintyError),
    /// No least squares.
    #[error("the pose graph of the scans cannot be solved, and is the odometry in metres and radians? {0}")]
    Solve(#[from] SolveError),
}

/// Closes the loops of a track. `progress` is told which scan it is at, and may stop there: the loops found so far are closed.
///
/// # Errors
/// If the options describe no submap, or the pose graph cannot be solved.
pub fn close_loops<R: Into<Reply>>(
    log: &LaserLog,
    track: &Track,
    options: &ClosingOptions,
    mut progress: impl FnMut(usize) -> R,
) -> Result<ClosedTrack, ClosingError> {
    let keyframes = keyframes(log, track, options);
    let mut closing = Closing::new(log, track, keyframes, options)?;
    'sweeps: for _ in 0..SWEEPS {
        for query in 0..closing.submaps.len() {
            closing.close(query)?;
            let scan = closing.keyframes[closing.submaps[query].middle].scan;
            if progress(scan).into() == Reply::Stop {
                break 'sweeps;
            }
        }
    }
    closing.finish(track)
}

/// Whether a match is good enough to be one in a chain: nothing else looks like it, and it cannot be slid along a corridor, unless
/// there was nothing else to find.
fn is_good(found: &Match) -> bool {
    found.is_clear && (found.slide.is_none() || found.is_expected)
}

/// An earlier submap that one may lie on.
struct Candidate {
    /// How far off it is believed to be, in metres.
    off: f64,
    reference: usize,
    window: Window,
    known: Known,
}

struct Closing<'a> {
    options: &'a ClosingOptions,
    keyframes: Vec<Keyframe>,
    submaps: Vec<Submap>,
    graph: PoseGraph,
    /// How many edges are the track's.
    tracked: usize,
    /// The track and what closes it, from submap to submap.
    ways: Ways,
    /// By query.
    tentative: Vec<Vec<Linked>>,
    /// By query, all that looks alike, clear or not.
    alike: Vec<Vec<Match>>,
    accepted: Vec<Match>,
}

impl<'a> Closing<'a> {
    fn new(
        log: &LaserLog,
        track: &Track,
        keyframes: Vec<Keyframe>,
        options: &'a ClosingOptions,
    ) -> Result<Self, ClosingError> {
        let submaps = middles(&keyframes, options)
            .into_iter()
            .map(|middle| Submap::new(log, &keyframes, middle, options))
            .collect::<Result<Vec<_>, _>>()?;
        let mut graph = PoseGraph::default();
        for keyframe in &keyframes {
            graph.add_pose(keyframe.tracked);
        }
        for (index, pair) in keyframes.windows(2).enumerate() {
            if let Ok(Some(motion)) = track.motion(pair[0].scan, pair[1].scan) {
                let (from, to) = (PoseId(index as u32), PoseId(index as u32 + 1));
                graph.add_edge(Edge::observed(from, to, motion.mean, &motion.covariance))?;
            }
        }
        graph.anchor(PoseId(0))?;
        let tracked = graph.edges().len();
        let mut ways = Ways::new(submaps.len());
        for later in 1..submaps.len() {
            let ends = [later - 1, later];
            let [from, to] = ends.map(|submap| keyframes[submaps[submap].middle].scan);
            let length = submaps[later].travelled - submaps[later - 1].travelled;
            if let Ok(Some(motion)) = track.motion(from, to) {
                ways.add(ends, length, motion)?;
            }
        }
        let (tentative, alike) = (vec![Vec::new(); submaps.len()], vec![Vec::new(); submaps.len()]);
        Ok(Closing {
            options,
            keyframes,
            submaps,
            graph,
            tracked,
            ways,
            tentative,
            alike,
            accepted: Vec::new(),
        })
    }

    /// Where the middle of a submap is believed to be.
    fn pose(&self, submap: usize) -> Pose {
        self.graph.poses()[self.submaps[submap].middle]
    }

    /// Looks for one submap among those before.
    fn close(&mut self, query: usize) -> Result<(), ClosingError> {
        let mut tried: Vec<usize> = Vec::new();
        let mut found: Vec<Match> = Vec::new();
        for Candidate { reference, window, known, .. } in self.candidates(query) {
            let is_like = |&other: &usize| {
                let travel = self.submaps[other].travelled - self.submaps[reference].travelled;
                travel.abs() < 1.5 * self.options.stretch
            };
            if tried.iter().any(is_like) {
                continue;
            }
            tried.push(reference);
            let matched =
                find(&self.submaps, &self.keyframes, (query, reference), &window, known.across, self.options);
            found.extend(matched.filter(|found| self.is_alike(found)));
            if tried.len() >= MOST_CANDIDATES {
                break;
            }
        }
        let good: Vec<Match> = found.iter().filter(|found| is_good(found)).copied().collect();
        let firm = self.unambiguous(&good).into_iter().map(|found| (found, true));
        let sliding =
            found.iter().filter(|found| found.is_clear && !is_good(found)).map(|found| (*found, false));
        let told: Vec<(Match, bool)> = firm.chain(sliding).collect();
        self.alike[query] = found;
        let pose = |submap: usize| self.pose(submap);
        let travelled = |submap: usize| self.submaps[submap].travelled;
        self.tentative[query] = told
            .into_iter()
            .map(|(found, is_firm)| linked(found, is_firm, &self.tentative, travelled, pose))
            .collect();
        self.accept(query)
    }

    /// The earlier submaps that a submap may lie on: how far off each is believed to be, and where to look. The
    /// nearest first.
    fn candidates(&self, query: usize) -> Vec<Candidate> {
        let here = self.pose(query);
        let is_long_ago = |reference: usize| {
            let apart = self.submaps[query].stretch + self.submaps[reference].stretch;
            let ago = self.submaps[query].travelled - self.submaps[reference].travelled;
            ago >= self.options.least_travel.max(apart + self.options.stretch)
        };
        let mut candidates: Vec<Candidate> = Vec::new();
        let known = self.ways.from(query, |submap| self.pose(submap));
        for (reference, known) in known.into_iter().enumerate().take(query) {
            let window = self.window(here, reference, known);
            let off = window.center.translation().norm();
            if is_long_ago(reference) && off < window.across + self.options.stretch / 2.0 {
                candidates.push(Candidate { off, reference, window, known });
            }
        }
        candidates.sort_by(|a, b| a.off.total_cmp(&b.off));
        candidates
    }

    /// Whether what two submaps show looks alike.
    fn is_alike(&self, found: &Match) -> bool {
        found.agreement >= self.options.least_agreement && found.overlap >= self.options.least_overlap
    }

    /// Of the matches of one submap those that no other one, elsewhere and nearly as good, makes doubtful.
    fn unambiguous(&self, found: &[Match]) -> Vec<Match> {
        let at = |found: &Match| told(found, |submap| self.pose(submap)).translation();
        let is_clear = |one: &&Match| {
            !found.iter().any(|other| {
                (at(one) - at(other)).norm() > 1.0 && other.score > self.options.ambiguity * one.score
            })
        };
        found.iter().filter(is_clear).copied().collect()
    }

    /// Accepts the chains that end at a submap.
    fn accept(&mut self, query: usize) -> Result<(), ClosingError> {
        let (pose, travelled) =
            (|submap: usize| self.pose(submap), |submap: usize| self.submaps[submap].travelled);
        let chains = self.tentative[query].iter().filter(|last| last.is_firm).map(|last| {
            if last.found.spread <= self.options.well_known {
                recent(&last.found, &self.tentative, travelled, pose)
            } else {
                chain(last, &self.tentative)
            }
        });
        let added: Vec<Match> = chains.filter(|chain| self.is_convincing(chain)).flatten().collect();
        let mut farthest: f64 = 0.0;
        for one in added {
            farthest = farthest.max(self.add(one)?);
        }
        if farthest > MOVED {
            let solution = solve(&self.graph, &Options::default())?;
            self.graph.set_poses(solution.poses)?;
        }
        Ok(())
    }

    /// Whether matches that tell the same, the last one first, are no chance: many, or strong, or where they were expected. The
    /// less is known of where the robot is, the more that looks alike may be there, and the longer it has to look alike: a match
    /// more for each two doublings of the standard deviation.
    fn is_convincing(&self, chain: &[Match]) -> bool {
        let options = self.options;
        let score = chain.iter().map(|found| found.score).sum::<f64>() / chain.len() as f64;
        let is_strong = score >= options.strong_score || chain.iter().all(|found| found.is_expected);
        let spread = chain.iter().map(|found| found.spread).fold(f64::INFINITY, f64::min);
        if spread <= options.well_known {
            return chain.len() + usize::from(is_strong) >= options.least_chain;
        }
        let doublings = (spread / options.well_known).log2().min(MOST_DOUBLINGS);
        chain.len() >= options.least_chain + (doublings / 2.0).ceil() as usize
    }

    /// Adds a match to the graph, if it is not there yet, and tells how far off it is: metres, and 10 for a radian.
    fn add(&mut self, one: Match) -> Result<f64, ClosingError> {
        if self.accepted.iter().any(|other| (other.query, other.reference) == (one.query, one.reference)) {
            return Ok(0.0);
        }
        let [from, to] = [one.reference, one.query].map(|submap| self.submaps[submap].middle);
        let (start, end) = (PoseId(from as u32), PoseId(to as u32));
        let edge = Edge::observed(start, end, one.relative.mean, &one.relative.covariance);
        let off = edge.error(self.graph.poses()[from], self.graph.poses()[to]);
        self.graph.add_edge(edge)?;
        if one.slide.is_none() {
            self.ways.add([one.reference, one.query], CLOSURE_LENGTH, one.relative)?;
        }
        self.accepted.push(one);
        Ok(off.xy().norm().max(10.0 * off.z.abs()))
    }

    /// The poses that a submap may have in the frame of an earlier one.
    fn window(&self, here: Pose, reference: usize, known: Known) -> Window {
        let options = self.options;
        Window {
            center: self.pose(reference).between(here),
            across: (options.window.0 + options.window.1 * known.length).min(options.largest_window.0),
            around: (options.heading_window.0 + options.heading_window.1 * known.length)
                .min(options.largest_window.1),
        }
    }

    /// The robust minimum with keyframes matched one by one, and all scans in one graph.
    fn finish(mut self, track: &Track) -> Result<ClosedTrack, ClosingError> {
        let mut robust = self.solve_robustly()?;
        let middle = |submap: usize| self.submaps[submap].middle;
        let believed = self.accepted.iter().zip(&robust.weights[self.tracked..]);
        let believed: Vec<(usize, usize)> = believed
            .filter(|&(_, &weight)| weight >= BELIEVED)
            .map(|(found, _)| (middle(found.reference), middle(found.query)))
            .collect();
        let found = self.graph.clone();
        for _ in 0..self.options.refinements {
            self.graph = found.clone();
            for fine in refine(&self.keyframes, &robust.poses, &believed, self.options) {
                let (from, to) = (PoseId(fine.from as u32), PoseId(fine.to as u32));
                let UncertainPose { mean, covariance } = fine.relative;
                self.graph.add_edge(Edge::observed(from, to, mean, &covariance))?;
            }
            self.graph.set_poses(robust.poses)?;
            robust = self.solve_robustly()?;
        }
        let scan = |submap: usize| self.keyframes[self.submaps[submap].middle].scan;
        let closures = self.accepted.iter().zip(&robust.weights[self.tracked..]);
        let closures = closures.map(|(found, &weight)| Closure {
            earlier: scan(found.reference),
            later: scan(found.query),
            relative: found.relative.mean,
            covariance: found.relative.covariance,
            agreement: found.agreement,
            spread: found.spread,
            off: found.off,
            weight,
        });
        let closures = closures.collect();
        let between = reweighted(&self.graph, &robust.poses, &robust.weights);
        let graph = all_scans(track, &self.keyframes, &between)?;
        self.graph.set_poses(robust.poses)?;
        Ok(ClosedTrack { graph, closures, alike: self.looks_alike() })
    }

    /// What looks alike, once it is known where all submaps are.
    fn looks_alike(&self) -> Alike {
        let scan = |submap: usize| self.keyframes[self.submaps[submap].middle].scan;
        let pose = |submap: usize| self.pose(submap);
        let mut pairs = Alike::default();
        for (query, alike) in self.alike.iter().enumerate().filter(|(_, alike)| !alike.is_empty()) {
            let known = self.ways.from(query, pose);
            for found in alike {
                let mut apart = told(found, pose).translation() - pose(query).translation();
                let across = known[found.reference].across;
                // How far along a corridor the robot is, a match that can be slid does not tell: that is known, or it is not.
                if let Some(axis) = found.slide.filter(|_| across <= self.options.well_known) {
                    let axis = pose(found.reference).rotation() * axis;
                    apart -= axis * axis.dot(&apart);
                }
                let off = apart.norm();
                let scans = (scan(found.reference), scan(query));
                if off <= THERE {
                    pairs.expected.push(scans);
                } else if off < POSSIBLE * across {
                    pairs.possible.push(scans);
                }
            }
        }
        pairs
    }

    /// The minimum in which closures that the rest contradicts count little.
    fn solve_robustly(&self) -> Result<RobustSolution, SolveError> {
        // Track edges lead from a keyframe to the next, closures never do.
        let is_closure = |edge: &Edge| edge.to.0 != edge.from.0 + 1;
        let kernel = |edge: &Edge| is_closure(edge).then_some(Kernel::DynamicCovarianceScaling(KERNEL));
        solve_robustly(&self.graph, kernel, &Options::default())
    }
}
