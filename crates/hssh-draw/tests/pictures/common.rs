//! Maps and searches to draw, built through the public API of the topological level.

use hssh_search::{Mapper, Visit};
use hssh_topology::{Olp, PendingGateway, PlaceId, Star, StarCatalog, TopologicalMap};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// North, east, south, west: (row, column) steps, clockwise.
const STEPS: [(i32, i32); 4] = [(-1, 0), (0, 1), (1, 0), (0, -1)];

/// A grid of places; walls are closed ends.
#[derive(Clone, Copy)]
pub(crate) struct Grid {
    pub(crate) rows: i32,
    pub(crate) columns: i32,
}

impl Grid {
    fn has(self, (row, column): (i32, i32)) -> bool {
        (0..self.rows).contains(&row) && (0..self.columns).contains(&column)
    }

    /// The star of a crossing, clockwise from north.
    pub(crate) fn star(self, (row, column): (i32, i32)) -> Star {
        let names = ["0+", "1+", "0-", "1-"];
        let end = |(name, (down, right)): (&str, (i32, i32))| match self.has((row + down, column + right)) {
            true => name.to_owned(),
            false => format!("({name})"),
        };
        names.into_iter().zip(STEPS).map(end).collect::<Vec<_>>().join(" ").parse().unwrap()
    }

    /// The true map, places row by row.
    pub(crate) fn map(self, catalog: &mut StarCatalog) -> TopologicalMap {
        let mut map = TopologicalMap::new();
        let mut places = Vec::new();
        for row in 0..self.rows {
            for column in 0..self.columns {
                let star = self.star((row, column));
                let id = catalog.intern(&star);
                places.push(map.add_place(id, &star));
            }
        }
        let at = |row: i32, column: i32| places[(row * self.columns + column) as usize];
        for row in 0..self.rows {
            for column in 0..self.columns {
                for (out, back, (down, right)) in [(1, 3, STEPS[1]), (2, 0, STEPS[2])] {
                    if self.has((row + down, column + right)) {
                        let (from, to) = (at(row, column), at(row + down, column + right));
                        link(&mut map, (from, out), (to, back));
                    }
                }
            }
        }
        map
    }

    /// Rows alternately from the north-west corner, then columns alternately from where the rows ended.
    pub(crate) fn snake(self) -> Vec<(i32, i32)> {
        let mut route = Vec::new();
        for row in 0..self.rows {
            let columns = 0..self.columns;
            let columns: Vec<i32> = if row % 2 == 0 { columns.collect() } else { columns.rev().collect() };
            route.extend(columns.into_iter().map(|column| (row, column)));
        }
        let (_, last_column) = route.pop().unwrap();
        let columns = 0..self.columns;
        let columns: Vec<i32> = if last_column == 0 { columns.collect() } else { columns.rev().collect() };
        for (index, column) in columns.into_iter().enumerate() {
            let rows = 0..self.rows;
            let rows: Vec<i32> = if index % 2 == 1 { rows.collect() } else { rows.rev().collect() };
            route.extend(rows.into_iter().map(|row| (row, column)));
        }
        route
    }

    /// Tells a mapper what a robot sees on a way through neighbouring crossings.
    pub(crate) fn explore(self, route: &[(i32, i32)], mapper: &mut Mapper) {
        for travel in route.windows(2) {
            let step = (travel[1].0 - travel[0].0, travel[1].1 - travel[0].1);
            let exit = STEPS.iter().position(|&other| other == step).unwrap() as u32;
            mapper
                .observe(Visit::new(Olp::new(exit), Olp::new((exit + 2) % 4), &self.star(travel[1])))
                .unwrap();
        }
        mapper.advance();
    }
}

/// Links an end of one place to an end of another.
pub(crate) fn link(map: &mut TopologicalMap, (place, end): (PlaceId, u32), (other, far): (PlaceId, u32)) {
    let pending = |place, end| map.pending(map.olp(place, Olp::new(end))).unwrap();
    map.link(pending(place, end), pending(other, far));
}

/// A random planar map, grown from one place by new places and by closures within a face.
pub(crate) fn random_planar(places: u32, closures: u32, seed: u64) -> (TopologicalMap, StarCatalog) {
    let stars =
        ["0+ 1+ 0- 1-", "0+ 1+ 0- (1-)", "0+ 1+ 2+ 0- 1- 2-", "0+ 0-", "0+ (1+) 0- 1-", "0+ 1+ 1- 0-"];
    let stars = stars.map(|text| text.parse::<Star>().unwrap());
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut catalog = StarCatalog::new();
    let mut map = TopologicalMap::new();
    let id = catalog.intern(&stars[0]);
    map.add_place(id, &stars[0]);
    let mut closed = 0;
    while map.place_count() < places || closed < closures {
        let pending: Vec<PendingGateway> = map.pending_gateways().collect();
        if pending.is_empty() {
            break;
        }
        let exit = pending[rng.random_range(0..pending.len())];
        let partners: Vec<PendingGateway> = pending
            .iter()
            .copied()
            .filter(|&other| {
                let paths = [exit, other].map(|gateway| map.path(gateway.olp()));
                map.share_face(exit, other) && !map.paths_meet(paths[0], paths[1])
            })
            .collect();
        let grows = map.place_count() < places;
        if closed < closures && !partners.is_empty() && (!grows || rng.random_range(0..3) == 0) {
            map.link(exit, partners[rng.random_range(0..partners.len())]);
            closed += 1;
        } else if grows {
            let star = &stars[rng.random_range(0..stars.len())];
            let id = catalog.intern(star);
            let place = map.add_place(id, star);
            let gateways: Vec<Olp> = star.gateways().collect();
            let entry = map.olp(place, gateways[rng.random_range(0..gateways.len())]);
            map.link(exit, map.pending(entry).unwrap());
        } else {
            break;
        }
    }
    (map, catalog)
}
