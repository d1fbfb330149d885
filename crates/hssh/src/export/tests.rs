//! Random maps, written and read back by parsers that share no code with the writers: everything is there, and where it was.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use roxmltree::Document;
use serde_json::Value;

use super::route_graph::distance;
use super::*;
use crate::answer::{
    AnsweredBuilding, AnsweredEnd, AnsweredLink, AnsweredMap, AnsweredPassage, AnsweredPlace, EndReference,
    EndState, PlacedPose,
};
use crate::pipeline::{Input, MappingOptions, map};

/// An answer with one map, which is proved to be the only one.
fn answer() -> Answer {
    let text = r#"(
        stars: { "west": ["0+ @0", "0- @180 closed"], "east": ["0+ @0 closed", "0- @180"] },
        start: "west",
        travels: [(exit: "0+", entry: "0-", star: "east"), (exit: "0-", entry: "0+", star: "west")],
    )"#;
    let input = Input::from_ron("corridor.ron", text).unwrap();
    map(&input, &MappingOptions::default(), &Default::default()).unwrap().answer
}

/// The answer with another map.
fn answer_with(places: Vec<AnsweredPlace>, links: Vec<AnsweredLink>) -> Answer {
    let mut answer = answer();
    answer.maps[0] = AnsweredMap { places, links, ..answer.maps[0].clone() };
    answer
}

/// Two places in a corridor ten metres apart, in a building with a door three metres along and another one beside the corridor.
#[test]
fn a_lane_names_the_door_that_it_leads_through() {
    let mut answer = answer();
    for (place, x) in answer.maps[0].places.iter_mut().zip([0.0, 10.0]) {
        place.pose = Some(PlacedPose { x, y: 0.0, theta: 0.0, covariance: None });
    }
    let door = |line| AnsweredPassage {
        kind: "door".to_owned(),
        door_probability: 0.9,
        regions: [0, 1],
        width: 1.0,
        line,
    };
    let passages = vec![door([[6.0, 1.0], [7.0, 1.0]]), door([[3.0, -0.5], [3.0, 0.5]])];
    answer.building = Some(AnsweredBuilding { passages, ..AnsweredBuilding::default() });
    let file: Value = serde_saphyr::from_str(&exported(&answer, ExportKind::OpenRmf)).unwrap();
    assert_eq!(numbers(&file["doors"]["door 1"]["endpoints"][1]), [3.0, 0.5]);
    let lanes = file["levels"]["L1"]["lanes"].as_array().unwrap();
    let through: Vec<[u64; 2]> = lanes
        .iter()
        .filter(|lane| lane[2]["door_name"] == "door 1")
        .map(|lane| [0, 1].map(|end| lane[end].as_u64().unwrap()))
        .collect();
    // The one node between is at five metres.
    assert_eq!(through, [[0, 2], [2, 0]]);
    assert!(lanes.iter().all(|lane| lane[2]["door_name"] != "door 0"));
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![-40.0..40.0_f64, Just(0.0), Just(-0.0), Just(1.0), -1e-9..1e-9_f64]
}

fn point() -> impl Strategy<Value = [f64; 2]> {
    [coordinate(), coordinate()]
}

/// Texts with all that may break a file: quotes, tags, line ends, control characters, what YAML takes for something else.
fn name() -> impl Strategy<Value = String> {
    prop_oneof![
        "\\PC{0,12}",
        "[ -~\\x00-\\x1f\\x7f\\x85\\u{2028}\\u{feff}\\u{fffe}]{0,12}",
        prop::sample::select(vec![
            "", "null", "yes", "1.0", "a: b", "- a", "]]>", "<!--", "&amp;", "# a", "{}", "'\"\\"
        ])
        .prop_map(str::to_owned),
    ]
}

/// A place with four ends, whose gateways lie two metres around it.
fn place() -> impl Strategy<Value = AnsweredPlace> {
    (point(), -3.0..3.0_f64, name()).prop_map(|([x, y], theta, star)| {
        let end = |(number, name): (u32, &str)| {
            let across = |side: f64| {
                let angle = -std::f64::consts::FRAC_PI_2 * f64::from(number) + 0.4 * side;
                [2.0 * angle.cos(), 2.0 * angle.sin()]
            };
            AnsweredEnd {
                name: name.to_owned(),
                state: EndState::Linked,
                label: None,
                bearing: None,
                leads_to: None,
                gateway: Some([across(1.0), across(-1.0)]),
            }
        };
        let ends = (0..).zip(["0+", "1+", "0-", "1-"]).map(end).collect();
        AnsweredPlace { star, ends, region: None, pose: Some(PlacedPose { x, y, theta, covariance: None }) }
    })
}

