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
    let text = "% a graph\r\nVERTEX_SE2 30 1 0 0\r\n\r\nEDGE_SE2 30 7 -1e0 0 .5 1 0 0 1 0 1 # back\r\n\
                VERTEX_SE2 7 0 0 7\r\nVERTEX_SE2 12 0 0 0\r\nFIX 12 7\r\nVERTEX_XY 3 1 1\r\nPARAMS_SE2OFFSET 0 0 0 0";
    let file = read_pose_graph(text.as_bytes()).unwrap();
    assert_eq!(file.labels, [3, 7, 12, 30]);
    assert_eq!(file.landmarks, [PoseId(0)]);
    assert_eq!(file.graph.edges()[0].from, PoseId(3));
    assert!((0..3).all(|pose| file.graph.is_anchored(PoseId(pose))), "nobody saw landmark 3");
    assert!((file.graph.pose(PoseId(1)).theta - (7.0 - std::f64::consts::TAU)).abs() < 1e-15);
    assert!(file.unplaced.is_empty());
    let skipped: Vec<_> =
        file.skipped.iter().map(|skipped| (skipped.line, skipped.record.as_str())).collect();
    assert_eq!(skipped, [(9, "PARAMS_SE2OFFSET")]);
    assert!(!file.skipped[0].matters());
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
        "line 2: `x` stands where a vertex has its y, which must be a finite number, of metres between -1e9 and 1e9; \
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

/// A square of four poses with one closure, as g2o writes it.
const SQUARE: [&str; 4] = [
    "EDGE_SE2 0 1 1 0 1.5707963 100 0 0 100 0 400",
    "EDGE_SE2 1 2 1.1 0 1.5707963 100 0 0 100 0 400",
    "EDGE_SE2 2 3 1 0 1.5707963 100 0 0 100 0 400",
    "EDGE_SE2 3 0 1 0.1 1.5707963 100 0 0 100 0 400",
];

/// The least χ² of a text, with its first pose held unless something else holds it.
fn least(text: &str) -> f64 {
    let mut file = read_pose_graph(text.as_bytes()).unwrap();
    file.graph.anchor_components();
    hssh_metrics::solve_from_anywhere(&file.graph, &Options::default()).unwrap().chi2
}

#[test]
fn no_mark_and_no_line_end_hides_a_record() {
    let text = SQUARE.join("\n");
    let marked = format!("\u{feff}{text}");
    for same in [marked.clone(), text.replace('\n', "\r"), marked.replace('\n', "\r\n"), text.to_lowercase()]
    {
        let file = read_pose_graph(same.as_bytes()).unwrap();
        assert_eq!(file.graph, read_pose_graph(text.as_bytes()).unwrap().graph);
        assert!(file.skipped.is_empty());
    }
}

#[test]
fn what_is_not_known_is_counted_and_named() {
    let text = format!("{}\nEDGE_RANGE 0 2 1 1\nVERTEX_TAG 0\nEDGE_RANGE 1 3 1 1\n", SQUARE.join("\n"));
    let file = read_pose_graph(text.as_bytes()).unwrap();
    let found: Vec<_> =
        file.skipped.iter().map(|it| (it.record.as_str(), it.line, it.count, it.matters())).collect();
    assert_eq!(found, [("EDGE_RANGE", 5, 2, true), ("VERTEX_TAG", 6, 1, false)]);
    let spatial = read_pose_graph("EDGE_SE3:QUAT 0 1 0 0 0 0 0 0 1\n".as_bytes()).unwrap();
    assert!(spatial.skipped[0].is_spatial() && spatial.graph.edges().is_empty());
}

/// Endless words, lines and files end in a short error.
#[test]
fn nothing_endless_is_kept_or_shown() {
    let word = "z".repeat(900_000);
    assert!(error(&format!("EDGE_SE2 0 {word}")).len() < 300);
    assert!(error(&"\0".repeat(2 << 20)).contains("longer than"));
    assert!(error("EDGE_SE2 0 \u{1b}[31m").contains("\\u{1b}[31m"));
    assert!(error(&"x\n".repeat(100_001)).contains("line 100000: there is no record"));
}

/// A prior is one more residual: two of them pull in the frame of the world, and nothing else is held.
#[test]
fn priors_hold_poses_in_the_world() {
    let text = format!(
        "{}\nEDGE_PRIOR_SE2 0 5 5 0 100 0 0 100 0 400\nEDGE_PRIOR_SE2 2 6.2 6 3.1 100 0 0 100 0 400\n",
        SQUARE.join("\n")
    );
    let mut file = read_pose_graph(text.as_bytes()).unwrap();
    assert!(file.graph.anchor_components().is_empty());
    let solution = hssh_metrics::solve_from_anywhere(&file.graph, &Options::default()).unwrap();
    assert!((solution.poses[0].translation() - nalgebra::vector![5.0, 5.0]).norm() < 0.2);
    assert!(solution.chi2 > least(&SQUARE.join("\n")));
    let written = read_pose_graph(file.to_g2o().as_bytes()).unwrap();
    assert_eq!(written.graph.edges(), file.graph.edges());
    assert_eq!(written.world, file.world);
}

