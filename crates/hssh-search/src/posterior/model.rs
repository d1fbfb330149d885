//! What makes a map probable: the price of its complexity and how well it fits the measured travels.

use std::f64::consts::TAU;

use hssh_causal::{Exploration, Odometry};
use hssh_metrics::{Pose, UniformPrior, wrap_angle};
use hssh_topology::{Simplicity, SimplicityError};

/// The posterior probability of a map: (4.5), metrical likelihood times prior.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PosteriorModel {
    /// p(τ° | map), up to a factor that all maps share.
    pub metrical: Metrical,
    /// p(map), up to such a factor.
    pub prior: MapPrior,
}

/// How well a map explains the measured travels.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Metrical {
    /// Not at all: only the prior counts.
    Ignored,
    /// (4.9): the density of the measurements at the most likely layout, −χ²/2.
    Likelihood,
    /// (4.6): the density of the measurements, whatever the layout. Travel by travel: one to a new place
    /// contributes the density of where a corridor leads, one between known places how well the layout
    /// so far predicts it, N(τ°; predicted, C + H Σ Hᵀ).
    Evidence(PlacePrior),
}

/// Where the corridor to a place not seen before leads.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum PlacePrior {
    /// Anywhere in some area, looking anywhere.
    Uniform(UniformPrior),
    /// As far and as straight as corridors are.
    Corridor(Corridor),
    /// As far as the corridors that were travelled so far: [`Corridor::typical_of`], estimated anew with every travel.
    Typical,
}

/// A prior on corridors: their length is log-normal; they lead where the gateways at both ends point, with some
/// deviation, except for a share that leads anywhere.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Corridor {
    /// The median of the distance between neighboring places: m.
    pub length: f64,
    /// The standard deviation of its logarithm.
    pub spread: f64,
    /// The standard deviation of the way's direction from the gateway's bearing, at either end: rad.
    pub deviation: f64,
    /// How many corridors lead anywhere, whatever their gateways say.
    pub crooked: f64,
}

/// The least spread of lengths that [`Corridor::typical_of`] believes in.
const LEAST_SPREAD: f64 = 0.3;

impl Corridor {
    /// Corridors as long as those of an exploration: the median of the distances travelled, and their
    /// spread. `None` if no distance was measured.
    ///
    /// Each corridor counts as often as it was travelled. That is the same for all maps.
    #[must_use]
    pub fn typical_of(exploration: &Exploration) -> Option<Self> {
        Corridor::typical(exploration.travels().iter().filter_map(|travel| travel.odometry.as_ref()))
    }

    /// The same of any measured travels.
    pub(crate) fn typical<'a>(odometry: impl Iterator<Item = &'a Odometry>) -> Option<Self> {
        let mut logs: Vec<f64> = odometry.map(|measured| distance(measured).ln()).collect();
        logs.sort_by(f64::total_cmp);
        let median = *logs.get(logs.len() / 2)?;
        let variance = logs.iter().map(|log| (log - median).powi(2)).sum::<f64>() / logs.len() as f64;
        let spread = variance.sqrt().max(LEAST_SPREAD);
        Some(Corridor { length: median.exp(), spread, deviation: 0.3, crooked: 0.1 })
    }

    /// The log-density of (x, y, θ) for a corridor that leaves by a gateway with the bearing `exit` and
    /// arrives by one with the bearing `entry`; each in the frame of its place, where measured.
    pub(crate) fn log_density(self, measured: &Odometry, exit: Option<f64>, entry: Option<f64>) -> f64 {
        let distance = distance(measured);
        let way = measured.y.atan2(measured.x);
        let way_back = wrap_angle(way + std::f64::consts::PI - measured.theta); // in the arrival frame
        let along = (distance / self.length).ln() / self.spread;
        let length = -0.5 * along * along - (distance * self.spread).ln() - 0.5 * TAU.ln();
        // dx dy = distance · d(distance) d(way)
        length - distance.ln() + self.direction(way, exit) + self.direction(way_back, entry)
    }

    /// What it costs that a corridor is so long, against the usual length: nats, never negative.
    pub(crate) fn price_of_length(self, way: Pose) -> f64 {
        let along = (way.x.hypot(way.y) / self.length).max(f64::MIN_POSITIVE).ln() / self.spread;
        0.5 * along * along
    }

    /// What it costs that a way leads off a gateway's bearing by so much, against one that does not: nats, never negative.
    pub(crate) fn price_of_turn(self, way: f64, bearing: f64) -> f64 {
        (self.direction(bearing, Some(bearing)) - self.direction(way, Some(bearing))).max(0.0)
    }

    /// The log-density of a direction, given the gateway's bearing.
    fn direction(self, way: f64, bearing: Option<f64>) -> f64 {
        let Some(bearing) = bearing else { return -TAU.ln() };
        let off = wrap_angle(way - bearing) / self.deviation;
        let straight = (-0.5 * off * off).exp() / (TAU.sqrt() * self.deviation);
        ((1.0 - self.crooked) * straight + self.crooked / TAU).ln()
    }
}

