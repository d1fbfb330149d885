//! Everything that a map carries along, recounted from its places and links by the naive mapper.

use std::collections::{BTreeMap, BTreeSet};

use hssh_causal::{Exploration, NamedStar, StarType};
use hssh_oracle::{End, Facts, Map, Path};
use hssh_topology::{
    BoundaryRelation, Direction, MapOlp, PendingGateway, PlaceId, StarCatalog, TopologicalMap,
};

/// An exploration without travels, for its star types: those of the catalog.
pub(crate) fn stars_of(catalog: &StarCatalog) -> Exploration {
    let named = |(number, star): (usize, &hssh_topology::Star)| NamedStar {
        name: number.to_string(),
        star: star.clone(),
        bearings: vec![None; star.ends().len()],
    };
    let star_types = catalog.stars().enumerate().map(named).collect();
    Exploration::new(star_types, StarType(0), Vec::new()).expect("stars of a catalog are star types")
}

/// The same map as the naive mapper describes it.
pub(crate) fn naive<'a>(map: &TopologicalMap, stars: &'a Exploration) -> Map<'a> {
    Map {
        exploration: stars,
        places: map.places().map(|place| StarType(map.star(place).number())).collect(),
        links: map.links().map(|(a, b)| (end(map, a), end(map, b))).collect(),
    }
}

pub(crate) fn end(map: &TopologicalMap, olp: MapOlp) -> End {
    (map.place(olp).index(), map.local(olp).index())
}

/// Compares everything; `catalog` has the stars of the map.
pub(crate) fn check(map: &TopologicalMap, catalog: &StarCatalog) {
    let stars = stars_of(catalog);
    let naive = naive(map, &stars);
    check_counts(map, &naive);
    check_faces(map, &naive);
    check_paths(map, &naive);
}

fn check_counts(map: &TopologicalMap, naive: &Map<'_>) {
    let facts = Facts::of(naive);
    assert_eq!(map.undetermined_boundary_count(), facts.value.unrelated as u64);
    assert_eq!(map.path_count() as usize, facts.value.paths);
    assert_eq!(map.place_count() as usize, facts.value.places);
    assert_eq!(map.graph().genus() as usize, facts.genus);
    assert_eq!(map.is_closed(), facts.closed);
    assert_eq!(map.is_perpendicular(), facts.perpendicular);

    let pending: Vec<End> = map.pending_gateways().map(|gateway| end(map, gateway.olp())).collect();
    assert_eq!(pending, naive.pending_gateways());
    assert_eq!(map.pending_count() as usize, pending.len());
    assert_eq!(map.link_count() as usize, naive.links.len());
    let closed_ends = naive.ends().len() - 2 * naive.links.len() - pending.len();
    assert_eq!(map.closed_end_count() as usize, closed_ends);
    // "With only one place", be it met twice: the naive mapper counts local paths there.
    let on_long_path = |&end: &End| Path::through(naive, end).places().collect::<BTreeSet<_>>().len() > 1;
    assert_eq!(map.is_nearly_closed(), pending.iter().all(on_long_path));
}

/// A walk around a face, beginning with its least dart.
fn from_least<T: Ord>(mut walk: Vec<T>) -> Vec<T> {
    let least = (0..walk.len()).min_by_key(|&position| &walk[position]).unwrap_or(0);
    walk.rotate_left(least);
    walk
}

