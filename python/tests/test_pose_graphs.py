"""Pose graphs against scipy, which shares no code with them, published optima, and everything that arrays can have wrong."""

import os
import pickle
import signal
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import hssh
import numpy as np
import pytest
from scipy.optimize import least_squares
from signals import interrupting

FIXTURES = Path(__file__).parents[2] / "fixtures"
DATA = os.environ.get("HSSH_DATA")


def wrapped(angle):
    return (angle + np.pi) % (2 * np.pi) - np.pi


def between(start, end):
    """The end in the frame of the start, row by row."""
    cos, sin = np.cos(start[..., 2]), np.sin(start[..., 2])
    dx, dy = end[..., 0] - start[..., 0], end[..., 1] - start[..., 1]
    return np.stack([cos * dx + sin * dy, -sin * dx + cos * dy, wrapped(end[..., 2] - start[..., 2])], axis=-1)


def random_graph(seed, count=12, closures=8):
    """A noisy walk with closures, each measurement with an information of its own, in no direction like another."""
    random = np.random.default_rng(seed)
    truth = np.cumsum(random.normal([1.0, 0.3, 0.4], 0.3, (count, 3)), axis=0)
    truth -= truth[0]
    edges = [(i, i + 1) for i in range(count - 1)]
    edges += [tuple(random.choice(count, 2, replace=False)) for _ in range(closures - 1)] + [(count - 1, 0)]
    edges = np.array(edges)
    roots = random.normal(size=(len(edges), 3, 3)) + 4 * np.eye(3)
    information = roots @ roots.transpose(0, 2, 1)
    noise = random.normal(0.0, 0.03, (len(edges), 3))
    return truth, edges, between(truth[edges[:, 0]], truth[edges[:, 1]]) + noise, information


def residuals(flat, edges, measurements, information):
    poses = np.vstack([np.zeros(3), flat.reshape(-1, 3)])
    error = between(measurements, between(poses[edges[:, 0]], poses[edges[:, 1]]))
    factors = np.linalg.cholesky(information)
    return np.einsum("mji,mj->mi", factors, error).ravel()


@pytest.mark.parametrize("seed", range(6))
def test_scipy_finds_the_same_minimum_and_the_same_covariances(seed):
    truth, edges, measurements, information = random_graph(seed)
    found = hssh.PoseGraph(truth, edges, measurements, information).optimize()
    other = least_squares(
        residuals, truth[1:].ravel(), args=(edges, measurements, information), method="lm", xtol=1e-15, ftol=1e-15
    )
    assert found.converged
    assert found.chi2 == pytest.approx(2 * other.cost, rel=1e-9)
    theirs = np.vstack([np.zeros(3), other.x.reshape(-1, 3)])
    np.testing.assert_allclose(found.poses[:, :2], theirs[:, :2], atol=1e-6)
    np.testing.assert_allclose(wrapped(found.poses[:, 2] - theirs[:, 2]), 0, atol=1e-6)
    covariance = np.linalg.inv(other.jac.T @ other.jac).reshape(11, 3, 11, 3)
    marginals = found.marginals()
    blocks = np.stack([covariance[i, :, i] for i in range(11)])
    np.testing.assert_allclose(marginals.covariances()[1:], blocks, rtol=2e-3, atol=1e-6)
    np.testing.assert_array_equal(marginals.covariance(0), np.zeros((3, 3)))
    joint = marginals.joint(3, 7)
    np.testing.assert_allclose(joint[:3, 3:], covariance[2, :, 6], rtol=2e-2, atol=1e-5)


