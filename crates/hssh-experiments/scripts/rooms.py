#!/usr/bin/env python3
"""Room segmentation of floor plans by OpenCV, and of label images, scored against the true rooms.

    pip install opencv-python-headless numpy
    python3 rooms.py DATA/gridmap/rooms [--hssh target/release/hssh]

The baselines, made of OpenCV's functions after the survey of Bormann et al. (2016): a watershed of the distance transform,
flooded from what is wider than a wide door; the cores of the distance transform at the threshold that gives the most rooms,
grown over the rest; and the Voronoi diagram, cut at its critical points. With --hssh the program's own `--export labels=`
images are scored in the same way: this scorer shares no code with the one behind `cargo xtask grids`.
"""
import argparse
import pathlib
import subprocess
import tempfile

import cv2
import numpy as np

RESOLUTION = 0.05
TRUTH = "_gt_segmentation.png"


def gray(path):
    image = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    if image.ndim == 2:
        return image
    return image[..., 0] if image.shape[2] == 2 else cv2.cvtColor(image[..., :3], cv2.COLOR_BGR2GRAY)


def true_rooms(path):
    count, labels, stats, _ = cv2.connectedComponentsWithStats((gray(path) > 250).astype(np.uint8), connectivity=4)
    rooms = np.zeros_like(labels)
    number = 0
    for label in range(1, count):
        if stats[label, cv2.CC_STAT_AREA] * RESOLUTION**2 >= 1:
            number += 1
            rooms[labels == label] = number
    return rooms


def score(regions, rooms):
    """MCC one to one, precision, recall, F1 at half the union, numbers of regions and rooms."""
    shared = np.zeros((regions.max() + 1, rooms.max() + 1))
    np.add.at(shared, (regions.ravel(), rooms.ravel()), 1)
    shared = shared[:, 1:]
    total, of_room = shared.sum(), shared.sum(0)
    shared = shared[1:]
    of_region = shared.sum(1)
    left, mcc = shared.copy(), 0.0
    while left.size and left.max() > 0:
        region, room = np.unravel_index(left.argmax(), left.shape)
        hit = shared[region, room]
        extra, missing = of_region[region] - hit, of_room[room] - hit
        rest = total - hit - extra - missing
        norm = (hit + extra) * (hit + missing) * (rest + extra) * (rest + missing)
        mcc += (hit * rest - extra * missing) / np.sqrt(norm) if norm > 0 else 0.0
        left[region, :] = 0
        left[:, room] = 0
    large = of_region * RESOLUTION**2 >= 1
    union = of_region[:, None] + of_room[None] - shared
    found = ((shared > 0) & (2 * shared >= union)).any(0).sum()
    return [
        mcc / len(of_room),
        np.mean((shared.max(1) / np.maximum(of_region, 1))[large]),
        np.mean(shared.max(0) / of_room),
        2 * found / (large.sum() + len(of_room)),
        int(large.sum()),
        len(of_room),
    ]


def watershed(image):
    free = (image >= 206).astype(np.uint8)
    distance = cv2.distanceTransform(free, cv2.DIST_L2, 5)
    # Cores are what is wider than a wide door.
    _, cores = cv2.connectedComponents((distance > 0.75 / RESOLUTION).astype(np.uint8))
    return grown(cores, free, distance)


def grown(cores, free, distance):
    markers = cores.astype(np.int32) + 1
    markers[(free == 1) & (cores == 0)] = 0
    relief = 255 - np.clip(distance * 4, 0, 255).astype(np.uint8)
    regions = cv2.watershed(cv2.merge([relief] * 3), markers) - 1
    return np.where((free == 1) & (regions > 0), regions, 0)


