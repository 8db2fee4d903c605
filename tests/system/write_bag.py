# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a bag of ten scans and ten readings of odometry with the Python package rosbags: write_bag.py FOLDER "sqlite3|mcap [message|file]".
Exit 77: it is not there."""
import sys
from pathlib import Path

try:
    import numpy
    from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore
except ImportError as missing:
    print(f"{missing}; install the Python package rosbags")
    sys.exit(77)

form, *compression = sys.argv[2].split()
store = get_typestore(Stores.ROS2_JAZZY)
types = store.types
Time, Header = types["builtin_interfaces/msg/Time"], types["std_msgs/msg/Header"]
Point, Quaternion, Vector3 = (types[f"geometry_msgs/msg/{name}"] for name in ("Point", "Quaternion", "Vector3"))
Pose, Twist = types["geometry_msgs/msg/Pose"], types["geometry_msgs/msg/Twist"]
PoseWithCovariance, TwistWithCovariance = types["geometry_msgs/msg/PoseWithCovariance"], types["geometry_msgs/msg/TwistWithCovariance"]
Odometry, LaserScan = types["nav_msgs/msg/Odometry"], types["sensor_msgs/msg/LaserScan"]


def scan(header):
    ranges = numpy.full(181, 3.0, dtype=numpy.float32)
    return LaserScan(header, -1.57, 1.57, 0.01745, 0.0, 0.1, 0.1, 8.0, ranges, numpy.zeros(0, dtype=numpy.float32))


def odometry(header, x):
    return Odometry(header, "base_link", PoseWithCovariance(Pose(Point(x, 0.0, 0.0), Quaternion(0.0, 0.0, 0.0, 1.0)), numpy.zeros(36)),
                    TwistWithCovariance(Twist(Vector3(0.3, 0.0, 0.0), Vector3(0.0, 0.0, 0.0)), numpy.zeros(36)))


writer = Writer(Path(sys.argv[1]), version=9, storage_plugin=StoragePlugin.SQLITE3 if form == "sqlite3" else StoragePlugin.MCAP)
if compression:
    writer.set_compression(CompressionMode[compression[0].upper()], CompressionFormat.ZSTD)
with writer:
    topics = {name: writer.add_connection(name, kind.__msgtype__, typestore=store) for name, kind in (("/scan", LaserScan), ("/odom", Odometry))}
    for i in range(10):
        header = Header(Time(1_700_000_000, i * 100_000_000), "laser")
        for topic, message in (("/scan", scan(header)), ("/odom", odometry(header, 0.03 * i))):
            writer.write(topics[topic], 1_700_000_000_000_000_000 + i * 100_000_000, store.serialize_cdr(message, message.__msgtype__))
