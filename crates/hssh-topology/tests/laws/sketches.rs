//! Sketches: their axioms against the naive mapper's, their text, and what is no map.

use hssh_oracle::{Axiom as NaiveAxiom, Rules};
use hssh_topology::{
    Axiom, Axioms, Contradiction, End, Malformed, MapSketch, Observation, Olp, PlaceId, Star, StarId, replay,
    violations,
};
use proptest::prelude::*;

use crate::random::{Change, Growing, growth};
use crate::recount::{naive, stars_of};

const NONE: Axioms = Axioms {
    no_self_intersection: false,
    no_circular_path: false,
    max_places: None,
    max_genus: None,
    perpendicular: false,
    consistent_boundaries: false,
};

const NO_RULES: Rules = Rules {
    no_self_intersection: false,
    no_circular_path: false,
    places_bound: None,
    genus_bound: None,
    perpendicular: false,
    sides: false,
};

/// Each axiom by itself.
fn single_axioms() -> [(Axioms, Rules); 8] {
    [
        (Axioms { no_self_intersection: true, ..NONE }, Rules { no_self_intersection: true, ..NO_RULES }),
        (Axioms { no_circular_path: true, ..NONE }, Rules { no_circular_path: true, ..NO_RULES }),
        (Axioms { max_places: Some(2), ..NONE }, Rules { places_bound: Some(2), ..NO_RULES }),
        (Axioms { max_places: Some(5), ..NONE }, Rules { places_bound: Some(5), ..NO_RULES }),
        (Axioms { max_genus: Some(0), ..NONE }, Rules { genus_bound: Some(0), ..NO_RULES }),
        (Axioms { max_genus: Some(1), ..NONE }, Rules { genus_bound: Some(1), ..NO_RULES }),
        (Axioms { perpendicular: true, ..NONE }, Rules { perpendicular: true, ..NO_RULES }),
        (Axioms { consistent_boundaries: true, ..NONE }, Rules { sides: true, ..NO_RULES }),
    ]
}

