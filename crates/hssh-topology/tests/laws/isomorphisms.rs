//! Isomorphisms are exactly the rotations that keep attributes and opposites, and form a groupoid.

use hssh_topology::{Isomorphism, Olp, Star, StarCatalog};
use proptest::prelude::*;

use crate::random::{star, two_stars};

/// Definition 2.2 for the map i ↦ i + rotation, by name: a local path's ends go to one local path's ends.
fn is_isomorphism(from: &Star, to: &Star, rotation: usize) -> bool {
    let degree = from.ends().len();
    let image = |position: usize| &to.ends()[(position + rotation) % degree];
    degree == to.ends().len()
        && (0..degree).all(|one| {
            let (here, there) = (&from.ends()[one], image(one));
            let same_path = |other: usize| {
                let together = here.name.local_path == from.ends()[other].name.local_path;
                together == (there.name.local_path == image(other).name.local_path)
            };
            here.passability == there.passability && here.label == there.label && (0..degree).all(same_path)
        })
}

fn rotations(from: &Star, to: &Star) -> Vec<usize> {
    (0..from.ends().len()).filter(|&rotation| is_isomorphism(from, to, rotation)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn all_isomorphisms_are_found_and_nothing_else((from, to) in two_stars()) {
        let found: Vec<usize> = Isomorphism::all(&from, &to).map(|phi| phi.rotation() as usize).collect();
        prop_assert_eq!(found, rotations(&from, &to));
    }

    /// One pair of corresponding ends decides an isomorphism.
    #[test]
    fn an_anchor_is_unique((from, to) in two_stars()) {
        for olp in from.olps() {
            for image in to.olps() {
                let through: Vec<Isomorphism> =
                    Isomorphism::all(&from, &to).filter(|phi| phi.apply(olp) == image).collect();
                prop_assert!(through.len() <= 1);
                prop_assert_eq!(Isomorphism::anchored(&from, olp, &to, image), through.first().copied());
            }
        }
    }

    #[test]
    fn isomorphisms_keep_order_attributes_and_local_paths((from, to) in two_stars()) {
        for phi in Isomorphism::all(&from, &to) {
            for olp in from.olps() {
                prop_assert_eq!(phi.apply(from.next(olp)), to.next(phi.apply(olp)));
                prop_assert_eq!(phi.apply(from.opposite(olp)), to.opposite(phi.apply(olp)));
                let (here, there) = (&from.ends()[olp.index()], &to.ends()[phi.apply(olp).index()]);
                prop_assert_eq!((here.passability, &here.label), (there.passability, &there.label));
                for other in from.olps() {
                    let right = to.is_right_of(phi.apply(olp), phi.apply(other));
                    prop_assert_eq!(from.is_right_of(olp, other), right);
                }
            }
        }
    }

    #[test]
    fn identity_and_inverse((from, to) in two_stars()) {
        let identity = Isomorphism::identity(&from);
        prop_assert!(from.olps().all(|olp| identity.apply(olp) == olp));
        prop_assert!(Isomorphism::all(&from, &from).any(|phi| phi == identity));
        let back: Vec<Isomorphism> = Isomorphism::all(&to, &from).collect();
        for phi in Isomorphism::all(&from, &to) {
            prop_assert!(back.contains(&phi.inverse()));
            prop_assert_eq!(phi.inverse().inverse(), phi);
            prop_assert_eq!(phi.inverse().after(phi), identity);
            prop_assert_eq!(phi.after(phi.inverse()), Isomorphism::identity(&to));
            prop_assert_eq!((phi.after(identity), Isomorphism::identity(&to).after(phi)), (phi, phi));
        }
    }

    /// The self-isomorphisms of a star are a group: closed, and composition is associative.
    #[test]
    fn composition(star in star()) {
        let all: Vec<Isomorphism> = Isomorphism::all(&star, &star).collect();
        prop_assert_eq!(star.degree() as usize % all.len(), 0); // Lagrange: a subgroup of the rotations
        for &third in &all {
            for &second in &all {
                let both = third.after(second);
                prop_assert!(all.contains(&both));
                prop_assert!(star.olps().all(|olp| both.apply(olp) == third.apply(second.apply(olp))));
                for &first in &all {
                    prop_assert_eq!(both.after(first), third.after(second.after(first)));
                }
            }
        }
    }

    #[test]
    fn a_catalog_says_what_isomorphisms_say(stars in prop::collection::vec(star(), 1..6)) {
        let mut catalog = StarCatalog::new();
        let ids: Vec<_> = stars.iter().map(|star| catalog.intern(star)).collect();
        for (from, &from_id) in stars.iter().zip(&ids) {
            prop_assert_eq!(catalog.star(from_id), from);
            for (to, &to_id) in stars.iter().zip(&ids) {
                for (olp, image) in from.olps().flat_map(|olp| to.olps().map(move |image| (olp, image))) {
                    let turn = olp.turn_to(image, from.degree());
                    let expected = is_isomorphism(from, to, turn as usize);
                    prop_assert_eq!(catalog.matches(from_id, olp, to_id, image), expected);
                }
            }
        }
    }
}

#[test]
fn stars_of_different_degree_do_not_match() {
    let (road, crossing): (Star, Star) = ("0+ 0-".parse().unwrap(), "0+ 1+ 0- 1-".parse().unwrap());
    assert_eq!(Isomorphism::all(&road, &crossing).count(), 0);
    assert_eq!(Isomorphism::all(&crossing, &road).count(), 0);
    assert_eq!(Isomorphism::anchored(&crossing, Olp::new(3), &road, Olp::new(0)), None);
}
