#!/usr/bin/env python3
"""Reads back what hssh exports, by programs that share no code with it, and compares it with the answer.

    pip install networkx jsonschema pyyaml osmium shapely evo
    python3 scripts/read-exports.py robot.log.gz fixtures/aces.ron map.yaml [--hssh PROGRAM] [--schema tmap-schema.yaml]

Laser logs and explorations are mapped (`hssh map --json`), grid maps parted into regions (`hssh stars --json`); then each format is
written of that JSON by `hssh export` and read back:

    graphml  networkx        nav2   the rules of the Route Server's loader, written down here
    geojson  shapely         tmap   PyYAML, and jsonschema with the schema of topological_navigation, if it is given
    osmag    osmium          open-rmf   PyYAML
    tum      evo             g2o    line by line

Counts of places and ways and all coordinates have to be those of the answer; the table says how far apart they are at most, in
metres. Ends with an error at the first that is not as it should be.
"""
import argparse
import collections
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import jsonschema
import networkx
import numpy
import osmium
import shapely.geometry
import yaml
from evo.tools import file_interface

DEGREE = 6378137.0 * math.pi / 180.0
KINDS = ["graphml", "geojson", "nav2", "open-rmf", "tmap", "osmag", "tum", "g2o"]


class Expected:
    """What the files have to hold, by the JSON alone."""

    def __init__(self, answer):
        self.answer = answer
        if answer["format"] == "hssh-answer":
            best = answer["maps"][0]
            self.places = [position(place.get("pose")) for place in best["places"]]
            self.links = [(link["from"]["place"], link["to"]["place"]) for link in best["links"]]
            self.ends = [(link["from"]["end"], link["to"]["end"]) for link in best["links"]]
            self.lines = [self.line(link) for link in best["links"]]
            self.nodes, self.ways, self.way_lines = self.places, self.links, self.lines
            self.trajectory = best.get("trajectory", [])
        else:
            self.places = [tuple(place["center"]) for place in answer["places"]]
            self.links = [tuple(end["place"] for end in link["ends"]) for link in answer["connections"]]
            self.ends = [tuple(end["end"] for end in link["ends"]) for link in answer["connections"]]
            self.lines = [[tuple(point) for point in link["line"]] for link in answer["connections"]]
            roadmap = answer["roadmap"]
            self.nodes = [tuple(node["position"]) for node in roadmap["nodes"]]
            self.ways = [tuple(way["ends"]) for way in roadmap["ways"]]
            self.way_lines = [[tuple(point) for point in way["line"]] for way in roadmap["ways"]]
            self.trajectory = []
        self.is_placed = all(place is not None for place in self.places)

    def line(self, link):
        if "way" in link:
            return [tuple(point) for point in link["way"]]
        ends = [self.places[link[end]["place"]] for end in ("from", "to")]
        return ends if all(ends) and ends[0] != ends[1] else []


def position(pose):
    return pose and (pose["x"], pose["y"])


def apart(points, others):
    """The largest distance between points that correspond."""
    assert len(points) == len(others), f"{len(points)} points instead of {len(others)}"
    return max((math.dist(point, other) for point, other in zip(points, others)), default=0.0)


def length(line):
    return sum(math.dist(a, b) for a, b in zip(line, line[1:]))


def read_graphml(file, expected):
    graph = networkx.read_graphml(file, force_multigraph=True)
    assert not graph.is_directed()
    assert sorted(graph.nodes, key=lambda node: int(node[1:])) == [f"n{n}" for n in range(len(expected.places))]
    edges = {key: (source, target, about) for source, target, key, about in graph.edges(keys=True, data=True)}
    assert len(edges) == len(expected.links)
    error = 0.0
    for number, place in enumerate(expected.places):
        about = graph.nodes[f"n{number}"]
        assert ("x" in about) == (place is not None)
        if place:
            error = max(error, math.dist((about["x"], about["y"]), place))
    for number, (link, ends, line) in enumerate(zip(expected.links, expected.ends, expected.lines)):
        source, target, about = edges[f"w{number}"]
        told = {(source, about["from_end"]), (target, about["to_end"])}
        assert {source, target} == {f"n{end}" for end in link} and len(told) == len(set(zip(link, ends)))
        if line:
            corners = [tuple(map(float, corner.split())) for corner in about["line"].split(", ")]
            error = max(error, apart(corners, line), abs(about["length"] - length(line)))
    assert graph.graph["source"] and graph.graph["generator"].startswith("hssh")
    return len(graph.nodes), len(edges), error


