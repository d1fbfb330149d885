//! `hssh graph`: the poses of a pose graph that contradict its measurements least, as numbers and pictures.

mod optimize;
mod report;

use std::io::{BufRead, BufReader};
use std::time::Instant;

use hssh_draw::{EdgeKind, PoseGraphOptions, draw_pose_graph};
use hssh_metrics::{
    BayesNetwork, GraphFile, Marginals, PoseGraph, PoseId, closures, read_pose_graph, reweighted,
};
use nalgebra::Matrix2;

use crate::arguments::GraphArguments;
use crate::failure::{Failure, Status};
use crate::output::{print, print_json, write_file};

use optimize::{Optimum, optimize};
use report::account;

/// Up to this many poses are drawn with the ellipse of their covariance.
const MOST_ELLIPSES: usize = 40;

pub(crate) fn run(options: &GraphArguments) -> Result<Status, Failure> {
    let started = Instant::now();
    let mut file = read(options)?;
    let reading = started.elapsed().as_secs_f64();
    let held = file.graph.anchor_components();
    let started = Instant::now();
    let optimum = optimize(options, &file)?;
    let solving = started.elapsed().as_secs_f64();

    let kinds = edge_kinds(&file.graph, &optimum.weights);
    let name = options.file.display().to_string();
    let report = account(name, &file, &held, &kinds, &optimum, [reading, solving]);
    if options.json {
        print_json(&report)?;
    } else {
        print(&report.to_string())?;
    }
    write_files(options, file, &kinds, &optimum)?;
    Ok(if optimum.finished { Status::Found } else { Status::Stopped })
}

/// The pose graph in the file, or on standard input; one without poses is refused.
fn read(options: &GraphArguments) -> Result<GraphFile, Failure> {
    let file = &options.file;
    let unreadable = |error| Failure::ReadGraph { file: file.clone(), error };
    let reader: Box<dyn BufRead> = if file.as_os_str() == "-" {
        Box::new(std::io::stdin().lock())
    } else {
        Box::new(BufReader::new(std::fs::File::open(file).map_err(unreadable)?))
    };
    let read = read_pose_graph(reader)
        .map_err(|error| Failure::Graph { file: file.clone(), error: Box::new(error) })?;
    if read.graph.poses().is_empty() {
        let skipped = match read.skipped.first() {
            None => "it has no records at all".to_owned(),
            Some(first) => format!(
                "its {} records are of types that hssh does not know, the first is `{}` on line {}",
                read.skipped.len(),
                first.record,
                first.line
            ),
        };
        return Err(Failure::EmptyGraph { file: file.clone(), skipped });
    }
    Ok(read)
}

fn edge_kinds(graph: &PoseGraph, weights: &[f64]) -> Vec<EdgeKind> {
    let kind = |(closes, &weight): (bool, &f64)| match closes {
        _ if weight == 0.0 => EdgeKind::Refused,
        true => EdgeKind::Closure,
        false => EdgeKind::Odometry,
    };
    closures(graph).into_iter().zip(weights).map(kind).collect()
}

/// Writes what was asked for: the picture, and the optimized graph and its Bayes network without refused edges.
fn write_files(
    options: &GraphArguments,
    mut file: GraphFile,
    kinds: &[EdgeKind],
    optimum: &Optimum,
) -> Result<(), Failure> {
    file.graph.set_poses(optimum.poses.clone()).expect("there is one pose for each");
    if let Some(out) = &options.svg {
        let name =
            options.file.file_stem().map_or_else(|| "pose graph".into(), |stem| stem.to_string_lossy());
        let believed = reweighted(&file.graph, &optimum.poses, &optimum.weights);
        let drawn = PoseGraphOptions {
            title: Some(format!("{name}: {} poses, {} edges", believed.poses().len(), kinds.len())),
            kinds: kinds.to_vec(),
            covariances: covariances(&believed)?,
        };
        write_file(out, &draw_pose_graph(&file.graph, &drawn))?;
    }
    let accepted: Vec<f64> = optimum.weights.iter().map(|weight| weight.ceil()).collect();
    file.graph = reweighted(&file.graph, &optimum.poses, &accepted);
    if let Some(out) = &options.g2o {
        write_file(out, &file.to_g2o())?;
    }
    if let Some(out) = &options.dot {
        write_file(out, &BayesNetwork::from(&file.graph).to_dot())?;
    }
    Ok(())
}

/// The covariances of the positions of free poses, evenly chosen if there are many.
fn covariances(graph: &PoseGraph) -> Result<Vec<(PoseId, Matrix2<f64>)>, Failure> {
    let marginals = Marginals::new(graph)?;
    let free: Vec<PoseId> = graph.pose_ids().filter(|&pose| !graph.is_anchored(pose)).collect();
    let stride = free.len().div_ceil(MOST_ELLIPSES).max(1);
    let chosen = free.into_iter().rev().step_by(stride); // the last pose is one of them
    let position = |pose| marginals.covariance(pose).fixed_view::<2, 2>(0, 0).into_owned();
    Ok(chosen.map(|pose| (pose, position(pose))).collect())
}
