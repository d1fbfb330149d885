//! Embedded graphs against known surfaces, and the incremental counts against recounting.

use proptest::prelude::*;

use super::{EmbeddedGraph, EmbeddingError, PendingEdge};
use crate::ids::Dart;

/// A graph from the neighbors of each vertex in clockwise order; simple graphs only.
fn from_neighbors(neighbors: &[&[usize]]) -> EmbeddedGraph {
    let first: Vec<u32> = neighbors
        .iter()
        .scan(0, |next, list| Some(std::mem::replace(next, *next + list.len() as u32)))
        .collect();
    let dart = |v: usize, w: usize| {
        let position = neighbors[v].iter().position(|&x| x == w).expect("edges are listed at both ends");
        Dart::new(first[v] + position as u32)
    };
    let links = neighbors
        .iter()
        .enumerate()
        .flat_map(|(v, list)| list.iter().filter(move |&&w| v < w).map(move |&w| (dart(v, w), dart(w, v))));
    EmbeddedGraph::from_links(neighbors.iter().map(|list| list.len() as u32), links).unwrap()
}

#[test]
fn known_surfaces() {
    let k4 = from_neighbors(&[&[1, 2, 3], &[0, 3, 2], &[0, 1, 3], &[0, 2, 1]]);
    assert_eq!((k4.face_count(), k4.genus()), (4, 0));
    let k4_twisted = from_neighbors(&[&[1, 2, 3], &[0, 2, 3], &[0, 1, 3], &[0, 2, 1]]);
    assert_eq!((k4_twisted.face_count(), k4_twisted.genus()), (2, 1));
    // K5 on the torus: the rotation at i is i+1, i+2, i-1, i-2 (a quotient of the square lattice).
    let k5_rows: Vec<Vec<usize>> =
        (0..5).map(|i| [1, 2, 4, 3].iter().map(|step| (i + step) % 5).collect()).collect();
    let k5 = from_neighbors(&k5_rows.iter().map(Vec::as_slice).collect::<Vec<_>>());
    assert_eq!((k5.face_count(), k5.genus()), (5, 1));
    // K3,3 on the torus in three hexagons.
    let k33 = from_neighbors(&[&[3, 4, 5], &[3, 4, 5], &[3, 4, 5], &[0, 1, 2], &[0, 1, 2], &[0, 1, 2]]);
    assert_eq!((k33.face_count(), k33.genus()), (3, 1));
}

#[test]
fn two_loops_at_one_vertex() {
    let loops = |links: [(u32, u32); 2]| {
        let graph = EmbeddedGraph::from_links([4], links.map(|(a, b)| (Dart::new(a), Dart::new(b)))).unwrap();
        (graph.face_count(), graph.genus())
    };
    assert_eq!(loops([(0, 1), (2, 3)]), (3, 0));
    assert_eq!(loops([(0, 2), (1, 3)]), (1, 1));
}

#[test]
fn figure_3_2_an_edge_is_one_face_walked_on_both_sides() {
    let edge = from_neighbors(&[&[1], &[0]]);
    assert_eq!(edge.faces().iter().collect::<Vec<_>>(), [&[Dart::new(0), Dart::new(1)]]);
    assert!(edge.is_planar());
}

#[test]
fn parallel_edges_and_isolated_vertices() {
    let graph =
        EmbeddedGraph::from_links([2, 2, 3, 0], [(Dart::new(0), Dart::new(3)), (Dart::new(1), Dart::new(2))])
            .unwrap();
    graph.sanity_check().unwrap();
    assert_eq!((graph.face_count(), graph.component_count(), graph.genus()), (2, 3, 0));
    assert_eq!(graph.isolated_vertices().count(), 2);
    assert_eq!(graph.pending_count(), 3);
}

