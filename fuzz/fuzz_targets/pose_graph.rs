//! Any bytes: reading a pose graph does not panic, and what is read can be solved or is refused.

#![no_main]

use hssh_metrics::{Options, read_pose_graph, solve_from_anywhere};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(mut file) = read_pose_graph(bytes) {
        file.graph.anchor_components();
        let options = Options { max_iterations: 10, ..Options::default() };
        if let Ok(solution) = solve_from_anywhere(&file.graph, &options) {
            assert!(solution.chi2.is_finite());
        }
        let again = read_pose_graph(file.to_g2o().as_bytes()).expect("what is written can be read");
        assert_eq!(again.graph.edges(), file.graph.edges());
    }
});
