//! `hssh explain`: how a map explains an exploration, travel by travel, in words.

use hssh::answer::Explanation;
use hssh::pipeline::{Means, SearchMethod};

use crate::arguments::ExplainArguments;
use crate::command::map::searched;
use crate::failure::{Failure, Status};
use crate::input::read_input;
use crate::output::{print, print_json};

pub(crate) fn run(arguments: &ExplainArguments) -> Result<Status, Failure> {
    let mut options = arguments.search.options(&arguments.places, &arguments.laser)?;
    options.listed = Some(arguments.rank as usize);
    if options.search.method == Some(SearchMethod::Count) {
        let help = "counting keeps no maps to explain: choose another --search";
        return Err(Failure::Usage(help.to_owned()));
    }
    let input = read_input(&arguments.file, &options, &arguments.laser.topics)?;
    let mapped = searched(&input, &options, &Means::default())?;
    let answer = &mapped.answer;
    if answer.maps.is_empty() {
        print(&if arguments.json { answer.to_json() } else { answer.verdict.sentence.clone() + "\n" })?;
        return Ok(Status::of(answer));
    }
    let rank = arguments.rank as usize;
    if answer.map(rank).is_none() {
        return Err(Failure::NoSuchRank { asked: arguments.rank, found: answer.maps.len() });
    }
    let explanation = Explanation::new(answer, rank, mapped.exploration(&input), &options.axioms)?;
    if arguments.json {
        print_json(&explanation)?;
    } else {
        print(&explanation.to_string())?;
    }
    Ok(Status::of(answer))
}
