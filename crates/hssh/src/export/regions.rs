//! Regions, passages and places as GeoJSON in the frame of the map, for whatever draws polygons.

use serde_json::json;

use super::error::ExportError;
use super::geojson::feature;
use super::names::region_names;
use super::provenance::Provenance;
use crate::account::PlacesAccount;

/// Regions as polygons, passages as lines and places as points; coordinates are metres in the frame of the map.
///
/// # Errors
/// If there are no regions: the places of a log have none.
pub fn regions_geojson(account: &PlacesAccount) -> Result<String, ExportError> {
    if account.regions.is_empty() {
        return Err(ExportError::NoRegions);
    }
    let names = region_names(account);
    let mut features = Vec::new();
    for (number, (region, name)) in account.regions.iter().zip(&names).enumerate() {
        // Which ring a hole is in does not matter to who fills by the even-odd rule; the largest is the likely one.
        let mut polygons: Vec<Vec<Vec<[f64; 2]>>> =
            region.outline.iter().map(|ring| vec![closed(ring)]).collect();
        if let Some(largest) = polygons.first_mut() {
            largest.extend(region.holes.iter().map(|ring| closed(ring)));
        }
        let properties = json!({
            "what": "region", "number": number, "kind": region.kind, "name": name, "area": region.area,
            "width": region.width, "color": region.color,
        });
        features.push(feature(properties, "MultiPolygon", json!(polygons)));
    }
    for (number, passage) in account.passages.iter().enumerate() {
        let properties = json!({
            "what": "passage", "number": number, "kind": passage.kind, "door_probability": passage.door_probability,
            "regions": passage.regions, "width": passage.gateway.width,
        });
        features.push(feature(properties, "LineString", json!(passage.gateway.line)));
    }
    for (number, place) in account.places.iter().enumerate() {
        let mut properties =
            json!({ "what": "place", "number": number, "kind": place.kind, "star": place.star });
        if let (Some(region), Some(known)) = (place.region, properties.as_object_mut()) {
            known.insert("region".to_owned(), json!(region));
        }
        features.push(feature(properties, "Point", json!(place.center)));
    }
    let file = json!({
        "type": "FeatureCollection",
        "name": account.name,
        "hssh": Provenance::of_places(account),
        "features": features,
    });
    Ok(file.to_string() + "\n")
}

/// A ring with its first corner repeated, as GeoJSON has it.
fn closed(ring: &[[f64; 2]]) -> Vec<[f64; 2]> {
    ring.iter().chain(ring.first()).copied().collect()
}
