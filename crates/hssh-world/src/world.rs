//! Worlds: places with positions and stars, and links between their gateways.

use std::f64::consts::TAU;
use std::fmt;

use hssh_topology::{Olp, Star};

use crate::geometry::{Point, length};

/// A place of one world: its position in [`World::places`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct PlaceId(pub u32);

impl PlaceId {
    /// The place as an index into [`World::places`].
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A place as it truly is.
#[derive(Clone, PartialEq, Debug)]
pub struct Place {
    /// A name for people.
    pub name: String,
    /// Where its frame has its origin. The frame's axes are the world's.
    pub position: Point,
    /// What the robot sees here.
    pub star: Star,
    /// What the robot calls a star like this one, such as `L-ES`.
    pub star_name: String,
    /// One bearing per end of the star, radians counterclockwise from east.
    pub bearings: Vec<f64>,
}

/// An oriented local path of a place of the world.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct WorldOlp {
    /// The place.
    pub place: PlaceId,
    /// The oriented local path of its star.
    pub olp: Olp,
}

/// A corridor or street: two gateways and the way between them.
#[derive(Clone, PartialEq, Debug)]
pub struct Link {
    /// The gateways it joins; they may belong to one place (a loop).
    pub ends: [WorldOlp; 2],
    /// Where the way bends between the two places, from the first end to the second.
    pub bends: Vec<Point>,
}

/// A simulated world.
///
/// Every gateway has exactly one link, so the world is a closed map. Parallel links are allowed,
/// and so are loops: links that join two gateways of one place. Whether a mapper's axioms hold is
/// another question, see [`World::has_simple_paths`].
#[derive(Clone, PartialEq, Debug)]
pub struct World {
    places: Vec<Place>,
    links: Vec<Link>,
    /// `link_at[place][olp]`: the link there and which of its two ends it is.
    link_at: Vec<Vec<Option<(usize, usize)>>>,
}

/// Two ends of a star never point the same way to this precision, in radians.
const SAME_BEARING: f64 = 1e-9;

/// Why places and links make no world.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum WorldError {
    /// Nothing there, or too little.
    #[error("a world needs at least {needed} place(s), this one has {given}")]
    TooSmall {
        /// How many places there must be.
        needed: usize,
        /// How many there are.
        given: usize,
    },
    /// A parameter is outside its range.
    #[error("{parameter} is {value}, it must be {range}")]
    Parameter {
        /// Which parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// NaN or infinite.
    #[error("{0} is not finite")]
    NotFinite(String),
    /// A place has another number of bearings than ends.
    #[error("place `{place}` has {ends} ends but {bearings} bearings")]
    BearingCount {
        /// The place's name.
        place: String,
        /// How many ends its star has.
        ends: usize,
        /// How many bearings were given.
        bearings: usize,
    },
    /// Bearings that contradict the star's order, or coincide.
    #[error("place `{0}`: the bearings of its ends do not go around clockwise once, or two of them coincide")]
    NotClockwise(String),
    /// A link names a place, or an end of a place, that does not exist or is closed.
    #[error("link {link} ends at {gateway}, where there is no gateway")]
    NoGateway {
        /// The link, counted from 0.
        link: usize,
        /// The end that is missing.
        gateway: WorldOlp,
    },
    /// Two links, or both ends of one, use a gateway.
    #[error("gateway {gateway} of place `{place}` is used by link {first} and again by link {second}")]
    LinkedTwice {
        /// The gateway.
        gateway: WorldOlp,
        /// The place's name.
        place: String,
        /// The link that came first, counted from 0.
        first: usize,
        /// The link that came second.
        second: usize,
    },
    /// A travelable end leads nowhere.
    #[error("gateway {gateway} of place `{place}` leads nowhere: close it or link it")]
    NotLinked {
        /// The gateway.
        gateway: WorldOlp,
        /// The place's name.
        place: String,
    },
    /// A crossing without streets has no star.
    #[error("crossing `{0}` has no street: leave it out")]
    NoStreet(String),
}

impl fmt::Display for WorldOlp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.place.0, self.olp)
    }
}

