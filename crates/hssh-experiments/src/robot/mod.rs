//! Drives a simulated robot through floors: its control level against the truth, and the maps that come of its logs.

mod course;
mod outcome;

use std::error::Error;

use hssh_world::floors;

use crate::flags;
use crate::noisy::on_threads;
use crate::table::aligned;
use course::Course;
use outcome::Outcome;

/// How large the robot's errors are, in parts of their usual size.
const NOISE: [f64; 3] = [0.0, 1.0, 2.0];
/// Seeds of each row if none are asked for.
const SEEDS: usize = 3;
/// The largest floor of a quick check, in places.
const SMALL: usize = 9;

pub(crate) fn run(flags: &flags::Robot) -> Result<(), Box<dyn Error>> {
    let seeds = if flags.check { 1 } else { flags.seeds.unwrap_or(SEEDS) };
    let noises = if flags.check { &NOISE[1..2] } else { &NOISE[..] };
    let mut courses = floors().iter().map(Course::built).collect::<Result<Vec<_>, _>>()?;
    if flags.check {
        courses.retain(|course| course.places.len() <= SMALL);
    } else if let Some(data) = flags.data.clone().or_else(|| std::env::var_os("HSSH_DATA").map(Into::into)) {
        courses.push(Course::aces(&data)?);
    } else {
        println!("without the ACES floor: name the folder that contains gridmap/, or set HSSH_DATA");
    }
    let rows: Vec<(&Course, f64)> =
        courses.iter().flat_map(|course| noises.iter().map(move |&noise| (course, noise))).collect();
    let outcomes = on_threads(flags.threads.unwrap_or(1), rows.len() * seeds, |task| {
        let (course, noise) = rows[task / seeds];
        Outcome::of(course, noise, (task % seeds) as u64)
    })?;
    println!("{}", table(&rows, &outcomes, seeds));
    let failed = outcomes.iter().filter(|outcome| !outcome.is_as_expected()).count();
    if flags.check && failed > 0 {
        return Err(format!("{failed} of {} drives went wrong", outcomes.len()).into());
    }
    Ok(())
}

fn table(rows: &[(&Course, f64)], outcomes: &[Outcome], seeds: usize) -> String {
    let header = [
        "course",
        "noise",
        "done",
        "reached",
        "off center, m",
        "worst",
        "collisions",
        "visits found",
        "survey right",
        "map right",
        "back, m",
        "back, °",
        "walls, m",
        "within 0.05 m",
        "s",
    ];
    let mut lines = vec![header.map(str::to_owned).to_vec()];
    for ((course, noise), outcomes) in rows.iter().zip(outcomes.chunks(seeds)) {
        let sum = |number: fn(&Outcome) -> usize| outcomes.iter().map(number).sum::<usize>();
        let count =
            |is: fn(&Outcome) -> bool| format!("{}/{seeds}", outcomes.iter().filter(|one| is(one)).count());
        let mean = |number: fn(&Outcome) -> f64| outcomes.iter().map(number).sum::<f64>() / seeds as f64;
        lines.push(vec![
            course.name.clone(),
            format!("{noise:.0}"),
            count(|one| one.is_done),
            format!("{}/{}", sum(|one| one.reached), sum(|one| one.travels)),
            format!("{:.2}", mean(|one| one.off_center.0)),
            format!("{:.2}", outcomes.iter().map(|one| one.off_center.1).fold(0.0, f64::max)),
            sum(|one| one.collisions).to_string(),
            format!("{}/{}", sum(|one| one.visits.0), sum(|one| one.visits.1)),
            count(|one| one.is_surveyed),
            count(|one| one.is_right),
            known(outcomes, 3, |one| one.back.map(|back| back[0])),
            known(outcomes, 2, |one| one.back.map(|back| back[1].to_degrees())),
            known(outcomes, 3, |one| one.walls.map(|walls| walls.off)),
            known(outcomes, 3, |one| one.walls.map(|walls| walls.near)),
            format!("{:.1}", mean(|one| one.seconds)),
        ]);
    }
    format!("every corridor travelled once or more; drives of each row: {seeds}\n{}", aligned(&lines))
}

/// The mean of what is known.
fn known(outcomes: &[Outcome], digits: usize, number: fn(&Outcome) -> Option<f64>) -> String {
    let numbers: Vec<f64> = outcomes.iter().filter_map(number).collect();
    match numbers.len() {
        0 => "–".to_owned(),
        count => format!("{:.digits$}", numbers.iter().sum::<f64>() / count as f64),
    }
}
