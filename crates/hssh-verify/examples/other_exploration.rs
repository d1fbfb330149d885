//! A certificate proves something of one exploration only: of any other it is refused.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_causal::Exploration;
use hssh_verify::{exploration_line, verify};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let exploration = |ends: &str| {
        let text = format!(
            r#"(stars: {{"door": [{ends}]}}, start: "door", travels: [(exit: "0+", entry: "0-", star: "door")])"#
        );
        Exploration::from_ron(&text)
    };
    let (told, other) = (exploration(r#""0+", "0-""#)?, exploration(r#""0+", "0-", "1+", "1-""#)?);
    let certificate = format!(
        "hssh-certificate 1\n{}\naxioms {{}}\ngoal any\nobjective preference ignored\nbest 0 1 2 0\nmaps 1\ntree\ne 1\nf 0 1 2 0\nend\n",
        exploration_line(&told),
    );
    println!("of the exploration itself: {} map", verify(&certificate, &told)?.maps);
    let Err(refusal) = verify(&certificate, &other) else {
        return Err("another exploration was accepted".into());
    };
    println!("of another: {refusal}");
    Ok(())
}
