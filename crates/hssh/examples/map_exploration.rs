//! From what a robot saw and did to the most probable map, and how much is proved of it.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh::pipeline::{Input, MappingOptions, map};

/// Once round a square of corridors whose corners look alike but for how they are turned.
const SQUARE: &str = r#"(
    stars: {
        "south-west": ["0+ @90", "1+ @0", "0- @-90 closed", "1- @180 closed"],
        "south-east": ["0+ @90", "1+ @0 closed", "0- @-90 closed", "1- @180"],
        "north-east": ["0+ @90 closed", "1+ @0 closed", "0- @-90", "1- @180"],
        "north-west": ["0+ @90 closed", "1+ @0", "0- @-90", "1- @180 closed"],
    },
    start: "south-west",
    travels: [
        (exit: "1+", entry: "1-", star: "south-east", odometry: (x: 8, y: 0, theta: 0.01, covariance: [0.04, 0.04, 0.001])),
        (exit: "0+", entry: "0-", star: "north-east", odometry: (x: 0, y: 8, theta: 0, covariance: [0.04, 0.04, 0.001])),
        (exit: "1-", entry: "1+", star: "north-west", odometry: (x: -8, y: 0.1, theta: 0, covariance: [0.04, 0.04, 0.001])),
        (exit: "0-", entry: "0+", star: "south-west", odometry: (x: 0.1, y: -8, theta: 0, covariance: [0.04, 0.04, 0.001])),
    ],
)"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let options = MappingOptions::from_ron("(axioms: (max_genus: 0))")?;
    let input = Input::from_ron("square", SQUARE)?;
    let answer = map(&input, &options, &Default::default())?.answer;
    println!("{}", answer.verdict.sentence);
    for map in &answer.maps {
        println!("{}: {} places, probability {:?}", map.rank, map.places.len(), map.probability);
    }
    assert!(answer.maps[0].closed && answer.maps[0].places.len() == 4);
    Ok(())
}