/// Places and links with ways, some with corners and some without any line.
fn places_and_links() -> impl Strategy<Value = (Vec<AnsweredPlace>, Vec<AnsweredLink>)> {
    prop::collection::vec(place(), 2..7).prop_flat_map(|places| {
        let count = places.len() as u32;
        let end = move || {
            let names = prop::sample::select(vec!["0+", "1+", "0-", "1-"]);
            (0..count, names).prop_map(|(place, end)| EndReference { place, end: end.to_owned() })
        };
        let centers: Vec<[f64; 2]> =
            places.iter().filter_map(|place| place.pose).map(|pose| [pose.x, pose.y]).collect();
        let link = (end(), end(), prop::option::of(prop::collection::vec(point(), 1..6))).prop_map(
            move |(from, mut to, inner)| {
                let is_loop = from.place == to.place;
                if from == to {
                    // No gateway leads to itself.
                    to.end = if from.end == "0+" { "0-" } else { "0+" }.to_owned();
                }
                let [first, last] = [&from, &to].map(|end| centers[end.place as usize]);
                // Only a line tells how a way leads back to where it began.
                let away = [first[0] + 3.0, first[1]];
                let inner =
                    if is_loop { Some([inner.unwrap_or_default(), vec![away]].concat()) } else { inner };
                let way = inner.map(|inner| [vec![first], inner, vec![last]].concat());
                AnsweredLink { from, to, way: way.unwrap_or_default() }
            },
        );
        (Just(places), prop::collection::vec(link, 1..8))
    })
}

fn centers(answer: &Answer) -> Vec<[f64; 2]> {
    answer.maps[0].places.iter().filter_map(|place| place.pose).map(|pose| [pose.x, pose.y]).collect()
}

/// The line of a link from place to place.
fn line(answer: &Answer, link: &AnsweredLink) -> Vec<[f64; 2]> {
    let ends = [&link.from, &link.to].map(|end| centers(answer)[end.place as usize]);
    if link.way.is_empty() { ends.to_vec() } else { link.way.clone() }
}

fn length(line: &[[f64; 2]]) -> f64 {
    line.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
}

fn exported(answer: &Answer, kind: ExportKind) -> String {
    export_map(answer, None, kind, Spacing::default()).unwrap().text
}

fn numbers(value: &Value) -> [f64; 2] {
    [&value[0], &value[1]].map(|number| number.as_f64().unwrap())
}

/// As the loader of the Route Server converts metadata: it throws at anything else.
fn is_converted(metadata: &Value) -> bool {
    let is_plain = |value: &Value| value.is_number() || value.is_boolean() || value.is_string();
    metadata.as_object().is_some_and(|fields| {
        fields.values().all(|value| match value {
            Value::Object(_) => is_converted(value),
            Value::Array(values) => values.iter().all(is_plain),
            plain => is_plain(plain),
        })
    })
}

