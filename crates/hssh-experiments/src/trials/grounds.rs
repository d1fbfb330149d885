//! Buildings and campuses that are hard to map, and ways through them.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::surroundings::{Disc, Surroundings, Wall};

/// A point in metres.
type Point = [f64; 2];
/// A box of free space: its low and its high corner.
type Space = [Point; 2];

/// What is to be driven through, and the corners of the way.
pub(super) struct Ground {
    pub(super) surroundings: Surroundings,
    pub(super) way: Vec<Point>,
    /// How likely a beam does not come back.
    pub(super) dropouts: f64,
}

/// How a ground is made.
type Plan = fn(&mut ChaCha8Rng) -> Ground;

/// The kinds of grounds, and how one is made.
pub(super) const KINDS: [(&str, Plan); 7] = [
    ("twins", twins),
    ("twins, back", twins_and_back),
    ("ring", ring),
    ("blocks", blocks),
    ("atria", atria),
    ("campus", campus),
    ("institute", institute),
];

/// Half the width of a corridor.
const HALF: f64 = 1.2;
/// How likely a beam does not come back in a building.
const INDOORS: f64 = 0.01;

fn built(spaces: &[Space], discs: Vec<Disc>, way: Vec<Point>) -> Ground {
    Ground { surroundings: Surroundings::new(around(spaces), discs), way, dropouts: INDOORS }
}

/// The walls of free space made of boxes: every border of a box that is not inside another one.
fn around(spaces: &[Space]) -> Vec<Wall> {
    let mut walls = Vec::new();
    for [low, high] in spaces {
        for (axis, at) in [(0, low[1]), (0, high[1]), (1, low[0]), (1, high[0])] {
            let other = 1 - axis;
            // What of the side lies inside of other boxes.
            let mut covered: Vec<[f64; 2]> = spaces
                .iter()
                .filter(|[l, h]| l[other] < at - 1e-9 && at + 1e-9 < h[other])
                .map(|[l, h]| [l[axis].max(low[axis]), h[axis].min(high[axis])])
                .filter(|[from, to]| from < to)
                .collect();
            covered.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let mut from = low[axis];
            for [start, end] in covered.into_iter().chain([[high[axis], high[axis]]]) {
                if start > from + 1e-9 {
                    let point = |along: f64| if axis == 0 { [along, at] } else { [at, along] };
                    walls.push([point(from), point(start)]);
                }
                from = from.max(end);
            }
        }
    }
    walls
}

/// A straight corridor between two points, one beside or above the other.
fn corridor(a: Point, b: Point, half: f64) -> Space {
    let low = [a[0].min(b[0]) - half, a[1].min(b[1]) - half];
    [low, [a[0].max(b[0]) + half, a[1].max(b[1]) + half]]
}

/// Doorways on both sides of a corridor between two points, one every `spacing` metres, all alike.
fn doorways(a: Point, b: Point, half: f64, spacing: f64) -> Vec<Space> {
    let axis = usize::from((b[1] - a[1]).abs() > (b[0] - a[0]).abs());
    let (from, to) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
    let count = ((to - from - 2.0 * spacing) / spacing).max(0.0) as u32;
    (1..=count)
        .map(|door| {
            let along = from + spacing * (f64::from(door) + 0.5);
            let mut space = [[0.0; 2]; 2];
            let (side, middle) = (1 - axis, a[1 - axis]);
            (space[0][axis], space[1][axis]) = (along - 0.45, along + 0.45);
            (space[0][side], space[1][side]) = (middle - half - 0.2, middle + half + 0.2);
            space
        })
        .collect()
}

/// The way of the twins: up the one corridor, a long way around, and up the other.
fn twin_corridors(random: &mut ChaCha8Rng) -> (Vec<Space>, [Point; 6]) {
    let apart = random.random_range(3.5..10.0);
    let (detour, length) = (random.random_range(30.0..150.0), random.random_range(20.0..60.0));
    let far = apart + detour;
    let way = [[0.0, 0.0], [0.0, length], [far, length], [far, 0.0], [apart, 0.0], [apart, length - 2.0]];
    let mut spaces: Vec<Space> = way.windows(2).map(|pair| corridor(pair[0], pair[1], HALF)).collect();
    spaces.push(corridor([apart, 0.0], [apart, length], HALF));
    // Niches on the same side of both twins, at the same heights.
    let mut at = random.random_range(3.0..6.0);
    while at < length - 3.0 {
        let (width, deep) = (random.random_range(0.8..2.0), random.random_range(0.3..0.6));
        for x in [0.0, apart] {
            spaces.push([[x, at], [x + HALF + deep, at + width]]);
        }
        at += width + random.random_range(2.0..6.0);
    }
    (spaces, way)
}

