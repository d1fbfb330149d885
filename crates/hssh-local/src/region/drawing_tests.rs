//! Regions and doors of floors that are drawn at any angle and in cells of any size.

use std::f64::consts::PI;

use super::{Passage, Region, RegionKind, RegionMap, RegionOptions};
use crate::grid::{Lattice, Occupancy, OccupancyGrid};

/// A rectangle: left, bottom, right and top in metres.
type Area = [f64; 4];

/// Two rooms above a corridor; what is not free is wall 0.2 m thick, and beyond the outer walls is something else.
const SIZE: [f64; 2] = [13.0, 8.0];
const ROOMS: [Area; 3] = [[0.2, 0.2, 12.8, 2.4], [0.2, 2.6, 6.4, 7.8], [6.6, 2.6, 12.8, 7.8]];
/// The door to the second room.
const DOOR: Area = [9.0, 2.4, 9.9, 2.6];

/// A floor plan before it is drawn.
#[derive(Clone)]
struct Plan {
    free: Vec<Area>,
    /// Lines, 0.05 m thick, from one point to another.
    leaves: Vec<[[f64; 2]; 2]>,
    beyond: Occupancy,
}

impl Plan {
    /// The floor with an opening to the first room, from x = 2.5 m on.
    fn with_opening(width: f64) -> Self {
        let opening = [2.5, 2.4, 2.5 + width, 2.6];
        Plan { free: [&ROOMS[..], &[DOOR, opening]].concat(), leaves: Vec::new(), beyond: Occupancy::Unknown }
    }

    /// Hangs leaves into it that stand open by so many degrees, into the room or into the corridor.
    fn with_leaves(mut self, width: f64, leaves: u32, degrees: f64, is_into_room: bool) -> Self {
        let (up, y) = if is_into_room { (1.0, 2.575) } else { (-1.0, 2.425) };
        let length = width / f64::from(leaves);
        let (sin, cos) = degrees.to_radians().sin_cos();
        for (x, ahead) in [(2.5, 1.0), (2.5 + width, -1.0)].into_iter().take(leaves as usize) {
            self.leaves.push([[x, y], [x + ahead * length * cos, y + up * length * sin]]);
        }
        self
    }

    /// Draws the arc of each leaf, a right angle from its tip to where the leaf lies when it is closed.
    fn with_arcs(mut self) -> Self {
        let arcs: Vec<[[f64; 2]; 2]> = self
            .leaves
            .iter()
            .flat_map(|&[[hx, hy], [_, ty]]| {
                let (radius, ahead) = (ty - hy, if hx < 2.6 { 1.0 } else { -1.0 });
                let at = move |step: u32| {
                    let (sin, cos) = (f64::from(step) * PI / 64.0).sin_cos();
                    [hx + ahead * radius.abs() * cos, hy + radius * sin]
                };
                (0..32).map(move |step| [at(step), at(step + 1)])
            })
            .collect();
        self.leaves.extend(arcs);
        self
    }

    fn at(&self, [x, y]: [f64; 2]) -> Occupancy {
        let is_in =
            |&[left, bottom, right, top]: &Area| (left..right).contains(&x) && (bottom..top).contains(&y);
        let is_on = |&[[ax, ay], [bx, by]]: &[[f64; 2]; 2]| {
            let (dx, dy) = (bx - ax, by - ay);
            let length = dx.hypot(dy);
            let (along, off) = ((x - ax) * dx + (y - ay) * dy, (x - ax) * dy - (y - ay) * dx);
            (0.0..length * length).contains(&along) && off.abs() <= 0.025 * length
        };
        match () {
            () if self.leaves.iter().any(is_on) => Occupancy::Occupied,
            () if self.free.iter().any(is_in) => Occupancy::Free,
            () if is_in(&[0.0, 0.0, SIZE[0], SIZE[1]]) => Occupancy::Occupied,
            () => self.beyond,
        }
    }

    /// The plan in cells of that many metres, turned by so many degrees around the origin. What covers any of nine points of a
    /// cell is in it, so that no thin line is lost.
    fn drawn(&self, cell: f64, degrees: f64) -> OccupancyGrid {
        self.drawn_with_margin(cell, degrees, 0.2)
    }

