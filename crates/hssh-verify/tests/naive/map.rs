//! Hypotheses as plain lists, copied at every step.

use std::collections::{BTreeMap, BTreeSet};

use hssh_causal::Exploration;
use hssh_topology::{Axioms, Star};

/// A place and the position of one of its ends.
pub(crate) type End = (usize, usize);

/// ⟨map, place, φ⟩ with everything looked up anew.
#[derive(Clone)]
pub(crate) struct Hypothesis {
    /// Star and first visit of each place.
    pub(crate) places: Vec<(Star, usize)>,
    pub(crate) links: BTreeMap<End, End>,
    pub(crate) place: usize,
    pub(crate) rotation: usize,
    pub(crate) explained: usize,
    /// Whether the last step was one of several possible growths, and whether it found a new place.
    pub(crate) grown: bool,
    pub(crate) is_new: bool,
}

/// A path: its places with the end that leads onwards, and whether it is circular.
pub(crate) struct Path {
    pub(crate) passages: Vec<End>,
    pub(crate) circular: bool,
}

pub(crate) fn matches(seen: &Star, kept: &Star, rotation: usize) -> bool {
    let n = seen.ends().len();
    let opposite = |star: &Star, end: usize| {
        let name = star.ends()[end].name.opposite();
        star.ends().iter().position(|other| other.name == name).unwrap()
    };
    n == kept.ends().len()
        && (0..n).all(|end| {
            let (a, b) = (&seen.ends()[end], &kept.ends()[(end + rotation) % n]);
            a.passability == b.passability
                && a.label == b.label
                && (opposite(seen, end) + rotation) % n == opposite(kept, (end + rotation) % n)
        })
}

pub(crate) fn visit_star(exploration: &Exploration, visit: usize) -> &Star {
    exploration.star(exploration.visits().nth(visit).unwrap())
}

impl Hypothesis {
    pub(crate) fn root(exploration: &Exploration) -> Self {
        let places = vec![(visit_star(exploration, 0).clone(), 0)];
        Hypothesis {
            places,
            links: BTreeMap::new(),
            place: 0,
            rotation: 0,
            explained: 0,
            grown: false,
            is_new: false,
        }
    }

    pub(crate) fn ends(&self) -> Vec<End> {
        let of = |place: usize| (0..self.places[place].0.ends().len()).map(move |end| (place, end));
        (0..self.places.len()).flat_map(of).collect()
    }

    fn is_open(&self, (place, end): End) -> bool {
        let star = &self.places[place].0;
        star.gateways().any(|gateway| gateway.index() == end)
    }

    pub(crate) fn pending(&self) -> Vec<End> {
        self.ends().into_iter().filter(|end| self.is_open(*end) && !self.links.contains_key(end)).collect()
    }

    pub(crate) fn closed_ends(&self) -> usize {
        self.ends().into_iter().filter(|end| !self.is_open(*end)).count()
    }

    fn opposite(&self, (place, end): End) -> End {
        let ends = self.places[place].0.ends();
        (place, ends.iter().position(|other| other.name == ends[end].name.opposite()).unwrap())
    }

    pub(crate) fn successors(&self, exploration: &Exploration, axioms: &Axioms) -> Vec<Hypothesis> {
        let travel = &exploration.travels()[self.explained];
        let star = visit_star(exploration, self.explained + 1);
        let degree = self.places[self.place].0.ends().len();
        let exit = (self.place, (travel.exit.index() + self.rotation) % degree);
        let arrive = |(place, end): End| {
            let kept = &self.places[place].0;
            let n = kept.ends().len();
            let rotation = (end + n * star.ends().len() - travel.entry.index()) % n;
            matches(star, kept, rotation).then(|| Hypothesis {
                place,
                rotation,
                explained: self.explained + 1,
                grown: false,
                is_new: false,
                ..self.clone()
            })
        };
        if let Some(&far) = self.links.get(&exit) {
            return arrive(far).into_iter().collect();
        }
        let mut new = self.clone();
        new.places.push((star.clone(), self.explained + 1));
        (new.place, new.rotation, new.explained) = (self.places.len(), 0, self.explained + 1);
        new.is_new = true;
        let mut grown = vec![(new.clone(), (new.place, travel.entry.index()))];
        for gateway in self.pending().into_iter().filter(|gateway| *gateway != exit) {
            grown.extend(arrive(gateway).map(|child| (child, gateway)));
        }
        for (child, gateway) in &mut grown {
            child.grown = true;
            child.links.insert(exit, *gateway);
            child.links.insert(*gateway, exit);
        }
        grown.into_iter().map(|(child, _)| child).filter(|child| child.satisfies(axioms)).collect()
    }

