//! Rooms and passages of floor plans in maps that a simulated laser draws of them: with noise, turned, in cells of other sizes,
//! and from so few spots that some of the rooms are seen in part.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use hssh_local::{
    Cell, DistanceField, Gateway, Lattice, Occupancy, OccupancyGrid, RegionMap, RegionOptions,
    read_floor_plan,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::plans::{RESOLUTION, names, truth};
use super::segmentation::{Agreement, Rooms};
use crate::table::aligned;

/// How the plans are turned, in degrees, and the size of the cells that are drawn, in metres; the first is the plan itself, to
/// compare with.
const DRAWINGS: [(f64, f64); 4] = [(0.0, 0.05), (1.5, 0.05), (20.0, 0.05), (3.0, 0.1)];
/// The robot looks around at spots no nearer to one another than this, and no nearer to obstacles than that, in metres.
const SPACING: f64 = 2.0;
const ROBOT: f64 = 0.3;
/// How many spots are tried: enough that hardly any is left where one would fit in.
const TRIES: usize = 40_000;
/// The laser's beams, its reach in metres, and the deviations of a range and of the position (metres) and heading (radians) in
/// which a scan is drawn.
const BEAMS: u32 = 360;
const REACH: f64 = 12.0;
const RANGE_NOISE: f64 = 0.015;
const POSITION_NOISE: f64 = 0.015;
const HEADING_NOISE: f64 = 0.004;
/// A cell is occupied if at least this part of the beams that came to it ended there.
const OCCUPIED: f64 = 0.3;
/// The part of a room's cells that have to be seen for it to count.
const SEEN: f64 = 0.5;
/// A true passage is found if there is one no farther off, in metres. What leads from one room of the truth to another is a true
/// passage, however far apart they are drawn, and a door if it is as wide as this.
const NEAR: f64 = 0.6;
const DOOR_WIDTHS: std::ops::RangeInclusive<f64> = 0.55..=1.2;
/// How far before and behind a passage rooms of the truth are looked for, in metres.
const BESIDE: [f64; 5] = [0.2, 0.4, 0.6, 0.8, 1.0];
/// The probabilities of doors are told in so many classes.
const CLASSES: usize = 5;

/// Where two true rooms meet.
struct Portal {
    middle: [f64; 2],
}

/// What was found in the drawings of one kind.
#[derive(Clone, Default)]
struct Count {
    agreements: Vec<Agreement>,
    passages: usize,
    right: usize,
    portals: usize,
    found: usize,
    /// By class of probability: passages, their probabilities' sum, and how many are doors.
    classes: [(usize, f64, usize); CLASSES],
}

pub(super) fn report(folder: &Path) -> Result<String, Box<dyn Error>> {
    let mut rows = vec![
        [
            "",
            "MCC",
            "precision",
            "recall",
            "F1",
            "regions",
            "passages right",
            "true passages found",
            "doors: said, true",
        ]
        .map(str::to_owned)
        .to_vec(),
    ];
    let mut all = Count::default();
    for (degrees, cell) in DRAWINGS {
        for furnished in [false, true] {
            let mut count = Count::default();
            for (seed, name) in (0..).zip(names(folder)?) {
                let ending = if furnished { "_furnitures.png" } else { ".png" };
                let file = folder.join(format!("{name}{ending}"));
                if file.exists() {
                    let plan = read_floor_plan(&file, RESOLUTION)?;
                    let rooms = truth(folder, &name)?;
                    count.add(&plan, &rooms, degrees.to_radians(), cell, seed)?;
                }
            }
            let kind = if furnished { ", furnished" } else { "" };
            let is_plan = degrees == 0.0;
            let name = if is_plan {
                "the plan itself".to_owned()
            } else {
                format!("{degrees}°, {} cm", 100.0 * cell)
            };
            rows.push(count.row(name + kind));
            if !is_plan {
                all.join(&count);
            }
        }
    }
    let classes = all.classes.iter().map(|&(passages, sum, doors)| {
        let count = passages.max(1) as f64;
        format!("{:.2} said, {:.2} true ({passages})", sum / count, doors as f64 / count)
    });
    Ok(format!(
        "plans as a simulated laser draws them\n{}probability of a door, by fifths: {}\n",
        aligned(&rows),
        classes.collect::<Vec<_>>().join("; ")
    ))
}

