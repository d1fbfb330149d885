//! Random worlds and explorations for property tests, each decided by one number.
//!
//! With proptest: `any::<u64>().prop_map(strategies::random_exploration)`; a seed that fails is
//! reported and reproduces the case.

use hssh_causal::Exploration;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::drift::DriftModel;
use crate::grid::grid;
use crate::random::random_planar;
use crate::route::Route;
use crate::walk::random_walk;
use crate::world::World;

/// A small planar world: a grid of 2 to 4 rows and columns, or 2 to 10 random places, in equal parts.
#[must_use]
pub fn random_world(seed: u64) -> World {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    if random.random() {
        return grid(random.random_range(2..=4), random.random_range(2..=4), 8.0)
            .expect("a grid with rows and columns is a world");
    }
    let (places, density) = (random.random_range(2..=10), random.random_range(0.0..1.0));
    random_planar(places, density, 8.0, random.random()).expect("two places or more make a world")
}

/// A small planar world in which no path is circular or meets a place twice.
#[must_use]
pub fn random_simple_world(seed: u64) -> World {
    (0..)
        .map(|attempt| random_world(seed.wrapping_add(attempt)))
        .find(World::has_simple_paths)
        .expect("every second world is a grid, and grids have simple paths")
}

/// A walk of 1 to 14 travels in a [`random_simple_world`].
#[must_use]
pub fn random_route(seed: u64) -> (World, Route) {
    let world = random_simple_world(seed);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let route = random_walk(&world, random.random_range(1..=14), random.random());
    (world, route)
}

/// What a robot sees on a [`random_route`], without odometry.
#[must_use]
pub fn random_exploration(seed: u64) -> Exploration {
    let (world, route) = random_route(seed);
    world.explore(&route).expect("a walk in a world can be followed")
}

/// What a robot sees and measures on a [`random_route`].
#[must_use]
pub fn random_exploration_with_odometry(seed: u64) -> Exploration {
    let (world, route) = random_route(seed);
    world
        .explore_with_odometry(&route, &DriftModel::default(), seed)
        .expect("a walk in a world can be followed, and the default drift model is one")
}