def read_geojson(file, expected):
    features = json.loads(file.read_text())["features"]
    shapes = [(feature["properties"], shapely.geometry.shape(feature["geometry"])) for feature in features]
    points = [(shape.x, shape.y) for about, shape in shapes if about["what"] != "way"]
    lines = {about["number"]: list(shape.coords) for about, shape in shapes if about["what"] == "way"}
    error = apart(points, expected.nodes)
    told = {number: line for number, line in enumerate(expected.way_lines) if line}
    assert lines.keys() == told.keys()
    return len(points), len(lines), max([error, *(apart(lines[number], line) for number, line in told.items())])


def check_metadata(about):
    """As the loader converts them: numbers, truth values, texts, lists of these, and objects; anything else throws."""
    assert isinstance(about, dict)
    for value in about.values():
        if isinstance(value, dict):
            check_metadata(value)
        else:
            values = value if isinstance(value, list) else [value]
            assert all(isinstance(value, (bool, int, float, str)) for value in values), value


def read_nav2(file, expected):
    text = file.read_text()
    features = json.loads(text)["features"]
    nodes = [feature for feature in features if feature["geometry"]["type"] == "Point"]
    edges = [feature for feature in features if feature["geometry"]["type"] in ("MultiLineString", "LineString")]
    assert nodes and edges and len(nodes) + len(edges) == len(features)
    ids = [feature["properties"]["id"] for feature in features]
    assert all(type(number) is int and 0 <= number < 2**32 for number in ids) and len(set(ids)) == len(ids)
    where = {node["properties"]["id"]: tuple(node["geometry"]["coordinates"][:2]) for node in nodes}
    ends = [(edge["properties"]["startid"], edge["properties"]["endid"]) for edge in edges]
    assert all(type(end) is int and end in where for pair in ends for end in pair)
    counts = collections.Counter(ends)
    assert all(counts[start, end] == counts[end, start] for start, end in ends), "a way leads one way only"
    for feature in features:
        check_metadata(feature["properties"].get("metadata", {}))
    for name in ("cost", "width", "probability_at_least"):
        told = re.findall(rf'"{name}":(-?[0-9][^,}}]*)', text)
        assert all("." in number or "e" in number for number in told), f"{name} without a decimal point"
    for edge, (start, end) in zip(edges, ends):
        assert abs(edge["properties"]["cost"] - math.dist(where[start], where[end])) < 1e-9
    return of_drive(where, ends, [edge["properties"]["metadata"]["way"] for edge in edges], expected)


def of_drive(where, ends, ways, expected):
    """The nodes come first; the legs of each way make a chain between its nodes that is as long as its line."""
    error = apart([where[number] for number in range(len(expected.nodes))], expected.nodes)
    legs = collections.defaultdict(list)
    for pair, way in zip(ends, ways):
        legs[way].append(pair)
    assert sorted(legs) == list(range(len(expected.ways)))
    for way, pairs in legs.items():
        chain = networkx.MultiGraph(pairs[::2])
        first, last = expected.ways[way]
        odd = {node for node, degree in chain.degree() if degree % 2}
        assert networkx.is_connected(chain) and odd == ({first, last} if first != last else set())
        driven = sum(math.dist(where[start], where[end]) for start, end in pairs[::2])
        # Corners nearer than a millimetre are one.
        assert abs(driven - length(expected.way_lines[way])) < 2e-3 * len(expected.way_lines[way])
    return len(expected.nodes), len(legs), error


def read_open_rmf(file, expected):
    graph = yaml.safe_load(file.read_text())
    assert isinstance(graph["building_name"], str) and graph["lifts"] == {} and isinstance(graph["doors"], dict)
    level = graph["levels"]["L1"]
    where = {number: (x, y) for number, (x, y, _) in enumerate(level["vertices"])}
    assert all(isinstance(number, float) for point in where.values() for number in point)
    names = [about["name"] for _, _, about in level["vertices"] if about["name"]]
    assert all(isinstance(name, str) for name in names) and len(set(names)) == len(names)
    lanes = collections.Counter((start, end) for start, end, _ in level["lanes"])
    assert all(lanes[start, end] == lanes[end, start] and start in where and end in where for start, end in lanes)
    assert all(about.get("door_name") in {None, *graph["doors"]} for _, _, about in level["lanes"])
    graph = networkx.MultiGraph([lane[:2] for lane in level["lanes"][::2]])
    assert set(graph.nodes) <= set(where)
    # Without the corners of ways, which join two lanes, ways are left.
    corners = set(where) - set(range(len(expected.nodes)))
    assert all(graph.degree(corner) == 2 for corner in corners)
    error = apart([where[number] for number in range(len(expected.nodes))], expected.nodes)
    return len(expected.nodes), graph.number_of_edges() - len(corners), error


