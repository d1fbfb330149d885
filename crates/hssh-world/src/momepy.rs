//! Reads street networks in momepy's plain text: `NODE id x y` and `EDGE from to count x1 y1 …`.

use std::collections::BTreeMap;

use crate::geometry::Point;
use crate::streets::{Crossing, StreetError, StreetNetwork, StreetProblem, number};

/// Reads a street network; lines that are empty or begin with `#` say nothing.
///
/// # Errors
/// With the line, if it is no record, misses a field, holds no number where one belongs, names a
/// node that no line before it gave, or has a polyline that does not join its two nodes.
pub fn read(text: &str) -> Result<StreetNetwork, StreetError> {
    let mut network = StreetNetwork::default();
    let mut index_of = BTreeMap::new();
    for (line, record) in text.lines().enumerate() {
        read_record(record, &mut network, &mut index_of)
            .map_err(|problem| StreetError { line: line + 1, problem })?;
    }
    Ok(network)
}

fn read_record<'a>(
    record: &'a str,
    network: &mut StreetNetwork,
    index_of: &mut BTreeMap<&'a str, usize>,
) -> Result<(), StreetProblem> {
    let mut words = record.split_whitespace();
    match words.next() {
        Some("NODE") => {
            let mut field = |field| words.next().ok_or(StreetProblem::Missing { record: "the node", field });
            let name = field("identifier")?;
            let position = Point::new(number("x", field("x")?)?, number("y", field("y")?)?);
            if index_of.insert(name, network.crossings.len()).is_some() {
                return Err(StreetProblem::RepeatedNode(name.to_owned()));
            }
            network.crossings.push(Crossing { name: name.to_owned(), position });
            Ok(())
        }
        Some("EDGE") => {
            let mut field = |field| words.next().ok_or(StreetProblem::Missing { record: "the edge", field });
            let (from, to, count) = (field("first node")?, field("second node")?, field("number of points")?);
            let node = |name: &str| {
                index_of.get(name).copied().ok_or_else(|| StreetProblem::UnknownNode(name.to_owned()))
            };
            let ends = [node(from)?, node(to)?];
            let announced =
                count.parse().ok().filter(|&count| (2..=usize::MAX / 2).contains(&count)).ok_or(
                    StreetProblem::NotANumber { field: "the number of points", text: count.to_owned() },
                )?;
            let numbers = words.map(|word| number("a coordinate", word)).collect::<Result<Vec<_>, _>>()?;
            if numbers.len() != 2 * announced {
                return Err(StreetProblem::PointCount { announced, listed: numbers.len() });
            }
            let polyline = numbers.chunks_exact(2).map(|xy| Point::new(xy[0], xy[1])).collect();
            network.add_street(ends, polyline)
        }
        Some(word) if !word.starts_with('#') => Err(StreetProblem::UnknownRecord(word.to_owned())),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_nodes_and_polylines_of_either_direction() {
        let network = read(
            "# a corner and a bent street\nNODE a 0 0\nNODE b 10 10\n\n\
             EDGE a b 3 0 0 10 0 10 10\nEDGE a b 3 10 10 0 10 0 0\n",
        )
        .unwrap();
        assert_eq!(network.crossings.len(), 2);
        assert_eq!(network.streets[0].bends, [Point::new(10.0, 0.0)]);
        assert_eq!(network.streets[1].ends, [0, 1]);
        let world = network.to_world().unwrap();
        let stars: Vec<_> = world.places().iter().map(|place| place.star.to_string()).collect();
        assert_eq!(stars, ["[<0+,T>, <1+,T>, <0-,C>, <1-,C>]", "[<0+,C>, <1+,C>, <0-,T>, <1-,T>]"]);
    }

    #[test]
    fn says_where_and_what_is_wrong() {
        let error = |text: &str| read(&format!("NODE a 0 0\nNODE b 10 0\n{text}\n")).unwrap_err().to_string();
        assert!(error("WAY a b").starts_with("line 3: `WAY` begins no record"));
        assert_eq!(error("NODE c 1"), "line 3: the node has no y");
        assert_eq!(error("NODE c 1 nan"), "line 3: y is `nan`, which is no finite number");
        assert_eq!(error("NODE a 1 2"), "line 3: node `a` was given before");
        assert_eq!(
            error("EDGE a c 2 0 0 1 1"),
            "line 3: node `c` does not exist, or comes later than its edge"
        );
        assert_eq!(error("EDGE a b"), "line 3: the edge has no number of points");
        assert_eq!(error("EDGE a b -3 0"), "line 3: the number of points is `-3`, which is no finite number");
        assert_eq!(error("EDGE a b 1 0 0"), "line 3: the number of points is `1`, which is no finite number");
        assert_eq!(
            error("EDGE a b 2 0 0 10"),
            "line 3: the edge announces 2 points but lists 3 numbers, not 4"
        );
        assert_eq!(
            error("EDGE a b 2 0 0 9 0"),
            "line 3: the polyline of edge `a`–`b` does not join these nodes: it misses one by 1.00 m"
        );
    }

    #[test]
    fn a_node_without_streets_is_no_place() {
        let network = read("NODE a 0 0").unwrap();
        assert_eq!(network.to_world().unwrap_err().to_string(), "crossing `a` has no street: leave it out");
        assert!(read("").unwrap().to_world().is_err());
    }

    #[test]
    fn streets_that_leave_together_are_no_star() {
        let text = "NODE a 0 0\nNODE b 8 0\nEDGE a b 2 0 0 8 0\nEDGE a b 2 0 0 8 0\n";
        let error = read(text).unwrap().to_world().unwrap_err().to_string();
        assert!(error.ends_with("or two of them coincide"), "{error}");
    }
}
