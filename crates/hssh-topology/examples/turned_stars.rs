//! In which ways one place can be another that was seen before: isomorphisms of stars.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_topology::{Isomorphism, Star};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Ends in clockwise order; what is in parentheses is closed.
    let seen: Star = "0+ (1+) 0- 1-".parse()?;
    for known in ["(1+) 0- 1- 0+", "0+ 1+ 0- 1-", "0+ 1+ 0- (1-)"] {
        let star: Star = known.parse()?;
        let turns: Vec<u32> = Isomorphism::all(&seen, &star).map(|phi| phi.rotation()).collect();
        println!("{seen} as {known}: turned by {turns:?} ends");
    }
    let crossing: Star = "0+ 1+ 0- 1-".parse()?;
    assert_eq!(Isomorphism::all(&crossing, &crossing).count(), 4);
    Ok(())
}
