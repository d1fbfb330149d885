//! g2o and TORO text: round trips, and an error with line, word and remedy for every way to be wrong.

use hssh_metrics::{
    Edge, GraphFile, Information, Options, Pose, PoseGraph, PoseId, chordal_poses, read_pose_graph, solve,
};
use nalgebra::matrix;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::random_graph;

fn error(text: &str) -> String {
    read_pose_graph(text.as_bytes()).unwrap_err().to_string()
}

#[test]
fn what_is_written_is_read_back_to_the_last_bit() {
    let file = GraphFile::from(random_graph(3, 20, 8, 0.1));
    assert_eq!(read_pose_graph(file.to_g2o().as_bytes()).unwrap(), file);
    let mut from_toro = read_pose_graph(file.to_toro().as_bytes()).unwrap();
    assert_eq!(from_toro.graph.free_poses(), 20, "TORO has no anchors");
    from_toro.graph.anchor(PoseId(0)).unwrap();
    assert_eq!(from_toro, file);
}

/// The two orders of the six numbers: g2o row by row, TORO Ixx Ixy Iyy Itt Ixt Iyt.
#[test]
fn the_two_formats_order_the_information_differently() {
    let information = matrix![10.0, 1.0, 2.0; 1.0, 20.0, 3.0; 2.0, 3.0, 30.0];
    for text in ["EDGE_SE2 0 1 1 2 3 10 1 2 20 3 30", "EDGE2 0 1 1 2 3 10 1 20 30 2 3"] {
        let file = read_pose_graph(text.as_bytes()).unwrap();
        let expected = Edge {
            from: PoseId(0),
            to: PoseId(1),
            relative_pose: Pose::new(1.0, 2.0, 3.0),
            information: Information::new(information).unwrap(),
        };
        assert_eq!(file.graph.edges(), [expected]);
    }
}

#[test]
fn labels_comments_and_line_ends_do_not_matter() {
    let text = "# a graph\r\nVERTEX_SE2 30 1 0 0\r\n\r\nEDGE_SE2 30 7 -1e0 0 .5 1 0 0 1 0 1 # back\r\n\
                VERTEX_SE2 7 0 0 7\r\nVERTEX_SE2 12 0 0 0\r\nFIX 12 7\r\nVERTEX_XY 3 1 1\r\nPARAMS_SE2OFFSET 0 0 0 0";
    let file = read_pose_graph(text.as_bytes()).unwrap();
    assert_eq!(file.labels, [7, 12, 30]);
    assert_eq!(file.graph.edges()[0].from, PoseId(2));
    assert!(file.graph.is_anchored(PoseId(0)) && file.graph.is_anchored(PoseId(1)));
    assert!((file.graph.pose(PoseId(0)).theta - (7.0 - std::f64::consts::TAU)).abs() < 1e-15);
    assert!(file.unplaced.is_empty());
    let skipped: Vec<_> =
        file.skipped.iter().map(|skipped| (skipped.line, skipped.record.as_str())).collect();
    assert_eq!(skipped, [(8, "VERTEX_XY"), (9, "PARAMS_SE2OFFSET")]);
}

#[test]
fn edges_alone_make_a_graph() {
    let file = read_pose_graph("EDGE2 5 3 1 0 0 1 0 1 1 0 0\n".as_bytes()).unwrap();
    assert_eq!(file.labels, [3, 5]);
    assert_eq!(file.unplaced, [PoseId(0), PoseId(1)]);
    let empty = read_pose_graph("".as_bytes()).unwrap();
    assert_eq!(empty.graph, PoseGraph::new());
}

#[test]
fn errors_say_where_and_what_would_be_right() {
    assert_eq!(
        error("\nVERTEX_SE2 0 0 x 0"),
        "line 2: `x` stands where a vertex has its y, which must be a finite number; \
         a complete line is `VERTEX_SE2 id x y theta`"
    );
    assert_eq!(
        error("VERTEX_SE2 0 0 0"),
        "line 1: a vertex ends before its angle; a complete line is `VERTEX_SE2 id x y theta`"
    );
    assert_eq!(
        error("FIX -1"),
        "line 1: `-1` stands where a fixed pose has its pose, which must be a whole number from 0; \
         a complete line is `FIX id [id ...]`"
    );
    assert_eq!(error("FIX 4"), "line 1: pose 4 is fixed, but no vertex and no edge mentions it");
    assert!(error("FIX").contains("ends before its pose"));
    assert!(error("VERTEX_SE2 0 nan 0 0").contains("`nan`"));
    assert!(error("VERTEX_SE2 0 1e999 0 0").contains("`1e999`"));
    assert!(error("EDGE_SE2 0 1 0 0 0 1 0 0 1 0 1 1").contains("`1` is one word too many"));
    assert!(error("EDGE_SE2 0 1 0 0 0 1 0 0 1 0").contains("information matrix of six numbers"));
    assert_eq!(
        error("VERTEX_SE2 3 0 0 0\nVERTEX_SE2 3 0 0 0"),
        "line 2: pose 3 was given on line 1 already: every pose has one vertex record"
    );
    assert_eq!(
        error("EDGE_SE2 6 8 0 0 0 1 0 0 -1 0 1"),
        "line 1: the information matrix from pose 6 to pose 8 is not positive definite: the smallest eigenvalue \
         is -1e0, but every direction needs a positive one"
    );
    assert_eq!(
        error("EDGE_SE2 5 5 0 0 0 1 0 0 1 0 1"),
        "line 1: the edge leads from pose 5 to itself: it says nothing about where the pose is, leave it out"
    );
}

#[test]
fn bytes_that_are_no_text_are_an_error() {
    let error = read_pose_graph(&b"VERTEX_SE2 0 0 0 0\n\xff\xfe\n"[..]).unwrap_err();
    assert_eq!(error.line, 2);
}

/// Whatever the bytes, reading ends with a graph or an error, and what it read can be solved or is refused.
#[test]
fn damaged_files_never_panic() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let file = GraphFile::from(random_graph(3, 6, 3, 0.1));
    for text in [file.to_g2o(), file.to_toro()] {
        for _ in 0..2000 {
            let mut bytes = text.clone().into_bytes();
            for _ in 0..random.random_range(1..6) {
                let position = random.random_range(0..bytes.len());
                match random.random_range(0..3) {
                    0 => bytes[position] = b"0123456789-.eE \nNaN#x"[random.random_range(0..21)],
                    1 if bytes.len() > 1 => drop(bytes.remove(position)),
                    _ => bytes.truncate(position.max(1)),
                }
            }
            if let Ok(GraphFile { mut graph, .. }) = read_pose_graph(&bytes[..]) {
                graph.anchor_components();
                if let Ok(poses) = chordal_poses(&graph) {
                    assert_eq!(poses.len(), graph.poses().len());
                }
                let solution = solve(&graph, &Options { max_iterations: 20, ..Options::default() });
                assert!(solution.is_err() || solution.is_ok_and(|solution| solution.chi2.is_finite()));
            }
        }
    }
}
