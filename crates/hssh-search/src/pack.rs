//! What open hypotheses carry along, as plain data.

use hssh_topology::Axioms;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::leaf::{Appraise, Leaf};
use crate::tree::NodeId;

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

    /// The same load again, of a search under those axioms. `None` if it refers to what is not there.
    fn unpack(packed: Self::Packed, read: &Self::Read, axioms: &Axioms) -> Option<Self::Load>;
}

/// A leaf, its load packed.
#[derive(Serialize, Deserialize)]
pub(crate) struct PackedLeaf<K, L>(K, u32, NodeId, u32, u32, L);

impl<K: Copy, L> PackedLeaf<K, L> {
    pub(crate) fn of<A: Pack<Key = K, Packed = L>>(leaf: &Leaf<A>, shared: &A::Shared<'_>) -> Self {
        let Leaf { key, arrival, node, depth, pending, ref load } = *leaf;
        PackedLeaf(key, arrival, node, depth, pending, A::pack(load, shared))
    }

    /// The same leaf again, of a search under those axioms. `None` if it refers to what is not there.
    pub(crate) fn unpack<A: Pack<Key = K, Packed = L>>(
        self,
        read: &A::Read,
        axioms: &Axioms,
    ) -> Option<Leaf<A>> {
        let PackedLeaf(key, arrival, node, depth, pending, load) = self;
        Some(Leaf { key, arrival, node, depth, pending, load: A::unpack(load, read, axioms)? })
    }
}