@pytest.mark.parametrize(
    "robust, rho",
    [
        ("huber", lambda s, k: np.where(s <= k * k, s, 2 * k * np.sqrt(np.maximum(s, 1e-300)) - k * k)),
        ("cauchy", lambda s, k: k * k * np.log1p(s / (k * k))),
    ],
)
def test_kernels_minimize_what_they_are_said_to(robust, rho):
    truth, edges, measurements, information = random_graph(3)
    measurements[-1] += [20.0, -10.0, 0.5]
    graph = hssh.PoseGraph(truth, edges, measurements, information)
    found = graph.optimize(robust=robust, start="poses", max_iterations=1000, tolerance=1e-14)
    # Poses that dead reckoning joins directly are believed.
    is_suspect = np.abs(edges[:, 0] - edges[:, 1]) > 1

    def cost(flat):
        chi2 = (residuals(flat, edges, measurements, information).reshape(-1, 3) ** 2).sum(axis=1)
        return np.where(is_suspect, rho(chi2, 3.0), chi2)

    at_ours = cost(found.poses[1:].ravel()).sum()
    assert found.robust_cost == pytest.approx(at_ours, rel=1e-9)
    other = least_squares(lambda flat: np.sqrt(cost(flat)), found.poses[1:].ravel(), xtol=1e-15, ftol=1e-15)
    assert at_ours <= 2 * other.cost * (1 + 1e-6)
    assert found.weights[-1] < 0.9


def test_chi2_is_the_sum_of_what_each_edge_costs():
    truth, edges, measurements, information = random_graph(1)
    graph = hssh.PoseGraph(truth, edges, measurements, information)
    error = graph.errors()
    np.testing.assert_allclose(np.einsum("mi,mij,mj->m", error, information, error), graph.edge_chi2())
    assert graph.chi2() == pytest.approx(graph.edge_chi2().sum())
    mine = between(measurements, between(truth[edges[:, 0]], truth[edges[:, 1]]))
    np.testing.assert_allclose(error, mine, atol=1e-12)


@pytest.mark.parametrize(
    "name, chi2",
    [
        ("MIT.g2o", 41.163269),
        ("CSAIL.g2o", 40.555129),
        ("intel.g2o", 45.004696),
        ("manhattan.g2o", 3549.0368),
        ("input_M3500b_g2o.g2o", 2054.7159),
        ("ring.g2o", 11.163101),
    ],
)
def test_published_optima(name, chi2):
    if not DATA:
        pytest.skip("no real data: HSSH_DATA names no folder")
    graph = hssh.read_pose_graph(Path(DATA) / "posegraph" / name)
    assert graph.optimize().chi2 == pytest.approx(chi2, rel=1e-6)


def test_wrong_closures_are_refused():
    graph = hssh.read_pose_graph(FIXTURES / "graphs" / "two-wrong-closures.g2o")
    found = graph.optimize(robust="graduated")
    assert (found.weights == 0).sum() == 2
    assert len(found.graph.edges) == len(graph.edges) - 2
    plain = graph.optimize()
    assert plain.chi2 > 10 * found.chi2


def test_texts_and_pickles_come_back_with_every_bit():
    truth, edges, measurements, information = random_graph(5)
    graph = hssh.PoseGraph(truth, edges, measurements, information, anchored=[0, 3])
    for again in (hssh.PoseGraph.from_text(graph.to_g2o()), pickle.loads(pickle.dumps(graph))):
        for name in ("poses", "edges", "measurements", "information", "anchored", "labels"):
            np.testing.assert_array_equal(getattr(again, name), getattr(graph, name))
    toro = hssh.PoseGraph.from_text(graph.to_toro())
    np.testing.assert_array_equal(toro.information, graph.information)
    assert not toro.anchored.any()


def test_a_graph_without_poses_is_laid_out_by_its_measurements():
    truth, edges, measurements, information = random_graph(2)
    placed = hssh.PoseGraph(truth, edges, measurements, information).optimize()
    free = hssh.PoseGraph(None, edges, measurements, information)
    assert free.optimize().chi2 == pytest.approx(placed.chi2, rel=1e-9)
    with pytest.raises(hssh.ArgumentError, match="does not say where 12 of its 12 poses are"):
        free.optimize(start="poses")
    assert free._repr_svg_() is None
    assert pickle.loads(pickle.dumps(free)).optimize().chi2 == pytest.approx(placed.chi2, rel=1e-9)


def endless_descent():
    """Relaxes a ring that dead reckoning leaves open, pose by pose, until somebody stops it."""
    count = 5000
    edges = [(index, (index + 1) % count) for index in range(count)]
    ring = hssh.PoseGraph(None, edges, np.full((count, 3), [1.0, 0.0, 1.9 * np.pi / count]), np.eye(3))
    return ring.optimize(method="relaxation", start="odometry", max_iterations=10**9, tolerance=1e-300)


