"""Compares the time of a pose graph from numpy arrays to numpy arrays with that of the program's solver.

    cargo build --release --package hssh
    pip install ./python
    python python/bench.py FOLDER [FILE ...]

FOLDER holds pose graphs; without files, those of the usual benchmarks that are there. Both are asked for in turn, and the medians are printed. The
program's time is `seconds_solving` of `hssh graph --json`: reading is left out, and on Python's side everything from arrays to arrays counts.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

import hssh

USUAL = ["ring.g2o", "MIT.g2o", "CSAIL.g2o", "intel.g2o", "manhattan.g2o", "input_M3500b_g2o.g2o"]
ROUNDS = 11
ROOT = Path(__file__).parents[1]


def program_time(program: Path, file: Path) -> float:
    """Seconds of solving, as the program tells."""
    told = subprocess.run([program, "graph", file, "--json"], capture_output=True, check=True, text=True)
    return json.loads(told.stdout)["seconds_solving"]


def numpy_time(arrays: tuple) -> float:
    """Seconds from arrays to the array of poses."""
    begun = time.perf_counter()
    found = hssh.PoseGraph(*arrays).optimize()
    poses = found.poses
    taken = time.perf_counter() - begun
    assert len(poses)
    return taken


def main() -> None:
    program = Path(os.environ.get("HSSH_PROGRAM", ROOT / "target" / "release" / "hssh"))
    if not program.is_file() or len(sys.argv) < 2:
        raise SystemExit(__doc__)
    folder = Path(sys.argv[1])
    files = [folder / name for name in sys.argv[2:] or USUAL]
    print(f"load {os.getloadavg()[0]:.1f}; medians of {ROUNDS}")
    print(f"{'file':<24}{'poses':>7}{'edges':>7}{'Rust, ms':>11}{'numpy, ms':>11}{'ratio':>8}")
    for file in filter(Path.is_file, files):
        graph = hssh.read_pose_graph(file)
        # Where a file gives no poses, there is none to give.
        poses = graph.poses if graph.poses.any() else None
        arrays = (poses, graph.edges, graph.measurements, graph.information)
        pairs = [(program_time(program, file), numpy_time(arrays)) for _ in range(ROUNDS)]
        rust, python = (1e3 * statistics.median(times) for times in zip(*pairs))
        print(f"{file.name:<24}{len(graph):>7}{len(graph.edges):>7}{rust:>11.2f}{python:>11.2f}{python / rust:>8.3f}")


if __name__ == "__main__":
    main()
