//! Whether a map of an answer is one to go by: the single best one, with nothing that speaks against it.

use super::Answer;
use super::verdict::VerdictKind;

impl Answer {
    /// Why the map of a rank may well be the wrong one to go by, if it may. `None` only for the best map, if there is a single one,
    /// either proved or more probable than not, and no warning makes it [doubtful](Answer::doubt).
    #[must_use]
    pub fn reservation(&self, rank: usize) -> Option<String> {
        if rank != 1 {
            let known = self.map(rank).and_then(|map| map.probability);
            let probability = known.map(|[_, most]| format!("; its probability is at most {most:.2}"));
            return Some(format!("this is map {rank} of the ranking{}", probability.unwrap_or_default()));
        }
        if let Some(doubt) = self.doubt() {
            return Some(doubt);
        }
        let is_probable =
            self.maps.first().and_then(|map| map.probability).is_some_and(|[least, _]| least >= 0.5);
        match self.verdict.kind {
            VerdictKind::OneBest => None,
            VerdictKind::Unproved if is_probable => None,
            VerdictKind::SeveralBest
            | VerdictKind::Unproved
            | VerdictKind::StoppedEarly
            | VerdictKind::NoneYet
            | VerdictKind::NoClosedMap
            | VerdictKind::NoMap => Some(self.verdict.sentence.clone()),
        }
    }
}
