#!/usr/bin/env python3
"""Solve a pose graph with wrong closures by GTSAM's graduated non-convexity.

    gnc.py FILE.g2o SUSPECTS CHI2

SUSPECTS has a 1 for each edge that may be wrong and a 0 for each other, in the order of the file; a suspect is refused beyond
CHI2. Prints one line of JSON: the poses in the order of their labels, and for each edge whether it is believed. The
vertices of the file are where it starts; the first pose is held fixed. Set up as for peers.py.
"""

import json
import sys

import gtsam

from peers import read_g2o


def main():
    """Reads, solves, prints."""
    path, suspects, threshold = sys.argv[1], sys.argv[2], float(sys.argv[3])
    poses, edges = read_g2o(path)
    graph, known = gtsam.NonlinearFactorGraph(), []
    for number, (start, end, measured, information) in enumerate(edges):
        noise = gtsam.noiseModel.Gaussian.Information(information)
        graph.add(gtsam.BetweenFactorPose2(start, end, gtsam.Pose2(*measured), noise))
        if suspects[number] == "0":
            known.append(number)
    first = min(poses)
    graph.add(gtsam.PriorFactorPose2(first, gtsam.Pose2(*poses[first]), gtsam.noiseModel.Isotropic.Sigma(3, 1e-6)))
    known.append(len(edges))
    initial = gtsam.Values()
    for label, pose in poses.items():
        initial.insert(label, gtsam.Pose2(*pose))
    parameters = gtsam.GncLMParams()
    parameters.setKnownInliers(known)
    optimizer = gtsam.GncLMOptimizer(graph, initial, parameters)
    optimizer.setInlierCostThresholds(0.5 * threshold)
    found = optimizer.optimize()
    weights = optimizer.getWeights()
    placed = [found.atPose2(label) for label in sorted(poses)]
    told = {
        "poses": [[pose.x(), pose.y(), pose.theta()] for pose in placed],
        "accepted": [bool(weight > 0.5) for weight in weights[: len(edges)]],
    }
    print(json.dumps(told))


if __name__ == "__main__":
    main()
