//! Pages: what holds of them whatever a browser makes of them; scripts/page has the checks in one.

#![allow(clippy::unwrap_used, reason = "in tests a failed unwrap is the failed assertion")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use hssh::account::PlacesAccount;
use hssh::causal::Exploration;
use hssh::page::{PageData, PlanData};
use hssh::pipeline::{Input, Mapped, MappingOptions, Monitor, map};
use hssh::world::{grid, snake};
use hssh_local::{RegionMap, RegionOptions, Roadmap, RoadmapOptions, read_map};
use proptest::prelude::*;

/// What the data stand in.
const BEGIN: &str = r#"<script type="application/json" id="data">"#;
const END: &str = "</script>";

fn assets() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src/page/assets")
}

fn input(name: &str) -> Input {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures").join(name);
    Input::exploration(name, Exploration::from_ron(&std::fs::read_to_string(file).unwrap()).unwrap())
}

fn planar() -> MappingOptions {
    MappingOptions::from_ron("(axioms: (max_genus: 0))").unwrap()
}

fn mapped(input: &Input, options: &MappingOptions) -> Mapped {
    map(input, options, &Arc::<Monitor>::default()).unwrap()
}

fn page_data(input: &Input, options: &MappingOptions) -> PageData {
    PageData::new(input, &mapped(input, options), options, 1, &Arc::default()).unwrap()
}

/// A page before, in and behind its data.
fn parts(page: &str) -> [&str; 3] {
    let (before, rest) = page.split_once(BEGIN).unwrap();
    let (data, behind) = rest.split_once(END).unwrap();
    [before, data, behind]
}

/// By number of travels: the branch believed in.
fn branches(data: &PageData) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut branches = Vec::new();
    for belief in &data.history.beliefs {
        words.truncate(belief.kept as usize);
        words.extend(belief.then.split_whitespace().map(str::to_owned));
        branches.push(words.join(" "));
    }
    branches
}

/// The page of the small floor.
fn plan() -> PlanData {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/grids/floor.yaml");
    let grid = read_map(&file).unwrap();
    let map = RegionMap::new(&grid, &RegionOptions::default()).unwrap();
    let roadmap = Roadmap::new(&grid, &map, &RoadmapOptions::default());
    PlanData::new(&PlacesAccount::of_regions("floor.yaml", &map, &roadmap, 0.25), &grid)
}

#[test]
fn a_page_needs_nothing_but_itself() {
    needs_nothing(&page_data(&input("aces.ron"), &planar()).to_html());
    needs_nothing(&plan().to_html());
}

fn needs_nothing(page: &str) {
    let page = page.replace("\"http://www.w3.org/2000/svg\"", ""); // the name of a language, which nobody fetches
    for outside in [
        "http:",
        "https:",
        "//www",
        " src=",
        "@import",
        "url(",
        "import(",
        "fetch(",
        "XMLHttp",
        "<link rel=\"style",
    ] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert_eq!(page.matches("href=").count(), 2, "the icon, which is empty, and the way to the map");
    assert!(page.contains("default-src 'none'") && page.contains("connect-src 'none'"));
}

/// Text that is shown never becomes markup, nor markup a script.
#[test]
fn the_script_makes_no_markup_of_text() {
    let script = std::fs::read_dir(assets().join("js")).unwrap().map(|file| file.unwrap().path());
    for file in script.chain(["head.html", "page.html", "plan.html"].map(|frame| assets().join(frame))) {
        let text = std::fs::read_to_string(&file).unwrap();
        for dangerous in [
            "innerHTML",
            "outerHTML",
            "insertAdjacentHTML",
            "document.write",
            "eval(",
            "Function(",
            " style=",
        ] {
            assert!(!text.contains(dangerous), "{}: {dangerous}", file.display());
        }
    }
}

/// Every file of the scripts is in one of the pages.
#[test]
fn no_part_of_the_script_is_forgotten() {
    let page = page_data(&input("figure-2-4.ron"), &planar()).to_html() + &plan().to_html();
    for file in std::fs::read_dir(assets().join("js")).unwrap() {
        let file = file.unwrap().path();
        assert!(page.contains(&std::fs::read_to_string(&file).unwrap()), "{}", file.display());
    }
}

#[test]
fn what_a_page_shows_can_be_read_from_it() {
    for (name, options) in [("aces.ron", planar()), ("figure-2-4.ron", MappingOptions::default())] {
        let data = page_data(&input(name), &options);
        let page = data.to_html();
        assert_eq!(serde_json::from_str::<PageData>(parts(&page)[1]).unwrap(), data, "{name}");
    }
}

#[test]
fn what_a_plan_shows_can_be_read_from_it() {
    let data = plan();
    assert_eq!((data.account.regions.len(), data.account.passages.len()), (2, 1));
    assert_eq!(serde_json::from_str::<PlanData>(parts(&data.to_html())[1]).unwrap(), data);
    // No name of a region gets out of the data.
    let mut nasty = data.clone();
    nasty.account.regions[0].name = Some("</script><b>".to_owned());
    let (page, usual) = (nasty.to_html(), data.to_html());
    let ([before, shown, behind], [usual_before, _, usual_behind]) = (parts(&page), parts(&usual));
    assert_eq!((before, behind), (usual_before, usual_behind));
    assert!(!shown.contains(['<', '>', '&']));
}

