//! What a hypothesis is, wherever it is made: the sequence of choices that leads to it.

use std::fmt;
use std::str::FromStr;

use hssh_topology::{Axioms, Derivation, DerivationError, Hypothesis, Rules, Step};

use crate::experience::Experience;

/// The choices from the root of a tree down to a hypothesis, one for each travel that it explains.
///
/// Two hypotheses about one experience are the same if and only if their branches are. Branches are ordered as a
/// breadth-first search would make them.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Branch(Vec<Derivation>);

impl Branch {
    /// The choices, the first travel's first.
    #[must_use]
    pub fn choices(&self) -> &[Derivation] {
        &self.0
    }

    /// Makes the hypothesis anew. `None` if some choice is none of those that the experience and the axioms leave
    /// there: the branch belongs to another exploration.
    #[must_use]
    pub fn replay(&self, experience: &Experience, axioms: &Axioms) -> Option<Hypothesis> {
        let mut hypothesis = experience.root();
        let rules = Rules { catalog: &experience.catalog, axioms };
        let mut step = Step::default();
        for (index, &choice) in self.0.iter().enumerate() {
            let observation = *experience.observations.get(index)?;
            hypothesis.step(observation, rules, &mut step);
            if !step.derivations.contains(&choice) {
                return None;
            }
            let _ = hypothesis.follow(observation, choice, rules.catalog);
        }
        Some(hypothesis)
    }
}

impl FromIterator<Derivation> for Branch {
    fn from_iter<T: IntoIterator<Item = Derivation>>(choices: T) -> Self {
        Branch(choices.into_iter().collect())
    }
}

/// The choices, one word each: `n n p c17`.
impl fmt::Display for Branch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, choice) in self.0.iter().enumerate() {
            write!(f, "{}{choice}", if index == 0 { "" } else { " " })?;
        }
        Ok(())
    }
}

impl FromStr for Branch {
    type Err = DerivationError;

    fn from_str(text: &str) -> Result<Self, DerivationError> {
        text.split_whitespace().map(str::parse).collect()
    }
}
