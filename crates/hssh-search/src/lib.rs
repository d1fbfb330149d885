//! The tree of hypotheses and the searches through it.