def distance_cores(image):
    """Cores at the threshold with the most of them that are large enough to be rooms, grown over the rest."""
    free = (image >= 206).astype(np.uint8)
    distance = cv2.distanceTransform(free, cv2.DIST_L2, 5)
    best, most = None, 0
    for threshold in np.arange(min(distance.max() - 1, 3 / RESOLUTION), 0, -1):
        count, labels, stats, _ = cv2.connectedComponentsWithStats((distance > threshold).astype(np.uint8))
        large = np.flatnonzero(stats[1:, cv2.CC_STAT_AREA] * RESOLUTION**2 >= 0.35) + 1
        if len(large) > most:
            most, best = len(large), np.where(np.isin(labels, large), labels, 0)
    return grown(best, free, distance)


def voronoi(image):
    """Free space cut across the Voronoi diagram wherever its clearance is least within half a metre; crumbs join a neighbor."""
    free = (image >= 206).astype(np.uint8)
    distance, sites = cv2.distanceTransformWithLabels(free, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    rows, columns = np.nonzero(free == 0)
    site_at = np.zeros((sites.max() + 1, 2))
    site_at[sites[rows, columns]] = np.stack([rows, columns], 1)
    base = site_at[sites]
    diagram = np.zeros(free.shape, bool)
    other = np.zeros_like(base)
    for axis in (0, 1):
        here, there = [(slice(None, -1), slice(None)), (slice(None), slice(None, -1))][axis], [
            (slice(1, None), slice(None)), (slice(None), slice(1, None))][axis]
        between = np.linalg.norm(base[here] - base[there], axis=2)
        # Sites at least as far apart as one of them is away: opposite walls, and not neighbors along one.
        parted = (between > 1.5 * np.maximum(distance[here], 2)) & (free[here] == 1) & (free[there] == 1)
        diagram[here] |= parted
        other[here][parted] = base[there][parted]
    reach = int(0.5 / RESOLUTION)
    on = np.where(diagram, distance, np.inf).astype(np.float32)
    least = cv2.erode(on, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1,) * 2))
    most = cv2.dilate(np.where(diagram, distance, 0).astype(np.float32),
                      cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1,) * 2))
    critical = diagram & (on <= least) & (on < 0.8 * most) & (on < 0.8 / RESOLUTION)
    cut = free.copy()
    for row, column in zip(*np.nonzero(critical)):
        for end in (base[row, column], other[row, column]):
            cv2.line(cut, (int(column), int(row)), (int(end[1]), int(end[0])), 0, 2)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(cut, connectivity=4)
    crumbs = [label for label in range(1, count) if stats[label, cv2.CC_STAT_AREA] * RESOLUTION**2 < 1.5]
    labels[np.isin(labels, crumbs)] = 0
    return grown(labels, free, distance)


def labels_of(program, plan):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "labels.png"
        subprocess.run([program, "stars", plan, "--resolution", str(RESOLUTION), "--export", f"labels={out}"],
                       check=True, capture_output=True)
        colors = cv2.imread(str(out)).astype(np.int64)
    keys = colors[..., 0] << 16 | colors[..., 1] << 8 | colors[..., 2]
    return np.unique(keys, return_inverse=True)[1].reshape(keys.shape)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--hssh", help="the program")
    given = arguments.parse_args()
    baselines = {"watershed": watershed, "distance": distance_cores, "voronoi": voronoi}
    peers = {name: lambda plan, segment=segment: segment(gray(plan)) for name, segment in baselines.items()}
    if given.hssh:
        peers["hssh"] = lambda plan: labels_of(given.hssh, plan)
    names = sorted(path.name[: -len(TRUTH)] for path in given.folder.glob("*" + TRUTH))
    for ending in (".png", "_furnitures.png"):
        plans = [name for name in names if (given.folder / (name + ending)).exists()]
        for peer, segment in peers.items():
            scores = [score(segment(given.folder / (name + ending)), true_rooms(given.folder / (name + TRUTH)))
                      for name in plans]
            mcc, precision, recall, f1 = np.mean([one[:4] for one in scores], 0)
            regions, rooms = np.sum([one[4:] for one in scores], 0)
            print(f"{peer:10} {len(plans):2} plans{ending:17} MCC {mcc:.3f} precision {precision:.3f} "
                  f"recall {recall:.3f} F1 {f1:.3f} regions {regions} of {rooms}")


if __name__ == "__main__":
    main()
