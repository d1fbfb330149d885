//! Rectangular grids of places and the published routes through them (section 3.4).

use std::f64::consts::{FRAC_PI_2, PI};

use hssh_topology::{Olp, OlpName, Passability, Sign, Star, StarEnd};

use crate::geometry::Point;
use crate::world::{Link, Place, PlaceId, World, WorldError, WorldOlp};

/// Ends of a grid place in clockwise order, as positions in its star.
const NORTH: Olp = Olp::new(0);
const EAST: Olp = Olp::new(1);
const SOUTH: Olp = Olp::new(2);
const WEST: Olp = Olp::new(3);

/// A grid of `rows` × `columns` places, `spacing` metres apart.
///
/// Place (row, column) is number `row · columns + column`, named `row,column`; row 0 is the north
/// row, and place (0, 0) is the origin. Stars read clockwise from north: `0+ 1+ 0- 1-`, closed
/// where the grid ends. They are named by shape and open ends: `L-ES`, `T-ESW`, `+`.
///
/// # Errors
/// If there are no rows or no columns, or if the spacing is not positive.
pub fn grid(rows: u32, columns: u32, spacing: f64) -> Result<World, WorldError> {
    if rows == 0 || columns == 0 {
        return Err(WorldError::TooSmall { needed: 1, given: 0 });
    }
    if !(spacing > 0.0 && spacing.is_finite()) {
        return Err(WorldError::Parameter { parameter: "the spacing", value: spacing, range: "positive" });
    }
    let cells = || (0..rows).flat_map(move |row| (0..columns).map(move |column| (row, column)));
    let place = |(row, column): (u32, u32)| {
        let open = [row > 0, column + 1 < columns, row + 1 < rows, column > 0];
        Place {
            name: format!("{row},{column}"),
            position: Point::new(f64::from(column) * spacing, -f64::from(row) * spacing),
            star: star(open),
            star_name: star_name(open),
            bearings: vec![FRAC_PI_2, 0.0, -FRAC_PI_2, PI],
        }
    };
    let id = |row: u32, column: u32| PlaceId(row * columns + column);
    let link = |from, exit, to, entry| Link {
        ends: [WorldOlp { place: from, olp: exit }, WorldOlp { place: to, olp: entry }],
        bends: Vec::new(),
    };
    let eastward = cells()
        .filter(|&(_, column)| column + 1 < columns)
        .map(|(row, column)| link(id(row, column), EAST, id(row, column + 1), WEST));
    let southward = cells()
        .filter(|&(row, _)| row + 1 < rows)
        .map(|(row, column)| link(id(row, column), SOUTH, id(row + 1, column), NORTH));
    World::new(cells().map(place).collect(), eastward.chain(southward).collect())
}

fn star(open: [bool; 4]) -> Star {
    let ends = open.iter().enumerate().map(|(position, &open)| StarEnd {
        name: OlpName {
            local_path: position as u32 % 2,
            sign: if position < 2 { Sign::Plus } else { Sign::Minus },
        },
        passability: if open { Passability::Travelable } else { Passability::Closed },
        label: None,
    });
    Star::new(ends).expect("0+ 1+ 0- 1- is a star")
}

fn star_name(open: [bool; 4]) -> String {
    let letters: String =
        "NESW".chars().zip(open).filter(|(_, open)| *open).map(|(letter, _)| letter).collect();
    let straight = (open[0] && open[2]) || (open[1] && open[3]);
    match letters.len() {
        4 => "+".to_owned(),
        3 => format!("T-{letters}"),
        2 if straight => format!("I-{letters}"),
        2 => format!("L-{letters}"),
        1 => format!("end-{letters}"),
        _ => "shut".to_owned(),
    }
}

/// The snake of section 3.4: rows alternately from the north-west corner, then columns
/// alternately from where the rows ended.
#[must_use]
pub fn snake(rows: u32, columns: u32) -> Vec<PlaceId> {
    let forth_or_back = |back: bool, count: u32, index: u32| if back { count - 1 - index } else { index };
    let by_rows = (0..rows)
        .flat_map(|row| (0..columns).map(move |column| (row, forth_or_back(row % 2 == 1, columns, column))));
    let ended_east = rows % 2 == 1;
    let by_columns = (0..columns).flat_map(|nth| {
        let column = forth_or_back(ended_east, columns, nth);
        (0..rows).map(move |row| (forth_or_back(nth % 2 == 0, rows, row), column))
    });
    let mut cells: Vec<_> = by_rows.chain(by_columns).collect();
    cells.dedup(); // the columns begin where the rows ended
    cells.into_iter().map(|(row, column)| PlaceId(row * columns + column)).collect()
}

