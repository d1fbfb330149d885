//! What open hypotheses carry along, as plain data.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::leaf::Appraise;

/// An objective whose hypotheses can be written down.
pub(crate) trait Pack: Appraise<Key: Serialize + DeserializeOwned> {
    /// What loads share with one another, each once, as it is written.
    type Shared<'a>: Serialize;
    /// The same as it is read, to make loads of.
    type Read: DeserializeOwned;
    /// The rest of a load, which refers to what is shared.
    type Packed: Serialize + DeserializeOwned;

    /// What these loads share.
    fn share<'a>(loads: impl Iterator<Item = &'a Self::Load>) -> Self::Shared<'a>
    where
        Self: 'a;

    /// One of these loads.
    fn pack(load: &Self::Load, shared: &Self::Shared<'_>) -> Self::Packed;

    /// The same load again. `None` if it refers to what is not there.
    fn unpack(packed: Self::Packed, read: &Self::Read) -> Option<Self::Load>;
}
