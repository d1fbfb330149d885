//! `hssh verify`: whether a certificate proves what it says, by a checker that shares no code with the search.

use std::path::Path;

use hssh_causal::Exploration;
use hssh_verify::{report, verify};

use crate::arguments::VerifyArguments;
use crate::failure::{Failure, Status};
use crate::input::read_exploration;
use crate::output::{print, print_json};

pub(crate) fn run(arguments: &VerifyArguments) -> Result<Status, Failure> {
    let certificate = read(&arguments.certificate)?;
    let exploration = beginning(read_exploration(&arguments.exploration)?, &certificate);
    let refused = |refusal| Failure::Refused { file: arguments.certificate.clone(), refusal };
    let verdict = verify(&certificate, &exploration).map_err(refused)?;
    if arguments.json {
        print_json(&verdict)?;
    } else {
        print(&report(&verdict))?;
    }
    Ok(Status::Found)
}

fn read(file: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(file).map_err(|error| Failure::Read { file: file.to_owned(), error })
}

/// The first travels of an exploration, if the certificate is about no more of them.
fn beginning(exploration: Exploration, certificate: &str) -> Exploration {
    let line = certificate.lines().find_map(|line| line.strip_prefix("exploration "));
    let travels = line.and_then(|line| line.split_whitespace().next()?.parse().ok());
    travels.map_or(exploration.clone(), |travels| exploration.prefix(travels))
}
