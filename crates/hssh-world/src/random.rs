//! Random worlds that are planar by construction: parts of Delaunay triangulations.

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spade::{DelaunayTriangulation, Point2, Triangulation};

use crate::geometry::Point;
use crate::streets::{Crossing, Street, StreetNetwork};
use crate::world::{World, WorldError};

/// A connected planar world of `places` places at random, with straight links.
///
/// Points are drawn uniformly from a square of `places · spacing²` m² and triangulated (Delaunay).
/// A random spanning tree of the triangulation is kept, and of its other edges the fraction
/// `density`: 0 gives a tree, 1 the whole triangulation. Stars follow the rule of
/// [`StreetNetwork::to_world`]. The same arguments give the same world.
///
/// # Errors
/// If there are fewer than two places, the density is not in \[0, 1\] or the spacing is not
/// positive.
pub fn random_planar(places: u32, density: f64, spacing: f64, seed: u64) -> Result<World, WorldError> {
    if places < 2 {
        return Err(WorldError::TooSmall { needed: 2, given: places as usize });
    }
    if !(0.0..=1.0).contains(&density) {
        return Err(WorldError::Parameter {
            parameter: "the density",
            value: density,
            range: "between 0 and 1",
        });
    }
    if !(spacing > 0.0 && spacing.is_finite()) {
        return Err(WorldError::Parameter { parameter: "the spacing", value: spacing, range: "positive" });
    }
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let side = f64::from(places).sqrt() * spacing;
    let mut triangulation = DelaunayTriangulation::<Point2<f64>>::new();
    while triangulation.num_vertices() < places as usize {
        let point = Point2::new(random.random_range(0.0..side), random.random_range(0.0..side));
        triangulation.insert(point).expect("coordinates in [0, side) are in spade's range");
    }
    let crossings = triangulation.vertices().enumerate().map(|(index, vertex)| {
        let Point2 { x, y } = vertex.position();
        Crossing { name: index.to_string(), position: Point::new(x, y) }
    });
    let mut edges: Vec<[usize; 2]> = triangulation
        .undirected_edges()
        .map(|edge| {
            let mut ends = edge.vertices().map(|vertex| vertex.index());
            ends.sort_unstable();
            ends
        })
        .collect();
    edges.sort_unstable();
    edges.shuffle(&mut random);
    let streets = thin_out(places as usize, &edges, density);
    StreetNetwork {
        crossings: crossings.collect(),
        streets: streets.into_iter().map(|ends| Street { ends, bends: Vec::new() }).collect(),
    }
    .to_world()
}

/// The edges that join two components when they come up, and `density` of the others.
pub(crate) fn thin_out(places: usize, edges: &[[usize; 2]], density: f64) -> Vec<[usize; 2]> {
    let mut component: Vec<usize> = (0..places).collect();
    let (mut kept, mut others) = (Vec::new(), Vec::new());
    for &[from, to] in edges {
        let (old, new) = (component[from], component[to]);
        if old == new {
            others.push([from, to]);
        } else {
            component.iter_mut().filter(|part| **part == old).for_each(|part| *part = new);
            kept.push([from, to]);
        }
    }
    others.truncate((density * others.len() as f64).round() as usize);
    kept.extend(others);
    kept.sort_unstable();
    kept
}
