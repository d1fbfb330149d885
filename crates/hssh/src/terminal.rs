//! Text that is safe to show, and what is said beside the output.

use std::io::Write;

/// Says something on standard error; nothing in it commands the terminal, and it does not matter whether anybody reads it.
pub(crate) fn say(text: &str) {
    let _ = writeln!(std::io::stderr(), "{}", harmless(text));
}

/// Text with what is no character to be shown written as its code: names of files and of stars may hold anything.
pub(crate) fn harmless(text: &str) -> String {
    let is_shown = |c: char| !c.is_control() || c == '\n' || c == '\t';
    if text.chars().all(is_shown) {
        return text.to_owned();
    }
    let shown = |c: char| if is_shown(c) { c.to_string() } else { c.escape_debug().to_string() };
    text.chars().map(shown).collect()
}

#[cfg(test)]
mod tests {
    use super::harmless;

    #[test]
    fn nothing_commands_the_terminal() {
        assert_eq!(harmless("a\tb\nü → \u{1b}[31mred\r\u{7}"), "a\tb\nü → \\u{1b}[31mred\\r\\u{7}");
    }
}