impl World {
    /// A world from its places and links.
    ///
    /// # Errors
    /// If there is no place, a number is not finite, a place's bearings do not match its star, or a
    /// gateway has no link or more than one.
    pub fn new(places: Vec<Place>, links: Vec<Link>) -> Result<Self, WorldError> {
        if places.is_empty() {
            return Err(WorldError::TooSmall { needed: 1, given: 0 });
        }
        places.iter().try_for_each(check_place)?;
        let mut link_at: Vec<Vec<_>> = places.iter().map(|place| vec![None; place.bearings.len()]).collect();
        for (index, link) in links.iter().enumerate() {
            if !link.bends.iter().all(|bend| bend.is_finite()) {
                return Err(WorldError::NotFinite(format!("a bend of link {index}")));
            }
            for (side, &gateway) in link.ends.iter().enumerate() {
                let Some(place) =
                    places.get(gateway.place.index()).filter(|place| has_gateway(place, gateway.olp))
                else {
                    return Err(WorldError::NoGateway { link: index, gateway });
                };
                let slot = &mut link_at[gateway.place.index()][gateway.olp.index()];
                if let Some((first, _)) = *slot {
                    let place = place.name.clone();
                    return Err(WorldError::LinkedTwice { gateway, place, first, second: index });
                }
                *slot = Some((index, side));
            }
        }
        let world = World { places, links, link_at };
        let loose = world.gateways().find(|&gateway| world.neighbor(gateway).is_none());
        match loose {
            Some(gateway) => {
                let place = world.place(gateway.place).name.clone();
                Err(WorldError::NotLinked { gateway, place })
            }
            None => Ok(world),
        }
    }

    /// The places, in the order in which [`PlaceId`] counts them.
    #[must_use]
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// A place.
    ///
    /// # Panics
    /// If the world has no such place.
    #[must_use]
    pub fn place(&self, place: PlaceId) -> &Place {
        &self.places[place.index()]
    }

    /// The identifiers of all places.
    pub fn place_ids(&self) -> impl ExactSizeIterator<Item = PlaceId> + use<> {
        (0..self.places.len() as u32).map(PlaceId)
    }

    /// The links.
    #[must_use]
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// All gateways, by place and clockwise.
    pub fn gateways(&self) -> impl Iterator<Item = WorldOlp> + '_ {
        self.place_ids().flat_map(|place| self.gateways_of(place))
    }

    /// The gateways of one place, clockwise.
    pub fn gateways_of(&self, place: PlaceId) -> impl Iterator<Item = WorldOlp> + '_ {
        self.place(place).star.gateways().map(move |olp| WorldOlp { place, olp })
    }

    /// The gateway at the other end of a gateway's link; `None` if the end is closed, or is no
    /// end of this world.
    #[must_use]
    pub fn neighbor(&self, gateway: WorldOlp) -> Option<WorldOlp> {
        let (link, side) = self.link_and_side(gateway)?;
        Some(self.links[link].ends[1 - side])
    }

    /// Which of [`World::links`] a gateway has, `None` as for [`World::neighbor`].
    #[must_use]
    pub fn link_index(&self, gateway: WorldOlp) -> Option<usize> {
        self.link_and_side(gateway).map(|(link, _)| link)
    }

    /// The way out of a gateway: from the place's position by the bends to the neighbor's
    /// position; `None` as for [`World::neighbor`].
    #[must_use]
    pub fn way(&self, gateway: WorldOlp) -> Option<Vec<Point>> {
        let (link, side) = self.link_and_side(gateway)?;
        let Link { ends, bends } = &self.links[link];
        let mut way = vec![self.place(ends[0].place).position];
        way.extend(bends);
        way.push(self.place(ends[1].place).position);
        if side == 1 {
            way.reverse();
        }
        Some(way)
    }

    /// The length of the way out of a gateway in metres; `None` as for [`World::neighbor`].
    #[must_use]
    pub fn way_length(&self, gateway: WorldOlp) -> Option<f64> {
        self.way(gateway).map(|way| length(&way))
    }

    fn link_and_side(&self, gateway: WorldOlp) -> Option<(usize, usize)> {
        *self.link_at.get(gateway.place.index())?.get(gateway.olp.index())?
    }
}

