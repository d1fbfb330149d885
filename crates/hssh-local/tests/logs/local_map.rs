//! Local maps: what they say of a room, and that scrolling only forgets.

use hssh_local::{LocalMap, LocalMapOptions, Occupancy};
use hssh_metrics::Pose;
use nalgebra::{Vector2, vector};

use crate::simulator::{around, scan};

/// A room of 6 m × 4 m around the origin, seen from two corners.
fn map_of_a_room(side: f64) -> LocalMap {
    let walls = around(&[[[-3.0, -2.0], [3.0, 2.0]]]);
    let mut map =
        LocalMap::new(Vector2::zeros(), LocalMapOptions { side, ..LocalMapOptions::default() }).unwrap();
    for pose in [Pose::new(-2.05, -1.05, 0.7), Pose::new(2.05, 1.05, 3.9)] {
        map.insert(pose, &scan(&walls, pose));
    }
    map
}

#[test]
fn a_room_is_free_its_walls_are_occupied_and_what_is_behind_unknown() {
    let grid = map_of_a_room(12.0).classify();
    for (x, y) in [(0.0, 0.0), (2.5, -1.5), (-2.5, 1.5), (1.0, 1.5)] {
        assert_eq!(grid.at([x, y]), Occupancy::Free, "({x}, {y})");
    }
    let near_wall = |x: f64, y: f64| {
        let around = [-0.1, 0.0, 0.1];
        around.iter().any(|dx| around.iter().any(|dy| grid.at([x + dx, y + dy]) == Occupancy::Occupied))
    };
    for (x, y) in [(3.0, 0.5), (-3.0, -0.5), (0.5, 2.0), (-0.5, -2.0)] {
        assert!(near_wall(x, y), "({x}, {y})");
    }
    for (x, y) in [(3.5, 0.0), (0.0, 2.5), (-4.0, -3.0)] {
        assert_eq!(grid.at([x, y]), Occupancy::Unknown, "({x}, {y})");
    }
}

#[test]
fn scrolling_keeps_what_stays_inside_and_forgets_the_rest() {
    let before = map_of_a_room(8.0).classify();
    let mut map = map_of_a_room(8.0);
    map.scroll_to(vector![3.0, -1.0]).unwrap();
    map.scroll_to(vector![0.0, 0.0]).unwrap();
    let after = map.classify();
    assert_eq!(after.lattice(), before.lattice());
    let mut kept = 0;
    for cell in after.lattice().cells() {
        let [x, y] = after.lattice().center(cell);
        if x > -0.9 && y < 2.9 {
            assert_eq!(after.get(cell), before.get(cell));
            kept += usize::from(after.get(cell) != Occupancy::Unknown);
        } else if x < -1.1 {
            assert_eq!(after.get(cell), Occupancy::Unknown);
        }
    }
    assert!(kept > 500);
}

#[test]
fn where_the_robot_went_nothing_is() {
    let mut map = map_of_a_room(12.0);
    map.clear_way(Pose::new(0.0, 0.0, 0.0), Pose::new(5.0, 0.0, 0.0));
    let grid = map.classify();
    for step in 0..=50 {
        assert_eq!(grid.at([f64::from(step) * 0.1, 0.0]), Occupancy::Free);
    }
}
