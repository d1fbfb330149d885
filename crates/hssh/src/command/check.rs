//! `hssh check`: what is in an exploration or a bag, or what is wrong with it.

use hssh::account::ContentsAccount;
#[cfg(feature = "bags")]
use hssh::file::read_bag_account;
use hssh_causal::schema::{Sight, Trace, Turning, view_graph_dot};

use crate::arguments::CheckArguments;
use crate::failure::{Failure, Status};
#[cfg(feature = "bags")]
use crate::input::Source;
use crate::input::read_exploration;
use crate::output::{check_outputs, print, print_json, write_file};

pub(crate) fn run(arguments: &CheckArguments) -> Result<Status, Failure> {
    check_outputs(&[&arguments.file], [arguments.dot.as_ref()])?;
    #[cfg(feature = "bags")]
    if let Some(source) = bag(arguments)? {
        let account = read_bag_account(&arguments.file, source, &arguments.topics.choice())?;
        if arguments.json {
            print_json(&account)?;
        } else {
            print(&account.to_string())?;
        }
        return Ok(if account.problem.is_empty() { Status::Found } else { Status::NothingConsistent });
    }
    let exploration = read_exploration(&arguments.file)?;
    let trace = if arguments.schemas || arguments.dot.is_some() {
        let help = "--schemas and --dot need an exploration with travels: this one has none";
        let trace = Trace::of(&exploration, Sight::Place, Turning::Direct);
        Some(trace.ok_or_else(|| Failure::Usage(help.to_owned()))?)
    } else {
        None
    };
    let name = arguments.file.display().to_string();
    let contents = ContentsAccount::new(&name, &exploration, trace.as_ref().filter(|_| arguments.schemas));
    if arguments.json {
        print_json(&contents)?;
    } else {
        print(&contents.to_string())?;
    }
    if let (Some(file), Some(trace)) = (&arguments.dot, &trace) {
        write_file(file, &view_graph_dot(trace))?;
    }
    Ok(Status::Found)
}

/// The file, if it is a bag.
#[cfg(feature = "bags")]
fn bag(arguments: &CheckArguments) -> Result<Option<Source>, Failure> {
    use hssh::kind::FileKind;

    // Standard input can be opened once; explorations come that way.
    if arguments.file.as_os_str() == "-" {
        return Ok(None);
    }
    let source = Source::open(&arguments.file)?;
    let is_bag = matches!(source.kind(), FileKind::Recording(_));
    if is_bag && (arguments.schemas || arguments.dot.is_some()) {
        let help = "--schemas and --dot need an exploration: `hssh explore` makes one of a bag";
        return Err(Failure::Usage(help.to_owned()));
    }
    Ok(is_bag.then_some(source))
}
