//! A mistake in an exploration, shown where it is and with what would be right.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_causal::Exploration;

fn main() {
    let text = r#"(
    stars: { "corner": ["0+ closed", "0-"] },
    start: "corner",
    travels: [(exit: "0+", entry: "0-", star: "corner")],
)"#;
    let Err(error) = Exploration::from_ron(text) else { return };
    println!("{}", error.render("corner.ron", text));
    assert_eq!((error.line(), error.column()), (4, 22));
}
