//! "Did you mean": the known word nearest to a misspelled one.

/// The known word within a few edits of `word`, if there is one; the first of several.
pub(super) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    let tolerated = (word.chars().count() / 3).max(1);
    known
        .into_iter()
        .map(|candidate| (edit_distance(&word, &candidate.to_lowercase()), candidate))
        .filter(|&(distance, candidate)| distance <= tolerated && distance < candidate.chars().count())
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// "did you mean `x`? " or nothing, ready to stand before a list of what is known.
pub(super) fn did_you_mean<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    nearest(word, known).map(|candidate| format!("did you mean `{candidate}`? ")).unwrap_or_default()
}

/// Words in backquotes, with commas between them; only the first ones of very many.
pub(super) fn listed<T: std::fmt::Display>(words: impl IntoIterator<Item = T>) -> String {
    const LISTED: usize = 12;
    let mut words = words.into_iter();
    let mut listed: Vec<String> = words.by_ref().take(LISTED).map(|word| format!("`{word}`")).collect();
    match words.count() {
        0 => {}
        more => listed.push(format!("and {more} more")),
    }
    listed.join(", ")
}

/// Levenshtein's distance, in characters; words longer than any sensible name are just far apart.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().take(64).collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().take(64).enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &to) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(from != to);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_misspellings_and_nothing_else() {
        assert_eq!(nearest("entri", ["exit", "entry", "star"]), Some("entry"));
        assert_eq!(nearest("Covariance", ["covariance"]), Some("covariance"));
        assert_eq!(nearest("dor", ["door", "L"]), Some("door"));
        assert_eq!(nearest("kitchen", ["exit", "entry", "star"]), None);
        assert_eq!(nearest("X", ["L", "T"]), None);
    }

    #[test]
    fn distance_is_a_metric_on_examples() {
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("sitting", "kitten"), 3);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("same", "same"), 0);
    }
}
