//! What links cost as networks are walked: faces that split and merge, paths that are joined, and taking it all back.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use hssh_topology::{MapOlp, PendingGateway, PlaceId, Star, StarId, TopologicalMap};
use hssh_world::{Route, World, WorldOlp, cover, grid, random_planar, snake};

use crate::bench::median;
use crate::bench::streets;
use crate::table::{aligned, grouped};

/// The sides of grids, of 10,000 and of 100,000 places, and the places of random networks.
const GRIDS: [u32; 2] = [100, 316];
const RANDOM: [u32; 2] = [1_000, 10_000];
/// Between places: m. Topology does not see it.
const SPACING: f64 = 8.0;

/// One change of the true map as a walk goes on.
enum Change {
    Place(Star),
    Link(MapOlp, MapOlp),
}

/// Means and extremes of lengths.
#[derive(Default)]
struct Lengths {
    sum: u64,
    most: u64,
    number: u64,
}

impl Lengths {
    fn add(&mut self, length: u64) {
        self.sum += length;
        self.most = self.most.max(length);
        self.number += 1;
    }

    fn mean(&self) -> String {
        format!("{:.1}", self.sum as f64 / self.number.max(1) as f64)
    }
}

/// The table of all networks.
pub(crate) fn run(data: Option<&Path>, runs: usize) -> Result<(), Box<dyn Error>> {
    println!(
        "The true map of a walk that takes every street, grown travel by travel and taken back; medians of {runs} runs. Of every link between two \
         pending gateways: how many pending gateways the smaller part of the faces has, and how many places the shorter of two joined paths.\n"
    );
    let heads =
        ["", "places", "links", "smaller face", "most", "shorter path", "most", "ns/link", "ns/unlink"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    match streets::new_york(data)? {
        Some(world) => rows.push(row("New York", &world, &cover(&world, 1)?, runs)?),
        None => println!("New York: skipped: set HSSH_DATA to the folder with streets/"),
    }
    for side in GRIDS {
        let world = grid(side, side, SPACING)?;
        let row_by_row = world.route_through(&snake(side, side))?;
        rows.push(row("grid, row by row", &world, &row_by_row, runs)?);
        rows.push(row("grid, at random", &world, &cover(&world, 1)?, runs)?);
    }
    for places in RANDOM {
        let world = random_planar(places, 0.5, SPACING, 1)?;
        rows.push(row("random streets", &world, &cover(&world, 1)?, runs)?);
    }
    println!("{}", aligned(&rows));
    Ok(())
}

fn row(name: &str, world: &World, route: &Route, runs: usize) -> Result<Vec<String>, Box<dyn Error>> {
    let changes = changes(world, route)?;
    let [faces, paths] = lengths(&changes)?;
    let (mut growing, mut shrinking) = (Vec::new(), Vec::new());
    for _ in 0..runs {
        let mut map = TopologicalMap::without_boundaries();
        let started = Instant::now();
        changes.iter().try_for_each(|change| apply(&mut map, change).map(drop))?;
        growing.push(started.elapsed().as_secs_f64());
        if map.graph().genus() > 0 {
            return Err(format!("{name}: streets are planar, their map is not").into());
        }
        let started = Instant::now();
        changes.iter().for_each(|_| map.retract());
        shrinking.push(started.elapsed().as_secs_f64());
    }
    let links = changes.iter().filter(|change| matches!(change, Change::Link(..))).count();
    let each = |seconds: Vec<f64>| format!("{:.0}", median(seconds) * 1e9 / links as f64);
    Ok(vec![
        name.to_owned(),
        grouped((changes.len() - links) as u64),
        grouped(links as u64),
        faces.mean(),
        grouped(faces.most),
        paths.mean(),
        grouped(paths.most),
        each(growing),
        each(shrinking),
    ])
}

/// How the true map grows: a place when it is seen first, a link when it is travelled first.
fn changes(world: &World, route: &Route) -> Result<Vec<Change>, Box<dyn Error>> {
    let mut first_olps: Vec<Option<u32>> = vec![None; world.places().len()];
    let mut is_travelled = vec![false; world.links().len()];
    let (mut changes, mut olps) = (Vec::new(), 0);
    let mut here = route.start;
    let mut see = |place: hssh_world::PlaceId, changes: &mut Vec<Change>| {
        if first_olps[place.index()].is_none() {
            let star = world.place(place).star.clone();
            first_olps[place.index()] = Some(olps);
            olps += star.degree();
            changes.push(Change::Place(star));
        }
        first_olps[place.index()].unwrap_or_default()
    };
    for &exit in &route.exits {
        let exit = WorldOlp { place: here, olp: exit };
        let entry = world.neighbor(exit).ok_or("a route leads along links")?;
        let link = world.link_index(exit).ok_or("a route leads along links")?;
        let ends = [exit, entry].map(|end| MapOlp::new(see(end.place, &mut changes) + end.olp.number()));
        if !std::mem::replace(&mut is_travelled[link], true) {
            changes.push(Change::Link(ends[0], ends[1]));
        }
        here = entry.place;
    }
    Ok(changes)
}

fn apply(map: &mut TopologicalMap, change: &Change) -> Result<Option<PlaceId>, Box<dyn Error>> {
    match change {
        Change::Place(star) => Ok(Some(map.add_place(StarId::new(0), star))),
        &Change::Link(a, b) => {
            let [a, b] = pending(map, a, b)?;
            map.link(a, b);
            Ok(None)
        }
    }
}

fn pending(map: &TopologicalMap, a: MapOlp, b: MapOlp) -> Result<[PendingGateway; 2], Box<dyn Error>> {
    let both = map.pending(a).zip(map.pending(b));
    both.map(|(a, b)| [a, b]).ok_or_else(|| "a street that leads to itself has two ends".into())
}

/// Of every link: the smaller part of its face or faces, and the shorter of its paths. They are counted here, not by what links.
fn lengths(changes: &[Change]) -> Result<[Lengths; 2], Box<dyn Error>> {
    let mut map = TopologicalMap::without_boundaries();
    let [mut faces, mut paths] = [Lengths::default(), Lengths::default()];
    for change in changes {
        if let &Change::Link(a, b) = change {
            let ends = pending(&map, a, b)?;
            faces.add(smaller_face(&map, ends));
            if map.path(a) != map.path(b) {
                paths.add(length(&map, a).min(length(&map, b)));
            }
        }
        apply(&mut map, change)?;
    }
    Ok([faces, paths])
}

/// How many pending gateways the smaller of the two parts has that a link makes of a face, or that it joins.
fn smaller_face(map: &TopologicalMap, [a, b]: [PendingGateway; 2]) -> u64 {
    let rest_of_face = |from: PendingGateway, to: PendingGateway| {
        let after = map.graph().pending_edges_of_face(from.edge()).skip(1);
        after.take_while(move |&edge| edge != to.edge())
    };
    rest_of_face(a, b).zip(rest_of_face(b, a)).count() as u64
}

/// How many places the path has that ends there.
fn length(map: &TopologicalMap, end: MapOlp) -> u64 {
    std::iter::successors(Some(end), |&toward| map.linked(map.opposite(toward))).count() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a square of four crossings the last street closes a face with nothing pending inside.
    #[test]
    fn the_smaller_face_and_the_shorter_path_are_counted() {
        let world = grid(2, 2, SPACING).unwrap();
        let around: Vec<_> = [0, 1, 3, 2, 0].map(hssh_world::PlaceId).to_vec();
        let changes = changes(&world, &world.route_through(&around).unwrap()).unwrap();
        let [faces, paths] = lengths(&changes).unwrap();
        assert_eq!((faces.number, faces.most, faces.sum), (4, 1, 3));
        assert_eq!((paths.number, paths.most), (4, 1));
    }
}
