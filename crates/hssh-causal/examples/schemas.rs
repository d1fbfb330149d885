//! The causal level: what a robot learns that sees only what is ahead, as schemas ⟨view, action, view⟩.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_causal::Exploration;
use hssh_causal::schema::{Sight, Trace, Turning, view_graph_dot};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let exploration = Exploration::from_ron(
        r#"(
            stars: { "T": ["0+", "1+", "0- closed", "1-"], "end": ["0+", "0- closed"] },
            start: "end",
            travels: [(exit: "0+", entry: "0+", star: "T"), (exit: "1+", entry: "0+", star: "end")],
        )"#,
    )?;
    for sight in [Sight::Place, Sight::Ahead] {
        let Some(trace) = Trace::of(&exploration, sight, Turning::Direct) else { continue };
        println!("{sight:?}: {} schemas", trace.schemas().len());
        println!("{}", view_graph_dot(&trace));
    }
    Ok(())
}
