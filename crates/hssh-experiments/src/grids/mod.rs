//! `cargo xtask grids`: gateways, places and stars of real grid maps beside what is known of the buildings.

mod aces;
mod bottleneck;
mod crossing;
mod doors;
mod floor;
mod plans;
mod rooms;
mod scanned;
mod segmentation;
mod speed;
mod stability;
mod steadiness;

use std::error::Error;

use crate::flags::Grids;
pub(crate) use aces::known_places;
pub(crate) use plans::{RESOLUTION, names as plan_names, truth as plan_truth};
pub(crate) use segmentation::Rooms;

/// Prints all measurements, one paragraph each.
pub(crate) fn run(flags: &Grids) -> Result<(), Box<dyn Error>> {
    let maps = flags.data.join("gridmap");
    println!("{}", crossing::report(&maps.join("evg-thin"))?);
    println!("{}", doors::report(&maps.join("gdc3"))?);
    println!("{}", rooms::report(&maps.join("gdc3"))?);
    println!("{}", floor::report(&maps.join("gdc3"))?);
    println!("{}", plans::report(&maps.join("rooms"))?);
    println!("{}", scanned::report(&maps.join("rooms"))?);
    println!("{}", steadiness::report(&maps.join("rooms"))?);
    println!("{}", aces::report(&flags.data)?);
    println!("{}", stability::report(&flags.data)?);
    println!("{}", speed::report(&maps.join("gdc3"))?);
    Ok(())
}
