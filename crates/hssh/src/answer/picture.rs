//! Pictures of answered maps: as SVG and as Graphviz DOT.

use hssh_draw::{
    Bearings, BuildingPicture, Drawing, DrawingError, MapOptions, RegionPicture, draw_map, map_to_dot,
};
use hssh_local::RegionNumber;
use hssh_metrics::Pose;
use hssh_topology::{PlaceId, TopologicalMap};
use nalgebra::Matrix2;

use super::building::{AnsweredBuilding, AnsweredRegion};
use super::error::DisagreementError;
use super::map::AnsweredMap;
use super::rebuild::RebuiltMap;

/// A map ready to be drawn.
#[derive(Clone, Debug)]
pub struct MapPicture {
    rebuilt: RebuiltMap,
    drawing: Drawing,
    options: MapOptions,
}

/// Why a map cannot be drawn.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum PictureError {
    /// It is no map.
    #[error(transparent)]
    Map(#[from] DisagreementError),
    /// It cannot be laid out.
    #[error("cannot lay out the map: {0}")]
    Drawing(#[from] DrawingError),
}

impl MapPicture {
    /// The picture of a map under a title: with its places where they are if that is known, else in a schematic drawing.
    ///
    /// # Errors
    /// If the visits of the map do not lead to it, or it cannot be laid out.
    pub fn new(map: &AnsweredMap, title: Option<String>) -> Result<Self, PictureError> {
        let rebuilt = map.rebuild()?;
        let bearings = map.places.iter().map(|place| place.ends.iter().map(|end| end.bearing).collect());
        let bearings = Bearings(bearings.collect());
        let placed: Option<Vec<Pose>> = map
            .places
            .iter()
            .map(|place| place.pose.map(|pose| Pose { x: pose.x, y: pose.y, theta: pose.theta }))
            .collect();
        let drawing = match placed {
            Some(poses) => {
                let drawing = Drawing::measured(&rebuilt.map, poses, &bearings)?;
                along_ways(drawing.with_covariances(covariances(map)), map, &rebuilt.map)?
            }
            None => Drawing::schematic(&rebuilt.map, &bearings)?,
        };
        let options = MapOptions {
            title,
            current: Some(PlaceId::new(map.current.place)),
            star_names: map.places.iter().map(|place| place.star.clone()).collect(),
            ..MapOptions::default()
        };
        Ok(MapPicture { rebuilt, drawing, options })
    }

    /// The map, grown as it was found.
    #[must_use]
    pub fn map(&self) -> &TopologicalMap {
        &self.rebuilt.map
    }

    /// Where its places are drawn, and which way their ends point.
    #[must_use]
    pub fn drawing(&self) -> &Drawing {
        &self.drawing
    }

    /// The same picture with the building under it, in whose frame the map is: that of the answer, under its first map.
    #[must_use]
    pub fn in_building(mut self, building: &AnsweredBuilding) -> Self {
        let region = |(number, region): (u32, &AnsweredRegion)| {
            let [red, green, blue] = RegionNumber(number).color();
            RegionPicture {
                rings: region.outline.iter().chain(&region.holes).cloned().collect(),
                color: format!("#{red:02x}{green:02x}{blue:02x}"),
                // Of what was only seen, there may be much and small.
                name: if region.stays > 0 { region.title(number as usize) } else { String::new() },
            }
        };
        let doors = building.passages.iter().filter(|passage| passage.kind == "door");
        self.options.building = Some(BuildingPicture {
            regions: (0..).zip(&building.regions).map(region).collect(),
            doors: doors.map(|door| door.line).collect(),
        });
        self
    }

    /// As SVG.
    #[must_use]
    pub fn to_svg(&self) -> String {
        draw_map(&self.rebuilt.map, &self.drawing, &self.options)
    }

    /// For Graphviz.
    #[must_use]
    pub fn to_dot(&self) -> String {
        map_to_dot(&self.rebuilt.map, &self.rebuilt.catalog, &self.options)
    }
}

/// The drawing with links along the ways that were driven, where these are known.
fn along_ways(
    drawing: Drawing,
    map: &AnsweredMap,
    grown: &TopologicalMap,
) -> Result<Drawing, DisagreementError> {
    let sketch = map.sketch()?;
    let ends = sketch.links.iter().map(|&(from, to)| [from, to].map(|end| grown.olp(end.place, end.olp)));
    let driven = ends.zip(&map.links).filter(|(_, link)| !link.way.is_empty());
    Ok(drawing.with_ways(driven.map(|(ends, link)| (ends, link.way.clone()))))
}

/// Of the position of each place, if they are known.
fn covariances(map: &AnsweredMap) -> Vec<Matrix2<f64>> {
    let position = |covariance: [[f64; 3]; 3]| Matrix2::from_fn(|row, column| covariance[row][column]);
    let all = map.places.iter().map(|place| Some(position(place.pose?.covariance?)));
    all.collect::<Option<_>>().unwrap_or_default()
}
