"""Plays a CARMEN log as its robot drove: each message when it is due, on standard output.

    python3 scripts/play.py robot.log.gz --speed 10 | hssh live -

With --json the messages are lines of JSON (docs/live.md), made of the log's own odometry. Where the log's clock goes back, the
message follows at once.
"""

import argparse
import gzip
import json
import math
import sys
import time

VIEWS = {180: 180.0, 181: 180.0, 360: 180.0, 361: 180.0}


def due(words):
    """When a message was logged: its last number."""
    try:
        return float(words[-1])
    except ValueError:
        return None


def as_json(words, clock):
    """A message as a line of JSON, stamped so that the order of the log is that of the stamps."""
    if words[0] == "FLASER":
        beams = int(words[1])
        ranges = [float(word) for word in words[2 : 2 + beams]]
        pose = [float(word) for word in words[5 + beams : 8 + beams]]
        step = math.radians(VIEWS.get(beams, 180.0)) / (beams - beams % 2)
        record = {"time": clock, "pose": pose, "angle_min": -math.pi / 2, "angle_increment": step, "ranges": ranges}
    elif words[0] == "ODOM":
        record = {"time": clock, "pose": [float(word) for word in words[1:4]]}
    else:
        return None
    return json.dumps(record)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("log")
    parser.add_argument("--speed", type=float, default=1.0, help="times faster than the robot drove")
    parser.add_argument("--json", action="store_true", help="lines of JSON instead of the log's own")
    arguments = parser.parse_args()
    text = (gzip.open if arguments.log.endswith(".gz") else open)(arguments.log, "rt")
    started, first, clock = time.monotonic(), None, 0.0
    for line in text:
        words = line.split()
        if not words:
            continue
        logged = due(words) if words[0] in ("FLASER", "ODOM") else None
        if logged is not None:
            first = logged if first is None else first
            clock = max(clock + 1e-6, logged - first)
            wait = started + (logged - first) / arguments.speed - time.monotonic()
            if wait > 0:
                time.sleep(wait)
        told = as_json(words, clock) if arguments.json else line.rstrip("\n")
        if told is not None:
            print(told, flush=True)


if __name__ == "__main__":
    try:
        main()
    except BrokenPipeError:
        sys.exit(0)
