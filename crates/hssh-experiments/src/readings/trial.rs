//! One exploration with injected errors: is the true map found, with readings and without?

use std::error::Error;
use std::time::Duration;

use hssh_search::{Limits, PosteriorModel, ReadAnswer, Reader, VisitConstraints};
use hssh_topology::Axioms;
use hssh_world::{DriftModel, ErrorRates, Misperceived, Route, World};

/// Where robots drive.
pub(super) struct Ground {
    pub(super) name: String,
    pub(super) world: World,
    pub(super) route: Route,
}

/// What a search has to come to within.
#[derive(Clone, Copy)]
pub(super) struct Means {
    pub(super) seconds: f64,
    pub(super) patience: u64,
}

/// What one trial came to.
#[derive(Clone, Copy, Default)]
pub(super) struct Outcome {
    pub(super) errors: usize,
    /// The best account puts all visits where they were.
    pub(super) right: bool,
    /// No account is known that puts all visits where they were and is more probable: the search did what the model allows.
    pub(super) probable: bool,
    pub(super) proved: bool,
    pub(super) found_after: u64,
    pub(super) expanded: u64,
    pub(super) seconds: f64,
    /// The same, every star and travel being certain.
    pub(super) exact_right: bool,
    pub(super) exact_found_after: u64,
}

/// Costs that differ by less are the same: nats.
const SAME: f64 = 1e-6;

const MOST_BYTES: u64 = 2 << 30;

impl Ground {
    /// What a robot tells whose perception errs at that rate.
    pub(super) fn told(&self, rate: f64, seed: u64) -> Result<Misperceived, Box<dyn Error>> {
        Ok(self.world.misperceive(&self.route, &DriftModel::default(), ErrorRates::all(rate), seed)?)
    }

    pub(super) fn try_with(&self, rate: f64, seed: u64, means: Means) -> Result<Outcome, Box<dyn Error>> {
        let told = self.told(rate, seed)?;
        let exploration = &told.exploration;
        let model = PosteriorModel::evidence(exploration).ok_or("no distance was measured")?;
        let axioms = Axioms { max_genus: Some(0), ..Axioms::default() };
        let time = Some(Duration::from_secs_f64(means.seconds));
        let limits = Limits { time, bytes: Some(MOST_BYTES), ..Limits::default() };
        let patience = Some(means.patience);
        let reader = Reader { axioms, limits, patience, ..Reader::new(model) };
        let read = reader.read(exploration)?;
        let right =
            |answer: &ReadAnswer| answer.maps.first().is_some_and(|map| told.is_told_apart_by(&map.visits()));
        let [same, different] = told.pairs();
        let constraints = VisitConstraints::new(&same, &different)?;
        let truth = Reader { constraints, ..reader.clone() }.read(exploration)?;
        let cost = |answer: &ReadAnswer| answer.maps.first().map_or(f64::INFINITY, |map| map.cost.total());
        let exact = reader.exact().read(exploration)?;
        Ok(Outcome {
            errors: told.errors.iter().sum(),
            right: right(&read),
            probable: cost(&read) <= cost(&truth) + SAME,
            proved: read.proof.proved,
            found_after: read.found_after,
            expanded: read.expanded,
            seconds: read.seconds,
            exact_right: right(&exact),
            exact_found_after: exact.found_after,
        })
    }
}
