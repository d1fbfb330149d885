//! Scripted experiments: every published table is a file that can be run again and checked.

mod outcome;
mod schema;
#[cfg(test)]
mod tests;
mod text;
mod truth;
mod world;

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use outcome::{Outcome, outcome};
use schema::Experiment;
pub(crate) use schema::{RouteSource, WorldSource};
pub(crate) use world::{Missing, case};

use crate::flags;
use crate::noisy;
use crate::root;

/// `cargo xtask experiment`.
pub(crate) fn run(flags: &flags::Experiment) -> Result<(), Box<dyn Error>> {
    if let Some(noisy) = flags.name.as_deref().and_then(noisy::named) {
        return noisy(flags);
    }
    let data = flags.data.clone().or_else(|| std::env::var_os("HSSH_DATA").map(PathBuf::from));
    let mut results = BTreeMap::new();
    let mut differences = 0;
    for (name, experiment) in chosen(flags)? {
        let outcomes = outcomes(&experiment, data.as_deref(), flags.threads.unwrap_or(1))?;
        differences += outcomes.iter().map(Outcome::differences).sum::<usize>();
        if !flags.json {
            println!("== {name}: {}\n{}", text::table(&experiment, &outcomes), text::times(&outcomes));
        }
        results.insert(name, outcomes);
    }
    if flags.json {
        println!("{}", serde_json::to_string_pretty(&results)?);
    }
    if flags.all {
        noisy::names().filter_map(|name| noisy::named(&name)).try_for_each(|run| run(flags))?;
    }
    match differences {
        0 => Ok(()),
        _ if !flags.check => Ok(()),
        1 => Err("one value differs from the expected one: look for DIFFERS above".into()),
        many => Err(format!("{many} values differ from the expected ones: look for DIFFERS above").into()),
    }
}

/// The experiments that the command line asks for, by name.
fn chosen(flags: &flags::Experiment) -> Result<Vec<(String, Experiment)>, Box<dyn Error>> {
    let names = names()?;
    let all = || names.iter().cloned().chain(noisy::names()).collect::<Vec<_>>().join(", ");
    match &flags.name {
        None if flags.all => {
            let all = names.into_iter().map(|name| Ok((name.clone(), read(&name)?)));
            let all: Result<Vec<_>, Box<dyn Error>> = all.collect();
            Ok(all?.into_iter().filter(|(_, experiment)| flags.slow || !experiment.slow).collect())
        }
        Some(name) if names.contains(name) => Ok(vec![(name.clone(), read(name)?)]),
        Some(name) => Err(format!("there is no experiment `{name}`; there are: {}", all()).into()),
        None => Err(format!("name an experiment, or pass --all; there are: {}", all()).into()),
    }
}

fn folder() -> PathBuf {
    root::fixtures().join("experiments")
}

/// The names of all experiments in alphabetical order.
fn names() -> Result<Vec<String>, Box<dyn Error>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder())? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "ron") {
            names.extend(path.file_stem().map(|stem| stem.to_string_lossy().into_owned()));
        }
    }
    names.sort();
    Ok(names)
}

fn read(name: &str) -> Result<Experiment, Box<dyn Error>> {
    let path = folder().join(format!("{name}.ron"));
    let text = fs::read_to_string(&path)?;
    Experiment::read(&text).map_err(|error| format!("{}:{error}", path.display()).into())
}

fn outcomes(
    experiment: &Experiment,
    data: Option<&Path>,
    threads: usize,
) -> Result<Vec<Outcome>, Box<dyn Error>> {
    experiment.runs.iter().map(|run| outcome(run, data, threads)).collect()
}
