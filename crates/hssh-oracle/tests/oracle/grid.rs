//! Grids of corridors with closed walls, and the routes of the published experiments.

use hssh_causal::{Exploration, NamedStar, StarType, Travel};
use hssh_topology::{Olp, Star};

/// A place: row from the north, column from the west.
type Place = (usize, usize);

/// The exploration of a grid along a route; stars are read clockwise from north.
pub(crate) fn exploration(rows: usize, columns: usize, route: &[Place]) -> Exploration {
    let star = |(row, column): Place| -> Star {
        let open = [row > 0, column + 1 < columns, row + 1 < rows, column > 0];
        let names = ["0+", "1+", "0-", "1-"];
        let ends: Vec<String> = std::iter::zip(names, open)
            .map(|(name, open)| if open { name.to_owned() } else { format!("({name})") })
            .collect();
        ends.join(" ").parse().unwrap()
    };
    let mut star_types: Vec<NamedStar> = Vec::new();
    let mut star_type = |place: Place| {
        let star = star(place);
        let known = star_types.iter().position(|named| named.star == star).unwrap_or_else(|| {
            star_types.push(NamedStar { name: star.to_string(), bearings: vec![None; 4], star });
            star_types.len() - 1
        });
        StarType(known as u32)
    };
    let start = star_type(route[0]);
    let travels = route
        .windows(2)
        .map(|pair| {
            let exit = direction(pair[0], pair[1]);
            Travel {
                exit: Olp::new(exit),
                entry: Olp::new((exit + 2) % 4),
                star: star_type(pair[1]),
                odometry: None,
            }
        })
        .collect();
    Exploration::new(star_types, start, travels).unwrap()
}

/// North, east, south or west, as the end of a star.
fn direction((row, column): Place, to: Place) -> u32 {
    match to {
        _ if row > 0 && to == (row - 1, column) => 0,
        _ if to == (row, column + 1) => 1,
        _ if to == (row + 1, column) => 2,
        _ if column > 0 && to == (row, column - 1) => 3,
        _ => panic!("{to:?} is not beside ({row}, {column})"),
    }
}

/// The snake: rows alternately from the north-west corner, then columns alternately from where the
/// rows ended.
pub(crate) fn snake(rows: usize, columns: usize) -> Vec<Place> {
    let mut route: Vec<Place> = Vec::new();
    for row in 0..rows {
        let across: Vec<usize> = (0..columns).collect();
        let east = row % 2 == 0;
        route.extend(across.iter().map(|&c| (row, if east { c } else { columns - 1 - c })));
    }
    let &(last_row, last_column) = route.last().unwrap();
    assert_eq!(last_row, rows - 1);
    let from_the_east = last_column == columns - 1;
    for count in 0..columns {
        let column = if from_the_east { columns - 1 - count } else { count };
        let north = count % 2 == 0;
        route.extend((0..rows).map(|r| (if north { rows - 1 - r } else { r }, column)));
    }
    route.dedup();
    route
}

/// The route of the published 3×4 experiment.
pub(crate) fn route_3x4() -> Vec<Place> {
    vec![
        (0, 0),
        (0, 1),
        (1, 1),
        (2, 1),
        (2, 2),
        (1, 2),
        (0, 2),
        (0, 3),
        (1, 3),
        (2, 3),
        (2, 2),
        (2, 1),
        (2, 0),
        (1, 0),
        (1, 1),
        (1, 2),
        (1, 3),
        (0, 3),
        (0, 2),
        (0, 1),
        (0, 0),
        (1, 0),
    ]
}
