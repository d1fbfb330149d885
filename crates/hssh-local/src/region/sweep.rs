//! Doors as plans draw them: a leaf that stands open, and the arc along which its tip comes home to the other jamb. Both are signs,
//! and no walls.

use std::f64::consts::{FRAC_PI_2, PI};

use rustc_hash::FxHashSet;

use super::arc::{self, Arc};
use super::leaf::Leaf;
use super::options::LeafOptions;
use super::raster::{Raster, Vector, length, minus, plus, point, toward};
use crate::grid::{Cell, Lattice};

/// Arcs are sought in cells at least as large as this, in metres, ...
const COARSE: f64 = 0.04;
/// ... and lines of a drawing are no thicker than this, with two cells more.
const THICKNESS: f64 = 0.1;
/// So much of a leaf is drawn, at least, ...
const DRAWN: f64 = 0.7;
/// ... and so much of an arc.
const SWEPT: f64 = 0.75;
/// So much of what the leaf sweeps is free.
const EMPTY: f64 = 0.85;
/// An arc that leads on behind the leaf by more than this, in radians, is something round.
const ROUND: f64 = 0.25 * PI;
/// Lines of fewer cells than this, in radius, are no arcs.
const FEWEST: f64 = 6.0;
/// Before the best place for a sweep is sought, so much of both is drawn.
const ROUGHLY: f64 = 0.3;
/// The middle of its line is no farther off the circle than so many cells.
const OFF: f64 = 0.8;
/// In the middle it is no nearer to the hinge than at its ends by more than this part of the radius; a straight line is by 0.14 of it.
const STRAIGHT: f64 = 0.08;
/// A leaf is sought so many radians beyond the end of its arc, ...
const BEYOND: f64 = PI / 12.0;
/// ... and this is from one direction to the next.
const TURN: f64 = PI / 120.0;
/// Within so many metres beside an opening is wall, ...
const BESIDE: f64 = 0.25;
/// ... for this part of it.
const WALLED: f64 = 0.6;
/// Within so many metres from where the leaf hangs the wall ends, ...
const DEEP: f64 = 0.6;
/// ... and so much is free behind it.
const BEHIND: f64 = 0.3;
/// No more than so many lines are drawn across an opening.
const SILLS: usize = 3;
/// Half a cell is a step when the best place for a sweep is sought, ...
const HALF: f64 = 0.5;
/// ... of which there are no more than this.
const ROUNDS: u32 = 20;
/// What is no farther from a jamb than so many cells is taken for a part of it.
const JAMB: f64 = 2.0;
/// So many cells of lines are left where they meet a jamb.
const ROOT: f64 = 0.5;
/// Two sweeps are one if their middles are no farther apart than this part of the radius.
const SAME: f64 = 0.3;
/// The tips of two leaves come home no farther from one another than this, in metres.
const MEETING: f64 = 0.2;

/// What a plan draws of doors.
#[derive(Default)]
pub(super) struct Sweeps {
    /// The leaves as they stand open.
    pub(super) leaves: Vec<Leaf>,
    /// The cells of leaves, of their arcs, and of lines across their openings.
    pub(super) cells: FxHashSet<Cell>,
    /// Points in metres where a leaf goes, or who goes through.
    pub(super) ways: Vec<[f64; 2]>,
}

/// The doors that are drawn as leaves with arcs.
pub(super) fn sweeps(
    lattice: &Lattice,
    is_obstacle: impl Fn(usize) -> bool,
    options: &LeafOptions,
) -> Sweeps {
    let fine = Raster { lattice: *lattice, is_obstacle };
    let times = (COARSE / lattice.resolution()).ceil().max(1.0) as u32;
    let drawn =
        if times == 1 { sweeps_of(&fine, options) } else { sweeps_of(&pooled(&fine, times), options) };
    let drawing = Drawing::of(&fine, options);
    let mut sweeps = Sweeps::default();
    for sweep in drawn {
        let sweep = sweep.in_cells_divided_by(times);
        drawing.cells_of(&sweep, &mut sweeps.cells);
        sweeps.leaves.push(Leaf { hinge: fine.metres(sweep.hinge()), tip: fine.metres(sweep.tip()) });
        sweeps.ways.extend(drawing.ways_of(&sweep).into_iter().map(|at| fine.metres(at)));
    }
    sweeps
}

