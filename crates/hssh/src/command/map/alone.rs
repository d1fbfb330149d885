//! Searches by this process alone: the program was built without those that are spread over several.

use hssh::pipeline::{Input, Mapped, MappingOptions, Means};

use super::search::searched;
use crate::arguments::MapArguments;
use crate::failure::Failure;

/// Whether this process only takes part: another one has the answer.
pub(super) fn is_helper(_: &MapArguments) -> bool {
    false
}

/// Whether several processes are asked for.
pub(crate) fn is_spread(_: &MapArguments) -> bool {
    false
}

/// Searches.
pub(super) fn spread(
    _: &MapArguments,
    input: &Input,
    options: &MappingOptions,
    kept: Means<'_>,
) -> Result<Mapped, Failure> {
    searched(input, options, &kept)
}
