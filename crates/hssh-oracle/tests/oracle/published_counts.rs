//! The published counts of Figure 3.3, and the independent ones beside them.

use crate::grid::{exploration, route_3x4, snake};
use hssh_oracle::{Enumeration, Rules, Value, enumerate};

/// One column of the table, from "nodes" down to the number of optimal maps.
fn column(result: &Enumeration) -> [usize; 7] {
    let (_, optimal) = result.optimum().unwrap();
    [
        result.nodes(),
        result.maps(),
        result.final_maps.len(),
        result.nearly_closed(),
        result.closed(),
        result.closed_and_perpendicular(),
        optimal,
    ]
}

fn value(unrelated: usize, paths: usize, places: usize) -> Value {
    Value { unrelated, paths, places }
}

fn nodes_per_level(result: &Enumeration) -> Vec<usize> {
    result.levels.iter().map(|level| level.nodes).collect()
}

#[test]
fn grid_3x3() {
    let exploration = exploration(3, 3, &snake(3, 3));
    assert_eq!(exploration.travels().len(), 16);

    let all = enumerate(&exploration, &Rules::default());
    assert_eq!(column(&all), [317, 188, 88, 6, 4, 2, 2]);
    assert_eq!(all.optimum().unwrap().0, value(0, 6, 9));
    assert_eq!(nodes_per_level(&all), [1, 1, 1, 1, 1, 2, 2, 4, 4, 7, 7, 11, 21, 45, 56, 65, 88]);

    let planar = enumerate(&exploration, &Rules::planar());
    assert_eq!(column(&planar), [240, 147, 62, 3, 3, 1, 1]);
    assert_eq!(planar.optimum().unwrap().0, value(0, 6, 9));
    assert_eq!(nodes_per_level(&planar), [1, 1, 1, 1, 1, 2, 2, 4, 4, 7, 7, 11, 18, 32, 41, 45, 62]);
}

#[test]
fn grid_3x4() {
    let exploration = exploration(3, 4, &route_3x4());
    assert_eq!(exploration.travels().len(), 21);

    let all = enumerate(&exploration, &Rules::default());
    assert_eq!(column(&all), [4_239, 3_400, 1_465, 16, 16, 8, 8]);
    assert_eq!(all.optimum().unwrap().0, value(0, 7, 12));

    let planar = enumerate(&exploration, &Rules::planar());
    assert_eq!(column(&planar), [1_722, 1_425, 507, 3, 3, 1, 1]);
    assert_eq!(planar.optimum().unwrap().0, value(0, 7, 12));
}

#[test]
fn grid_4x4_planar_up_to_16_places() {
    let exploration = exploration(4, 4, &snake(4, 4));
    assert_eq!(exploration.travels().len(), 30);
    let planar = enumerate(&exploration, &Rules { places_bound: Some(16), ..Rules::planar() });
    assert_eq!(column(&planar), [8_452, 4_951, 545, 58, 6, 1, 2]);
    assert_eq!(planar.optimum().unwrap().0, value(0, 6, 12));
}

#[test]
fn grid_4x4_up_to_16_places() {
    let exploration = exploration(4, 4, &snake(4, 4));
    let all = enumerate(&exploration, &Rules { places_bound: Some(16), ..Rules::default() });
    assert_eq!(column(&all), [192_569, 93_034, 23_685, 6_992, 2_000, 256, 2]);
    assert_eq!(all.optimum().unwrap().0, value(0, 6, 12));
}

/// Without the axiom that the thesis does not name, the count is not the published one.
#[test]
fn grid_4x4_with_circular_paths() {
    let exploration = exploration(4, 4, &snake(4, 4));
    let rules = Rules { places_bound: Some(16), no_circular_path: false, ..Rules::default() };
    assert_eq!(enumerate(&exploration, &rules).nodes(), 205_191);
}

/// The search that the thesis could not finish, as far as it is planar.
#[test]
#[ignore = "half a minute"]
fn grid_4x4_planar_without_bound() {
    let planar = enumerate(&exploration(4, 4, &snake(4, 4)), &Rules::planar());
    let counts = [planar.nodes(), planar.maps(), planar.final_maps.len()];
    assert_eq!(counts, [223_865, 164_467, 49_123]);
}

#[test]
#[ignore = "minutes, and gigabytes"]
fn grid_4x4_without_bound() {
    let all = enumerate(&exploration(4, 4, &snake(4, 4)), &Rules::default());
    assert_eq!([all.nodes(), all.maps(), all.final_maps.len()], [3_599_821, 2_419_525, 920_024]);
}
