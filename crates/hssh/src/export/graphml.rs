//! GraphML: places and ways with all that is known of them, for networkx, Gephi, yEd and others.

use std::collections::BTreeMap;

use super::provenance::Fact;
use super::route_graph::{RouteGraph, RouteNode, RouteWay};
use super::xml::XmlText;

/// The ways are the edges of an undirected graph, in the order of the ways, with ids `w0`, `w1`, …; nodes have ids `n0`, `n1`, …. Two
/// nodes may have several edges, and a node may have one to itself. What is not known is left out.
#[must_use]
pub fn graphml(graph: &RouteGraph) -> String {
    let about = graph.provenance.facts();
    let nodes: Vec<_> = graph.nodes.iter().map(of_node).collect();
    let ways: Vec<_> = graph.ways.iter().map(of_way).collect();
    let mut keys = Keys::default();
    keys.add("graph", &about);
    nodes.iter().for_each(|facts| keys.add("node", facts));
    ways.iter().for_each(|facts| keys.add("edge", facts));
    let mut text = XmlText::new();
    text.within("graphml", &[("xmlns", "http://graphml.graphdrawing.org/xmlns")], |text| {
        for ((of, name), (id, kind)) in &keys.0 {
            let key = [("id", id.as_str()), ("for", *of), ("attr.name", *name), ("attr.type", *kind)];
            text.empty("key", &key);
        }
        text.within("graph", &[("id", "map"), ("edgedefault", "undirected")], |text| {
            keys.data("graph", &about, text);
            for (number, facts) in nodes.iter().enumerate() {
                let id = format!("n{number}");
                text.within("node", &[("id", &id)], |text| keys.data("node", facts, text));
            }
            for (number, (way, facts)) in graph.ways.iter().zip(&ways).enumerate() {
                let [source, target] = way.ends.map(|end| format!("n{end}"));
                let id = format!("w{number}");
                let attributes = [("id", id.as_str()), ("source", &source), ("target", &target)];
                text.within("edge", &attributes, |text| keys.data("edge", facts, text));
            }
        });
    });
    text.done()
}

/// The keys of all data, by what they are for and their names: id and type.
#[derive(Default)]
struct Keys(BTreeMap<(&'static str, &'static str), (String, &'static str)>);

impl Keys {
    fn add(&mut self, of: &'static str, facts: &[(&'static str, Fact<'_>)]) {
        for (name, fact) in facts {
            let kind = match fact {
                Fact::Text(_) | Fact::Line(_) => "string",
                Fact::Count(_) => "long",
                Fact::Number(_) => "double",
            };
            self.0.entry((of, name)).or_insert_with(|| (format!("{of}.{name}"), kind));
        }
    }

    fn data(&self, of: &'static str, facts: &[(&'static str, Fact<'_>)], text: &mut XmlText) {
        for (name, fact) in facts {
            let (id, _) = &self.0[&(of, *name)];
            text.element("data", &[("key", id)], &fact.to_string());
        }
    }
}

fn of_node(node: &RouteNode) -> Vec<(&'static str, Fact<'_>)> {
    let coordinate = |axis: usize| node.position.map(|position| Fact::Number(position[axis]));
    known([
        ("name", Some(Fact::Text(&node.name))),
        ("kind", Some(Fact::Text(&node.kind))),
        ("x", coordinate(0)),
        ("y", coordinate(1)),
        ("theta", node.heading.map(Fact::Number)),
        ("star", node.star.as_deref().map(Fact::Text)),
        ("pending", node.pending.map(|pending| Fact::Count(u64::from(pending)))),
    ])
}

fn of_way(way: &RouteWay) -> Vec<(&'static str, Fact<'_>)> {
    let gateway = |end: usize| Some(Fact::Text(&way.gateways.as_ref()?[end]));
    known([
        ("from_end", gateway(0)),
        ("to_end", gateway(1)),
        ("origin", Some(Fact::Text(way.origin.name()))),
        ("length", way.length().map(Fact::Number)),
        ("width", way.width.map(Fact::Number)),
        ("line", (way.line.len() > 1).then_some(Fact::Line(&way.line))),
    ])
}

/// What is known and finite.
fn known<'a, const N: usize>(facts: [(&'static str, Option<Fact<'a>>); N]) -> Vec<(&'static str, Fact<'a>)> {
    let is_told = |fact: &Fact<'_>| !matches!(fact, Fact::Number(number) if !number.is_finite());
    facts.into_iter().filter_map(|(name, fact)| Some((name, fact.filter(is_told)?))).collect()
}
