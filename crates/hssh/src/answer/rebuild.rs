//! An answered map as the mapper's own data again: to be drawn, and to be checked by others.

use hssh_topology::{
    End, MapSketch, Passability, PendingGateway, PlaceId, Star, StarCatalog, StarEnd, StarError,
    TopologicalMap,
};

use super::error::{DisagreementError, end_name};
use super::map::AnsweredMap;
use super::place::{AnsweredPlace, EndReference, EndState};
use super::visit::Finding;

/// A map as it grew, with its stars: star number i is that of place number i.
#[derive(Clone, Debug)]
pub struct RebuiltMap {
    /// The stars.
    pub catalog: StarCatalog,
    /// The map.
    pub map: TopologicalMap,
}

impl AnsweredPlace {
    /// The star of the place.
    ///
    /// # Errors
    /// If the names of its ends make none.
    pub fn to_star(&self) -> Result<Star, StarError> {
        let ends = self.ends.iter().map(|end| {
            let closed = end.state == EndState::Closed;
            let passability = if closed { Passability::Closed } else { Passability::Travelable };
            Ok(StarEnd { name: end.name.parse()?, passability, label: end.label.clone() })
        });
        Star::new(ends.collect::<Result<Vec<_>, StarError>>()?)
    }
}

impl AnsweredMap {
    /// The map as places and links, for [`hssh_topology::replay`] and [`hssh_topology::violations`].
    ///
    /// # Errors
    /// If a place has no star, or a link an end that does not exist.
    pub fn sketch(&self) -> Result<MapSketch, DisagreementError> {
        let places = self.stars()?;
        let end = |reference: &EndReference| -> Result<End, DisagreementError> {
            let star = places.get(reference.place as usize);
            let olp = star.zip(end_name(&reference.end)).and_then(|(star, name)| star.find(name));
            let olp = olp.ok_or_else(|| DisagreementError::no_such_end(reference))?;
            Ok(End { place: PlaceId::new(reference.place), olp })
        };
        let links = self.links.iter().map(|link| Ok((end(&link.from)?, end(&link.to)?)));
        let links = links.collect::<Result<_, DisagreementError>>()?;
        Ok(MapSketch { places, links })
    }

    /// The map, grown visit by visit as it was found.
    ///
    /// # Errors
    /// If a place has no star, or a visit does not follow from those before it.
    pub fn rebuild(&self) -> Result<RebuiltMap, DisagreementError> {
        let stars = self.stars()?;
        let mut catalog = StarCatalog::new();
        let ids: Vec<_> = stars.iter().map(|star| catalog.add(star)).collect();
        let mut map = TopologicalMap::new();
        for (visit, now) in self.visits.iter().enumerate() {
            let place = now.place as usize;
            let impossible = DisagreementError::Visit { visit };
            if matches!(now.finding, Finding::Start | Finding::NewPlace) {
                if place != map.place_count() as usize || place >= stars.len() {
                    return Err(impossible);
                }
                map.add_place(ids[place], &stars[place]);
            }
            if matches!(now.finding, Finding::NewPlace | Finding::Closure) {
                let before = visit.checked_sub(1).and_then(|before| self.visits.get(before));
                let ends = before.and_then(|before| {
                    let exit = gateway(&map, &stars, before.place, before.exit.as_ref()?)?;
                    Some((exit, gateway(&map, &stars, now.place, now.entry.as_ref()?)?))
                });
                match ends {
                    Some((exit, entry)) if exit != entry => map.link(exit, entry),
                    _ => return Err(impossible),
                }
            }
        }
        Ok(RebuiltMap { catalog, map })
    }

    fn stars(&self) -> Result<Vec<Star>, DisagreementError> {
        let star = |(place, answered): (usize, &AnsweredPlace)| {
            answered.to_star().map_err(|problem| DisagreementError::Star { place, problem })
        };
        self.places.iter().enumerate().map(star).collect()
    }
}

/// A gateway of a map that is still pending.
fn gateway(map: &TopologicalMap, stars: &[Star], place: u32, end: &str) -> Option<PendingGateway> {
    let olp = stars.get(place as usize)?.find(end_name(end)?)?;
    (place < map.place_count()).then(|| map.olp(PlaceId::new(place), olp)).and_then(|olp| map.pending(olp))
}
