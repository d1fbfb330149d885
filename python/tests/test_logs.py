"""Laser logs: bags, tables and arrays; where the robot was, and the maps of what it saw."""

import os
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import hssh
import numpy as np
import pytest

FIXTURES = Path(__file__).parents[2] / "fixtures"
DATA = os.environ.get("HSSH_DATA")
WALLS = np.array([[[-6, -4], [6, -4]], [[6, -4], [6, 4]], [[6, 4], [-6, 4]], [[-6, 4], [-6, -4]], [[1, -4], [1, -1]], [[-3, 4], [-3, 2]]], float)


def cast(pose, angles):
    """The ranges of a laser at a pose among the walls."""
    directions = np.stack([np.cos(angles + pose[2]), np.sin(angles + pose[2])], axis=-1)
    best = np.full(len(angles), np.inf)
    for start, end in WALLS:
        along, to = end - start, start - pose[:2]
        cross = directions[:, 0] * along[1] - directions[:, 1] * along[0]
        with np.errstate(divide="ignore", invalid="ignore"):
            range_ = (to[0] * along[1] - to[1] * along[0]) / cross
            part = (to[0] * directions[:, 1] - to[1] * directions[:, 0]) / cross
        hit = (range_ > 0) & (part >= 0) & (part <= 1)
        best = np.where(hit, np.minimum(best, range_), best)
    return best


def drive(count=60):
    """Where a robot is that circles in a room, and its scans."""
    turn = np.linspace(0, np.pi, count)
    poses = np.stack([-2 + 2 * np.sin(turn), -1.5 + 1.5 * (1 - np.cos(turn)) / 2, turn / 2], axis=-1)
    angles = np.radians(np.arange(-90, 91))
    return poses, angles, np.stack([cast(pose, angles) for pose in poses])


def relative(poses):
    dx, dy = (poses[:, :2] - poses[0, :2]).T
    cos, sin = np.cos(poses[0, 2]), np.sin(poses[0, 2])
    return np.stack([cos * dx + sin * dy, -sin * dx + cos * dy, poses[:, 2] - poses[0, 2]], axis=-1)


def test_arrays_make_a_log_with_its_geometry():
    poses, angles, ranges = drive()
    ranges[3, 5] = np.nan
    log = hssh.Log.from_arrays(
        ranges, angle_min=angles[0], angle_increment=np.radians(1), times=np.arange(60) * 0.1, odometry=poses, range_max=11
    )
    assert (len(log), log.ranges.shape) == (60, (60, 181))
    scan = log[3]
    np.testing.assert_allclose(scan.angles, angles, atol=1e-12)
    assert np.isinf(scan.ranges[5]) and scan.time == pytest.approx(0.3)
    np.testing.assert_allclose(log.odometry, poses)
    np.testing.assert_array_equal(log.times, np.arange(60) * 0.1)
    hit = np.isfinite(scan.ranges)
    points = np.stack([scan.ranges * np.cos(angles), scan.ranges * np.sin(angles)], axis=-1)[hit]
    np.testing.assert_allclose(scan.points(), points, atol=1e-9)
    np.testing.assert_array_equal(log[-1].ranges, log[59].ranges)
    with pytest.raises(IndexError, match="there is no scan 60"):
        log[60]


@pytest.mark.parametrize("beams, first, step", [(360, -180.0, 1.0), (181, -60.0, 0.75), (40, 10.0, 4.0)])
def test_lasers_look_where_they_are_said_to(beams, first, step):
    angles = np.radians(first + step * np.arange(beams))
    ranges = np.stack([cast([0, 0, 0], angles)] * 3)
    log = hssh.Log.from_arrays(ranges, angle_min=angles[0], angle_increment=np.radians(step), odometry=np.zeros((3, 3)))
    np.testing.assert_allclose(log[1].angles, angles, atol=1e-9)


def test_the_track_is_where_the_robot_was():
    poses, angles, ranges = drive()
    drifted = poses * [1.05, 0.95, 1.02]
    log = hssh.Log.from_arrays(ranges, angle_min=angles[0], angle_increment=np.radians(1), odometry=drifted)
    track = log.track()
    np.testing.assert_allclose(track.poses, relative(poses), atol=0.05)
    assert np.abs(track.poses - relative(drifted)).max() > 0.05
    times, trajectory = track.trajectory()
    assert times.shape == (60,) and trajectory.shape == (60, 3)
    assert len(track.graph) == 60
    grid = track.grid()
    assert (grid.cells == 100).sum() > 100 and (grid.cells == 0).sum() > 1000
    assert "60 scans" in str(track) and "hssh-track" in track.to_json()


