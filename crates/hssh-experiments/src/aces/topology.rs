//! Reads the hand-made topology: `PLACE name x y`, `EDGE name name`, `VISIT place first last`.

use std::ops::RangeInclusive;

use hssh_world::{Crossing, Point, Street, StreetNetwork};

/// The true map and the order in which the robot visited its places.
pub(crate) struct Topology {
    pub(crate) network: StreetNetwork,
    pub(crate) visits: Vec<Visit>,
}

/// A visit: a place's position in the network's crossings, and the scans taken there.
pub(crate) struct Visit {
    pub(crate) place: usize,
    pub(crate) scans: Vec<RangeInclusive<usize>>,
}

/// Reads a topology. Two visits to one place in succession are one visit.
pub(crate) fn read(text: &str) -> Result<Topology, String> {
    let mut topology = Topology { network: StreetNetwork::default(), visits: Vec::new() };
    for (index, line) in text.lines().enumerate() {
        read_line(line, &mut topology).ok_or_else(|| format!("topology line {}: `{line}`", index + 1))?;
    }
    Ok(topology)
}

/// `None` if the line is not as it should be.
fn read_line(line: &str, Topology { network, visits }: &mut Topology) -> Option<()> {
    let place = |name: &str| network.crossings.iter().position(|crossing| crossing.name == name);
    let words: Vec<&str> = line.split_whitespace().collect();
    match words[..] {
        [] => {}
        [first, ..] if first.starts_with('#') => {}
        ["PLACE", name, x, y] => {
            let position = Point::new(x.parse().ok()?, y.parse().ok()?);
            network.crossings.push(Crossing { name: name.to_owned(), position });
        }
        ["EDGE", from, to] => {
            let ends = [place(from)?, place(to)?];
            network.streets.push(Street { ends, bends: Vec::new() });
        }
        ["VISIT", name, first, last] => {
            let (place, scans) = (place(name)?, first.parse().ok()?..=last.parse().ok()?);
            match visits.last_mut() {
                Some(before) if before.place == place => before.scans.push(scans),
                _ => visits.push(Visit { place, scans: vec![scans] }),
            }
        }
        _ => return None,
    }
    Some(())
}
