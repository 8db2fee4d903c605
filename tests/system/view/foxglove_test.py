#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""orcaview as a server of the Foxglove WebSocket protocol: by hand, and by the protocol's own client for Node.

    tests/system/view/foxglove_test.py BUILD_FOLDER
"""
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest

from view_case import TREE, ViewCase
from websocket import WebSocket

OLD, NEW = "foxglove.websocket.v1", "foxglove.sdk.v1"
PACKAGES = ("@foxglove/ws-protocol@0.8.0", "@foxglove/rosmsg", "@foxglove/rosmsg2-serialization", "ws")


class Foxglove(ViewCase):
    NAME = "pioneer_planner"
    COMPONENTS = 5

    @classmethod
    def start_system(cls):
        """With a robot that has a mesh in a package, and one of a file that is no mesh."""
        robot = (TREE / "sim" / "robots" / "pioneer_2dx.urdf").read_text(encoding="utf-8")
        meshes = "".join(f'<link name="{name}"><visual><geometry><mesh filename="{uri}"/></geometry></visual></link>'
                         f'<joint name="to_{name}" type="fixed"><parent link="base_link"/><child link="{name}"/></joint>'
                         for name, uri in (("shell", "package://pioneer/shell.stl"), ("leak", "/etc/passwd")))
        cls.robot = cls.folder / "pioneer" / "robot.urdf"
        cls.robot.parent.mkdir()
        cls.robot.write_text(robot.replace("</robot>", meshes + "</robot>"), encoding="utf-8")
        cls.shell = bytes(range(256)) * 4096
        (cls.folder / "pioneer" / "shell.stl").write_bytes(cls.shell)
        (cls.folder / "pioneer" / "other.stl").write_bytes(b"solid other")
        cls.OPTIONS = ("--set", f"robot={cls.robot}")
        return super().start_system()

    def viewer(self, token=None, protocol=NEW):
        viewer = WebSocket(self.port, token or self.tokens["change"], **{"Sec-WebSocket-Protocol": protocol})
        self.addCleanup(viewer.socket.close)
        self.assertIn("101", viewer.status)
        return viewer

    def advertised(self, viewer):
        while True:
            message = viewer.receive()
            if isinstance(message, dict) and message["op"] == "advertise":
                return {channel["topic"]: channel for channel in message["channels"]}

    def message(self, viewer, op):
        while True:
            message = viewer.receive()
            if isinstance(message, dict) and message["op"] == op:
                return message

    def first(self, viewer, subscription):
        """Returns time [s] and payload of the next message."""
        while True:
            message = viewer.receive()
            if isinstance(message, bytes) and struct.unpack_from("<BI", message) == (1, subscription):
                return struct.unpack_from("<Q", message, 5)[0] / 1e9, message[13:]

    def test_both_versions_are_greeted(self):
        for offered, chosen in ((OLD, OLD), (NEW, NEW), (f"{OLD}, {NEW}", NEW)):
            viewer = self.viewer(protocol=offered)
            self.assertIn(f"Sec-WebSocket-Protocol: {chosen}".lower(), viewer.head.lower())
            info = viewer.receive()
            self.assertEqual(info["op"], "serverInfo")
            self.assertIn("clientPublish", info["capabilities"])

    def test_ports_are_topics_with_the_types_that_ros_has(self):
        topics = {topic: channel["schemaName"] for topic, channel in self.advertised(self.viewer()).items()}
        for topic, schema in (("/base/OdometryPush", "nav_msgs/msg/Odometry"),
                              ("/laser/LaserRangeReadingsPush", "sensor_msgs/msg/LaserScan"),
                              ("/localizer/RobotPosePush", "geometry_msgs/msg/PoseWithCovarianceStamped"),
                              ("/planner/MapPush", "nav_msgs/msg/OccupancyGrid"), ("/fuser/base", "orca/msg/MotionCommand"), ("/tf", "tf2_msgs/msg/TFMessage"),
                              ("/rosout", "rcl_interfaces/msg/Log")):
            self.assertEqual(topics.get(topic), schema, topics)

    def test_a_scan_comes_as_ros_has_it(self):
        viewer = self.viewer()
        channel = self.advertised(viewer)["/laser/LaserRangeReadingsPush"]
        viewer.send(op="subscribe", subscriptions=[{"id": 7, "channelId": channel["id"]}])
        stamp, scan = self.first(viewer, 7)
        self.assertLess(abs(stamp - time.time()), 10.0)
        self.assertEqual(scan[:4], b"\0\1\0\0")
        length = struct.unpack_from("<I", scan, 12)[0]
        self.assertEqual(scan[16:16 + length - 1], b"laser")
        at = 4 + (12 + length + 3) // 4 * 4
        low, high, step = struct.unpack_from("<fff", scan, at)
        count = struct.unpack_from("<I", scan, at + 28)[0]
        self.assertAlmostEqual((high - low) / step + 1, count, delta=0.1)
        ranges = struct.unpack_from(f"<{count}f", scan, at + 32)
        self.assertTrue(any(0.1 < one < 8.2 for one in ranges))
        viewer.send(op="unsubscribe", subscriptionIds=[7])

    def test_a_robots_file_is_a_description_and_no_other_file_is_read(self):
        viewer = self.viewer(self.tokens["observe"])
        topics = self.advertised(viewer)
        self.assertNotIn("/robot_description", topics, "ports come first")
        channels = {channel["topic"]: channel for channel in self.message(viewer, "advertise")["channels"]}
        self.assertEqual(list(channels), ["/robot_description"], "the only file that the graph names of a robot")
        self.assertEqual(channels["/robot_description"]["schemaName"], "std_msgs/msg/String")
        self.assertNotIn(channels["/robot_description"]["id"], [channel["id"] for channel in topics.values()])
        for _ in range(2):  # whoever comes later gets it, too
            viewer.send(op="subscribe", subscriptions=[{"id": 9, "channelId": channels["/robot_description"]["id"]}])
            _, message = self.first(viewer, 9)
            length = struct.unpack_from("<I", message, 4)[0]
            self.assertEqual((message[:4], message[-1:], len(message)), (b"\0\1\0\0", b"\0", 8 + length))
            self.assertEqual(message[8:-1], self.robot.read_bytes())
            viewer.send(op="unsubscribe", subscriptionIds=[9])

    def asset(self, viewer, number, uri):
        """Asks for a file, and returns what comes: its bytes, or the error as a text."""
        viewer.send(op="fetchAsset", requestId=number, uri=uri)
        return self.fetched(viewer, number)

    def fetched(self, viewer, number):
        while True:
            message = viewer.receive()
            if isinstance(message, bytes) and message[0] == 4:
                _, request, failed, length = struct.unpack_from("<BIBI", message)
                self.assertEqual(request, number)
                return message[10:10 + length].decode() if failed else message[10:]

    def test_meshes_that_a_robots_file_names_are_fetched_and_no_other_file(self):
        viewer = self.viewer(self.tokens["observe"])
        self.assertIn("assets", viewer.receive()["capabilities"])
        self.message(viewer, "advertise")
        self.message(viewer, "advertise")  # the robot's
        self.assertEqual(self.asset(viewer, 1, "package://pioneer/shell.stl"), self.shell)
        self.assertEqual(self.asset(viewer, 2, f"file://{self.folder}/pioneer/shell.stl"), self.shell)
        self.assertEqual(self.asset(viewer, 3, f"file://{self.robot}"), self.robot.read_bytes())
        for number, uri in enumerate(("package://pioneer/other.stl", "package://pioneer/../pioneer/shell.stl", "shell.stl",
                                      "package://orca/../../../../etc/passwd", "/etc/shadow", "", "x" * 5000), 4):
            self.assertIsInstance(self.asset(viewer, number, uri), str, uri)
        self.assertIn("no mesh", self.asset(viewer, 20, "/etc/passwd"), "the robot's file names it")
        for number in range(30, 70):  # 40 MiB: more than waits at a time
            viewer.send(op="fetchAsset", requestId=number, uri="package://pioneer/shell.stl")
        for number in range(30, 70):
            self.assertEqual(self.fetched(viewer, number), self.shell)

    def test_who_may_only_observe_publishes_nothing_and_sets_nothing(self):
        viewer = self.viewer(self.tokens["observe"])
        self.advertised(viewer)
        viewer.send(op="setParameters", parameters=[{"name": "planner.max_speed", "value": 0.1}])
        self.assertIn('"set" takes the role change, and this address has observe', self.message(viewer, "status")["message"])
        viewer.send(op="advertise", channels=[{"id": 1, "topic": "/goal_pose", "encoding": "json",
                                               "schemaName": "geometry_msgs/msg/PoseStamped"}])
        pose = {"header": {"frame_id": "map"}, "pose": {"position": {"x": 1, "y": 2, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}}
        viewer.send_frame(2, struct.pack("<BI", 1, 1) + json.dumps(pose).encode())
        self.assertIn('"talk to" takes the role operate, and this address has observe', self.message(viewer, "status")["message"])

    def test_what_is_wrong_is_said_and_nothing_ends(self):
        viewer = self.viewer()
        self.advertised(viewer)
        deep = b'{"op":"getParameters","id":' + b"[" * 400_000 + b"]" * 400_000 + b"}"
        viewer.send_frame(1, deep)
        self.assertIn("JSON object", self.message(viewer, "status")["message"])
        for text, part in ((b"nonsense", "JSON object"), (b'{"op":"dance"}', "dance"), (b'{"op":"subscribe"}', "missing"),
                           (b'{"op":"subscribe","subscriptions":[{"id":1,"channelId":9999}]}', "no channel 9999"),
                           (b'{"op":"subscribe","subscriptions":7}', "wrong type"), (b'{"op":"fetchAsset","requestId":1}', "missing")):
            viewer.send_frame(1, text)
            self.assertIn(part, self.message(viewer, "status")["message"])
        viewer.send(op="advertise", channels=[{"id": 1, "topic": "/x", "encoding": "cdr", "schemaName": "std_msgs/msg/String"},
                                              {"id": 2, "topic": "/y", "encoding": "cdr",
                                               "schemaName": "geometry_msgs/msg/PoseStamped"}])
        for frame, part in ((b"\x07", "does not know"), (struct.pack("<BI", 1, 5), "not advertised"),
                            (struct.pack("<BI", 1, 1) + b"x", "String"),
                            (struct.pack("<BI", 1, 2) + b"\0\1\0\0\xff\xff\xff\xff" * 3, "the bytes are no"),
                            (struct.pack("<BI", 1, 2), "the bytes are no")):
            viewer.send_frame(2, frame)
            self.assertIn(part, self.message(viewer, "status")["message"])

    def test_the_protocols_own_client_decodes_all_and_sends_a_goal(self):
        folder = tempfile.TemporaryDirectory(prefix="orca_foxglove_")
        self.addCleanup(folder.cleanup)
        if not shutil.which("npm"):
            self.skipTest("npm is not installed")
        try:
            subprocess.run(["npm", "install", "--no-audit", "--no-fund", *PACKAGES], cwd=folder.name, capture_output=True, text=True,
                           timeout=60, check=True)
        except subprocess.TimeoutExpired:
            self.skipTest("npm cannot fetch the client within 60 s")
        except subprocess.CalledProcessError as error:
            self.skipTest("npm cannot fetch the client: " + " ".join(error.stderr.split())[-200:])
        shutil.copy(TREE / "tests" / "system" / "view" / "foxglove_client.cjs", folder.name)
        done = subprocess.run(["node", "foxglove_client.cjs", f"ws://127.0.0.1:{self.port}/?token={self.tokens['change']}"],
                              cwd=folder.name, capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        seen = json.loads(done.stdout)
        self.assertEqual(seen["server"]["metadata"], {"ROS_DISTRO": "jazzy"})
        scan = seen["messages"]["/laser/LaserRangeReadingsPush"]
        self.assertGreater(scan["count"], 5)
        self.assertGreater(len(scan["last"]["ranges"]), 100)
        odometry = seen["messages"]["/base/OdometryPush"]
        self.assertGreater(odometry["count"], 10)
        self.assertEqual(odometry["last"]["child_frame_id"], "base_link")
        grid = seen["messages"]["/planner/MapPush"]["last"]
        self.assertEqual(len(grid["data"]), grid["info"]["width"] * grid["info"]["height"])
        self.assertEqual(set(grid["data"]), {-1, 0, 100})
        frames = {transform["child_frame_id"] for transform in seen["messages"]["/tf"]["last"]["transforms"]}
        self.assertTrue(frames & {"odom", "base_link", "laser"}, frames)
        self.assertEqual(seen["parameters"][0]["name"], "planner.max_speed")
        self.assertIn({"name": "planner.max_speed", "value": 0.25}, seen["parameters"])
        published = {one["name"]: one["publisherIds"] for one in seen["graph"]["publishedTopics"]}
        taken = {one["name"]: one["subscriberIds"] for one in seen["graph"]["subscribedTopics"]}
        self.assertEqual(published["/base/OdometryPush"], ["base"])
        self.assertIn("planner", taken["/laser/LaserRangeReadingsPush"])
        self.assertEqual([line for line in seen["status"] if "goal" in line.lower() or "port" in line], [])
        mesh, other = seen["assets"]
        self.assertEqual((mesh["id"], mesh["status"], mesh["bytes"], mesh["first"]), (0, 0, len(self.shell), 0x03020100))
        self.assertEqual((other["id"], other["status"]), (1, 1))
        self.assertIn("no robot's file of this system names", other["error"])
        goal = seen["messages"]["/planner/GoalPush"]["last"]["pose"]["position"]
        self.assertEqual((goal["x"], goal["y"]), (3, 6))


if __name__ == "__main__":
    sys.argv.pop()
    unittest.main()