fn same(axiom: Axiom) -> NaiveAxiom {
    match axiom {
        Axiom::NoSelfIntersection => NaiveAxiom::SelfIntersection,
        Axiom::NoCircularPath => NaiveAxiom::CircularPath,
        Axiom::MaxPlaces => NaiveAxiom::Places,
        Axiom::MaxGenus => NaiveAxiom::Genus,
        Axiom::Perpendicular => NaiveAxiom::Perpendicular,
        Axiom::ConsistentBoundaries => NaiveAxiom::Sides,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn violations_are_those_of_the_naive_mapper(
        ((stars, changes), place) in (growth(30), any::<prop::sample::Index>())
    ) {
        let mut growing = Growing::new(&stars);
        changes.iter().for_each(|change| growing.make(change));
        growing.make(&Change::Place(place));
        let sketch = MapSketch::of(&growing.map, &growing.catalog);
        let stars = stars_of(&growing.catalog);
        let naive = naive(&growing.map, &stars);
        for (axioms, rules) in single_axioms() {
            let found = violations(&sketch, &axioms).unwrap();
            let first = found.first().map(|violation| same(violation.axiom()));
            prop_assert_eq!(first, rules.first_violation(&naive), "{:?}", found);
        }
    }

    #[test]
    fn sketches_are_read_as_they_were_written((stars, changes) in growth(30)) {
        let mut growing = Growing::new(&stars);
        changes.iter().for_each(|change| growing.make(change));
        let sketch = MapSketch::of(&growing.map, &growing.catalog);
        let text = serde_json::to_string(&sketch).unwrap();
        prop_assert_eq!(serde_json::from_str::<MapSketch>(&text).unwrap(), sketch);
    }
}

fn end(place: u32, olp: u32) -> End {
    End { place: PlaceId::new(place), olp: Olp::new(olp) }
}

fn sketch(stars: &[&str], links: &[(End, End)]) -> MapSketch {
    MapSketch { places: stars.iter().map(|star| star.parse().unwrap()).collect(), links: links.to_vec() }
}

#[test]
fn labels_of_any_kind_survive_the_text() {
    let mut star: Star = "0+ (0-)".parse::<Star>().unwrap();
    for label in ["big door", "(x)", "a:b", "", ")"] {
        let ends = star.ends().iter().cloned().map(|mut end| {
            end.label = Some(label.to_owned());
            end
        });
        star = Star::new(ends).unwrap();
        let sketch = MapSketch { places: vec![star.clone()], links: Vec::new() };
        let text = serde_json::to_string(&sketch).unwrap();
        assert_eq!(serde_json::from_str::<MapSketch>(&text).unwrap(), sketch);
    }
}

#[test]
fn text_that_is_no_sketch_is_refused() {
    let error = |text: &str| serde_json::from_str::<MapSketch>(text).unwrap_err().to_string();
    assert!(
        error(r#"{"places":[["0+","0-"],["0+"]],"links":[]}"#).starts_with("place 1: `0+` has no opposite")
    );
    assert!(error(r#"{"places":[],"links":[],"paths":[]}"#).starts_with("unknown field `paths`"));
}

#[test]
fn what_is_no_map_is_refused() {
    let road = ["0+ 0-", "0+ (0-)"];
    let refusals = [
        (sketch(&[], &[]), Malformed::NoPlaces),
        (sketch(&road, &[(end(0, 0), end(0, 0))]), Malformed::ToItself { link: 0, end: end(0, 0) }),
        (sketch(&road, &[(end(0, 0), end(2, 0))]), Malformed::NoSuchEnd { link: 0, end: end(2, 0) }),
        (sketch(&road, &[(end(0, 2), end(1, 0))]), Malformed::NoSuchEnd { link: 0, end: end(0, 2) }),
        (sketch(&road, &[(end(0, 0), end(1, 1))]), Malformed::ClosedEnd { link: 0, end: end(1, 1) }),
        (
            sketch(&road, &[(end(0, 0), end(1, 0)), (end(1, 0), end(0, 1))]),
            Malformed::LinkedTwice { link: 1, end: end(1, 0) },
        ),
    ];
    for (sketch, refusal) in refusals {
        assert_eq!(violations(&sketch, &Axioms::default()), Err(refusal.clone()));
        let stars = ["0+ 0-".parse().unwrap()];
        assert_eq!(replay(&sketch, &stars, StarId::new(0), &[]), Err(Contradiction::Malformed(refusal)));
    }
}

#[test]
fn contradictions_say_where_and_what() {
    let stars: Vec<Star> = ["0+ 1+ 0- 1-", "0+ (1+) 0- 1-"].map(|star| star.parse().unwrap()).to_vec();
    let go = |exit, entry, star| Observation {
        exit: Olp::new(exit),
        entry: Olp::new(entry),
        star: StarId::new(star),
    };
    let refusal = |places: &[&str], links: &[(End, End)], start, observations: &[Observation]| {
        replay(&sketch(places, links), &stars, StarId::new(start), observations).unwrap_err().to_string()
    };
    let (plus, tee) = ("0+ 1+ 0- 1-", "0+ (1+) 0- 1-");
    let link = (end(0, 0), end(1, 2));
    assert_eq!(refusal(&[plus], &[], 7, &[]), "travel 0: star 7 does not exist");
    assert_eq!(refusal(&[plus, tee], &[link], 0, &[go(0, 2, 2)]), "travel 1: star 2 does not exist");
    assert_eq!(
        refusal(&[plus, tee], &[link], 0, &[go(0, 1, 1)]),
        "travel 1: the observed star [<0+,T>, <1+,C>, <0-,T>, <1-,T>] has no gateway number 1"
    );
    assert_eq!(
        refusal(&[tee], &[], 0, &[]),
        "the first star is [<0+,T>, <1+,T>, <0-,T>, <1-,T>], but place 0 has [<0+,T>, <1+,C>, <0-,T>, <1-,T>]"
    );
    assert_eq!(
        refusal(&[plus, tee], &[link], 0, &[go(1, 2, 1)]),
        "travel 1 leaves place 0 by `1+`, which the map does not link"
    );
    // The tee is the same, but it was entered by another end.
    assert_eq!(
        refusal(&[plus, tee], &[link], 0, &[go(0, 0, 1)]),
        "travel 1 reaches place 1 by `0-`; seen from there its star [<0+,T>, <1+,C>, <0-,T>, <1-,T>] is not \
         the observed [<0+,T>, <1+,C>, <0-,T>, <1-,T>] entered by `0+`"
    );
    assert_eq!(refusal(&[plus, tee, tee], &[link], 0, &[go(0, 2, 1)]), "place 2 is never visited");
    assert_eq!(
        refusal(&[plus, tee], &[link, (end(0, 1), end(1, 3))], 0, &[go(0, 2, 1)]),
        "the link from end 1 of place 0 to end 3 of place 1 is never used"
    );
}

/// Four corners walked around once and a little on: new places, then the loop, then known links.
#[test]
fn a_square_told() {
    use hssh_topology::Discovery::{KnownLink, LoopClosure, NewPlace};
    let corner = "0+ 1+ (0-) (1-)";
    let stars: Vec<Star> = vec![corner.parse().unwrap()];
    let go = Observation { exit: Olp::new(0), entry: Olp::new(1), star: StarId::new(0) };
    let links: Vec<(End, End)> = (0..4).map(|place| (end(place, 0), end((place + 1) % 4, 1))).collect();
    let told = replay(&sketch(&[corner; 4], &links), &stars, StarId::new(0), &[go; 5]).unwrap();
    let discoveries: Vec<_> = told.travels.iter().map(|travel| travel.discovery).collect();
    assert_eq!(discoveries, [NewPlace, NewPlace, NewPlace, LoopClosure, KnownLink]);
    assert!(told.travels.iter().all(|travel| travel.rotation == 0));
    assert_eq!(told.travels[3].to, PlaceId::new(0));
    // The same walk is no lap around a square in which one place stands the other way round.
    let turned = sketch(&[corner, corner, "(0+) 1+ 0- (1-)", corner], &links);
    assert!(replay(&turned, &stars, StarId::new(0), &[go; 5]).is_err());
}

/// Two crossings joined twice over: paths share two places; three roads, a triangle.
#[test]
fn oblique_paths_are_named() {
    let perpendicular = Axioms { perpendicular: true, ..NONE };
    let plus = "0+ 1+ 0- 1-";
    let twice = sketch(&[plus; 2], &[(end(0, 0), end(1, 2)), (end(0, 1), end(1, 3))]);
    let told = |sketch| {
        violations(sketch, &perpendicular).unwrap().iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(told(&twice), ["paths 0-1 and 0-1 share places 0 and 1"]);
    let triangle =
        sketch(&[plus; 3], &[(end(0, 0), end(1, 2)), (end(1, 1), end(2, 3)), (end(2, 0), end(0, 3))]);
    assert_eq!(told(&triangle), ["paths 0-1, 2-0 and 1-2 form a triangle"]);
}
