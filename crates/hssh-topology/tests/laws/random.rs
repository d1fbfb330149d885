//! Random stars, and maps that grow at random and respect no axiom.

use hssh_topology::{
    OlpName, Passability, PendingGateway, Sign, Star, StarCatalog, StarEnd, StarId, TopologicalMap,
};
use proptest::prelude::*;
use proptest::sample::Index;

/// An attribute: mostly travelable, seldom labeled.
fn attribute() -> impl Strategy<Value = (Passability, Option<String>)> {
    let passability = prop_oneof![3 => Just(Passability::Travelable), 1 => Just(Passability::Closed)];
    let label = prop_oneof![8 => Just(None), 1 => Just(Some("door".to_owned()))];
    (passability, label)
}

/// A star of `local_paths` local paths, half of the time one whose ends all look alike.
fn star_of(local_paths: std::ops::RangeInclusive<u32>) -> impl Strategy<Value = Star> {
    local_paths.prop_flat_map(|local_paths| {
        let name = |sign| move |local_path| OlpName { local_path, sign };
        let crossing: Vec<OlpName> =
            (0..local_paths).map(name(Sign::Plus)).chain((0..local_paths).map(name(Sign::Minus))).collect();
        let order = prop_oneof![Just(crossing.clone()).prop_shuffle(), Just(crossing)];
        let ends = 2 * local_paths as usize;
        let alike = attribute().prop_map(move |attribute| vec![attribute; ends]);
        let different = prop::collection::vec(attribute(), ends);
        (order, prop_oneof![different, alike]).prop_map(|(order, attributes)| {
            let end = |(name, (passability, label)): (OlpName, (Passability, Option<String>))| StarEnd {
                name,
                passability,
                label,
            };
            Star::new(order.into_iter().zip(attributes).map(end)).expect("all ends are paired")
        })
    })
}

/// A star of 1 to 5 local paths.
pub(crate) fn star() -> impl Strategy<Value = Star> {
    star_of(1..=5)
}

/// Two stars: any two, or one and itself enumerated from another end with other names.
pub(crate) fn two_stars() -> impl Strategy<Value = (Star, Star)> {
    let turned = (star(), any::<Index>()).prop_map(|(star, turn)| {
        let mut ends = star.ends().to_vec();
        let degree = ends.len();
        ends.rotate_left(turn.index(degree));
        for end in &mut ends {
            end.name = OlpName { local_path: 7 - end.name.local_path, ..end.name.opposite() };
        }
        (star, Star::new(ends).expect("renaming and turning keep pairs"))
    });
    prop_oneof![2 => turned, 1 => (star(), star())]
}

/// How a map changes.
#[derive(Clone, Debug)]
pub(crate) enum Change {
    Place(Index),
    Link(Index, Index),
    Retract,
}

/// A few stars of 1 to 3 local paths, and changes to make.
pub(crate) fn growth(changes: usize) -> impl Strategy<Value = (Vec<Star>, Vec<Change>)> {
    let change = prop_oneof![
        4 => any::<Index>().prop_map(Change::Place),
        6 => any::<(Index, Index)>().prop_map(|(a, b)| Change::Link(a, b)),
        1 => Just(Change::Retract),
    ];
    (prop::collection::vec(star_of(1..=3), 1..4), prop::collection::vec(change, 1..changes))
}

/// A map with what is needed to let it grow.
pub(crate) struct Growing {
    pub(crate) catalog: StarCatalog,
    pub(crate) map: TopologicalMap,
    /// The same map, which does not carry its boundary relations along.
    pub(crate) lean: TopologicalMap,
    stars: Vec<StarId>,
    /// What the map was before each change that was not taken back.
    before: Vec<String>,
}

impl Growing {
    pub(crate) fn new(stars: &[Star]) -> Self {
        let mut catalog = StarCatalog::new();
        let stars = stars.iter().map(|star| catalog.intern(star)).collect();
        let (map, lean) = (TopologicalMap::new(), TopologicalMap::without_boundaries());
        Growing { catalog, map, lean, stars, before: Vec::new() }
    }

    /// Two different pending gateways, if there are any.
    fn pair(&self, a: &Index, b: &Index) -> Option<(PendingGateway, PendingGateway)> {
        let mut pending: Vec<PendingGateway> = self.map.pending_gateways().collect();
        if pending.len() < 2 {
            return None;
        }
        let a = pending.swap_remove(a.index(pending.len()));
        Some((a, pending[b.index(pending.len())]))
    }

    /// Makes a change. Retracting checks that the map becomes what it was.
    pub(crate) fn make(&mut self, change: &Change) {
        self.make_if(change, |_, _, _| true);
    }

    /// Makes a change, a link only if `allowed`.
    pub(crate) fn make_if(
        &mut self,
        change: &Change,
        allowed: impl Fn(&TopologicalMap, PendingGateway, PendingGateway) -> bool,
    ) {
        match change {
            Change::Place(star) => {
                self.before.push(self.describe());
                let star = *star.get(&self.stars);
                for map in [&mut self.map, &mut self.lean] {
                    map.add_place(star, self.catalog.star(star));
                }
            }
            Change::Link(a, b) => {
                if let Some((a, b)) = self.pair(a, b).filter(|&(a, b)| allowed(&self.map, a, b)) {
                    self.before.push(self.describe());
                    self.map.link(a, b);
                    self.lean.link(a, b);
                }
            }
            Change::Retract => self.retract(),
        }
        self.map.sanity_check().unwrap();
    }

    /// Takes back the last change; whether there was one.
    fn retract(&mut self) {
        self.map.retract();
        self.lean.retract();
        if let Some(before) = self.before.pop() {
            self.map.sanity_check().unwrap();
            self.lean.sanity_check().unwrap();
            assert_eq!(self.describe(), before);
        }
    }

    /// Everything that is in the maps.
    fn describe(&self) -> String {
        format!("{:?} {:?}", self.map, self.lean)
    }

    /// Takes everything back.
    pub(crate) fn retract_all(&mut self) {
        while !self.before.is_empty() {
            self.retract();
        }
    }
}
