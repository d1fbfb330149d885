"""Writes the small bags of fixtures/bags by an independent writer, the PyPI package `rosbags`: `python3 scripts/make-bags.py`.

A robot drives 1 m ahead in a room of 6 m × 4 m, in five steps of 0.2 m and 0.5 s, and turns left by 0.1 rad in each. Its laser sits 0.3 m ahead
of the axis and 0.1 m to the left. Each bag has one thing that is unusual.
"""

import math
import shutil
from pathlib import Path

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

OUT = Path(__file__).parent.parent / "fixtures" / "bags"
SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND
LASER = (0.3, 0.1)


def wall(x, y, angle):
    """How far a room's wall is: x from -2 to 4, y from -2 to 2."""
    c, s = math.cos(angle), math.sin(angle)
    far = [((4 if c > 0 else -2) - x) / c] if abs(c) > 1e-9 else []
    far += [((2 if s > 0 else -2) - y) / s] if abs(s) > 1e-9 else []
    return min(far)


class Maker:
    def __init__(self, is_ros1):
        self.is_ros1 = is_ros1
        self.store = get_typestore(Stores.ROS1_NOETIC if is_ros1 else Stores.ROS2_HUMBLE)
        if is_ros1:
            text = "geometry_msgs/TransformStamped[] transforms"
            self.store.register(get_types_from_msg(text, "tf2_msgs/msg/TFMessage"))

    def make(self, name, **fields):
        return self.store.types[name](**fields)

    def header(self, stamp, frame):
        time = self.make("builtin_interfaces/msg/Time", sec=stamp // SECOND, nanosec=stamp % SECOND)
        more = {"seq": 0} if self.is_ros1 else {}
        return self.make("std_msgs/msg/Header", stamp=time, frame_id=frame, **more)

    def rotation(self, roll, yaw):
        half = [math.cos(roll / 2), math.sin(roll / 2), math.cos(yaw / 2), math.sin(yaw / 2)]
        w, x, y, z = half[2] * half[0], half[2] * half[1], half[3] * half[1], half[3] * half[0]
        return self.make("geometry_msgs/msg/Quaternion", w=w, x=x, y=y, z=z)

    def transform(self, stamp, parent, child, x, y, z, roll, yaw):
        vector = self.make("geometry_msgs/msg/Vector3", x=x, y=y, z=z)
        transform = self.make("geometry_msgs/msg/Transform", translation=vector, rotation=self.rotation(roll, yaw))
        stamped = self.make(
            "geometry_msgs/msg/TransformStamped",
            header=self.header(stamp, parent),
            child_frame_id=child,
            transform=transform,
        )
        return self.make("tf2_msgs/msg/TFMessage", transforms=[stamped])

    def odometry(self, stamp, pose):
        x, y, theta = pose
        vector = self.make("geometry_msgs/msg/Vector3", x=0.0, y=0.0, z=0.0)
        point = self.make("geometry_msgs/msg/Point", x=x, y=y, z=0.0)
        posed = self.make("geometry_msgs/msg/Pose", position=point, orientation=self.rotation(0.0, theta))
        zeros = np.zeros(36)
        twist = self.make("geometry_msgs/msg/Twist", linear=vector, angular=vector)
        return self.make(
            "nav_msgs/msg/Odometry",
            header=self.header(stamp, "odom"),
            child_frame_id="base_link",
            pose=self.make("geometry_msgs/msg/PoseWithCovariance", pose=posed, covariance=zeros),
            twist=self.make("geometry_msgs/msg/TwistWithCovariance", twist=twist, covariance=zeros),
        )

    def scan(self, stamp, frame, pose, first, step, beams, roll=0.0, yaw=0.0):
        x, y, theta = pose
        at = (x + math.cos(theta) * LASER[0] - math.sin(theta) * LASER[1], y + math.sin(theta) * LASER[0] + math.cos(theta) * LASER[1])
        sign = -1 if roll else 1
        angles = [theta + yaw + sign * (first + step * beam) for beam in range(beams)]
        ranges = np.array([wall(*at, angle) for angle in angles], dtype=np.float32)
        ranges[0] = np.inf
        return self.make(
            "sensor_msgs/msg/LaserScan",
            header=self.header(stamp, frame),
            angle_min=first,
            angle_max=first + step * (beams - 1),
            angle_increment=step,
            time_increment=0.0,
            scan_time=0.0,
            range_min=0.05,
            range_max=20.0,
            ranges=ranges,
            intensities=np.array([], dtype=np.float32),
        )


def two_robots(maker, odom):
    """Two robots that call their frames alike, each in its own namespace: the second drives elsewhere, faster, and tells it twice as often."""
    told = messages(maker, odom=odom)
    for number in range(12):
        time, pose = BEGIN + number * SECOND // 4, (1.5 - 0.4 * number, 0.2 * number, -0.3 * number)
        if odom == "topic":
            told.append(("/odom", TYPES["/odom"], time, maker.odometry(time, pose)))
        else:
            told.append(("/tf", TYPES["/tf"], time, maker.transform(time, "odom", "base_link", *pose[:2], 0.0, 0.0, pose[2])))
        told.append(("/scan", "sensor_msgs/msg/LaserScan", time, maker.scan(time, "laser", (0.0, 0.0, 0.0), -1.0, 0.1, 21)))
    told.append(("/tf_static", TYPES["/tf_static"], BEGIN, maker.transform(BEGIN, "base_link", "laser", -0.5, 0.0, 0.2, 0.0, 1.0)))
    first = len(told) - 25
    named = [(f"/robot{1 if index < first else 2}{topic}", kind, time, message) for index, (topic, kind, time, message) in enumerate(told)]
    return sorted(named, key=lambda message: message[2])


TYPES = {"/tf_static": "tf2_msgs/msg/TFMessage", "/tf": "tf2_msgs/msg/TFMessage", "/odom": "nav_msgs/msg/Odometry"}


def messages(
    maker, first=-2.0, step=0.1, beams=41, roll=0.0, yaw=0.0, odom="topic", mount=True, rear=False, scans=True, shift=0, back=False, cloud=False
):
    """(topic, type, time of recording, message)."""
    told = []
    for number in range(6):
        time = BEGIN + number * SECOND // 2
        stamp = time - 60 * SECOND if back and number >= 3 else time
        pose = (0.2 * number, 0.0, 0.1 * number)
        if odom == "topic":
            told.append(("/odom", time, maker.odometry(stamp + shift, pose)))
        if odom == "tf":
            told.append(("/tf", time, maker.transform(stamp, "odom", "base_link", *pose[:2], 0.0, 0.0, pose[2])))
        if scans:
            told.append(("/scan", time + 1, maker.scan(stamp, "laser", pose, first, step, beams, roll, yaw)))
        if rear:
            told.append(("/rear", time + 2, maker.scan(stamp, "rear_laser", pose, -0.5, 0.1, 11)))
    if mount:
        # Late, as of a node that was started after the recording.
        told.append(("/tf_static", BEGIN + SECOND, maker.transform(BEGIN, "base_link", "laser", *LASER, 0.2, roll, yaw)))
    if cloud:
        empty = np.array([], dtype=np.uint8)
        points = maker.make(
            "sensor_msgs/msg/PointCloud2", header=maker.header(BEGIN, "lidar"), height=1, width=0, fields=[],
            is_bigendian=False, point_step=12, row_step=0, data=empty, is_dense=True,
        )
        told.append(("/points", BEGIN, points))
    types = {"/scan": "sensor_msgs/msg/LaserScan", "/rear": "sensor_msgs/msg/LaserScan", "/points": "sensor_msgs/msg/PointCloud2"}
    return [(topic, (TYPES | types)[topic], time, message) for topic, time, message in sorted(told, key=lambda message: message[1])]


def write(writer, maker, told):
    with writer:
        connections = {}
        for topic, kind, time, message in told:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=maker.store)
            serialize = maker.store.serialize_ros1 if maker.is_ros1 else maker.store.serialize_cdr
            writer.write(connections[topic], time, serialize(message, kind))


