//! What a hypothesis pays: minus the logarithm of its posterior probability, item by item.

use hssh_topology::{Observation, StarId, TopologicalMap};
use serde::Serialize;

use crate::experience::Experience;
use crate::measured::Measured;
use crate::posterior::model::{MapPrior, Metrical, PosteriorModel};
use crate::posterior::outlook::Outlook;

/// The cost of a hypothesis in nats, item by item. A map with the cost c has the posterior probability e⁻ᶜ, up
/// to a factor that all maps share. No item ever falls along a branch, except that a price of new places
/// may be negative if odometry is very poor, or corridors are very short.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize)]
pub struct Cost {
    /// χ²/2 of the best layout: what its bending costs.
    pub bend: f64,
    /// Σ ½ ln(|C + H Σ Hᵀ| / |C|) over travels between known places: what their vague prediction costs.
    /// Counts in the evidence only.
    pub vagueness: f64,
    /// What the new places cost: the density of a perfect prediction against that of the prior on where
    /// corridors lead. Counts in the evidence only.
    pub places: f64,
    /// Σ ln of the number of consistent extensions, wherever one was chosen.
    pub choices: f64,
    /// ln F.
    pub complexity: f64,
    /// How much less alike visits to one place look than the most alike visits there are.
    pub appearance: f64,
}

impl Cost {
    /// The sum.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.bend + self.vagueness + self.places + self.choices + self.complexity + self.appearance
    }

    /// The same with another χ².
    pub(crate) fn with_chi2(self, chi2: f64) -> Self {
        Cost { bend: 0.5 * chi2, ..self }
    }
}

/// A model applied to one exploration: what each travel may cost.
#[derive(Clone, Debug)]
pub(crate) struct Tariff {
    pub(crate) model: PosteriorModel,
    outlook: Outlook,
    /// By travel: what it costs if it leads to a new place.
    new_place: Vec<f64>,
    /// By number of travels explained: the least price of a new place among those left, at least 0.
    least_new_place: Vec<f64>,
    /// By number of travels explained: the sum of the negative prices among those left.
    discount: Vec<f64>,
    /// By travel.
    branching: Vec<Branching>,
}

impl Tariff {
    pub(crate) fn new(
        model: PosteriorModel,
        exploration: &hssh_causal::Exploration,
        experience: &Experience,
        measured: Option<&Measured>,
    ) -> Self {
        let new_place = match (model.metrical, measured) {
            (Metrical::Evidence(prior), Some(measured)) => {
                let visits: Vec<_> =
                    exploration.visits().map(|star| &exploration.star_types()[star.index()]).collect();
                let travels = exploration.travels().iter().zip(&measured.travels).enumerate();
                let price = |(index, (travel, measurement)): (
                    usize,
                    (&hssh_causal::Travel, &crate::measured::MeasuredTravel),
                )| {
                    let exit = visits[index].bearings[travel.exit.index()];
                    let entry = visits[index + 1].bearings[travel.entry.index()];
                    let odometry = travel.odometry.as_ref();
                    measurement.peak()
                        - odometry.map_or(0.0, |measured| prior.log_density(measured, exit, entry))
                };
                travels.map(price).collect()
            }
            _ => vec![0.0; experience.observations.len()],
        };
        let rest = |explained: usize| &new_place[explained..];
        let all = 0..=new_place.len();
        let least = |explained| rest(explained).iter().copied().fold(f64::INFINITY, f64::min);
        let least_new_place = all.clone().map(|explained| least(explained).clamp(0.0, f64::MAX)).collect();
        let discount =
            all.map(|explained| rest(explained).iter().map(|price| price.min(0.0)).sum()).collect();
        Tariff {
            outlook: Outlook::of(experience, measured),
            least_new_place,
            discount,
            branching: branching(experience),
            new_place,
            model,
        }
    }

    /// What the travel costs if it leads to a new place.
    pub(crate) fn new_place(&self, travel: usize) -> f64 {
        self.new_place[travel]
    }

    /// What it costs to choose one of so many extensions.
    pub(crate) fn choice(&self, extensions: usize) -> f64 {
        if self.model.prior == MapPrior::Choices { (extensions as f64).ln() } else { 0.0 }
    }

    pub(crate) fn is_evidence(&self) -> bool {
        matches!(self.model.metrical, Metrical::Evidence(_))
    }

    /// ln F of a map.
    pub(crate) fn complexity(&self, map: &TopologicalMap) -> f64 {
        match self.model.prior {
            MapPrior::Simplicity(weights) => weights.of(map).ln(),
            MapPrior::Flat | MapPrior::Choices => 0.0,
        }
    }

    /// What ln F does not fall below in any map that comes of this one with so many travels more.
    pub(crate) fn least_complexity(&self, map: &TopologicalMap, travels_left: u32) -> f64 {
        match self.model.prior {
            MapPrior::Simplicity(weights) if travels_left > 0 => weights.bound(map, travels_left).ln(),
            _ => self.complexity(map),
        }
    }

    /// What every map that comes of a hypothesis costs at least. `floor` is the hypothesis's own cost
    /// with the least complexity of what comes of it.
    pub(crate) fn bound(&self, floor: &Cost, explained: usize) -> f64 {
        let rest = floor.total() - floor.bend - floor.complexity;
        let per_place = match self.model.metrical {
            Metrical::Evidence(_) => self.least_new_place[explained],
            _ => 0.0,
        };
        let cost = |places: u32| {
            let complexity = match self.model.prior {
                MapPrior::Simplicity(weights) => {
                    (floor.complexity.exp() + weights.c3 * f64::from(places)).ln()
                }
                MapPrior::Flat | MapPrior::Choices => 0.0,
            };
            per_place * f64::from(places) + complexity
        };
        rest + self.discount[explained] + self.outlook.least(explained, floor.bend, cost)
    }

    /// ln of how many maps can come of a hypothesis at most; of the sum of their prior probabilities relative
    /// to its own, if these are probabilities of choices, which add up to one.
    pub(crate) fn log_branches(&self, explained: usize, pending: u32) -> f64 {
        if self.model.prior == MapPrior::Choices {
            return 0.0;
        }
        let mut pending = pending;
        let mut log = 0.0;
        for rest in &self.branching[explained..] {
            log += (1.0 + f64::from(rest.alike.min(pending.saturating_sub(1)))).ln();
            pending += rest.gained;
        }
        log
    }
}

/// What one travel does to the number of branches.
#[derive(Clone, Copy, Debug)]
struct Branching {
    /// How many gateways, of all those seen before it, look like its entry: more closures there are not.
    alike: u32,
    /// By how many the pending gateways grow at most: those of a new place but two.
    gained: u32,
}

fn branching(experience: &Experience) -> Vec<Branching> {
    let Experience { catalog, start, observations } = experience;
    let of_travel = |(travel, now): (usize, &Observation)| {
        let seen = std::iter::once(*start).chain(observations[..travel].iter().map(|before| before.star));
        let alike = |star: StarId| {
            let gateways = catalog.star(star).gateways();
            gateways.filter(|&olp| catalog.matches(now.star, now.entry, star, olp)).count() as u32
        };
        let gateways = catalog.star(now.star).gateways().count() as u32;
        Branching { alike: seen.map(alike).sum(), gained: gateways.saturating_sub(2) }
    };
    observations.iter().enumerate().map(of_travel).collect()
}
