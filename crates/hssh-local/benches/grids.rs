//! How long distance transform, medial axis, places and one neighborhood take.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use hssh_local::{
    DistanceField, FreeSpace, Lattice, Occupancy, OccupancyGrid, PlaceGraph, PlaceOptions, Skeleton,
    neighborhood,
};

/// Metres from one corridor to the next.
const BLOCK: f64 = 10.0;

/// A city of corridors 2 m wide around blocks of 8 m, in cells of 0.05 m.
fn city(side: u32) -> OccupancyGrid {
    let lattice = Lattice::new(side, side, 0.05, [0.0, 0.0]).expect("a lattice of at most 2048 × 2048 cells");
    let is_free = |point: [f64; 2]| point.iter().any(|coordinate| (coordinate + 1.0).rem_euclid(BLOCK) < 2.0);
    let occupancy = |cell| if is_free(lattice.center(cell)) { Occupancy::Free } else { Occupancy::Occupied };
    OccupancyGrid::new(lattice, lattice.cells().map(occupancy).collect())
        .expect("one cell for each of the lattice")
}

fn stages(criterion: &mut Criterion) {
    let parameters = PlaceOptions::default();
    let grid = city(2048);
    let free = FreeSpace::new(&grid, &parameters.skeleton);
    let mut group = criterion.benchmark_group("4 megapixels");
    group.sample_size(10);
    group.bench_function("distance transform", |bencher| {
        let is_obstacle = |index: usize| grid.cells()[index] == Occupancy::Occupied;
        bencher.iter(|| black_box(DistanceField::new(*grid.lattice(), is_obstacle)));
    });
    group.bench_function("medial axis", |bencher| {
        bencher.iter(|| black_box(Skeleton::new(&grid, &free, &parameters.skeleton)));
    });
    group.bench_function("all places", |bencher| {
        bencher.iter(|| black_box(PlaceGraph::new(&grid, &parameters)));
    });
    group.finish();
    let window = grid.window([10.0, 10.0], 10.0).expect("the window is inside the city");
    criterion.bench_function("a neighborhood of 200 × 200 cells", |bencher| {
        bencher.iter(|| black_box(neighborhood(&window, [10.0, 10.0], &parameters)));
    });
}

criterion_group!(benches, stages);
criterion_main!(benches);