@pytest.mark.parametrize(
    "other, kind, words",
    [
        ({"ranges": np.zeros(181)}, hssh.ArgumentError, r"ranges must have the shape \(N, B\), not \(181,\)"),
        ({"ranges": np.zeros((0, 181))}, hssh.ArgumentError, "0 beams"),
        ({"angle_increment": -0.01}, hssh.ArgumentError, "no sweep of a laser"),
        ({"angle_increment": 1.0}, hssh.ArgumentError, "no more than a full turn"),
        ({"angle_min": float("nan")}, hssh.ArgumentError, "angle_min is NaN"),
        ({"times": [0.0, 2.0, 1.0]}, hssh.ArgumentError, r"times\[2\] is less than times\[1\]"),
        ({"times": [0.0]}, hssh.ArgumentError, "3 scans, and 1 rows of times"),
        ({"odometry": np.zeros((3, 2))}, hssh.ArgumentError, r"odometry must have the shape \(N, 3\)"),
        ({"ranges": np.full((3, 181), np.inf)}, hssh.FormatError, "."),
        ({"ranges": np.array([["far"] * 181])}, TypeError, "ranges must be an array of numbers"),
    ],
)
def test_what_is_no_log_is_refused(other, kind, words):
    usual = {"ranges": np.ones((3, 181)), "angle_min": -1.57, "angle_increment": 0.01745, "odometry": np.zeros((3, 3))}
    with pytest.raises(kind, match=words):
        hssh.Log.from_arrays(**{**usual, **other})


def test_bags_are_read_as_the_program_reads_them(tmp_path):
    log = hssh.read_log(FIXTURES / "bags" / "usual")
    assert len(log) > 0 and log.used and log.ranges.shape[0] == len(log)
    assert np.isfinite(log.times).all()
    chosen = hssh.read_log(FIXTURES / "bags" / "usual", odometry="none")
    assert len(chosen) == len(log)
    with pytest.raises(hssh.FormatError, match="help: `hssh check` says what is in a bag"):
        hssh.read_log(FIXTURES / "bags" / "no-laser")
    with pytest.raises(hssh.FormatError, match="is a pose graph .*, but this command takes a laser log"):
        hssh.read_log(FIXTURES / "graphs" / "two-laps.g2o")
    with pytest.raises(hssh.FormatError, match="has no topics nor frames"):
        hssh.read_log(carmen(tmp_path), odometry="/odom")
    with pytest.raises(hssh.FormatError, match="go by the names of their messages: FLASER"):
        hssh.read_log(carmen(tmp_path), scan="/scan")


def carmen(folder):
    """A log in CARMEN's form, written here."""
    poses, _, ranges = drive(30)
    lines = []
    for number, (pose, sweep) in enumerate(zip(poses, ranges)):
        where = " ".join(f"{part:.6f}" for part in pose)
        beams = " ".join(f"{length:.2f}" for length in sweep)
        lines.append(f"FLASER {len(sweep)} {beams} {where} {where} {number * 0.1:.3f} host {number * 0.1:.3f}")
    (folder / "room.log").write_text("\n".join(lines) + "\n")
    return folder / "room.log"


def test_a_log_of_carmen_says_what_its_arrays_say(tmp_path):
    poses, angles, ranges = drive(30)
    log = hssh.read_log(carmen(tmp_path))
    np.testing.assert_allclose(log.ranges, ranges, atol=0.006)
    np.testing.assert_allclose(log.odometry, poses, atol=1e-5)
    np.testing.assert_allclose(log[0].angles, angles, atol=1e-9)
    turned = hssh.read_log(carmen(tmp_path), laser_pose=(0.0, 0.0, np.pi / 6))
    np.testing.assert_allclose(turned[0].angles, angles, atol=1e-9)
    np.testing.assert_allclose(turned.odometry[:, 2], poses[:, 2] + np.pi / 6, atol=1e-5)


def test_the_log_of_aces_becomes_its_map():
    if not DATA:
        pytest.skip("no real data: HSSH_DATA names no folder")
    survey = hssh.survey(Path(DATA) / "logs" / "aces.log.gz")
    answer = hssh.map(survey, planar=True)
    times, trajectory = answer.trajectory()
    assert answer.best.measure.places == len(answer.best.places) and len(times) == len(trajectory) > 400
    grid = answer.grid()
    assert (grid.cells == 0).sum() * grid.resolution**2 > 200
    assert len(answer.scan_graph()) == len(survey.poses)
    assert survey.frames.shape == (len(survey), 3) and len(survey.exploration) == len(survey) - 1
    assert ElementTree.fromstring(answer._repr_html_()).tag == "div"
