//! The example in the page about the format is an exploration.

use hssh_causal::Exploration;

const PAGE: &str = include_str!("../../../docs/exploration-format.md");

#[test]
fn the_page_shows_a_valid_exploration() {
    let (_, rest) = PAGE.split_once("```ron\n").expect("the page has an example");
    let (example, _) = rest.split_once("```").expect("the example ends");
    let exploration =
        Exploration::from_ron(example).unwrap_or_else(|error| panic!("{}", error.render("page", example)));
    assert_eq!(exploration.star_types().len(), 3);
    assert_eq!(exploration.travels().len(), 3);
}

#[test]
fn the_page_shows_a_message_as_it_is() {
    let text = include_str!("data/corridors.ron").replacen("exit: \"1+\"", "exit: \"0+\"", 1);
    let message = Exploration::from_ron(&text).unwrap_err().render("loop.ron", &text);
    assert!(PAGE.contains(&message), "{message}");
}
