//! Checks what lints cannot: opening sentences, file lengths, words that must not be committed, layers.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use crate::layers;
use crate::root;

/// Lines of the longest source file that is still one concept.
const LONGEST: usize = 600;

/// Where files are looked at.
const FOLDERS: [&str; 8] = ["crates", "docs", "fixtures", "fuzz", "python", "theory", "xtask", ".ci"];

/// What no file may say: notes to oneself, and folders of one machine. Written in two halves, so
/// that this file does not say them.
const FORBIDDEN: [&str; 9] = [
    concat!("TO", "DO"),
    concat!("FIX", "ME"),
    concat!("XX", "X"),
    concat!("todo", "!("),
    concat!("unimplemented", "!("),
    concat!("/wo", "rk/"),
    concat!("/tm", "p/"),
    concat!("/ho", "me/"),
    concat!("/ro", "ot/"),
];

/// `cargo xtask tidy`.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    let problems = problems()?;
    for problem in &problems {
        eprintln!("{problem}");
    }
    match problems.len() {
        0 => {
            println!("tidy: every file and every layer is as it should be");
            Ok(())
        }
        1 => Err("tidy found one problem".into()),
        many => Err(format!("tidy found {many} problems").into()),
    }
}

fn problems() -> Result<Vec<String>, Box<dyn Error>> {
    let mut files = Vec::new();
    for folder in FOLDERS {
        collect(&root::root().join(folder), &mut files)?;
    }
    files.extend(["Cargo.toml", "README.md"].map(|name| root::root().join(name)));
    files.sort();
    let mut problems = Vec::new();
    for path in files.iter().filter(|path| path.is_file()) {
        let text = String::from_utf8_lossy(&fs::read(path)?).into_owned();
        let name = path.strip_prefix(root::root()).unwrap_or(path).display().to_string();
        problems.extend(of_file(&name, &text));
    }
    problems.extend(layers::violations()?);
    let manifest = |name| fs::read_to_string(root::root().join(name));
    let (workspace, python) = (manifest("Cargo.toml")?, manifest("python/Cargo.toml")?);
    for kind in ["rust", "clippy"] {
        let own = lints(&python, &format!("[lints.{kind}]"));
        if lints(&workspace, &format!("[workspace.lints.{kind}]")) != own || own.is_empty() {
            problems.push(format!("python/Cargo.toml: its lints of {kind} are not those of the workspace"));
        }
    }
    Ok(problems)
}

/// The lines of a section of a manifest.
fn lints(manifest: &str, section: &str) -> Vec<String> {
    let lines = manifest.lines().skip_while(|line| *line != section).skip(1);
    lines
        .take_while(|line| !line.starts_with('['))
        .filter(|line| line.contains('='))
        .map(str::to_owned)
        .collect()
}

/// All files below a folder that are not made by tools.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    if !folder.is_dir() {
        return Ok(());
    }
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let is_made = ["target", "corpus", "artifacts", "__pycache__", ".pytest_cache", ".mypy_cache"]
            .iter()
            .any(|made| path.ends_with(made));
        if path.is_dir() && !is_made {
            collect(&path, files)?;
        } else if path.is_file() && path.extension().is_none_or(|ending| ending != "lock" && ending != "png")
        {
            files.push(path);
        }
    }
    Ok(())
}

/// What is wrong in one file.
fn of_file(name: &str, text: &str) -> Vec<String> {
    let mut problems = Vec::new();
    if name.ends_with(".rs") {
        let opening = text.lines().next().unwrap_or_default();
        if opening.strip_prefix("//! ").is_none_or(|sentence| sentence.len() <= 10) {
            problems.push(format!("{name}:1: opens without a `//!` sentence that says what the file is"));
        }
        let lines = text.lines().count();
        if lines > LONGEST {
            problems.push(format!("{name}: has {lines} lines, more than {LONGEST}: it is two concepts"));
        }
    }
    for (number, line) in text.lines().enumerate() {
        for word in FORBIDDEN.iter().filter(|word| line.contains(**word)) {
            problems.push(format!("{name}:{}: says `{word}`", number + 1));
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_repository_is_tidy() {
        assert_eq!(problems().unwrap(), Vec::<String>::new());
    }

    #[test]
    fn untidy_files_are_found() {
        assert!(of_file("a.rs", "//! Says what it is.\nfn f() {}\n").is_empty());
        let bare = of_file("a.rs", "fn f() {}\n");
        assert_eq!(bare, ["a.rs:1: opens without a `//!` sentence that says what the file is"]);
        assert_eq!(of_file("a.rs", &format!("//! Says what it is.\n{}", "\n".repeat(LONGEST))).len(), 1);
        let note = format!("Fine.\nSee {}data.\n", FORBIDDEN[5]);
        assert_eq!(of_file("a.md", &note), [format!("a.md:2: says `{}`", FORBIDDEN[5])]);
    }
}