/// The raster in cells that are so many times as large, with an obstacle where there is any.
fn pooled<F: Fn(usize) -> bool>(fine: &Raster<F>, times: u32) -> Raster<impl Fn(usize) -> bool + use<F>> {
    let lattice = fine.lattice;
    let [width, height] = [lattice.width(), lattice.height()].map(|cells| cells.div_ceil(times));
    let resolution = lattice.resolution() * f64::from(times);
    let coarse = Lattice::new(width, height, resolution, lattice.origin()).expect("it is no larger");
    let mut is_obstacle = vec![false; coarse.len()];
    for (index, cell) in lattice.cells().enumerate() {
        if (fine.is_obstacle)(index) {
            is_obstacle[coarse.index(Cell { column: cell.column / times, row: cell.row / times })] = true;
        }
    }
    Raster { lattice: coarse, is_obstacle: move |index: usize| is_obstacle[index] }
}

/// The sweeps of a raster: those whose arc ends at a wall, and those that meet another's.
fn sweeps_of<F: Fn(usize) -> bool>(raster: &Raster<F>, options: &LeafOptions) -> Vec<Sweep> {
    let drawing = Drawing::of(raster, options);
    let radii = (raster.cells(options.shortest) - 1.5).max(FEWEST)..=raster.cells(options.longest) + 1.5;
    let arcs = arc::arcs(raster, radii, drawing.thickness());
    // Several arcs are found for one that is drawn: the best first.
    let mut drawn: Vec<(f64, Sweep)> = arcs
        .iter()
        .filter_map(|arc| drawing.sweep(arc))
        .map(|sweep| (drawing.strokes(&sweep).into_iter().flatten().sum(), sweep))
        .collect();
    drawn.sort_by(|(one, a), (other, b)| b.is_to_wall.cmp(&a.is_to_wall).then(other.total_cmp(one)));
    let mut sweeps: Vec<Sweep> = Vec::new();
    for (_, sweep) in drawn {
        let is_same =
            |other: &Sweep| length(minus(sweep.middle(), other.middle())) <= SAME * sweep.arc.radius;
        if !sweeps.iter().any(is_same) {
            sweeps.push(sweep);
        }
    }
    let near = raster.cells(MEETING) + 2.0;
    let meets = |one: &Sweep, other: &Sweep| {
        let [ahead, back] = [one, other].map(|sweep| toward(sweep.closed));
        length(minus(one.latch(), other.latch())) <= near && ahead[0] * back[0] + ahead[1] * back[1] < -0.9
    };
    let is_door = |sweep: &&Sweep| sweep.is_to_wall || sweeps.iter().any(|other| meets(sweep, other));
    sweeps.iter().filter(is_door).copied().collect()
}

/// A leaf that stands open, and the way that it goes to close.
#[derive(Clone, Copy, Debug)]
struct Sweep {
    arc: Arc,
    /// The direction of the leaf as it stands open, in radians.
    open: f64,
    /// Its direction when it is closed.
    closed: f64,
    /// Whether the arc ends at a wall.
    is_to_wall: bool,
}

impl Sweep {
    fn hinge(&self) -> Vector {
        self.arc.center
    }

    fn middle(&self) -> Vector {
        plus(self.arc.center, toward((self.open + self.closed) / 2.0), self.arc.radius / 2.0)
    }

    fn tip(&self) -> Vector {
        self.arc.at(self.open)
    }

    /// Where the tip is when the leaf is closed.
    fn latch(&self) -> Vector {
        self.arc.at(self.closed)
    }

    /// The direction in which the opening leads away from the side that the leaf is on.
    fn through(&self) -> Vector {
        toward(self.closed + FRAC_PI_2.copysign(self.closed - self.open))
    }

