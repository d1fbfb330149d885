//! Maps while the robot drives: one visit after the other, and the maps that explain all so far.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_search::{Mapper, Visit};
use hssh_topology::{Axioms, Olp, Star};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let crossing: Star = "0+ 1+ 0- 1-".parse()?;
    let dead_end: Star = "0+ (0-)".parse()?;
    let planar = Axioms { max_genus: Some(0), ..Axioms::default() };
    let mut mapper = Mapper::builder().axioms(planar).start(&crossing)?;
    let visits = [(0, 0, &dead_end), (0, 0, &crossing), (1, 0, &dead_end)];
    for (exit, entry, star) in visits {
        mapper.observe(Visit::new(Olp::new(exit), Olp::new(entry), star))?;
        mapper.advance();
        let maps = mapper.maps(10);
        println!("{} travels: {} maps, the best with {}", mapper.explained(), maps.len(), maps[0].measure);
    }
    assert_eq!(mapper.maps(10).len(), 1);
    Ok(())
}
