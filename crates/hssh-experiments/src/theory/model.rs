//! Models of the theory: maps whose states, places and paths are named by the moments at which they were first met.

use std::collections::{BTreeMap, BTreeSet};

/// A moment of an exploration, by its number (theory/individuals.lp).
pub(super) type Moment = u32;

/// One side of a path, looking downstream.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) enum Side {
    Right,
    Left,
}

/// A map without arbitrary names, so that isomorphic maps are equal.
///
/// The moments are those of one exploration, and what a map says is which of them are the same distinctive state and which
/// of its stays are at the same place: an isomorphism leaves every moment where it is. All else follows from that,
/// and is compared nevertheless.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub(super) struct Model {
    /// For every moment the first moment in the same distinctive state.
    pub(super) states: BTreeMap<Moment, Moment>,
    /// For the first moment of every stay that of the first stay at the same place.
    pub(super) places: BTreeMap<Moment, Moment>,
    /// Going straight on from the one state, one comes to the other.
    pub(super) onward: BTreeSet<(Moment, Moment)>,
    /// Paths, each named by the first of its states, with the states that look downstream.
    pub(super) downstream: BTreeSet<(Moment, Moment)>,
    /// ⟨path, side, place⟩ for every boundary relation.
    pub(super) sides: BTreeSet<(Moment, Side, Moment)>,
}

impl Model {
    /// The model that consists of these atoms.
    ///
    /// # Errors
    /// An atom that theory/models.lp does not show.
    pub(super) fn of_atoms<'a>(atoms: impl IntoIterator<Item = &'a str>) -> Result<Self, String> {
        let mut model = Model::default();
        for atom in atoms {
            model.add(atom).ok_or_else(|| format!("clingo printed the atom `{atom}`, which no model has"))?;
        }
        Ok(model)
    }

    fn add(&mut self, atom: &str) -> Option<()> {
        let (predicate, arguments) = atom.strip_suffix(')')?.split_once('(')?;
        let arguments: Vec<&str> = arguments.split(',').collect();
        let moment = |argument: &str| argument.parse::<Moment>().ok();
        match (predicate, arguments[..].as_ref()) {
            ("is", [one, other]) => drop(self.states.insert(moment(one)?, moment(other)?)),
            ("at", [one, other]) => drop(self.places.insert(moment(one)?, moment(other)?)),
            ("onward", [one, other]) => drop(self.onward.insert((moment(one)?, moment(other)?))),
            ("downstream", [one, other]) => drop(self.downstream.insert((moment(one)?, moment(other)?))),
            ("side", [path, "right", place]) => {
                self.sides.insert((moment(path)?, Side::Right, moment(place)?));
            }
            ("side", [path, "left", place]) => {
                self.sides.insert((moment(path)?, Side::Left, moment(place)?));
            }
            _ => return None,
        }
        Some(())
    }
}

/// For each of some things the number of the first that is the same.
pub(super) fn firsts<T: PartialEq>(things: &[T]) -> Vec<Moment> {
    let first = |thing: &T| things.iter().position(|other| other == thing).expect("it is one of them");
    things.iter().map(|thing| first(thing) as Moment).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn models_are_read_from_atoms() {
        let atoms = ["is(4,0)", "at(4,0)", "onward(0,6)", "downstream(0,6)", "side(1,left,8)"];
        let model = Model::of_atoms(atoms).unwrap();
        assert_eq!((model.states[&4], model.places[&4]), (0, 0));
        assert!(model.onward.contains(&(0, 6)) && model.downstream.contains(&(0, 6)));
        assert!(model.sides.contains(&(1, Side::Left, 8)));
        for atom in ["is(4)", "is(4,x)", "is", "has(4,0)", "side(1,above,8)", "is(4,0"] {
            assert!(Model::of_atoms([atom]).unwrap_err().contains(atom));
        }
    }

    #[test]
    fn things_are_named_by_the_first() {
        assert_eq!(firsts(&["a", "b", "a", "c", "b"]), [0, 1, 0, 3, 1]);
    }
}