    fn in_cells_divided_by(self, times: u32) -> Self {
        let times = f64::from(times);
        let center = self.arc.center.map(|axis| (axis + 0.5) * times - 0.5);
        Sweep { arc: Arc { center, radius: self.arc.radius * times, ..self.arc }, ..self }
    }
}

/// What is asked for sweeps; lengths in cells, unless they are constants.
struct Drawing<'a, F> {
    raster: &'a Raster<F>,
    options: &'a LeafOptions,
}

impl<'a, F: Fn(usize) -> bool> Drawing<'a, F> {
    fn of(raster: &'a Raster<F>, options: &'a LeafOptions) -> Self {
        Drawing { raster, options }
    }

    fn thickness(&self) -> f64 {
        self.raster.cells(THICKNESS) + 2.0
    }

    /// The sweep of which an arc is the way of the tip.
    fn sweep(&self, arc: &Arc) -> Option<Sweep> {
        let lengths = self.options.shortest..=self.options.longest;
        let is_leaf = lengths.contains(&(arc.radius * self.raster.lattice.resolution()));
        let of_leaf = |(open, sign): (f64, f64)| self.closing(arc, open, sign);
        (is_leaf && self.is_free_in_the_middle(arc))
            .then(|| self.leaves(arc))?
            .into_iter()
            .filter_map(of_leaf)
            .max_by_key(|sweep| sweep.is_to_wall)
    }

    /// Whether nothing is drawn between the middle of an arc and its center.
    fn is_free_in_the_middle(&self, arc: &Arc) -> bool {
        let middle = toward((arc.from + arc.to) / 2.0);
        [0.3, 0.4, 0.5, 0.6, 0.7]
            .into_iter()
            .all(|far| !self.raster.is_at(plus(arc.center, middle, far * arc.radius)))
    }

    /// The directions of what may be a leaf at the ends of an arc, each with the sign of the turn that closes it.
    fn leaves(&self, arc: &Arc) -> Vec<(f64, f64)> {
        let middle = (arc.from + arc.to) / 2.0;
        let leaf = |sign: f64| {
            let turns = ((arc.length() / 2.0 + BEYOND) / TURN) as u32;
            let direction = |turn: u32| middle - sign * f64::from(turn) * TURN;
            let is_drawn = |turn: &u32| self.drawn(arc, direction(*turn)) >= DRAWN;
            let first = (0..=turns).find(is_drawn)?;
            let last = (first..=first + (2.0 * self.thickness() / arc.radius / TURN) as u32)
                .take_while(is_drawn)
                .last()?;
            Some((direction(first + (last - first) / 2), sign))
        };
        [1.0, -1.0].into_iter().filter_map(leaf).collect()
    }

    /// The part of the radius of an arc in a direction that is drawn.
    fn drawn(&self, arc: &Arc, direction: f64) -> f64 {
        let (ahead, across) = (toward(direction), toward(direction + FRAC_PI_2));
        let is_drawn = |far: f64| {
            let at = plus(arc.center, ahead, far);
            [0.0, 0.7, -0.7].into_iter().any(|off| self.raster.is_at(plus(at, across, off)))
        };
        part(0.25 * arc.radius, 0.9 * arc.radius, is_drawn)
    }

    /// The sweep of which most is drawn, of those near to one that was found.
    fn settled(&self, found: Sweep) -> Sweep {
        let turn = HALF / found.arc.radius;
        let drawn = |sweep: &Sweep| self.strokes(sweep).into_iter().flatten().sum::<f64>();
        let (mut best, mut most) = (found, drawn(&found));
        for _ in 0..ROUNDS {
            let moved = |dx: f64, dy: f64, dr: f64| {
                let [x, y] = best.arc.center;
                Sweep {
                    arc: Arc { center: [x + dx, y + dy], radius: best.arc.radius + dr, ..best.arc },
                    ..best
                }
            };
            let turned = |by: f64| Sweep { open: best.open + by, closed: best.closed + by, ..best };
            let moves = [
                moved(HALF, 0.0, 0.0),
                moved(-HALF, 0.0, 0.0),
                moved(0.0, HALF, 0.0),
                moved(0.0, -HALF, 0.0),
                moved(0.0, 0.0, HALF),
                moved(0.0, 0.0, -HALF),
                turned(turn),
                turned(-turn),
            ];
            let tried = moves.into_iter().map(|sweep| (drawn(&sweep), sweep));
            let better = tried.filter(|&(drawn, _)| drawn > most).max_by(|a, b| a.0.total_cmp(&b.0));
            let Some(better) = better else { break };
            (most, best) = better;
        }
        best
    }

