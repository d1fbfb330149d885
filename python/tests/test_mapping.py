"""Explorations: published counts, constraints, limits, answers as objects, and going on travel by travel."""

import dataclasses
import json
import pickle
import threading
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import hssh
import numpy as np
import pytest
from signals import interrupting
from worlds import explored, snake

FIXTURES = Path(__file__).parents[2] / "fixtures"
ACES = FIXTURES / "aces.ron"


@pytest.mark.parametrize(
    "planar, nodes, maps, final, closed, optimal, genera",
    [(False, 317, 188, 88, 4, 2, [0, 1]), (True, 240, 147, 62, 3, 1, [0])],
)
def test_published_counts_of_three_by_three(planar, nodes, maps, final, closed, optimal, genera):
    answer = hssh.map(explored(3, 3, snake(3, 3)), planar=planar, listed=None)
    found = answer.search.found
    assert (answer.search.nodes, answer.search.maps_made, found.maps) == (nodes, maps, final)
    assert (found.closed, found.tied, len(answer.maps)) == (closed, optimal, final)
    best = [map.measure for map in answer.maps[:optimal]]
    assert [(measure.undetermined_boundaries, measure.paths, measure.places) for measure in best] == [(0, 6, 9)] * optimal
    assert sorted(measure.genus for measure in best) == genera
    levels = [level.nodes for level in answer.search.levels]
    assert levels[:13] == [1, 1, 1, 1, 1, 2, 2, 4, 4, 7, 7, 11, 18 if planar else 21]


def test_published_counts_of_four_by_four():
    answer = hssh.map(explored(4, 4, snake(4, 4)), planar=True, max_places=16, method="count")
    assert (answer.search.nodes, answer.search.maps_made, answer.search.found.maps) == (8_452, 4_951, 545)
    assert answer.search.found.closed == 6


def test_the_map_of_aces():
    answer = hssh.map(ACES, planar=True)
    best = answer.best
    assert answer.verdict.kind == "one_best" and best.optimal and best.closed
    assert (best.measure.places, len(best.links), best.measure.paths) == (9, 12, 6)
    assert best.poses.shape == (9, 3) and best.edges.shape == (12, 2)
    np.testing.assert_array_equal(best.poses[0], 0)
    assert np.asarray(best.places[3].pose).tolist() == best.poses[3].tolist()
    graph = answer.pose_graph()
    np.testing.assert_allclose(graph.poses, best.poses, atol=1e-12)
    np.testing.assert_allclose(
        graph.optimize(start="poses").marginals().covariance(4), best.places[4].pose.covariance, rtol=1e-6, atol=1e-9
    )
    assert answer.explain().check.startswith("An independent replay agrees")
    assert answer.certificate_text().startswith("hssh-certificate")
    assert answer.trajectory() is None and answer.scan_graph() is None
    with pytest.raises(hssh.ArgumentError, match="only a laser log has them"):
        answer.grid()
    with pytest.raises(hssh.ArgumentError, match="there is no map number 99"):
        answer.pose_graph(99)


def test_maps_are_graphs_of_networkx():
    networkx = pytest.importorskip("networkx")
    graph = hssh.map(ACES, planar=True).best.to_networkx()
    assert (graph.number_of_nodes(), graph.number_of_edges()) == (9, 12)
    assert networkx.check_planarity(networkx.Graph(graph))[0]


def test_what_is_known_of_visits_is_a_constraint():
    exploration = explored(3, 3, snake(3, 3))
    plain = hssh.map(exploration, planar=True, listed=None)
    pairs = [(0, 12)]
    apart = hssh.map(exploration, planar=True, different=pairs, listed=None)
    together = hssh.map(exploration, planar=True, same=np.array(pairs), listed=None)
    assert len(apart.maps) + len(together.maps) == len(plain.maps)
    assert all(map.visits[0].place == map.visits[12].place for map in together.maps)
    with pytest.raises(hssh.ArgumentError, match="said to be at different places, and also"):
        hssh.map(exploration, same=pairs, different=pairs)
    with pytest.raises(hssh.ArgumentError, match="there is no visit 99"):
        hssh.map(exploration, same=[(0, 99)])


def test_errors_of_perception_are_told():
    answer = hssh.map(FIXTURES / "misread.ron", planar=True, readings=True)
    assert answer.readings.corrections and all(correction.sentence for correction in answer.readings.corrections)
    assert answer.exploration() != hssh.read_exploration(FIXTURES / "misread.ron")