    /// The same, with so many metres of what is beyond around it.
    fn drawn_with_margin(&self, cell: f64, degrees: f64, margin: f64) -> OccupancyGrid {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let corners = [[0.0, 0.0], [SIZE[0], 0.0], [0.0, SIZE[1]], SIZE];
        let corners = corners.map(|[x, y]| [cos * x - sin * y, sin * x + cos * y]);
        let bound = |axis: usize, better: fn(f64, f64) -> f64| {
            corners.iter().map(|corner| corner[axis]).reduce(better).unwrap_or_default()
        };
        let low = [0, 1].map(|axis| bound(axis, f64::min) - margin);
        let cells = [0, 1].map(|axis| ((bound(axis, f64::max) + margin - low[axis]) / cell).ceil() as u32);
        let lattice = Lattice::new(cells[0], cells[1], cell, low).unwrap();
        let occupancy = |here| {
            let [x, y] = lattice.center(here);
            let third = cell / 3.0;
            let parts = [-third, 0.0, third]
                .into_iter()
                .flat_map(|dx| [-third, 0.0, third].map(|dy| [x + dx, y + dy]));
            let parts: Vec<Occupancy> =
                parts.map(|[x, y]| self.at([cos * x + sin * y, cos * y - sin * x])).collect();
            if parts.contains(&Occupancy::Occupied) { Occupancy::Occupied } else { parts[4] }
        };
        OccupancyGrid::new(lattice, lattice.cells().map(occupancy).collect()).unwrap()
    }
}

fn regions(grid: &OccupancyGrid) -> RegionMap {
    RegionMap::new(grid, &RegionOptions::default()).unwrap()
}

/// The passage in the opening to the first room, of a plan turned by so many degrees.
fn passage(map: &RegionMap, width: f64, degrees: f64) -> Option<Passage> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let [x, y] = [2.5 + width / 2.0, 2.5];
    let at = [cos * x - sin * y, sin * x + cos * y];
    let away = |passage: &&Passage| {
        let [x, y] = passage.gateway.position;
        (x - at[0]).hypot(y - at[1])
    };
    map.passages.iter().find(|passage| away(passage) < 0.5).copied()
}

/// Drawn like that, the plan has three regions, and its opening is a door of that width.
fn is_a_door_of_three_regions(plan: &Plan, cell: f64, turn: f64, width: f64) {
    let map = regions(&plan.drawn(cell, turn));
    let case = format!("{cell} m, turned by {turn}°: {width} m, leaves {:?}", plan.leaves);
    assert_eq!(map.regions.len(), 3, "{case}");
    let door = passage(&map, width, turn).unwrap_or_else(|| panic!("{case}: no passage"));
    assert!(door.door_probability > 0.9, "{case}: {door:?}");
    assert!((door.gateway.width - width).abs() < 0.17, "{case}: {door:?}");
}

/// A leaf of any width, into the room or the corridor, at any angle and in any cells: the same three regions, and a door as wide as
/// the opening.
#[test]
fn a_leaf_ajar_parts_nothing_and_is_a_door() {
    for (cell, turn) in [(0.02, 0.0), (0.05, 0.0), (0.05, 30.0), (0.05, 45.0)] {
        for (width, degrees) in [(0.8, 60.0), (0.9, 30.0), (0.9, 60.0), (0.9, 90.0), (1.0, 75.0)] {
            for is_into_room in [true, false] {
                let plan = Plan::with_opening(width).with_leaves(width, 1, degrees, is_into_room);
                is_a_door_of_three_regions(&plan, cell, turn, width);
            }
        }
    }
}

/// Two leaves make a door of what is an opening without them.
#[test]
fn two_leaves_are_a_door_and_no_leaf_is_an_opening() {
    for turn in [0.0, 30.0] {
        for width in [1.4, 1.6, 2.0] {
            let opening = regions(&Plan::with_opening(width).drawn(0.05, turn));
            let passage_without = passage(&opening, width, turn).expect("an opening");
            assert!(!passage_without.is_door(), "{turn}°: {width} m: {passage_without:?}");
            for degrees in [60.0, 90.0] {
                for is_into_room in [true, false] {
                    let plan = Plan::with_opening(width).with_leaves(width, 2, degrees, is_into_room);
                    is_a_door_of_three_regions(&plan, 0.05, turn, width);
                }
            }
        }
    }
}

