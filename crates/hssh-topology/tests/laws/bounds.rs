//! No map grown from another measures less than the other's bound.

use hssh_topology::{MapOlp, Measure, TopologicalMap};
use proptest::prelude::*;

use crate::random::{Change, Growing, growth};

/// Lets a map grow, without retracting, and compares all earlier bounds with all later measures.
fn bounds_hold(
    (stars, changes): (Vec<hssh_topology::Star>, Vec<Change>),
    allowed: impl Fn(&TopologicalMap, MapOlp, MapOlp) -> bool,
) {
    let mut growing = Growing::new(&stars);
    let mut ancestors: Vec<TopologicalMap> = Vec::new();
    for change in changes.iter().filter(|change| !matches!(change, Change::Retract)) {
        growing.make_if(change, &allowed);
        ancestors.push(growing.map.clone());
        let measure = Measure::of(&growing.map);
        for ancestor in &ancestors {
            let travels = growing.map.link_count() - ancestor.link_count();
            let bound = Measure::bound(ancestor, travels);
            let (Measure { f1, f2, f3, genus }, least) = (measure, bound);
            assert!(
                f1 >= least.f1 && f2 >= least.f2 && f3 >= least.f3 && genus >= least.genus,
                "{measure} is below {bound}"
            );
            assert!(ancestor.permanently_undetermined_boundary_count() <= measure.f1);
        }
    }
    let now = Measure::bound(&growing.map, 0);
    assert_eq!((now.f3, now.genus), (Measure::of(&growing.map).f3, Measure::of(&growing.map).genus));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1200))]

    /// Axioms 1 and 2: two paths that meet are never joined, nor the ends of one path.
    #[test]
    fn bounds_hold_with_simple_paths(growth in growth(60)) {
        bounds_hold(growth, |map, a, b| {
            map.path(a) != map.path(b) && !map.paths_meet(map.path(a), map.path(b))
        });
    }

    #[test]
    fn bounds_hold_whatever_is_linked(growth in growth(60)) {
        bounds_hold(growth, |_, _, _| true);
    }
}