/// Two corridors that look alike; the robot never is where it was.
fn twins(random: &mut ChaCha8Rng) -> Ground {
    let (spaces, way) = twin_corridors(random);
    built(&spaces, Vec::new(), way.to_vec())
}

/// The same, but then the robot comes back to the first of them.
fn twins_and_back(random: &mut ChaCha8Rng) -> Ground {
    let (spaces, way) = twin_corridors(random);
    let [start, first, _, _, second, _] = way;
    let top = [second[0], first[1]];
    built(&spaces, Vec::new(), [&way[..5], &[top, first, start]].concat())
}

/// One long ring of corridors with doorways all alike, a bit more than once around.
fn ring(random: &mut ChaCha8Rng) -> Ground {
    let (width, height) = (random.random_range(120.0..450.0), random.random_range(60.0..350.0));
    let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height], [0.0, 0.0]];
    let spacing = random.random_range(3.0..8.0);
    let sides = || corners.windows(2).map(|pair| (pair[0], pair[1]));
    let mut spaces: Vec<Space> = sides().map(|(a, b)| corridor(a, b, HALF)).collect();
    spaces.extend(sides().flat_map(|(a, b)| doorways(a, b, HALF, spacing)));
    // Only a few lounges differ.
    for _ in 0..random.random_range(1..5) {
        let x = random.random_range(10.0..width - 15.0);
        spaces.push([[x, -4.0], [x + random.random_range(3.0..6.0), 0.0]]);
    }
    let start = [random.random_range(0.2..0.6) * width, 0.0];
    let again = [start[0] + 0.35 * width, 0.0];
    built(&spaces, Vec::new(), vec![start, corners[1], corners[2], corners[3], corners[0], again])
}

/// Corridors around blocks all alike, with doorways, walked at random.
fn blocks(random: &mut ChaCha8Rng) -> Ground {
    let (columns, rows): (i32, i32) = (random.random_range(3..6), random.random_range(2..4));
    let (width, height) = (random.random_range(15.0..35.0), random.random_range(10.0..25.0));
    let at = |column: i32, row: i32| [f64::from(column) * width, f64::from(row) * height];
    let mut spaces = Vec::new();
    for row in 0..rows {
        spaces.push(corridor(at(0, row), at(columns - 1, row), HALF));
        spaces.extend((1..columns).flat_map(|c| doorways(at(c - 1, row), at(c, row), HALF, 4.0)));
    }
    for column in 0..columns {
        spaces.push(corridor(at(column, 0), at(column, rows - 1), HALF));
    }
    let (mut here, mut way, mut before) = ((0, 0), vec![at(0, 0)], (-1, -1));
    for _ in 0..random.random_range(15..40) {
        let steps = [(1, 0), (0, 1), (-1, 0), (0, -1)].map(|(c, r)| (here.0 + c, here.1 + r));
        let open = steps.into_iter().filter(|&(c, r)| c >= 0 && r >= 0 && c < columns && r < rows);
        let onward: Vec<(i32, i32)> = open.filter(|next| *next != before).collect();
        before = here;
        here = onward[random.random_range(0..onward.len())];
        way.push(at(here.0, here.1));
    }
    built(&spaces, Vec::new(), way)
}