/// What stands beside an opening that it would not close is no leaf of it, however thin.
#[test]
fn a_partition_is_no_leaf() {
    let mut plan = Plan::with_opening(1.8);
    plan.leaves.push([[2.5, 2.6], [2.5, 3.5]]);
    let map = regions(&plan.drawn(0.05, 0.0));
    let found = passage(&map, 1.8, 0.0).expect("an opening");
    assert!(!found.is_door(), "{found:?}");
}

/// However the plan is turned and whatever is beyond its walls, it has the same rooms and doors; paper is no room.
#[test]
fn a_turned_plan_has_the_same_rooms_and_doors() {
    for beyond in [Occupancy::Unknown, Occupancy::Occupied, Occupancy::Free] {
        for cell in [0.025, 0.05, 0.1] {
            for turn in [0.0, 7.0, 30.0, 45.0] {
                let plan = Plan { beyond, ..Plan::with_opening(0.9) };
                let map = regions(&plan.drawn(cell, turn));
                let doors = map.passages.iter().filter(|passage| passage.is_door()).count();
                assert_eq!(
                    (map.regions.len(), map.passages.len(), doors),
                    (3, 2, 2),
                    "{beyond:?}, {cell} m, {turn}°: {:?}",
                    map.passages
                );
                assert!(map.regions.iter().all(|region| region.kind != RegionKind::Outside));
            }
        }
    }
}

/// Free space that ends where the map ends is outside; it is kept where a door leads to it, or where there is nothing else.
#[test]
fn what_the_map_ends_at_is_outside() {
    let with_yard = |front: &[Area]| {
        let plan = Plan { beyond: Occupancy::Free, ..Plan::with_opening(0.9) };
        Plan { free: [&plan.free[..], front].concat(), ..plan }.drawn(0.05, 30.0)
    };
    let outside =
        |map: &RegionMap| map.regions.iter().filter(|region| region.kind == RegionKind::Outside).count();
    let open = regions(&with_yard(&[[0.0, 1.0, 0.2, 1.9]]));
    assert!(outside(&open) > 0);
    assert!(open.passages.iter().any(|passage| {
        let kinds = passage.regions.map(|region| open.region(region).kind);
        kinds.contains(&RegionKind::Outside) && passage.is_door()
    }));
    assert_eq!(outside(&regions(&with_yard(&[]))), 0);
    let lattice = Lattice::new(200, 200, 0.1, [0.0, 0.0]).unwrap();
    let yard = regions(&OccupancyGrid::filled(lattice, Occupancy::Free));
    assert_eq!((yard.regions.len(), outside(&yard)), (1, 1));
}

/// A wall of one cell at an angle, of which every so often a cell is missing, parts two rooms as if it were whole.
#[test]
fn a_wall_with_holes_is_a_wall() {
    let lattice = Lattice::new(200, 120, 0.05, [0.0, 0.0]).unwrap();
    for degrees in [0.0, 7.0, 30.0] {
        let slope = (degrees * PI / 180.0).tan();
        for holes in [5, 9, 14, 17] {
            let mut grid = OccupancyGrid::filled(lattice, Occupancy::Free);
            for cell in lattice.cells() {
                let on_wall = (slope * (f64::from(cell.column) - 100.0) + 60.0).round() as u32 == cell.row;
                let is_missing = cell.column.is_multiple_of(holes) || (60..78).contains(&cell.column);
                if on_wall && !is_missing {
                    grid.set(cell, Occupancy::Occupied);
                }
            }
            let map = regions(&grid);
            let case = format!("{degrees}°, every {holes}th: {:?}", map.passages);
            assert_eq!(map.passages.len(), 1, "{case}");
            let [x, _] = map.passages[0].gateway.position;
            assert!(map.passages[0].is_door() && (x - 3.45).abs() < 0.3, "{case}");
        }
    }
}

