//! The most probable map, if travels were measured: two places that look alike, too far apart to be one.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_causal::Exploration;
use hssh_search::{Mapper, Order, PosteriorModel};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let exploration = Exploration::from_ron(
        r#"(
            stars: { "door": ["0+ @0", "0- @180"], "T": ["0+ @0", "1+ @-90", "0- @180", "1- @90 closed"] },
            start: "T",
            travels: [
                (exit: "0+", entry: "0-", star: "T", odometry: (x: 9.0, y: 0.1, theta: 0.0, covariance: [0.1, 0.1, 0.01])),
                (exit: "0+", entry: "0-", star: "T", odometry: (x: 7.0, y: 0.0, theta: 0.1, covariance: [0.1, 0.1, 0.01])),
            ],
        )"#,
    )?;
    let model = PosteriorModel::evidence(&exploration).ok_or("no distance was measured")?;
    let mapper = Mapper::builder().posterior(model).order(Order::Cyclic).explain(&exploration)?;
    for map in mapper.maps(3) {
        let probable = map.probable.as_ref().ok_or("maps are ranked by probability")?;
        println!("{}: between {:.3} and {:.3}", map.measure, probable.at_least, probable.at_most);
    }
    assert_eq!(mapper.maps(1)[0].measure.places, 3);
    Ok(())
}
