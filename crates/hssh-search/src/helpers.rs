//! Processes that help a search: whoever carries requests to them, and their answers back.

use std::fmt::Debug;
use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;

/// Processes that search the same, each with an [`Expander`](crate::Expander). This crate knows of no network: whoever has one implements this.
pub trait Helpers: Debug + Send + Sync {
    /// How many there are.
    fn count(&self) -> usize;

    /// Work of less time is not worth the way to them.
    fn least_work(&self) -> Duration {
        Duration::from_micros(200)
    }

    /// Sends each request to the helper of its number, does `meanwhile`, and waits for the answers, in the order of the requests. `None` if one of
    /// them cannot answer any more; from then on, always.
    fn ask(&self, requests: Vec<Vec<u8>>, meanwhile: &mut dyn FnMut()) -> Option<Vec<Vec<u8>>>;
}

/// What a request asks for; it is its first byte.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Asked {
    /// The successors of nodes.
    Steps = 1,
    /// The turns of leaves.
    Turns = 2,
}

/// A value as bytes, after those that are there.
pub(crate) fn written(before: Vec<u8>, value: &impl Serialize) -> Vec<u8> {
    postcard::to_extend(value, before).expect("numbers, lists and texts can be written to memory")
}

/// The value that bytes are; `None` if they are none.
pub(crate) fn read<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    postcard::from_bytes(bytes).ok()
}
