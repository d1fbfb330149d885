"""A ROS 2 node that prints the robot's scans and odometry as lines of JSON: python3 scripts/ros2-lines.py | hssh live -"""
import json, math
import rclpy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan

def tell(message, **fields): print(json.dumps({"time": message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec, **fields}), flush=True)
def scan(m): tell(m, angle_min=m.angle_min, angle_increment=m.angle_increment, range_max=m.range_max, ranges=list(m.ranges))
def odom(m): tell(m, pose=[m.pose.pose.position.x, m.pose.pose.position.y, 2 * math.atan2(m.pose.pose.orientation.z, m.pose.pose.orientation.w)])

rclpy.init()
node = rclpy.create_node("lines_for_hssh")
node.create_subscription(LaserScan, "scan", scan, 10)
node.create_subscription(Odometry, "odom", odom, 10)
rclpy.spin(node)
