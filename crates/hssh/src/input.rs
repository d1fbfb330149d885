//! Reading explorations.

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
