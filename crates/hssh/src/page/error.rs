//! Why there is no page.

use crate::answer::PictureError;
use crate::pipeline::PipelineError;

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// What was believed on the way cannot be searched for.
    #[error(transparent)]
    Pipeline(#[from] PipelineError),
    /// A map cannot be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
}
