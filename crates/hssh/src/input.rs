//! Reading explorations, and telling them from laser logs.

use std::io::Read;
use std::path::Path;

use hssh_causal::Exploration;

use crate::failure::Failure;

/// The exploration in a file, or on standard input if the path is `-`.
pub(crate) fn read_exploration(file: &Path) -> Result<Exploration, Failure> {
    let bytes = if file.as_os_str() == "-" {
        let mut bytes = Vec::new();
        std::io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes)
    } else {
        std::fs::read(file)
    };
    let bytes = bytes.map_err(|error| Failure::Read { file: file.to_owned(), error })?;
    Exploration::from_ron_bytes(&bytes).map_err(|error| Failure::parse(file, &bytes, &error))
}

/// Whether a file holds a laser log: it is compressed, or its first record is a CARMEN message. An exploration
/// begins with a parenthesis or a comment of its own kind.
pub(crate) fn is_log(file: &Path) -> Result<bool, Failure> {
    if file.as_os_str() == "-" {
        return Ok(false);
    }
    let mut beginning = vec![0; 4096];
    let read = std::fs::File::open(file).and_then(|mut source| source.read(&mut beginning));
    beginning.truncate(read.map_err(|error| Failure::Read { file: file.to_owned(), error })?);
    let text = String::from_utf8_lossy(&beginning);
    let mut records = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let is_message = |line: &str| {
        let name = line.split_whitespace().next().unwrap_or_default();
        name.len() > 2
            && name
                .chars()
                .all(|letter| letter.is_ascii_uppercase() || letter.is_ascii_digit() || letter == '_')
    };
    Ok(beginning.starts_with(&GZIP) || records.next().is_some_and(is_message))
}

/// What a file compressed by gzip begins with.
const GZIP: [u8; 2] = [0x1f, 0x8b];
