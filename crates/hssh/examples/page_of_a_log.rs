//! From a log to a page that any browser opens: the log of a simulated robot, or one that is given. The page goes to a file if a second one is.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::io::{Cursor, Read};

use hssh::page::PageData;
use hssh::pipeline::{Input, MappingOptions, map};
use hssh::world::robot::{RobotOptions, Strategy, drive};
use hssh::world::{floor_plan, floors};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let log: Box<dyn Read> = match arguments.next() {
        Some(file) => Box::new(std::fs::File::open(file)?),
        None => {
            let floor = floors().into_iter().find(|floor| floor.name == "ring").ok_or("there is no ring")?;
            let plan = floor_plan(&floor.world, floor.width, 0.1)?;
            let driven = drive(&plan, None, Strategy::Cover, &RobotOptions::default(), 1)?;
            Box::new(Cursor::new(driven.to_carmen().into_bytes()))
        }
    };
    let options = MappingOptions::from_ron("(axioms: (max_genus: 0))")?;
    let input = Input::from_log("a log", log, &options)?;
    let mapped = map(&input, &options, &Default::default())?;
    let page = PageData::new(&input, &mapped, &options, 1, &Default::default())?.to_html();
    println!("{} The page has {} bytes.", mapped.answer.verdict.sentence, page.len());
    if let Some(file) = arguments.next() {
        std::fs::write(file, &page)?;
    }
    assert!(page.starts_with("<!doctype html>"));
    Ok(())
}
