#!/usr/bin/env python3
"""Time GTSAM and g2o on pose graphs.

Reads g2o files whose vertices are the poses to start from, solves each with both programs by Gauss-Newton
until chi2 falls by less than a given part of itself, and prints one line of JSON per file and program: the
iterations, the best and the median seconds of one solve (without reading the file and without building the
graph), and the chi2 at which it ends, without a factor 1/2. g2o's residual is e = measured^-1 (start^-1 end);
GTSAM takes the logarithm of the same, so that its chi2 differs from the fifth digit on, and its poses too. The
first pose is held fixed.

Set up once, in any folder:

    python3 -m venv peers
    peers/bin/pip install gtsam g2o-python 'numpy<2'
    cargo xtask peers DATA --python peers/bin/python

A program that cannot be imported is left out and named on standard error.
"""

import argparse
import json
import statistics
import sys
import time

MOST_STEPS = 100


def main():
    """Reads, solves, prints."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", help="g2o files with VERTEX_SE2 and EDGE_SE2 records")
    parser.add_argument("--runs", type=int, default=9, help="solves of each file, after one that does not count")
    parser.add_argument("--tolerance", type=float, default=1e-6, help="stop when chi2 falls by less, relatively")
    options = parser.parse_args()
    peers = available_peers()
    for path in options.files:
        try:
            poses, edges = read_g2o(path)
        except (OSError, ValueError) as error:
            sys.exit(f"{path}: {error}")
        for name, peer in peers:
            print(json.dumps(measure(name, peer(poses, edges, options.tolerance), path, options.runs)))
            sys.stdout.flush()


def available_peers():
    """Name and class of each program that is installed."""
    peers = []
    for name, peer, module in [("GTSAM", Gtsam, "gtsam"), ("g2o", G2o, "g2o")]:
        try:
            peer.library = __import__(module)
            peers.append((name, peer))
        except ImportError as error:
            print(f"{name} is left out: {error}", file=sys.stderr)
    return peers


def measure(name, solver, path, runs):
    """Solves once for nothing, then as often as asked."""
    seconds = []
    for run in range(runs + 1):
        solver.prepare()
        start = time.perf_counter()
        iterations = solver.solve()
        if run > 0:
            seconds.append(time.perf_counter() - start)
    return {
        "peer": name,
        "file": path,
        "iterations": iterations,
        "best": min(seconds),
        "median": statistics.median(seconds),
        "chi2": solver.chi2(),
    }


def count_steps(step, error, tolerance):
    """How many steps it takes until one changes the error by less than the tolerance; that one included."""
    before = error()
    for steps in range(1, MOST_STEPS + 1):
        step()
        after = error()
        if abs(before - after) < tolerance * before:
            return steps
        before = after
    return MOST_STEPS


class Gtsam:
    """GTSAM: a factor graph, Gauss-Newton, its default multifrontal elimination."""

    library = None

    def __init__(self, poses, edges, tolerance):
        gtsam = self.library
        self.graph = gtsam.NonlinearFactorGraph()
        for start, end, measured, information in edges:
            noise = gtsam.noiseModel.Gaussian.Information(information)
            self.graph.add(gtsam.BetweenFactorPose2(start, end, gtsam.Pose2(*measured), noise))
        first = min(poses)
        self.graph.add(gtsam.NonlinearEqualityPose2(first, gtsam.Pose2(*poses[first])))
        self.initial = gtsam.Values()
        for label, pose in poses.items():
            self.initial.insert(label, gtsam.Pose2(*pose))
        self.steps = self.count_steps(tolerance)
        self.result = None

    def optimizer(self):
        """A new optimizer at the start; the first elimination finds the ordering."""
        return self.library.GaussNewtonOptimizer(self.graph, self.initial, self.library.GaussNewtonParams())

    def count_steps(self, tolerance):
        """How many iterations it takes; its own loop would also stop where the error rises for once."""
        optimizer = self.optimizer()
        return count_steps(optimizer.iterate, optimizer.error, tolerance)

    def prepare(self):
        """Nothing to put back: the initial values stay as they are."""

    def solve(self):
        """One whole solve with the counted iterations, so that no time is spent on a stopping rule."""
        optimizer = self.optimizer()
        for _ in range(self.steps):
            optimizer.iterate()
        self.result = optimizer.values()
        return self.steps

    def chi2(self):
        """At the end of the last solve."""
        return 2.0 * self.graph.error(self.result)


class G2o:
    """g2o: Gauss-Newton on blocks of three, Eigen's sparse Cholesky, which is what its Python package has."""

    library = None

    def __init__(self, poses, edges, tolerance):
        g2o = self.library
        self.initial = poses
        self.optimizer = g2o.SparseOptimizer()
        solver = g2o.BlockSolverSE2(g2o.LinearSolverEigenSE2())
        self.optimizer.set_algorithm(g2o.OptimizationAlgorithmGaussNewton(solver))
        self.vertices = {}
        for label in sorted(poses):
            vertex = g2o.VertexSE2()
            vertex.set_id(label)
            vertex.set_fixed(label == min(poses))
            self.optimizer.add_vertex(vertex)
            self.vertices[label] = vertex
        for start, end, measured, information in edges:
            edge = g2o.EdgeSE2()
            edge.set_vertex(0, self.vertices[start])
            edge.set_vertex(1, self.vertices[end])
            edge.set_measurement(g2o.SE2(*measured))
            edge.set_information(information)
            self.optimizer.add_edge(edge)
        self.optimizer.initialize_optimization()
        self.prepare()
        self.steps = count_steps(lambda: self.optimizer.optimize(1), self.error, tolerance)

    def error(self):
        """chi2 at the present poses."""
        self.optimizer.compute_active_errors()
        return self.optimizer.active_chi2()

    def prepare(self):
        """Puts all poses back to where they start."""
        for label, vertex in self.vertices.items():
            vertex.set_estimate(self.library.SE2(*self.initial[label]))

    def solve(self):
        """One whole solve with the counted iterations, so that no time is spent on a stopping rule."""
        self.optimizer.initialize_optimization()
        return self.optimizer.optimize(self.steps)

    def chi2(self):
        """At the end of the last solve."""
        return self.error()


def read_g2o(path):
    """Poses by label, and edges as (start, end, measured pose, 3x3 information)."""
    import numpy

    poses, edges = {}, []
    with open(path, encoding="utf-8") as text:
        for line in text:
            record, *words = line.split() or [""]
            if record == "VERTEX_SE2":
                poses[int(words[0])] = tuple(float(word) for word in words[1:4])
            elif record == "EDGE_SE2":
                a, b, c, d, e, f = (float(word) for word in words[5:11])
                information = numpy.array([[a, b, c], [b, d, e], [c, e, f]])
                edges.append((int(words[0]), int(words[1]), tuple(float(word) for word in words[2:5]), information))
    if not poses or not edges:
        raise ValueError("no VERTEX_SE2 or no EDGE_SE2 records")
    return poses, edges


if __name__ == "__main__":
    main()
