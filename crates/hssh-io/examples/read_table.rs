//! A table of scans as a laser log: a file, or a few lines.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::io::{BufRead, BufReader};

use hssh_io::{KnownLaser, is_table, read_table};

const TABLE: &str = "\
# angle_min: -1.5708
# angle_increment: 0.7854
time,x,y,theta,ranges
0.0,0.0,0.0,0.0,1.25,1.30,4.00,2.75,1.20
0.5,0.2,0.0,0.0,1.25,1.31,3.80,2.74,1.20
1.0,0.4,0.0,0.0,1.25,inf,3.60,2.76,1.20
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let source: Box<dyn BufRead> = match std::env::args().nth(1) {
        Some(file) => Box::new(BufReader::new(std::fs::File::open(file)?)),
        None => Box::new(TABLE.as_bytes()),
    };
    let log = read_table(source, &KnownLaser::default())?;
    for scan in &log.scans {
        println!("{:?} s at ({:.1}, {:.1})", scan.time, scan.odometry.x, scan.odometry.y);
    }
    println!("{} warnings", log.warnings.len());
    assert!(is_table("time,x,y,theta,ranges") && !log.scans.is_empty());
    Ok(())
}
