//! `hssh graph`: the poses of a pose graph that contradict its measurements least, as numbers and pictures.

mod optimize;
mod report;

use std::time::Instant;

use hssh::kind::FileKind;
use hssh_draw::{EdgeKind, PoseGraphOptions, draw_pose_graph};
use hssh_metrics::{
    BayesNetwork, GraphFile, Marginals, PoseGraph, PoseId, closures, read_pose_graph, reweighted,
};
use nalgebra::Matrix2;

use crate::arguments::GraphArguments;
use crate::failure::{Failure, Status};
use crate::input::Source;
use crate::output::{Written, check_outputs, print, print_json, write_file};
use crate::progress::keep_on_signals;

use optimize::{Optimum, optimize};
use report::account;

/// Up to this many poses are drawn with the ellipse of their covariance.
const MOST_ELLIPSES: usize = 40;

pub(crate) fn run(options: &GraphArguments) -> Result<Status, Failure> {
    let GraphArguments { g2o, svg, dot, .. } = options;
    check_outputs(&[&options.file], [g2o, svg, dot].map(Option::as_ref))?;
    let started = Instant::now();
    let mut file = read(options)?;
    let reading = started.elapsed().as_secs_f64();
    if options.strict {
        refuse_partial(options, &file)?;
    }
    let fixed = fixed(&file);
    let held = file.graph.anchor_components();
    keep_on_signals();
    let started = Instant::now();
    let optimum = optimize(options, &file)?;
    let solving = started.elapsed().as_secs_f64();

    let kinds = edge_kinds(&file.graph, &optimum.weights);
    let name = options.file.display().to_string();
    let report = account(name, &file, [&fixed, &held], &kinds, &optimum, [reading, solving]);
    if options.json {
        print_json(&report)?;
    } else {
        print(&report.to_string())?;
    }
    write_files(options, file, &kinds, &optimum)?;
    Ok(if optimum.finished { Status::Found } else { Status::Stopped })
}

/// The pose graph in the file, or on standard input; one without measurements in the plane is refused.
fn read(options: &GraphArguments) -> Result<GraphFile, Failure> {
    let file = &options.file;
    let source = Source::open(file)?;
    if !matches!(
        source.kind(),
        FileKind::PoseGraph(_) | FileKind::LaserLog(_) | FileKind::Text | FileKind::Empty
    ) {
        return Err(source.unfit("a pose graph"));
    }
    let unfit = source.unfit("a pose graph");
    let is_log = matches!(source.kind(), FileKind::LaserLog(_));
    let read = read_pose_graph(source.into_content())
        .map_err(|error| Failure::Graph { file: file.clone(), error: Box::new(error) })?;
    let has_poses = read.labels.len() > read.landmarks.len();
    let lost = read.skipped.iter().find(|skipped| skipped.matters());
    match lost.or(read.skipped.first()) {
        _ if has_poses && (!read.graph.edges().is_empty() || lost.is_none()) => Ok(read),
        _ if is_log => Err(unfit),
        None => {
            Err(Failure::EmptyGraph { file: file.clone(), skipped: "it has no records at all".to_owned() })
        }
        Some(first) => {
            let what = if first.is_spatial() {
                "is of a graph in space"
            } else {
                "is of a type that hssh does not know"
            };
            let skipped = format!(
                "{} of its records, `{}` on line {} the first, {what}",
                first.count, first.record, first.line
            );
            Err(Failure::EmptyGraph { file: file.clone(), skipped })
        }
    }
}

/// Refuses a file of which something that matters cannot be used.
fn refuse_partial(options: &GraphArguments, file: &GraphFile) -> Result<(), Failure> {
    let lost = file.skipped.iter().find(|skipped| skipped.matters());
    lost.map_or(Ok(()), |lost| {
        Err(Failure::Partial {
            file: options.file.clone(),
            lost: format!("line {}: records `{}` cannot be used", lost.line, lost.record),
        })
    })
}

/// The poses that the file itself holds where they are.
fn fixed(file: &GraphFile) -> Vec<PoseId> {
    let is_fixed =
        |&pose: &PoseId| file.graph.is_anchored(pose) && file.world != Some(pose) && !file.is_landmark(pose);
    file.graph.pose_ids().filter(is_fixed).collect()
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
    let mut written = Written::default();
    if let Some(out) = &options.svg {
        let name =
            options.file.file_stem().map_or_else(|| "pose graph".into(), |stem| stem.to_string_lossy());
        let believed = reweighted(&file.graph, &optimum.poses, &optimum.weights);
        let is_drawn: Vec<bool> = file.graph.edges().iter().map(|edge| !file.is_prior(edge)).collect();
        let drawn_kinds = kinds.iter().zip(&is_drawn).filter(|&(_, &is_drawn)| is_drawn);
        let drawn = PoseGraphOptions {
            title: Some(format!("{name}: {} poses, {} edges", file.labels.len(), kinds.len())),
            kinds: drawn_kinds.map(|(&kind, _)| kind).collect(),
            covariances: covariances(&believed)?,
        };
        written.note(write_file(out, &draw_pose_graph(&without_world(&file), &drawn)));
    }
    let accepted: Vec<f64> = optimum.weights.iter().map(|weight| weight.ceil()).collect();
    file.graph = reweighted(&file.graph, &optimum.poses, &accepted);
    if let Some(out) = &options.g2o {
        written.note(write_file(out, &file.to_g2o()));
    }
    if let Some(out) = &options.dot {
        written.note(write_file(out, &BayesNetwork::from(&file.graph).to_dot()));
    }
    written.done()
}

/// The graph without the frame of the world, which is no pose to be drawn, and its priors.
fn without_world(file: &GraphFile) -> PoseGraph {
    let mut graph = PoseGraph::new();
    for &pose in &file.graph.poses()[..file.labels.len()] {
        graph.add_pose(pose);
    }
    for &edge in file.graph.edges().iter().filter(|edge| !file.is_prior(edge)) {
        graph.add_edge(edge).expect("an edge between poses that are left");
    }
    graph
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
