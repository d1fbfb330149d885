//! A model applied to one experience: what each travel costs, and what those to come cost at least.

use std::collections::BTreeMap;

use hssh_causal::Odometry;
use hssh_topology::{Look, Observation, SimplicityFloor, TopologicalMap};

use crate::experience::Experience;
use crate::limits::{StopReason, Watch};
use crate::measured::Measured;
use crate::posterior::cost::Cost;
use crate::posterior::model::{Corridor, MapPrior, Metrical, PlacePrior, PosteriorModel};
use crate::posterior::outlook::{Outlook, Sameness};
use crate::posterior::prices::Prices;

/// Factors are multiplied up to this before the logarithm is taken.
const MOST_FACTORS: f64 = 1e290;

/// What each travel may cost. It grows with the experience.
#[derive(Clone, Debug)]
pub(crate) struct Tariff {
    pub(crate) model: PosteriorModel,
    pub(crate) outlook: Outlook,
    /// Where corridors lead, if that is the prior: given, or as those travelled so far.
    corridor: Option<Corridor>,
    /// By travel: what it costs if it leads to a new place.
    new_place: Vec<f64>,
    /// What new places cost at least among the travels left.
    prices: Prices,
    /// By number of travels explained: the sum of the negative prices among those left.
    discount: Vec<f64>,
    /// By travel.
    branching: Vec<Branching>,
    /// How many gateways were seen that look alike, but on the last visit.
    seen: BTreeMap<Look, u32>,
}

/// What one travel does to the number of branches.
#[derive(Clone, Copy, Debug)]
struct Branching {
    /// How many gateways, of all those seen before it, look like its entry: more closures there are not.
    alike: u32,
    /// By how many the pending gateways grow at most: those of a new place but two.
    gained: u32,
}

impl Tariff {
    pub(crate) fn new(model: PosteriorModel, sameness: Sameness) -> Self {
        Tariff {
            model,
            outlook: Outlook::new(model.metrical != Metrical::Ignored, sameness),
            corridor: None,
            new_place: Vec::new(),
            prices: Prices::new(&[]),
            discount: vec![0.0],
            branching: Vec::new(),
            seen: BTreeMap::new(),
        }
    }

    /// Takes notice of the travels that are new; whether the prices of old ones changed.
    ///
    /// # Errors
    /// If a limit stopped it; the next call goes on.
    pub(crate) fn observe(
        &mut self,
        experience: &Experience,
        measured: Option<&Measured>,
        watch: &Watch,
    ) -> Result<bool, StopReason> {
        self.outlook.observe(experience, measured, watch).map_or(Ok(()), Err)?;
        self.count_branches(experience);
        let before = self.corridor;
        self.corridor = match self.model.metrical {
            Metrical::Evidence(PlacePrior::Corridor(corridor)) => Some(corridor),
            Metrical::Evidence(PlacePrior::Typical) => {
                let odometry = (0..experience.observations.len()).filter_map(|t| experience.odometry(t));
                Corridor::typical(odometry)
            }
            _ => None,
        };
        let is_changed = before != self.corridor;
        if is_changed {
            self.new_place.clear();
        }
        let new = self.new_place.len()..experience.observations.len();
        self.new_place.extend(new.map(|travel| match (self.model.metrical, measured) {
            (Metrical::Evidence(prior), Some(measured)) => {
                let density = log_density(prior, self.corridor, experience, travel);
                measured.travels[travel].peak() - density
            }
            _ => 0.0,
        }));
        self.look_ahead();
        Ok(is_changed)
    }

    /// How many travels there are.
    pub(crate) fn travels(&self) -> usize {
        self.new_place.len()
    }

    /// Sums over the travels that are left, by how many are explained.
    fn look_ahead(&mut self) {
        let travels = self.new_place.len();
        self.prices = Prices::new(&self.new_place);
        self.discount = vec![0.0; travels + 1];
        for (travel, &price) in self.new_place.iter().enumerate().rev() {
            self.discount[travel] = self.discount[travel + 1] + price.min(0.0);
        }
    }

    fn count_branches(&mut self, experience: &Experience) {
        let Experience { catalog, observations, .. } = experience;
        for (travel, now) in observations.iter().enumerate().skip(self.branching.len()) {
            let known = experience.star_of(travel);
            for gateway in catalog.star(known).gateways() {
                *self.seen.entry(catalog.look(known, gateway)).or_default() += 1;
            }
            let alike = self.seen.get(&catalog.look(now.star, now.entry)).copied().unwrap_or(0);
            let gateways = catalog.star(now.star).gateways().count() as u32;
            self.branching.push(Branching { alike, gained: gateways.saturating_sub(2) });
        }
    }

    /// What the travel costs if it leads to a new place.
    pub(crate) fn new_place(&self, travel: usize) -> f64 {
        self.new_place[travel]
    }

    /// Where corridors lead, if that is the prior.
    pub(crate) fn corridor(&self) -> Option<Corridor> {
        self.corridor
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

    /// What F does not fall below in any map that comes of this one.
    pub(crate) fn floor(&self, map: &TopologicalMap) -> Option<SimplicityFloor> {
        match self.model.prior {
            MapPrior::Simplicity(weights) => Some(weights.floor(map)),
            MapPrior::Flat | MapPrior::Choices => None,
        }
    }

    /// What every map that comes of a hypothesis costs at least, with so many travels explained and so many left; `cost` is the
    /// hypothesis's own.
    pub(crate) fn bound(&self, cost: &Cost, floor: Option<SimplicityFloor>, explained: usize) -> f64 {
        let left = self.new_place.len() - explained;
        let least = match (floor, self.model.prior) {
            (Some(floor), MapPrior::Simplicity(weights)) => {
                let least = if left > 0 { floor.least(left as u32) } else { cost.complexity.exp() };
                Some((least, weights.c3))
            }
            _ => None,
        };
        let to_come = |places: u32| {
            let complexity = least.map_or(0.0, |(least, c3)| (least + c3 * f64::from(places)).ln());
            let paid = if self.is_evidence() { self.prices.sum(explained, places) } else { 0.0 };
            paid + complexity
        };
        let rest = cost.total() - cost.bend - cost.complexity;
        rest + self.discount[explained] + self.outlook.least(explained, cost.bend, to_come)
    }

    /// ln of how many maps can come of a hypothesis at most; of the sum of their prior probabilities relative
    /// to its own, if these are probabilities of choices, which add up to one.
    pub(crate) fn log_branches(&self, explained: usize, pending: u32) -> f64 {
        if self.model.prior == MapPrior::Choices {
            return 0.0;
        }
        let (mut pending, mut log, mut product) = (pending, 0.0, 1.0);
        for rest in &self.branching[explained..] {
            product *= 1.0 + f64::from(rest.alike.min(pending.saturating_sub(1)));
            pending += rest.gained;
            if product > MOST_FACTORS {
                log += f64::ln(product);
                product = 1.0;
            }
        }
        log + product.ln()
    }
}

/// The log-density of the pose of a new place that the travel leads to.
fn log_density(prior: PlacePrior, corridor: Option<Corridor>, experience: &Experience, travel: usize) -> f64 {
    let Observation { exit, entry, star } = experience.observations[travel];
    let (departed, arrived) = (experience.bearings(experience.star_of(travel)), experience.bearings(star));
    let density = |measured: &Odometry| match (prior, corridor) {
        (PlacePrior::Uniform(prior), _) => prior.log_density(),
        (_, Some(corridor)) => corridor.log_density(measured, departed[exit.index()], arrived[entry.index()]),
        (_, None) => 0.0,
    };
    experience.odometry(travel).map_or(0.0, density)
}
