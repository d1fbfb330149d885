//! How long it takes to solve the public pose graphs, from chordal poses to convergence.

use std::hint::black_box;
use std::io::BufReader;
use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use hssh_metrics::{Options, PoseGraph, chordal_poses, read_pose_graph, solve};

const FILES: [&str; 8] = [
    "MIT.g2o",
    "CSAIL.g2o",
    "CSAIL_P_toro.graph",
    "intel.g2o",
    "manhattan.g2o",
    "input_M3500b_g2o.g2o",
    "ring.g2o",
    "noisyToyGraph.txt",
];

fn read(folder: &Path, name: &str) -> PoseGraph {
    let file = std::fs::File::open(folder.join(name)).expect("HSSH_DATA holds posegraph/ with this file");
    let mut graph = read_pose_graph(BufReader::new(file)).expect("a public pose graph is well-formed").graph;
    graph.anchor_components();
    graph
}

#[allow(clippy::print_stdout)] // says why nothing is measured
fn pose_graphs(criterion: &mut Criterion) {
    let Some(data) = std::env::var_os("HSSH_DATA") else {
        println!("skipped: set HSSH_DATA to the folder that holds posegraph/");
        return;
    };
    let folder = Path::new(&data).join("posegraph");
    for name in FILES {
        let mut graph = read(&folder, name);
        criterion.bench_function(&format!("chordal/{name}"), |bencher| {
            bencher.iter(|| chordal_poses(black_box(&graph)));
        });
        let start = chordal_poses(&graph).expect("every component is anchored");
        graph.set_poses(start).expect("there is one pose for each");
        criterion.bench_function(&format!("solve/{name}"), |bencher| {
            bencher.iter(|| solve(black_box(&graph), &Options::default()));
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = pose_graphs
}
criterion_main!(benches);
