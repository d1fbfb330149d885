//! The numbers by which stars, maps and embedded graphs name their parts: a type for each.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Defines numbers that are no others: made from a number, read as a number or an index, nothing else.
macro_rules! ids {
    ($($(#[$attribute:meta])* $name:ident)*) => {$(
        $(#[$attribute])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
        #[serde(transparent)]
        pub struct $name(u32);

        impl $name {
            /// The one with that number.
            #[must_use]
            pub const fn new(number: u32) -> Self {
                $name(number)
            }

            /// Its number.
            #[must_use]
            pub const fn number(self) -> u32 {
                self.0
            }

            /// Its number, as an index.
            #[must_use]
            pub const fn index(self) -> usize {
                self.0 as usize
            }
        }

        /// The number.
        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(&self.0, f)
            }
        }
    )*};
}

ids! {
    /// An oriented local path *of one star*: its position in the clockwise order, counted from 0.
    ///
    /// It means nothing without the star it indexes. Names such as `1+` belong to the star
    /// ([`Star::name`](crate::Star::name), [`Star::find`](crate::Star::find)).
    Olp

    /// A star of a [`StarCatalog`](crate::StarCatalog).
    #[derive(Default)]
    StarId

    /// An oriented local path *of a map*: one end in the star of one place.
    ///
    /// Numbered place by place in order of creation, clockwise within a place.
    MapOlp

    /// A place of a map; also the vertex of that number in its embedded graph.
    PlaceId

    /// A path of a map. When two paths become one, the one with more places gives its identity.
    PathId

    /// A vertex of an [`EmbeddedGraph`](crate::EmbeddedGraph).
    Vertex

    /// A directed edge leaving its source: an element of T(E), or a pending edge.
    Dart

    /// A label that two pending edges share if and only if they lie in the same face.
    ///
    /// Labels are not consecutive, and linking may change them.
    FaceLabel
}

impl Olp {
    /// The oriented local path that many positions clockwise of this one, in a star of that degree.
    #[must_use]
    pub const fn turned(self, clockwise: u32, degree: u32) -> Self {
        Olp((self.0 + clockwise) % degree)
    }

    /// How many positions clockwise of this one `other` is, in a star of that degree that has both.
    #[must_use]
    pub const fn turn_to(self, other: Olp, degree: u32) -> u32 {
        if other.0 >= self.0 { other.0 - self.0 } else { other.0 + degree - self.0 }
    }
}