/// Whether any two sides of a closed line cross in their middles.
fn crosses_itself(ring: &[[f64; 2]]) -> bool {
    let turn =
        |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let is_parted = |line: &[[f64; 2]], by: &[[f64; 2]]| {
        turn(by[0], by[1], line[0]) * turn(by[0], by[1], line[1]) < -1e-9
    };
    let sides = || ring.windows(2);
    sides().any(|one| sides().any(|other| is_parted(one, other) && is_parted(other, one)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn graphml_holds_all_places_and_ways((places, links) in places_and_links()) {
        let answer = answer_with(places, links);
        let text = exported(&answer, ExportKind::GraphMl);
        let document = Document::parse(&text).unwrap();
        let all = |name: &'static str| document.descendants().filter(move |node| node.has_tag_name(name));
        let keys: BTreeMap<&str, (&str, &str)> = all("key")
            .map(|key| {
                let of = |name| key.attribute(name).unwrap();
                (of("id"), (of("for"), of("attr.name")))
            })
            .collect();
        let data = |node: roxmltree::Node<'_, '_>| -> BTreeMap<String, String> {
            let children = node.children().filter(|child| child.has_tag_name("data"));
            children
                .map(|data| (keys[data.attribute("key").unwrap()].1.to_owned(), data.text().unwrap_or_default().to_owned()))
                .collect()
        };
        let nodes: Vec<_> = all("node").map(data).collect();
        prop_assert_eq!(nodes.len(), answer.maps[0].places.len());
        for (node, place) in nodes.iter().zip(&answer.maps[0].places) {
            let pose = place.pose.unwrap();
            let number = |name: &str| node[name].parse::<f64>().unwrap();
            prop_assert_eq!((number("x"), number("y"), number("theta")), (pose.x, pose.y, pose.theta));
            let is_same = |(read, told): (char, char)| read == told || read == '\u{FFFD}';
            let read = node.get("star").map_or("", String::as_str);
            // A parser may end lines otherwise; that is the only difference allowed, beside what XML cannot say.
            let [read, told] = [read, &place.star].map(|text| text.replace("\r\n", "\n").replace('\r', "\n"));
            prop_assert_eq!(read.chars().count(), told.chars().count());
            prop_assert!(read.chars().zip(told.chars()).all(is_same));
        }
        let edges: Vec<_> = all("edge").collect();
        prop_assert_eq!(edges.len(), answer.maps[0].links.len());
        for (edge, link) in edges.iter().zip(&answer.maps[0].links) {
            prop_assert_eq!(edge.attribute("source").unwrap(), format!("n{}", link.from.place));
            prop_assert_eq!(edge.attribute("target").unwrap(), format!("n{}", link.to.place));
            let told = data(*edge);
            prop_assert_eq!((&told["from_end"], &told["to_end"]), (&link.from.end, &link.to.end));
            let corners: Vec<[f64; 2]> = told["line"]
                .split(", ")
                .map(|corner| {
                    let (x, y) = corner.split_once(' ').unwrap();
                    [x.parse().unwrap(), y.parse().unwrap()]
                })
                .collect();
            prop_assert_eq!(corners, line(&answer, link));
        }
    }

    #[test]
    fn nav2_can_load_it((places, links) in places_and_links(), metres in 0.3..20.0_f64) {
        let answer = answer_with(places, links);
        let spacing = Spacing::new(metres).unwrap();
        let text = export_map(&answer, None, ExportKind::Nav2, spacing).unwrap().text;
        let file: Value = serde_json::from_str(&text).unwrap();
        let mut points: BTreeMap<u64, [f64; 2]> = BTreeMap::new();
        let mut edges: Vec<(u64, [u64; 2], u64, f64)> = Vec::new();
        for feature in file["features"].as_array().unwrap() {
            let properties = &feature["properties"];
            prop_assert!(is_converted(&properties["metadata"]), "{}", properties);
            let unsigned = |value: &Value| u32::try_from(value.as_u64().unwrap()).map(u64::from).unwrap();
            let id = unsigned(&properties["id"]);
            if feature["geometry"]["type"] == "Point" {
                prop_assert_eq!(&properties["frame"], "map");
                prop_assert!(points.insert(id, numbers(&feature["geometry"]["coordinates"])).is_none());
            } else {
                prop_assert!(properties["cost"].is_f64());
                let ends = [unsigned(&properties["startid"]), unsigned(&properties["endid"])];
                edges.push((id, ends, unsigned(&properties["metadata"]["way"]), properties["cost"].as_f64().unwrap()));
            }
        }
        let ids: BTreeSet<u64> = points.keys().copied().chain(edges.iter().map(|edge| edge.0)).collect();
        prop_assert_eq!(ids.len(), points.len() + edges.len());
        for (number, center) in (0..).zip(centers(&answer)) {
            prop_assert_eq!(points[&number], center);
        }
        let count = |ends: [u64; 2], way: u64| edges.iter().filter(|edge| edge.1 == ends && edge.2 == way).count();
        for &(_, [from, to], way, cost) in &edges {
            prop_assert!(from != to && points.contains_key(&from) && points.contains_key(&to));
            prop_assert_eq!(count([from, to], way), count([to, from], way));
            let metres = distance(points[&from], points[&to]);
            prop_assert!((cost - metres).abs() < 1e-9 && metres <= spacing.metres() + 1e-9);
        }
        // Each way is a chain along its line.
        for (number, link) in answer.maps[0].links.iter().enumerate() {
            let legs: Vec<_> = edges.iter().filter(|edge| edge.2 == number as u64).step_by(2).collect();
            prop_assert_eq!(legs[0].1[0], u64::from(link.from.place));
            prop_assert_eq!(legs[legs.len() - 1].1[1], u64::from(link.to.place));
            prop_assert!(legs.windows(2).all(|pair| pair[0].1[1] == pair[1].1[0]));
            let driven: f64 = legs.iter().map(|edge| edge.3).sum();
            let told = line(&answer, link);
            prop_assert!((driven - length(&told)).abs() < 2e-3 * told.len() as f64);
        }
    }

    #[test]
    fn open_rmf_and_topological_navigation_can_load_it((places, links) in places_and_links()) {
        let answer = answer_with(places, links);
        let of_map = |position: &[f64; 2], read: [f64; 2]| distance(*position, read) < 1e-3;

        let file: Value = serde_saphyr::from_str(&exported(&answer, ExportKind::OpenRmf)).unwrap();
        let level = &file["levels"]["L1"];
        let vertices = level["vertices"].as_array().unwrap();
        prop_assert!(centers(&answer).iter().zip(vertices).all(|(at, vertex)| of_map(at, numbers(vertex))));
        let names: Vec<&str> = vertices.iter().map(|vertex| vertex[2]["name"].as_str().unwrap()).collect();
        let named: BTreeSet<&str> = names.iter().copied().filter(|name| !name.is_empty()).collect();
        prop_assert_eq!(named.len(), answer.maps[0].places.len());
        let lanes: Vec<[u64; 2]> = level["lanes"]
            .as_array()
            .unwrap()
            .iter()
            .map(|lane| [lane[0].as_u64().unwrap(), lane[1].as_u64().unwrap()])
            .collect();
        prop_assert!(lanes.iter().flatten().all(|&end| (end as usize) < vertices.len()));
        prop_assert!(lanes.as_chunks::<2>().0.iter().all(|[there, back]| *there == [back[1], back[0]]));
        let corners = vertices.len() - answer.maps[0].places.len();
        prop_assert_eq!(lanes.len() / 2, answer.maps[0].links.len() + corners);
        prop_assert_eq!(&file["building_name"], "corridor.ron");

        let file: Value = serde_saphyr::from_str(&exported(&answer, ExportKind::Tmap)).unwrap();
        let nodes = file["nodes"].as_array().unwrap();
        prop_assert_eq!(nodes.len(), vertices.len());
        let mut words = BTreeSet::new();
        for (number, entry) in nodes.iter().enumerate() {
            let node = &entry["node"];
            let position = &node["pose"]["position"];
            let position = [position["x"].as_f64().unwrap(), position["y"].as_f64().unwrap()];
            prop_assert!(centers(&answer).get(number).is_none_or(|at| of_map(at, position)));
            prop_assert!(words.insert(node["name"].as_str().unwrap()));
            prop_assert_eq!(&entry["meta"]["node"], &node["name"]);
            prop_assert_eq!(node["verts"].as_array().unwrap().len(), 8);
        }
        let pairs: BTreeSet<[u64; 2]> = lanes.iter().copied().collect();
        let edges = nodes.iter().flat_map(|entry| {
            let own = entry["node"]["name"].as_str().unwrap();
            entry["node"]["edges"].as_array().unwrap().iter().map(move |edge| (own, edge))
        });
        let edges: Vec<_> = edges.collect();
        prop_assert_eq!(edges.len(), pairs.len());
        for (own, edge) in edges {
            prop_assert_eq!(edge["edge_id"].as_str().unwrap(), format!("{own}_{}", edge["node"].as_str().unwrap()));
            prop_assert!(words.contains(edge["node"].as_str().unwrap()));
        }
    }

    #[test]
    fn geojson_holds_points_and_lines((places, links) in places_and_links()) {
        let answer = answer_with(places, links);
        let file: Value = serde_json::from_str(&exported(&answer, ExportKind::GeoJson)).unwrap();
        let features = file["features"].as_array().unwrap();
        let (points, lines) = features.split_at(answer.maps[0].places.len());
        let read: Vec<[f64; 2]> = points.iter().map(|point| numbers(&point["geometry"]["coordinates"])).collect();
        prop_assert_eq!(read, centers(&answer));
        for ((place, point), number) in answer.maps[0].places.iter().zip(points).zip(0..) {
            prop_assert_eq!(point["properties"]["star"].as_str().unwrap(), &place.star);
            prop_assert_eq!(point["properties"]["number"].as_u64(), Some(number));
        }
        prop_assert_eq!(lines.len(), answer.maps[0].links.len());
        for (link, way) in answer.maps[0].links.iter().zip(lines) {
            let read: Vec<[f64; 2]> =
                way["geometry"]["coordinates"].as_array().unwrap().iter().map(numbers).collect();
            prop_assert_eq!(read, line(&answer, link));
        }
    }

    /// A passage is a gateway, where the place has it; areas are rings that do not cross themselves.
    #[test]
    fn osm_ag_holds_gateways_as_passages((places, links) in places_and_links()) {
        let answer = answer_with(places, links);
        let text = exported(&answer, ExportKind::OsmAg);
        let document = Document::parse(&text).unwrap();
        let all = |name: &'static str| document.descendants().filter(move |node| node.has_tag_name(name));
        let degree = 6_378_137.0_f64.to_radians();
        let nodes: BTreeMap<&str, [f64; 2]> = all("node")
            .map(|node| {
                let number = |name| node.attribute(name).unwrap().parse::<f64>().unwrap() * degree;
                (node.attribute("id").unwrap(), [number("lon"), number("lat")])
            })
            .collect();
        type Tags<'a> = BTreeMap<&'a str, &'a str>;
        let ways: Vec<(Vec<[f64; 2]>, Tags<'_>)> = all("way")
            .map(|way| {
                let children = |name: &'static str| way.children().filter(move |child| child.has_tag_name(name));
                let corners = children("nd").map(|nd| nodes[nd.attribute("ref").unwrap()]).collect();
                let tags = children("tag").map(|tag| (tag.attribute("k").unwrap(), tag.attribute("v").unwrap()));
                (corners, tags.collect())
            })
            .collect();
        let (places, links) = (&answer.maps[0].places, &answer.maps[0].links);
        let (areas, passages) = ways.split_at(places.len() + links.len());
        let names: BTreeSet<&str> = areas.iter().map(|(_, tags)| tags["name"]).collect();
        prop_assert_eq!(names.len(), areas.len());
        for (ring, tags) in areas {
            prop_assert_eq!(tags["osmAG:type"], "area");
            prop_assert_eq!(tags["osmAG:areatype"], tags["osmAG:areaType"]);
            prop_assert!(ring.len() > 3 && ring.first() == ring.last());
            prop_assert!(!crosses_itself(ring), "{:?}", ring);
        }
        prop_assert_eq!(passages.len(), 2 * links.len());
        let ends = links.iter().enumerate().flat_map(|(number, link)| [(number, &link.from), (number, &link.to)]);
        for ((line, tags), (number, end)) in passages.iter().zip(ends) {
            prop_assert_eq!(tags["osmAG:from"], format!("place {}", end.place));
            prop_assert_eq!(tags["osmAG:to"], format!("way {number}"));
            let place = &places[end.place as usize];
            let pose = place.pose.unwrap();
            let gateway = place.ends.iter().find(|other| other.name == end.end).unwrap().gateway.unwrap();
            for ([x, y], read) in gateway.iter().zip(line) {
                let (sin, cos) = pose.theta.sin_cos();
                let told = [pose.x + cos * x - sin * y, pose.y + sin * x + cos * y];
                prop_assert!(distance(told, *read) < 1e-5);
            }
        }
    }
}

#[test]
fn what_is_missing_is_refused() {
    let answer = answer();
    let refused = |kind| export_map(&answer, None, kind, Spacing::default()).unwrap_err();
    for kind in
        [ExportKind::Nav2, ExportKind::OpenRmf, ExportKind::Tmap, ExportKind::OsmAg, ExportKind::GeoJson]
    {
        assert_eq!(refused(kind), ExportError::NotPlaced { place: 0 }, "{kind}");
    }
    assert!(matches!(refused(ExportKind::Tum), ExportError::NoTrajectory { .. }));
    assert!(matches!(refused(ExportKind::G2o), ExportError::NoPoseGraph { .. }));
    assert!(matches!(refused(ExportKind::Labels), ExportError::OfGridMaps { .. }));
    let second = export_map(&answer, Some(2), ExportKind::GraphMl, Spacing::default());
    assert_eq!(second, Err(ExportError::NoSuchRank { asked: 2, found: 1 }));
    let mut damaged = answer.clone();
    damaged.maps[0].links[0].to.place = 7;
    let error = export_map(&damaged, None, ExportKind::GraphMl, Spacing::default()).unwrap_err();
    assert_eq!(error.to_string(), "the answer is damaged: link 0 leads to place 7, and there are 2 places");
    let mut none = answer.clone();
    none.maps.clear();
    assert!(matches!(
        export_map(&none, None, ExportKind::GraphMl, Spacing::default()),
        Err(ExportError::NoMap { .. })
    ));
}

/// Whoever sends robots by a doubtful map has said so; whoever looks at it is told.
#[test]
fn doubtful_maps_are_no_maps_to_drive_by() {
    let mut places: Vec<AnsweredPlace> = answer().maps[0].places.clone();
    for (place, x) in places.iter_mut().zip([0.0, 7.0]) {
        place.pose = Some(PlacedPose { x, y: 0.0, theta: 0.0, covariance: None });
    }
    let mut answer = answer_with(places, answer().maps[0].links.clone());
    let export = |answer: &Answer, rank, kind| export_map(answer, rank, kind, Spacing::default());
    assert_eq!(export(&answer, None, ExportKind::Nav2).unwrap().warnings, Vec::<String>::new());
    answer.maps[0].probability = Some([0.1, 0.4]);
    for kind in [ExportKind::Nav2, ExportKind::OpenRmf, ExportKind::Tmap, ExportKind::OsmAg] {
        assert!(matches!(export(&answer, None, kind), Err(ExportError::Doubtful { .. })), "{kind}");
    }
    let forced = export(&answer, Some(1), ExportKind::Nav2).unwrap();
    assert_eq!(forced.warnings.len(), 1);
    let file: Value = serde_json::from_str(&forced.text).unwrap();
    assert_eq!(file["hssh"]["probability_at_most"], 0.4);
    assert!(file["hssh"]["doubt"].as_str().unwrap().contains("at most 0.40"));
    for kind in [ExportKind::OpenRmf, ExportKind::Tmap, ExportKind::GraphMl, ExportKind::GeoJson] {
        let forced = export(&answer, Some(1), kind).unwrap();
        assert!(forced.text.contains("at most 0.40") && forced.warnings.len() == 1, "{kind}");
    }
    assert!(export(&answer, None, ExportKind::GraphMl).unwrap().text.contains("at most 0.40"));
    // Equally good maps: none is the best.
    answer.maps[0].probability = None;
    answer.verdict.kind = crate::answer::VerdictKind::SeveralBest;
    assert!(matches!(export(&answer, None, ExportKind::Nav2), Err(ExportError::Doubtful { .. })));
    assert!(export(&answer, Some(1), ExportKind::Nav2).is_ok());
    // A limit came before the end: others may be better.
    answer.verdict.kind = crate::answer::VerdictKind::StoppedEarly;
    assert!(matches!(export(&answer, None, ExportKind::Tmap), Err(ExportError::Doubtful { .. })));
}

#[test]
fn too_many_nodes_are_refused() {
    let mut places = answer().maps[0].places.clone();
    for (place, x) in places.iter_mut().zip([0.0, 1e300]) {
        place.pose = Some(PlacedPose { x, y: 0.0, theta: 0.0, covariance: None });
    }
    let answer = answer_with(places, answer().maps[0].links.clone());
    let error = export_map(&answer, None, ExportKind::Nav2, Spacing::default()).unwrap_err();
    assert_eq!(error, ExportError::TooMany { most: DriveGraph::MOST_POINTS });
    assert_eq!((Spacing::new(0.0), Spacing::new(f64::NAN), Spacing::new(f64::INFINITY)), (None, None, None));
}

/// A link from a place to itself has a length only if somebody drove it.
#[test]
fn a_loop_that_nobody_drove_is_refused() {
    let mut places = answer().maps[0].places.clone();
    for place in &mut places {
        place.pose = Some(PlacedPose { x: 1.0, y: 2.0, theta: 0.0, covariance: None });
    }
    let mut links = answer().maps[0].links.clone();
    links[0].to.place = 0;
    let answer = answer_with(places, links);
    let refused = export_map(&answer, None, ExportKind::Nav2, Spacing::default());
    assert_eq!(refused, Err(ExportError::UnknownLoop { way: 0, place: 0 }));
    assert!(export_map(&answer, None, ExportKind::GraphMl, Spacing::default()).is_ok());
}
