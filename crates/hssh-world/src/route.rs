//! Routes: a place to start from and the gateways left by, one travel after the other.

use hssh_topology::Olp;

use crate::noise::DriftError;
use crate::world::{PlaceId, World, WorldOlp};

/// A route through a world.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Route {
    /// Where it begins.
    pub start: PlaceId,
    /// The end of the current place's star by which each travel leaves.
    pub exits: Vec<Olp>,
}

/// Why a route cannot be followed in a world.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum RouteError {
    /// No places at all.
    #[error("the route names no place to start from")]
    Empty,
    /// A place outside the world.
    #[error("place {place} does not exist: the world has {places}")]
    NoSuchPlace {
        /// The place asked for.
        place: u32,
        /// How many there are.
        places: usize,
    },
    /// Two places in succession without a link.
    #[error("travel {travel}: no link leads from place {from} to place {to}, only to {neighbors}")]
    NotLinked {
        /// The travel, counted from 1.
        travel: usize,
        /// The place it should leave.
        from: u32,
        /// The place it should reach.
        to: u32,
        /// The places that can be reached.
        neighbors: String,
    },
    /// Two places in succession with several links.
    #[error(
        "travel {travel}: ends {exits} of place {from} all lead to place {to}; give the route by its exits"
    )]
    SeveralLinks {
        /// The travel, counted from 1.
        travel: usize,
        /// The place it should leave.
        from: u32,
        /// The place it should reach.
        to: u32,
        /// The ends that lead there.
        exits: String,
    },
    /// The robot cannot leave by this end.
    #[error("travel {travel}: end {exit} of place {from} is no gateway; gateways are {gateways}")]
    NoGateway {
        /// The travel, counted from 1.
        travel: usize,
        /// The place it should leave.
        from: u32,
        /// The end asked for.
        exit: u32,
        /// The ends that can be travelled.
        gateways: String,
    },
    /// A route cannot cover a world that is not connected.
    #[error("{travelled} of {links} links can be reached from place {start}: the world is not connected")]
    NotConnected {
        /// Where the route begins.
        start: u32,
        /// How many links it reached.
        travelled: usize,
        /// How many there are.
        links: usize,
    },
    /// The odometry asked for cannot be.
    #[error(transparent)]
    Drift(#[from] DriftError),
}

impl World {
    /// The route that visits these places in succession.
    ///
    /// # Errors
    /// If the list is empty, a place does not exist, or two places in succession are joined by no
    /// link or by several.
    pub fn route_through(&self, places: &[PlaceId]) -> Result<Route, RouteError> {
        let &start = places.first().ok_or(RouteError::Empty)?;
        places.iter().try_for_each(|&place| self.check(place))?;
        let exits = places
            .windows(2)
            .enumerate()
            .map(|(index, pair)| self.only_exit(index + 1, pair[0], pair[1]))
            .collect::<Result<_, _>>()?;
        Ok(Route { start, exits })
    }

    /// The places that a route visits, in order: one more than it has travels.
    ///
    /// # Errors
    /// As [`World::explore`].
    pub fn visits(&self, route: &Route) -> Result<Vec<PlaceId>, RouteError> {
        let crossings = self.follow_route(route)?;
        Ok(std::iter::once(route.start).chain(crossings.into_iter().map(|(_, entry)| entry.place)).collect())
    }

    /// The gateways that a route leaves and enters by.
    pub(crate) fn follow_route(&self, route: &Route) -> Result<Vec<(WorldOlp, WorldOlp)>, RouteError> {
        self.check(route.start)?;
        let mut place = route.start;
        let mut crossings = Vec::new();
        for (index, &olp) in route.exits.iter().enumerate() {
            let exit = WorldOlp { place, olp };
            let entry = self.neighbor(exit).ok_or_else(|| RouteError::NoGateway {
                travel: index + 1,
                from: place.0,
                exit: olp.number(),
                gateways: list(self.gateways_of(place).map(|gateway| gateway.olp.number())),
            })?;
            crossings.push((exit, entry));
            place = entry.place;
        }
        Ok(crossings)
    }

    fn only_exit(&self, travel: usize, from: PlaceId, to: PlaceId) -> Result<Olp, RouteError> {
        let target = |gateway| self.neighbor(gateway).map(|far| far.place);
        let exits: Vec<Olp> =
            self.gateways_of(from).filter(|&exit| target(exit) == Some(to)).map(|exit| exit.olp).collect();
        match exits[..] {
            [exit] => Ok(exit),
            [] => Err(RouteError::NotLinked {
                travel,
                from: from.0,
                to: to.0,
                neighbors: list(self.gateways_of(from).filter_map(target).map(|place| place.0)),
            }),
            _ => Err(RouteError::SeveralLinks {
                travel,
                from: from.0,
                to: to.0,
                exits: list(exits.iter().map(|exit| exit.number())),
            }),
        }
    }

    fn check(&self, place: PlaceId) -> Result<(), RouteError> {
        if place.index() < self.places().len() {
            Ok(())
        } else {
            Err(RouteError::NoSuchPlace { place: place.0, places: self.places().len() })
        }
    }
}

fn list(numbers: impl Iterator<Item = u32>) -> String {
    let numbers: Vec<String> = numbers.map(|number| number.to_string()).collect();
    if numbers.is_empty() { "none".to_owned() } else { numbers.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{grid, momepy};

    #[test]
    fn refuses_what_cannot_be_followed() {
        let world = grid(2, 2, 8.0).unwrap();
        let through = |places: &[u32]| {
            let places: Vec<_> = places.iter().map(|&place| PlaceId(place)).collect();
            world.route_through(&places).unwrap_err().to_string()
        };
        assert_eq!(through(&[]), "the route names no place to start from");
        assert_eq!(through(&[0, 1, 9]), "place 9 does not exist: the world has 4");
        assert_eq!(through(&[0, 1, 2]), "travel 2: no link leads from place 1 to place 2, only to 3, 0");
        let by_exits = Route { start: PlaceId(0), exits: vec![Olp::new(1), Olp::new(0)] };
        assert_eq!(
            world.explore(&by_exits).unwrap_err().to_string(),
            "travel 2: end 0 of place 1 is no gateway; gateways are 2, 3"
        );
    }

    #[test]
    fn parallel_links_want_exits() {
        let text = "NODE a 0 0\nNODE b 8 0\nEDGE a b 2 0 0 8 0\nEDGE a b 3 0 0 4 4 8 0\n";
        let world = momepy::read(text).unwrap().to_world().unwrap();
        let error = world.route_through(&[PlaceId(0), PlaceId(1)]).unwrap_err().to_string();
        assert!(error.contains("all lead to place 1; give the route by its exits"), "{error}");
    }
}