    /// For each half cell of the leaf, and for each of its arc, 1 if it is drawn, a half if it is drawn one cell off, and -1 if not.
    fn strokes(&self, sweep: &Sweep) -> [Vec<f64>; 2] {
        let of = |at: Vector, across: Vector| match () {
            () if self.raster.is_at(at) => 1.0,
            () if [1.0, -1.0].into_iter().any(|off| self.raster.is_at(plus(at, across, off))) => 0.5,
            () => -1.0,
        };
        let Sweep { arc, open, closed, .. } = sweep;
        let (leaf, across) = (toward(*open), toward(open + FRAC_PI_2));
        let of_leaf = halves(JAMB, arc.radius).map(|far| of(plus(arc.center, leaf, far), across));
        let turn = closed - open;
        let of_arc = halves(0.0, turn.abs() * arc.radius - JAMB).map(|along| {
            let angle = open + turn.signum() * along / arc.radius;
            of(arc.at(angle), toward(angle))
        });
        [of_leaf.collect(), of_arc.collect()]
    }

    /// The sweep of a leaf that stands open in a direction, and closes by a turn with a sign.
    fn closing(&self, arc: &Arc, open: f64, sign: f64) -> Option<Sweep> {
        let found = Sweep { arc: *arc, open, closed: open + sign * FRAC_PI_2, is_to_wall: false };
        let is_roughly_drawn = self.drawn_parts(&found).into_iter().all(|part| part >= ROUGHLY);
        let sweep = is_roughly_drawn.then(|| self.settled(found))?;
        let is_door = self.is_drawn(&sweep)
            && self.hangs(&sweep)
            && self.leads_through(&sweep)
            && self.stands_free(&sweep)
            && self.is_empty(&sweep);
        is_door.then(|| Sweep { is_to_wall: self.ends_at_wall(&sweep), ..sweep })
    }

    /// Of the leaf and of its arc, the mean of their strokes.
    fn drawn_parts(&self, sweep: &Sweep) -> [f64; 2] {
        self.strokes(sweep).map(|strokes| strokes.iter().sum::<f64>() / strokes.len() as f64)
    }

    /// Whether the leaf and its arc are drawn.
    fn is_drawn(&self, sweep: &Sweep) -> bool {
        let [leaf, arc] = self.drawn_parts(sweep);
        leaf >= DRAWN && arc >= SWEPT && self.is_round(sweep)
    }

    /// Whether the arc is a thin line along a circle, and no straight one: of that the middle would be nearer to the hinge than the ends.
    fn is_round(&self, sweep: &Sweep) -> bool {
        let Sweep { arc, open, closed, .. } = *sweep;
        let off = |step: u32| {
            let angle = open + (closed - open) * f64::from(step) / 20.0;
            let middle = arc.middle(angle, self.raster, self.thickness())?;
            Some(length(minus(middle, arc.center)) - arc.radius)
        };
        let mean = |steps: &[u32]| {
            let offs: Vec<f64> = steps.iter().filter_map(|&step| off(step)).collect();
            (2 * offs.len() > steps.len()).then(|| offs.iter().sum::<f64>() / offs.len() as f64)
        };
        let is_on = |step: &u32| off(*step).is_some_and(|off| off.abs() <= OFF);
        let bulge =
            mean(&[8, 9, 10, 11, 12]).zip(mean(&[3, 4, 5, 15, 16, 17])).map(|(middle, ends)| middle - ends);
        (3..=17).filter(is_on).count() as f64 >= 15.0 * SWEPT
            && bulge.is_some_and(|bulge| bulge >= -STRAIGHT * arc.radius)
    }

