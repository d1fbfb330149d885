//! The area graph of osmAG: areas and passages as ways of OpenStreetMap.

use super::areas::AreaGraph;
use super::xml::XmlText;

/// Metres in a degree of latitude, and of longitude at the equator, where the map is put: on a sphere with the
/// equatorial radius of WGS 84.
const METRES_PER_DEGREE: f64 = 6_378_137.0 * std::f64::consts::PI / 180.0;
/// The ids of ways begin behind those of all nodes.
const FIRST_WAY: u64 = 1_000_000_000;

/// Areas as closed ways and passages as ways with two nodes. The map's origin is the node named `root`, at latitude and longitude 0; a
/// degree is 111,319.49 m in both directions. Some readers want `osmAG:areaType`, others `osmAG:areatype`: both are there.
#[must_use]
pub fn osm_ag(graph: &AreaGraph) -> String {
    let mut ways = Ways { nodes: vec![[0.0, 0.0]], ways: Vec::new() };
    for area in &graph.areas {
        let kind = area.kind.as_str();
        ways.add(
            &area.ring,
            true,
            &[
                ("name", &area.name),
                ("indoor", kind),
                ("level", "1"),
                ("osmAG:type", "area"),
                ("osmAG:areatype", kind),
                ("osmAG:areaType", kind),
            ],
        );
    }
    for passage in &graph.passages {
        let [from, to] = passage.between.map(|area| graph.areas[area].name.as_str());
        ways.add(
            &passage.line,
            false,
            &[
                ("name", &passage.name),
                ("level", "1"),
                ("osmAG:type", "passage"),
                ("osmAG:from", from),
                ("osmAG:to", to),
            ],
        );
    }
    let facts = graph.provenance.facts();
    let facts: Vec<(String, String)> =
        facts.into_iter().map(|(name, fact)| (format!("hssh:{name}"), fact.to_string())).collect();
    let mut text = XmlText::new();
    text.within("osm", &[("version", "0.6"), ("generator", &graph.provenance.generator)], |text| {
        ways.write_nodes(&facts, text);
        ways.write_ways(text);
    });
    text.done()
}

/// Corners and ways until all corners are known.
struct Ways {
    nodes: Vec<[f64; 2]>,
    ways: Vec<Way>,
}

struct Way {
    nodes: Vec<usize>,
    tags: Vec<(&'static str, String)>,
}

impl Ways {
    fn add(&mut self, corners: &[[f64; 2]], is_closed: bool, tags: &[(&'static str, &str)]) {
        let first = self.nodes.len();
        self.nodes.extend(corners);
        let again = is_closed.then_some(first);
        let tags = tags.iter().map(|&(key, value)| (key, value.to_owned())).collect();
        self.ways.push(Way { nodes: (first..self.nodes.len()).chain(again).collect(), tags });
    }

    /// The first is the root, which also tells where the map comes from.
    fn write_nodes(&self, facts: &[(String, String)], text: &mut XmlText) {
        for (number, [x, y]) in self.nodes.iter().enumerate() {
            let id = node_id(number);
            let [lat, lon] = [y, x].map(|metres| format!("{:.11}", metres / METRES_PER_DEGREE + 0.0));
            let attributes = [
                ("id", id.as_str()),
                ("version", "1"),
                ("action", "modify"),
                ("visible", "true"),
                ("lat", &lat),
                ("lon", &lon),
            ];
            if number > 0 {
                text.empty("node", &attributes);
                continue;
            }
            text.within("node", &attributes, |text| {
                text.empty("tag", &[("k", "name"), ("v", "root")]);
                for (key, value) in facts {
                    text.empty("tag", &[("k", key), ("v", value)]);
                }
            });
        }
    }

    fn write_ways(&self, text: &mut XmlText) {
        for (number, way) in (1..).zip(&self.ways) {
            let id = format!("-{}", FIRST_WAY + number);
            let attributes =
                [("id", id.as_str()), ("version", "1"), ("action", "modify"), ("visible", "true")];
            text.within("way", &attributes, |text| {
                for &node in &way.nodes {
                    text.empty("nd", &[("ref", &node_id(node))]);
                }
                for (key, value) in &way.tags {
                    text.empty("tag", &[("k", key), ("v", value)]);
                }
            });
        }
    }
}

fn node_id(number: usize) -> String {
    format!("-{}", number + 1)
}