/// Long corridors around large blocks, of which no two are alike: doorways come as they come, shallow or deep, some with a room behind.
/// The way goes around one block after the other, so that it comes back only after hundreds of metres.
fn institute(random: &mut ChaCha8Rng) -> Ground {
    let (columns, rows): (usize, usize) = (random.random_range(2..4), random.random_range(2..4));
    let mut lines = |count: usize| {
        let mut at = vec![0.0];
        for _ in 1..count {
            at.push(at[at.len() - 1] + random.random_range(35.0..110.0));
        }
        at
    };
    let (xs, ys) = (lines(columns), lines(rows));
    let mut spaces = Vec::new();
    let mut lay = |a: Point, b: Point| {
        let half = random.random_range(0.9..1.7);
        spaces.push(corridor(a, b, half));
        spaces.extend(irregular_doorways(a, b, half, random));
    };
    for &y in &ys {
        xs.windows(2).for_each(|pair| lay([pair[0], y], [pair[1], y]));
    }
    for &x in &xs {
        ys.windows(2).for_each(|pair| lay([x, pair[0]], [x, pair[1]]));
    }
    let at = |column: usize, row: usize| [xs[column], ys[row]];
    let mut way = vec![at(0, 0)];
    for (column, row) in (0..columns - 1).flat_map(|column| (0..rows - 1).map(move |row| (column, row))) {
        // Along the lower side to the block, around it, and on.
        let last = way[way.len() - 1];
        let first = at(column, row);
        if last != first {
            way.push([last[0], first[1]]);
            way.push(first);
        }
        let around = [at(column + 1, row), at(column + 1, row + 1), at(column, row + 1), first];
        way.extend(around);
    }
    way.dedup();
    way.push(at(columns - 1, way_row(&way, &ys)));
    way.dedup();
    built(&spaces, Vec::new(), way)
}

/// The row of the last corner of a way.
fn way_row(way: &[Point], ys: &[f64]) -> usize {
    let last = way[way.len() - 1][1];
    ys.iter().position(|&y| y == last).unwrap_or(0)
}

/// Doorways on either side of a corridor, each of its own width and depth.
fn irregular_doorways(a: Point, b: Point, half: f64, random: &mut ChaCha8Rng) -> Vec<Space> {
    let axis = usize::from((b[1] - a[1]).abs() > (b[0] - a[0]).abs());
    let (from, to) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
    let mut spaces = Vec::new();
    for out in [-1.0, 1.0] {
        let mut along = from + random.random_range(3.0..8.0);
        while along < to - 5.0 {
            let width = random.random_range(0.8..1.3);
            let deep = if random.random_bool(0.2) { 3.0 } else { random.random_range(0.08..0.4) };
            let side = 1 - axis;
            let (inner, outer) = (a[side], a[side] + out * (half + deep));
            let mut space = [[0.0; 2]; 2];
            (space[0][axis], space[1][axis]) = (along, along + width);
            (space[0][side], space[1][side]) = (inner.min(outer), inner.max(outer));
            spaces.push(space);
            along += width + random.random_range(1.5..9.0);
        }
    }
    spaces
}

/// Large halls with pillars all alike, joined by corridors: the walls are often out of range.
fn atria(random: &mut ChaCha8Rng) -> Ground {
    let (long, wide) = (random.random_range(25.0..60.0), random.random_range(18.0..40.0));
    let gap = random.random_range(10.0..40.0);
    let halls = [[0.0, 0.0], [long + gap, 0.0]];
    let mut spaces: Vec<Space> = halls.map(|[x, y]| [[x, y], [x + long, y + wide]]).to_vec();
    let (low, high) = (random.random_range(3.0..6.0), wide - random.random_range(3.0..6.0));
    for y in [low, high] {
        spaces.push(corridor([long - 1.0, y], [long + gap + 1.0, y], HALF));
    }
    let spacing = random.random_range(6.0..12.0);
    let mut discs = Vec::new();
    for [x, y] in halls {
        for (column, row) in (1..10).flat_map(|column| (1..10).map(move |row| (column, row))) {
            let middle = [x + spacing * f64::from(column), y + spacing * f64::from(row) - spacing / 2.0];
            if middle[0] < x + long - 1.0 && middle[1] < y + wide - 1.0 && !near(middle[1], &[low, high]) {
                discs.push(Disc { middle, radius: 0.3 });
            }
        }
    }
    let (west, east) = (long / 4.0, 1.75 * long + gap);
    let loop_once = [[west, low], [east, low], [east, high], [west, high], [west, low]];
    let middle = [long + gap + 2.0, low];
    let way = [&loop_once[..], &[middle, [middle[0], high], [west, high]]].concat();
    discs.retain(|disc| way.windows(2).all(|pair| apart(disc.middle, pair) > 1.0));
    built(&spaces, discs, way)
}

