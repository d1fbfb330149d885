//! clingo, the answer-set solver: found, run on a theory, and its models read.

use std::error::Error;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use serde::Deserialize;

use crate::root;

/// How to call clingo, in the order in which it is tried: the program, and the package of Python.
const CALLS: [&[&str]; 2] = [&["clingo"], &["python3", "-m", "clingo"]];

/// A clingo that answers when it is called.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clingo {
    call: &'static [&'static str],
}

/// What to ask for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Wanted {
    /// All models.
    All,
    /// The models that `#minimize` prefers to all others.
    Optimal,
}

/// What clingo answered.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Reply {
    /// Each model as its atoms.
    pub(super) models: Vec<Vec<String>>,
    /// What the models cost that were found last, the most important number first. Empty if nothing was minimized.
    pub(super) costs: Vec<u64>,
    /// Seconds, from reading the files to the last model.
    pub(super) seconds: f64,
}

/// The part of `--outf=2` that is of interest.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Document {
    result: String,
    #[serde(default)]
    call: Vec<Call>,
    time: Time,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Call {
    #[serde(default)]
    witnesses: Vec<Witness>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Witness {
    #[serde(default)]
    value: Vec<String>,
    #[serde(default)]
    costs: Vec<u64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Time {
    total: f64,
}

impl Clingo {
    /// The first that can be called, if there is one.
    pub(super) fn find() -> Option<Self> {
        let answers = |call: &&[&str]| {
            let mut command = Command::new(call[0]);
            command.args(&call[1..]).arg("--version").stdout(Stdio::null()).stderr(Stdio::null());
            command.status().is_ok_and(|status| status.success())
        };
        CALLS.into_iter().find(answers).map(|call| Clingo { call })
    }

    /// The models of files of `theory/` together with some facts.
    ///
    /// # Errors
    /// If clingo cannot be run to the end, with what it complains of.
    pub(super) fn solve(self, files: &[&str], facts: &str, wanted: Wanted) -> Result<Reply, Box<dyn Error>> {
        let mut command = Command::new(self.call[0]);
        command.args(&self.call[1..]).arg("-").args(files.iter().map(|file| path(file)));
        command.args(["--models=0", "--outf=2", "--warn=no-atom-undefined"]);
        if wanted == Wanted::Optimal {
            command.args(["--opt-mode=optN", "--quiet=1"]);
        }
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut running = command.spawn()?;
        // It reads all before it writes.
        running.stdin.take().expect("it is piped").write_all(facts.as_bytes())?;
        let output = running.wait_with_output()?;
        let complaint = || format!("{}: {}", self.call.join(" "), String::from_utf8_lossy(&output.stderr));
        Ok(Reply::read(&output.stdout).map_err(|problem| format!("{problem}\n{}", complaint()))?)
    }
}

impl Reply {
    /// Reads what clingo printed with `--outf=2`.
    ///
    /// # Errors
    /// If it is no such document, or clingo did not come to an end.
    fn read(json: &[u8]) -> Result<Self, String> {
        let document: Document =
            serde_json::from_slice(json).map_err(|error| format!("what it printed is no answer: {error}"))?;
        if !["SATISFIABLE", "UNSATISFIABLE", "OPTIMUM FOUND"].contains(&document.result.as_str()) {
            return Err(format!("it did not come to an end: the result is {}", document.result));
        }
        let witnesses: Vec<Witness> = document.call.into_iter().flat_map(|call| call.witnesses).collect();
        let costs = witnesses.last().map_or_else(Vec::new, |last| last.costs.clone());
        let models = witnesses.into_iter().map(|witness| witness.value).collect();
        Ok(Reply { models, costs, seconds: document.time.total })
    }
}

/// A file of the theory.
pub(super) fn path(file: &str) -> PathBuf {
    root::root().join("theory").join(file).with_extension("lp")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_documentation_quotes_rules_that_are_there() {
        let files = std::fs::read_dir(root::root().join("theory")).unwrap();
        let theory: String =
            files.map(|file| std::fs::read_to_string(file.unwrap().path()).unwrap()).collect();
        let page = std::fs::read_to_string(root::root().join("docs/theory.md")).unwrap();
        let blocks = page.split("```prolog").skip(1).filter_map(|rest| rest.split_once("```"));
        let quoted: Vec<&str> =
            blocks.flat_map(|(block, _)| block.lines()).filter(|line| !line.is_empty()).collect();
        assert!(quoted.len() > 10);
        for line in quoted {
            assert!(theory.lines().any(|rule| rule == line), "docs/theory.md quotes: {line}");
        }
    }

    #[test]
    fn a_reply_is_read() {
        let json = br#"{"Solver": "clingo version 5.8.0", "Input": ["-"], "Call": [{"Witnesses": [
            {"Value": ["is(0,0)", "at(0,0)"], "Costs": [0, 2, 1]}, {"Value": ["is(0,0)"], "Costs": [0, 2, 1]}
        ]}], "Result": "OPTIMUM FOUND", "Models": {"Number": 2, "More": "no"}, "Time": {"Total": 0.25, "Solve": 0.1}}"#;
        let reply = Reply::read(json).unwrap();
        assert_eq!(reply.models, [vec!["is(0,0)", "at(0,0)"], vec!["is(0,0)"]]);
        assert_eq!((reply.costs, reply.seconds), (vec![0, 2, 1], 0.25));
        let none = br#"{"Call": [{}], "Result": "UNSATISFIABLE", "Time": {"Total": 0.0}}"#;
        assert_eq!(Reply::read(none).unwrap().models, Vec::<Vec<String>>::new());
    }

    #[test]
    fn what_is_no_reply_is_refused() {
        assert!(Reply::read(b"").unwrap_err().contains("no answer"));
        let interrupted = br#"{"Result": "UNKNOWN", "Time": {"Total": 0.0}}"#;
        assert!(Reply::read(interrupted).unwrap_err().contains("the result is UNKNOWN"));
    }
}
