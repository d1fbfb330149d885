//! `hssh check`: what is in an exploration, or what is wrong with it.

use std::collections::BTreeMap;

use hssh::answer::counted;
use hssh_causal::Exploration;
use hssh_causal::schema::{
    Automaton, Change, Refutation, Sight, Trace, Turning, View, numbered_views, view_graph_dot,
};
use serde::Serialize;

use crate::arguments::CheckArguments;
use crate::failure::{Failure, Status};
use crate::input::read_exploration;
use crate::output::{print, print_json, write_file};

/// The contents of an exploration in numbers.
#[derive(Serialize)]
struct Contents {
    travels: usize,
    travels_with_odometry: usize,
    star_types: Vec<StarTypeContents>,
    #[serde(skip_serializing_if = "Option::is_none")]
    causal: Option<CausalContents>,
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
            causal: None,
        }
    }
}

/// An exploration at the causal level.
#[derive(Serialize)]
struct CausalContents {
    /// What was seen, the first being `v1`.
    views: Vec<String>,
    schemas: Vec<SchemaContents>,
    /// The first two schemas, counted from 1, that contradict that equal views are one state.
    contradiction: Option<(usize, usize)>,
}

/// A schema ⟨v, a, v'⟩ with the numbers of its views, and its annotation: metres, radians, and their covariance.
#[derive(Serialize)]
struct SchemaContents {
    from: u32,
    action: String,
    to: u32,
    distance: Option<f64>,
    rotation: Option<f64>,
    covariance: Option<[[f64; 2]; 2]>,
}

impl CausalContents {
    fn of(trace: &Trace) -> Self {
        let numbers = numbered_views(trace);
        let mut views: Vec<(u32, &View)> = numbers.iter().map(|(&view, &number)| (number, view)).collect();
        views.sort_unstable();
        let schema = |schema: hssh_causal::schema::Schema<'_>| {
            let Change { distance, rotation, covariance } = schema.change;
            let (from, to) = (numbers[schema.from], numbers[schema.to]);
            SchemaContents { from, action: schema.action.to_string(), to, distance, rotation, covariance }
        };
        let equal_views_are_one_state = Automaton::from_partition(trace, |moment| trace.view(moment));
        CausalContents {
            views: views.iter().map(|(_, view)| view.to_string()).collect(),
            schemas: trace.schemas().map(schema).collect(),
            contradiction: equal_views_are_one_state.err().map(|refutation| match refutation {
                Refutation::Views(one, other) | Refutation::Schemas(one, other) => (one + 1, other + 1),
            }),
        }
    }

    fn text(&self) -> String {
        let mut text = "views, clockwise from the end ahead:\n".to_owned();
        for (index, view) in self.views.iter().enumerate() {
            text += &format!("  {:<4} {view}\n", format!("v{}", index + 1));
        }
        text += "schemas:\n";
        let width = self.schemas.iter().map(|schema| schema.action.len()).max().unwrap_or(0);
        for (index, schema) in self.schemas.iter().enumerate() {
            let SchemaContents { from, action, to, distance, rotation, covariance } = schema;
            let change = Change { distance: *distance, rotation: *rotation, covariance: *covariance };
            let (from, to) = (format!("v{from}"), format!("v{to}"));
            let line = format!("  {:>4}  {from:<4} {action:<width$}  {to:<4} {change}", index + 1);
            text += &format!("{}\n", line.trim_end());
        }
        text + &match self.contradiction {
            Some((one, other)) => {
                let (first, second) = (&self.schemas[one - 1], &self.schemas[other - 1]);
                format!(
                    "equal views are not always one state: {} in v{} led to v{} (schema {one}) and to v{} (schema {other})\n",
                    first.action, first.from, first.to, second.to
                )
            }
            None => "equal views can be one state: no schemas contradict that\n".to_owned(),
        }
    }
}

pub(crate) fn run(options: &CheckArguments) -> Result<Status, Failure> {
    let exploration = read_exploration(&options.file)?;
    let mut contents = Contents::of(&exploration);
    if options.schemas || options.dot.is_some() {
        let trace = Trace::of(&exploration, Sight::Place, Turning::Direct).ok_or_else(|| {
            Failure::Usage(
                "--schemas and --dot need an exploration with travels: this one has none".to_owned(),
            )
        })?;
        contents.causal = options.schemas.then(|| CausalContents::of(&trace));
        if let Some(file) = &options.dot {
            write_file(file, &view_graph_dot(&trace))?;
        }
    }
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
    text += &contents.causal.as_ref().map_or_else(String::new, CausalContents::text);
    print(&text)?;
    Ok(Status::Found)
}