/// Buildings alike with lawns and trees between, walked around.
fn campus(random: &mut ChaCha8Rng) -> Ground {
    let (size, lawn) = (random.random_range(15.0..35.0), random.random_range(15.0..40.0));
    let (columns, rows) = (3, 2);
    let pitch = size + lawn;
    let mut walls: Vec<Wall> = Vec::new();
    for (column, row) in (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row))) {
        let low = [f64::from(column) * pitch, f64::from(row) * pitch];
        let (x, y) = (low[0] + size, low[1] + size - random.random_range(0.0..4.0));
        let corners = [low, [x, low[1]], [x, y], [low[0], y], low];
        walls.extend(corners.windows(2).map(|pair| [pair[0], pair[1]]));
        let porch = [low[0] + size / 2.0, low[1]];
        walls.extend([
            [[porch[0] - 1.5, porch[1] - 2.0], [porch[0] + 1.5, porch[1] - 2.0]],
            [[porch[0] - 1.5, porch[1] - 2.0], [porch[0] - 1.5, porch[1]]],
            [[porch[0] + 1.5, porch[1] - 2.0], [porch[0] + 1.5, porch[1]]],
        ]);
    }
    let street = |number: i32| f64::from(number) * pitch - lawn / 2.0;
    let at = |column: i32, row: i32| [street(column), street(row)];
    let way = vec![
        at(0, 0),
        at(1, 0),
        at(2, 0),
        at(3, 0),
        at(3, 1),
        at(2, 1),
        at(1, 1),
        at(1, 2),
        at(2, 2),
        at(2, 1),
        at(2, 0),
        at(1, 0),
        at(1, 1),
        at(0, 1),
        at(0, 0),
        at(1, 0),
    ];
    let span = 3.0 * pitch;
    let mut discs: Vec<Disc> = (0..60)
        .map(|_| Disc {
            middle: [random.random_range(-lawn..span), random.random_range(-lawn..2.0 * pitch)],
            radius: random.random_range(0.1..0.4),
        })
        .collect();
    discs.retain(|disc| way.windows(2).all(|pair| apart(disc.middle, pair) > 1.5));
    Ground { surroundings: Surroundings::new(walls, discs), way, dropouts: 0.1 }
}

fn near(value: f64, others: &[f64]) -> bool {
    others.iter().any(|other| (value - other).abs() < 1.5)
}

/// How far a point is from the line between two others.
fn apart(point: Point, pair: &[Point]) -> f64 {
    let (a, b) = (pair[0], pair[1]);
    let way = [b[0] - a[0], b[1] - a[1]];
    let square = way[0] * way[0] + way[1] * way[1];
    let part = ((point[0] - a[0]) * way[0] + (point[1] - a[1]) * way[1]) / square.max(1e-9);
    let part = part.clamp(0.0, 1.0);
    (point[0] - a[0] - part * way[0]).hypot(point[1] - a[1] - part * way[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    #[test]
    fn two_boxes_have_one_outline() {
        let mut walls = around(&[[[0.0, 0.0], [4.0, 2.0]], [[3.0, -5.0], [5.0, 1.0]]]);
        walls.sort_by(|a, b| a.as_flattened().partial_cmp(b.as_flattened()).unwrap());
        let length = |[a, b]: &Wall| (b[0] - a[0]).abs() + (b[1] - a[1]).abs();
        assert_eq!(walls.iter().map(length).sum::<f64>(), 12.0 + 16.0 - 4.0, "{walls:?}");
        assert!(walls.contains(&[[0.0, 0.0], [3.0, 0.0]]), "{walls:?}");
    }

    /// The robot never comes near a wall.
    #[test]
    fn ways_are_free() {
        for (name, make) in KINDS {
            for seed in 0..10 {
                let ground = make(&mut ChaCha8Rng::seed_from_u64(seed));
                for pose in crate::trials::motion::poses(&ground.way, 0.5) {
                    let bearings: Vec<f64> =
                        (0..36).map(|beam| f64::from(beam) * 10_f64.to_radians()).collect();
                    let ranges = ground.surroundings.ranges(pose, &bearings, 30.0, &[]);
                    assert!(ranges.iter().all(|&range| range > 0.6), "{name} {seed}: {pose:?} {ranges:?}");
                }
            }
        }
    }
}
