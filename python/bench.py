"""Compares the time of a pose graph from numpy arrays to numpy arrays with that of Rust alone.

    pip install ./python
    cargo build --release --package hssh    # optional
    python python/bench.py FOLDER [FILE ...]

FOLDER holds pose graphs; without files, those of the usual benchmarks that are there. Medians are printed: of the solver by Rust's own clock, in the
same calls; of `hssh graph --json`, if the program is built (`seconds_solving`, reading left out), asked for in turn; and of everything from arrays to
arrays as Python sees it, by which factor of the solver's time it is longer.
"""

from __future__ import annotations

import json
import math
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


def numpy_times(arrays: tuple) -> tuple[float, float]:
    """Seconds of the solver, and from arrays to the array of poses."""
    begun = time.perf_counter()
    found = hssh.PoseGraph(*arrays).optimize()
    poses = found.poses
    taken = time.perf_counter() - begun
    assert len(poses)
    return found.seconds, taken


def main() -> None:
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    program = Path(os.environ.get("HSSH_PROGRAM", ROOT / "target" / "release" / "hssh"))
    folder = Path(sys.argv[1])
    print(f"load {os.getloadavg()[0]:.1f}; medians of {ROUNDS}, ms")
    print(f"{'file':<24}{'poses':>7}{'edges':>7}{'solver':>10}{'program':>10}{'numpy':>10}{'factor':>8}")
    for file in filter(Path.is_file, [folder / name for name in sys.argv[2:] or USUAL]):
        graph = hssh.read_pose_graph(file)
        # Where a file gives no poses, there are none to give.
        poses = graph.poses if graph.poses.any() else None
        arrays = (poses, graph.edges, graph.measurements, graph.information)
        rounds = []
        for _ in range(ROUNDS):
            rounds.append((program_time(program, file) if program.is_file() else math.nan, *numpy_times(arrays)))
        by_program, solver, python = (1e3 * statistics.median(times) for times in zip(*rounds))
        numbers = f"{solver:>10.2f}{by_program:>10.2f}{python:>10.2f}{python / solver:>8.3f}"
        print(f"{file.name:<24}{len(graph):>7}{len(graph.edges):>7}{numbers}")


if __name__ == "__main__":
    main()
