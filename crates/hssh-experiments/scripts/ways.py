#!/usr/bin/env python3
"""Checks a graph of nav2's Route Server that hssh wrote against the map it was made of.

    pip install numpy pillow pyyaml
    hssh stars map.yaml --radius 0.25 --export nav2=graph.geojson
    python3 ways.py map.yaml graph.geojson --radius 0.25

It reads the image and the graph by itself and fails unless ids are unique, every edge has its nodes and the edge back, and
no straight line from node to node comes nearer to a cell that is not free than the radius.
"""
import argparse
import json
import math
import pathlib
import sys

import numpy as np
import yaml
from PIL import Image


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("map", type=pathlib.Path)
    arguments.add_argument("graph", type=pathlib.Path)
    arguments.add_argument("--radius", type=float, default=0.25)
    given = arguments.parse_args()
    about = yaml.safe_load(given.map.read_text())
    gray = np.asarray(Image.open(given.map.parent / about["image"]).convert("L")).astype(float)
    occupancy = gray / 255 if about["negate"] else 1 - gray / 255
    blocked = np.flipud(occupancy >= about["free_thresh"])
    resolution, (x0, y0, _) = about["resolution"], about["origin"]
    features = json.loads(given.graph.read_text())["features"]
    ids = [feature["properties"]["id"] for feature in features]
    assert len(ids) == len(set(ids)) and all(isinstance(number, int) and number >= 0 for number in ids), "ids"
    nodes = {f["properties"]["id"]: f["geometry"]["coordinates"] for f in features if f["geometry"]["type"] == "Point"}
    edges = [(f["properties"]["startid"], f["properties"]["endid"]) for f in features if "startid" in f["properties"]]
    assert nodes and edges, "a graph has nodes and edges"
    assert all(start in nodes and end in nodes and (end, start) in set(edges) for start, end in edges), "ends"
    reach = math.ceil(given.radius / resolution) + 1
    height, width = blocked.shape

    def clearance(point):
        """To the side of the nearest cell that is not free; beyond the map, there are none."""
        column, row = int((point[0] - x0) // resolution), int((point[1] - y0) // resolution)
        left, right = max(column - reach, 0), min(column + reach + 1, width)
        low, high = max(row - reach, 0), min(row + reach + 1, height)
        rows, columns = np.nonzero(blocked[low:high, left:right])
        if not len(rows):
            return math.inf
        dx = np.abs(x0 + (columns + left + 0.5) * resolution - point[0]) - resolution / 2
        dy = np.abs(y0 + (rows + low + 0.5) * resolution - point[1]) - resolution / 2
        return np.hypot(np.maximum(dx, 0), np.maximum(dy, 0)).min()

    least = math.inf
    for start, end in edges:
        if start > end:
            continue
        a, b = np.array(nodes[start]), np.array(nodes[end])
        count = max(1, math.ceil(np.linalg.norm(b - a) / (resolution / 4)))
        least = min(least, *(clearance(a + (b - a) * step / count) for step in range(count + 1)))
    print(f"{len(nodes)} nodes, {len(edges)} edges; obstacles are {least:.3f} m away or more")
    # Samples are a quarter of a cell apart: between two, an obstacle is nearer by far less than a hundredth of it.
    if least < given.radius - resolution / 100:
        sys.exit(f"a robot with a radius of {given.radius} m would collide")


if __name__ == "__main__":
    main()
