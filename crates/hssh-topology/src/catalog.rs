//! The stars that occur in an exploration, and which of them match under which rotation.

use serde::{Deserialize, Serialize};

use crate::isomorphism::Isomorphism;
use crate::star::{Olp, Star};

/// A star of a [`StarCatalog`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct StarId(pub u32);

impl StarId {
    /// The star as an index.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// All stars met so far, with their isomorphisms tabulated: a match is one look-up.
#[derive(Clone, Debug, Default)]
pub struct StarCatalog {
    stars: Vec<Star>,
    /// For each ordered pair of stars where its rotations begin in `matches`, `None` if the stars
    /// have different degrees.
    starts: Vec<Option<u32>>,
    /// Whether the rotation by 0, 1, … is an isomorphism.
    matches: Vec<bool>,
}

impl StarCatalog {
    /// A catalog without stars.
    #[must_use]
    pub fn new() -> Self {
        StarCatalog::default()
    }

    /// The number of a star, which is added if it is new.
    pub fn intern(&mut self, star: &Star) -> StarId {
        if let Some(known) = self.stars.iter().position(|other| other == star) {
            return StarId(known as u32);
        }
        self.stars.push(star.clone());
        self.tabulate();
        StarId(self.stars.len() as u32 - 1)
    }

    fn tabulate(&mut self) {
        self.starts.clear();
        self.matches.clear();
        for from in &self.stars {
            for to in &self.stars {
                let start = (from.degree() == to.degree()).then_some(self.matches.len() as u32);
                self.starts.push(start);
                if start.is_some() {
                    let is_match = |image| Isomorphism::anchored(from, Olp(0), to, image).is_some();
                    self.matches.extend(to.olps().map(is_match));
                }
            }
        }
    }

    /// A star by its number.
    ///
    /// # Panics
    /// If the number is not from this catalog.
    #[must_use]
    pub fn star(&self, id: StarId) -> &Star {
        &self.stars[id.index()]
    }

    /// All stars, in the order of their numbers.
    #[must_use]
    pub fn stars(&self) -> &[Star] {
        &self.stars
    }

    /// Whether two stars look the same when observed from `olp` and from `image`: whether there is
    /// an isomorphism that takes the one to the other (Definition 2.2).
    #[must_use]
    pub fn matches(&self, from: StarId, olp: Olp, to: StarId, image: Olp) -> bool {
        let Some(start) = self.starts[from.index() * self.stars.len() + to.index()] else { return false };
        let degree = self.star(from).degree();
        let rotation = if image.0 >= olp.0 { image.0 - olp.0 } else { image.0 + degree - olp.0 };
        self.matches[(start + rotation) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_says_what_isomorphisms_say() {
        let texts = ["0+ 1+ 0- 1-", "0+ (1+) 0- 1-", "(1+) 0- 1- 0+", "0+ 0-", "0+ 1+ 0- 1-:door"];
        let stars: Vec<Star> = texts.iter().map(|text| text.parse().unwrap()).collect();
        let mut catalog = StarCatalog::new();
        let ids: Vec<StarId> = stars.iter().map(|star| catalog.intern(star)).collect();
        assert_eq!(ids, stars.iter().map(|star| catalog.intern(star)).collect::<Vec<_>>());
        for (from, &from_id) in stars.iter().zip(&ids) {
            for (to, &to_id) in stars.iter().zip(&ids) {
                for olp in from.olps() {
                    for image in to.olps() {
                        assert_eq!(
                            catalog.matches(from_id, olp, to_id, image),
                            Isomorphism::anchored(from, olp, to, image).is_some()
                        );
                    }
                }
            }
        }
    }
}
