//! Which axioms hold: every switch on and off.

use hssh_topology::Axioms;

/// Axioms with a name for them.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Switches {
    /// What differs from the published axioms: what is added, and what is left out.
    pub(super) name: String,
    pub(super) axioms: Axioms,
}

const NONE: Axioms = Axioms {
    no_self_intersection: false,
    no_circular_path: false,
    max_places: None,
    max_genus: None,
    perpendicular: false,
    consistent_boundaries: false,
};

/// All combinations that a search can decide, and bounds from too low to harmless.
///
/// `places` is how many places the smallest map has.
pub(super) fn all(places: u32) -> Vec<Switches> {
    let mut all = Vec::new();
    for switches in 0..1_u32 << 5 {
        let on = |switch: u32| switches >> switch & 1 == 0;
        all.push(named(Axioms {
            no_self_intersection: on(0),
            no_circular_path: on(1),
            max_genus: (!on(2)).then_some(0),
            perpendicular: !on(3),
            consistent_boundaries: !on(4),
            max_places: None,
        }));
    }
    all.retain(|one: &Switches| one.axioms.check().is_ok());
    for max_places in [places.saturating_sub(1).max(1), places, places + 1] {
        all.push(named(Axioms { max_places: Some(max_places), ..Axioms::default() }));
    }
    for max_genus in [1, 2] {
        all.push(named(Axioms { max_genus: Some(max_genus), ..Axioms::default() }));
        all.push(named(Axioms { max_genus: Some(max_genus), ..NONE }));
    }
    all
}

/// The published axioms with one switch after the other turned over, none of them, and all.
pub(super) fn each(places: u32) -> Vec<Switches> {
    let published = Axioms::default();
    let strict = Axioms { max_genus: Some(0), perpendicular: true, consistent_boundaries: true, ..published };
    [
        published,
        Axioms { no_self_intersection: false, ..published },
        Axioms { no_circular_path: false, ..published },
        Axioms { max_genus: Some(0), ..published },
        Axioms { max_genus: Some(1), ..published },
        Axioms { perpendicular: true, ..published },
        Axioms { consistent_boundaries: true, ..published },
        Axioms { max_places: Some(places + 1), ..published },
        NONE,
        strict,
    ]
    .map(named)
    .into()
}

fn named(axioms: Axioms) -> Switches {
    let published = Axioms::default();
    let changes = [
        (!axioms.no_self_intersection).then(|| "−1".to_owned()),
        (!axioms.no_circular_path).then(|| "−2".to_owned()),
        axioms.max_genus.map(|most| if most == 0 { "planar".to_owned() } else { format!("genus≤{most}") }),
        axioms.max_places.map(|most| format!("places≤{most}")),
        axioms.perpendicular.then(|| "perpendicular".to_owned()),
        axioms.consistent_boundaries.then(|| "sides".to_owned()),
    ];
    let changes: Vec<String> = changes.into_iter().flatten().collect();
    let name = if axioms == published { "published".to_owned() } else { changes.join(" ") };
    Switches { name, axioms }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn names_tell_switches_apart() {
        for switches in [all(4), each(4)] {
            let names: BTreeSet<&str> = switches.iter().map(|one| one.name.as_str()).collect();
            assert_eq!(names.len(), switches.len());
        }
        assert_eq!(all(4)[0].name, "published");
        assert_eq!(each(4)[8].name, "−1 −2");
        assert_eq!(each(4)[9].name, "planar perpendicular sides");
    }
}
