//! Where an exported map comes from, and how far it can be believed: what every file says of itself.

use serde::Serialize;

use crate::account::PlacesAccount;
use crate::answer::{Answer, AnsweredMap};

/// Where a map comes from, and how far it can be believed. Nothing in it is `null` when it is written.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Provenance {
    /// `hssh` and its version.
    pub generator: String,
    /// The input, as it was given.
    pub source: String,
    /// Of an answer's map: its place in the ranking.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rank: Option<u64>,
    /// Of an answer's map by posterior: its probability at least.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub probability_at_least: Option<f64>,
    /// Of an answer's map by posterior: its probability at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub probability_at_most: Option<f64>,
    /// Of an answer's map: what the answer says of its best map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<String>,
    /// Why the map may well be the wrong one, if it may.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
    /// Of an answer's map: where its ways come from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ways: Option<String>,
}

impl Provenance {
    /// Of a map of an answer; `doubt` is why it may be the wrong one.
    #[must_use]
    pub fn of_map(answer: &Answer, map: &AnsweredMap, doubt: Option<String>) -> Self {
        let is_driven = map.links.iter().any(|link| !link.way.is_empty());
        let ways = match is_driven {
            true => "as the robot drove them, without detours",
            false => "straight lines from place to place: no laser log says how the robot went",
        };
        Provenance {
            rank: Some(map.rank),
            probability_at_least: map.probability.map(|[least, _]| least),
            probability_at_most: map.probability.map(|[_, most]| most),
            verdict: Some(answer.verdict.sentence.clone()),
            doubt,
            ways: Some(ways.to_owned()),
            ..Provenance::of_source(&answer.input.name)
        }
    }

    /// Of a grid map.
    #[must_use]
    pub fn of_places(account: &PlacesAccount) -> Self {
        Provenance::of_source(&account.name)
    }

    fn of_source(source: &str) -> Self {
        Provenance {
            generator: format!("hssh {}", env!("CARGO_PKG_VERSION")),
            source: source.to_owned(),
            rank: None,
            probability_at_least: None,
            probability_at_most: None,
            verdict: None,
            doubt: None,
            ways: None,
        }
    }

    /// All that is known, name by name, numbers as numbers.
    pub(super) fn facts(&self) -> Vec<(&'static str, Fact<'_>)> {
        fn text(text: &Option<String>) -> Option<Fact<'_>> {
            text.as_deref().map(Fact::Text)
        }
        let facts = [
            ("generator", Some(Fact::Text(&self.generator))),
            ("source", Some(Fact::Text(&self.source))),
            ("rank", self.rank.map(Fact::Count)),
            ("probability_at_least", self.probability_at_least.map(Fact::Number)),
            ("probability_at_most", self.probability_at_most.map(Fact::Number)),
            ("verdict", text(&self.verdict)),
            ("doubt", text(&self.doubt)),
            ("ways", text(&self.ways)),
        ];
        facts.into_iter().filter_map(|(name, fact)| Some((name, fact?))).collect()
    }

    /// A line of comment for each fact, as YAML has comments.
    pub(super) fn to_comments(&self) -> String {
        let line = |(name, fact): (&str, Fact<'_>)| {
            let fact = fact.to_string();
            let harmless =
                fact.chars().map(|letter| if letter.is_control() || is_break(letter) { ' ' } else { letter });
            format!("# {name}: {}\n", harmless.collect::<String>())
        };
        self.facts().into_iter().map(line).collect()
    }
}

/// What ends a line to some readers of YAML, or is nothing that one may hold.
fn is_break(letter: char) -> bool {
    matches!(letter, '\u{2028}' | '\u{2029}' | '\u{FEFF}' | '\u{FFFE}' | '\u{FFFF}')
}

/// One thing that is known.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Fact<'a> {
    Text(&'a str),
    Count(u64),
    Number(f64),
    /// As `x y, x y, …`.
    Line(&'a [[f64; 2]]),
}

impl std::fmt::Display for Fact<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Fact::Text(text) => f.write_str(text),
            Fact::Count(count) => write!(f, "{count}"),
            Fact::Number(number) => write!(f, "{number}"),
            Fact::Line(line) => {
                let corners: Vec<String> = line.iter().map(|[x, y]| format!("{x} {y}")).collect();
                f.write_str(&corners.join(", "))
            }
        }
    }
}
