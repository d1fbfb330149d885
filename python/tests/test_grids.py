"""Grid maps: arrays in and out, regions, doors and ways, against counts that anybody can make."""

import json
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import hssh
import networkx
import numpy as np
import pytest

FIXTURES = Path(__file__).parents[2] / "fixtures"


def two_rooms():
    """Two rooms of 4 m by 5 m with a door of 0.9 m between them, in cells of 0.05 m: True is wall."""
    cells = np.ones((110, 176), bool)
    cells[5:105, 5:85] = False
    cells[5:105, 91:171] = False
    cells[50:68, 85:91] = False
    return cells


def test_two_rooms_are_two_rooms_with_a_door():
    places = hssh.find_places(hssh.Grid(two_rooms(), 0.05, (-1.0, 2.0)), names=[(1.0, 4.0, "west & <east>")])
    assert [region.kind for region in places.regions] == ["room", "room"]
    door, = places.passages
    assert door.kind == "door" and door.is_passable and places.doors == [door]
    assert door.width == pytest.approx(0.9, abs=0.1)
    x, y = door.position
    assert -1.0 + 84 * 0.05 <= x <= -1.0 + 92 * 0.05, "in the wall, up to a cell"
    assert y == pytest.approx(2.0 + 59 * 0.05, abs=0.1)
    for region in places.regions:
        assert region.area == pytest.approx(20.0, rel=0.05)
    assert sorted(str(region.name) for region in places.regions) == ["None", "west & <east>"]
    labels = places.labels()
    assert labels.shape == (110, 176) and labels.dtype == np.int32
    areas = [(labels == number).sum() * 0.05**2 for number in range(2)]
    np.testing.assert_allclose(areas, [region.area for region in places.regions], rtol=0.02)
    route = places.roadmap.to_networkx()
    assert networkx.is_connected(route) and len(route) == len(places.roadmap.nodes)
    assert len(places.connections) == 1


def test_places_can_be_looked_at_and_written():
    grid = hssh.Grid(two_rooms(), 0.05)
    places = hssh.find_places(grid, names=[(1.0, 1.0, "<&>")])
    root = ElementTree.fromstring(places._repr_html_())
    assert root.find(".//{http://www.w3.org/2000/svg}svg") is not None
    assert ElementTree.fromstring(grid.to_svg()).tag.endswith("svg")
    assert grid._repr_png_().startswith(b"\x89PNG")
    nav2 = json.loads(places.export("nav2"))
    ids = [feature["properties"]["id"] for feature in nav2["features"]]
    assert len(set(ids)) == len(ids) > 2
    assert "levels:" in places.export("open_rmf") and places.export("tmap")
    assert ElementTree.fromstring(places.export("osmag")).tag == "osm"
    assert len(json.loads(places.export("regions"))["features"]) >= 2
    assert json.loads(places.to_json())["format"] == "hssh-places"
    with pytest.raises(hssh.ArgumentError, match='kind is "pdf"'):
        places.export("pdf")


def test_a_crossing_has_the_star_of_one():
    cells = np.ones((220, 220), bool)
    cells[100:120, 10:210] = False
    cells[10:210, 100:120] = False
    place = hssh.place_at(hssh.Grid(cells, 0.1), 11.0, 11.0)
    assert place.kind == "junction" and len(place.ends) == 4
    assert all(end.gateway is not None for end in place.ends)
    detail = hssh.find_places(hssh.Grid(cells, 0.1), detail=True)
    assert len(detail.places) == 5 and detail.roadmap is None
    with pytest.raises(hssh.ArgumentError, match="is not on the map"):
        hssh.place_at(hssh.Grid(cells, 0.1), 500.0, 0.0)


def test_cells_come_back_as_they_were():
    cells = np.where(two_rooms(), 100, 0).astype(np.int8)
    cells[:3] = -1
    grid = hssh.Grid(cells, 0.05, (3.0, -2.0))
    np.testing.assert_array_equal(grid.cells, cells)
    assert (grid.shape, grid.resolution, grid.origin.tolist()) == ((110, 176), 0.05, [3.0, -2.0])
    unsigned = cells.astype(np.uint8)
    np.testing.assert_array_equal(hssh.Grid(unsigned, 0.05).cells, cells)
    np.testing.assert_array_equal(hssh.Grid(cells.T, 0.05).cells, cells.T)
    np.testing.assert_array_equal(hssh.Grid(cells == 100, 0.05).cells == 100, cells == 100)


