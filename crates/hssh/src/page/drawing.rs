//! Where the places of a map are drawn.

use hssh_topology::{Olp, PlaceId};

use super::data::{PageMap, PagePlace};
use super::image::rounded;
use crate::answer::{AnsweredMap, AnsweredPlace, MapPicture, PictureError};

/// A map of the ranking, drawn where its places are, or as a scheme.
pub(super) fn page_map(map: &AnsweredMap) -> Result<PageMap, PictureError> {
    let picture = MapPicture::new(map, None)?;
    let (grown, drawing) = (picture.map(), picture.drawing());
    let place = |(number, answered): (u32, &AnsweredPlace)| {
        let place = PlaceId::new(number);
        let pose = drawing.pose(place);
        let direction = |end: u32| rounded(drawing.direction(grown.olp(place, Olp::new(end))));
        PagePlace {
            x: rounded(pose.x),
            y: rounded(pose.y),
            directions: (0..answered.ends.len() as u32).map(direction).collect(),
            ellipse: answered.pose.and_then(|pose| pose.covariance).map(ellipse),
        }
    };
    Ok(PageMap {
        rank: map.rank,
        branch: map.branch.clone(),
        optimal: map.optimal,
        tied: map.tied,
        probability: map.probability,
        costs: map.costs.clone(),
        measure: map.measure,
        closed: map.closed,
        difference: map.difference.clone(),
        measured: map.places.iter().all(|place| place.pose.is_some()),
        places: (0..).zip(&map.places).map(place).collect(),
        grid: None,
        way: Vec::new(),
    })
}

/// Half the axes of the ellipse that holds a point with a probability of 95 %, and the direction of the greater.
fn ellipse(covariance: [[f64; 3]; 3]) -> [f64; 3] {
    /// −2 ln 0.05: what χ² with two degrees of freedom exceeds once in twenty times.
    const CHI2: f64 = 5.991_464_547_107_98;
    let [[xx, xy, _], [_, yy, _], _] = covariance;
    let (middle, half) = ((xx + yy) / 2.0, ((xx - yy) / 2.0).hypot(xy));
    let axis = |variance: f64| rounded((CHI2 * variance.max(0.0)).sqrt());
    [axis(middle + half), axis(middle - half), rounded(0.5 * (2.0 * xy).atan2(xx - yy))]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ellipse_has_the_axes_of_its_covariance() {
        let [long, short, turn] = ellipse([[4.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]]);
        assert_eq!([long, short, turn], [4.895, 2.448, 0.0]);
        // The same turned by a quarter of a right angle: R diag(4, 1) Rᵀ.
        let (sin, cos) = (std::f64::consts::FRAC_PI_8.sin(), std::f64::consts::FRAC_PI_8.cos());
        let (xx, yy, xy) = (4.0 * cos * cos + sin * sin, 4.0 * sin * sin + cos * cos, 3.0 * sin * cos);
        assert_eq!(ellipse([[xx, xy, 0.0], [xy, yy, 0.0], [0.0; 3]]), [4.895, 2.448, 0.393]);
    }
}
