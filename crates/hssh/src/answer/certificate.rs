//! What is proved of the maps, and what the proof takes on trust.

use serde::{Deserialize, Serialize};

use super::input::AnsweredEvidence;
use super::map::MapMeasure;
use super::reading::ReadingAccount;
use super::words::counted;

/// How good a map is: what decides its rank.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Worth {
    /// By posterior: minus the logarithm of its probability up to a factor that all maps share; the less, the better.
    Nats(f64),
    /// By preference: its measure, which is compared number by number.
    Measure(MapMeasure),
}

/// Something that a proof does not prove.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Assumption {
    /// Every star was seen as it is, and every travel went as reported.
    Perception,
    /// What was said of which visits are to one place, and which are not, is true.
    Visits,
    /// The covariances of measured travels are what they are said to be.
    Covariances,
    /// Odometry bends a layout by no less than a fixed part of the linear estimate.
    LinearEstimates,
    /// Every layout can be computed.
    Layouts,
}

/// Something that a proof takes on trust.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Trusted {
    /// What it is.
    pub assumption: Assumption,
    /// The same in words.
    pub sentence: String,
    /// Whether nothing was met that contradicts it. If something was, nothing is proved.
    pub held: bool,
    /// With [`Assumption::LinearEstimates`]: the least part that was met on the way.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least: Option<f64>,
}

impl Trusted {
    /// Something that nothing can contradict.
    pub(crate) fn held(assumption: Assumption, sentence: String) -> Self {
        Trusted { assumption, sentence, held: true, least: None }
    }
}

/// What is known about the maps that were not found.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct CertificateSummary {
    /// Whether no map that was not found is as good as the first.
    pub proved: bool,
    /// What the first map is worth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub best: Option<Worth>,
    /// What any map that was not found is worth at best; absent if there is none, or if nothing is known of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub open: Option<Worth>,
    /// By posterior: the probability of all maps that were not found, at most.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest_probability: Option<f64>,
    /// What all this relies on.
    pub trusted: Vec<Trusted>,
}

impl CertificateSummary {
    /// Says what the stars and travels of a log rest on.
    pub(crate) fn trust_survey(&mut self, evidence: &AnsweredEvidence) {
        for trusted in self.trusted.iter_mut().filter(|trusted| trusted.assumption == Assumption::Perception)
        {
            trusted.sentence = format!(
                "the robot was back where the laser shows it ({} times, {} more seem so and were not confirmed, {} are \
                 contradicted by the rest), and places are where its ways part, turn back, or where one was sighted",
                evidence.returns, evidence.unconfirmed, evidence.contradicted
            );
        }
    }

    /// Says that the maps are those that agree with what was said of visits.
    pub(crate) fn trust_said(&mut self, pairs: usize) {
        let said = counted(pairs, "pair");
        let sentence = format!("what was said of {said} of visits, to one place or to two, is true");
        self.trusted.push(Trusted::held(Assumption::Visits, sentence));
    }

    /// Says that the maps are those of an account of what was misread; what it does not prove, they do not either.
    pub(crate) fn trust_readings(&mut self, account: &ReadingAccount) {
        self.proved &= account.proved;
        for trusted in self.trusted.iter_mut().filter(|trusted| trusted.assumption == Assumption::Perception)
        {
            let errors = counted(account.corrections.len(), "error");
            let others = if account.proved {
                "no other account is as probable, which is proved of the model of perception"
            } else {
                "other accounts may be more probable"
            };
            trusted.sentence = format!("perception made {errors}, those that are listed; {others}");
        }
    }

    /// Why nothing is proved, if it is for something that was relied on; a sentence without its beginning.
    pub(super) fn objection(&self) -> Option<&'static str> {
        let failed = self.trusted.iter().find(|trusted| !trusted.held)?;
        Some(match failed.assumption {
            Assumption::Layouts => {
                "some layouts cannot be computed, so that nothing is proved: is an odometry out of all proportion?"
            }
            Assumption::LinearEstimates => {
                "the bound relied on linear estimates that proved wrong by more than it allows for, so that nothing is \
                 proved."
            }
            Assumption::Perception | Assumption::Covariances | Assumption::Visits => {
                "the input contradicts what was taken on trust, so that nothing is proved."
            }
        })
    }
}
