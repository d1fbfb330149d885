//! The loop over the submaps in the order of the log: look for each among the earlier ones near to where it is
//! believed to be, accept chains of matches, and solve the pose graph anew where they move it.

use hssh_metrics::{
    Covariance, Edge, GraphError, Kernel, Options, Pose, PoseGraph, PoseId, SolveError, solve, solve_robustly,
};

use super::chain::{agree, told};
use super::keyframe::{Keyframe, keyframes};
use super::matching::{Match, find};
use super::options::ClosingOptions;
use super::search::Window;
use super::submap::{Submap, middles};
use crate::carmen::LaserLog;
use crate::grid::LatticeError;
use crate::matching::Track;
use crate::progress::Reply;

/// How often the log is gone through: what was not found where it was believed to be may be found later.
const SWEEPS: usize = 2;
/// So many submaps back a match may have its chain.
const CHAIN_MEMORY: usize = 4;
/// Of one submap at most so many others are looked into.
const MOST_CANDIDATES: usize = 8;
/// A closure costs a way so long when it is asked how well two poses are known to one another: metres.
const CLOSURE_LENGTH: f64 = 1.0;
/// Moved farther than this, in metres, the graph is solved anew.
const MOVED: f64 = 0.1;
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
    /// By which factor it counts in the end: near 0 if the rest contradicts it.
    pub weight: f64,
}

