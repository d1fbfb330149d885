//! What a check of carried numbers against their definitions finds: for tests and fuzzing.

use std::fmt::Debug;

/// Something that is carried along and is not what its definition says. No use of this crate leads to it:
/// it is a fault of the crate.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{0}")]
pub struct Unsound(String);

/// Whether a law holds; `law` says which, and of what.
pub(crate) fn holds(law: impl Debug, is_so: bool) -> Result<(), Unsound> {
    if is_so { Ok(()) } else { Err(Unsound(format!("it does not hold that {law:?}"))) }
}

/// Whether what is carried along is what was counted anew.
pub(crate) fn agrees<T: PartialEq + Debug>(
    what: impl Debug,
    carried: T,
    recounted: T,
) -> Result<(), Unsound> {
    if carried == recounted {
        return Ok(());
    }
    Err(Unsound(format!("{what:?}: carried along {carried:?}, counted anew {recounted:?}")))
}
