//! Faces and genus of an embedded graph with a million edges, beside networkx.

use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::process::Command;
use std::time::Instant;

use hssh_topology::{Dart, EmbeddedGraph};
use serde::Deserialize;

use crate::bench::median;
use crate::root;
use crate::table::{aligned, grouped};

/// A square grid of 708 × 708 vertices has 1,001,112 edges.
const SIDE: u32 = 708;

/// A square grid as a rotation system: the darts of a vertex clockwise from north.
struct Grid {
    side: u32,
    /// The first dart of each vertex, and the end.
    first: Vec<u32>,
}

impl Grid {
    fn new(side: u32) -> Self {
        let mut grid = Grid { side, first: vec![0] };
        for vertex in 0..side * side {
            let start = grid.first[vertex as usize];
            grid.first.push(start + grid.neighbors(vertex).count() as u32);
        }
        grid
    }

    fn vertices(&self) -> u32 {
        self.side * self.side
    }

    /// The neighbors to the north, east, south and west, where there are any.
    fn neighbors(&self, vertex: u32) -> impl Iterator<Item = u32> + use<> {
        let (side, row, column) = (self.side, vertex / self.side, vertex % self.side);
        let north = (row > 0).then(|| vertex - side);
        let east = (column + 1 < side).then(|| vertex + 1);
        let south = (row + 1 < side).then(|| vertex + side);
        let west = (column > 0).then(|| vertex - 1);
        [north, east, south, west].into_iter().flatten()
    }

    fn degrees(&self) -> Vec<u32> {
        self.first.windows(2).map(|ends| ends[1] - ends[0]).collect()
    }

    fn dart(&self, from: u32, to: u32) -> Dart {
        let before = self.neighbors(from).take_while(|&neighbor| neighbor != to).count() as u32;
        Dart::new(self.first[from as usize] + before)
    }

    /// All edges, each once, row by row.
    fn links(&self) -> Vec<(Dart, Dart)> {
        let onward = |from| self.neighbors(from).filter(move |&to| to > from).map(move |to| (from, to));
        let edges = (0..self.vertices()).flat_map(onward);
        edges.map(|(from, to)| (self.dart(from, to), self.dart(to, from))).collect()
    }

    /// The rotation system as text: the number of vertices, then a line of neighbors for each.
    fn text(&self) -> String {
        let mut text = format!("{}\n", self.vertices());
        for vertex in 0..self.vertices() {
            let neighbors: Vec<String> = self.neighbors(vertex).map(|to| to.to_string()).collect();
            let _ = writeln!(text, "{}", neighbors.join(" ")); // writing to a String cannot fail
        }
        text
    }
}

/// What `networkx_faces.py` prints.
#[derive(Clone, Copy, Debug, Deserialize)]
struct Peer {
    faces: u32,
    genus: u32,
    build_seconds: f64,
    faces_seconds: f64,
}

/// Times building, tracing faces, and linking edge by edge with the genus carried along.
pub(crate) fn run(runs: usize) -> Result<(), Box<dyn Error>> {
    let grid = Grid::new(SIDE);
    let (degrees, links) = (grid.degrees(), grid.links());
    let (mut build, mut trace, mut grow, mut shrink) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (mut faces, mut genus) = (0, 0);
    for _ in 0..runs {
        let (seconds, graph) = timed(|| EmbeddedGraph::from_links(degrees.clone(), links.iter().copied()));
        let graph = graph?;
        build.push(seconds);
        let (seconds, traced) = timed(|| graph.faces());
        trace.push(seconds);
        (faces, genus) = (traced.len() as u32, graph.genus());
        drop((graph, traced));

        let mut graph = EmbeddedGraph::new();
        let (seconds, made) = timed(|| {
            for &degree in &degrees {
                graph.add_vertex(degree);
            }
            let link = |&(a, b): &(Dart, Dart)| Some(graph.link(graph.pending(a)?, graph.pending(b)?));
            links.iter().filter_map(link).collect::<Vec<_>>()
        });
        grow.push(seconds);
        if (graph.face_count(), graph.genus()) != (faces, genus) {
            return Err("linking edge by edge counts other faces than tracing them".into());
        }
        let (seconds, ()) = timed(|| made.into_iter().rev().for_each(|link| graph.unlink(link)));
        shrink.push(seconds);
    }
    let darts = 2 * links.len();
    let row = |what: &str, seconds: Vec<f64>| {
        let seconds = median(seconds);
        vec![what.to_owned(), format!("{seconds:.4}"), format!("{:.1}", seconds * 1e9 / darts as f64)]
    };
    let (built, traced) = (median(build.clone()), median(trace.clone()));
    let rows = [
        ["", "seconds", "ns/dart"].map(str::to_owned).to_vec(),
        row("build from links, faces and genus", build),
        row("trace all faces", trace),
        row("link edge by edge, genus carried", grow),
        row("unlink them in reverse", shrink),
    ];
    println!(
        "An embedded graph of {} edges: {} faces, genus {genus}; medians of {runs} runs.\n\n{}",
        grouped(links.len() as u64),
        grouped(u64::from(faces)),
        aligned(&rows)
    );
    match peer(&grid)? {
        None => println!("networkx: skipped: needs python3 with the package networkx\n"),
        Some(peer) => {
            if (peer.faces, peer.genus) != (faces, genus) {
                return Err("networkx counts other faces".into());
            }
            println!(
                "networkx, the same graph and as many faces: build {:.2} s ({:.0} times as long), faces {:.2} s \
                 ({:.0} times)\n",
                peer.build_seconds,
                peer.build_seconds / built,
                peer.faces_seconds,
                peer.faces_seconds / traced
            );
        }
    }
    Ok(())
}

fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let started = Instant::now();
    let result = work();
    (started.elapsed().as_secs_f64(), result)
}

/// The same by networkx, if it is there.
fn peer(grid: &Grid) -> Result<Option<Peer>, Box<dyn Error>> {
    let available = Command::new("python3").args(["-c", "import networkx"]).output();
    if !available.is_ok_and(|output| output.status.success()) {
        return Ok(None);
    }
    let path = std::env::temp_dir().join(format!("rotation-system-{}.txt", std::process::id()));
    fs::write(&path, grid.text())?;
    let script = root::root().join("xtask/scripts/networkx_faces.py");
    let output = Command::new("python3").arg(script).arg(&path).output();
    fs::remove_file(&path)?;
    let output = output?;
    if !output.status.success() {
        return Err(format!("networkx_faces.py: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    Ok(Some(serde_json::from_slice(&output.stdout)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_has_a_face_for_every_cell_and_one_around_it() {
        let grid = Grid::new(5);
        let graph = EmbeddedGraph::from_links(grid.degrees(), grid.links()).unwrap();
        graph.sanity_check().unwrap();
        assert_eq!((graph.face_count(), graph.genus(), grid.links().len()), (17, 0, 40));
        assert_eq!(grid.text().lines().nth(1), Some("1 5"));
    }
}