fn check_faces(map: &TopologicalMap, naive: &Map<'_>) {
    let (darts, faces) = (naive.linked_ends(), naive.rotation_system().faces());
    // Definition 3.2: a pending edge lies in the face of the first dart counterclockwise from it.
    let face_of = |(place, end): End| {
        let degree = naive.star(place).ends().len();
        let dart = (1..degree)
            .map(|steps| (place, (end + degree - steps) % degree))
            .find_map(|other| darts.iter().position(|&dart| dart == other));
        dart.and_then(|dart| faces.iter().position(|face| face.contains(&dart)))
    };

    let regions = map.regions();
    assert_eq!(map.graph().face_count() as usize, faces.len());
    let walks: BTreeSet<Vec<End>> = regions
        .iter()
        .map(|region| from_least(region.walk.iter().map(|&olp| end(map, olp)).collect()))
        .collect();
    let traced = faces.iter().map(|face| from_least(face.iter().map(|&dart| darts[dart]).collect()));
    assert_eq!(walks, traced.collect::<BTreeSet<_>>());
    assert_eq!(regions.len(), faces.len());
    for region in &regions {
        let first = end(map, region.walk[0]);
        let number = faces.iter().position(|face| face.iter().any(|&dart| darts[dart] == first));
        let pending: Vec<End> = region.pending.iter().map(|&olp| end(map, olp)).collect();
        let expected = naive.pending_gateways().into_iter().filter(|&end| face_of(end) == number);
        assert_eq!(pending, expected.collect::<Vec<_>>());
        let on: BTreeSet<PlaceId> = region.walk.iter().map(|&olp| map.place(olp)).collect();
        assert_eq!(region.places, on.into_iter().collect::<Vec<_>>());
        let along: BTreeSet<_> = region.walk.iter().map(|&olp| map.path(olp)).collect();
        assert_eq!(region.paths, along.into_iter().collect::<Vec<_>>());
    }

    let pending: Vec<PendingGateway> = map.pending_gateways().collect();
    for &a in &pending {
        for &b in &pending {
            let (one, other) = (end(map, a.olp()), end(map, b.olp()));
            // Around an isolated place there is one face of its own.
            let same = match (face_of(one), face_of(other)) {
                (None, None) => one.0 == other.0,
                (one, other) => one == other,
            };
            assert_eq!(map.share_face(a, b), same, "{one:?} and {other:?}");
        }
    }
}

/// A path in the direction, and if circular from the place, that puts its least end first.
fn normal(naive: &Map<'_>, path: &Path) -> (bool, Vec<End>) {
    let along = path.headings.clone();
    let back: Vec<End> = along.iter().rev().map(|&end| naive.opposite(end)).collect();
    let both = [along, back].map(|way| if path.circular { from_least(way) } else { way });
    (path.circular, both.into_iter().min().expect("there are two directions"))
}

fn check_paths(map: &TopologicalMap, naive: &Map<'_>) {
    let courses = map.courses();
    assert_eq!(courses.len(), map.path_count() as usize);
    assert!(courses.iter().map(|course| course.path).eq(map.paths()));
    let mut ours = BTreeMap::new();
    let mut contradictory = 0;
    for course in &courses {
        let headings: Vec<End> = course.downstream.iter().map(|&olp| end(map, olp)).collect();
        let path = Path { headings, circular: course.circular };
        ours.insert(normal(naive, &path), course.path);
        for &olp in &course.downstream {
            assert_eq!((map.path(olp), map.direction(olp)), (course.path, Direction::Downstream));
            let back = map.opposite(olp);
            assert_eq!((map.path(back), map.direction(back)), (course.path, Direction::Upstream));
        }

        let on: BTreeSet<usize> = path.places().collect();
        assert_eq!(map.is_circular(course.path), course.circular);
        assert_eq!(map.places_on_path(course.path) as usize, on.len());
        assert!(map.places_of_path(course.path).map(PlaceId::index).eq(on.iter().copied()));
        let ends = [course.downstream[course.downstream.len() - 1], map.opposite(course.downstream[0])];
        let complete = course.circular || ends.iter().all(|&olp| !map.is_pending(olp));
        assert_eq!(map.is_complete(course.path), complete);

        let (right, left) = (path.right(naive), path.left(naive));
        let sides = map.sides(course.path);
        for place in map.places() {
            let is = |set: &BTreeSet<usize>| set.contains(&place.index());
            let expected = match (is(&on), is(&right), is(&left)) {
                (true, _, _) => BoundaryRelation::On,
                (_, true, true) => BoundaryRelation::Both,
                (_, true, false) => BoundaryRelation::Right,
                (_, false, true) => BoundaryRelation::Left,
                (_, false, false) => BoundaryRelation::Neither,
            };
            assert_eq!(map.boundary_relation(course.path, place), expected, "{path:?} and {place:?}");
            assert_eq!(sides.right.contains(&place), expected == BoundaryRelation::Right);
            assert_eq!(sides.left.contains(&place), expected == BoundaryRelation::Left);
            let beside_own = is(&on) && (is(&right) || is(&left));
            contradictory += u64::from(beside_own || (is(&right) && is(&left)));
        }
        for other in map.paths() {
            let meets = map.places_of_path(other).any(|place| on.contains(&place.index()));
            assert_eq!(map.paths_meet(course.path, other), meets);
        }
    }
    assert_eq!(map.contradictory_boundary_count(), contradictory);
    let traced: BTreeSet<_> = naive.paths().iter().map(|path| normal(naive, path)).collect();
    assert_eq!(ours.into_keys().collect::<BTreeSet<_>>(), traced);
}
