//! `hssh graph`: the poses of a pose graph that contradict its measurements least, as numbers and pictures.

use std::time::Instant;

use hssh::file::read_graph;
use hssh::graph::{Optimized, optimize};
use hssh_metrics::{BayesNetwork, GraphFile};

use crate::arguments::GraphArguments;
use crate::failure::{Failure, Status};
use crate::input::Source;
use crate::output::{Written, check_outputs, print, print_json, write_file};
use crate::progress::keep_on_signals;

pub(crate) fn run(options: &GraphArguments) -> Result<Status, Failure> {
    let GraphArguments { g2o, svg, dot, .. } = options;
    check_outputs(&[&options.file], [g2o, svg, dot].map(Option::as_ref))?;
    let started = Instant::now();
    let file = read_graph(&options.file, Source::open(&options.file)?)?;
    let reading = started.elapsed().as_secs_f64();
    if options.strict {
        refuse_partial(options, &file)?;
    }
    keep_on_signals();
    let optimized = optimize(file, &options.options())?;
    let report = optimized.account(options.file.display().to_string(), reading);
    if options.json {
        print_json(&report)?;
    } else {
        print(&report.to_string())?;
    }
    let finished = optimized.optimum.finished;
    write_files(options, optimized)?;
    Ok(if finished { Status::Found } else { Status::Stopped })
}

/// Refuses a file of which something that matters cannot be used.
fn refuse_partial(options: &GraphArguments, file: &GraphFile) -> Result<(), Failure> {
    let lost = file.skipped.iter().find(|skipped| skipped.matters());
    lost.map_or(Ok(()), |lost| {
        Err(Failure::Partial {
            file: options.file.clone(),
            lost: format!("line {}: records `{}` cannot be used", lost.line, lost.record),
        })
    })
}

/// Writes what was asked for: the picture, and the optimized graph and its Bayes network without refused edges.
fn write_files(options: &GraphArguments, optimized: Optimized) -> Result<(), Failure> {
    let mut written = Written::default();
    if let Some(out) = &options.svg {
        let name =
            options.file.file_stem().map_or_else(|| "pose graph".into(), |stem| stem.to_string_lossy());
        written.note(write_file(out, &optimized.to_svg(&name)?));
    }
    let file = optimized.into_file();
    if let Some(out) = &options.g2o {
        written.note(write_file(out, &file.to_g2o()));
    }
    if let Some(out) = &options.dot {
        written.note(write_file(out, &BayesNetwork::from(&file.graph).to_dot()));
    }
    written.done()
}
