#!/usr/bin/env python3
"""Time networkx on the faces of an embedded graph.

Reads a rotation system of a simple graph as plain text: first the number of vertices, then one line
per vertex with its neighbors in clockwise order (empty for an isolated vertex). Builds a
networkx.PlanarEmbedding from it, traverses every face once, and prints one line of JSON with the
counts, the genus (|E| + 2c - |V| - |I| - f) / 2 and the seconds that building and traversing took.
The embedding need not be planar: networkx follows the rotation system as it stands.
"""

import argparse
import json
import sys
import time

import networkx as nx


def main():
    """Reads, measures, prints."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rotation_system", help="the text file to read")
    path = parser.parse_args().rotation_system
    try:
        clockwise = read_rotation_system(path)
    except (OSError, ValueError) as error:
        sys.exit(f"{path}: {error}")

    start = time.perf_counter()
    embedding = build(clockwise)
    built = time.perf_counter()
    faces = count_faces(embedding)
    traversed = time.perf_counter()

    vertices = len(clockwise)
    edges = sum(map(len, clockwise)) // 2
    components = nx.number_connected_components(embedding)
    isolated = sum(not neighbors for neighbors in clockwise)
    report = {
        "vertices": vertices,
        "edges": edges,
        "faces": faces,
        "components": components,
        "genus": (edges + 2 * components - vertices - isolated - faces) // 2,
        "build_seconds": round(built - start, 6),
        "faces_seconds": round(traversed - built, 6),
    }
    print(json.dumps(report))


def read_rotation_system(path):
    """The neighbors of every vertex in clockwise order; ValueError if it is no simple graph."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    if not lines or not lines[0].strip().isdigit():
        raise ValueError("line 1: expected the number of vertices")
    vertices = int(lines[0])
    # An isolated vertex at the end may have lost its empty line, any other line must be there.
    rows = lines[1:] + [""] * (vertices - len(lines) + 1)
    if any(row.strip() for row in rows[vertices:]):
        raise ValueError(f"line {vertices + 2}: more lines than the {vertices} vertices that line 1 announces")
    clockwise = []
    for vertex, row in enumerate(rows[:vertices]):
        try:
            neighbors = [int(word) for word in row.split()]
        except ValueError as error:
            raise ValueError(f"line {vertex + 2}: {error}") from error
        if len(set(neighbors)) < len(neighbors) or vertex in neighbors:
            raise ValueError(f"line {vertex + 2}: a neighbor is repeated or is the vertex itself: {row}")
        if any(not 0 <= neighbor < vertices for neighbor in neighbors):
            raise ValueError(f"line {vertex + 2}: a neighbor is not in 0..{vertices}: {row}")
        clockwise.append(neighbors)
    darts = {(source, target) for source, targets in enumerate(clockwise) for target in targets}
    for source, target in darts:
        if (target, source) not in darts:
            raise ValueError(f"line {source + 2}: has neighbor {target}, but line {target + 2} lacks {source}")
    return clockwise


def build(clockwise):
    """The embedding, edge after edge clockwise around every vertex."""
    embedding = nx.PlanarEmbedding()
    embedding.add_nodes_from(range(len(clockwise)))
    for vertex, neighbors in enumerate(clockwise):
        previous = None
        for neighbor in neighbors:
            embedding.add_half_edge(vertex, neighbor, ccw=previous)
            previous = neighbor
    return embedding


def count_faces(embedding):
    """The number of faces: every half-edge lies on exactly one."""
    marked = set()
    faces = 0
    for source, target in embedding.edges():
        if (source, target) not in marked:
            embedding.traverse_face(source, target, mark_half_edges=marked)
            faces += 1
    return faces


if __name__ == "__main__":
    main()
