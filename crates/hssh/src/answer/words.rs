//! Words that several sentences share.

/// A number of things: "1 map", "2 maps".
#[must_use]
pub fn counted(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}
