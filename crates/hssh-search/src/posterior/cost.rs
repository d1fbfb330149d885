//! What a hypothesis pays: minus the logarithm of its posterior probability, item by item.

use serde::{Deserialize, Serialize};

/// The cost of a hypothesis in nats, item by item. A map with the cost c has the posterior probability e⁻ᶜ, up
/// to a factor that all maps share. No item ever falls along a branch, except that a price of new places
/// may be negative if odometry is very poor, or corridors are very short.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
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
    /// What perception is taken to have got wrong (docs/readings.md). Counts with readings only.
    pub perception: f64,
}

impl Cost {
    /// The sum.
    #[must_use]
    pub fn total(&self) -> f64 {
        let Cost { bend, vagueness, places, choices, complexity, appearance, perception } = self;
        bend + vagueness + places + choices + complexity + appearance + perception
    }

    /// The same with another χ².
    pub(crate) fn with_chi2(self, chi2: f64) -> Self {
        Cost { bend: 0.5 * chi2, ..self }
    }
}
