//! The search for maps, with a progress line.

use hssh::pipeline::{Input, Mapped, MappingOptions, Means, map_with};

use crate::failure::Failure;
use crate::input::warn;
use crate::progress::watched;

/// Searches with a progress line; Ctrl-C leaves what is known so far.
pub(crate) fn searched(
    input: &Input,
    options: &MappingOptions,
    means: &Means<'_>,
) -> Result<Mapped, Failure> {
    let travels = input.as_exploration().travels().len().min(options.limits.travels.unwrap_or(usize::MAX));
    let mapped = watched(travels, |monitor| map_with(input, options, monitor, means))?;
    let known = input.as_surveyed().map_or(0, |surveyed| surveyed.warnings().len());
    warn(mapped.answer.input.name.as_ref(), &mapped.answer.warnings[known..]);
    Ok(mapped)
}
