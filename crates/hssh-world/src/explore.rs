//! Explorations of a world: what a robot on a route sees and does (section 2.3).

use std::f64::consts::PI;

use hssh_causal::{Exploration, NamedStar, Odometry, StarType, Travel};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::geometry::wrap;
use crate::noise::OdometryNoise;
use crate::route::{Route, RouteError};
use crate::world::{Place, World, WorldOlp};

/// Two places share a star type only if their bearings agree to this, in radians.
const SAME_BEARING: f64 = 1e-9;

impl World {
    /// What a robot on this route sees and does, without odometry.
    ///
    /// Star types are numbered in the order in which they are met. Places share one if they have
    /// the same star, the same name for it and the same bearings to 1e-9 rad. A name that is taken
    /// by another star type gets a number: `3-way`, `3-way-2`.
    ///
    /// # Errors
    /// If the route starts outside the world or leaves a place where there is no gateway.
    pub fn explore(&self, route: &Route) -> Result<Exploration, RouteError> {
        let crossings = self.follow_route(route)?;
        let without = vec![None; crossings.len()];
        Ok(self.write_down(route, &crossings, without))
    }

    /// What a robot on this route sees, does and measures.
    ///
    /// Each travel's odometry is the arrival place's frame as seen from the departure place's
    /// frame, disturbed as the model of noise says. The same arguments give the same exploration.
    ///
    /// # Errors
    /// As [`World::explore`], and if the model is none.
    pub fn explore_with_odometry(
        &self,
        route: &Route,
        noise: &impl OdometryNoise,
        seed: u64,
    ) -> Result<Exploration, RouteError> {
        noise.check()?;
        let crossings = self.follow_route(route)?;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut heading = None; // how the robot stands at the place; unknown before the first travel
        let odometry = crossings
            .iter()
            .map(|&(exit, entry)| {
                let turn = heading.map_or(0.0, |heading| wrap(self.bearing(exit) - heading).abs());
                heading = Some(self.bearing(entry) + PI);
                let way = self.way(exit)?;
                Some(noise.measure(turn, &way, &mut random))
            })
            .collect();
        Ok(self.write_down(route, &crossings, odometry))
    }

    fn write_down(
        &self,
        route: &Route,
        crossings: &[(WorldOlp, WorldOlp)],
        odometry: Vec<Option<Odometry>>,
    ) -> Exploration {
        let mut star_types = Vec::new();
        let start = star_type(&mut star_types, self.place(route.start));
        let travels = crossings
            .iter()
            .zip(odometry)
            .map(|(&(exit, entry), odometry)| Travel {
                exit: exit.olp,
                entry: entry.olp,
                star: star_type(&mut star_types, self.place(entry.place)),
                odometry,
            })
            .collect();
        Exploration::new(star_types, start, travels).expect(
            "names are made unique, links join gateways, and a checked model of noise has positive variances",
        )
    }

    fn bearing(&self, gateway: WorldOlp) -> f64 {
        self.place(gateway.place).bearings[gateway.olp.index()]
    }
}

/// The type of a place's star, which is added if it was not met before.
fn star_type(star_types: &mut Vec<NamedStar>, place: &Place) -> StarType {
    let stem = |name: &str| name == place.star_name || is_numbered(name, &place.star_name);
    let known = star_types
        .iter()
        .position(|known| stem(&known.name) && known.star == place.star && same_bearings(known, place));
    let index = known.unwrap_or_else(|| {
        star_types.push(NamedStar {
            name: free_name(star_types, &place.star_name),
            star: place.star.clone(),
            bearings: place.bearings.iter().copied().map(Some).collect(),
        });
        star_types.len() - 1
    });
    StarType(index as u32)
}

fn same_bearings(known: &NamedStar, place: &Place) -> bool {
    let same = |(a, b): (&Option<f64>, &f64)| a.is_some_and(|a| wrap(a - b).abs() <= SAME_BEARING);
    known.bearings.iter().zip(&place.bearings).all(same)
}

/// `stem`, or the first of `stem-2`, `stem-3`, … that no star type has.
fn free_name(star_types: &[NamedStar], stem: &str) -> String {
    let taken = |name: &str| star_types.iter().any(|known| known.name == name);
    let numbered = (2u32..).map(|number| format!("{stem}-{number}"));
    std::iter::once(stem.to_owned())
        .chain(numbered)
        .find(|name| !taken(name))
        .expect("there are fewer star types than numbers")
}

fn is_numbered(name: &str, stem: &str) -> bool {
    let number = name.strip_prefix(stem).and_then(|rest| rest.strip_prefix('-'));
    number.is_some_and(|number| number.parse::<u32>().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DriftModel, grid, momepy, random_planar, random_walk, snake};

    #[test]
    fn what_is_written_down_is_what_is_there() {
        for seed in 0..40 {
            let world = random_planar(9, 0.4, 10.0, seed).unwrap();
            let route = random_walk(&world, 20, seed);
            let exploration = world.explore(&route).unwrap();
            let visits = world.visits(&route).unwrap();
            for (star_type, &place) in exploration.visits().zip(&visits) {
                assert_eq!(exploration.star(star_type), &world.place(place).star);
            }
            for (travel, pair) in exploration.travels().iter().zip(visits.windows(2)) {
                let exit = WorldOlp { place: pair[0], olp: travel.exit };
                assert_eq!(world.neighbor(exit), Some(WorldOlp { place: pair[1], olp: travel.entry }));
            }
        }
    }

    #[test]
    fn star_types_are_shared_where_bearings_agree() {
        let world = grid(4, 4, 8.0).unwrap();
        let route = world.route_through(&snake(4, 4)).unwrap();
        let exploration = world.explore(&route).unwrap();
        let names: Vec<_> = exploration.star_types().iter().map(|named| named.name.as_str()).collect();
        assert_eq!(names, ["L-ES", "T-ESW", "L-SW", "T-NSW", "+", "T-NES", "L-NW", "T-NEW", "L-NE"]);

        // The same stars, but the second bend is skew: two types, told apart by a number.
        let text = "NODE a 0 0\nNODE b 10 0\nNODE c 9 -9\nNODE d 0 -9\n\
                    EDGE a b 2 0 0 10 0\nEDGE b c 2 10 0 9 -9\nEDGE c d 2 9 -9 0 -9\nEDGE d a 2 0 -9 0 0\n";
        let world = momepy::read(text).unwrap().to_world().unwrap();
        let walk = random_walk(&world, 8, 1);
        let exploration = world.explore(&walk).unwrap();
        let mut names: Vec<_> = exploration.star_types().iter().map(|named| named.name.as_str()).collect();
        names.sort_unstable();
        assert_eq!(names, ["2-way", "2-way-2", "2-way-3", "2-way-4"]);
    }

    #[test]
    fn odometry_is_measured_only_when_asked_for() {
        let world = grid(3, 3, 8.0).unwrap();
        let route = world.route_through(&snake(3, 3)).unwrap();
        let drift = DriftModel::default();
        assert!(world.explore(&route).unwrap().travels().iter().all(|travel| travel.odometry.is_none()));
        let once = world.explore_with_odometry(&route, &drift, 7).unwrap();
        assert!(once.travels().iter().all(|travel| travel.odometry.is_some()));
        assert_eq!(world.explore_with_odometry(&route, &drift, 7), Ok(once.clone()));
        assert_ne!(world.explore_with_odometry(&route, &drift, 8), Ok(once));
        let none = DriftModel { heading_fix: 0.0, ..drift };
        assert!(world.explore_with_odometry(&route, &none, 7).is_err());
    }
}