def test_files_of_map_server_come_back(tmp_path):
    cells = np.where(two_rooms(), 100, 0).astype(np.int8)
    cells[:3] = -1
    grid = hssh.Grid(cells, 0.05, (3.0, -2.0))
    grid.save(tmp_path / "rooms.yaml")
    again = hssh.read_grid(tmp_path / "rooms.yaml")
    np.testing.assert_array_equal(again.cells, cells)
    assert again.origin.tolist() == [3.0, -2.0]
    image = (tmp_path / "rooms.pgm").read_bytes()
    pixels = np.frombuffer(image[-cells.size :], np.uint8).reshape(cells.shape)
    np.testing.assert_array_equal(hssh.Grid.from_image(pixels, 0.05).cells, cells)
    np.testing.assert_array_equal(hssh.Grid.from_image(255 - pixels, 0.05, negate=True).cells == 100, cells == 100)
    np.testing.assert_array_equal(hssh.read(tmp_path / "rooms.yaml").cells, cells)


def test_the_floor_that_comes_with_the_repository():
    places = hssh.find_places(FIXTURES / "grids" / "floor.yaml")
    assert {region.kind for region in places.regions} <= {"room", "corridor", "hall", "doorway"}
    assert len(places.connections) > 0 and networkx.is_connected(places.roadmap.to_networkx())


@pytest.mark.parametrize(
    "make, kind, words",
    [
        (lambda: hssh.Grid(np.full((4, 4), 50), 0.1), hssh.ArgumentError, r"cells\[0, 0\] is 50: 0 is free, 100 is an obstacle"),
        (lambda: hssh.Grid(np.full((4, 4), 205, np.uint8), 0.1), hssh.ArgumentError, "Grid.from_image takes pixels"),
        (lambda: hssh.Grid(np.zeros((4, 4)), 0.1), TypeError, "threshold probabilities first"),
        (lambda: hssh.Grid(np.zeros(4, bool), 0.1), hssh.ArgumentError, r"must have the shape \(H, W\), not \(4,\)"),
        (lambda: hssh.Grid(np.zeros((0, 4), bool), 0.1), hssh.ArgumentError, "."),
        (lambda: hssh.Grid(np.zeros((4, 4), bool), -0.1), hssh.ArgumentError, "."),
        (lambda: hssh.Grid(np.zeros((4, 4), bool), float("nan")), hssh.ArgumentError, "."),
        (lambda: hssh.Grid(np.zeros((4, 4), bool), 0.1, (np.inf, 0)), hssh.ArgumentError, "."),
        (lambda: hssh.Grid(np.broadcast_to(False, (10**6, 10**6)), 0.1), hssh.ArgumentError, "1000000000000 numbers"),
        (lambda: hssh.Grid.from_image(np.full((4, 4), 300), 0.1), hssh.ArgumentError, "a pixel is from 0 to 255"),
        (lambda: hssh.find_places(hssh.Grid(np.ones((40, 40), bool), 0.1)), hssh.SurveyError, "."),
        (lambda: hssh.find_places(hssh.Grid(two_rooms(), 0.05), radius=0), hssh.ArgumentError, "radius is 0"),
        (lambda: hssh.find_places(hssh.Grid(two_rooms(), 0.05), names=[(99, 99, "x")]), hssh.ArgumentError, "no region is at"),
        (lambda: hssh.read_grid(FIXTURES / "grids" / "floor.png"), hssh.ArgumentError, "add resolution"),
        (lambda: hssh.read_grid(FIXTURES / "aces.ron"), hssh.FormatError, "is an exploration, but"),
        (lambda: hssh.read_grid("nowhere.yaml"), hssh.FileError, "cannot read nowhere.yaml"),
    ],
)
def test_what_is_no_map_is_refused(make, kind, words):
    with pytest.raises(kind, match=words):
        make()