    fn satisfies(&self, axioms: &Axioms) -> bool {
        let paths = self.paths();
        let on = |path: &Path| path.passages.iter().map(|end| end.0).collect::<BTreeSet<_>>();
        let meets_twice = |path: &Path| on(path).len() < path.passages.len();
        let crossings = |a: &Path, b: &Path| on(a).intersection(&on(b)).copied().collect::<Vec<_>>();
        let perpendicular = || {
            let n = paths.len();
            (0..n).all(|a| {
                (a + 1..n).all(|b| {
                    let first = crossings(&paths[a], &paths[b]);
                    first.len() < 2
                        && (b + 1..n).all(|c| {
                            let (second, third) =
                                (crossings(&paths[b], &paths[c]), crossings(&paths[a], &paths[c]));
                            first.is_empty() || second.is_empty() || third.is_empty() || first == second
                        })
                })
            })
        };
        let consistent = || {
            paths.iter().all(|path| {
                let [right, left] = self.sides(path);
                right.is_disjoint(&left) && on(path).is_disjoint(&right) && on(path).is_disjoint(&left)
            })
        };
        (!axioms.no_circular_path || paths.iter().all(|path| !path.circular))
            && (!axioms.no_self_intersection || !paths.iter().any(meets_twice))
            && axioms.max_places.is_none_or(|most| self.places.len() <= most as usize)
            && axioms.max_genus.is_none_or(|most| self.genus() <= most as usize)
            && (!axioms.perpendicular || perpendicular())
            && (!axioms.consistent_boundaries || consistent())
    }

    pub(crate) fn paths(&self) -> Vec<Path> {
        let mut done = BTreeSet::new();
        let mut paths = Vec::new();
        let (last, linked): (Vec<End>, Vec<End>) =
            self.ends().into_iter().partition(|end| !self.links.contains_key(end));
        for start in last.into_iter().chain(linked) {
            if done.contains(&start) {
                continue;
            }
            let mut path = Path { passages: Vec::new(), circular: false };
            let mut back = Some(start);
            while let Some(end) = back {
                let forward = self.opposite(end);
                done.extend([end, forward]);
                path.passages.push(forward);
                back = self.links.get(&forward).copied();
                if back == Some(start) {
                    path.circular = true;
                    break;
                }
            }
            paths.push(path);
        }
        paths
    }

    /// The places that one comes to going straight on from an end.
    fn beyond(&self, end: End) -> BTreeSet<usize> {
        let mut places = BTreeSet::new();
        let mut next = self.links.get(&end).copied();
        while let Some(entry) = next {
            places.insert(entry.0);
            let forward = self.opposite(entry);
            next = self.links.get(&forward).copied().filter(|_| forward != end);
        }
        places
    }

    /// The places right and left of a path.
    pub(crate) fn sides(&self, path: &Path) -> [BTreeSet<usize>; 2] {
        let mut sides = [BTreeSet::new(), BTreeSet::new()];
        for &forward in &path.passages {
            let back = self.opposite(forward);
            let n = self.places[forward.0].0.ends().len();
            let clockwise = |end: usize| (end + n - forward.1) % n;
            for end in (0..n).filter(|end| *end != forward.1 && *end != back.1) {
                let side = usize::from(clockwise(end) > clockwise(back.1));
                sides[side].extend(self.beyond((forward.0, end)));
            }
        }
        sides
    }

    pub(crate) fn f1(&self) -> usize {
        let undetermined = |path: &Path| {
            let [right, left] = self.sides(path);
            let off = |place: &usize| path.passages.iter().all(|end| end.0 != *place);
            let same = |place: &usize| right.contains(place) == left.contains(place);
            (0..self.places.len()).filter(off).filter(same).count()
        };
        self.paths().iter().map(undetermined).sum()
    }

    /// From V − E + F, with the pending gateways leading to dead ends of their own.
    pub(crate) fn genus(&self) -> usize {
        let pending = self.pending();
        let open: Vec<End> = self.ends().into_iter().filter(|end| self.is_open(*end)).collect();
        // A dart leads away along an open end, or back from the dead end beyond a pending one.
        let mut darts: BTreeSet<(End, bool)> = open.iter().map(|end| (*end, true)).collect();
        darts.extend(pending.iter().map(|end| (*end, false)));
        let next = |(end, away): (End, bool)| {
            let arrived = match self.links.get(&end) {
                Some(far) => *far,
                None if away => return (end, false),
                None => end,
            };
            let n = self.places[arrived.0].0.ends().len();
            let mut around = (1..=n).map(|k| (arrived.0, (arrived.1 + k) % n));
            (around.find(|end| self.is_open(*end)).unwrap(), true)
        };
        let mut faces = 0;
        while let Some(start) = darts.pop_first() {
            faces += 1;
            let mut dart = next(start);
            while dart != start {
                darts.remove(&dart);
                dart = next(dart);
            }
        }
        let vertices = self.places.len() + pending.len();
        let edges = self.links.len() / 2 + pending.len();
        (2 + edges - vertices - faces) / 2
    }
}
