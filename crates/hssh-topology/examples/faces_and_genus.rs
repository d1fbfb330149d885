//! An embedded graph: its faces, and how many handles a surface needs to hold it.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_topology::{Dart, EmbeddedGraph};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A square of four corners with two ways each: darts 0 and 1 belong to the first corner, 2 and 3 to the second, …
    let dart = Dart::new;
    let sides = [(1, 2), (3, 4), (5, 6), (7, 0)].map(|(a, b)| (dart(a), dart(b)));
    let square = EmbeddedGraph::from_links([2; 4], sides)?;
    println!("the square has {} faces and genus {}", square.face_count(), square.genus());
    assert_eq!((square.face_count(), square.genus()), (2, 0));
    // A crossing whose opposite ways are joined, as on a torus: no plane can hold it.
    let torus = EmbeddedGraph::from_links([4], [(dart(0), dart(2)), (dart(1), dart(3))])?;
    println!("the crossing has {} face and genus {}", torus.face_count(), torus.genus());
    assert!(!torus.is_planar());
    Ok(())
}
