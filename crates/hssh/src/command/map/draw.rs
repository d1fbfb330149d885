//! The pictures of the best maps and of the search tree, and the pose graph of the best map.

use std::path::{Path, PathBuf};

use hssh_draw::{
    Bearings, Layout, MapOptions as DrawOptions, SearchTree, TreeOptions, draw_map, draw_tree, map_to_dot,
    tree_to_dot,
};
use hssh_metrics::{GraphFile, Marginals, PoseGraph};
use hssh_search::{Cursor, Experience, NodeId, Tree};
use nalgebra::Matrix2;

use super::Source;
use crate::arguments::MapOptions;
use crate::command::stages::{building_file, map_file};
use crate::failure::Failure;
use crate::output::write_file;

/// What there is to draw.
#[derive(Clone, Copy)]
pub(super) struct Pictures<'a> {
    pub(super) source: &'a Source,
    pub(super) tree: &'a Tree,
    pub(super) experience: &'a Experience,
    /// The maps that are equally good, each with its pose graph, laid out, if it has odometry.
    pub(super) best: &'a [(NodeId, Option<PoseGraph>)],
    /// What they are, in the singular.
    pub(super) kind: &'static str,
}

/// Whether any picture or file is asked for.
pub(super) fn is_asked(options: &MapOptions) -> bool {
    let files = [&options.svg, &options.dot, &options.tree, &options.g2o, &options.grid, &options.debug_dir];
    files.iter().any(|file| file.is_some())
}

/// Draws the tree, and the best maps.
pub(super) fn draw(options: &MapOptions, pictures: &Pictures<'_>) -> Result<(), Failure> {
    let Pictures { source, tree, experience, best, kind } = *pictures;
    let exploration = &source.exploration;
    let bearings = Bearings(exploration.star_types().iter().map(|named| named.bearings.clone()).collect());
    if let Some(file) = &options.tree {
        let drawn = TreeOptions { bearings: bearings.clone(), ..TreeOptions::default() };
        let nodes: Vec<NodeId> = best.iter().map(|(node, _)| *node).collect();
        let tree = SearchTree::of(tree, experience, &nodes, drawn.most_maps);
        let is_dot = file.extension().is_some_and(|ending| ending == "dot");
        let text = if is_dot { tree_to_dot(&tree, &drawn)? } else { draw_tree(&tree, &drawn)? };
        write_file(file, &text)?;
    }
    let mut cursor = Cursor::new(experience);
    for (index, (node, graph)) in best.iter().enumerate() {
        let node = *node;
        let [map_stage, building_stage] =
            [map_file, building_file].map(|stage| options.debug_dir.as_deref().map(stage));
        let files = [&options.svg, &map_stage, &options.dot, &options.g2o, &options.grid, &building_stage]
            .map(|file| numbered(file.as_deref(), index));
        if files.iter().all(Option::is_none) {
            break;
        }
        let [svg, map_stage, dot, g2o, grid, building_stage] = files;
        let visits = cursor.visits(node, tree, experience);
        let hypothesis = cursor.go_to(node, tree, experience);
        let map = &hypothesis.map;
        let layout = match graph {
            Some(graph) => {
                let layout = Layout::measured(map, graph.poses().to_vec(), &bearings)?;
                layout.with_covariances(covariances(graph)?)
            }
            None => Layout::schematic(map, &bearings)?,
        };
        let drawn = DrawOptions {
            title: Some(title(&options.file, index, best.len(), kind)),
            current: Some(hypothesis.position.place),
            star_names: exploration.star_types().iter().map(|named| named.name.clone()).collect(),
            ..DrawOptions::default()
        };
        for file in [svg, map_stage].into_iter().flatten() {
            write_file(&file, &draw_map(map, &layout, &drawn))?;
        }
        if let Some(file) = dot {
            write_file(&file, &map_to_dot(map, &experience.catalog, &drawn))?;
        }
        if let (Some(surveyed), Some(graph)) = (&source.surveyed, graph) {
            for file in [grid, building_stage].into_iter().flatten() {
                surveyed.write_grid(&file, &visits, graph)?;
            }
        }
        if let Some(file) = g2o {
            let graph = graph.as_ref().ok_or(Failure::NoOdometry)?;
            write_file(&file, &GraphFile::from(graph.clone()).to_g2o())?;
        }
    }
    Ok(())
}

/// Of the position of each place, in the frame of the first one.
fn covariances(graph: &PoseGraph) -> Result<Vec<Matrix2<f64>>, Failure> {
    let marginals = Marginals::new(graph)?;
    Ok(graph.pose_ids().map(|pose| marginals.covariance(pose).fixed_view::<2, 2>(0, 0).into()).collect())
}

fn title(file: &Path, index: usize, best: usize, kind: &str) -> String {
    let name = file.file_stem().map_or_else(|| "exploration".into(), |stem| stem.to_string_lossy());
    match best {
        1 => format!("{name}: the {kind}"),
        _ => format!("{name}: {kind} {} of {best}", index + 1),
    }
}

/// The file for the picture of the map with that index: `map.svg`, `map-2.svg`, …
fn numbered(file: Option<&Path>, index: usize) -> Option<PathBuf> {
    let file = file?;
    if index == 0 {
        return Some(file.to_owned());
    }
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    let name = format!("{stem}-{}", index + 1);
    let ending = file.extension().map_or(String::new(), |ending| format!(".{}", ending.to_string_lossy()));
    Some(file.with_file_name(name + &ending))
}
