//! The answer in a word and in a sentence.

use hssh_search::StopReason;
use serde::{Deserialize, Serialize};

use super::certificate::CertificateSummary;
use super::input::AnsweredInput;
use super::reading::ReadingAccount;
use super::search::{SearchObjective, SearchOrder, SearchSummary};
use super::words::counted;

/// What came of a search, for programs.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VerdictKind {
    /// One map is the best, which is proved.
    OneBest,
    /// Several maps are equally good and better than all others, which is proved.
    SeveralBest,
    /// Maps were found; others may be better.
    Unproved,
    /// A limit or an interruption left the maps of the travels explained so far.
    StoppedEarly,
    /// A limit or an interruption came before any map.
    NoneYet,
    /// Maps explain everything considered, but none of them is closed as was asked for.
    NoClosedMap,
    /// No map explains everything considered.
    NoMap,
}

/// What came of a search.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Verdict {
    /// For programs.
    pub kind: VerdictKind,
    /// For people: first how much of the input it rests on, if not on all of it.
    pub sentence: String,
    /// With [`VerdictKind::NoMap`]: the travel that no hypothesis survives, counted from 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lost_at_travel: Option<u64>,
}

impl Verdict {
    /// The verdict on what a search did and proved.
    pub(crate) fn of(
        input: &AnsweredInput,
        search: &SearchSummary,
        certificate: &CertificateSummary,
    ) -> Self {
        let kind = kind(input, search, certificate);
        let lost_at_travel = (kind == VerdictKind::NoMap).then(|| {
            let alive = search.levels.iter().take_while(|level| level.nodes > 0).count() as u64;
            alive.saturating_sub(1)
        });
        let is_partial = input.basis() < input.travels;
        let basis = match input.basis() {
            _ if !is_partial => String::new(),
            1 => format!("Only the first of {} travels: ", input.travels),
            basis => format!("Only the first {basis} of {} travels: ", input.travels),
        };
        let what = match input.basis() {
            _ if !is_partial => "the exploration",
            1 => "it",
            _ => "them",
        };
        let body = match kind {
            VerdictKind::OneBest if input.travels == 0 => {
                "no way from one place to another was travelled, so that there was nothing to decide: one place is the \
                 whole map."
                    .to_owned()
            }
            VerdictKind::NoneYet => format!(
                "the search stopped before it found a map that explains {what}; the hypotheses that got farthest explain \
                 {} of {}.",
                search
                    .levels
                    .iter()
                    .filter(|level| level.nodes > 0)
                    .map(|level| level.travels)
                    .max()
                    .unwrap_or(0),
                counted(input.considered as usize, "travel")
            ),
            VerdictKind::NoClosedMap => format!(
                "no closed map explains {what}; {} left with pending gateways.",
                match search.rejected {
                    1 => "1 hypothesis was".to_owned(),
                    many => format!("{many} hypotheses were"),
                }
            ),
            VerdictKind::NoMap => format!(
                "no map explains {what}: none survives travel {}. Is a star wrong, or an axiom too strict?",
                lost_at_travel.unwrap_or_default() + 1
            ),
            _ => found(search, certificate, kind, what),
        };
        let mut sentence = if is_partial { basis + &body } else { capitalized(&body) };
        if let (VerdictKind::OneBest | VerdictKind::SeveralBest, Some(evidence)) = (kind, &input.evidence) {
            // A proof speaks of the model: what a survey saw is taken as given.
            let returns = counted(evidence.returns as usize, "return");
            sentence += &format!(" Given that the robot was back where the laser shows it: {returns}.");
        }
        Verdict { kind, sentence, lost_at_travel }
    }
}

impl Verdict {
    /// The maps are those of an account of what was misread.
    pub(crate) fn rest_on(&mut self, account: &ReadingAccount) {
        let errors = counted(account.corrections.len(), "error");
        if account.proved {
            self.sentence += &format!(
                " Given {errors} of perception, which no account does better with: proved of the model."
            );
            return;
        }
        if matches!(self.kind, VerdictKind::OneBest | VerdictKind::SeveralBest) {
            self.kind = VerdictKind::Unproved;
        }
        self.sentence = format!(
            "this map explains the exploration with {errors} of perception; whether another account is more probable was not proved."
        );
        self.sentence = capitalized(&self.sentence);
    }
}

fn kind(input: &AnsweredInput, search: &SearchSummary, certificate: &CertificateSummary) -> VerdictKind {
    match (search.found.maps, search.stop.is_complete()) {
        (0, false) => VerdictKind::NoneYet,
        (0, true) if search.rejected > 0 => VerdictKind::NoClosedMap,
        (0, true) => VerdictKind::NoMap,
        _ if certificate.proved && search.found.tied == 1 => VerdictKind::OneBest,
        _ if certificate.proved => VerdictKind::SeveralBest,
        (_, false) if input.explained < input.considered => VerdictKind::StoppedEarly,
        (_, false) if search.order == SearchOrder::Count => VerdictKind::StoppedEarly,
        _ => VerdictKind::Unproved,
    }
}

/// What was found, beginning with a small letter.
fn found(search: &SearchSummary, certificate: &CertificateSummary, kind: VerdictKind, what: &str) -> String {
    let SearchSummary { objective, order, stop, found, .. } = search;
    let maps = counted(found.maps as usize, "map");
    let explain = if found.maps == 1 { "explains" } else { "explain" };
    let (good, better) = match objective {
        SearchObjective::Preference => ("good", "better"),
        SearchObjective::Posterior => ("probable", "more probable"),
    };
    match (kind, order) {
        (VerdictKind::OneBest, SearchOrder::BreadthFirst | SearchOrder::Count) if found.maps == 1 => {
            format!("one map explains {what}; that no other does is proved.")
        }
        (VerdictKind::OneBest, SearchOrder::BreadthFirst | SearchOrder::Count) => {
            format!("{maps} {explain} {what}; one is optimal.")
        }
        (VerdictKind::SeveralBest, SearchOrder::BreadthFirst | SearchOrder::Count) => {
            format!("{maps} {explain} {what}; {} are optimal.", found.tied)
        }
        (VerdictKind::OneBest, _) => match objective {
            SearchObjective::Preference => {
                "one map is optimal; that no other is as good is proved.".to_owned()
            }
            SearchObjective::Posterior => {
                "one map is the most probable; that no other is as probable is proved.".to_owned()
            }
        },
        (VerdictKind::SeveralBest, _) => match objective {
            SearchObjective::Preference => {
                format!("{} maps are optimal; that no other is as good is proved.", found.tied)
            }
            SearchObjective::Posterior => {
                format!("{} maps are equally {good}; that no other is as {good} is proved.", found.tied)
            }
        },
        (VerdictKind::StoppedEarly, SearchOrder::Count) => {
            format!("stopped early, so far {maps} {explain} everything; the rest was not counted.")
        }
        (VerdictKind::StoppedEarly, order) if *order != SearchOrder::BreadthFirst => {
            "this is the best of the hypotheses that got farthest; the search stopped early.".to_owned()
        }
        (VerdictKind::StoppedEarly, _) => format!("{maps} {explain} {what}; the search stopped early."),
        _ if *stop == StopReason::Found => {
            format!("this map explains {what}; whether a {better} one exists was not searched.")
        }
        _ => {
            let stopped = if stop.is_complete() { "" } else { "stopped early, " };
            match certificate.objection() {
                Some(objection) => format!("{stopped}{maps} found; {objection}"),
                None => format!("{stopped}{maps} found; others may be {better}."),
            }
        }
    }
}

/// The text with a capital letter.
fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}