/// The 21 travels through the 3×4 grid that give the counts of Figure 3.3.
#[must_use]
pub fn thesis_3x4() -> Vec<PlaceId> {
    #[rustfmt::skip]
    let cells = [
        (0, 0), (0, 1), (1, 1), (2, 1), (2, 2), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3), (2, 2),
        (2, 1), (2, 0), (1, 0), (1, 1), (1, 2), (1, 3), (0, 3), (0, 2), (0, 1), (0, 0), (1, 0),
    ];
    cells.iter().map(|&(row, column)| PlaceId(row * 4 + column)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn a_grid_has_four_corners_and_borders_between_them() {
        for (rows, columns) in [(2, 2), (3, 3), (3, 4), (4, 4), (2, 7)] {
            let world = grid(rows, columns, 8.0).unwrap();
            let count = |gateways: usize| {
                world.places().iter().filter(|place| place.star.gateways().count() == gateways).count() as u32
            };
            assert_eq!(count(2), 4);
            assert_eq!(count(3), 2 * (rows - 2) + 2 * (columns - 2));
            assert_eq!(count(4), (rows - 2) * (columns - 2));
            assert_eq!(world.links().len() as u32, rows * (columns - 1) + columns * (rows - 1));
            assert_eq!(world.paths().len() as u32, rows + columns);
            assert!(world.has_simple_paths());
        }
    }

    #[test]
    fn stars_of_the_3x3_grid() {
        let world = grid(3, 3, 8.0).unwrap();
        let stars: Vec<_> =
            world.places().iter().map(|place| format!("{} {}", place.star_name, place.star)).collect();
        assert_eq!(
            stars,
            [
                "L-ES [<0+,C>, <1+,T>, <0-,T>, <1-,C>]",
                "T-ESW [<0+,C>, <1+,T>, <0-,T>, <1-,T>]",
                "L-SW [<0+,C>, <1+,C>, <0-,T>, <1-,T>]",
                "T-NES [<0+,T>, <1+,T>, <0-,T>, <1-,C>]",
                "+ [<0+,T>, <1+,T>, <0-,T>, <1-,T>]",
                "T-NSW [<0+,T>, <1+,C>, <0-,T>, <1-,T>]",
                "L-NE [<0+,T>, <1+,T>, <0-,C>, <1-,C>]",
                "T-NEW [<0+,T>, <1+,T>, <0-,C>, <1-,T>]",
                "L-NW [<0+,T>, <1+,C>, <0-,C>, <1-,T>]",
            ]
        );
    }

    #[test]
    fn every_link_leaves_by_its_bearing() {
        let world = grid(3, 4, 8.0).unwrap();
        for gateway in world.gateways() {
            let way = world.way(gateway).unwrap();
            let bearing = world.place(gateway.place).bearings[gateway.olp.index()];
            assert_eq!(way[0].bearing_to(way[1]), bearing);
            assert_eq!(world.way_length(gateway), Some(8.0));
        }
    }

    #[test]
    fn the_published_routes_have_16_21_and_30_travels_and_take_every_link() {
        for (rows, columns, places, travels) in
            [(3, 3, snake(3, 3), 16), (3, 4, thesis_3x4(), 21), (4, 4, snake(4, 4), 30)]
        {
            let world = grid(rows, columns, 8.0).unwrap();
            let route = world.route_through(&places).unwrap();
            assert_eq!(route.exits.len(), travels);
            assert_eq!(world.visits(&route).unwrap(), places);
            let crossings = world.follow_route(&route).unwrap();
            let links: BTreeSet<_> = crossings.iter().map(|&(exit, _)| world.link_index(exit)).collect();
            assert_eq!(links.len(), world.links().len());
        }
    }

    #[test]
    fn refuses_empty_grids() {
        assert!(grid(0, 3, 8.0).is_err());
        assert!(grid(3, 0, 8.0).is_err());
        assert_eq!(grid(3, 3, -1.0).unwrap_err().to_string(), "the spacing is -1, it must be positive");
        assert!(grid(1, 1, 8.0).is_ok());
    }
}
