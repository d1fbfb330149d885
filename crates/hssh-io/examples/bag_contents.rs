//! The topics of a ROS bag, and what of it would be used.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::path::PathBuf;

use hssh_io::{RecordingOptions, bag_account};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let usual = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/bags/usual");
    let bag = std::env::args().nth(1).map_or_else(|| PathBuf::from(usual), PathBuf::from);
    let account = bag_account(&bag, &RecordingOptions::default())?;
    for topic in &account.topics {
        println!("{}: {}, {} messages", topic.name, topic.type_name, topic.messages);
    }
    assert!(!account.topics.is_empty());
    Ok(())
}
