//! Help for tests that have certificates: whoever writes them can add a test with [`accepts`].

use hssh_causal::Exploration;
use hssh_verify::{Verdict, verify};

/// One of the explorations in `fixtures`.
pub(crate) fn fixture(name: &str) -> Exploration {
    let path = format!("{}/../../fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    Exploration::from_ron(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Checks that a certificate holds for an exploration; otherwise shows where it does not.
pub(crate) fn accepts(certificate: &str, exploration: &Exploration) -> Verdict {
    verify(certificate, exploration).unwrap_or_else(|refusal| {
        let lines = certificate.lines().enumerate().skip(refusal.line.saturating_sub(6)).take(8);
        let around: Vec<String> = lines.map(|(index, line)| format!("{:6} {line}", index + 1)).collect();
        panic!("{refusal}\n{}", around.join("\n"))
    })
}
