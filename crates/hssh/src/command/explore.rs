//! `hssh explore`: from a laser log to an exploration.

use hssh::account::SurveyAccount;
use hssh::pipeline::MappingOptions;

use super::stages::draw_survey;
use crate::arguments::ExploreArguments;
use crate::failure::{Failure, Status};
use crate::input::{failed, read_surveyed, refuse_partial};
use crate::output::{Written, check_folder, check_outputs, print, print_json, write_file};
use crate::progress::is_interrupted;

pub(crate) fn run(arguments: &ExploreArguments) -> Result<Status, Failure> {
    let (laser, places) = (arguments.laser.choice(), arguments.places.choice());
    let options = MappingOptions { laser, places, ..MappingOptions::default() };
    check_outputs(&[&arguments.log], [arguments.output.as_ref()])?;
    check_folder(arguments.debug_dir.as_ref())?;
    let surveyed = read_surveyed(&arguments.log, &options, &arguments.laser.topics)?;
    if arguments.strict {
        refuse_partial(&arguments.log, Some(&surveyed))?;
    }
    let exploration = surveyed.survey.exploration().map_err(|error| failed(&arguments.log, error))?;
    let account = SurveyAccount::new(&arguments.log.display().to_string(), &surveyed);
    match &arguments.output {
        _ if arguments.json => print_json(&account)?,
        Some(_) => print(&account.to_string())?,
        None => print(&exploration.to_ron())?,
    }
    let mut written = Written::default();
    if let Some(file) = &arguments.output {
        let done = write_file(file, &exploration.to_ron());
        if done.is_err() {
            print(&exploration.to_ron())?;
        }
        written.note(done);
    }
    if let Some(folder) = &arguments.debug_dir {
        written.note(draw_survey(&surveyed.log, &surveyed.survey, folder));
    }
    written.done()?;
    Ok(if is_interrupted() { Status::Stopped } else { Status::Found })
}
