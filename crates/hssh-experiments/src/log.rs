//! Surveys real laser logs and compares what comes out with what is known of the buildings.

mod drift;
mod matching;
mod truth;

use std::error::Error;
use std::fs::File;
use std::path::Path;
use std::time::Instant;

use hssh_causal::Exploration;
use hssh_local::{
    LaserLog, LocalMapOptions, MatchOptions, Survey, SurveyOptions, global_map, global_poses,
    mean_wall_distance, read_map, survey, track, visit_frames,
};
use hssh_metrics::Pose;
use hssh_search::{Mapper, Placement, RankedMap, place_by_odometry};
use hssh_topology::{Axioms, Position};

use truth::Truth;

/// Prints what comes out of each log in the folder that contains `logs/` and `gridmap/`.
pub(crate) fn run(data: &Path) -> Result<(), Box<dyn Error>> {
    for name in ["aces", "intel", "freiburg-079"] {
        println!("{name}");
        let started = Instant::now();
        let log = LaserLog::read(File::open(data.join(format!("logs/{name}.log.gz")))?)?;
        let read = started.elapsed();
        let found = match survey(&log, &SurveyOptions::default(), |_, _| ()) {
            Ok(found) => found,
            Err(error) => {
                println!("  {error}");
                continue;
            }
        };
        let exploration = found.exploration()?;
        let all = started.elapsed();
        println!(
            "  {} scans of {} beams, read in {:.0} ms; from file to exploration in {:.2} s, {} warnings",
            log.scans.len(),
            log.beams(),
            read.as_secs_f64() * 1e3,
            all.as_secs_f64(),
            log.warnings.len() + found.warnings.len()
        );
        let started = Instant::now();
        let tracked = track(&log, &MatchOptions::default(), |_| ());
        let rate = log.scans.len() as f64 / started.elapsed().as_secs_f64();
        println!("  matching: {rate:.0} scans/s\n{}", drift::table(&log, &tracked));
        if name == "aces" {
            let truth = Truth::read(&data.join("logs/aces-topology.txt"))?;
            println!("{}", truth.score(&found));
            println!("{}", matching::pairs(&found, &truth));
            println!("{}", matching::among_optimal(&found, &exploration)?);
            println!("{}", matching::gain(&found, &exploration)?);
            println!("{}", mapped(&log, &found, &exploration, &data.join("gridmap/aces.yaml"))?);
        } else {
            println!("{}", shapes(&found));
        }
    }
    Ok(())
}

/// The stars of the visits in order, and how many ways out they have.
fn shapes(survey: &Survey) -> String {
    let ways: Vec<String> =
        survey.visits.iter().map(|visit| visit.star.gateways().count().to_string()).collect();
    format!("  {} visits; ways out: {}", ways.len(), ways.join(" "))
}

/// The maps that planarity leaves, and how the best looks as a grid beside the reference.
fn mapped(
    log: &LaserLog,
    survey: &Survey,
    exploration: &Exploration,
    reference: &Path,
) -> Result<String, Box<dyn Error>> {
    let axioms = Axioms { max_genus: Some(0), ..Axioms::default() };
    let mapper = Mapper::builder().axioms(axioms).explain(exploration)?;
    let (report, maps) = mapper.answer(1);
    let Some(best) = maps.first() else { return Ok("  no planar map explains the exploration".to_owned()) };
    let mut text = format!(
        "  {} planar maps explain it, {} of them optimal; the best: {} places, {} paths, closed: {}",
        report.finals.final_maps, report.finals.optimal, best.measure.places, best.measure.paths, best.closed
    );
    if let Some((placement, positions)) = placed(&mapper, best, exploration)? {
        let frames = visit_frames(&survey.visits, &positions, placement.graph.poses());
        let poses = global_poses(survey, &frames);
        let grid = global_map(log, &poses, &LocalMapOptions::default())?;
        let corrected: Vec<Pose> = log.scans.iter().map(|scan| scan.corrected).collect();
        let frame = drift::best_fit(&poses, &corrected);
        let off = drift::root_mean_square(&poses, &corrected, frame);
        text += &format!("\n  placed: χ² {:.2}; poses {off:.2} m from the corrected ones", placement.chi2);
        if let Some(distance) = mean_wall_distance(&grid, &read_map(reference)?, frame) {
            text += &format!(", walls {distance:.2} m from those of the reference on the mean");
        }
    }
    Ok(text)
}

/// Where the places of a map are, and where the robot was in it.
type Placed = (Placement, Vec<Position>);

fn placed(
    mapper: &Mapper,
    map: &RankedMap,
    exploration: &Exploration,
) -> Result<Option<Placed>, Box<dyn Error>> {
    let positions = mapper.visits(map.node);
    Ok(place_by_odometry(exploration, &positions)?.map(|placement| (placement, positions)))
}