def read_tmap(file, expected, schema):
    tmap = yaml.safe_load(file.read_text())
    if schema:
        jsonschema.Draft7Validator(schema).validate(tmap)
    names = [entry["node"]["name"] for entry in tmap["nodes"]]
    assert len(set(names)) == len(names) and all(re.fullmatch(r"[\w.-]+", name) for name in names)
    where = [entry["node"]["pose"]["position"] for entry in tmap["nodes"]]
    edges = [(entry["node"]["name"], edge) for entry in tmap["nodes"] for edge in entry["node"]["edges"]]
    assert all(edge["edge_id"] == f"{name}_{edge['node']}" and edge["node"] in names for name, edge in edges)
    assert all(edge["action"] == "NavigateToPose" for _, edge in edges)
    pairs = {(name, edge["node"]) for name, edge in edges}
    assert len(pairs) == len(edges) and all((end, start) in pairs for start, end in pairs)
    corners = len(names) - len(expected.nodes)
    error = apart([(point["x"], point["y"]) for point in where[: len(expected.nodes)]], expected.nodes)
    # Straight ways between the same two places are one edge.
    return len(expected.nodes), len(edges) // 2 - corners, error


class OsmReader(osmium.SimpleHandler):
    def __init__(self):
        super().__init__()
        self.nodes, self.ways, self.root = {}, [], None

    def node(self, node):
        self.nodes[node.id] = (node.location.lon * DEGREE, node.location.lat * DEGREE)
        if node.tags.get("name") == "root":
            self.root = node.id

    def way(self, way):
        self.ways.append(([node.ref for node in way.nodes], dict(way.tags)))


def read_osmag(file, expected):
    read = OsmReader()
    read.apply_file(str(file))
    assert read.nodes[read.root] == (0.0, 0.0)
    areas = {about["name"]: nodes for nodes, about in read.ways if about["osmAG:type"] == "area"}
    passages = [(nodes, about) for nodes, about in read.ways if about["osmAG:type"] == "passage"]
    assert len(areas) + len(passages) == len(read.ways) and all(about["level"] for _, about in read.ways)
    assert all(nodes[0] == nodes[-1] and len(nodes) > 3 for nodes in areas.values())
    assert all(shapely.geometry.Polygon([read.nodes[node] for node in nodes]).is_valid for nodes in areas.values())
    assert all(len(nodes) == 2 for nodes, _ in passages)
    assert all(about[end] in areas for _, about in passages for end in ("osmAG:from", "osmAG:to"))
    graph = networkx.MultiGraph([(about["osmAG:from"], about["osmAG:to"]) for _, about in passages])
    answer = expected.answer
    if answer["format"] != "hssh-answer":
        told = [line for passage in answer["passages"] for line in [passage["line"]]]
        assert len(areas) == len(answer["regions"]) and len(passages) == len(answer["passages"])
        lines = [[read.nodes[node] for node in nodes] for nodes, _ in passages]
        return len(areas), len(passages), max(map(apart, lines, told), default=0.0)
    best = answer["maps"][0]
    assert len(areas) == len(expected.places) + len(expected.links) and len(passages) == 2 * len(expected.links)
    error = 0.0
    for number, link in enumerate(best["links"]):
        assert graph.degree(f"way {number}") == 2
        for end, (nodes, about) in zip(("from", "to"), passages[2 * number : 2 * number + 2]):
            place = best["places"][link[end]["place"]]
            assert {about["osmAG:from"], about["osmAG:to"]} == {f"place {link[end]['place']}", f"way {number}"}
            gateway = next(e["gateway"] for e in place["ends"] if e["name"] == link[end]["end"])
            pose = place["pose"]
            cos, sin = math.cos(pose["theta"]), math.sin(pose["theta"])
            line = [(pose["x"] + cos * x - sin * y, pose["y"] + sin * x + cos * y) for x, y in gateway]
            error = max(error, apart([read.nodes[node] for node in nodes], line))
    return len(areas) - len(expected.links), len(passages) // 2, error


