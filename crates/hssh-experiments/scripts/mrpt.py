#!/usr/bin/env python3
"""Run MRPT's icp-slam and rbpf-slam on the scans and the raw odometry of a CARMEN log.

    apt-get install mrpt-apps
    mrpt.py LOG

Reads a log whose lines are `FLASER n ranges… x y theta odom_x odom_y odom_theta time host time`, and nothing else. Prints one
line of JSON per program: its name, the seconds of processor time, the peak memory in MB, and where it has each scan. Both run as
they are shipped, with the configurations of Debian's package (icp-slam_demo_classic, gridmapping_RBPF_ICPbased_intel), without
windows. MRPT's importer gives each message the time at which it runs: the times of the log are put in their place, and for
rbpf-slam, which takes no other form, the messages are written as pairs of a motion and what was seen after it.
"""

import gzip
import json
import math
import os
import re
import resource
import struct
import subprocess
import sys
import tempfile

CONFIGURATIONS = "/usr/share/mrpt/config_files"
PROGRAMS = {
    "icp-slam": "icp-slam/icp-slam_demo_classic.ini",
    "rbpf-slam": "rbpf-slam/gridmapping_RBPF_ICPbased_intel.ini",
}
# Seconds that one program may take.
MOST_SECONDS = 900


def main():
    """Converts, runs, prints."""
    (log,) = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        times, odometry, imported = convert(log, folder)
        for name, configuration in PROGRAMS.items():
            print(json.dumps(run(name, configuration, folder, times, odometry, imported)))
            sys.stdout.flush()


def convert(log, folder):
    """The times and odometry of the scans, and the bytes of the objects that MRPT's importer makes of a log."""
    times, odometry = [], []
    with open(log, encoding="ascii") as lines:
        for line in lines:
            words = line.split()
            if words and words[0] == "FLASER":
                count = int(words[1])
                odometry.append([float(word) for word in words[count + 5 : count + 8]])
                times.append(float(words[-1]))
    raw = os.path.join(folder, "imported.rawlog")
    command = ["carmen2rawlog", "-i", log, "-o", raw, "-w", "-q"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with gzip.open(raw) as file:
        imported = file.read()
    return times, odometry, timed(imported, times)


def timed(imported, times):
    """The objects, an odometry and a scan for each time, with these times instead of the one that all have."""
    at = imported.index(b"ODOMETRY") + len(b"ODOMETRY")
    same = imported[at : at + 8]
    (base,) = struct.unpack("<Q", same)
    parts = imported.split(same)
    if len(parts) != 2 * len(times) + 1:
        sys.exit(f"{len(times)} scans, but {len(parts) - 1} times in what was imported")
    told = [parts[0]]
    for number, part in enumerate(parts[1:]):
        stamp = base + int(1e7 * (times[number // 2] - times[0])) + 1000 * (number % 2)
        told += [struct.pack("<Q", stamp), part]
    return b"".join(told)


def scans(imported):
    """The scans among the objects, each as it is."""
    start = re.compile(rb".mrpt::obs::CObservation(?:2DRangeScan|Odometry)", re.DOTALL)
    places = [found.start() for found in start.finditer(imported)] + [len(imported)]
    objects = [imported[begin:end] for begin, end in zip(places, places[1:])]
    return [one for one in objects if b"2DRangeScan" in one[:40]]


def named(name, version, content):
    """An object as MRPT writes them."""
    return bytes([len(name) | 0x80]) + name.encode() + bytes([version]) + content + b"\x88"


def pairs(imported, odometry):
    """For each scan the motion since the one before, and the scan."""
    whole = []
    before = odometry[0]
    for scan, pose in zip(scans(imported), odometry):
        step = named("mrpt::poses::CPose2D", 1, struct.pack("<3d", *between(before, pose)))
        # The Gaussian model with its usual noise; the other model, which is not chosen, with its own.
        gaussian = struct.pack("<I6f", 0, 0.01, 0.0573, 0.01745, 0.05, 0.01, 0.00349)
        thrun = struct.pack("<I6f", 300, 0.05, 0.0698, 0.01, 0.00573, 0.001, 0.00087)
        rest = struct.pack("<?2f?2i", False, 0.0, 0.0, False, 0, 0) + scan_time(scan)
        motion = named("mrpt::obs::CActionRobotMovement2D", 6, struct.pack("<I", 0) + step + gaussian + thrun + rest)
        whole.append(named("mrpt::obs::CActionCollection", 0, struct.pack("<I", 1) + motion))
        whole.append(named("mrpt::obs::CSensoryFrame", 2, struct.pack("<I", 1) + scan))
        before = pose
    return b"".join(whole)


def scan_time(scan):
    """The eight bytes of a scan's time, which stand behind its label."""
    at = scan.index(b"FLASER") + len(b"FLASER")
    return scan[at : at + 8]


def between(start, end):
    """A pose as seen from another one."""
    (x, y, turn), (u, v, heading) = start, end
    cos, sin = math.cos(turn), math.sin(turn)
    across = (heading - turn + math.pi) % (2 * math.pi) - math.pi
    return cos * (u - x) + sin * (v - y), cos * (v - y) - sin * (u - x), across


def run(name, configuration, folder, times, odometry, imported):
    """One program on all scans."""
    out = os.path.join(folder, name)
    with open(os.path.join(CONFIGURATIONS, configuration), encoding="utf-8") as file:
        text = file.read()
    for option, value in [
        ("SHOW_PROGRESS_3D_REAL_TIME", 0),
        ("SHOW_PROGRESS_IN_WINDOW", 0),
        ("SAVE_3D_SCENE", 0),
        ("SAVE_MAP_IMAGES", 0),
        ("SAVE_POSE_LOG", 0),
        ("LOG_FREQUENCY", 1000000),
        ("logOutput_dir", out),
        ("verbosity_level", "ERROR"),
    ]:
        text = re.sub(rf"(?m)^{option}\s*=.*$", f"{option}={value}", text)
    settings, rawlog = os.path.join(folder, name + ".ini"), os.path.join(folder, name + ".rawlog")
    with open(settings, "w", encoding="utf-8") as file:
        file.write(text)
    with gzip.open(rawlog, "wb", compresslevel=1) as file:
        file.write(imported if name == "icp-slam" else pairs(imported, odometry))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    try:
        command = [name, settings, rawlog]
        quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        ended = subprocess.run(["/usr/bin/env", "OMP_NUM_THREADS=1"] + command, timeout=MOST_SECONDS, **quiet).returncode
    except subprocess.TimeoutExpired:
        ended = f"stopped after {MOST_SECONDS} s"
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    told = {"peer": name, "seconds": usage.ru_utime - before, "megabytes": usage.ru_maxrss / 1024, "poses": []}
    path = os.path.join(out, "log_estimated_path.txt")
    if os.path.exists(path):
        with open(path, encoding="ascii") as lines:
            words = [[float(word) for word in line.split()] for line in lines]
        # Either `step x y heading` or `step x y z yaw pitch roll`.
        poses = [[line[1], line[2], line[4] if len(line) > 4 else line[3]] for line in words]
        # icp-slam has a line for each odometry message, too.
        step = 2 if len(poses) == 2 * len(times) else 1
        told["poses"] = poses[step - 1 :: step]
    if len(told["poses"]) != len(times):
        told["problem"] = f"{len(told['poses'])} poses of {len(times)} scans; it ended with {ended}"
    return told


if __name__ == "__main__":
    main()
