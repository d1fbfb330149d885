//! Whether the same rooms and doors are found in a plan that is drawn anew: with noise, turned, or in other cells.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use hssh_local::{Gateway, Lattice, Occupancy, OccupancyGrid, RegionMap, RegionOptions, read_floor_plan};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::plans::{RESOLUTION, names};
use crate::table::aligned;

/// How many drawings with noise there are of each plan.
const DRAWINGS: u64 = 20;
/// The part of the cells beside walls that become wall, and half as many of all become unknown.
const NOISE: f64 = 0.02;
/// A door is the same if its middle moved by no more than this, in metres.
const NEAR: f64 = 0.5;

/// A plan drawn anew.
struct Drawing {
    grid: OccupancyGrid,
    /// How it is turned, in radians, around the middle of the plan.
    turn: f64,
}

/// Rooms and doors of the plan, and those that are found again.
#[derive(Clone, Copy, Default)]
struct Count {
    rooms: usize,
    same_rooms: usize,
    doors: usize,
    same_doors: usize,
}

pub(super) fn report(folder: &Path) -> Result<String, Box<dyn Error>> {
    let mut counts: BTreeMap<usize, (String, Count)> = BTreeMap::new();
    for name in names(folder)? {
        let plan = read_floor_plan(&folder.join(format!("{name}.png")), RESOLUTION)?;
        let known = RegionMap::new(&plan, &RegionOptions::default())?;
        let noisy = (0..DRAWINGS).map(|seed| (format!("{DRAWINGS} with noise"), 0.0, 1.0, Some(seed)));
        let others = [(7.0, 1.0), (30.0, 1.0), (45.0, 1.0), (0.0, 2.0), (0.0, 0.5)];
        let others = others.map(|(degrees, factor): (f64, f64)| {
            let name =
                if degrees > 0.0 { format!("turned by {degrees}°") } else { format!("cells × {factor}") };
            (name, degrees.to_radians(), factor, None)
        });
        for (row, (name, turn, factor, seed)) in noisy.chain(others).enumerate() {
            let drawing = drawn(&plan, turn, factor, seed)?;
            let found = RegionMap::new(&drawing.grid, &RegionOptions::default())?;
            let row = row.saturating_sub(DRAWINGS as usize - 1);
            let count = &mut counts.entry(row).or_insert((name, Count::default())).1;
            add(count, &plan, &known, &drawing, &found);
        }
    }
    let mut rows = vec![["", "same rooms", "same doors"].map(str::to_owned).to_vec()];
    for (name, Count { rooms, same_rooms, doors, same_doors }) in counts.into_values() {
        let part = |same: usize, all: usize| {
            format!("{same} of {all} ({:.1}%)", 100.0 * same as f64 / all.max(1) as f64)
        };
        rows.push(vec![name, part(same_rooms, rooms), part(same_doors, doors)]);
    }
    Ok(format!("rooms and doors of the plans that are found again in other drawings\n{}", aligned(&rows)))
}

/// The plan in cells `factor` times as large, turned around its middle.
fn drawn(plan: &OccupancyGrid, turn: f64, factor: f64, seed: Option<u64>) -> Result<Drawing, Box<dyn Error>> {
    let [width, height] = size(plan.lattice());
    let cell = RESOLUTION * factor;
    let (sin, cos) = turn.sin_cos();
    let side = |a: f64, b: f64| ((a * cos.abs() + b * sin.abs()) / cell).round() as u32;
    let (columns, rows) = (side(width, height), side(height, width));
    let origin = [columns, rows].map(|count| -f64::from(count) * cell / 2.0);
    let lattice = Lattice::new(columns, rows, cell, origin)?;
    let mut random = ChaCha8Rng::seed_from_u64(seed.unwrap_or_default());
    let at = |[x, y]: [f64; 2]| plan.at([cos * x + sin * y + width / 2.0, cos * y - sin * x + height / 2.0]);
    let cells = lattice.cells().map(|here| {
        let [x, y] = lattice.center(here);
        let truth = at([x, y]);
        let draw: f64 = if seed.is_some() { random.random() } else { 1.0 };
        let is_beside_wall = || {
            [[1.5, 0.0], [-1.5, 0.0], [0.0, 1.5], [0.0, -1.5]]
                .iter()
                .any(|[dx, dy]| at([x + dx * cell, y + dy * cell]) == Occupancy::Occupied)
        };
        match truth {
            _ if draw < NOISE / 2.0 => Occupancy::Unknown,
            Occupancy::Free if draw < 1.5 * NOISE && is_beside_wall() => Occupancy::Occupied,
            _ => truth,
        }
    });
    Ok(Drawing { grid: OccupancyGrid::new(lattice, cells.collect())?, turn })
}

fn size(lattice: &Lattice) -> [f64; 2] {
    [lattice.width(), lattice.height()].map(|count| f64::from(count) * lattice.resolution())
}

/// Counts the rooms of which a region of the drawing is at least half of the union with, and the doors found again.
fn add(count: &mut Count, plan: &OccupancyGrid, known: &RegionMap, drawing: &Drawing, found: &RegionMap) {
    let [width, height] = size(plan.lattice());
    let (sin, cos) = drawing.turn.sin_cos();
    let to_drawing = |[x, y]: [f64; 2]| {
        let [x, y] = [x - width / 2.0, y - height / 2.0];
        [cos * x - sin * y, sin * x + cos * y]
    };
    let mut shared: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    let (mut all_known, mut all_found) = (vec![0.0; known.regions.len()], vec![0.0; found.regions.len()]);
    for cell in plan.lattice().cells() {
        let here = known.region_of(cell);
        let there = found.region_at(to_drawing(plan.lattice().center(cell)));
        if let Some(region) = here {
            all_known[region.index()] += 1.0;
        }
        if let Some(region) = there {
            all_found[region.index()] += 1.0;
        }
        if let (Some(here), Some(there)) = (here, there) {
            *shared.entry((here.0, there.0)).or_default() += 1.0;
        }
    }
    count.rooms += known.regions.len();
    let is_same = |&(&(here, there), &cells): &(&(u32, u32), &f64)| {
        2.0 * cells >= all_known[here as usize] + all_found[there as usize] - cells
    };
    count.same_rooms += shared.iter().filter(is_same).count();
    let doors = |map: &RegionMap| -> Vec<Gateway> {
        map.passages.iter().filter(|passage| passage.is_door()).map(|passage| passage.gateway).collect()
    };
    let again = doors(found);
    let is_near = |door: &&Gateway| {
        let at = to_drawing(door.position);
        again.iter().any(|other| (other.position[0] - at[0]).hypot(other.position[1] - at[1]) <= NEAR)
    };
    let known = doors(known);
    count.doors += known.len();
    count.same_doors += known.iter().filter(is_near).count();
}