def test_control_c_stops_a_descent_and_keeps_the_poses_reached():
    begun = time.monotonic()
    stop = interrupting(0.3, endless_descent)
    assert time.monotonic() - begun < 20
    assert isinstance(stop.partial, hssh.PoseGraphSolution) and not stop.partial.converged
    assert stop.partial.chi2 < stop.partial.initial_chi2 and "interrupted" in stop.partial.ending


def test_what_handles_a_signal_may_optimize_too():
    found = []

    def handle(number, frame):
        found.append(hssh.PoseGraph(None, [(0, 1), (0, 1)], [(1, 0, 0), (3, 0, 0)], np.eye(3)).optimize().chi2)
        if len(found) == 2:
            raise KeyboardInterrupt

    usual = signal.signal(signal.SIGALRM, handle)
    signal.setitimer(signal.ITIMER_REAL, 0.1, 0.2)
    try:
        with pytest.raises(hssh.Interrupted):
            endless_descent()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, usual)
    assert found == [2.0, 2.0]


class TestArrays:
    """Whatever numpy people hand over."""

    def setup_method(self):
        self.parts = random_graph(0)

    def graph(self, **other):
        names = ("poses", "edges", "measurements", "information")
        return hssh.PoseGraph(*[other.get(name, part) for name, part in zip(names, self.parts)])

    def test_strides_order_and_flags_do_not_matter(self):
        usual = self.graph().optimize().poses
        wide = np.zeros((12, 7))
        wide[:, 1:6:2] = self.parts[0]
        frozen = self.parts[2].copy()
        frozen.flags.writeable = False
        swapped = self.parts[3].astype(">f8")
        records = np.zeros(len(self.parts[1]), dtype=[("pad", "i1"), ("ends", "<i4", 2)])
        records["ends"] = self.parts[1]
        for other in (
            {"poses": np.asfortranarray(self.parts[0])},
            {"poses": wide[:, 1:6:2]},
            {"poses": self.parts[0][::-1][::-1]},
            {"measurements": frozen},
            {"information": swapped},
            {"edges": records["ends"]},
            {"edges": self.parts[1].astype(np.uint8)},
            {"edges": self.parts[1].tolist(), "poses": self.parts[0].tolist()},
        ):
            np.testing.assert_array_equal(self.graph(**other).optimize().poses, usual)

    def test_integers_and_single_precision_are_numbers(self):
        assert len(self.graph(poses=self.parts[0].astype(np.float32))) == 12
        assert len(self.graph(poses=np.zeros((12, 3), int))) == 12

    def test_one_information_serves_all(self):
        graph = self.graph(information=np.diag([4.0, 4.0, 9.0]))
        np.testing.assert_array_equal(graph.information[7], np.diag([4.0, 4.0, 9.0]))

    @pytest.mark.parametrize(
        "other, kind, words",
        [
            ({"poses": np.zeros((12, 2))}, ValueError, r"poses must have the shape \(N, 3\), not \(12, 2\)"),
            ({"poses": np.zeros(36)}, ValueError, r"not \(36,\)"),
            ({"poses": np.zeros((12, 3), complex)}, TypeError, "poses must be an array of numbers, not of complex128"),
            ({"poses": [["a", "b", "c"]]}, TypeError, "poses must be an array of numbers"),
            ({"poses": [[1, 2, 3], [4, 5]]}, ValueError, "poses cannot be an array"),
            ({"poses": np.zeros((12, 3), bool)}, TypeError, "not of bool"),
            ({"poses": np.zeros((3, 3))}, ValueError, "indices count from 0 and are below 3"),
            ({"poses": np.full((12, 3), np.nan)}, ValueError, r"poses\[0, 0\] is NaN, which is no finite number"),
            ({"edges": np.zeros((19, 2))}, TypeError, "edges must be an array of integers, not of float64"),
            ({"edges": np.full((19, 2), -1)}, ValueError, r"edges\[0, 0\] is -1"),
            ({"edges": np.full((19, 2), 2)}, ValueError, r"edges\[0\]: an edge leads from pose 2 to itself"),
            ({"edges": np.zeros((0, 2), int)}, ValueError, "0 edges and 19 measurements"),
            ({"measurements": np.zeros((18, 3))}, ValueError, "19 edges and 18 measurements"),
            ({"measurements": np.full((19, 3), np.inf)}, ValueError, r"measurements\[0, 0\] is inf"),
            ({"information": np.zeros((18, 3, 3))}, ValueError, r"information must have the shape \(19, 3, 3\) or \(3, 3\)"),
            ({"information": -np.eye(3)}, ValueError, r"information\[0\] is none: not positive definite"),
            ({"information": np.triu(np.ones((3, 3)))}, ValueError, "not symmetric"),
            ({"information": np.full((3, 3), np.nan)}, ValueError, "which is no finite number"),
            ({"poses": np.broadcast_to(np.zeros(3), (10**9, 3))}, ValueError, "3000000000 numbers"),
            ({"edges": np.full((19, 2), 10**12)}, ValueError, r"edges\[0, 0\] is 1000000000000"),
            ({"poses": object()}, TypeError, "not of object"),
        ],
    )
    def test_what_makes_no_sense_is_refused(self, other, kind, words):
        with pytest.raises(kind, match=words) as raised:
            self.graph(**other)
        if kind is ValueError:
            assert isinstance(raised.value, hssh.ArgumentError)

    def test_nothing_is_a_graph_too(self):
        empty = hssh.PoseGraph([], [], [], [])
        assert (len(empty), empty.chi2()) == (0, 0.0)
        found = empty.optimize()
        assert found.poses.shape == (0, 3) and found.converged
        assert hssh.PoseGraph(np.zeros((0, 3)), np.zeros((0, 2), int), np.zeros((0, 3)), np.zeros((0, 3, 3))).components() == []
        alone = hssh.PoseGraph([[1, 2, 3]], [], [], np.eye(3)).optimize()
        np.testing.assert_array_equal(alone.poses, [[1, 2, 3]])

    def test_anchors_are_indices_or_a_mask(self):
        mask = np.zeros(12, bool)
        mask[[2, 5]] = True
        for anchored in ([2, 5], np.array([5, 2], np.int16), mask):
            graph = hssh.PoseGraph(*self.parts, anchored=anchored)
            np.testing.assert_array_equal(graph.anchored, mask)
            np.testing.assert_array_equal(graph.optimize().poses[5], self.parts[0][5])
        with pytest.raises(hssh.ArgumentError, match=r"anchored must have the shape \(12,\)"):
            hssh.PoseGraph(*self.parts, anchored=np.zeros(5, bool))

    @pytest.mark.parametrize(
        "options, words",
        [
            ({"method": "newton"}, 'method is "newton": write one of linearize_once, gauss_newton'),
            ({"robust": "tukey"}, "write one of huber, cauchy, dcs, graduated"),
            ({"start": "nowhere"}, "write one of best, chordal, odometry, poses"),
            ({"threshold": -1.0}, "threshold is -1: write a positive number"),
            ({"tolerance": float("nan")}, "tolerance is NaN"),
            ({"method": "relaxation", "robust": "dcs"}, "relaxation weighs all edges alike"),
        ],
    )
    def test_options_that_make_no_sense_are_refused(self, options, words):
        with pytest.raises(hssh.ArgumentError, match=words):
            self.graph().optimize(**options)


def test_what_is_not_determined_is_no_solution():
    free = np.diag([1.0, 1.0, 0.0])
    graph = hssh.PoseGraph(np.zeros((3, 3)), [(0, 1), (1, 2)], [(1, 0, 0), (1, 0, 0)], free)
    with pytest.raises(hssh.SolveError, match="could move without any measurement noticing") as raised:
        graph.optimize()
    assert isinstance(raised.value, ArithmeticError) and graph.floating()


def test_pictures_are_well_formed():
    truth, edges, measurements, information = random_graph(4)
    graph = hssh.PoseGraph(truth, edges, measurements, information)
    for svg in (graph._repr_svg_(), graph.optimize()._repr_svg_()):
        assert ElementTree.fromstring(svg).tag == "{http://www.w3.org/2000/svg}svg"
