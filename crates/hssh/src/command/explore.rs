//! `hssh explore`: from a laser log to an exploration.

use hssh::account::SurveyAccount;
use hssh::pipeline::MappingOptions;

use super::stages::draw_survey;
use crate::arguments::ExploreArguments;
use crate::failure::{Failure, Status};
use crate::input::{failed, surveyed};
use crate::output::{print, print_json, write_file};

pub(crate) fn run(arguments: &ExploreArguments) -> Result<Status, Failure> {
    let options = MappingOptions { places: arguments.places.choice(), ..MappingOptions::default() };
    let surveyed = surveyed(&arguments.log, &options)?;
    let exploration = surveyed.survey.exploration().map_err(|error| failed(&arguments.log, error))?;
    if let Some(folder) = &arguments.debug_dir {
        draw_survey(&surveyed.log, &surveyed.survey, folder)?;
    }
    if let Some(file) = &arguments.output {
        write_file(file, &exploration.to_ron())?;
    }
    let account = SurveyAccount::new(&arguments.log.display().to_string(), &surveyed);
    match &arguments.output {
        _ if arguments.json => print_json(&account)?,
        Some(_) => print(&account.to_string())?,
        None => print(&exploration.to_ron())?,
    }
    Ok(Status::Found)
}
