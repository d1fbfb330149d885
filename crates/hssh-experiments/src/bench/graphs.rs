//! The public pose graphs from every start: χ², iterations and time, and how far ring is from the truth.

use std::error::Error;
use std::fs;
use std::path::Path;

use hssh_metrics::{
    GraphFile, Options, Pose, PoseGraph, chordal_poses, odometry_poses, solve, solve_from_anywhere,
};
use nalgebra::Vector2;

use crate::pose_graphs::{PUBLIC, folder, read, time};
use crate::table::aligned;

/// How closely χ² must agree with the best known optimum, relatively.
const AGREEMENT: f64 = 1e-6;

/// `cargo xtask bench graphs`; an error if a graph is not solved to its best known optimum.
pub(crate) fn run(data: Option<&Path>, runs: usize) -> Result<(), Box<dyn Error>> {
    let folder = folder(data)?;
    println!(
        "Pose graphs from every start, one thread, medians of {runs} runs. `solve` descends from the start"
    );
    println!(
        "given; `solve_from_anywhere` does not let it mislead, its time includes finding chordal poses.\n"
    );
    let heads =
        ["", "start", "start χ²", "solve χ²", "systems", "ms", "anywhere χ²", "systems", "ms", "off by"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    let mut wrong = Vec::new();
    for (name, best_known) in PUBLIC {
        let file = read(&folder, name)?;
        let best_known = best_known.map_or_else(|| lowest(&file), Ok)?;
        for (start, poses) in starts(&file)? {
            let mut graph = file.graph.clone();
            graph.set_poses(poses)?;
            let off_by = measure(name, start, &graph, best_known, runs, &mut rows)?;
            if off_by.abs() > AGREEMENT {
                wrong.push(format!("{name} from {start}"));
            }
        }
    }
    println!("{}\n{}", aligned(&rows), ring_against_truth(&folder)?);
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(format!("not the best known optimum: {}", wrong.join(", ")).into()),
    }
}

/// χ² where no reference is known: the lower one of two starts.
fn lowest(file: &GraphFile) -> Result<f64, Box<dyn Error>> {
    let from_file = solve(&file.graph, &Options::default())?.chi2;
    Ok(from_file.min(solve_from_anywhere(&file.graph, &Options::default())?.chi2))
}

