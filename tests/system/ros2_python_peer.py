#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets Cyclone DDS for Python, as it comes from PyPI, drive and watch a robot by the topics of ROS 2.

    ros2_python_peer.py BUILD

`pip install cyclonedds`, for instance into a virtual environment whose Python the variable ORCA_CLIENTS_PYTHON names. It brings a Cyclone DDS
of its own, newer than Debian's, which the other tests speak to. Where it is not there, the test is skipped. All is on the loopback interface.
"""
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
DOMAIN = 40 + os.getpid() % 50
SETTINGS = f"""<CycloneDDS><Domain Id="{DOMAIN}"><General><Interfaces><NetworkInterface name="lo"/></Interfaces><AllowMulticast>false</AllowMulticast>
</General><Discovery><SPDPInterval>200 ms</SPDPInterval><ParticipantIndex>auto</ParticipantIndex><Peers><Peer Address="127.0.0.1"/></Peers></Discovery>
</Domain></CycloneDDS>"""
SPEED = 0.25  # [m/s]


def check(is_so, what):
    if not is_so:
        sys.exit(f"FAILED: {what}")


def parts_of_messages():
    """The types of ROS 2 of which those that are spoken here consist, as classes of the library."""
    from dataclasses import dataclass

    from cyclonedds.idl import IdlStruct
    from cyclonedds.idl.types import float64, int32, uint32

    @dataclass
    class Time(IdlStruct, typename="builtin_interfaces::msg::dds_::Time_"):
        sec: int32
        nanosec: uint32

    @dataclass
    class Header(IdlStruct, typename="std_msgs::msg::dds_::Header_"):
        stamp: Time
        frame_id: str

    @dataclass
    class Vector3(IdlStruct, typename="geometry_msgs::msg::dds_::Vector3_"):
        x: float64
        y: float64
        z: float64

    @dataclass
    class Quaternion(IdlStruct, typename="geometry_msgs::msg::dds_::Quaternion_"):
        x: float64
        y: float64
        z: float64
        w: float64

    @dataclass
    class Point(IdlStruct, typename="geometry_msgs::msg::dds_::Point_"):
        x: float64
        y: float64
        z: float64

    @dataclass
    class Pose(IdlStruct, typename="geometry_msgs::msg::dds_::Pose_"):
        position: Point
        orientation: Quaternion

    @dataclass
    class Twist(IdlStruct, typename="geometry_msgs::msg::dds_::Twist_"):
        linear: Vector3
        angular: Vector3

    return Header, Vector3, Pose, Twist


def messages():
    """The types of ROS 2 that are spoken here."""
    from dataclasses import dataclass

    from cyclonedds.idl import IdlStruct
    from cyclonedds.idl.types import array, float32, float64, sequence

    Header, Vector3, Pose, Twist = parts_of_messages()

    @dataclass
    class PoseWithCovariance(IdlStruct, typename="geometry_msgs::msg::dds_::PoseWithCovariance_"):
        pose: Pose
        covariance: array[float64, 36]

    @dataclass
    class TwistWithCovariance(IdlStruct, typename="geometry_msgs::msg::dds_::TwistWithCovariance_"):
        twist: Twist
        covariance: array[float64, 36]

    @dataclass
    class Odometry(IdlStruct, typename="nav_msgs::msg::dds_::Odometry_"):
        header: Header
        child_frame_id: str
        pose: PoseWithCovariance
        twist: TwistWithCovariance

    @dataclass
    class LaserScan(IdlStruct, typename="sensor_msgs::msg::dds_::LaserScan_"):
        header: Header
        angle_min: float32
        angle_max: float32
        angle_increment: float32
        time_increment: float32
        scan_time: float32
        range_min: float32
        range_max: float32
        ranges: sequence[float32]
        intensities: sequence[float32]

    return Twist, Vector3, Odometry, LaserScan


class Peer:
    """A participant that watches a robot, and may drive it."""

    def __init__(self):
        from cyclonedds.core import Policy, Qos
        from cyclonedds.domain import DomainParticipant
        from cyclonedds.pub import DataWriter
        from cyclonedds.sub import DataReader
        from cyclonedds.topic import Topic

        self.twist, self.vector, odometry, scan = messages()
        self.participant = DomainParticipant(DOMAIN)
        last = Policy.History.KeepLast(10)
        best_effort = Qos(Policy.Reliability.BestEffort, last)
        reliable = Qos(Policy.Reliability.Reliable(1_000_000_000), last)
        self.odometry = DataReader(self.participant, Topic(self.participant, "rt/odom", odometry), qos=reliable)
        self.scans = DataReader(self.participant, Topic(self.participant, "rt/scan", scan), qos=best_effort)
        self.commands = DataWriter(self.participant, Topic(self.participant, "rt/cmd_vel", self.twist), qos=reliable)

    def drive(self, speed):
        zero = self.vector(0.0, 0.0, 0.0)
        self.commands.write(self.twist(self.vector(speed, 0.0, 0.0), zero))

    @staticmethod
    def next_of(reader, limit=10.0):
        """Returns the latest sample that comes within a time [s]."""
        end = time.monotonic() + limit
        while time.monotonic() < end:
            samples = [sample for sample in reader.take(100) if getattr(sample, "header", None) is not None]
            if samples:
                return samples[-1]
            time.sleep(0.01)
        sys.exit("FAILED: nothing comes")


def drive_a_metre(peer):
    began = time.monotonic()
    scan = peer.next_of(peer.scans)
    at = peer.next_of(peer.odometry)
    print(f"scan and odometry after {time.monotonic() - began:.2f} s")
    check(scan.header.frame_id.endswith("laser") and len(scan.ranges) == 181, f"{scan.header.frame_id}: {len(scan.ranges)} ranges")
    check(math.isclose(scan.angle_increment, math.radians(1.0), rel_tol=1e-4), "a scan has a range for each degree")
    check(all(scan.range_min <= each <= scan.range_max or math.isinf(each) for each in scan.ranges), "ranges are within their bounds")
    check(at.header.frame_id.endswith("odom") and at.child_frame_id.endswith("base_link"), f"{at.header.frame_id}, {at.child_frame_id}")

    start = (at.pose.pose.position.x, at.pose.pose.position.y)
    way = 0.0
    while way < 1.0:
        check(time.monotonic() < began + 40, f"the robot drives a metre, and not {way} m")
        peer.drive(SPEED)
        here = peer.next_of(peer.odometry).pose.pose.position
        way = math.dist(start, (here.x, here.y))
        time.sleep(0.05)
    time.sleep(1.5)  # it falls silent
    here = peer.next_of(peer.odometry)
    way = math.dist(start, (here.pose.pose.position.x, here.pose.pose.position.y))
    print(f"drove {way:.2f} m, and stands")
    check(abs(here.twist.twist.linear.x) < 0.01, "the robot stands when nobody commands it")
    check(way < 1.35, f"it stands soon: {way} m")


def main():
    python = os.environ.pop("ORCA_CLIENTS_PYTHON", None)
    if python:
        os.execv(python, [python, "-B", *sys.argv])
    try:
        import cyclonedds  # noqa: F401
    except ImportError:
        print("SKIPPED: cyclonedds is not installed for this Python (PyPI)")
        return
    with tempfile.TemporaryDirectory() as folder:
        os.environ.update(CYCLONEDDS_URI=SETTINGS, ROS_LOCALHOST_ONLY="1", ROS_DOMAIN_ID=str(DOMAIN), XDG_RUNTIME_DIR=folder)
        robot = subprocess.Popen([pathlib.Path(sys.argv[1]) / "bin/deployer", SOURCE / "graphs/ros2_pioneer.xml", "--set", "realism=ideal"],
                                 stderr=subprocess.PIPE, text=True)
        try:
            drive_a_metre(Peer())
        finally:
            robot.terminate()
            said = robot.communicate(timeout=20)[1]
        expected = "the base stands: no motion command"
        check(not [line for line in said.splitlines() if " warning " in line and expected not in line], said)
    print("all is well")


if __name__ == "__main__":
    main()