impl Count {
    fn add(
        &mut self,
        plan: &OccupancyGrid,
        rooms: &Rooms,
        turn: f64,
        cell: f64,
        seed: u64,
    ) -> Result<(), Box<dyn Error>> {
        let drawn = if turn == 0.0 { centered(plan)? } else { scanned(plan, turn, cell, seed)? };
        let to_plan = Turned::new(plan.lattice(), turn);
        let map = RegionMap::new(&drawn, &RegionOptions::default())?;
        let room_at = |point: [f64; 2]| {
            let at = plan.lattice().cell_at(to_plan.back(point))?;
            rooms.room_of[plan.lattice().index(at)]
        };
        let lattice = *drawn.lattice();
        let mut room_of: Vec<Option<u32>> = lattice
            .cells()
            .map(|here| room_at(lattice.center(here)).filter(|_| drawn.get(here) == Occupancy::Free))
            .collect();
        let least = rooms.areas().map(|cells| SEEN * cells as f64 * (RESOLUTION / cell).powi(2));
        let mut seen = vec![0.0; rooms.count];
        room_of.iter().flatten().for_each(|&room| seen[room as usize] += 1.0);
        let mut number = 0..;
        let numbers: Vec<Option<u32>> =
            least.zip(&seen).map(|(least, &seen)| if seen >= least { number.next() } else { None }).collect();
        room_of.iter_mut().for_each(|room| *room = room.and_then(|room| numbers[room as usize]));
        let count = numbers.iter().flatten().count();
        self.agreements.push(Agreement::of(&map, &Rooms { room_of, count }));
        let is_seen = |point: [f64; 2]| drawn.at(point) == Occupancy::Free;
        let portals =
            portals(plan, rooms).into_iter().map(|portal| Portal { middle: to_plan.there(portal.middle) });
        let portals: Vec<Portal> = portals.filter(|portal| is_seen(portal.middle)).collect();
        let middles: Vec<[f64; 2]> = map.passages.iter().map(|passage| passage.gateway.position).collect();
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) <= NEAR;
        self.portals += portals.len();
        self.found +=
            portals.iter().filter(|portal| middles.iter().any(|&at| near(portal.middle, at))).count();
        // What leads to no room of the truth may be a door or none.
        let beside =
            |gateway: &Gateway, sign: f64| BESIDE.iter().find_map(|far| room_at(ahead(gateway, sign * far)));
        for passage in &map.passages {
            let gateway = &passage.gateway;
            let [Some(before), Some(behind)] = [-1.0, 1.0].map(|sign| beside(gateway, sign)) else {
                continue;
            };
            let is_right = before != behind;
            let is_door = is_right && DOOR_WIDTHS.contains(&gateway.width);
            self.passages += 1;
            self.right += usize::from(is_right);
            let class = ((passage.door_probability * CLASSES as f64) as usize).min(CLASSES - 1);
            let (passages, sum, doors) = &mut self.classes[class];
            *passages += 1;
            *sum += passage.door_probability;
            *doors += usize::from(is_door);
        }
        Ok(())
    }

    fn join(&mut self, other: &Count) {
        for (own, other) in self.classes.iter_mut().zip(&other.classes) {
            *own = (own.0 + other.0, own.1 + other.1, own.2 + other.2);
        }
    }

    fn row(&self, name: String) -> Vec<String> {
        let part = |part: usize, all: usize| {
            format!("{part} of {all} ({:.1}%)", 100.0 * part as f64 / all.max(1) as f64)
        };
        let said: f64 = self.classes.iter().map(|class| class.1).sum();
        let true_doors: usize = self.classes.iter().map(|class| class.2).sum();
        let mut row = vec![name];
        row.extend(Agreement::mean(&self.agreements).cells());
        row.extend([
            part(self.right, self.passages),
            part(self.found, self.portals),
            format!("{said:.0}, {true_doors}"),
        ]);
        row
    }
}

/// The point so many metres beyond the middle of a gateway.
fn ahead(gateway: &Gateway, far: f64) -> [f64; 2] {
    let (sin, cos) = gateway.bearing.sin_cos();
    [gateway.position[0] + far * cos, gateway.position[1] + far * sin]
}

/// A plan turned around its middle, which is the origin of what is drawn.
struct Turned {
    middle: [f64; 2],
    sin: f64,
    cos: f64,
}

impl Turned {
    fn new(plan: &Lattice, turn: f64) -> Self {
        let middle = [plan.width(), plan.height()].map(|count| f64::from(count) * plan.resolution() / 2.0);
        Turned { middle, sin: turn.sin(), cos: turn.cos() }
    }

    fn there(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [x, y] = [x - self.middle[0], y - self.middle[1]];
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y]
    }

    fn back(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cos * x + self.sin * y + self.middle[0], self.cos * y - self.sin * x + self.middle[1]]
    }
}

/// The plan with its middle in the origin.
fn centered(plan: &OccupancyGrid) -> Result<OccupancyGrid, Box<dyn Error>> {
    let lattice = plan.lattice();
    let origin = Turned::new(lattice, 0.0).middle.map(|half| -half);
    let lattice = Lattice::new(lattice.width(), lattice.height(), lattice.resolution(), origin)?;
    Ok(OccupancyGrid::new(lattice, plan.cells().to_vec())?)
}