    /// Whether the arc ends where the leaf is, and nothing else is drawn where the leaf goes, nor right beyond.
    fn is_empty(&self, sweep: &Sweep) -> bool {
        let Sweep { arc, open, closed, .. } = *sweep;
        let beyond = if closed > open { open - arc.from } else { arc.to - open };
        let is_free = |part: f64, far: f64| {
            !self.raster.is_at(plus(arc.center, toward(open + part * (closed - open)), far))
        };
        let within = [0.3, 0.4, 0.5, 0.6, 0.7].map(|far| far * arc.radius - 0.5);
        let around = [arc.radius + self.thickness(), arc.radius + self.thickness() + 1.0];
        let free = |fars: &[f64]| {
            let points = fars.iter().flat_map(|&far| (4..=16).map(move |part| (f64::from(part) / 20.0, far)));
            let count = points.clone().count() as f64;
            points.filter(|&(part, far)| is_free(part, far)).count() as f64 / count
        };
        beyond <= ROUND && free(&within) >= EMPTY && free(&around) >= EMPTY
    }

    /// Whether there is wall along a line: on it, or a little behind it.
    fn is_wall(&self, from: Vector, ahead: Vector, through: Vector) -> bool {
        let reach = (self.raster.cells(THICKNESS) + 1.0) as i32;
        let is_at = |far: f64| {
            let at = plus(from, ahead, far);
            (-1..=reach).any(|off| self.raster.is_at(plus(at, through, f64::from(off))))
        };
        let wall = |begin: f64| part(begin, begin + self.raster.cells(BESIDE), is_at) >= WALLED;
        [1.0, 2.0, 3.0].into_iter().any(wall)
    }

    /// Whether the leaf hangs on the end of a wall.
    fn hangs(&self, sweep: &Sweep) -> bool {
        self.is_wall(sweep.hinge(), toward(sweep.closed + PI), sweep.through())
    }

    /// Whether it is the leaf that stands open, and not the line across the opening: nothing is behind its tip.
    fn stands_free(&self, sweep: &Sweep) -> bool {
        let is_closed = self.drawn(&sweep.arc, sweep.closed) >= DRAWN;
        let behind = |far: f64| self.raster.is_at(plus(sweep.tip(), toward(sweep.open), far));
        !is_closed || part(2.0, self.raster.cells(BESIDE) + 2.0, behind) < WALLED
    }

    /// Whether the arc ends at a wall.
    fn ends_at_wall(&self, sweep: &Sweep) -> bool {
        self.is_wall(sweep.latch(), toward(sweep.closed), sweep.through())
    }

    /// Whether the opening leads to somewhere behind the wall, with no more in it than lines.
    fn leads_through(&self, sweep: &Sweep) -> bool {
        let leads = |part: &f64| self.sills(sweep, part * sweep.arc.radius).is_some();
        [0.35, 0.5, 0.65].iter().filter(|part| leads(part)).count() >= 2
    }

    /// The lines across the opening so far from the hinge, as the distances at which they begin and end; nothing if it does not lead
    /// through there.
    fn sills(&self, sweep: &Sweep, along: f64) -> Option<Vec<[f64; 2]>> {
        let from = plus(sweep.hinge(), toward(sweep.closed), along);
        let (deep, behind) = (self.raster.cells(DEEP), self.raster.cells(BEHIND).max(2.0));
        let mut sills: Vec<[f64; 2]> = Vec::new();
        let mut free = 0.0;
        let mut far = -self.thickness() / 2.0;
        let mut is_in_line = false;
        while far <= deep + behind {
            if self.raster.is_at(plus(from, sweep.through(), far)) {
                match sills.last_mut().filter(|_| is_in_line) {
                    Some(sill) => sill[1] = far,
                    None => sills.push([far, far]),
                }
                is_in_line = true;
                free = 0.0;
            } else {
                is_in_line = false;
                free += 0.5;
            }
            far += 0.5;
        }
        let is_line = |[from, to]: &[f64; 2]| to - from <= self.thickness();
        let is_through = sills.last().is_none_or(|&[_, end]| end <= deep) && free >= behind;
        (is_through && sills.len() <= SILLS && sills.iter().all(is_line)).then_some(sills)
    }

