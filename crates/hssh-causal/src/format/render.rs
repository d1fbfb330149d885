//! Problems shown under the source line they stand in, as plain text.

use super::error::{ParseError, Problem};

/// A longer source line is shown only around the problem.
const SHOWN_CHARACTERS: usize = 120;

impl ParseError {
    /// The problems as a person reads them in a terminal: message, place, source line with the
    /// fault underlined, help. `source` is the text that was read, `file_name` only its title.
    #[must_use]
    pub fn render(&self, file_name: &str, source: &str) -> String {
        let lines: Vec<&str> = source.trim_start_matches('\u{feff}').lines().collect();
        let mut shown: Vec<String> = self
            .problems()
            .iter()
            .map(|problem| {
                render_problem(problem, file_name, lines.get(problem.line() - 1).copied().unwrap_or(""))
            })
            .collect();
        if self.unlisted() > 0 {
            shown.push(format!("and {} more problems", self.unlisted()));
        }
        shown.join("\n\n")
    }
}

fn render_problem(problem: &Problem, file_name: &str, line: &str) -> String {
    let number = problem.line().to_string();
    let margin = " ".repeat(number.len());
    let (text, indent, underline) = excerpt(line, problem.column() - 1, problem.length());
    let indent = " ".repeat(indent);
    let underline = "^".repeat(underline.max(1));
    format!(
        "error: {message}\n\
         {margin}--> {file_name}:{number}:{column}\n\
         {margin} |\n\
         {number} | {text}\n\
         {margin} | {indent}{underline}\n\
         help: {help}",
        message = problem.message(),
        column = problem.column(),
        help = problem.help(),
    )
}

/// The line as a terminal shows it, the cells before the fault, and the cells the fault takes.
fn excerpt(line: &str, start: usize, length: usize) -> (String, usize, usize) {
    let characters: Vec<char> = line.chars().collect();
    let start = start.min(characters.len());
    let first =
        if characters.len() > SHOWN_CHARACTERS { start.saturating_sub(SHOWN_CHARACTERS / 2) } else { 0 };
    let last = characters.len().min(first + SHOWN_CHARACTERS);
    let end = (start + length).min(last);
    let cells = |range: &[char]| range.iter().map(|&c| width(c)).sum::<usize>();
    let mut text = String::new();
    let mut indent = cells(&characters[first..start]);
    if first > 0 {
        text.push('…');
        indent += 1;
    }
    characters[first..last].iter().for_each(|&c| push_printable(&mut text, c));
    if last < characters.len() {
        text.push('…');
    }
    (text.trim_end().to_owned(), indent, cells(&characters[start..end]))
}

/// Appends a character in a form that takes [`width`] cells: a tab as four spaces, a control
/// character as the replacement character.
fn push_printable(text: &mut String, c: char) {
    match c {
        '\t' => text.push_str("    "),
        c if c.is_control() => text.push('\u{fffd}'),
        c => text.push(c),
    }
}

/// The cells of a terminal that a character takes: marks that combine with the character before
/// take none, East Asian wide characters and pictographs two.
fn width(c: char) -> usize {
    match c {
        '\t' => 4,
        '\u{300}'..='\u{36f}'
        | '\u{200b}'..='\u{200f}'
        | '\u{20d0}'..='\u{20ff}'
        | '\u{fe00}'..='\u{fe0f}' => 0,
        '\u{1100}'..='\u{115f}'
        | '\u{2e80}'..='\u{303e}'
        | '\u{3041}'..='\u{a4cf}'
        | '\u{ac00}'..='\u{d7a3}'
        | '\u{f900}'..='\u{faff}'
        | '\u{fe30}'..='\u{fe6f}'
        | '\u{ff00}'..='\u{ff60}'
        | '\u{ffe0}'..='\u{ffe6}'
        | '\u{1f300}'..='\u{1f64f}'
        | '\u{1f680}'..='\u{1f9ff}'
        | '\u{20000}'..='\u{3fffd}' => 2,
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn underlines_line_up_in_terminal_cells() {
        assert_eq!(excerpt("\tab", 1, 1), ("    ab".to_owned(), 4, 1));
        assert_eq!(excerpt("部屋 x", 0, 2), ("部屋 x".to_owned(), 0, 4));
        assert_eq!(excerpt("部屋 x", 3, 1), ("部屋 x".to_owned(), 5, 1));
        assert_eq!(excerpt("e\u{301}x", 2, 1), ("e\u{301}x".to_owned(), 1, 1));
        assert_eq!(excerpt("a\0b", 1, 1), ("a\u{fffd}b".to_owned(), 1, 1));
        assert_eq!(excerpt("", 0, 0), (String::new(), 0, 0));
    }

    #[test]
    fn long_lines_are_cut_around_the_fault() {
        let line = format!("{}X{}", "a".repeat(500), "b".repeat(500));
        let (text, indent, underline) = excerpt(&line, 500, 1);
        assert_eq!(text.chars().nth(indent), Some('X'));
        assert_eq!(underline, 1);
        assert!(text.starts_with('…') && text.ends_with('…'));
        assert_eq!(text.chars().count(), SHOWN_CHARACTERS + 2);
    }
}
