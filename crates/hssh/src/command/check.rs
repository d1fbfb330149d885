//! `hssh check`: what is in an exploration, or what is wrong with it.

use hssh::account::ContentsAccount;
use hssh_causal::schema::{Sight, Trace, Turning, view_graph_dot};

use crate::arguments::CheckArguments;
use crate::failure::{Failure, Status};
use crate::input::read_exploration;
use crate::output::{check_outputs, print, print_json, write_file};

pub(crate) fn run(arguments: &CheckArguments) -> Result<Status, Failure> {
    check_outputs(&[&arguments.file], [arguments.dot.as_ref()])?;
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
