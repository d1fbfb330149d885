//! The frame of a page: a thin rectangle around all that is drawn, with paper on both sides. It is no wall.

use std::ops::Range;

use super::thing::{Thing, things};
use crate::grid::{Cell, Lattice};

/// A frame is drawn no thicker than this, in metres, with two cells more.
const THICKNESS: f64 = 0.1;
/// This part of a side is drawn, at least, ...
const DRAWN: f64 = 0.97;
/// ... and this part of it has paper within.
const PAPER: f64 = 0.6;
/// What is framed is at least so large a part of the frame, along both axes.
const FRAMED: f64 = 0.4;
/// So many frames are around one another at most.
const FRAMES: usize = 3;

/// The cells of frames, by index; within a frame is paper for so many metres.
pub(super) fn frames(lattice: &Lattice, is_obstacle: impl Fn(usize) -> bool, within: f64) -> Vec<usize> {
    let page = Page { lattice, is_obstacle, within: (within / lattice.resolution()).ceil() as u32 };
    let mut frames = Vec::new();
    let mut area = Area { columns: 0..lattice.width(), rows: 0..lattice.height() };
    for _ in 0..FRAMES {
        let Some((frame, inner)) = page.frame(&area) else { break };
        frames.extend(frame);
        area = inner;
    }
    frames
}

/// The cell so far along a side of a rectangle, and so far within.
type Side<'a> = &'a dyn Fn(u32, u32) -> Cell;

/// A rectangle of cells.
#[derive(Clone)]
struct Area {
    columns: Range<u32>,
    rows: Range<u32>,
}

impl Area {
    fn size(&self) -> [u32; 2] {
        [self.columns.end - self.columns.start, self.rows.end - self.rows.start]
    }
}

struct Page<'a, F> {
    lattice: &'a Lattice,
    is_obstacle: F,
    within: u32,
}

impl<F: Fn(usize) -> bool> Page<'_, F> {
    fn is_at(&self, column: u32, row: u32) -> bool {
        (self.is_obstacle)(self.lattice.index(Cell { column, row }))
    }

    /// The cells of the frame around all obstacles of an area, if there is one, and the area within.
    fn frame(&self, area: &Area) -> Option<(Vec<usize>, Area)> {
        let around = self.around(area)?;
        let most = (THICKNESS / self.lattice.resolution()) as u32 + 2;
        if around.size().into_iter().any(|cells| cells <= 2 * (most + self.within)) {
            return None;
        }
        let Area { columns, rows } = around.clone();
        let bottom = |along: u32, far: u32| Cell { column: columns.start + along, row: rows.start + far };
        let top = |along: u32, far: u32| Cell { column: columns.start + along, row: rows.end - 1 - far };
        let left = |along: u32, far: u32| Cell { column: columns.start + far, row: rows.start + along };
        let right = |along: u32, far: u32| Cell { column: columns.end - 1 - far, row: rows.start + along };
        let [wide, high] = around.size();
        let sides: [(Side<'_>, u32); 4] = [(&bottom, wide), (&top, wide), (&left, high), (&right, high)];
        let mut frame = Vec::new();
        let mut thickest = 0;
        for (side, length) in sides {
            let is_at = |along: u32, far: u32| (self.is_obstacle)(self.lattice.index(side(along, far)));
            let drawn = (0..length).filter(|&along| (0..2).any(|far| is_at(along, far))).count();
            let end = |along: u32| (1..=most).find(|&far| !is_at(along, far));
            let has_paper = |&along: &u32| {
                end(along).is_some_and(|end| (end..end + self.within).all(|far| !is_at(along, far)))
            };
            let paper = (0..length).filter(has_paper).count();
            if (drawn as f64) < DRAWN * f64::from(length) || (paper as f64) < PAPER * f64::from(length) {
                return None;
            }
            for along in 0..length {
                if let Some(end) = end(along) {
                    thickest = thickest.max(end);
                    frame.extend((0..end).map(|far| self.lattice.index(side(along, far))));
                }
            }
        }
        let inner = Area {
            columns: columns.start + thickest..columns.end - thickest,
            rows: rows.start + thickest..rows.end - thickest,
        };
        self.is_framed(&around).then_some((frame, inner))
    }

    /// The least area that has all obstacles of one, without the outermost cells of the map.
    fn around(&self, area: &Area) -> Option<Area> {
        let [width, height] = [self.lattice.width(), self.lattice.height()];
        let Area { columns, rows } = area.clone();
        let (columns, rows) =
            (columns.start.max(1)..columns.end.min(width - 1), rows.start.max(1)..rows.end.min(height - 1));
        let has_row = |row: &u32| columns.clone().any(|column| self.is_at(column, *row));
        let (low, high) = (rows.clone().find(has_row)?, rows.clone().rev().find(has_row)?);
        let has_column = |column: &u32| (low..=high).any(|row| self.is_at(*column, row));
        let (left, right) = (columns.clone().find(has_column)?, columns.rev().find(has_column)?);
        Some(Area { columns: left..right + 1, rows: low..high + 1 })
    }

    /// Whether there is a drawing in an area that does not hang together with what is around it.
    fn is_framed(&self, area: &Area) -> bool {
        let is_within = |cell: Cell| area.columns.contains(&cell.column) && area.rows.contains(&cell.row);
        let is_obstacle = |index: usize| (self.is_obstacle)(index) && is_within(self.lattice.cell(index));
        let is_drawing = |thing: &Thing| {
            let is_part = |(own, all): (u32, u32)| f64::from(own) >= FRAMED * f64::from(all) && own < all;
            thing.size().into_iter().zip(area.size()).all(is_part)
        };
        things(self.lattice, is_obstacle, 1).iter().any(is_drawing)
    }
}
