//! The table of Figure 3.3.

use hssh_causal::Exploration;
use hssh_search::Mapper;
use hssh_topology::Axioms;
use hssh_world::{snake, thesis_3x4};

use crate::cases::{grid_walk, planar};

/// Nodes, maps, final maps, the table's closed ones, closed, closed and perpendicular, optimal.
fn column(exploration: &Exploration, axioms: Axioms) -> [u64; 7] {
    let report = Mapper::builder().axioms(axioms).threads(2).count(exploration).unwrap();
    let finals = report.finals;
    let (all, nearly, closed) = (finals.final_maps, finals.nearly_closed, finals.closed);
    [report.nodes, report.maps, all, nearly, closed, finals.perpendicular, finals.optimal]
}

#[test]
fn figure_3_3() {
    let small = grid_walk(3, 3, &snake(3, 3));
    assert_eq!(column(&small, Axioms::default()), [317, 188, 88, 6, 4, 2, 2]);
    assert_eq!(column(&small, planar()), [240, 147, 62, 3, 3, 1, 1]);
    let oblong = grid_walk(3, 4, &thesis_3x4());
    assert_eq!(column(&oblong, Axioms::default()), [4239, 3400, 1465, 16, 16, 8, 8]);
    assert_eq!(column(&oblong, planar()), [1722, 1425, 507, 3, 3, 1, 1]);
    let large = grid_walk(4, 4, &snake(4, 4));
    let to_sixteen = |axioms| Axioms { max_places: Some(16), ..axioms };
    assert_eq!(column(&large, to_sixteen(Axioms::default())), [192_569, 93_034, 23_685, 6992, 2000, 256, 2]);
    assert_eq!(column(&large, to_sixteen(planar())), [8452, 4951, 545, 58, 6, 1, 2]);
}

/// The axiom that the thesis does not name: without it the 4×4 count is another one.
#[test]
fn without_the_axiom_on_circular_paths() {
    let axioms = Axioms { no_circular_path: false, max_places: Some(16), ..Axioms::default() };
    assert_eq!(column(&grid_walk(4, 4, &snake(4, 4)), axioms)[0], 205_191);
}
