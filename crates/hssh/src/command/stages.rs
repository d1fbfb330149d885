//! `--debug-dir`: pictures of every stage on the way from a laser log to the map.

use std::path::{Path, PathBuf};

use hssh_draw::{GridPicture, TRUE_WAY, draw_grid};
use hssh_local::{
    FreeSpace, LaserLog, LocalMapOptions, OccupancyGrid, Skeleton, SkeletonOptions, Survey, Visit,
    global_map, write_png,
};
use hssh_metrics::Pose;

use crate::failure::Failure;
use crate::output::{say_written, write_file};

/// Where the topological map of a log is drawn.
pub(crate) fn map_file(folder: &Path) -> PathBuf {
    folder.join("4-map.svg")
}

/// Where the grid of the whole building is written.
pub(crate) fn building_file(folder: &Path) -> PathBuf {
    folder.join("5-building.png")
}

/// What the survey of a log went through: all scans where raw odometry puts them; where scan matching does, with the
/// robot's way and the stars; and for each visit its local map, with medial axis, gateways and star.
pub(crate) fn draw_survey(log: &LaserLog, survey: &Survey, folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| Failure::Write { file: folder.to_owned(), error })?;
    let told: Vec<Pose> = log.scans.iter().map(|scan| scan.odometry).collect();
    let picture = |poses: &[Pose], places| GridPicture {
        places,
        ways: vec![(poses.iter().map(|pose| [pose.x, pose.y]).collect(), TRUE_WAY)],
        ..GridPicture::default()
    };
    let all_scans = |poses: &[Pose]| global_map(log, poses, &LocalMapOptions::default());
    write(&folder.join("1-odometry.svg"), &all_scans(&told)?, &picture(&told, Vec::new()))?;
    let matched: Vec<Pose> = survey.track.scans.iter().map(|scan| scan.pose).collect();
    let center = |visit: &Visit| [visit.frame.x, visit.frame.y];
    let places = survey.visits.iter().map(|visit| (center(visit), &visit.star)).collect();
    write(&folder.join("2-track.svg"), &all_scans(&matched)?, &picture(&matched, places))?;
    for (number, visit) in survey.visits.iter().enumerate() {
        let file = folder.join(format!("3-visit-{:03}", number + 1));
        let robot = survey.track.scans[visit.reference].pose;
        let parameters = SkeletonOptions::default();
        let skeleton = Skeleton::new(&visit.grid, &FreeSpace::new(&visit.grid, &parameters), &parameters);
        let picture = GridPicture {
            skeleton: Some(&skeleton),
            places: vec![(center(visit), &visit.star)],
            robot: Some([robot.x, robot.y]),
            ..GridPicture::default()
        };
        write(&file.with_extension("svg"), &visit.grid, &picture)?;
        write_png(&visit.grid, &file.with_extension("png"))?;
        say_written(&file.with_extension("png"));
    }
    Ok(())
}

fn write(file: &Path, grid: &OccupancyGrid, picture: &GridPicture<'_>) -> Result<(), Failure> {
    write_file(file, &draw_grid(grid, picture))
}
