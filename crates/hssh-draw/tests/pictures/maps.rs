//! Laws of drawn maps, and two short pictures as text.

use std::f64::consts::TAU;

use hssh_draw::{Bearings, BuildingPicture, Drawing, MapOptions, RegionPicture, draw_map, map_to_dot};
use hssh_metrics::Pose;
use hssh_topology::{PlaceId, StarCatalog, TopologicalMap};

use crate::common::{Grid, link, random_planar};

/// The value of an attribute in a line of SVG.
fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    line.split_once(&format!(" {name}=\""))?.1.split('"').next()
}

fn number(line: &str, name: &str) -> f64 {
    attribute(line, name).unwrap_or_else(|| panic!("no {name} in {line}")).parse().unwrap()
}

/// A place as drawn: its middle, and where each of its ends begins.
type DrawnPlace = ((f64, f64), Vec<(f64, f64)>);

/// The places, from the text of a picture alone.
fn drawn_ends(svg: &str) -> Vec<DrawnPlace> {
    let mut places: Vec<DrawnPlace> = Vec::new();
    let mut lines = svg.lines();
    while let Some(line) = lines.next() {
        if line.contains("class=\"place\"") {
            let circle = lines.next().unwrap();
            places.push(((number(circle, "cx"), number(circle, "cy")), Vec::new()));
        } else if line.contains("class=\"end\"") {
            let (_, ends) = places.last_mut().unwrap();
            assert_eq!(number(line, "data-end") as usize, ends.len());
            let mark = lines.next().unwrap();
            let names = if mark.contains("<line") { ["x1", "y1"] } else { ["cx", "cy"] };
            ends.push((number(mark, names[0]), number(mark, names[1])));
        }
    }
    places
}

fn schematic(map: &TopologicalMap, options: &MapOptions) -> String {
    draw_map(map, &Drawing::schematic(map, &Bearings::none()).unwrap(), options)
}

#[test]
fn the_drawn_ends_go_around_each_place_as_the_star_does() {
    for seed in 0..20 {
        let (map, _) = random_planar(12, 6, seed);
        let svg = schematic(&map, &MapOptions::default());
        let places = drawn_ends(&svg);
        assert_eq!(places.len() as u32, map.place_count());
        for (place, ((x, y), ends)) in map.places().zip(&places) {
            assert_eq!(ends.len(), map.olps_of(place).len());
            // y points down: angles grow clockwise, and once around they grow by a full turn.
            let angles: Vec<f64> = ends.iter().map(|(ex, ey)| (ey - y).atan2(ex - x)).collect();
            let gaps = (0..angles.len())
                .map(|end| (angles[(end + 1) % angles.len()] - angles[end]).rem_euclid(TAU))
                .collect::<Vec<_>>();
            assert!(gaps.iter().all(|&gap| gap > 0.1), "seed {seed}, {place:?}: {gaps:?}");
            assert!((gaps.iter().sum::<f64>() - TAU).abs() < 1e-6, "seed {seed}, {place:?}: {gaps:?}");
        }
    }
}

#[test]
fn links_leave_their_places_in_the_direction_of_the_end() {
    for seed in 0..20 {
        let (map, _) = random_planar(12, 6, seed);
        let svg = schematic(&map, &MapOptions::default());
        let places = drawn_ends(&svg);
        let curves = curves(&svg);
        assert_eq!(curves.len(), map.links().count());
        for ((from, to), curve) in map.links().zip(curves) {
            let n = curve.len();
            let halves = [
                (from, [curve[0], curve[1], curve[2], curve[3]]),
                (to, [curve[n - 2], curve[n - 1], curve[n - 4], curve[n - 3]]),
            ];
            for (olp, [x, y, handle_x, handle_y]) in halves {
                let ((middle_x, middle_y), ends) = &places[map.place(olp).index()];
                let end = ends[map.local(olp).index()];
                assert!((x - end.0).hypot(y - end.1) < 0.02);
                let (out_x, out_y) = (end.0 - middle_x, end.1 - middle_y);
                let (dx, dy) = (handle_x - x, handle_y - y);
                let cosine = (out_x * dx + out_y * dy) / (out_x.hypot(out_y) * dx.hypot(dy));
                assert!(cosine > 0.999, "seed {seed}: {olp:?} leaves at an angle of {}", cosine.acos());
            }
        }
    }
}

/// The numbers of the curves of links, in the order of the links.
fn curves(svg: &str) -> Vec<Vec<f64>> {
    let links = svg.lines().filter(|line| line.contains("<path") && !line.contains("#ffffff"));
    let numbers = |line: &str| {
        let numbers = attribute(line, "d").unwrap().split([' ', ',']);
        numbers.filter_map(|text| text.parse().ok()).collect()
    };
    links.map(numbers).collect()
}

