//! The simplest map of a simulated world, with a proof that no other is as good.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_search::{Mapper, Order};
use hssh_world::{grid, snake};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let world = grid(3, 3, 8.0)?;
    let exploration = world.explore(&world.route_through(&snake(3, 3))?)?;
    let mapper = Mapper::builder().order(Order::Cyclic).explain(&exploration)?;
    let (report, maps) = mapper.answer(3);
    println!("{} nodes were searched; proved: {}", report.nodes, report.is_optimal);
    for map in &maps {
        println!("{}, closed: {}", map.measure, map.closed);
    }
    let certificate = mapper.certificate(&exploration).ok_or("nothing was proved")?;
    println!("the certificate has {} lines; hssh-verify checks it", certificate.lines().count());
    assert!(report.is_optimal);
    Ok(())
}