    /// Adds the cells of the leaf, of its arc and of lines across the opening. What is behind the line of the closed leaf is wall, but
    /// for those lines.
    fn cells_of(&self, sweep: &Sweep, cells: &mut FxHashSet<Cell>) {
        let arc = &sweep.arc;
        let (leaf, ahead) = (toward(sweep.open), toward(sweep.closed));
        let across = toward(sweep.open + FRAC_PI_2);
        let mut lines = FxHashSet::default();
        for far in halves(ROOT, arc.radius + 1.0) {
            self.cells_across(plus(arc.center, leaf, far), across, self.thickness(), &mut lines);
        }
        let swept = sweep.closed - sweep.open;
        for along in halves(-1.0, arc.radius * swept.abs() - ROOT) {
            let angle = sweep.open + swept.signum() * along / arc.radius;
            self.cells_across(arc.at(angle), toward(angle), self.thickness(), &mut lines);
        }
        let [x, y] = sweep.through();
        let is_before = |cell: &Cell| {
            let [dx, dy] = minus(point(*cell), sweep.hinge());
            x * dx + y * dy <= -ROOT
        };
        let (low, high) = (sweep.open.min(sweep.closed), sweep.open.max(sweep.closed));
        let within = halves(0.0, arc.radius - 1.0).flat_map(|far| {
            halves(0.0, (high - low) * far)
                .map(move |along| plus(arc.center, toward(low + along / far.max(0.5)), far))
        });
        lines.extend(within.filter(|&at| self.raster.is_at(at)).filter_map(|at| self.raster.cell_at(at)));
        cells.extend(lines.into_iter().filter(is_before));
        let middle = [0.5, 0.35, 0.65].into_iter().find_map(|part| self.sills(sweep, part * arc.radius));
        for along in halves(0.0, arc.radius) {
            let from = plus(arc.center, ahead, along);
            for &[start, end] in middle.iter().flatten() {
                let at = plus(from, sweep.through(), (start + end) / 2.0);
                self.cells_across(at, sweep.through(), end - start + 1.0, cells);
            }
        }
    }

    /// Points of what the leaf sweeps, and of the opening.
    fn ways_of(&self, sweep: &Sweep) -> Vec<Vector> {
        let middle = plus(sweep.hinge(), toward(sweep.closed), sweep.arc.radius / 2.0);
        let through = halves(0.0, self.raster.cells(DEEP)).map(|far| plus(middle, sweep.through(), far));
        through.chain([sweep.middle()]).collect()
    }

    /// Adds the cells of lines at a point or near to it, in a direction across them, if they are no thicker than that.
    fn cells_across(&self, at: Vector, across: Vector, thickness: f64, cells: &mut FxHashSet<Cell>) {
        let is_at = |off: f64| self.raster.is_at(plus(at, across, off));
        let near: Vec<f64> = halves(-thickness / 2.0, thickness / 2.0).filter(|&off| is_at(off)).collect();
        for off in near {
            let run =
                |sign: f64| halves(0.0, 2.0 * thickness).take_while(|far| is_at(off + sign * far)).last();
            let [left, right] = [-1.0, 1.0].map(|sign| run(sign).unwrap_or_default());
            if left + right <= thickness {
                cells.extend(self.raster.cell_at(plus(at, across, off)));
                cells.extend(
                    halves(off - left, off + right)
                        .filter_map(|off| self.raster.cell_at(plus(at, across, off))),
                );
            }
        }
    }
}

/// Numbers from one to another, half a cell apart.
fn halves(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let count = (2.0 * (to - from)).max(0.0) as u32;
    (0..=count).map(move |step| from + f64::from(step) / 2.0)
}

/// The part of the numbers from one to another for which something holds.
fn part(from: f64, to: f64, holds: impl Fn(f64) -> bool) -> f64 {
    halves(from, to).filter(|&at| holds(at)).count() as f64 / halves(from, to).count() as f64
}