/// Only a page that was served may ask for news, and only of the program that served it.
#[test]
fn a_served_page_may_ask_for_news() {
    let data = PageData { live: Some("/news".to_owned()), ..page_data(&input("figure-2-4.ron"), &planar()) };
    let page = data.to_html();
    assert!(page.contains("connect-src 'self'") && parts(&page)[1].contains(r#""live":"/news""#));
    let waiting = PageData::waiting("a robot", "/news", "nothing has come yet");
    let page = waiting.to_html();
    assert!(page.contains("connect-src 'self'") && waiting.maps.is_empty());
    assert_eq!(serde_json::from_str::<PageData>(parts(&page)[1]).unwrap(), waiting);
}

/// After each travel the on-line search believes what a search of these travels alone finds.
#[test]
fn what_was_believed_is_the_best_map_of_the_travels_so_far() {
    let usual = MappingOptions::default;
    for (name, options) in [("aces.ron", planar()), ("figure-2-4.ron", usual()), ("misread.ron", usual())] {
        let input = input(name);
        let data = page_data(&input, &options);
        let travels = input.as_exploration().travels().len();
        let best = |travels: usize| {
            let mut options = options.clone();
            options.limits.travels = Some(travels);
            options.listed = Some(1);
            mapped(&input, &options).answer.maps.first().map(|map| map.branch.clone())
        };
        let expected: Vec<String> = (0..=travels).map_while(best).collect();
        assert_eq!(branches(&data), expected, "{name}");
        assert_eq!(data.history.end.is_some(), expected.len() <= travels, "{name}: {:?}", data.history.end);
    }
}

/// A tree that is too large to look at loses what no listed map comes of, and says how much.
#[test]
fn a_tree_says_what_it_leaves_out() {
    let world = grid(4, 3, 8.0).unwrap();
    let exploration = world.explore(&world.route_through(&snake(4, 3)).unwrap()).unwrap();
    let all = page_data(&Input::exploration("grid", exploration), &MappingOptions::default());
    let planar = page_data(&input("aces.ron"), &planar());
    for data in [&all, &planar] {
        let tree = data.tree.as_ref().unwrap();
        assert_eq!(tree.made, data.search.nodes);
        let hidden: u64 = tree.nodes.iter().map(|node| node.hidden).sum();
        assert_eq!(tree.nodes.len() as u64 + hidden, tree.made);
        for (number, node) in tree.nodes.iter().enumerate() {
            assert!(node.parent.map_or(number == 0, |parent| (parent as usize) < number));
        }
        // The way to the best map is there: its words lead from the root to it.
        let mut at = tree.nodes.iter().position(|node| node.rank == Some(1)).unwrap();
        let mut words = Vec::new();
        while let Some(parent) = tree.nodes[at].parent {
            words.push(tree.nodes[at].follows.as_str());
            at = parent as usize;
        }
        words.reverse();
        assert_eq!(words.join(" "), data.maps[0].branch);
    }
    let shown = all.tree.as_ref().unwrap().nodes.len() as u64;
    assert!(shown < all.search.nodes, "{shown} of {}", all.search.nodes);
}

#[test]
fn where_no_map_explains_everything_the_best_of_the_first_travels_is_shown() {
    let text = r##"(
        stars: { "a": ["0+", "0- closed"], "b": ["0+ closed", "0-"], "c": ["0+", "0- #door"] },
        start: "a",
        travels: [
            (exit: "0+", entry: "0-", star: "b"),
            (exit: "0-", entry: "0+", star: "a"),
            (exit: "0+", entry: "0-", star: "c"),
        ],
    )"##;
    let data = page_data(&Input::from_ron("none", text).unwrap(), &MappingOptions::default());
    assert_eq!((data.maps.len(), data.history.beliefs.len()), (0, 3));
    assert_eq!(data.history.end.as_deref(), Some("no map explains travel 3"));
    assert_eq!(data.reference.unwrap().branch, "n p");
}

/// Equal input gives equal pages, but for how long the search took.
#[test]
fn pages_do_not_depend_on_chance() {
    let page = |threads| {
        let mut options = planar();
        options.search.threads = threads;
        let mut data = page_data(&input("aces.ron"), &options);
        (data.search.seconds, data.search.bytes) = (0.0, 0);
        data.to_html()
    };
    assert_eq!(page(1), page(3));
}

proptest! {
    /// Whatever texts there are, nothing changes but the data, and nothing in these ends or begins an element.
    #[test]
    fn no_text_gets_out_of_the_data(texts in proptest::collection::vec(nasty(), 4)) {
        let plain = PLAIN.clone();
        let mut data = plain.clone();
        let [name, star, label, sentence] = &texts[..] else { unreachable!("four texts") };
        data.input.name.clone_from(name);
        data.stars[0].name.clone_from(star);
        data.stars[0].ends[0].label = Some(label.clone());
        data.verdict.sentence.clone_from(sentence);
        data.doubt = Some(sentence.clone());
        let (page, usual) = (data.to_html(), plain.to_html());
        let ([before, shown, behind], [usual_before, _, usual_behind]) = (parts(&page), parts(&usual));
        prop_assert_eq!((before, behind), (usual_before, usual_behind));
        prop_assert!(!shown.contains(['<', '>', '&']));
        prop_assert_eq!(serde_json::from_str::<PageData>(shown).unwrap(), data);
    }
}

/// A page to put texts into.
static PLAIN: std::sync::LazyLock<PageData> =
    std::sync::LazyLock::new(|| page_data(&input("figure-2-4.ron"), &MappingOptions::default()));

/// Any text, and often one with what matters to HTML.
fn nasty() -> impl Strategy<Value = String> {
    const PIECES: [&str; 13] = [
        "</script>",
        "<!--",
        "-->",
        "]]>",
        "<script>",
        "&lt;",
        "\"",
        "'",
        "\\",
        "\u{2028}",
        "\0",
        "${x}",
        "é",
    ];
    let piece = prop_oneof![any::<String>(), proptest::sample::select(&PIECES[..]).prop_map(str::to_owned)];
    proptest::collection::vec(piece, 0..4).prop_map(|pieces| pieces.concat())
}