def ros2(name, plugin=StoragePlugin.MCAP, mode=None, version=9, robots=False, **options):
    maker = Maker(False)
    writer = Writer2(OUT / name, version=version, storage_plugin=plugin)
    if mode:
        writer.set_compression(mode, CompressionFormat.ZSTD)
    write(writer, maker, two_robots(maker, **options) if robots else messages(maker, **options))


def ros1(name, compression=None, **options):
    maker = Maker(True)
    writer = Writer1(OUT / f"{name}.bag")
    if compression:
        writer.set_compression(Writer1.CompressionFormat[compression])
    write(writer, maker, messages(maker, **options))


shutil.rmtree(OUT, ignore_errors=True)
OUT.mkdir(parents=True)
ros2("usual")
ros2("upside-down", roll=math.pi, yaw=0.7)
ros2("clockwise", first=2.0, step=-0.1)
ros2("all-around", first=0.0, step=math.radians(4.0), beams=90)
ros2("tf-only", odom="tf")
ros2("scans-only", odom=None, mount=False)
ros2("no-mount", mount=False)
ros2("two-lasers", rear=True)
ros2("two-robots", robots=True, odom="topic")
ros2("two-robots-tf", robots=True, odom="tf")
ros2("two-clocks", shift=5000 * SECOND)
ros2("backwards", back=True)
ros2("clouds", scans=False, cloud=True)
ros2("no-laser", scans=False)
ros2("sqlite", StoragePlugin.SQLITE3, version=8)
ros2("sqlite-file", StoragePlugin.SQLITE3, CompressionMode.FILE)
ros2("sqlite-message", StoragePlugin.SQLITE3, CompressionMode.MESSAGE)
ros1("ros1")
ros1("ros1-bz2", "BZ2")
ros1("ros1-lz4", "LZ4")
