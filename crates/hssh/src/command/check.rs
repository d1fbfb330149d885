//! `hssh check`: what is in an exploration, or what is wrong with it.

use std::collections::BTreeMap;

use hssh_causal::Exploration;
use serde::Serialize;

use crate::arguments::CheckOptions;
use crate::failure::{Failure, Status};
use crate::input::read_exploration;
use crate::output::{counted, print, print_json};

/// The contents of an exploration in numbers.
#[derive(Serialize)]
struct Contents {
    travels: usize,
    travels_with_odometry: usize,
    star_types: Vec<StarTypeContents>,
}

#[derive(Serialize)]
struct StarTypeContents {
    name: String,
    star: String,
    gateways: usize,
    bearings: usize,
    visits: usize,
}

impl Contents {
    fn of(exploration: &Exploration) -> Self {
        let mut visits: BTreeMap<_, usize> = BTreeMap::new();
        exploration.visits().for_each(|star_type| *visits.entry(star_type.index()).or_default() += 1);
        let star_type = |(index, named): (usize, &hssh_causal::NamedStar)| StarTypeContents {
            name: named.name.clone(),
            star: named.star.to_string(),
            gateways: named.star.gateways().count(),
            bearings: named.bearings.iter().flatten().count(),
            visits: visits.get(&index).copied().unwrap_or(0),
        };
        let travels = exploration.travels();
        Contents {
            travels: travels.len(),
            travels_with_odometry: travels.iter().filter(|travel| travel.odometry.is_some()).count(),
            star_types: exploration.star_types().iter().enumerate().map(star_type).collect(),
        }
    }
}

pub(crate) fn run(options: &CheckOptions) -> Result<Status, Failure> {
    let exploration = read_exploration(&options.file)?;
    let contents = Contents::of(&exploration);
    if options.json {
        print_json(&contents)?;
        return Ok(Status::Found);
    }
    let mut text = format!(
        "{}: {}, {} with odometry; {}\n",
        options.file.display(),
        counted(contents.travels, "travel"),
        contents.travels_with_odometry,
        counted(contents.star_types.len(), "star type"),
    );
    let width = contents.star_types.iter().map(|star| star.name.chars().count()).max().unwrap_or(0);
    for star in &contents.star_types {
        text += &format!("  {:<width$}  {:>3} ×  {}\n", star.name, star.visits, star.star);
    }
    print(&text)?;
    Ok(Status::Found)
}
