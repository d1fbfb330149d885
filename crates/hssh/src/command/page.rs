//! `--html`: the page of an answer.

use std::path::Path;

use hssh::page::PageData;
use hssh::pipeline::{Input, Mapped, MappingOptions};

use crate::failure::Failure;
use crate::output::write_file;
use crate::progress::watched;

/// Writes the page of an answer, which opens with the map of a rank.
pub(super) fn write(
    file: &Path,
    input: &Input,
    mapped: &Mapped,
    options: &MappingOptions,
    rank: Option<u32>,
) -> Result<(), Failure> {
    let shown = rank.map_or(1, u64::from);
    let travels = mapped.answer.input.considered as usize;
    let page = watched(travels, |monitor| PageData::new(input, mapped, options, shown, monitor))?;
    write_file(file, &page.to_html())
}
