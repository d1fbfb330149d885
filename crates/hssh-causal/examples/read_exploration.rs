//! Reads an exploration and says what the robot saw and did.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_causal::Exploration;

const TEXT: &str = r#"(
    stars: { "west": ["0+ @0", "0- @180 closed"], "east": ["0+ @0 closed", "0- @180"] },
    start: "west",
    travels: [
        (exit: "0+", entry: "0-", star: "east", odometry: (x: 9.8, y: 0.1, theta: 0.02, covariance: [0.04, 0.04, 0.001])),
        (exit: "0-", entry: "0+", star: "west"),
    ],
)"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = std::env::args().nth(1).map_or(Ok(TEXT.to_owned()), std::fs::read_to_string)?;
    let exploration = Exploration::from_ron(&text)?;
    let name = |star: hssh_causal::StarType| exploration.star_types()[star.index()].name.as_str();
    println!("start at {}", name(exploration.start()));
    for travel in exploration.travels() {
        let metres = travel
            .odometry
            .as_ref()
            .map_or("?".to_owned(), |odometry| format!("{:.1}", odometry.x.hypot(odometry.y)));
        println!("{metres} m to {}", name(travel.star));
    }
    assert_eq!(Exploration::from_ron(&exploration.to_ron())?, exploration);
    Ok(())
}
