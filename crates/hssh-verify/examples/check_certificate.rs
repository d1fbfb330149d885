//! Checks a certificate against its exploration: two files, or a small proof.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_causal::Exploration;
use hssh_verify::{exploration_line, report, verify};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let (certificate, exploration) = match &files[..] {
        [certificate, exploration] => (
            std::fs::read_to_string(certificate)?,
            Exploration::from_ron(&std::fs::read_to_string(exploration)?)?,
        ),
        _ => small_proof()?,
    };
    println!("{}", report(&verify(&certificate, &exploration)?));
    Ok(())
}

/// The robot went through one door to another, which the axioms let be no other than a new place.
fn small_proof() -> Result<(String, Exploration), Box<dyn std::error::Error>> {
    let exploration = Exploration::from_ron(
        r#"(stars: {"door": ["0+", "0-"]}, start: "door", travels: [(exit: "0+", entry: "0-", star: "door")])"#,
    )?;
    let certificate = format!(
        "hssh-certificate 1\n{}\naxioms {{}}\ngoal any\nobjective preference ignored\nbest 0 1 2 0\nmaps 1\ntree\ne 1\nf 0 1 2 0\nend\n",
        exploration_line(&exploration),
    );
    Ok((certificate, exploration))
}
