//! How long the searches take on the snake through the 4×4 grid, with the whole tree of section 3.4.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hssh_causal::Exploration;
use hssh_search::{Goal, Mapper, Order};
use hssh_world::{grid, snake};

/// Nodes of the complete tree without a bound on places.
const NODES: u64 = 3_599_821;

fn snake_through_4x4() -> Exploration {
    let world = grid(4, 4, 8.0).expect("4 × 4 places 8 m apart are a grid");
    let route = world.route_through(&snake(4, 4)).expect("the snake goes along corridors");
    world.explore(&route).expect("the route leads through this world")
}

/// The benchmarks.
fn searches(criterion: &mut Criterion) {
    let exploration = snake_through_4x4();
    let mut group = criterion.benchmark_group("4x4");
    group.sample_size(10);

    group.throughput(Throughput::Elements(NODES));
    for threads in [1, 2] {
        group.bench_function(format!("exhaustive, threads {threads}"), |bencher| {
            bencher.iter(|| {
                let builder = Mapper::builder().threads(threads);
                let report = builder.count(&exploration).expect("the system gives threads");
                assert_eq!(report.nodes, NODES);
            });
        });
        group.bench_function(format!("breadth-first, threads {threads}"), |bencher| {
            bencher.iter(|| {
                let builder = Mapper::builder().threads(threads);
                let mapper = builder.explain(&exploration).expect("the system gives threads");
                assert_eq!(mapper.tree().len() as u64, NODES);
            });
        });
    }
    group.throughput(Throughput::Elements(1));
    group.bench_function("with proof", |bencher| {
        bencher.iter(|| {
            let builder = Mapper::builder().order(Order::Proof).goal(Goal::AnyMap);
            builder.explain(&exploration).expect("the system gives threads").maps(2)
        });
    });
    group.finish();
}

criterion_group!(benches, searches);
criterion_main!(benches);
