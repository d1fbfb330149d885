//! Reads street networks from GraphML as OSMnx writes it: node data `x`, `y`, edge data `geometry`.

use std::collections::BTreeMap;

use roxmltree::{Document, Node};

use crate::geometry::Point;
use crate::streets::{Crossing, StreetError, StreetNetwork, StreetProblem, number};

/// Reads a street network; coordinates are metres, an edge without geometry is straight.
///
/// # Errors
/// With the line, if the text is no GraphML, a node has no coordinates, an edge ends at an unknown
/// node, or a geometry is no line that joins the edge's two nodes.
pub fn read(text: &str) -> Result<StreetNetwork, StreetError> {
    let document = Document::parse(text).map_err(|error| StreetError {
        line: error.pos().row as usize,
        problem: StreetProblem::Xml(error.to_string()),
    })?;
    let at = |node: Node<'_, '_>| {
        let line = document.text_pos_at(node.range().start).row as usize;
        move |problem| StreetError { line, problem }
    };
    let elements = |name: &'static str| document.descendants().filter(move |node| node.has_tag_name_of(name));
    let keys = Keys(
        elements("key")
            .filter_map(|key| {
                Some(((key.attribute("for")?, key.attribute("attr.name")?), key.attribute("id")?))
            })
            .collect(),
    );

    let mut network = StreetNetwork::default();
    let mut index_of = BTreeMap::new();
    for node in elements("node") {
        let crossing = read_node(node, &keys).map_err(at(node))?;
        if index_of.insert(crossing.name.clone(), network.crossings.len()).is_some() {
            return Err(at(node)(StreetProblem::RepeatedNode(crossing.name)));
        }
        network.crossings.push(crossing);
    }
    for edge in elements("edge") {
        let ends = read_ends(edge, &index_of).map_err(at(edge))?;
        let polyline = match keys.data(edge, "geometry") {
            Some(geometry) => read_line(geometry).map_err(at(edge))?,
            None => ends.map(|end: usize| network.crossings[end].position).to_vec(),
        };
        network.add_street(ends, polyline).map_err(at(edge))?;
    }
    Ok(network)
}

/// Which data key stands for which attribute: (`node` or `edge`, attribute name) → key.
struct Keys<'a>(BTreeMap<(&'a str, &'a str), &'a str>);

impl Keys<'_> {
    fn data<'a>(&self, element: Node<'a, '_>, attribute: &str) -> Option<&'a str> {
        let key = self.0.get(&(element.tag_name().name(), attribute))?;
        element
            .children()
            .find(|child| child.has_tag_name_of("data") && child.attribute("key") == Some(key))?
            .text()
            .map(str::trim)
    }
}

/// Tag names without regard to the namespace, which not all writers declare.
trait TagName {
    fn has_tag_name_of(&self, name: &str) -> bool;
}

impl TagName for Node<'_, '_> {
    fn has_tag_name_of(&self, name: &str) -> bool {
        self.is_element() && self.tag_name().name() == name
    }
}

fn read_node(node: Node<'_, '_>, keys: &Keys<'_>) -> Result<Crossing, StreetProblem> {
    let missing = |field| StreetProblem::Missing { record: "the node", field };
    let name = node.attribute("id").ok_or(missing("id"))?.to_owned();
    let coordinate = |axis| number(axis, keys.data(node, axis).ok_or(missing(axis))?);
    Ok(Crossing { name, position: Point::new(coordinate("x")?, coordinate("y")?) })
}

fn read_ends(edge: Node<'_, '_>, index_of: &BTreeMap<String, usize>) -> Result<[usize; 2], StreetProblem> {
    let end = |field| {
        let name = edge.attribute(field).ok_or(StreetProblem::Missing { record: "the edge", field })?;
        index_of.get(name).copied().ok_or_else(|| StreetProblem::UnknownNode(name.to_owned()))
    };
    Ok([end("source")?, end("target")?])
}

/// The points of `LINESTRING (x1 y1, x2 y2, …)`.
fn read_line(geometry: &str) -> Result<Vec<Point>, StreetProblem> {
    let not_a_line = || StreetProblem::NotALine(geometry.chars().take(60).collect());
    let points = geometry
        .strip_prefix("LINESTRING")
        .and_then(|rest| rest.trim().strip_prefix('(')?.strip_suffix(')'))
        .ok_or_else(not_a_line)?;
    let polyline = points
        .split(',')
        .map(|point| {
            let (x, y) = point.trim().split_once(' ').ok_or_else(not_a_line)?;
            Ok(Point::new(number("a coordinate", x)?, number("a coordinate", y.trim())?))
        })
        .collect::<Result<Vec<_>, _>>()?;
    if polyline.len() < 2 { Err(not_a_line()) } else { Ok(polyline) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(body: &str) -> String {
        format!(
            "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n\
             <key id=\"k0\" for=\"node\" attr.name=\"x\"/><key id=\"k1\" for=\"node\" attr.name=\"y\"/>\n\
             <key id=\"k2\" for=\"edge\" attr.name=\"geometry\"/>\n<graph>\n{body}\n</graph></graphml>"
        )
    }

    const NODES: &str = "<node id=\"a\"><data key=\"k0\">0</data><data key=\"k1\">0</data></node>\
                         <node id=\"b\"><data key=\"k0\">10</data><data key=\"k1\">0</data></node>\n";

    #[test]
    fn reads_straight_and_bent_edges() {
        let edges = "<edge source=\"a\" target=\"b\"/>\
             <edge source=\"a\" target=\"b\"><data key=\"k2\">LINESTRING (10 0, 5 5, 0 0)</data></edge>";
        let network = read(&document(&format!("{NODES}{edges}"))).unwrap();
        assert_eq!(network.streets[0].bends, []);
        assert_eq!(network.streets[1].bends, [Point::new(5.0, 5.0)]);
        assert_eq!(network.to_world().unwrap().links().len(), 2);
    }

    #[test]
    fn says_where_and_what_is_wrong() {
        let error = |body: &str| read(&document(&format!("{NODES}{body}"))).unwrap_err().to_string();
        assert!(
            read("<graphml>\n</node>").unwrap_err().to_string().starts_with("line 2: this is no GraphML")
        );
        assert_eq!(error("<node id=\"a\"><data key=\"k0\">0</data></node>"), "line 6: the node has no y");
        assert_eq!(
            error("<edge source=\"a\" target=\"z\"/>"),
            "line 6: node `z` does not exist, or comes later than its edge"
        );
        assert_eq!(error("<edge source=\"a\"/>"), "line 6: the edge has no target");
        let edge = |geometry: &str| {
            error(&format!("<edge source=\"a\" target=\"b\"><data key=\"k2\">{geometry}</data></edge>"))
        };
        assert!(edge("POINT (1 2)").contains("is not of the form `LINESTRING"));
        assert!(edge("LINESTRING (1 2)").contains("is not of the form `LINESTRING"));
        assert_eq!(edge("LINESTRING (0 0, 10 x)"), "line 6: a coordinate is `x`, which is no finite number");
        assert!(edge("LINESTRING (0 0, 10 3)").ends_with("it misses one by 3.00 m"));
    }
}
