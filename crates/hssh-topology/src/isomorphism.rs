//! Isomorphisms between stars (Definition 2.2): rotations that keep attributes and opposites.

use serde::{Deserialize, Serialize};

use crate::ids::Olp;
use crate::star::Star;

/// A bijection φ: S → S' that keeps the clockwise order, the attributes and the local paths.
///
/// Keeping the order makes it a rotation, so that one pair of corresponding oriented local paths
/// decides it. Build it with [`Isomorphism::anchored`] or [`Isomorphism::all`]; what exists is
/// an isomorphism between the two stars that it was built for.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct Isomorphism {
    rotation: u32,
    degree: u32,
}

impl Isomorphism {
    /// The identity of a star.
    #[must_use]
    pub fn identity(star: &Star) -> Self {
        Isomorphism { rotation: 0, degree: star.degree() }
    }

    /// The only candidate that takes `olp` of `from` to `image` of `to`, if it is an isomorphism:
    /// if the two stars look the same when observed from these two ends.
    #[must_use]
    pub fn anchored(from: &Star, olp: Olp, to: &Star, image: Olp) -> Option<Self> {
        let degree = from.degree();
        if to.degree() != degree {
            return None;
        }
        let phi = Isomorphism::rotating(olp, image, degree);
        let keeps = |x: Olp| {
            let (end, image) = (&from.ends()[x.index()], &to.ends()[phi.apply(x).index()]);
            (end.passability, &end.label) == (image.passability, &image.label) // (ii)
                && phi.apply(from.opposite(x)) == to.opposite(phi.apply(x)) // (iii)
        };
        from.olps().all(keeps).then_some(phi)
    }

    /// The rotation that takes `olp` to `image`, known from elsewhere to be an isomorphism.
    pub(crate) fn rotating(olp: Olp, image: Olp, degree: u32) -> Self {
        Isomorphism { rotation: olp.turn_to(image, degree), degree }
    }

    /// All isomorphisms from one star to another, by the image of the first oriented local path.
    pub fn all<'a>(from: &'a Star, to: &'a Star) -> impl Iterator<Item = Isomorphism> + 'a {
        to.olps().filter_map(|image| Isomorphism::anchored(from, Olp::new(0), to, image))
    }

    /// φ(olp).
    #[must_use]
    pub fn apply(self, olp: Olp) -> Olp {
        olp.turned(self.rotation, self.degree)
    }

    /// φ⁻¹: S' → S.
    #[must_use]
    pub fn inverse(self) -> Self {
        Isomorphism { rotation: (self.degree - self.rotation) % self.degree, ..self }
    }

    /// `self` after `first`: S → S' → S''.
    ///
    /// # Panics
    /// If the two do not share the star in the middle: if their degrees differ.
    #[must_use]
    pub fn after(self, first: Isomorphism) -> Self {
        assert_eq!(self.degree, first.degree, "isomorphisms of stars of different degree do not compose");
        Isomorphism { rotation: (self.rotation + first.rotation) % self.degree, ..self }
    }

    /// How many positions clockwise φ moves an oriented local path.
    #[must_use]
    pub fn rotation(self) -> u32 {
        self.rotation
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn automorphisms(text: &str) -> usize {
        let star: Star = text.parse().unwrap();
        Isomorphism::all(&star, &star).count()
    }

    #[test]
    fn remark_2_1_counts_self_isomorphisms() {
        assert_eq!(automorphisms("0+ 1+ 0- 1-"), 4);
        assert_eq!(automorphisms("0+ (1+) 0- 1-"), 1);
        assert_eq!(automorphisms("(0+) 1+ 0- (1-)"), 1);
        assert_eq!(automorphisms("0+ 0-"), 2);
        assert_eq!(automorphisms("0+:door 1+ 0- 1-"), 1);
        assert_eq!(automorphisms("0+ 1+ 2+ 0- 1- 2-"), 6);
        assert_eq!(automorphisms("0+ 0- 1+ 1-"), 2);
    }
}
