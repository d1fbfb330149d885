"""Converts a CARMEN log to ROS bags of every kind, by an independent writer: the PyPI package `rosbags`.

    pip install rosbags
    python3 scripts/convert-log.py robot.log.gz FOLDER

writes FOLDER/mcap, FOLDER/mcap-file, FOLDER/db3, FOLDER/db3-file, FOLDER/db3-message (ROS 2) and FOLDER/none.bag, bz2.bag,
lz4.bag (ROS 1), and FOLDER/clock.log.gz: the log itself with the scans' times that the bags have, which differ where the log's clock
stands still or goes back, as no bag's may. What `hssh map` answers to each is what it answers to that; scripts/compare-bags.sh says whether it is.

A third argument adds so many messages of 1 MB of a camera, to MCAP, db3 and an unpacked .bag alone.

A scan goes with the odometry of its own message, with the same stamp; odometry between two scans is stamped evenly
between them, so that the order of the log is that of the stamps whatever clock the log has.
"""

import gzip
import math
import sys
from pathlib import Path

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

BEAMS = {180: (-90.0, 1.0), 181: (-90.0, 1.0), 360: (-90.0, 0.5), 361: (-90.0, 0.5)}


def read(path):
    """The messages of a log: ("scan", stamp, pose, ranges) and ("odom", stamp, pose), stamps in nanoseconds; and its lines with these stamps."""
    text = (gzip.open if path.suffix == ".gz" else open)(path, "rt")
    messages, waiting, last, lines = [], [], None, []

    def flush(until):
        first = until - 1_000_000_000 if last is None else last
        for number, pose in enumerate(waiting):
            messages.append(("odom", first + (until - first) * (number + 1) // (len(waiting) + 1), pose))
        waiting.clear()

    for line in text:
        lines.append(line)
        words = line.split()
        if words and words[0] == "FLASER":
            beams = int(words[1])
            pose = [float(word) for word in words[2 + beams + 3 : 2 + beams + 6]]
            seconds, _, fraction = words[2 + beams + 6].partition(".")
            stamp = int(seconds) * 1_000_000_000 + int((fraction + "0" * 9)[:9])
            if last is not None and stamp <= last:
                stamp = last + 1_000_000  # A clock that stands still or goes back cannot say the order of the log.
                words[2 + beams + 6] = f"{stamp // 10**9}.{stamp % 10**9:09}"
                lines[-1] = " ".join(words) + "\n"
            flush(stamp)
            last = stamp
            messages.append(("scan", stamp, pose, [float(word) for word in words[2 : 2 + beams]]))
        elif words and words[0] == "ODOM":
            waiting.append([float(word) for word in words[1:4]])
    flush(last + 1_000_000_000)
    return messages, lines


def typed(store, messages, is_ros1):
    """(topic, type, stamp, message) of each."""
    types = store.types
    one = {"seq": 0} if is_ros1 else {}
    point, quaternion = types["geometry_msgs/msg/Point"], types["geometry_msgs/msg/Quaternion"]
    vector = types["geometry_msgs/msg/Vector3"]

    def header(stamp, frame):
        time = types["builtin_interfaces/msg/Time"](sec=stamp // 10**9, nanosec=stamp % 10**9)
        return types["std_msgs/msg/Header"](stamp=time, frame_id=frame, **one)

    still = types["geometry_msgs/msg/TransformStamped"](
        header=header(messages[0][1], "base_link"),
        child_frame_id="laser",
        transform=types["geometry_msgs/msg/Transform"](
            translation=vector(x=0.0, y=0.0, z=0.3), rotation=quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
        ),
    )
    tf = types["tf2_msgs/msg/TFMessage"](transforms=[still])
    yield "/tf_static", "tf2_msgs/msg/TFMessage", messages[0][1], tf
    zeros = np.zeros(36)
    for kind, stamp, (x, y, theta), *rest in messages:
        pose = types["geometry_msgs/msg/Pose"](
            position=point(x=x, y=y, z=0.0),
            orientation=quaternion(x=0.0, y=0.0, z=math.sin(theta / 2), w=math.cos(theta / 2)),
        )
        twist = types["geometry_msgs/msg/Twist"](linear=vector(x=0.0, y=0.0, z=0.0), angular=vector(x=0.0, y=0.0, z=0.0))
        odometry = types["nav_msgs/msg/Odometry"](
            header=header(stamp, "odom"),
            child_frame_id="base_link",
            pose=types["geometry_msgs/msg/PoseWithCovariance"](pose=pose, covariance=zeros),
            twist=types["geometry_msgs/msg/TwistWithCovariance"](twist=twist, covariance=zeros),
        )
        yield "/odom", "nav_msgs/msg/Odometry", stamp, odometry
        if kind == "scan":
            ranges = np.array(rest[0], dtype=np.float32)
            first, step = BEAMS[len(ranges)]
            scan = types["sensor_msgs/msg/LaserScan"](
                header=header(stamp, "laser"),
                angle_min=math.radians(first),
                angle_max=math.radians(first + step * (len(ranges) - 1)),
                angle_increment=math.radians(step),
                time_increment=0.0,
                scan_time=0.0,
                range_min=0.0,
                range_max=100.0,
                ranges=ranges,
                intensities=np.array([], dtype=np.float32),
            )
            yield "/scan", "sensor_msgs/msg/LaserScan", stamp, scan


def padded(told, store, count, padding, is_ros1):
    """The messages, with so many images of 1 MB between them."""
    rest = np.random.default_rng(1).integers(0, 256, 1 << 20, dtype=np.uint8)
    written = 0
    for number, (topic, kind, stamp, message) in enumerate(told):
        yield topic, kind, stamp, message
        while written * count < padding * number:
            written += 1
            header = store.types["std_msgs/msg/Header"](
                stamp=store.types["builtin_interfaces/msg/Time"](sec=0, nanosec=0), frame_id="camera", **({"seq": 0} if is_ros1 else {})
            )
            image = store.types["sensor_msgs/msg/CompressedImage"](header=header, format="none", data=rest)
            yield "/camera", "sensor_msgs/msg/CompressedImage", stamp, image


def write(writer, store, messages, is_ros1, padding):
    with writer:
        connections = {}
        told = typed(store, messages, is_ros1)
        for topic, kind, stamp, message in padded(told, store, len(messages), padding, is_ros1):
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=store)
            serialize = store.serialize_ros1 if is_ros1 else store.serialize_cdr
            writer.write(connections[topic], stamp, serialize(message, kind))


def main():
    log, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    messages, lines = read(log)
    with gzip.open(folder / "clock.log.gz", "wt") as out:
        out.writelines(lines)
    padding = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    ros2 = get_typestore(Stores.ROS2_HUMBLE)
    kinds = {
        "mcap": (StoragePlugin.MCAP, None),
        "mcap-file": (StoragePlugin.MCAP, CompressionMode.FILE),
        "db3": (StoragePlugin.SQLITE3, None),
        "db3-file": (StoragePlugin.SQLITE3, CompressionMode.FILE),
        "db3-message": (StoragePlugin.SQLITE3, CompressionMode.MESSAGE),
    }
    for name, (plugin, mode) in kinds.items():
        if padding and mode:
            continue
        writer = Writer2(folder / name, version=9, storage_plugin=plugin)
        if mode:
            writer.set_compression(mode, CompressionFormat.ZSTD)
        write(writer, ros2, messages, False, padding)
    ros1 = get_typestore(Stores.ROS1_NOETIC)
    ros1.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
    for name in ["none"] if padding else ["none", "bz2", "lz4"]:
        writer = Writer1(folder / f"{name}.bag")
        if name != "none":
            writer.set_compression(Writer1.CompressionFormat[name.upper()])
        write(writer, ros1, messages, True, padding)


main()