def test_limits_stop_a_search_with_what_it_knows():
    exploration = explored(5, 5, snake(5, 5))
    answer = hssh.map(exploration, nodes=2_000)
    assert (answer.search.stop, answer.verdict.kind) == ("node_limit", "stopped_early")
    assert 0 < answer.input.explained < len(exploration) and answer.maps
    begun = time.monotonic()
    answer = hssh.map(exploration, seconds=0.2)
    assert answer.search.stop == "time_limit" and time.monotonic() - begun < 20
    answer = hssh.map(exploration, mebibytes=1)
    assert answer.search.stop == "memory_limit"
    answer = hssh.map(exploration, travels=6)
    assert answer.input.considered == 6


def test_control_c_stops_a_search_and_keeps_what_is_known():
    exploration = explored(6, 6, snake(6, 6))
    begun = time.monotonic()
    stop = interrupting(0.5, lambda: hssh.map(exploration, seconds=60))
    assert time.monotonic() - begun < 30
    assert isinstance(stop, KeyboardInterrupt) and isinstance(stop.partial, hssh.Answer)
    assert stop.partial.search.stop == "interrupted" and stop.partial.maps
    assert len(hssh.map(ACES, planar=True).maps) >= 1, "the next search begins anew"


def test_other_threads_go_on_during_a_search():
    ticks = []
    done = threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    hssh.map(explored(6, 6, snake(6, 6)), seconds=0.5)
    done.set()
    thread.join()
    assert len(ticks) > 10


class TestOptions:
    def test_each_reaches_the_search(self):
        exploration = explored(3, 3, snake(3, 3))
        options = [
            {"method": "proof"},
            {"method": "cyclic", "closed": True},
            {"method": "best_first"},
            {"max_genus": 1},
            {"perpendicular": True},
            {"consistent_boundaries": True},
            {"circular_paths": True},
            {"genus": "first"},
            {"threads": 1},
        ]
        answers = [hssh.map(exploration, **option) for option in options]
        assert all(answer.maps for answer in answers)
        assert answers[0].search.order == "proof" and answers[0].certificate.proved
        assert answers[1].search.closed_only
        assert answers[6].search.nodes >= 317

    def test_posteriors_have_theirs(self):
        for options in ({"score": "likelihood", "prior": "simplicity", "weights": (0, 2, 1)}, {"area": 4000.0}, {"best": 2, "rest": 0.5}):
            answer = hssh.map(ACES, planar=True, **options)
            assert answer.search.objective == "posterior" and answer.best.costs.total > 0
            assert 0 <= answer.best.probability[0] <= answer.best.probability[1] <= 1

    @pytest.mark.parametrize(
        "options, kind, words",
        [
            ({"method": "depth_first"}, hssh.ArgumentError, "unknown variant `depth_first`, expected one of `breadth_first`"),
            ({"planar": True, "max_genus": 1}, hssh.ArgumentError, "leave out max_genus, or planar"),
            ({"seconds": -1.0}, hssh.ArgumentError, "the option limits.seconds is -1"),
            ({"seconds": float("nan")}, hssh.ArgumentError, "no finite number"),
            ({"closed": True}, hssh.ArgumentError, "only closed maps are asked for"),
            ({"perpendicular": True, "self_intersection": True}, hssh.ArgumentError, "maps cannot be held to be perpendicular"),
            ({"method": "posterior"}, hssh.SearchError, "travel 1 has no odometry"),
            ({"readings": True}, hssh.ArgumentError, "some travel of the exploration has no odometry"),
            ({"narrowest": 0.5}, hssh.ArgumentError, "what counts as a place is for logs"),
            ({"same": [(1, 1)]}, hssh.ArgumentError, "visit 1 stands twice in a pair"),
            ({"max_places": "nine"}, hssh.ArgumentError, "invalid type: string"),
            ({"speed": 1}, TypeError, "unexpected keyword argument 'speed'"),
            ({"nodes": object()}, TypeError, "which is no number"),
        ],
    )
    def test_what_makes_no_sense_is_refused(self, options, kind, words):
        with pytest.raises(kind, match=words):
            hssh.map(explored(3, 3, snake(3, 3)), **options)

    def test_only_what_can_be_mapped_is(self):
        with pytest.raises(TypeError, match="not of PoseGraph"):
            hssh.map(FIXTURES / "graphs" / "two-laps.g2o")
        with pytest.raises(TypeError, match="not of int"):
            hssh.map(17)


