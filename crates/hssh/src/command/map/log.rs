//! From a laser log to the grid map of the whole building (sections 2.1.4 and 2.4).

use std::path::Path;

use hssh_local::{
    LaserLog, LocalMapOptions, Survey, global_map, global_poses, resemblance, visit_frames, write_map,
    write_png,
};
use hssh_metrics::PoseGraph;
use hssh_search::Appearance;
use hssh_topology::{Isomorphism, Position};

use super::Source;
use crate::arguments::PlaceArguments;
use crate::command::explore::{failed, read_log, surveyed};
use crate::command::stages::{draw_survey, too_large};
use crate::failure::Failure;
use crate::output::say_written;

/// A log with what was found in it.
pub(crate) struct Surveyed {
    log: LaserLog,
    survey: Survey,
}

/// Reads a log and surveys it; draws that into a folder if one is given.
pub(super) fn read(file: &Path, places: &PlaceArguments, folder: Option<&Path>) -> Result<Source, Failure> {
    let log = read_log(file)?;
    let survey = surveyed(file, &log, &places.along_logs())?;
    if let Some(folder) = folder {
        draw_survey(&log, &survey, folder)?;
    }
    let exploration = survey.exploration().map_err(|error| failed(file, error))?;
    Ok(Source { exploration, surveyed: Some(Surveyed { log, survey }) })
}

impl Surveyed {
    /// How much alike the local maps of all pairs of visits are, times a weight.
    pub(super) fn appearance(&self, weight: f64) -> Appearance {
        let visits = &self.survey.visits;
        let degrees: Vec<u32> = visits.iter().map(|visit| visit.star.star.degree()).collect();
        Appearance::new(&degrees, |later, earlier, rotation| {
            let (first, second) = (&visits[earlier], &visits[later]);
            let isomorphisms = Isomorphism::all(&second.star.star, &first.star.star);
            let phi = isomorphisms.into_iter().find(|phi| phi.rotation() == rotation);
            let found = phi.and_then(|phi| resemblance(first, second, phi));
            found.map_or(0.0, |found| weight * found.log_likelihood_ratio)
        })
    }

    /// Puts all scans into one frame, that of a map, and writes the grid.
    pub(super) fn write_grid(
        &self,
        file: &Path,
        visits: &[Position],
        places: &PoseGraph,
    ) -> Result<(), Failure> {
        let frames = visit_frames(&self.survey.visits, visits, places.poses());
        let poses = global_poses(&self.survey, &frames);
        let grid = global_map(&self.log, &poses, &LocalMapOptions::default()).map_err(too_large)?;
        let is_yaml = file.extension().is_some_and(|ending| ending == "yaml" || ending == "yml");
        if is_yaml {
            write_map(&grid, file)?
        } else {
            write_png(&grid, file)?
        }
        say_written(file);
        Ok(())
    }
}
