//! YAML as the parsers of robots read it: numbers in millimetres, texts that no reader takes for anything else.

use serde::Serialize;

/// A document of plain structs.
pub(super) fn to_yaml(document: &impl Serialize) -> String {
    let options = serde_saphyr::ser_options! { prefer_block_scalars: false };
    serde_saphyr::to_string_with_options(document, options)
        .expect("structs, lists, texts and numbers are YAML")
}

/// A number to the millimetre, so that it is written without an exponent, which not all readers know.
pub(super) fn rounded(metres: f64) -> f64 {
    // No minus before a zero.
    (metres * 1e3).round() / 1e3 + 0.0
}
