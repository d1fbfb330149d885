//! The pictures of the best maps and of the search tree, the pose graph of each, and the grid of the building.

use std::path::{Path, PathBuf};

use hssh::answer::{Answer, AnsweredMap, MapPicture, SearchObjective};
use hssh::pipeline::{Input, Mapped, PipelineError};
use hssh_draw::{Bearings, TreeOptions, draw_tree, tree_to_dot};
use hssh_metrics::GraphFile;

use crate::arguments::MapArguments;
use crate::command::export::refuse_unfit;
use crate::command::stages::{building_file, map_file};
use crate::failure::Failure;
use crate::output::{
    Written, check_folder, check_outputs, grid_image, refuse_input, write_file, write_grid, write_tum,
};

/// Whether any picture or file is asked for.
pub(super) fn is_asked(arguments: &MapArguments) -> bool {
    let MapArguments { svg, dot, tree, g2o, grid, trajectory, debug_dir, page, .. } = arguments;
    [svg, dot, tree, g2o, grid, trajectory, debug_dir, &page.html].iter().any(|file| file.is_some())
        || !arguments.files.export.is_empty()
}

/// Refuses outputs that cannot be written, before anything is searched.
pub(super) fn check(arguments: &MapArguments) -> Result<(), Failure> {
    let MapArguments {
        svg, dot, tree, g2o, grid, trajectory, certificate, corrected, page, checkpoint, ..
    } = arguments;
    let grid_image = grid_image(grid.as_deref());
    let outputs =
        [svg, dot, tree, g2o, grid, trajectory, certificate, corrected, &grid_image, &page.html, checkpoint]
            .map(Option::as_ref);
    refuse_unfit(&arguments.files, true)?;
    let exported = arguments.files.export.iter().map(|(_, file)| Some(file));
    check_outputs(&[&arguments.file], outputs.into_iter().chain(exported))?;
    check_folder(arguments.debug_dir.as_ref())
}

/// Draws the tree, and the maps that are as good as the first.
pub(super) fn draw(
    arguments: &MapArguments,
    input: &Input,
    mapped: &Mapped,
    written: &mut Written,
) -> Result<(), Failure> {
    if let Some(file) = &arguments.tree {
        written.note(draw_search(file, input, mapped));
    }
    let is_asked = |map: &&AnsweredMap| arguments.rank.map_or(map.tied, |rank| map.rank == u64::from(rank));
    let best: Vec<&AnsweredMap> = mapped.answer.maps.iter().filter(is_asked).collect();
    if let (Some(file), []) = (&arguments.trajectory, &best[..]) {
        written.note(write_trajectory(file, input, mapped, 1));
    }
    for (index, map) in best.iter().enumerate() {
        let MapArguments { svg, dot, g2o, grid, trajectory, debug_dir, .. } = arguments;
        let [map_stage, building_stage] =
            [map_file, building_file].map(|stage| debug_dir.as_deref().map(stage));
        let files = [svg, &map_stage, dot, g2o, grid, trajectory, &building_stage];
        if files.iter().all(|file| file.is_none()) {
            break;
        }
        let [svg, map_stage, dot, g2o, grid, trajectory, building_stage] =
            files.map(|file| numbered(file.as_deref(), index));
        let title = title(&arguments.file, index, best.len(), kind(&mapped.answer));
        let mut picture = MapPicture::new(map, Some(title))?;
        if let (1, Some(building)) = (map.rank, &mapped.answer.building) {
            picture = picture.in_building(building);
        }
        let outputs = [&svg, &dot, &g2o, &grid, &trajectory];
        for file in outputs.into_iter().flatten() {
            refuse_input(&arguments.file, file)?;
        }
        for file in [svg, map_stage].into_iter().flatten() {
            written.note(write_file(&file, &picture.to_svg()));
        }
        if let Some(file) = dot {
            written.note(write_file(&file, &picture.to_dot()));
        }
        let rank = map.rank as usize;
        if let Some(file) = trajectory {
            written.note(write_trajectory(&file, input, mapped, rank));
        }
        let graph = mapped.pose_graph(rank);
        for file in [grid, building_stage].into_iter().flatten().filter(|_| graph.is_some()) {
            written.note(write_building(&file, input, mapped, rank));
        }
        if let Some(file) = g2o {
            let graph =
                mapped.scan_graph(input, rank).or_else(|| graph.cloned()).ok_or(Failure::NoOdometry)?;
            written.note(write_file(&file, &GraphFile::from(graph).to_g2o()));
        }
    }
    Ok(())
}

fn draw_search(file: &Path, input: &Input, mapped: &Mapped) -> Result<(), Failure> {
    let named = mapped.exploration(input).star_types().iter();
    let bearings = Bearings(named.map(|named| named.bearings.clone()).collect());
    let drawn = TreeOptions { bearings, ..TreeOptions::default() };
    let Some(tree) = mapped.tree(drawn.most_maps) else { return Ok(()) };
    let is_dot = file.extension().is_some_and(|ending| ending == "dot");
    let text = if is_dot { tree_to_dot(&tree, &drawn)? } else { draw_tree(&tree, &drawn)? };
    write_file(file, &text)
}

/// Writes the grid of the building, for ROS `map_server` if the file ends so.
fn write_building(file: &Path, input: &Input, mapped: &Mapped, rank: usize) -> Result<(), Failure> {
    write_grid(file, &mapped.building(input, rank)?)
}

/// Writes where every scan was taken, one line each.
fn write_trajectory(file: &Path, input: &Input, mapped: &Mapped, rank: usize) -> Result<(), Failure> {
    write_tum(file, &mapped.trajectory(input, rank).ok_or(PipelineError::NoScans)?)
}

/// What the best maps are, in the singular.
fn kind(answer: &Answer) -> &'static str {
    if answer.input.explained < answer.input.considered {
        return "partial map";
    }
    match (answer.search.objective, answer.certificate.proved) {
        (SearchObjective::Preference, true) => "optimal map",
        (SearchObjective::Preference, false) => "best map found",
        (SearchObjective::Posterior, true) => "most probable map",
        (SearchObjective::Posterior, false) => "most probable map found",
    }
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
