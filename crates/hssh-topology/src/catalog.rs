//! The stars that occur in an exploration, and which of them match under which rotation.

use std::collections::BTreeMap;

use crate::ids::{Olp, StarId};
use crate::star::{Passability, Star};

/// All stars met so far, sorted into classes of isomorphic ones: a match is one look-up.
#[derive(Clone, Debug, Default)]
pub struct StarCatalog {
    entries: Vec<Entry>,
    numbers: BTreeMap<Star, StarId>,
    classes: BTreeMap<Signature, u32>,
    /// For each class: whether turning its signature by 0, 1, … positions keeps it.
    automorphisms: Vec<Vec<bool>>,
}

#[derive(Clone, Debug)]
struct Entry {
    star: Star,
    class: u32,
    /// The oriented local path at which the signature of the class begins.
    start: Olp,
}

/// What isomorphisms look at, clockwise: the attribute of each end, and how far it is to the opposite
/// end. Of all the ends to begin at, the one that gives the least sequence.
type Signature = Vec<(Passability, Option<String>, u32)>;

/// How a star looks from one of its ends, all around: two ends, of any stars of one catalog, have the same look if and only if they
/// [match](StarCatalog::matches).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Look {
    class: u32,
    /// From where the signature begins, up to an automorphism.
    position: u32,
}

impl StarCatalog {
    /// A catalog without stars.
    #[must_use]
    pub fn new() -> Self {
        StarCatalog::default()
    }

    /// Adds a star under a new number, whether or not the catalog has it already.
    pub fn add(&mut self, star: &Star) -> StarId {
        let (signature, start) = signature(star);
        let automorphisms = (0..signature.len()).map(|turn| {
            let turned = signature.iter().cycle().skip(turn).take(signature.len());
            turned.eq(signature.iter())
        });
        let next_class = self.automorphisms.len() as u32;
        if !self.classes.contains_key(&signature) {
            self.automorphisms.push(automorphisms.collect());
        }
        let class = *self.classes.entry(signature).or_insert(next_class);
        let id = StarId::new(self.entries.len() as u32);
        self.entries.push(Entry { star: star.clone(), class, start });
        self.numbers.entry(star.clone()).or_insert(id);
        id
    }

    /// The number of a star, which is added if it is new.
    pub fn intern(&mut self, star: &Star) -> StarId {
        self.numbers.get(star).copied().unwrap_or_else(|| self.add(star))
    }

    /// A star by its number.
    ///
    /// # Panics
    /// If the number is not from this catalog.
    #[must_use]
    pub fn star(&self, id: StarId) -> &Star {
        &self.entries[id.index()].star
    }

    /// All stars, in the order of their numbers.
    pub fn stars(&self) -> impl ExactSizeIterator<Item = &Star> {
        self.entries.iter().map(|entry| &entry.star)
    }

    /// Whether two stars look the same when observed from `olp` and from `image`: whether there is
    /// an isomorphism that takes the one to the other (Definition 2.2).
    #[must_use]
    pub fn matches(&self, from: StarId, olp: Olp, to: StarId, image: Olp) -> bool {
        let (from, to) = (&self.entries[from.index()], &self.entries[to.index()]);
        let automorphisms = &self.automorphisms[from.class as usize];
        let degree = automorphisms.len() as u32;
        let from_start = |olp: Olp, start: Olp| Olp::new(start.turn_to(olp, degree));
        from.class == to.class
            && automorphisms
                [from_start(olp, from.start).turn_to(from_start(image, to.start), degree) as usize]
    }

    /// How a star looks from one of its ends.
    #[must_use]
    pub fn look(&self, star: StarId, olp: Olp) -> Look {
        let Entry { class, start, .. } = self.entries[star.index()];
        let automorphisms = &self.automorphisms[class as usize];
        // The automorphisms are the multiples of the least one.
        let turns = automorphisms.iter().skip(1);
        let period = 1 + turns.take_while(|&&is_kept| !is_kept).count() as u32;
        Look { class, position: start.turn_to(olp, automorphisms.len() as u32) % period }
    }
}

/// The signature of a star, and the end it begins at.
fn signature(star: &Star) -> (Signature, Olp) {
    let degree = star.degree();
    let look = |olp: Olp| {
        let end = &star.ends()[olp.index()];
        (end.passability, end.label.clone(), olp.turn_to(star.opposite(olp), degree))
    };
    let ends: Signature = star.olps().map(look).collect();
    let turned = |start: Olp| ends.iter().cycle().skip(start.index()).take(ends.len());
    let start = star.olps().min_by(|&a, &b| turned(a).cmp(turned(b))).expect("no star is empty");
    (turned(start).cloned().collect(), start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::isomorphism::Isomorphism;

    #[test]
    fn the_table_says_what_isomorphisms_say() {
        let texts = [
            "0+ 1+ 0- 1-",
            "0+ (1+) 0- 1-",
            "(1+) 0- 1- 0+",
            "0+ 0-",
            "0+ 1+ 0- 1-:door",
            "0+ 0- 1+ 1-",
            "0+ 1+ 1- 0-",
            "1+ (1-) 0+ 0-",
        ];
        let stars: Vec<Star> = texts.iter().map(|text| text.parse().unwrap()).collect();
        let mut catalog = StarCatalog::new();
        let ids: Vec<StarId> = stars.iter().map(|star| catalog.intern(star)).collect();
        assert_eq!(
            ids,
            stars.iter().map(|star| catalog.intern(star)).collect::<Vec<_>>(),
            "known stars keep their numbers"
        );
        for (from, &from_id) in stars.iter().zip(&ids) {
            for (to, &to_id) in stars.iter().zip(&ids) {
                for olp in from.olps() {
                    for image in to.olps() {
                        let is_match = Isomorphism::anchored(from, olp, to, image).is_some();
                        assert_eq!(catalog.matches(from_id, olp, to_id, image), is_match);
                        assert_eq!(catalog.look(from_id, olp) == catalog.look(to_id, image), is_match);
                    }
                }
            }
        }
    }
}