def read_tum(file, expected):
    trajectory = file_interface.read_tum_trajectory_file(str(file))
    told = numpy.array(expected.trajectory)
    assert numpy.array_equal(trajectory.timestamps, told[:, 0])
    turned = 2 * numpy.arctan2(trajectory.orientations_quat_wxyz[:, 3], trajectory.orientations_quat_wxyz[:, 0])
    assert numpy.abs(numpy.angle(numpy.exp(1j * (turned - told[:, 3])))).max() < 1e-6
    off = numpy.hypot(*(trajectory.positions_xyz[:, :2] - told[:, 1:3]).T)
    return trajectory.num_poses, trajectory.num_poses - 1, off.max()


def read_g2o(file, expected):
    records = [line.split() for line in file.read_text().splitlines()]
    vertices = [tuple(map(float, record[2:4])) for record in records if record[0] == "VERTEX_SE2"]
    edges = [record for record in records if record[0] == "EDGE_SE2"]
    if not expected.trajectory:
        return len(vertices), len(edges), apart(vertices, expected.places)
    scans = {(round(x, 3), round(y, 3)) for _, x, y, _ in expected.trajectory}
    assert all((round(x, 3), round(y, 3)) in scans for x, y in vertices) or len(vertices) == len(scans)
    return len(vertices), len(edges), 0.0


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("inputs", nargs="+", metavar="INPUT", type=pathlib.Path)
    options.add_argument("--hssh", default="target/release/hssh")
    options.add_argument("--schema", type=pathlib.Path, help="the JSON Schema of topological_navigation's maps, as YAML")
    given = options.parse_args()
    schema = given.schema and yaml.safe_load(given.schema.read_text())
    print(f"{'input':<24}{'format':<10}{'places':>8}{'ways':>8}{'apart, m':>12}")
    for source in given.inputs:
        with tempfile.TemporaryDirectory() as folder:
            read_back(source, pathlib.Path(folder), given.hssh, schema)


def read_back(source, folder, program, schema):
    def run(*arguments):
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr

    is_grid = source.suffix in (".yaml", ".yml", ".pgm", ".png")
    is_log = not is_grid and source.suffix != ".ron"
    if is_grid:
        made = run("stars", source, "--json")
    else:
        extra = ["--with-trajectory"] if is_log else []
        made = run("map", source, "--json", "--export", f"g2o={folder / 'map.g2o'}", *extra)
    assert made[1], made[2]
    (folder / "answer.json").write_text(made[1])
    expected = Expected(json.loads(made[1]))
    for kind in KINDS:
        file = folder / ("map.osm" if kind == "osmag" else f"map.{kind}")
        if kind != "g2o":
            # Of an answer the first map, whatever the answer says of it.
            rank = [] if is_grid else ["--rank", "1"]
            code, _, said = run("export", folder / "answer.json", "--to", kind, "-o", file, *rank)
            needs = {"tum": is_log, "osmag": is_log or is_grid, "graphml": True}.get(kind, expected.is_placed)
            assert (code == 0) == needs, f"{source} {kind}: {said}"
        if not file.exists():
            print(f"{source.name:<24}{kind:<10}{'-':>8}{'-':>8}{'-':>12}")
            continue
        reader = globals()["read_" + kind.replace("-", "_")]
        extra = [schema] if kind == "tmap" else []
        try:
            places, ways, error = reader(file, expected, *extra)
        except AssertionError as problem:
            sys.exit(f"{source}: {kind}: {problem!r}")
        print(f"{source.name:<24}{kind:<10}{places:>8}{ways:>8}{error:>12.1e}")
        if kind not in ("tum", "g2o", "osmag"):
            told = (expected.places, expected.links) if kind == "graphml" else (expected.nodes, expected.ways)
            if kind == "tmap":
                told = (told[0], [*range(ways)])
            assert (places, ways) == (len(told[0]), len(told[1])), f"{source}: {kind}"
        # Millimetres in YAML; OpenStreetMap's programs keep a ten millionth of a degree, which is a centimetre.
        assert error < (1e-2 if kind == "osmag" else 1e-3), f"{source}: {kind}: {error} m apart"


if __name__ == "__main__":
    main()
