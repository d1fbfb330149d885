//! `hssh live`: maps while the robot drives, shows the map on a page of this machine, and ends as `hssh map` does.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

use hssh::pipeline::{Input, MappingOptions, Monitor, SurveyedLog};
use hssh_local::GrowingTrack;

use crate::arguments::LiveArguments;
use crate::command::map;
use crate::failure::{Failure, Status};
use crate::input::{failed, progress_bar, warn};
use crate::live::{
    Hub, Latest, PageServer, Remade, Source, Stream, follow, html, keep_mapping, lock, renew, show,
};
use crate::progress::{hear_interruption, is_interrupted, keep_on_signals};
use crate::terminal::say;

/// So often it is looked whether somebody wants the end.
const LOOK: Duration = Duration::from_millis(50);

pub(crate) fn run(arguments: &LiveArguments) -> Result<Status, Failure> {
    let file = &arguments.map.file;
    if arguments.map.checkpoint.is_some() {
        let help = "--checkpoint is of a search that begins with everything: leave it out where the robot still drives";
        return Err(Failure::Usage(help.to_owned()));
    }
    if map::is_spread(&arguments.map) {
        let help = "--workers and --hosts are for searches that begin with everything: leave them out where the robot still drives";
        return Err(Failure::Usage(help.to_owned()));
    }
    let options = map::checked_options(&arguments.map)?;
    let hub = Arc::new(Hub::default());
    let server = PageServer::start(arguments.port, html(&file.display().to_string()), &hub)
        .map_err(|error| Failure::Port { port: arguments.port, error })?;
    say(&format!("the map as it grows: {} (Ctrl-C ends and writes what is known)", server.address()));
    keep_on_signals();
    let source = Source::open(file, &arguments.map.laser.choice(), &arguments.map.laser.topics)?;
    let latest: Latest = Mutex::new(GrowingTrack::new(options.places.along_logs().matching));
    let stream = Arc::new(Stream::new(source.incoming.clone()));
    // Nothing wakes a thread that waits for a robot: it is left behind.
    let (reading, name) = (Arc::clone(&stream), file.clone());
    thread::spawn(move || reading.read(source, &name));
    let (delays, made) = watch(&stream, &latest, &hub, &options, arguments.every);

    let (incoming, read) = stream.end();
    if let Err(failure) = read {
        failure.print();
    }
    lock(&latest).follow(incoming.into_log(file)?);
    renew(&latest);
    lock(&latest).calibrate();
    renew(&latest);
    let input = surveyed(arguments, &latest, &options)?;
    tell_delays(delays, &made);
    let status = map::answer(&arguments.map, &input, &options, |mapped| show(&hub, Ok((&input, mapped))))?;
    hub.end();
    if arguments.stay && !is_interrupted() {
        say("nothing comes any more; the page is served until Ctrl-C");
        while !is_interrupted() {
            thread::sleep(LOOK);
        }
    }
    Ok(status)
}

/// Follows and maps until the stream ends or somebody wants it to.
fn watch(
    stream: &Stream,
    latest: &Latest,
    hub: &Hub,
    options: &MappingOptions,
    every: f64,
) -> (Vec<Duration>, Vec<Remade>) {
    let stop = AtomicBool::new(false);
    let monitor = Arc::new(Monitor::default());
    thread::scope(|scope| {
        let following = scope.spawn(|| follow(stream, latest, hub));
        let mapping = scope.spawn(|| {
            keep_mapping(latest, every, options, &stop, &monitor, |found| {
                show(hub, found.as_ref().map(|(input, mapped)| (input, mapped)).map_err(String::as_str));
            })
        });
        while !stream.has_ended() {
            if is_interrupted() {
                stream.cut_off();
                hear_interruption();
            }
            thread::sleep(LOOK);
        }
        stop.store(true, Ordering::Relaxed);
        monitor.interrupt();
        (following.join().unwrap_or_default(), mapping.join().unwrap_or_default())
    })
}

/// What is found along all that has come.
fn surveyed(arguments: &LiveArguments, latest: &Latest, options: &MappingOptions) -> Result<Input, Failure> {
    let file = &arguments.map.file;
    let (log, track) = {
        let growing = lock(latest);
        (growing.log().cloned(), growing.track().clone())
    };
    let log = log.ok_or(Failure::NothingCame)?;
    let bar = progress_bar(log.scans.len() as u64);
    bar.set_message("closing loops");
    let surveyed = SurveyedLog::from_track(log, track, options, |_, scans| bar.set_position(scans as u64));
    bar.finish_and_clear();
    let surveyed = surveyed.map_err(|error| failed(file, error))?;
    warn(file, &surveyed.warnings());
    Input::surveyed(file.display().to_string(), surveyed).map_err(|error| failed(file, error))
}

/// Says on standard error how far behind the robot the picture was.
fn tell_delays(mut delays: Vec<Duration>, made: &[Remade]) {
    delays.sort();
    let at = |part: f64| {
        let index = ((delays.len() as f64 - 1.0) * part).round().max(0.0) as usize;
        delays.get(index).map_or(0.0, |delay| 1e3 * delay.as_secs_f64())
    };
    say(&format!(
        "{} scans were in the picture {:.0} ms after they came (half of them; 99 of 100 after {:.0} ms, all after {:.0} ms)",
        delays.len(),
        at(0.5),
        at(0.99),
        at(1.0)
    ));
    let longest = made.iter().map(|made| made.seconds).fold(0.0, f64::max);
    say(&format!("{} maps were made on the way, each in {longest:.1} s at most", made.len()));
}
