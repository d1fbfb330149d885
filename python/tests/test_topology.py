"""Stars and embedded graphs against networkx, Euler's formula, and faces traced here."""

import itertools
import pickle

import hssh
import networkx
import numpy as np
import pytest


def test_stars_say_what_they_are():
    star = hssh.Star("0+ (1+) 0- 1-:door", bearings=[np.pi / 2, 0.0, None, float("nan")])
    assert (star.ends, star.gateways) == (["0+", "1+", "0-", "1-"], ["0+", "0-", "1-"])
    assert star.bearings == [np.pi / 2, 0.0, None, None]
    assert star.labels == [None, None, None, "door"]
    assert (star.opposite("1+"), star.opposite(0)) == ("1-", "0-")
    assert str(star) == "0+ (1+) 0- 1-:door"
    assert hssh.Star(str(star), star.bearings) == star == pickle.loads(pickle.dumps(star))
    assert hash(hssh.Star("0+ 0-")) == hash(hssh.Star(["0+", "0-"]))


@pytest.mark.parametrize("spelled, turns", [("0+ 1+ 0- 1-", 4), ("0+ (1+) 0- 1-", 1), ("0+ 1+ (0-) (1-)", 1), ("0+ 0-", 2)])
def test_self_isomorphisms(spelled, turns):
    star = hssh.Star(spelled)
    assert len(star.isomorphisms(star)) == turns


@pytest.mark.parametrize(
    "ends, words",
    [
        ("", "a star needs at least one local path"),
        ("0+ 0+", "`0\\+` stands twice"),
        ("0+ 1-", "has no opposite"),
        ("north", "does not name an oriented local path"),
    ],
)
def test_what_is_no_star_is_refused(ends, words):
    with pytest.raises(hssh.ArgumentError, match=words):
        hssh.Star(ends)


def test_bearings_must_agree_with_the_order():
    with pytest.raises(hssh.ArgumentError, match="contradicts the clockwise order"):
        hssh.Star("0+ 1+ 0- 1-", [0.0, 1.0, 2.0, 3.0])
    with pytest.raises(hssh.ArgumentError, match="has 2 ends but 1 bearings"):
        hssh.Star("0+ 0-", [0.0])
    with pytest.raises(TypeError, match="a star is a text"):
        hssh.Star(17)


def faces_of(graph):
    """The orbits of the permutation that goes from a dart to the one before its reverse: nothing of the package but the links."""
    pairs = [tuple(pair) for pair in graph.links]
    reverse = {a: b for a, b in pairs} | {b: a for a, b in pairs}
    around = {}
    for dart in reverse:
        around.setdefault(graph.source(dart), []).append(dart)
    before = {}
    for darts in around.values():
        darts.sort()
        before |= {dart: darts[index - 1] for index, dart in enumerate(darts)}
    faces, seen = [], set()
    for start in sorted(reverse):
        if start not in seen:
            face, dart = [], start
            while dart not in seen:
                seen.add(dart)
                face.append(dart)
                dart = before[reverse[dart]]
            faces.append(face)
    return faces


@pytest.mark.parametrize("seed", range(20))
def test_faces_and_genus_by_euler(seed):
    random = np.random.default_rng(seed)
    degrees = random.integers(0, 6, 12)
    darts = random.permutation(degrees.sum())
    pairs = darts[: len(darts) // 2 * 2].reshape(-1, 2)[: random.integers(0, len(darts) // 2 + 1)]
    graph = hssh.EmbeddedGraph(degrees.tolist(), pairs)
    assert graph.faces() == faces_of(graph) and graph.face_count == len(graph.faces())
    other = networkx.MultiGraph()
    other.add_nodes_from(range(12))
    other.add_edges_from((graph.source(int(a)), graph.source(int(b))) for a, b in pairs)
    parts = list(networkx.connected_components(other))
    assert graph.component_count == len(parts)
    with_edges = [part for part in parts if other.subgraph(part).number_of_edges()]
    vertices = sum(map(len, with_edges))
    # V - E + F = 2 - 2g, part by part.
    assert vertices - graph.edge_count + graph.face_count == 2 * len(with_edges) - 2 * graph.genus


@pytest.mark.parametrize("seed", range(40))
def test_networkx_and_ours_agree_on_embeddings(seed):
    graph = networkx.gnm_random_graph(9, 14, seed=seed)
    is_planar, embedding = networkx.check_planarity(graph)
    if is_planar:
        ours = hssh.EmbeddedGraph.from_rotations(embedding.get_data())
        assert ours.is_planar and ours.edge_count == 14
        theirs, marked = 0, set()
        for edge in embedding.edges():
            if edge not in marked:
                embedding.traverse_face(*edge, mark_half_edges=marked)
                theirs += 1
        assert ours.face_count == theirs


@pytest.mark.parametrize("seed", range(12))
def test_a_graph_is_planar_if_some_rotation_has_genus_zero(seed):
    graph = networkx.gnm_random_graph(6, 9 + seed % 3, seed=seed)
    if max(dict(graph.degree).values()) > 4:
        pytest.skip("too many rotations to try all")
    around = {vertex: list(graph[vertex]) for vertex in graph}
    turns = [[[order[0], *rest] for rest in itertools.permutations(order[1:])] if order else [[]] for order in around.values()]
    least = min(
        hssh.EmbeddedGraph.from_rotations(dict(zip(around, rotation))).genus for rotation in itertools.product(*turns)
    )
    assert (least == 0) == networkx.check_planarity(graph)[0]


def test_graphs_grow_and_tell_before_whether_the_genus_stays():
    graph = hssh.EmbeddedGraph()
    first, second = graph.add_vertex(4), graph.add_vertex(2)
    graph.link(first[0], second[0])
    assert graph.share_face(first[1], second[1]) and graph.is_planar
    graph.link(first[1], first[3])
    assert not graph.share_face(first[2], second[1])
    graph.link(first[2], second[1])
    assert (graph.genus, graph.pending, graph.vertex_count) == (1, [], 2)
    assert (graph.reverse(first[0]), graph.source(second[1])) == (second[0], 1)


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda: hssh.EmbeddedGraph([2], [(0, 2)]), "dart 2 does not exist"),
        (lambda: hssh.EmbeddedGraph([2], [(0, 0)]), "linked twice or to itself"),
        (lambda: hssh.EmbeddedGraph([2**30], []), "more than the"),
        (lambda: hssh.EmbeddedGraph([2]).link(0, 0), "cannot be linked to itself"),
        (lambda: hssh.EmbeddedGraph([2]).link(0, 7), "dart 7 does not exist"),
        (lambda: hssh.EmbeddedGraph([2], [(0, 1)]).link(0, 1), "dart 0 is linked already"),
        (lambda: hssh.EmbeddedGraph.from_rotations({"a": ["b"], "b": []}), "not the other way round"),
        (lambda: hssh.EmbeddedGraph.from_rotations({"a": ["b"]}), "b is a neighbor, but no vertex"),
        (lambda: hssh.EmbeddedGraph.from_rotations({"a": ["a"]}), "is its own neighbor"),
    ],
)
def test_what_is_no_graph_is_refused(make, words):
    with pytest.raises(hssh.ArgumentError, match=words):
        make()
