//! How a map explains an exploration, travel by travel in words, once an independent checker agrees.

use std::fmt;

use hssh_causal::Exploration;
use hssh_topology::{Axioms, Discovery, Observation, Star, StarId, replay, violations};
use serde::{Deserialize, Serialize};

use super::Answer;
use super::error::DisagreementError;
use super::input::AnsweredInput;
use super::map::AnsweredMap;
use super::visit::{AnsweredVisit, Finding};

/// A map with the story that it tells of an exploration.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Explanation {
    /// `hssh-explanation`.
    pub format: String,
    /// 1.
    pub version: u32,
    /// What is explained.
    pub input: AnsweredInput,
    /// The map.
    pub map: AnsweredMap,
    /// The start and each travel in words.
    pub story: Vec<String>,
    /// What an independent checker found, in words.
    pub check: String,
}

impl Explanation {
    /// The story of the map of a rank, checked: the exploration is replayed in the map by code that shares nothing with the
    /// mapper, and every axiom is decided from its definition.
    ///
    /// # Errors
    /// If there is no such map, or it does not explain what it is said to explain: then something is wrong with the
    /// mapper, or the answer is another exploration's.
    pub fn new(
        answer: &Answer,
        rank: usize,
        exploration: &Exploration,
        axioms: &Axioms,
    ) -> Result<Self, DisagreementError> {
        let map = answer.map(rank).ok_or(DisagreementError::NoSuchRank(rank))?;
        check(map, exploration, axioms)?;
        let names = answer.visits.iter().map(|visit| visit.star.as_str());
        let pairs = map.visits.windows(2).zip(names.clone().skip(1));
        let start = names.clone().next().unwrap_or_default();
        let mut story = vec![format!("start at place 0, a {start}.")];
        story.extend(pairs.map(|(pair, seen)| sentence(&pair[0], &pair[1], seen)));
        Ok(Explanation {
            format: "hssh-explanation".to_owned(),
            version: 1,
            input: answer.input.clone(),
            map: map.clone(),
            story,
            check: "An independent replay agrees: every star matches, every place and link is needed, no axiom is \
                    violated."
                .to_owned(),
        })
    }
}

/// Replays the exploration in the map, and looks for violated axioms.
fn check(map: &AnsweredMap, exploration: &Exploration, axioms: &Axioms) -> Result<(), DisagreementError> {
    let sketch = map.sketch()?;
    let stars: Vec<Star> = exploration.star_types().iter().map(|named| named.star.clone()).collect();
    let observation = |travel: &hssh_causal::Travel| Observation {
        exit: travel.exit,
        entry: travel.entry,
        star: StarId::new(travel.star.0),
    };
    let explained = map.visits.len().saturating_sub(1);
    let observations: Vec<Observation> =
        exploration.travels().iter().take(explained).map(observation).collect();
    let told = replay(&sketch, &stars, StarId::new(exploration.start().0), &observations)?;
    for (index, (travel, visit)) in told.travels.iter().zip(map.visits.iter().skip(1)).enumerate() {
        let finding = match travel.discovery {
            Discovery::NewPlace => Finding::NewPlace,
            Discovery::LoopClosure => Finding::Closure,
            Discovery::KnownLink => Finding::Predicted,
        };
        if (travel.to.number(), travel.rotation, finding) != (visit.place, visit.rotation, visit.finding) {
            return Err(DisagreementError::ToldOtherwise { visit: index + 1 });
        }
    }
    match violations(&sketch, axioms)?.into_iter().next() {
        Some(violation) => Err(violation.into()),
        None => Ok(()),
    }
}

/// One travel in words.
fn sentence(before: &AnsweredVisit, now: &AnsweredVisit, seen: &str) -> String {
    let name = |end: &Option<String>| end.clone().unwrap_or_default();
    let (from, to) = (before.place, now.place);
    let (exit, entry) = (name(&before.exit), name(&now.entry));
    let left = format!("leave place {from} by {exit}, see a {seen}");
    let turned = match now.rotation {
        0 => String::new(),
        1 => ", seen turned by 1 end".to_owned(),
        ends => format!(", seen turned by {ends} ends"),
    };
    match now.finding {
        Finding::Start | Finding::NewPlace => format!("{left}: a new place {to}, entered by {entry}."),
        Finding::Closure => format!("{left}: back at place {to}, by its pending gateway {entry}{turned}."),
        Finding::Predicted => format!("{left}, as predicted: place {to}, entered by {entry}{turned}."),
    }
}

/// The story for people to read.
impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Explanation { input, map, story, check, .. } = self;
        writeln!(f, "Map {} of the ranking: {}.", map.rank, map.measure)?;
        for (travel, sentence) in story.iter().enumerate() {
            match travel {
                0 => writeln!(f, "      {sentence}")?,
                _ => writeln!(f, "{travel:>4}. {sentence}")?,
            }
        }
        let rest = if map.closed { "no gateway is pending" } else { "some gateways are pending" };
        write!(f, "      {} places, {} links; {rest}.", map.places.len(), map.links.len())?;
        match input.considered - input.explained {
            0 => writeln!(f)?,
            missing => writeln!(f, " A limit stopped the search {missing} travels before the end.")?,
        }
        writeln!(f, "{check}")
    }
}