/// Positions alone, as of a satellite: one does not say where the graph looks, two do.
#[test]
fn one_position_leaves_a_graph_turning() {
    let one = format!("{}\nEDGE_PRIOR_SE2_XY 0 5 5 100 0 100\n", SQUARE.join("\n"));
    let floating = |text: &str| {
        let mut graph = read_pose_graph(text.as_bytes()).unwrap().graph;
        graph.set_poses(hssh_metrics::odometry_poses(&graph).unwrap()).unwrap();
        hssh_metrics::floating_poses(&graph)
    };
    assert_eq!(floating(&one).len(), 4);
    let two = format!("{one}EDGE_PRIOR_SE2_XY 2 6 6 100 0 100\n");
    assert!(floating(&two).is_empty());
    assert!(least(&two) < least(&SQUARE.join("\n")) + 1.0);
}

/// A landmark is where all that saw it say, and its heading costs nothing.
#[test]
fn landmarks_are_part_of_the_graph() {
    let sightings = "EDGE_SE2_XY 0 9 1 0.5 50 0 50\nEDGE_SE2_XY 1 9 0.5 0.1 50 0 50\n";
    let text = format!("{}\nVERTEX_XY 9 0 0\n{sightings}", SQUARE[..3].join("\n"));
    let mut file = read_pose_graph(text.as_bytes()).unwrap();
    file.graph.anchor_components();
    let solution = hssh_metrics::solve_from_anywhere(&file.graph, &Options::default()).unwrap();
    // From pose 1 = (1, 0, 90°) the landmark is seen at (0.9, 0.5), from pose 0 at (1, 0.5).
    assert!(solution.chi2 > 0.1 && solution.chi2 < 0.25, "{}", solution.chi2);
    assert!((solution.poses[4].x - 0.95).abs() < 0.05, "{:?}", solution.poses[4]);
    let written = read_pose_graph(file.to_g2o().as_bytes()).unwrap();
    assert_eq!((written.graph.edges(), written.landmarks), (file.graph.edges(), file.landmarks));
    assert!(error(&format!("{}\nEDGE_SE2_XY 0 1 1 1 1 0 1\n", SQUARE[0])).contains("1 is a landmark here"));
}

#[test]
fn switches_and_mixtures_are_doubtful_closures() {
    let plain = SQUARE.join("\n");
    let closure = SQUARE[3].strip_prefix("EDGE_SE2 3 0").unwrap();
    let switchable = format!(
        "{}\nVERTEX_SWITCH 7 1\nEDGE_SWITCH_PRIOR 7 1 1\nEDGE_SE2_SWITCHABLE 3 0 7{closure}\n",
        SQUARE[..3].join("\n")
    );
    let mixture = format!("{}\nEDGE_SE2_MAXMIX 3 0 1e-12{closure}\n", SQUARE[..3].join("\n"));
    for text in [switchable, mixture] {
        let file = read_pose_graph(text.as_bytes()).unwrap();
        assert_eq!(file.graph, read_pose_graph(plain.as_bytes()).unwrap().graph);
        assert_eq!(file.doubtful.iter().copied().collect::<Vec<_>>(), [3]);
        assert!(file.skipped.is_empty());
    }
}

/// A file with `ODOMETRY` is iSAM's: its numbers are the square root, and the errors lie along the start pose.
#[test]
fn isam_writes_square_roots() {
    let isam = "ODOMETRY 0 1 1 0 1.5707963 10 0 0 10 0 20\nEDGE2 1 2 1.1 0 1.5707963 10 0 0 10 0 20\n\
                ODOMETRY 2 3 1 0 1.5707963 10 0 0 10 0 20\nEDGE2 3 0 1 0.1 1.5707963 10 0 0 10 0 20\n";
    assert!((least(isam) - least(&SQUARE.join("\n"))).abs() < 1e-9);
    let skew = read_pose_graph("ODOMETRY 0 1 1 0 1.5707963267948966 2 1 0 3 0 5\n".as_bytes()).unwrap();
    let along_start = skew.graph.edges()[0].start_frame_information();
    assert!((along_start.matrix() - matrix![4.0, 2.0, 0.0; 2.0, 10.0, 0.0; 0.0, 0.0, 25.0]).amax() < 1e-9);
    let seen =
        read_pose_graph("ODOMETRY 0 1 1 0 0 1 0 0 1 0 1\nLANDMARK 0 1 2 0 3 0 3\n".as_bytes()).unwrap();
    assert_eq!((seen.labels, seen.landmarks), (vec![0, 1, 1], vec![PoseId(2)]));
}

/// No information in one direction is no error as long as the rest of the graph determines it.
#[test]
fn a_direction_may_be_unmeasured() {
    let blind =
        SQUARE.join("\n").replace("3 0 1 0.1 1.5707963 100 0 0 100 0 400", "3 0 1 0.1 9 100 0 0 100 0 0");
    let with = least(&blind);
    assert!(with > 0.0 && with < least(&SQUARE.join("\n")));
    let absent = SQUARE.join("\n").replace("0.1 1.5707963 100 0 0 100 0 400", "0.1 1.5 0 0 0 0 0 0");
    assert_eq!(read_pose_graph(absent.as_bytes()).unwrap().empty_edges, 1);
    assert!(least(&absent) < 1e-9);
}

#[test]
fn numbers_out_of_proportion_are_refused_where_they_stand() {
    assert!(error("EDGE_SE2 0 1 1e300 0 0 1 0 0 1 0 1").contains("`1e300` stands where an edge has its x"));
    assert!(error("VERTEX_SE2 0 0 0 1e300").contains("radians between"));
    assert!(error("EDGE_SE2 0 1 0 0 0 1e200 0 0 1 0 1").contains("between -1e30 and 1e30"));
    let degrees = read_pose_graph("EDGE_SE2 0 1 1 0 90 1 0 0 1 0 1\n".as_bytes()).unwrap();
    assert_eq!(degrees.large_turn, Some((1, 90.0)));
}
