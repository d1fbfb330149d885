//! Explorations in which perception may have erred: the most probable account, and the exploration as it must have been.

use std::sync::Arc;

use hssh_causal::Exploration;
use hssh_search::{Correction, MapperError, Monitor, PosteriorModel, ReadMap, Reader, StopReason};
use hssh_topology::{ChartEnd, PlaceId, ReadingModel};
use serde::{Deserialize, Serialize};

use super::engine::Means;
use super::error::{PipelineError, SearchFailure};
use super::options::MappingOptions;
use crate::answer::{CorrectionKind, ReadingAccount, ReadingCorrection, counted};

/// How errors of perception are reckoned with.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ReadingChoice {
    /// What errors cost; none of them happens if nothing is said.
    pub model: Option<ReadingModel>,
    /// The best account counts, without a proof, when it has been the best for so many expansions.
    pub patience: u64,
}

impl Default for ReadingChoice {
    fn default() -> Self {
        ReadingChoice { model: None, patience: 1_000 }
    }
}

/// An exploration as it must have been, and why.
pub(super) struct Read {
    pub(super) exploration: Exploration,
    pub(super) account: ReadingAccount,
    /// Why the search for it ended.
    pub(super) stop: StopReason,
}

/// The most probable account of an exploration, by the model of `options`.
pub(super) fn read(
    exploration: &Exploration,
    reading: ReadingModel,
    posterior: PosteriorModel,
    options: &MappingOptions,
    monitor: &Arc<Monitor>,
    means: &Means<'_>,
) -> Result<Read, PipelineError> {
    let reader = Reader {
        reading,
        axioms: options.axioms,
        constraints: options.visits.constraints()?,
        best: options.posterior.best,
        patience: Some(options.readings.patience),
        limits: options.limits.of_search(),
        threads: options.search.threads,
        monitor: Arc::clone(monitor),
        checkpoints: means.reading_checkpoints.clone(),
        store: means.store.clone(),
        ..Reader::new(posterior)
    };
    let answer = reader.read(exploration).map_err(|error| match error {
        MapperError::Checkpoint(error) => SearchFailure::ReadingCheckpoint(error),
        error => error.into(),
    })?;
    let Some(best) = answer.maps.first() else {
        return Err(PipelineError::NoAccount { stop: answer.stop });
    };
    let corrected =
        best.corrected(exploration).map_err(|problem| PipelineError::Corrected(Box::new(problem)))?;
    // Places of the maps are numbered as they are come to.
    let mut numbers: Vec<PlaceId> = Vec::new();
    for &place in &corrected.places {
        if !numbers.contains(&place) {
            numbers.push(place);
        }
    }
    let number =
        |place: PlaceId| numbers.iter().position(|&other| other == place).map(|number| number as u32);
    let corrections = best.corrections(exploration);
    let visits = corrected.told.iter().enumerate();
    let visits = visits.filter_map(|(visit, told)| Some([(*told)? as u64, visit as u64])).collect();
    let account = ReadingAccount {
        nats: best.cost.total(),
        nats_of_errors: best.cost.perception,
        at_most: best.at_most,
        proved: answer.proof.proved,
        found: answer.maps.len() as u64,
        corrections: corrections.iter().map(|correction| told(correction, best, number)).collect(),
        visits,
    };
    Ok(Read { exploration: corrected.exploration, account, stop: answer.stop })
}

/// A correction in words.
fn told(
    correction: &Correction,
    map: &ReadMap,
    number: impl Fn(PlaceId) -> Option<u32>,
) -> ReadingCorrection {
    let names = |place: PlaceId, ends: &[ChartEnd]| -> Vec<String> {
        let star = map.chart.star(place);
        let all = map.chart.ends_of(place).iter().zip(star.ends());
        all.filter(|(end, _)| ends.contains(end)).map(|(_, end)| end.name.to_string()).collect()
    };
    let place_name =
        |place: PlaceId| number(place).map_or("a place".to_owned(), |number| format!("place {number}"));
    let quoted =
        |names: &[String]| names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let (kind, visit, place, ends, sentence) = match correction {
        Correction::Missed { visit, place, ends } => {
            let ends = names(*place, ends);
            let gateways = counted(ends.len(), "gateway");
            let sentence =
                format!("visit {visit} missed {gateways} of {}: {}", place_name(*place), quoted(&ends));
            (CorrectionKind::Missed, *visit, Some(*place), ends, sentence)
        }
        Correction::New { visit, place, ends } => {
            let ends = names(*place, ends);
            let gateways = counted(ends.len(), "gateway");
            let sentence = format!(
                "visit {visit} is the first to show {gateways} of {}: {}",
                place_name(*place),
                quoted(&ends)
            );
            (CorrectionKind::New, *visit, Some(*place), ends, sentence)
        }
        Correction::Passed { visit, place } => {
            let sentence =
                format!("before visit {visit} the robot passed {} without a report", place_name(*place));
            (CorrectionKind::Passed, *visit, Some(*place), Vec::new(), sentence)
        }
        Correction::False { visit } => {
            (CorrectionKind::False, *visit, None, Vec::new(), format!("visit {visit} is to no place"))
        }
        Correction::TurnedBack { visit, place } => {
            let sentence = format!(
                "before visit {visit} the robot turned on the way, and was back at {}",
                place_name(*place)
            );
            (CorrectionKind::TurnedBack, *visit, Some(*place), Vec::new(), sentence)
        }
    };
    ReadingCorrection { kind, visit: visit as u64, place: place.and_then(number), ends, sentence }
}
