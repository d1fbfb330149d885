//! `hssh completions` and `hssh man`: what shells and `man` want to know of the command line, made of the command line itself.

use std::fs;

use clap::CommandFactory;

use crate::arguments::{Arguments, CompletionsArguments, ManArguments};
use crate::failure::{Failure, Status};
use crate::output::{check_folder, print, say_written};

/// The name of the program.
const NAME: &str = "hssh";

/// `hssh completions`: a script that completes commands and options.
pub(crate) fn print_completions(arguments: &CompletionsArguments) -> Result<Status, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), NAME, &mut script);
    print(&String::from_utf8_lossy(&script))?;
    Ok(Status::Found)
}

/// `hssh man`: the page of the program, or a page for each command in a folder.
pub(crate) fn print_man(arguments: &ManArguments) -> Result<Status, Failure> {
    let Some(folder) = &arguments.output else {
        let mut page = Vec::new();
        clap_mangen::Man::new(Arguments::command()).render(&mut page)?;
        print(&String::from_utf8_lossy(&page))?;
        return Ok(Status::Found);
    };
    check_folder(Some(folder))?;
    let unwritten = |error| Failure::Write { file: folder.clone(), error };
    clap_mangen::generate_to(Arguments::command(), folder).map_err(unwritten)?;
    let mut pages: Vec<_> =
        fs::read_dir(folder).map_err(unwritten)?.flatten().map(|page| page.path()).collect();
    pages.sort();
    let is_ours = |page: &&std::path::PathBuf| {
        page.file_name().is_some_and(|name| name.to_string_lossy().starts_with(NAME))
    };
    pages.iter().filter(is_ours).for_each(|page| say_written(page));
    Ok(Status::Found)
}
