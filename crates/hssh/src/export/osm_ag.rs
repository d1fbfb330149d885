//! The area graph of osmAG: areas and passages as ways of OpenStreetMap.

use std::fmt::Write;

use super::region_names;
use crate::account::PlacesAccount;

/// Metres in a degree of latitude, and of longitude at the equator, where the map is put: on a sphere with the
/// equatorial radius of WGS 84.
const METRES_PER_DEGREE: f64 = 6_378_137.0 * std::f64::consts::PI / 180.0;

/// Regions as areas and gateways as passages. The map's origin is the node named `root`, at latitude and longitude 0;
/// a degree is 111,319.49 m in both directions. Holes are left out, for an area has one ring.
#[must_use]
pub fn osm_ag(account: &PlacesAccount) -> String {
    let names = region_names(account);
    let mut nodes = Vec::from([[0.0, 0.0]]);
    let mut ways = String::new();
    let mut number = 0;
    let mut add = |corners: &[[f64; 2]], is_closed: bool, tags: &[(&str, &str)]| {
        let first = nodes.len();
        nodes.extend(corners);
        number += 1;
        let _ = writeln!(ways, "  <way id=\"-{}\" version=\"1\">", number + 1_000_000_000_u64);
        let again = is_closed.then_some(first);
        for node in (first..nodes.len()).chain(again) {
            let _ = writeln!(ways, "    <nd ref=\"-{}\"/>", node + 1);
        }
        for (key, value) in tags {
            let _ = writeln!(ways, "    <tag k=\"{key}\" v=\"{}\"/>", escaped(value));
        }
        ways.push_str("  </way>\n");
    };
    for (region, name) in account.regions.iter().zip(&names) {
        let Some(ring) = region.outline.first() else { continue };
        let areatype = if region.kind == "corridor" { "corridor" } else { "room" };
        let tags = [
            ("name", name.as_str()),
            ("indoor", areatype),
            ("level", "1"),
            ("osmAG:type", "area"),
            ("osmAG:areatype", areatype),
        ];
        add(ring, true, &tags);
    }
    for (passage, about) in account.passages.iter().enumerate() {
        let [from, to] = about.regions.map(|region| names[region as usize].as_str());
        let name = format!("{} {passage}", about.kind);
        let tags = [
            ("name", name.as_str()),
            ("level", "1"),
            ("osmAG:type", "passage"),
            ("osmAG:from", from),
            ("osmAG:to", to),
        ];
        add(&about.gateway.line, false, &tags);
    }
    let mut text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<osm version=\"0.6\" generator=\"hssh\">\n".to_owned();
    for (node, [x, y]) in nodes.iter().enumerate() {
        let place = format!(
            "  <node id=\"-{}\" version=\"1\" lat=\"{:.11}\" lon=\"{:.11}\"",
            node + 1,
            y / METRES_PER_DEGREE,
            x / METRES_PER_DEGREE
        );
        text += &place;
        text += if node == 0 { ">\n    <tag k=\"name\" v=\"root\"/>\n  </node>\n" } else { "/>\n" };
    }
    text + &ways + "</osm>\n"
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
