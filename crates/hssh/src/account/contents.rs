//! What is in an exploration: travels and stars in numbers, and its causal schemas.

use std::collections::BTreeMap;
use std::fmt;

use hssh_causal::schema::{Automaton, Change, Refutation, Schema, Trace, View, numbered_views};
use hssh_causal::{Doubt, Exploration, NamedStar};
use serde::{Deserialize, Serialize};

use crate::answer::counted;

/// How many questions the text lists.
const MOST_QUESTIONS: usize = 5;

/// What is in an exploration.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct ContentsAccount {
    /// `hssh-contents`.
    pub format: String,
    /// 1.
    pub version: u32,
    /// The exploration, as it was given.
    pub name: String,
    /// How many travels there are.
    pub travels: u64,
    /// How many of them have odometry.
    pub travels_with_odometry: u64,
    /// What places look like, in the order of the exploration.
    pub star_types: Vec<StarTypeContents>,
    /// What is worth asking about: measurements that are possible and hardly meant.
    pub questions: Vec<String>,
    /// The same at the causal level, if it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub causal: Option<CausalContents>,
}

/// A star type in numbers.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct StarTypeContents {
    /// Its name.
    pub name: String,
    /// The star, as the thesis writes it.
    pub star: String,
    /// How many of its ends are gateways.
    pub gateways: u64,
    /// How many have a bearing.
    pub bearings: u64,
    /// How often it was seen.
    pub visits: u64,
}

/// An exploration at the causal level.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct CausalContents {
    /// What was seen, the first being `v1`.
    pub views: Vec<String>,
    /// The schemas in order.
    pub schemas: Vec<SchemaContents>,
    /// The first two schemas, counted from 1, that contradict that equal views are one state.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contradiction: Option<(usize, usize)>,
}

/// A schema ⟨v, a, v'⟩ with the numbers of its views, and its annotation where it was measured.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SchemaContents {
    /// v.
    pub from: u32,
    /// a.
    pub action: String,
    /// v'.
    pub to: u32,
    /// Metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    /// Radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<f64>,
    /// Of distance and rotation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub covariance: Option<[[f64; 2]; 2]>,
}

impl ContentsAccount {
    /// The account of an exploration, with the schemas of a trace of it if they are asked for.
    #[must_use]
    pub fn new(name: &str, exploration: &Exploration, trace: Option<&Trace>) -> Self {
        let mut visits: BTreeMap<usize, u64> = BTreeMap::new();
        exploration.visits().for_each(|star_type| *visits.entry(star_type.index()).or_default() += 1);
        let star_type = |(index, named): (usize, &NamedStar)| StarTypeContents {
            name: named.name.clone(),
            star: named.star.to_string(),
            gateways: named.star.gateways().count() as u64,
            bearings: named.bearings.iter().flatten().count() as u64,
            visits: visits.get(&index).copied().unwrap_or(0),
        };
        let travels = exploration.travels();
        ContentsAccount {
            format: "hssh-contents".to_owned(),
            version: 1,
            name: name.to_owned(),
            travels: travels.len() as u64,
            travels_with_odometry: travels.iter().filter(|travel| travel.odometry.is_some()).count() as u64,
            star_types: exploration.star_types().iter().enumerate().map(star_type).collect(),
            questions: exploration.doubts().iter().map(Doubt::to_string).collect(),
            causal: trace.map(CausalContents::new),
        }
    }
}

impl CausalContents {
    /// The schemas of a trace.
    #[must_use]
    pub fn new(trace: &Trace) -> Self {
        let numbers = numbered_views(trace);
        let mut views: Vec<(u32, &View)> = numbers.iter().map(|(&view, &number)| (number, view)).collect();
        views.sort_unstable();
        let schema = |schema: Schema<'_>| {
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
}

impl fmt::Display for ContentsAccount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}: {}, {} with odometry; {}",
            self.name,
            counted(self.travels as usize, "travel"),
            self.travels_with_odometry,
            counted(self.star_types.len(), "star type"),
        )?;
        let width = self.star_types.iter().map(|star| star.name.chars().count()).max().unwrap_or(0);
        for star in &self.star_types {
            writeln!(f, "  {:<width$}  {:>3} ×  {}", star.name, star.visits, star.star)?;
        }
        for question in self.questions.iter().take(MOST_QUESTIONS) {
            writeln!(f, "question: {question}")?;
        }
        if let Some(more) = self.questions.len().checked_sub(MOST_QUESTIONS).filter(|&more| more > 0) {
            writeln!(f, "and {more} more questions of this kind")?;
        }
        self.causal.as_ref().map_or(Ok(()), |causal| causal.fmt(f))
    }
}

impl fmt::Display for CausalContents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "views, clockwise from the end ahead:")?;
        for (index, view) in self.views.iter().enumerate() {
            writeln!(f, "  {:<4} {view}", format!("v{}", index + 1))?;
        }
        writeln!(f, "schemas:")?;
        let width = self.schemas.iter().map(|schema| schema.action.len()).max().unwrap_or(0);
        for (index, schema) in self.schemas.iter().enumerate() {
            let SchemaContents { from, action, to, distance, rotation, covariance } = schema;
            let change = Change { distance: *distance, rotation: *rotation, covariance: *covariance };
            let (from, to) = (format!("v{from}"), format!("v{to}"));
            let line = format!("  {:>4}  {from:<4} {action:<width$}  {to:<4} {change}", index + 1);
            writeln!(f, "{}", line.trim_end())?;
        }
        match self.contradiction {
            Some((one, other)) => {
                let (first, second) = (&self.schemas[one - 1], &self.schemas[other - 1]);
                writeln!(
                    f,
                    "equal views are not always one state: {} in v{} led to v{} (schema {one}) and to v{} (schema {other})",
                    first.action, first.from, first.to, second.to
                )
            }
            None => writeln!(f, "equal views can be one state: no schemas contradict that"),
        }
    }
}