/// A track with its loops closed.
#[derive(Clone, PartialEq, Debug)]
pub struct ClosedTrack {
    /// The robot at each scan, in the frame of the first.
    pub poses: Vec<Pose>,
    /// What holds it together beside the tracked motion.
    pub closures: Vec<Closure>,
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
    /// No least squares.
    #[error("the pose graph of the scans cannot be solved: {0}")]
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

struct Closing<'a> {
    options: &'a ClosingOptions,
    keyframes: Vec<Keyframe>,
    submaps: Vec<Submap>,
    graph: PoseGraph,
    /// How many edges are the track's.
    tracked: usize,
    /// By query.
    tentative: Vec<Vec<Match>>,
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
        let tentative = vec![Vec::new(); submaps.len()];
        Ok(Closing { options, keyframes, submaps, graph, tracked, tentative, accepted: Vec::new() })
    }

    /// Where the middle of a submap is believed to be.
    fn pose(&self, submap: usize) -> Pose {
        self.graph.poses()[self.submaps[submap].middle]
    }

    /// Looks for one submap among those before.
    fn close(&mut self, query: usize) -> Result<(), ClosingError> {
        let mut tried: Vec<usize> = Vec::new();
        let mut found: Vec<Match> = Vec::new();
        for (_, reference, window) in self.candidates(query) {
            let is_like = |&other: &usize| {
                let travel = self.submaps[other].travelled - self.submaps[reference].travelled;
                travel.abs() < 1.5 * self.options.stretch
            };
            if tried.iter().any(is_like) {
                continue;
            }
            tried.push(reference);
            let matched = find(&self.submaps, &self.keyframes, (query, reference), &window, self.options);
            found.extend(matched.filter(|found| self.is_good(found)));
            if tried.len() >= MOST_CANDIDATES {
                break;
            }
        }
        self.tentative[query] = self.unambiguous(&found);
        self.accept(query)
    }

    /// The earlier submaps that a submap may lie on: how far off each is believed to be, and where to look. The
    /// nearest first.
    fn candidates(&self, query: usize) -> Vec<(f64, usize, Window)> {
        let here = self.pose(query);
        let is_long_ago = |reference: usize| {
            self.submaps[query].travelled - self.submaps[reference].travelled >= self.options.least_travel
        };
        let mut candidates: Vec<(f64, usize, Window)> = Vec::new();
        for (reference, way) in self.ways(query).into_iter().enumerate().take(query) {
            let window = self.window(here, reference, way);
            let off = window.center.translation().norm();
            if is_long_ago(reference) && off < window.across + self.options.stretch / 2.0 {
                candidates.push((off, reference, window));
            }
        }
        candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
        candidates
    }

    /// Whether a match is good enough to be one in a chain.
    fn is_good(&self, found: &Match) -> bool {
        found.is_clear
            && found.agreement >= self.options.least_agreement
            && found.overlap >= self.options.least_overlap
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
        let pose = |submap: usize| self.pose(submap);
        let mut added: Vec<Match> = Vec::new();
        for found in &self.tentative[query] {
            let mut chain = vec![*found];
            for before in query.saturating_sub(CHAIN_MEMORY)..query {
                let travel = self.submaps[query].travelled - self.submaps[before].travelled;
                let same = self.tentative[before].iter().filter(|other| agree(other, found, travel, pose));
                chain.extend(same.max_by(|a, b| a.score.total_cmp(&b.score)));
            }
            if self.is_convincing(&chain) {
                added.extend(chain);
            }
        }
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

    /// Whether matches that tell the same are no chance: many, or strong, or where they were expected.
    fn is_convincing(&self, chain: &[Match]) -> bool {
        let score = chain.iter().map(|found| found.score).sum::<f64>() / chain.len() as f64;
        let is_strong = score >= self.options.strong_score || chain.iter().all(|found| found.is_expected);
        chain.len() + usize::from(is_strong) >= self.options.least_chain
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
        self.accepted.push(one);
        Ok(off.xy().norm().max(10.0 * off.z.abs()))
    }

    /// The poses that a submap may have in the frame of an earlier one.
    fn window(&self, here: Pose, reference: usize, way: f64) -> Window {
        let options = self.options;
        Window {
            center: self.pose(reference).between(here),
            across: (options.window.0 + options.window.1 * way).min(options.largest_window.0),
            around: (options.heading_window.0 + options.heading_window.1 * way).min(options.largest_window.1),
        }
    }

    /// How long the way is, by track and closures, from a submap to each earlier one: what the uncertainty of
    /// their relative pose grows with.
    fn ways(&self, from: usize) -> Vec<f64> {
        let count = self.submaps.len();
        let mut ways = vec![f64::INFINITY; count];
        let mut neighbors: Vec<Vec<(usize, f64)>> = vec![Vec::new(); count];
        for later in 1..count {
            let length = self.submaps[later].travelled - self.submaps[later - 1].travelled;
            neighbors[later].push((later - 1, length));
            neighbors[later - 1].push((later, length));
        }
        for closure in self.accepted.iter().filter(|closure| closure.slide.is_none()) {
            neighbors[closure.query].push((closure.reference, CLOSURE_LENGTH));
            neighbors[closure.reference].push((closure.query, CLOSURE_LENGTH));
        }
        let mut open = std::collections::BinaryHeap::new();
        ways[from] = 0.0;
        open.push((std::cmp::Reverse(0_u64), from));
        while let Some((std::cmp::Reverse(millimetres), submap)) = open.pop() {
            if millimetres as f64 / 1e3 > ways[submap] + 1e-3 {
                continue;
            }
            for &(next, length) in &neighbors[submap] {
                let way = ways[submap] + length;
                if way < ways[next] {
                    ways[next] = way;
                    open.push((std::cmp::Reverse((way * 1e3) as u64), next));
                }
            }
        }
        ways
    }

    /// The robust minimum, and the corrections between keyframes.
    fn finish(self, track: &Track) -> Result<ClosedTrack, ClosingError> {
        // Track edges lead from a keyframe to the next, closures never do.
        let is_closure = |edge: &Edge| edge.to.0 != edge.from.0 + 1;
        let kernel = |edge: &Edge| is_closure(edge).then_some(Kernel::DynamicCovarianceScaling(KERNEL));
        let robust = solve_robustly(&self.graph, kernel, &Options::default())?;
        let scan = |submap: usize| self.keyframes[self.submaps[submap].middle].scan;
        let closures = self.accepted.iter().zip(&robust.weights[self.tracked..]);
        let closures = closures.map(|(found, &weight)| Closure {
            earlier: scan(found.reference),
            later: scan(found.query),
            relative: found.relative.mean,
            covariance: found.relative.covariance,
            agreement: found.agreement,
            weight,
        });
        Ok(ClosedTrack { poses: spread(&self.keyframes, &robust.poses, track), closures: closures.collect() })
    }
}

/// The pose of every scan: between keyframes the tracked motion, bent so that it begins and ends at theirs.
fn spread(keyframes: &[Keyframe], poses: &[Pose], track: &Track) -> Vec<Pose> {
    let mut all = vec![Pose::IDENTITY; track.scans.len()];
    for (index, pair) in keyframes.windows(2).enumerate() {
        let (start, end) = (poses[index], poses[index + 1]);
        let last = start.compose(pair[0].tracked.between(pair[1].tracked));
        let correction = last.between(end).log();
        let length = (pair[1].scan - pair[0].scan) as f64;
        let scans = pair[0].scan..=pair[1].scan;
        for (number, scan) in scans.enumerate() {
            let moved = start.compose(pair[0].tracked.between(track.scans[scan].pose));
            all[scan] = moved.compose(Pose::exp(correction * (number as f64 / length)));
        }
    }
    if let ([_], [only]) = (keyframes, poses) {
        all.fill(*only);
    }
    all
}