/// How far a travel led, m: no less than its own standard deviation, below which nothing is known.
fn distance(measured: &Odometry) -> f64 {
    let [[x, ..], [_, y, _], _] = measured.covariance;
    measured.x.hypot(measured.y).max(((x + y) / 2.0).sqrt())
}

/// How probable a map is before anything is measured.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum MapPrior {
    /// All maps alike.
    Flat,
    /// (4.17): in inverse proportion to F.
    Simplicity(Simplicity),
    /// Wherever the exploration says nothing, each consistent extension of the map is as probable as any
    /// other. The probabilities of all maps add up to one at most.
    Choices,
}

/// A model that defines no probability.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum ModelError {
    /// The weights of F.
    #[error(transparent)]
    Simplicity(#[from] SimplicityError),
    /// The prior on corridors.
    #[error(
        "the prior on corridors is {0:?}: length, spread and deviation must be positive, crooked between 0 and 1"
    )]
    Corridor(Corridor),
}

impl PosteriorModel {
    /// The thesis's posterior (4.18): −χ²/2 − ln F with F = 2·f2' + f3.
    pub const THESIS: PosteriorModel = PosteriorModel {
        metrical: Metrical::Likelihood,
        prior: MapPrior::Simplicity(Simplicity { c1: 0.0, c2: 2.0, c3: 1.0 }),
    };

    /// The evidence with corridors typical of the exploration, all maps being as probable beforehand. `None`
    /// if no distance was measured.
    #[must_use]
    pub fn evidence(exploration: &Exploration) -> Option<Self> {
        let corridor = Corridor::typical_of(exploration)?;
        let metrical = Metrical::Evidence(PlacePrior::Corridor(corridor));
        Some(PosteriorModel { metrical, prior: MapPrior::Flat })
    }

    /// The same on the way, where the exploration's end is not known: corridors as long as those travelled so far.
    pub const ONLINE: PosteriorModel =
        PosteriorModel { metrical: Metrical::Evidence(PlacePrior::Typical), prior: MapPrior::Flat };

    /// Checks that all weights and widths make sense.
    ///
    /// # Errors
    /// With the first that does not.
    pub fn check(self) -> Result<(), ModelError> {
        if let MapPrior::Simplicity(weights) = self.prior {
            weights.check()?;
        }
        if let Metrical::Evidence(PlacePrior::Corridor(corridor)) = self.metrical {
            let Corridor { length, spread, deviation, crooked } = corridor;
            let positive = [length, spread, deviation].iter().all(|&n| n.is_finite() && n > 0.0);
            if !positive || !(0.0..=1.0).contains(&crooked) || crooked == 0.0 {
                return Err(ModelError::Corridor(corridor));
            }
        }
        Ok(())
    }
}