/// Poses to begin at, and where they come from.
type Start = (&'static str, Vec<Pose>);

/// The poses that a graph may be solved from; the file's only if it has all.
fn starts(file: &GraphFile) -> Result<Vec<Start>, Box<dyn Error>> {
    let mut starts = Vec::new();
    if file.unplaced.is_empty() {
        starts.push(("file", file.graph.poses().to_vec()));
    }
    starts.push(("odometry", odometry_poses(&file.graph)?));
    starts.push(("edges only", chordal_poses(&file.graph)?));
    Ok(starts)
}

/// Adds a row, and returns by how much `solve_from_anywhere` misses the best known χ², relatively.
fn measure(
    name: &str,
    start: &str,
    graph: &PoseGraph,
    best_known: f64,
    runs: usize,
    rows: &mut Vec<Vec<String>>,
) -> Result<f64, Box<dyn Error>> {
    let options = Options::default();
    let (from_start, anywhere) = (solve(graph, &options)?, solve_from_anywhere(graph, &options)?);
    let milliseconds = |seconds: f64| format!("{:.3}", 1e3 * seconds);
    let off_by = (anywhere.chi2 - best_known) / best_known;
    rows.push(vec![
        name.to_owned(),
        start.to_owned(),
        format!("{:.4e}", graph.chi2()),
        significant(from_start.chi2),
        from_start.iterations.to_string(),
        milliseconds(time(runs, || solve(graph, &options)).median),
        significant(anywhere.chi2),
        anywhere.iterations.to_string(),
        milliseconds(time(runs, || solve_from_anywhere(graph, &options)).median),
        format!("{off_by:.0e}"),
    ]);
    Ok(off_by)
}

/// Eight significant digits, as the best known values are printed.
fn significant(chi2: f64) -> String {
    let digits = 7 - chi2.log10().floor() as i32;
    format!("{chi2:.*}", digits.clamp(0, 12) as usize)
}

/// How far the solution of ring is from the poses that it was simulated with.
fn ring_against_truth(folder: &Path) -> Result<String, Box<dyn Error>> {
    let truth = read_truth(&folder.join("ring-groundtruth-poses.txt"))?;
    let file = read(folder, "ring.g2o")?;
    let found = solve_from_anywhere(&file.graph, &Options::default())?.poses;
    let reckoned = odometry_poses(&file.graph)?;
    if truth.len() != found.len() {
        return Err(format!("ring has {} poses, but {} true ones", found.len(), truth.len()).into());
    }
    let mut rows = vec![["ring", "position m", "aligned m", "heading rad"].map(str::to_owned).to_vec()];
    for (name, poses) in [("dead reckoning", reckoned), ("solved", found)] {
        let [position, aligned, heading] =
            root_mean_squares(&poses, &truth).map(|error| format!("{error:.3}"));
        rows.push(vec![name.to_owned(), position, aligned, heading]);
    }
    let text = "Root mean square errors of ring's poses against the truth: from pose 0 on, and after the best turn\n\
                and shift of all.\n\n";
    Ok(format!("{text}{}", aligned(&rows)))
}

/// One pose a line: index, x, y, θ.
fn read_truth(path: &Path) -> Result<Vec<Pose>, Box<dyn Error>> {
    let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let pose = |(index, line): (usize, &str)| -> Result<Pose, Box<dyn Error>> {
        let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        match numbers.as_deref() {
            Ok(&[_, x, y, theta]) => Ok(Pose::new(x, y, theta)),
            _ => Err(format!("{}, line {}: not `index x y theta`", path.display(), index + 1).into()),
        }
    };
    text.lines().enumerate().map(pose).collect()
}

/// Of positions, of positions after a rigid alignment, and of headings.
fn root_mean_squares(poses: &[Pose], truth: &[Pose]) -> [f64; 3] {
    let count = poses.len() as f64;
    let pairs = || poses.iter().zip(truth);
    let mean = |poses: &[Pose]| poses.iter().map(|pose| pose.translation()).sum::<Vector2<f64>>() / count;
    let (center, true_center) = (mean(poses), mean(truth));
    // The turn that maximizes Σ q·R p has the tangent Σ p×q / Σ p·q.
    let (mut cross, mut dot) = (0.0, 0.0);
    for (pose, truth) in pairs() {
        let (p, q) = (pose.translation() - center, truth.translation() - true_center);
        cross += p.perp(&q);
        dot += p.dot(&q);
    }
    let turn = Pose::new(0.0, 0.0, cross.atan2(dot)).rotation();
    let root_mean = |squares: f64| (squares / count).sqrt();
    [
        root_mean(
            pairs().map(|(pose, truth)| (pose.translation() - truth.translation()).norm_squared()).sum(),
        ),
        root_mean(
            pairs()
                .map(|(pose, truth)| {
                    (turn * (pose.translation() - center) - (truth.translation() - true_center))
                        .norm_squared()
                })
                .sum(),
        ),
        root_mean(pairs().map(|(pose, truth)| truth.between(*pose).theta.powi(2)).sum()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A turned and shifted copy has no error once it is aligned.
    #[test]
    fn alignment_undoes_a_rigid_motion() {
        let truth: Vec<Pose> =
            (0..9).map(|i| Pose::new(f64::from(i), f64::from(i * i % 5), 0.3 * f64::from(i))).collect();
        let motion = Pose::new(4.0, -2.0, 2.5);
        let moved: Vec<Pose> = truth.iter().map(|pose| motion.compose(*pose)).collect();
        let [position, aligned, heading] = root_mean_squares(&moved, &truth);
        assert!(position > 1.0 && aligned < 1e-12 && (heading - 2.5).abs() < 1e-12);
    }
}
