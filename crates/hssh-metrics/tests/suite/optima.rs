//! The reference optima of public pose graphs, from edges alone and from the files' own poses.

use std::io::BufReader;

use hssh_metrics::{
    GraphFile, Options, Pose, PoseGraph, Solution, chordal_poses, odometry_poses, read_pose_graph, solve,
    solve_from_anywhere,
};

/// File, poses, edges, χ² at the best known optimum; whether dead reckoning, and the file's poses if it has
/// any, lead there.
const OPTIMA: [(&str, usize, usize, f64, bool); 7] = [
    ("MIT.g2o", 808, 827, 41.163269, false),
    ("CSAIL.g2o", 1045, 1172, 40.555129, true),
    ("intel.g2o", 1728, 2512, 45.004696, true),
    ("manhattan.g2o", 3500, 5453, 3549.0368, true),
    ("input_M3500b_g2o.g2o", 3500, 5453, 2054.7159, false),
    ("ring.g2o", 434, 459, 11.163101, true),
    ("noisyToyGraph.txt", 4, 5, 0.13665202, true),
];

#[allow(clippy::print_stdout)] // says why nothing is tested
fn read(name: &str) -> Option<GraphFile> {
    let Some(data) = std::env::var_os("HSSH_DATA") else {
        println!("skipped: set HSSH_DATA to the folder that holds posegraph/{name}");
        return None;
    };
    let path = std::path::Path::new(&data).join("posegraph").join(name);
    let reader = BufReader::new(std::fs::File::open(&path).unwrap());
    let mut file = read_pose_graph(reader).unwrap();
    assert!(file.skipped.is_empty());
    file.graph.anchor_components();
    Some(file)
}

fn solve_from(graph: &PoseGraph, poses: Vec<Pose>) -> Solution {
    let mut graph = graph.clone();
    graph.set_poses(poses).unwrap();
    solve(&graph, &Options::default()).unwrap()
}

fn assert_optimum(name: &str, solution: &Solution, chi2: f64) {
    assert!(solution.is_converged(), "{name}: {:?}", solution.stop);
    assert!((solution.chi2 - chi2).abs() < 1e-6 * chi2, "{name}: {} instead of {chi2}", solution.chi2);
}

#[test]
fn every_optimum_is_reached_from_edges_alone() {
    for (name, poses, edges, chi2, _) in OPTIMA {
        let Some(GraphFile { graph, .. }) = read(name) else { return };
        assert_eq!((graph.poses().len(), graph.edges().len()), (poses, edges), "{name}");
        assert_optimum(name, &solve_from(&graph, chordal_poses(&graph).unwrap()), chi2);
    }
}

#[test]
fn optima_are_reached_from_dead_reckoning_and_from_files_where_they_set_no_trap() {
    for (name, _, _, chi2, _) in OPTIMA.into_iter().filter(|&(.., safe)| safe) {
        let Some(GraphFile { graph, unplaced, .. }) = read(name) else { return };
        assert_optimum(name, &solve_from(&graph, odometry_poses(&graph).unwrap()), chi2);
        if unplaced.is_empty() {
            assert_optimum(name, &solve_from(&graph, graph.poses().to_vec()), chi2);
        }
    }
}

#[test]
fn the_poses_of_the_mit_file_are_the_known_trap() {
    let Some(GraphFile { graph, .. }) = read("MIT.g2o") else { return };
    let solution = solve_from(&graph, graph.poses().to_vec());
    assert!(solution.is_converged() && (solution.chi2 - 770.66).abs() < 0.01, "{}", solution.chi2);
}

#[test]
fn every_optimum_is_reached_from_anywhere() {
    for (name, _, _, chi2, _) in OPTIMA {
        let Some(GraphFile { mut graph, .. }) = read(name) else { return };
        assert_optimum(name, &solve_from_anywhere(&graph, &Options::default()).unwrap(), chi2);
        graph.set_poses(odometry_poses(&graph).unwrap()).unwrap();
        assert_optimum(name, &solve_from_anywhere(&graph, &Options::default()).unwrap(), chi2);
    }
}

/// No reference is published for this file: two starts have to agree.
#[test]
fn the_toro_file_has_one_optimum_from_both_starts() {
    let Some(GraphFile { graph, .. }) = read("CSAIL_P_toro.graph") else { return };
    let from_file = solve_from(&graph, graph.poses().to_vec());
    assert_optimum("CSAIL_P_toro.graph", &solve_from(&graph, chordal_poses(&graph).unwrap()), from_file.chi2);
}