/// What is left of a thick wall between two slits is wall, although it is as small as a chair.
#[test]
fn a_piece_between_two_walls_is_wall() {
    let lattice = Lattice::new(200, 120, 0.05, [0.0, 0.0]).unwrap();
    let mut grid = OccupancyGrid::filled(lattice, Occupancy::Free);
    for cell in lattice.cells().filter(|cell| (58..62).contains(&cell.row)) {
        if !(60..78).contains(&cell.column) && ![120, 136].contains(&cell.column) {
            grid.set(cell, Occupancy::Occupied);
        }
    }
    let map = regions(&grid);
    assert_eq!((map.regions.len(), map.passages.len()), (2, 1), "{:?}", map.passages);
}

/// Doors as plans draw them: a leaf at a right angle, and the arc from its tip to the other jamb. They are doors as wide as the
/// leaf, whichever way it opens, and the same regions are there as without.
#[test]
fn a_leaf_with_its_arc_is_a_door() {
    for (cell, turn) in [(0.025, 0.0), (0.05, 0.0), (0.05, 7.0), (0.025, 30.0)] {
        for width in [0.7, 0.9, 1.1] {
            for is_into_room in [true, false] {
                let plan = Plan::with_opening(width).with_leaves(width, 1, 90.0, is_into_room).with_arcs();
                is_a_door_of_three_regions(&plan, cell, turn, width);
            }
        }
    }
}

#[test]
fn two_leaves_with_their_arcs_are_one_door() {
    for (cell, turn) in [(0.025, 0.0), (0.05, 0.0), (0.025, 30.0)] {
        for is_into_room in [true, false] {
            let plan = Plan::with_opening(1.8).with_leaves(1.8, 2, 90.0, is_into_room).with_arcs();
            is_a_door_of_three_regions(&plan, cell, turn, 1.8);
        }
    }
}

/// Without a leaf an arc is a round wall, and what it closes in is no door.
#[test]
fn an_arc_without_a_leaf_is_a_wall() {
    let mut plan = Plan::with_opening(0.9).with_leaves(0.9, 1, 90.0, true).with_arcs();
    plan.leaves.retain(|&[[ax, _], [bx, _]]| (ax - bx).abs() > 1e-9);
    let map = regions(&plan.drawn(0.05, 0.0));
    assert!(passage(&map, 0.9, 0.0).is_none_or(|passage| !passage.is_door()), "{:?}", map.passages);
}

/// A plan on a page: a frame around it with a box of the legend in a corner. The paper is outside, and the box is no room.
#[test]
fn a_page_is_no_building() {
    for cell in [0.05, 0.1] {
        let front = [0.0, 1.0, 0.2, 1.9];
        let mut plan = Plan { beyond: Occupancy::Free, ..Plan::with_opening(0.9) };
        plan.free.push(front);
        let page = |[left, bottom, right, top]: Area| {
            let corners = [[left, bottom], [right, bottom], [right, top], [left, top]];
            (0..4).map(move |at| [corners[at], corners[(at + 1) % 4]])
        };
        plan.leaves.extend(page([-3.0, -5.0, 16.0, 11.0]).chain(page([11.0, -5.0, 16.0, -3.0])));
        let map = regions(&plan.drawn_with_margin(cell, 0.0, 6.5));
        let outside = |region: &&Region| region.kind == RegionKind::Outside;
        let kinds: Vec<RegionKind> = map.regions.iter().map(|region| region.kind).collect();
        assert_eq!((map.regions.len(), map.regions.iter().filter(outside).count()), (4, 1), "{kinds:?}");
        assert_eq!(map.passages.iter().filter(|passage| passage.is_door()).count(), 3, "{:?}", map.passages);
    }
}

/// A word across most of a room parts it no more than paper does.
#[test]
fn a_word_parts_no_room() {
    for turn in [0.0, 30.0] {
        let mut plan = Plan { beyond: Occupancy::Occupied, ..Plan::with_opening(0.9) };
        for letter in 0..12 {
            let x = 1.4 + 0.35 * f64::from(letter);
            plan.leaves.push([[x, 5.0], [x, 5.4]]);
            plan.leaves.push([[x, 5.4], [x + 0.2, 5.4]]);
            plan.leaves.push([[x, 5.2], [x + 0.15, 5.2]]);
        }
        let map = regions(&plan.drawn(0.05, turn));
        assert_eq!((map.regions.len(), map.passages.len()), (3, 2), "{turn}°: {:?}", map.passages);
    }
}