class TestExplorations:
    def test_texts_and_pickles_come_back(self):
        exploration = hssh.read_exploration(ACES)
        assert hssh.Exploration.from_ron(exploration.to_ron()).travels == exploration.travels
        assert pickle.loads(pickle.dumps(exploration)) == exploration
        built = hssh.Exploration(exploration.stars, exploration.start, exploration.travels)
        assert built.to_ron() == exploration.to_ron()
        assert built.visits == [exploration.start, *[travel.star for travel in exploration.travels]]

    def test_travels_say_where_and_what_was_measured(self):
        travel = hssh.read_exploration(ACES).travels[0]
        assert travel.odometry.shape == (3,) and travel.covariance.shape == (3, 3)
        star = "0+ (0-)"
        tuples = [("0+", "0+", "s", (5, 0, np.pi), (0.1, 0.1, 0.01))]
        exploration = hssh.Exploration({"s": star}, "s", tuples)
        np.testing.assert_array_equal(exploration.travels[0].covariance, np.diag([0.1, 0.1, 0.01]))
        assert len(exploration.prefix(0)) == 0 and exploration.prefix(0)

    @pytest.mark.parametrize(
        "travels, kind, words",
        [
            ([("5+", "0+", "s")], hssh.ArgumentError, r"travels\[0\]: star `s` has no end `5\+`: its ends are 0\+, 0-"),
            ([(2, "0+", "s")], hssh.ArgumentError, "has no end number 2: it has 2, counted from 0"),
            ([("0-", "0+", "s")], hssh.ArgumentError, "travel 1: the robot cannot leave star `s` by `0-`, which is closed"),
            ([("0+", "0+", "t")], hssh.ArgumentError, r"travels\[0\]'s star `t` is not among the stars: s"),
            ([("0+", "0+")], TypeError, "a travel is"),
            ([17], TypeError, r"travels\[0\] is 17"),
            ([("0+", "0+", "s", (1, 2, 3), None)], hssh.ArgumentError, "has odometry or a covariance, but not both"),
            ([("0+", "0+", "s", (1, 2), np.eye(3))], hssh.ArgumentError, r"must have the shape \(3,\), not \(2,\)"),
            ([("0+", "0+", "s", (1, 2, np.nan), np.eye(3))], hssh.ArgumentError, "which is no finite number"),
            ([("0+", "0+", "s", (1, 2, 3), -np.eye(3))], hssh.ArgumentError, "not positive definite"),
            ([("0+", "0+", "s", (1, 2, 3), np.eye(2))], hssh.ArgumentError, r"not \(2, 2\)"),
        ],
    )
    def test_what_cannot_have_happened_is_refused(self, travels, kind, words):
        with pytest.raises(kind, match=words):
            hssh.Exploration({"s": "0+ (0-)"}, "s", travels)

    def test_mistakes_in_texts_are_told_with_their_place(self):
        text = (FIXTURES / "malformed" / "exit_is_closed.ron").read_text()
        with pytest.raises(hssh.FormatError) as raised:
            hssh.Exploration.from_ron(text, "exit_is_closed.ron")
        assert str(raised.value).startswith("error: ") and "help: " in str(raised.value)
        assert f"exit_is_closed.ron:{raised.value.line}:{raised.value.column}" in str(raised.value)


class TestAnswers:
    def answer(self):
        return hssh.map(ACES, planar=True)

    def test_every_field_is_an_attribute(self):
        for answer in (self.answer(), hssh.map(FIXTURES / "misread.ron", planar=True, readings=True)):
            whole = json.loads(answer.to_json())
            del whole["format"], whole["version"]
            for name, value in whole.items():
                compare(getattr(answer, name) if name != "maps" else list(answer.maps), value, name)

    def test_answers_come_back_from_texts(self):
        answer = self.answer()
        again = hssh.Answer.from_json(answer.to_json())
        assert again == answer == pickle.loads(pickle.dumps(answer))
        assert again.maps[0] == answer.maps[0] and again.best.to_svg() == answer.best.to_svg()
        with pytest.raises(hssh.ArgumentError, match="only what hssh.map gives has this"):
            again.pose_graph()
        with pytest.raises(hssh.FormatError, match="this is no answer"):
            hssh.Answer.from_json("{}")

    def test_notebooks_get_well_formed_documents(self):
        answer = self.answer()
        for html in (answer._repr_html_(), answer.best._repr_html_()):
            root = ElementTree.fromstring(html)
            assert root.tag == "div" and root.find(".//{http://www.w3.org/2000/svg}svg") is not None
        assert ElementTree.fromstring(answer.best._repr_svg_()).tag.endswith("svg")
        assert ElementTree.fromstring(answer.tree_svg()).tag.endswith("svg")
        assert answer.tree_dot().startswith("digraph") and "{" in answer.best.to_dot()
        rude = hssh.Exploration({"<&>": "0+ (0-)"}, "<&>", [("0+", "0+", "<&>")])
        assert ElementTree.fromstring(hssh.map(rude)._repr_html_()).tag == "div"
        nothing = hssh.map(explored(3, 3, snake(3, 3)), max_places=2)
        assert nothing.verdict.kind == "no_map" and nothing.best is None
        assert ElementTree.fromstring(nothing._repr_html_()).tag == "div"

    def test_they_read_as_the_program_prints_them(self):
        answer = self.answer()
        assert answer.verdict.sentence in str(answer)
        assert "levels" not in repr(answer) and "travels" in answer.to_text(levels=True)
        assert answer.maps[-1] is answer.maps[len(answer.maps) - 1]
        assert [map.rank for map in answer.maps[:3]] == list(range(1, len(answer.maps[:3]) + 1))


