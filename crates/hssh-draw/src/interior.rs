//! Where in an area there is room for a name.

use nalgebra::vector;

use crate::svg::Point;

/// Into how many parts the longer side of the box around an area is cut, to look for room.
const PARTS: f64 = 32.0;

/// The point within rings (by the even-odd rule) that is farthest from them and from what it should keep off, points with a
/// radius: of those looked at, on a lattice. `None` if the rings enclose nothing to speak of.
pub(crate) fn roomiest(rings: &[Vec<Point>], keep_off: &[(Point, f64)]) -> Option<Point> {
    let mut corners = rings.iter().flatten();
    let first = *corners.next()?;
    let (low, high) = corners.fold((first, first), |(low, high), at| (low.inf(at), high.sup(at)));
    let step = (high - low).max() / PARTS;
    if !(step > 0.0 && step.is_finite()) {
        return None;
    }
    let reach = high - low;
    // What is farther away than the area is wide leaves the rings nearer.
    let is_near = |&&(at, radius): &&(Point, f64)| {
        let beyond = (low - at).sup(&(at - high)).max();
        beyond < reach.max() + radius
    };
    let near: Vec<(Point, f64)> = keep_off.iter().filter(is_near).copied().collect();
    let along = |from: f64, length: f64| {
        let count = (length / step).floor().max(1.0);
        (0..count as u32).map(move |index| from + (f64::from(index) + 0.5) * length / count)
    };
    let lattice = along(low.y, reach.y).flat_map(|y| along(low.x, reach.x).map(move |x| vector![x, y]));
    let sides: Vec<[Point; 2]> = rings.iter().flat_map(|ring| sides(ring)).collect();
    let room = |at: &Point| {
        let sides = sides.iter().map(|&side| distance(*at, side));
        let others = near.iter().map(|(other, radius)| (other - at).norm() - radius);
        sides.chain(others).fold(f64::INFINITY, f64::min)
    };
    let inside = lattice.filter(|at| is_inside(*at, &sides)).map(|at| (room(&at), at));
    inside.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, at)| at)
}

/// The sides of a closed ring.
fn sides(ring: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    let next = ring.iter().copied().cycle().skip(1);
    ring.iter().copied().zip(next).map(|(from, to)| [from, to])
}

/// Whether a ray to the right crosses the sides of rings an odd number of times.
fn is_inside(at: Point, sides: &[[Point; 2]]) -> bool {
    let crosses = |[from, to]: &&[Point; 2]| {
        (from.y > at.y) != (to.y > at.y)
            && at.x < from.x + (at.y - from.y) / (to.y - from.y) * (to.x - from.x)
    };
    sides.iter().filter(crosses).count() % 2 == 1
}

/// How far a point is from a side.
fn distance(at: Point, [from, to]: [Point; 2]) -> f64 {
    let along = to - from;
    let square = along.norm_squared();
    let part = if square > 0.0 { ((at - from).dot(&along) / square).clamp(0.0, 1.0) } else { 0.0 };
    (from + part * along - at).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> Vec<Point> {
        [[low, low], [high, low], [high, high], [low, high]].map(Point::from).into()
    }

    #[test]
    fn of_a_square_the_middle_is_the_roomiest() {
        let at = roomiest(&[square(0.0, 8.0)], &[]).expect("a square has room");
        assert!((at - vector![4.0, 4.0]).norm() < 0.5, "{at}");
    }

    #[test]
    fn of_a_corridor_that_goes_around_something_a_point_within_it() {
        let (outer, inner) = (square(0.0, 10.0), square(2.0, 8.0));
        let at = roomiest(&[outer, inner], &[]).expect("a ring has room");
        let off = (at - vector![5.0, 5.0]).abs().max();
        assert!(off > 3.0 && off < 5.0, "{at}");
    }

    #[test]
    fn it_keeps_off_what_is_there_already() {
        let rings = [square(0.0, 8.0)];
        let at =
            roomiest(&rings, &[(vector![2.0, 4.0], 1.0), (vector![4.0, 4.0], 1.0)]).expect("there is room");
        assert!(at.x > 5.0, "{at}");
    }

    #[test]
    fn nothing_has_no_room() {
        assert_eq!(roomiest(&[], &[]), None);
        assert_eq!(roomiest(&[vec![vector![1.0, 1.0]; 3]], &[]), None);
    }
}
