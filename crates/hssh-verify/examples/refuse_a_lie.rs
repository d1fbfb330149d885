//! A certificate that claims another map than there is: the checker names the line.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_causal::Exploration;
use hssh_verify::{exploration_line, verify};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let exploration = Exploration::from_ron(
        r#"(stars: {"door": ["0+", "0-"]}, start: "door", travels: [(exit: "0+", entry: "0-", star: "door")])"#,
    )?;
    let certificate = |found: &str| {
        format!(
            "hssh-certificate 1\n{}\naxioms {{}}\ngoal any\nobjective preference ignored\nbest 0 1 2 0\nmaps 1\ntree\ne 1\n{found}\nend\n",
            exploration_line(&exploration),
        )
    };
    assert!(verify(&certificate("f 0 1 2 0"), &exploration).is_ok());
    let Err(refusal) = verify(&certificate("f 0 1 3 0"), &exploration) else {
        return Err("a lie was believed".into());
    };
    println!("{refusal}");
    assert_eq!(refusal.line, 10);
    Ok(())
}
