//! How many wrong closures among many poses are doubted, and how many right ones.

use std::error::Error;
use std::f64::consts::FRAC_PI_2;

use hssh_metrics::{
    Covariance, Edge, Kernel, Options, Pose, PoseGraph, PoseId, odometry_poses, screen_closures,
    solve_robustly,
};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::table::{aligned, grouped};

const POSES: usize = 10_000;
const WRONG: usize = 100;
/// The robot walks among crossings this far from the first one at most, a metre from one to the next.
const REACH: i32 = 30;
/// One visit to a known crossing in so many is noticed.
const NOTICED: f64 = 0.3;
/// A weight below this is a doubt: the program says so, too.
const DOUBT: f64 = 0.5;

/// `cargo xtask bench wrong-closures`.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    println!(
        "{WRONG} wrong closures among {} poses that walk a grid of streets, from dead reckoning.\n",
        grouped(POSES as u64)
    );
    let heads = ["m", "rad", "right", "method", "wrong doubted", "right doubted", "rounds"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for (metres, radians) in [(0.03, 0.005), (0.05, 0.01), (0.1, 0.03)] {
        let walk = Walk::new(metres, radians)?;
        let is_closure = |edge: &Edge| edge.from.0 + 1 != edge.to.0;
        let screening = screen_closures(&walk.graph, is_closure, 11.34, &Options::default())?;
        let kernel = |edge: &Edge| is_closure(edge).then_some(Kernel::DynamicCovarianceScaling(9.0));
        let robust =
            solve_robustly(&walk.graph, kernel, &Options { max_iterations: 50, ..Options::default() })?;
        let refused: Vec<bool> = screening.accepted.iter().map(|accepted| !accepted).collect();
        let doubted: Vec<bool> = robust.weights.iter().map(|weight| *weight < DOUBT).collect();
        for (method, doubted, rounds) in
            [("graduated", refused, screening.rounds), ("dcs", doubted, robust.rounds)]
        {
            let count = |edges: &[bool]| edges.iter().filter(|&&doubted| doubted).count().to_string();
            let closures = &doubted[POSES - 1..];
            rows.push(vec![
                metres.to_string(),
                radians.to_string(),
                walk.right.to_string(),
                method.to_owned(),
                count(&closures[walk.right..]),
                count(&closures[..walk.right]),
                rounds.to_string(),
            ]);
        }
    }
    println!("{}", aligned(&rows));
    println!("A threshold of 11.34 refuses one right closure in a hundred.");
    Ok(())
}

/// A walk along streets with its closures: odometry first, then those that are right, then those that are not.
struct Walk {
    graph: PoseGraph,
    right: usize,
}

impl Walk {
    fn new(metres: f64, radians: f64) -> Result<Self, Box<dyn Error>> {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let covariance = Covariance::from_standard_deviations(metres, metres, radians)?;
        let truth = walk(&mut random);
        let pose =
            |index: usize| Pose::new(f64::from(truth[index].0), f64::from(truth[index].1), truth[index].2);
        let mut graph = PoseGraph::new();
        truth.iter().for_each(|_| _ = graph.add_pose(Pose::IDENTITY));
        graph.anchor(PoseId(0))?;
        let mut measure = |from: usize, to: usize, exact: Pose, random: &mut ChaCha8Rng| {
            let mut error = |deviation: f64| -> f64 {
                let standard: f64 = StandardNormal.sample(random);
                deviation * standard
            };
            let measured =
                Pose::new(exact.x + error(metres), exact.y + error(metres), exact.theta + error(radians));
            graph.add_edge(Edge::observed(PoseId(from as u32), PoseId(to as u32), measured, &covariance))
        };
        for index in 1..truth.len() {
            measure(index - 1, index, pose(index - 1).between(pose(index)), &mut random)?;
        }
        let mut right = 0;
        for later in 0..truth.len() {
            let is_here =
                |&earlier: &usize| (truth[earlier].0, truth[earlier].1) == (truth[later].0, truth[later].1);
            let before: Vec<usize> = (0..later.saturating_sub(20)).filter(is_here).collect();
            if !before.is_empty() && random.random_bool(NOTICED) {
                let earlier = before[random.random_range(0..before.len())];
                measure(earlier, later, pose(earlier).between(pose(later)), &mut random)?;
                right += 1;
            }
        }
        for _ in 0..WRONG {
            // Two crossings that look alike.
            let earlier = random.random_range(0..truth.len() - 100);
            let later = random.random_range(earlier + 50..truth.len());
            let turn = FRAC_PI_2 * f64::from(random.random_range(0..4_u8));
            let (x, y) = (random.random_range(-0.5..0.5), random.random_range(-0.5..0.5));
            measure(earlier, later, Pose::new(x, y, turn), &mut random)?;
        }
        let start = odometry_poses(&graph)?;
        graph.set_poses(start)?;
        Ok(Walk { graph, right })
    }
}

/// Crossing by crossing, with the heading in which the robot stands there.
fn walk(random: &mut impl Rng) -> Vec<(i32, i32, f64)> {
    const AHEAD: [(i32, i32); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];
    let (mut x, mut y, mut heading) = (0_i32, 0_i32, 0_usize);
    let mut walk = Vec::with_capacity(POSES);
    while walk.len() < POSES {
        walk.push((x, y, FRAC_PI_2 * heading as f64));
        let (dx, dy) = AHEAD[heading];
        (x, y) = (x + dx, y + dy);
        let is_at_edge = |turn: usize| {
            let (dx, dy) = AHEAD[(heading + turn) % 4];
            (x + dx).abs() > REACH || (y + dy).abs() > REACH
        };
        let wish = if random.random_bool(0.1) { [1, 3][random.random_range(0..2)] } else { 0 };
        let turn = [wish, 1, 3, 0].into_iter().find(|&turn| !is_at_edge(turn)).unwrap_or(2);
        heading = (heading + turn) % 4;
    }
    walk
}