#[test]
fn a_link_passes_the_points_of_its_line_on_the_way_between_its_ends() {
    let map = Grid { rows: 1, columns: 2 }.map(&mut StarCatalog::new());
    let poses = vec![Pose::new(0.0, 0.0, 0.0), Pose::new(10.0, 0.0, 0.0)];
    let line = [[0.0, 0.0], [0.1, 0.2], [3.0, 4.0], [7.0, -4.0], [10.0, 0.0]];
    let (from, to) = map.links().next().unwrap();
    let straight = Drawing::measured(&map, poses, &Bearings::none()).unwrap();
    let [plain, forth, back] = [
        straight.clone(),
        straight.clone().with_ways([([from, to], line.to_vec())]),
        straight.with_ways([([to, from], line.into_iter().rev().collect())]),
    ]
    .map(|drawing| draw_map(&map, &drawing, &MapOptions::default()));
    assert_eq!(forth, back);
    let (plain, driven) = (curves(&plain).remove(0), curves(&forth).remove(0));
    let at = |numbers: &[f64], from_end: bool| {
        let start = if from_end { numbers.len() - 2 } else { 0 };
        [numbers[start], numbers[start + 1]]
    };
    assert_eq!(at(&plain, false), at(&driven, false));
    assert_eq!(at(&plain, true), at(&driven, true));
    // Two points are within the first place's circle; the two others are passed, at 92 pixels for 10 m, y down.
    assert_eq!(driven.len(), 2 + 3 * 6);
    let passed = [[driven[6], driven[7]], [driven[12], driven[13]]];
    assert_eq!(passed, [[27.6, -36.8], [64.4, 36.8]]);
}

#[test]
fn names_of_regions_lie_in_them() {
    let map = Grid { rows: 1, columns: 2 }.map(&mut StarCatalog::new());
    let poses = vec![Pose::new(0.0, 0.0, 0.0), Pose::new(10.0, 0.0, 0.0)];
    let drawing = Drawing::measured(&map, poses, &Bearings::none()).unwrap();
    // A corridor around the corner: the middle of its box is not in it.
    let corner = [[0.0, 0.0], [40.0, 0.0], [40.0, 4.0], [4.0, 4.0], [4.0, 40.0], [0.0, 40.0]];
    let region =
        RegionPicture { rings: vec![corner.to_vec()], name: "corner".to_owned(), ..RegionPicture::default() };
    let building = BuildingPicture { regions: vec![region], doors: Vec::new() };
    let svg = draw_map(&map, &drawing, &MapOptions { building: Some(building), ..MapOptions::default() });
    let ring = svg.lines().find(|line| line.contains("Z\"")).and_then(|line| attribute(line, "d")).unwrap();
    let corners: Vec<f64> = ring.split(['M', 'L', 'Z', ' ']).filter_map(|text| text.parse().ok()).collect();
    let name = svg.lines().find(|line| line.contains(">corner<")).unwrap();
    // In metres: the first corner is the origin and the second one 40 m to the right.
    let scale = 40.0 / (corners[2] - corners[0]);
    let [x, y] = [(number(name, "x") - corners[0]) * scale, (corners[1] - number(name, "y")) * scale];
    assert!((0.0..4.0).contains(&x) || (0.0..4.0).contains(&y), "{x} {y}");
    assert!((0.0..40.0).contains(&x) && (-0.5..40.0).contains(&y), "{x} {y}");
}

#[test]
fn equal_maps_give_equal_pictures() {
    let draw = || {
        let (map, catalog) = random_planar(30, 12, 7);
        let options = MapOptions { current: Some(PlaceId::new(3)), ..MapOptions::default() };
        (schematic(&map, &options), map_to_dot(&map, &catalog, &options))
    };
    assert_eq!(draw(), draw());
}

#[test]
fn the_unit_of_length_does_not_matter() {
    let grid = Grid { rows: 3, columns: 3 };
    let map = grid.map(&mut StarCatalog::new());
    // The same grid as measured: 8 m from crossing to crossing, the first row northernmost.
    let metres = |place: PlaceId| {
        Pose::new(f64::from(place.number() % 3) * 8.0, -f64::from(place.number() / 3) * 8.0, 0.0)
    };
    let poses = map.places().map(metres).collect();
    let measured = Drawing::measured(&map, poses, &Bearings::none()).unwrap();
    let options = MapOptions::default();
    assert_eq!(draw_map(&map, &measured, &options), schematic(&map, &options));
}

#[test]
fn maps_that_fit_no_plane_are_drawn_too() {
    // A torus of one place, and two places linked back to back: circular paths.
    let star = "0+ 1+ 0- 1-".parse().unwrap();
    let id = StarCatalog::new().intern(&star);
    let mut torus = TopologicalMap::new();
    let place = torus.add_place(id, &star);
    link(&mut torus, (place, 0), (place, 2));
    link(&mut torus, (place, 1), (place, 3));
    let mut ring = TopologicalMap::new();
    let places = [0; 2].map(|_| ring.add_place(id, &star));
    link(&mut ring, (places[0], 1), (places[1], 3));
    link(&mut ring, (places[0], 3), (places[1], 1));
    for map in [torus, ring, TopologicalMap::new()] {
        let svg = schematic(&map, &MapOptions::default());
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}

#[test]
fn two_places_as_svg() {
    let map = Grid { rows: 1, columns: 2 }.map(&mut StarCatalog::new());
    let options = MapOptions {
        title: Some("A & B".to_owned()),
        current: Some(PlaceId::new(1)),
        star_names: vec!["west".to_owned()],
        ..MapOptions::default()
    };
    insta::assert_snapshot!(schematic(&map, &options));
}

#[test]
fn a_partial_map_as_dot() {
    let mut catalog = StarCatalog::new();
    let tee = "0+ 1+ 0- (1-)".parse().unwrap();
    let id = catalog.intern(&tee);
    let mut map = TopologicalMap::new();
    let places = [0; 2].map(|_| map.add_place(id, &tee));
    link(&mut map, (places[0], 0), (places[1], 2));
    let options = MapOptions { current: Some(PlaceId::new(1)), ..MapOptions::default() };
    insta::assert_snapshot!(map_to_dot(&map, &catalog, &options));
}