#[test]
fn a_vertex_without_darts_comes_and_goes() {
    let mut graph = EmbeddedGraph::from_links([4, 0, 0], []).unwrap();
    let pending: Vec<PendingEdge> = graph.pending_edges().collect();
    let link = graph.link(pending[0], pending[2]);
    graph.sanity_check().unwrap();
    graph.unlink(link);
    for _ in 0..3 {
        graph.remove_last_vertex();
    }
    assert_eq!((graph.vertex_count(), graph.face_count()), (0, 0));
}

#[test]
fn refuses_impossible_links() {
    let error = |links: &[(u32, u32)]| {
        EmbeddedGraph::from_links([2, 2], links.iter().map(|&(a, b)| (Dart::new(a), Dart::new(b))))
            .unwrap_err()
    };
    assert_eq!(error(&[(0, 4)]), EmbeddingError::NoSuchDart(Dart::new(4), 4));
    assert_eq!(error(&[(0, 0)]), EmbeddingError::LinkedTwice(Dart::new(0)));
    assert_eq!(error(&[(0, 1), (1, 2)]), EmbeddingError::LinkedTwice(Dart::new(1)));
}

/// Degrees of vertices and an order in which to try to link pairs of darts.
fn links() -> impl Strategy<Value = (Vec<u32>, Vec<(prop::sample::Index, prop::sample::Index)>)> {
    let degrees = prop::collection::vec(0_u32..6, 1..9);
    (degrees, prop::collection::vec(any::<(prop::sample::Index, prop::sample::Index)>(), 0..20))
}

proptest! {
    /// Whatever is linked, what is carried along equals a recount, and taking links back restores it.
    #[test]
    fn linking_equals_recounting((degrees, pairs) in links()) {
        let mut graph = EmbeddedGraph::new();
        let mut states = Vec::new();
        let mut undo = Vec::new();
        for &degree in &degrees {
            graph.add_vertex(degree);
        }
        for (a, b) in pairs {
            let pending: Vec<PendingEdge> = graph.pending_edges().collect();
            if pending.is_empty() {
                break;
            }
            let (a, b) = (*a.get(&pending), *b.get(&pending));
            if a == b {
                continue;
            }
            let (genus, same_face) = (graph.genus(), graph.face_of(a) == graph.face_of(b));
            let connected = graph.are_connected(graph.source(a.dart()), graph.source(b.dart()));
            states.push(format!("{graph:?}"));
            undo.push(graph.link(a, b));
            graph.sanity_check().unwrap();
            // Section 3.3: only an edge between two faces of one component costs a handle.
            prop_assert_eq!(graph.genus(), genus + u32::from(connected && !same_face));
        }
        while let Some(link) = undo.pop() {
            graph.unlink(link);
            graph.sanity_check().unwrap();
            prop_assert_eq!(Some(format!("{graph:?}")), states.pop());
        }
        for _ in &degrees {
            graph.remove_last_vertex();
        }
        prop_assert_eq!(graph.dart_count(), 0);
    }

    /// Every dart lies on exactly one face, and its face is where `next` leads.
    #[test]
    fn faces_partition_the_darts((degrees, pairs) in links()) {
        let mut free: Vec<Dart> = (0..degrees.iter().sum()).map(Dart::new).collect();
        let mut chosen = Vec::new();
        for (a, b) in pairs {
            if free.len() < 2 {
                break;
            }
            let a = free.swap_remove(a.index(free.len()));
            let b = free.swap_remove(b.index(free.len()));
            chosen.push((a, b));
        }
        let graph = EmbeddedGraph::from_links(degrees, chosen.iter().copied()).unwrap();
        graph.sanity_check().unwrap();
        let faces = graph.faces();
        let mut darts: Vec<Dart> = faces.iter().flatten().copied().collect();
        darts.sort_unstable();
        let mut linked: Vec<Dart> = chosen.into_iter().flat_map(|(a, b)| [a, b]).collect();
        linked.sort_unstable();
        prop_assert_eq!(darts, linked);
        for face in faces.iter() {
            for (index, &dart) in face.iter().enumerate() {
                prop_assert_eq!(graph.next(dart), Some(face[(index + 1) % face.len()]));
            }
        }
    }
}