fn check_place(place: &Place) -> Result<(), WorldError> {
    let (ends, bearings) = (place.star.ends().len(), place.bearings.len());
    if ends != bearings {
        return Err(WorldError::BearingCount { place: place.name.clone(), ends, bearings });
    }
    if !place.position.is_finite() {
        return Err(WorldError::NotFinite(format!("the position of place `{}`", place.name)));
    }
    if !place.bearings.iter().all(|bearing| bearing.is_finite()) {
        return Err(WorldError::NotFinite(format!("a bearing at place `{}`", place.name)));
    }
    if !is_clockwise(&place.bearings) {
        return Err(WorldError::NotClockwise(place.name.clone()));
    }
    Ok(())
}

/// Whether turning clockwise from each bearing to the next one comes around exactly once.
fn is_clockwise(bearings: &[f64]) -> bool {
    let next = bearings.iter().cycle().skip(1);
    let turns: Vec<f64> = bearings.iter().zip(next).map(|(from, to)| (from - to).rem_euclid(TAU)).collect();
    let apart = turns.iter().all(|&turn| turn > SAME_BEARING && turn < TAU - SAME_BEARING);
    apart && turns.iter().sum::<f64>() < 1.5 * TAU
}

fn has_gateway(place: &Place, olp: Olp) -> bool {
    olp.number() < place.star.degree() && place.star.is_travelable(olp)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(star: &str) -> Place {
        let star: Star = star.parse().unwrap();
        let step = TAU / f64::from(star.degree());
        let bearings = (0..star.degree()).map(|position| -step * f64::from(position)).collect();
        Place { name: "p".into(), position: Point::new(0.0, 0.0), star, star_name: "s".into(), bearings }
    }

    fn link(from: (u32, u32), to: (u32, u32)) -> Link {
        let gateway = |(place, olp)| WorldOlp { place: PlaceId(place), olp: Olp::new(olp) };
        Link { ends: [gateway(from), gateway(to)], bends: Vec::new() }
    }

    #[test]
    fn loops_and_parallel_links_are_worlds() {
        let one =
            World::new(vec![place("0+ 1+ 0- 1-")], vec![link((0, 0), (0, 1)), link((0, 2), (0, 3))]).unwrap();
        for gateway in one.gateways() {
            let far = one.neighbor(gateway).unwrap();
            assert_ne!(far, gateway);
            assert_eq!(one.neighbor(far), Some(gateway));
        }
        let two = vec![place("0+ 0-"), place("0+ 0-")];
        assert!(World::new(two, vec![link((0, 0), (1, 1)), link((0, 1), (1, 0))]).is_ok());
    }

    #[test]
    fn refuses_what_is_no_world() {
        let error = |places, links| World::new(places, links).unwrap_err().to_string();
        assert_eq!(error(vec![], vec![]), "a world needs at least 1 place(s), this one has 0");
        assert_eq!(
            error(vec![place("0+ (0-)")], vec![]),
            "gateway 0:0 of place `p` leads nowhere: close it or link it"
        );
        let ends = || vec![place("0+ (0-)"), place("0+ (0-)")];
        assert_eq!(
            error(ends(), vec![link((0, 0), (1, 1))]),
            "link 0 ends at 1:1, where there is no gateway"
        );
        assert_eq!(
            error(ends(), vec![link((0, 0), (7, 0))]),
            "link 0 ends at 7:0, where there is no gateway"
        );
        assert_eq!(
            error(ends(), vec![link((0, 0), (1, 0)), link((0, 0), (1, 0))]),
            "gateway 0:0 of place `p` is used by link 0 and again by link 1"
        );
        let mut odd = place("0+ (0-)");
        odd.bearings.pop();
        assert_eq!(error(vec![odd], vec![]), "place `p` has 2 ends but 1 bearings");
        let mut counterclockwise = place("0+ 1+ 0- 1-");
        counterclockwise.bearings.reverse();
        assert!(error(vec![counterclockwise], vec![]).contains("do not go around clockwise once"));
        let mut coincident = place("0+ 1+ 0- 1-");
        coincident.bearings[1] = 0.0;
        assert!(error(vec![coincident], vec![]).contains("or two of them coincide"));
        let mut lost = place("(0+) (0-)");
        lost.position.x = f64::NAN;
        assert_eq!(error(vec![lost], vec![]), "the position of place `p` is not finite");
    }
}
