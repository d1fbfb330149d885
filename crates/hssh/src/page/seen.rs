//! What the robot saw: the stars, and the visits with their local maps.

use hssh_causal::{Exploration, StarType};

use super::data::{PageEnd, PageImage, PageStar, PageVisit};
use super::image::rounded;
use super::way::Thinned;
use crate::pipeline::{Input, Mapped};

/// The stars of an exploration.
pub(super) fn stars(exploration: &Exploration) -> Vec<PageStar> {
    let star = |named: &hssh_causal::NamedStar| {
        let end = |(end, &bearing): (&hssh_topology::StarEnd, &Option<f64>)| PageEnd {
            name: end.name.to_string(),
            closed: end.passability == hssh_topology::Passability::Closed,
            label: end.label.clone(),
            bearing: bearing.map(rounded),
        };
        PageStar {
            name: named.name.clone(),
            ends: named.star.ends().iter().zip(&named.bearings).map(end).collect(),
        }
    };
    exploration.star_types().iter().map(star).collect()
}

/// The visits of the travels considered.
pub(super) fn visits(input: &Input, mapped: &Mapped, thinned: Option<&Thinned>) -> Vec<PageVisit> {
    let exploration = mapped.exploration(input);
    let (travels, records) = (exploration.travels(), &mapped.answer.visits);
    let readings = mapped.answer.readings.as_ref();
    let visit = |(index, star): (usize, StarType)| {
        let record = records.get(index);
        let surveyed = input.as_surveyed().and_then(|surveyed| surveyed.survey.visits.get(index));
        let told = readings.and_then(|account| account.visits.iter().find(|pair| pair[1] == index as u64));
        PageVisit {
            star: star.index() as u32,
            entry: index.checked_sub(1).map(|before| travels[before].entry.index() as u32),
            exit: travels
                .get(index)
                .filter(|_| index + 1 < records.len())
                .map(|travel| travel.exit.index() as u32),
            told: told.map(|pair| pair[0]),
            scan: record.and_then(|record| record.scan),
            scans: record.and_then(|record| record.scans),
            times: record.and_then(|record| record.times),
            picture: surveyed.map(|visit| PageImage::seen_from(&visit.grid, visit.frame)),
            at: thinned.and_then(|thinned| thinned.at(index)),
        }
    };
    exploration.visits().take(records.len()).enumerate().map(visit).collect()
}