/// The map that a laser draws of a plan.
fn scanned(plan: &OccupancyGrid, turn: f64, cell: f64, seed: u64) -> Result<OccupancyGrid, Box<dyn Error>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let turned = Turned::new(plan.lattice(), turn);
    let half = turned.middle[0].hypot(turned.middle[1]);
    let side = (2.0 * half / cell).ceil() as u32 + 2;
    let lattice = Lattice::new(side, side, cell, [-f64::from(side) * cell / 2.0; 2])?;
    let mut beams = vec![[0_u32; 2]; lattice.len()];
    let spots = spots(plan, &mut random);
    let mut noise = |deviation: f64| {
        let normal: f64 = StandardNormal.sample(&mut random);
        deviation * normal
    };
    for [x, y] in spots {
        let [dx, dy, heading] = [POSITION_NOISE, POSITION_NOISE, HEADING_NOISE].map(&mut noise);
        for beam in 0..BEAMS {
            let bearing = f64::from(beam) / f64::from(BEAMS) * std::f64::consts::TAU;
            let (range, is_hit) = range(plan, [x, y], bearing);
            let range = (range + noise(RANGE_NOISE)).max(0.0);
            let (sin, cos) = (bearing + heading).sin_cos();
            let from = turned.there([x + dx, y + dy]);
            let to = turned.there([x + dx + range * cos, y + dy + range * sin]);
            let (Some(from), Some(to)) = (lattice.cell_at(from), lattice.cell_at(to)) else { continue };
            let ended = lattice.index(to);
            lattice.line(from, to).map(|cell| lattice.index(cell)).filter(|&index| index != ended).for_each(
                |index| {
                    beams[index][0] += 1;
                },
            );
            beams[ended][usize::from(is_hit)] += 1;
        }
    }
    let known = |&[passed, hit]: &[u32; 2]| match passed + hit {
        0 => Occupancy::Unknown,
        all if f64::from(hit) >= OCCUPIED * f64::from(all) => Occupancy::Occupied,
        _ => Occupancy::Free,
    };
    Ok(OccupancyGrid::new(lattice, beams.iter().map(known).collect())?)
}

/// Where the robot looks around: spots at random, as many as fit in.
fn spots(plan: &OccupancyGrid, random: &mut ChaCha8Rng) -> Vec<[f64; 2]> {
    let lattice = *plan.lattice();
    let field = DistanceField::new(lattice, |index| plan.cells()[index] != Occupancy::Free);
    let cells: Vec<Cell> =
        lattice.cells().filter(|&cell| (ROBOT..f64::INFINITY).contains(&field.clearance(cell))).collect();
    let mut spots: Vec<[f64; 2]> = Vec::new();
    for _ in 0..cells.len().min(TRIES) {
        let spot = lattice.center(cells[random.random_range(0..cells.len())]);
        if spots.iter().all(|other| (other[0] - spot[0]).hypot(other[1] - spot[1]) >= SPACING) {
            spots.push(spot);
        }
    }
    spots
}

/// How far a beam goes, in metres, and whether something ends it: whatever is not free does, as in the regions of the plan
/// itself, for plans have walls that are gray.
fn range(plan: &OccupancyGrid, [x, y]: [f64; 2], bearing: f64) -> (f64, bool) {
    let (sin, cos) = bearing.sin_cos();
    let step = RESOLUTION / 2.0;
    let steps = (REACH / step) as u32;
    let along = |step_number: &u32| f64::from(*step_number) * step;
    let end = (1..steps)
        .find(|number| plan.at([x + along(number) * cos, y + along(number) * sin]) != Occupancy::Free);
    end.map_or((REACH, false), |number| (along(&number), true))
}

/// Where true rooms are no farther apart than a line is thick, and nothing but free space is between them.
fn portals(plan: &OccupancyGrid, rooms: &Rooms) -> Vec<Portal> {
    const ACROSS: i32 = 4;
    let lattice = *plan.lattice();
    let room = |cell: Cell| rooms.room_of[lattice.index(cell)];
    let mut contacts: BTreeMap<[u32; 2], Vec<Cell>> = BTreeMap::new();
    for here in lattice.cells() {
        let Some(own) = room(here) else { continue };
        for (columns, rows) in [(1, 0), (0, 1), (1, 1), (1, -1)] {
            let beyond = (1..=ACROSS).map_while(|far| lattice.step(here, far * columns, far * rows));
            let free = beyond.take_while(|&cell| plan.get(cell) == Occupancy::Free);
            if let Some((cell, other)) = free.filter_map(|cell| Some((cell, room(cell)?))).next()
                && other != own
            {
                let middle =
                    Cell { column: here.column.midpoint(cell.column), row: here.row.midpoint(cell.row) };
                contacts.entry([own.min(other), own.max(other)]).or_default().push(middle);
            }
        }
    }
    contacts.into_values().flat_map(|cells| grouped(cells, &lattice)).collect()
}

/// Each group of cells that hang together as one portal.
fn grouped(mut cells: Vec<Cell>, lattice: &Lattice) -> Vec<Portal> {
    const APART: u32 = 2;
    cells.sort_unstable();
    cells.dedup();
    let mut portals = Vec::new();
    while let Some(first) = cells.pop() {
        let mut group = vec![first];
        let mut at = 0;
        while at < group.len() {
            let here = group[at];
            let is_near = |cell: &mut Cell| {
                cell.column.abs_diff(here.column) <= APART && cell.row.abs_diff(here.row) <= APART
            };
            group.extend(cells.extract_if(.., is_near));
            at += 1;
        }
        let points: Vec<[f64; 2]> = group.iter().map(|&cell| lattice.center(cell)).collect();
        let count = points.len() as f64;
        let middle = [0, 1].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / count);
        portals.push(Portal { middle });
    }
    portals
}
