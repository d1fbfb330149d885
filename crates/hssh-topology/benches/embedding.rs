//! How long it takes to build an embedded graph, to trace its faces, and to link and unlink edges.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hssh_topology::{Dart, EmbeddedGraph};

/// A grid of `side` × `side` vertices with darts north, east, south and west, pending on the rim.
struct Grid {
    side: u32,
    links: Vec<(Dart, Dart)>,
}

impl Grid {
    fn new(side: u32) -> Self {
        let dart = |row: u32, column: u32, direction: u32| Dart::new(4 * (row * side + column) + direction);
        let cells = || (0..side).flat_map(|row| (0..side).map(move |column| (row, column)));
        let eastward = cells()
            .filter(|&(_, column)| column + 1 < side)
            .map(|(row, column)| (dart(row, column, 1), dart(row, column + 1, 3)));
        let southward = cells()
            .filter(|&(row, _)| row + 1 < side)
            .map(|(row, column)| (dart(row, column, 2), dart(row + 1, column, 0)));
        Grid { side, links: eastward.chain(southward).collect() }
    }

    fn degrees(&self) -> impl Iterator<Item = u32> + use<> {
        std::iter::repeat_n(4, (self.side * self.side) as usize)
    }

    fn build(&self) -> EmbeddedGraph {
        EmbeddedGraph::from_links(self.degrees(), self.links.iter().copied())
            .expect("every dart is used once")
    }

    fn unlinked(&self) -> EmbeddedGraph {
        EmbeddedGraph::from_links(self.degrees(), []).expect("no dart is used twice")
    }
}

/// The benchmarks.
fn embedding(criterion: &mut Criterion) {
    for side in [4, 32, 256] {
        let grid = Grid::new(side);
        let mut group = criterion.benchmark_group(format!("{side}x{side}"));
        group.throughput(Throughput::Elements(grid.links.len() as u64));
        group.bench_function("build", |bencher| bencher.iter(|| black_box(&grid).build()));
        let built = grid.build();
        group.bench_function("faces", |bencher| bencher.iter(|| black_box(&built).faces().len()));
        let mut graph = grid.unlinked();
        group.bench_function("link and unlink", |bencher| {
            bencher.iter(|| {
                let link = |&(a, b): &(Dart, Dart)| {
                    let pending = |dart| graph.pending(dart).expect("every dart is used once");
                    graph.link(pending(a), pending(b))
                };
                let made: Vec<_> = grid.links.iter().map(link).collect();
                black_box(graph.genus());
                made.into_iter().rev().for_each(|link| graph.unlink(link));
            });
        });
        group.finish();
    }
}

criterion_group!(benches, embedding);
criterion_main!(benches);