def compare(made, data, path):
    """Whether an object says everything that its JSON does."""
    if isinstance(data, dict) and dataclasses.is_dataclass(made):
        names = {field.metadata.get("json", field.name): field.name for field in dataclasses.fields(made)}
        for key, value in data.items():
            assert key in names, f"{path}.{key} is no attribute"
            compare(getattr(made, names[key]), value, f"{path}.{key}")
    elif isinstance(data, list):
        assert len(made) == len(data), path
        for index, (one, other) in enumerate(zip(made, data)):
            compare(one, other, f"{path}[{index}]")
    else:
        assert made == data, path


class TestOnline:
    def told(self, mapper, exploration):
        for travel in exploration.travels:
            star = exploration.stars[travel.star]
            mapper.travel(
                travel.exit, travel.entry, star, odometry=travel.odometry, covariance=travel.covariance, name=travel.star
            )
            yield

    def test_the_answer_is_that_of_all_travels_so_far(self):
        exploration = explored(3, 3, snake(3, 3))
        mapper = hssh.Mapper(exploration.stars[exploration.start], exploration.start, planar=True, listed=None)
        for number, _ in enumerate(self.told(mapper, exploration), 1):
            now, all_at_once = mapper.answer(), hssh.map(exploration.prefix(number), planar=True, listed=None)
            assert [map.branch for map in now.maps] == [map.branch for map in all_at_once.maps]
            assert now.verdict == all_at_once.verdict and now.maps[0] == all_at_once.maps[0]
        assert mapper.exploration == exploration or mapper.exploration.travels == exploration.travels

    def test_measured_travels_are_weighed(self):
        exploration = hssh.read_exploration(ACES)
        mapper = hssh.Mapper(exploration.stars[exploration.start], exploration.start, planar=True)
        for _ in self.told(mapper, exploration):
            mapper.advance()
        now, all_at_once = mapper.answer(), hssh.map(exploration, planar=True)
        assert now.search.objective == "posterior"
        assert now.best.branch == all_at_once.best.branch
        np.testing.assert_allclose(now.best.poses, all_at_once.best.poses, atol=1e-6)
        assert now.best.costs.total == pytest.approx(all_at_once.best.costs.total, rel=1e-6)

    def test_what_cannot_have_happened_changes_nothing(self):
        mapper = hssh.Mapper("0+ 1+ 0- 1-")
        for travel, words in [
            (("7+", "0+", "0+ (0-)"), "of the departure has no end `7\\+`"),
            (("0+", "0-", "0+ (0-)"), "cannot enter star .* by `0-`, which is closed"),
        ]:
            with pytest.raises(hssh.ArgumentError, match=words):
                mapper.travel(*travel)
        assert len(mapper) == 0 and len(mapper.answer().maps) == 1
        mapper.travel("0+", "0+", "0+ (0-)", odometry=(5, 0, 0), covariance=(0.1, 0.1, 0.01))
        with pytest.raises(hssh.ArgumentError, match="travel 2 has no odometry"):
            mapper.travel("0+", "0+", "0+ 1+ 0- 1-")
        assert len(mapper) == 1
        for refused in ({"method": "count"}, {"readings": True}, {"travels": 3}):
            with pytest.raises(hssh.ArgumentError):
                hssh.Mapper("0+ 0-", **refused)

    def test_limits_and_signals_leave_it_to_go_on(self):
        exploration = explored(6, 6, snake(6, 6))
        mapper = hssh.Mapper(exploration.stars[exploration.start])
        for _ in self.told(mapper, exploration):
            pass
        assert mapper.advance(nodes=500) == "node_limit"
        before = mapper.answer().search.nodes
        assert 0 < before < 1000, "the levels that are complete"
        stop = interrupting(0.5, lambda: mapper.advance(seconds=60, nodes=10**9))
        assert isinstance(stop.partial, hssh.Answer) and stop.partial.search.stop == "interrupted"
        assert stop.partial.search.nodes > before
        assert mapper.advance(seconds=0.2) == "time_limit"
