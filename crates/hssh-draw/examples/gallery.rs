//! Draws a gallery of maps and search trees: `cargo run -p hssh-draw --example gallery -- <directory>`.

use std::path::PathBuf;

#[path = "../tests/pictures/common.rs"]
#[allow(clippy::unwrap_used, reason = "the stars and routes are constants")]
mod common;

use common::{Grid, random_planar};
use hssh_draw::{
    Bearings, Drawing, MapOptions, SearchTree, TreeOptions, draw_map, draw_tree, map_to_dot, tree_to_dot,
};
use hssh_search::{Mapper, Visit};
use hssh_topology::{Axioms, Hypothesis, Olp, PlaceId, Star, StarCatalog, TopologicalMap};

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let directory = std::env::args().nth(1).ok_or("say where the pictures go: gallery <directory>")?;
    let directory = PathBuf::from(directory);
    std::fs::create_dir_all(&directory)?;
    let write = |name: &str, text: String| std::fs::write(directory.join(name), text);
    let schematic = |title: &str, map: &TopologicalMap, current, star_names| -> Result<String, Failure> {
        let drawing = Drawing::schematic(map, &Bearings::none())?;
        let options =
            MapOptions { title: Some(title.to_owned()), current, star_names, ..MapOptions::default() };
        Ok(draw_map(map, &drawing, &options))
    };
    let letters = |count: usize| (0..count).map(|star| char::from(b'A' + star as u8).to_string()).collect();

    let mut catalog = StarCatalog::new();
    let grid = Grid { rows: 3, columns: 3 };
    let map = grid.map(&mut catalog);
    write("grid.svg", schematic("3 × 3 grid", &map, Some(PlaceId::new(4)), letters(9))?)?;
    write("grid.dot", map_to_dot(&map, &catalog, &MapOptions::default()))?;

    let (tee, six) = ("0+ 1+ 0- (1-)".parse::<Star>()?, "0+ 1+ 2+ 0- 1- 2-".parse::<Star>()?);
    write(
        "tee.svg",
        schematic("T-shaped", &tee_map(&mut catalog, &tee), Some(PlaceId::new(1)), Vec::new())?,
    )?;
    write(
        "six.svg",
        schematic("Three local paths", &six_map(&mut catalog, &six), Some(PlaceId::new(0)), Vec::new())?,
    )?;

    let mut mapper = Mapper::builder().start(&grid.star((0, 0)))?;
    grid.explore(&grid.snake()[..9], &mut mapper);
    for (rank, ranked) in mapper.maps(3).iter().enumerate() {
        let Hypothesis { map, position } = mapper.hypothesis(ranked.node);
        write(
            &format!("partial{rank}.svg"),
            schematic("Partly explored", &map, Some(position.place), letters(9))?,
        )?;
    }
    let options =
        TreeOptions { title: Some("3 × 3 grid, first 8 travels".to_owned()), ..TreeOptions::default() };
    let best: Vec<_> = mapper.maps(1).iter().map(|ranked| ranked.node).collect();
    let tree = SearchTree::of(mapper.tree(), mapper.experience(), &best, options.most_maps);
    write("tree.svg", draw_tree(&tree, &options)?)?;
    write("tree.dot", tree_to_dot(&tree, &options)?)?;

    let mut mapper = Mapper::builder().start(&grid.star((0, 0)))?;
    grid.explore(&grid.snake(), &mut mapper);
    let best: Vec<_> = mapper.maps(2).iter().map(|ranked| ranked.node).collect();
    let tree = SearchTree::of(mapper.tree(), mapper.experience(), &best, options.most_maps);
    let options = TreeOptions { title: Some("3 × 3 grid, all 16 travels".to_owned()), ..options };
    write("bigtree.svg", draw_tree(&tree, &options)?)?;

    let grid = Grid { rows: 2, columns: 2 };
    let axioms = Axioms { max_places: Some(4), ..Axioms::default() };
    let mut mapper = Mapper::builder().axioms(axioms).start(&"0+ (1+) (0-) 1-".parse()?)?;
    let corner: Star = "0+ (1+) (0-) 1-".parse()?;
    for _ in 0..3 {
        mapper.observe(Visit::new(Olp::new(0), Olp::new(3), &corner))?;
    }
    mapper.observe(Visit::new(Olp::new(0), Olp::new(3), &"0+ (1+) 0- 1-".parse()?))?;
    mapper.observe(Visit::new(Olp::new(0), Olp::new(3), &corner))?;
    mapper.advance();
    let best: Vec<_> = mapper.maps(1).iter().map(|ranked| ranked.node).collect();
    let options = TreeOptions { title: Some("Corners and a T, at most four places".to_owned()), ..options };
    let tree = SearchTree::of(mapper.tree(), mapper.experience(), &best, 60);
    write("square.svg", draw_tree(&tree, &options)?)?;
    write("two.svg", schematic("2 × 2 grid", &grid.map(&mut catalog), None, Vec::new())?)?;

    let grid = Grid { rows: 4, columns: 4 };
    let axioms = Axioms { max_places: Some(16), max_genus: Some(0), ..Axioms::default() };
    let mut mapper = Mapper::builder().axioms(axioms).start(&grid.star((0, 0)))?;
    grid.explore(&grid.snake(), &mut mapper);
    for (rank, ranked) in mapper.maps(4).iter().enumerate() {
        let Hypothesis { map, position } = mapper.hypothesis(ranked.node);
        write(
            &format!("minimal{rank}.svg"),
            schematic("4 × 4 grid", &map, Some(position.place), Vec::new())?,
        )?;
    }

    let mut mapper = Mapper::builder().axioms(axioms).start(&grid.star((0, 0)))?;
    grid.explore(&grid.snake()[..26], &mut mapper);
    let best: Vec<_> = mapper.maps(1).iter().map(|ranked| ranked.node).collect();
    let tree = SearchTree::of(mapper.tree(), mapper.experience(), &best, options.most_maps);
    let options = TreeOptions { title: Some("4 × 4 grid, planar, first 25 travels".to_owned()), ..options };
    write("hugetree.svg", draw_tree(&tree, &options)?)?;

    for (places, closures, seed) in [(40, 12, 1), (40, 25, 2), (200, 60, 3), (2, 0, 4), (12, 4, 5)] {
        let (map, _) = random_planar(places, closures, seed);
        let title = format!("Random planar map of {places} places");
        write(
            &format!("random{seed}.svg"),
            schematic(&title, &map, Some(PlaceId::new(places / 2)), letters(6))?,
        )?;
    }
    Ok(())
}

/// Links an end of one place to an end of another.
fn link(map: &mut TopologicalMap, (place, end): (PlaceId, u32), (other, far): (PlaceId, u32)) {
    let pending = |place, end| map.pending(map.olp(place, Olp::new(end))).expect("it is linked once");
    map.link(pending(place, end), pending(other, far));
}

/// Three places along a T.
fn tee_map(catalog: &mut StarCatalog, tee: &Star) -> TopologicalMap {
    let id = catalog.intern(tee);
    let mut map = TopologicalMap::new();
    let places = [0; 3].map(|_| map.add_place(id, tee));
    link(&mut map, (places[1], 0), (places[0], 2));
    link(&mut map, (places[1], 1), (places[2], 1));
    map
}

/// A place with six ends, three of them linked.
fn six_map(catalog: &mut StarCatalog, six: &Star) -> TopologicalMap {
    let id = catalog.intern(six);
    let mut map = TopologicalMap::new();
    let places = [0; 4].map(|_| map.add_place(id, six));
    for (end, place) in [(0, 1), (1, 2), (3, 3)] {
        link(&mut map, (places[0], end), (places[place], (end + 3) % 6));
    }
    link(&mut map, (places[1], 2), (places[2], 5));
    map
}
