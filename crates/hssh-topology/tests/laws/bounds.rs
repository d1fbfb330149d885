//! No map grown from another measures less than the other's bound.

use hssh_topology::{Measure, PendingGateway, TopologicalMap};
use proptest::prelude::*;

use crate::random::{Change, Growing, growth};

/// Lets a map grow, without retracting, and compares all earlier bounds with all later measures.
fn bounds_hold(
    (stars, changes): (Vec<hssh_topology::Star>, Vec<Change>),
    allowed: impl Fn(&TopologicalMap, PendingGateway, PendingGateway) -> bool,
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
            let Measure { undetermined_boundaries, paths, places, genus } = measure;
            let holds = undetermined_boundaries >= bound.undetermined_boundaries
                && paths >= bound.paths
                && places >= bound.places
                && genus >= bound.genus;
            assert!(holds, "{measure} is below {bound}");
            assert!(ancestor.permanently_undetermined_boundary_count() <= undetermined_boundaries);
        }
    }
    let now = Measure::bound(&growing.map, 0);
    assert_eq!((now.places, now.genus), (Measure::of(&growing.map).places, Measure::of(&growing.map).genus));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1200))]

    /// Axioms 1 and 2: two paths that meet are never joined, nor the ends of one path.
    #[test]
    fn bounds_hold_with_simple_paths(growth in growth(60)) {
        bounds_hold(growth, |map, a, b| {
            let (path, other) = (map.path(a.olp()), map.path(b.olp()));
            path != other && !map.paths_meet(path, other)
        });
    }

    #[test]
    fn bounds_hold_whatever_is_linked(growth in growth(60)) {
        bounds_hold(growth, |_, _, _| true);
    }
}
