#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""orcaview beside a running system: what it shows, whom it lets in, and that no client can hurt it or the system.

    tests/system/view/server_test.py BUILD_FOLDER
"""
import json
import os
import pathlib
import re
import signal
import socket
import stat
import struct
import subprocess
import sys
import tempfile
import time
import unittest

from view_case import BUILD, ROLES, TREE, ViewCase, await_that
from websocket import TEXT, WebSocket

GRAPH = str(TREE / "graphs" / "scout_goto_processes.xml")
POSE = "localizer.RobotPosePush"
# The role that each order takes (docs/security.md), with words that nothing comes of.
ORDERS = {
    "observe": ("ps", "graph", "file", "machines", "team", "ports", "plugins", "objects", "names", "counters", "alarms", "missions", "log", "get goto",
                "pace", "sources", "roles"),
    "operate": ("estop", "estop --release", "suspend nobody", "resume nobody", "alarms ack 99999", "pace 1", "pause", "step 1s", "line goto.Nothing"),
    "change": ("swap nobody x.so", "set goto.nothing 1", "connect a.b c.d", "disconnect a.b c.d", "move a.b c.d", "restart nobody", "fits nobody",
               "apply", "diff", "stop", "of a later version"),
}
TELLS = "takes the role {}, and this address has {}"


class View(ViewCase):
    def page(self, token=None):
        page = WebSocket(self.port, token or self.tokens["change"])
        self.addCleanup(page.socket.close)
        self.assertEqual(page.status.split()[1], "101", page.status)
        self.assertEqual(page.receive()["op"], "hello")
        return page

    def fetch(self, *lines):
        with socket.create_connection(("127.0.0.1", self.port), timeout=10) as connection:
            connection.sendall("\r\n".join([*lines, "", ""]).encode())
            return connection.recv(1 << 16).decode()

    def memory(self):
        """Returns the resident memory of orcaview [kB]."""
        return int(re.search(r"VmRSS:\s+(\d+)", pathlib.Path(f"/proc/{self.view.pid}/status").read_text())[1])

    def objects(self, page, look, count, limit=10.0):
        """Returns heads and payloads of the objects of a look."""
        found, end = [], time.monotonic() + limit
        while len(found) < count and time.monotonic() < end:
            message = page.receive()
            if isinstance(message, bytes) and message[0] == 1 and struct.unpack_from("<I", message, 4)[0] == look:
                found.append((struct.unpack_from("<ddII", message, 8), message[32:]))
        self.assertEqual(len(found), count, "objects came too slowly")
        return found

    # ---- what it shows

    def test_a_page_is_greeted_with_the_system_and_its_role(self):
        for role, token in self.tokens.items():
            with WebSocket(self.port, token) as page:
                hello = page.receive()
            self.assertEqual((hello["system"], hello["role"], hello["present"]), (self.NAME, role, True))
        self.assertLess(abs(hello["time"] - time.time()), 5.0)

    def test_answers_are_those_of_orcactl(self):
        page = self.page()
        page.send(op="ask", id=1, command="ps")
        answer = page.answer(1)
        self.assertTrue(answer["ok"], answer)
        shown = json.loads(self.orcactl("--json", "ps").stdout)
        self.assertEqual([list(row) for row in answer["records"]], [sorted(row) for row in shown])
        for name in ("name", "process", "type", "build_id"):
            self.assertEqual([row[name] for row in answer["records"]], [row[name] for row in shown])
        page.send(op="ask", id=3, command="graph")
        self.assertEqual(json.loads(page.answer(3)["text"])["name"], self.NAME)
        page.send(op="ask", id=4, command="swap", words=["nobody", "x.so"])
        self.assertIn("nobody", page.answer(4)["error"])

    def test_objects_come_as_they_pass(self):
        page = self.page()
        page.send(op="types")
        while True:
            message = page.receive()
            if isinstance(message, dict) and message["op"] == "types":
                break
        self.assertIn("x:double {m}", message["types"]["RobotPose"]["layout"])
        page.send(op="look", id=5, port=POSE)
        looking = page.answer(5)
        self.assertEqual((looking["op"], looking["type"]), ("looking", "RobotPose"))
        found = self.objects(page, 5, 20)
        times = [head[0] for head, _ in found]
        self.assertEqual(times, sorted(times))
        self.assertTrue(all(abs(t - time.time()) < 10 for t in times))
        self.assertEqual(len({payload for _, payload in found}), 20)

    def test_a_page_sees_the_simulated_world_and_changes_it(self):
        page = self.page()
        page.send(op="look", id=7, port="world.ScenePush")
        self.assertEqual(page.answer(7)["type"], "WorldScene")
        crate = '<WorldChange kind="PUT_OBSTACLE" name="crate" x="14" y="2" length="0.5" width="0.5"/>'
        page.send(op="send", id=8, port="world.ChangeSend", xml=crate)
        self.assertTrue(page.answer(8)["ok"])
        self.assertIn(b"crate\0", self.objects(page, 7, 5)[-1][1])
        page.send(op="send", id=9, port="world.ChangeSend", xml=crate)
        self.assertIn("there is a 'crate' already", page.answer(9)["error"])

    def test_a_rate_thins_out(self):
        page = self.page()
        page.send(op="look", id=6, port=POSE, rate=5)
        page.answer(6)
        begin = time.monotonic()
        found = self.objects(page, 6, 11)
        self.assertGreater(time.monotonic() - begin, 1.5)
        self.assertGreater(found[-1][0][3], 0, "none was left out")

    def test_an_object_is_sent_and_a_question_answered(self):
        page = self.page()
        page.send(op="query", id=7, port="base.RobotQuery", xml="<Ask/>")
        reply = page.receive()
        while not isinstance(reply, bytes):
            reply = page.receive()
        self.assertEqual((reply[0], struct.unpack_from("<I", reply, 4)[0]), (2, 7))
        self.assertEqual(page.answer(7)["type"], "Robot")
        page.send(op="send", id=8, port="goto.CancelSend", xml="<GoalFailed/>")
        self.assertTrue(page.answer(8)["ok"])
        page.send(op="send", id=9, port="goto.CancelSend", xml="<GoalFail/>")
        self.assertIn("a <GoalFailed> is expected here", page.answer(9)["error"])
        page.send(op="look", id=10, port="base.Nothing")
        self.assertEqual(page.answer(10)["op"], "refused")

    def test_the_log_is_followed(self):
        page = self.page()
        page.send(op="ask", id=11, command="log", stream=True)
        self.assertEqual(self.orcactl("estop").returncode, 0)
        while True:
            message = page.receive()
            if isinstance(message, dict) and message["op"] == "record" and "ESTOP" in message["record"]["text"]:
                break
        self.assertEqual(self.orcactl("estop", "--release").returncode, 0)

    # ---- who may

    def test_only_the_token_opens_the_door(self):
        for token in ("", "0" * 32, self.tokens["change"][:-1], self.tokens["change"] + "0"):
            with WebSocket(self.port, token) as page:
                self.assertIn("403", page.status)

    def test_pages_of_other_servers_stay_outside(self):
        for fields in ({"Origin": "http://evil.org"}, {"Origin": "null"}, {"Host": "evil.org"},
                       {"Host": f"evil.org:{self.port}", "Origin": f"http://evil.org:{self.port}"}):
            with WebSocket(self.port, self.tokens["change"], **fields) as page:
                self.assertIn("403", page.status, fields)
        with WebSocket(self.port, self.tokens["change"], Origin=f"http://127.0.0.1:{self.port}") as page:
            self.assertIn("101", page.status)

    def test_each_role_may_what_it_may_on_the_machine(self):
        ranks = tuple(reversed(ROLES))
        for role in ranks:
            for needed, orders in ORDERS.items():
                page = self.page(self.tokens[role])
                page.send(op="ask", id=1, command="roles", words=orders)
                self.assertEqual({row["order"]: row["role"] for row in page.answer(1)["records"]}, dict.fromkeys(orders, needed))
                may = ranks.index(role) >= ranks.index(needed)
                for number, order in enumerate(orders, 2):
                    command, *words = order.split()
                    if order == "line goto.Nothing" or (may and order == "stop"):
                        continue  # see below; and others need the system
                    graph = {"graph": "<graph/>"} if order in ("apply", "diff") else {}
                    page.send(op="ask", id=number, command=command, words=words, **graph)
                    error = page.answer(number)["error"]
                    (self.assertNotIn if may else self.assertIn)(TELLS.format(needed, role), error, order)

    def test_who_may_only_observe_sends_nothing_and_asks_only_what_carries_no_order(self):
        sent = (("send", "goto.CancelSend", "<GoalFailed/>"), ("query", "goto.CancelSend", "<GoalFailed/>"), ("query", "command.TripQuery", "<TripOrder/>"),
                ("query", "command.TripQuery", "<!-- --><TripOrder/>"), ("send", "world.ChangeSend", '<WorldChange kind="TAKE_OBSTACLE" name="nothing"/>'))
        with self.page(self.tokens["observe"]) as onlooker, self.page(self.tokens["operate"]) as operator:
            for number, (op, port, xml) in enumerate(sent, 1):
                operator.send(op=op, id=number, port=port, xml=xml)  # first, so that there is a line to the port
                self.assertNotIn("takes the role", operator.answer(number)["error"])
                onlooker.send(op=op, id=number, port=port, xml=xml)
                self.assertIn(TELLS.format("operate", "observe"), onlooker.answer(number)["error"], (op, port, xml))
            onlooker.send(op="query", id=10, port="base.RobotQuery", xml="<Ask/>")
            self.assertEqual(onlooker.answer(10)["type"], "Robot")
            for number, op in enumerate(("query", "send"), 11):
                onlooker.send(op=op, id=number, port="goto.CancelSend", xml="<Ask/>")
                self.assertIn("answers no questions", onlooker.answer(number)["error"])

    def test_the_audit_log_says_that_an_order_came_by_the_page_and_with_which_role(self):
        page = self.page(self.tokens["operate"])
        for number, words in enumerate((["estop"], ["estop", "--release"], ["restart", "nobody"]), 1):
            page.send(op="ask", id=number, command=words[0], words=words[1:])
            page.answer(number)
        page.send(op="send", id=9, port="world.ChangeSend", xml='<WorldChange kind="TAKE_OBSTACLE" name="nothing"/>')
        self.assertIn("there is no obstacle", page.answer(9)["error"])
        log = self.orcactl("log", "audit").stdout
        for order in ("estop: done", "estop '?--release'?: done", "restart '?nobody'?: not done: .*role change", "talk to '?world.ChangeSend'?: done"):
            self.assertRegex(log, rf"orcaview\[{self.view.pid}\], by page as operate, at [^ ]*Z: {order}")

    def test_whoever_keeps_asking_for_what_is_refused_is_held_up_and_nobody_else(self):
        greedy, other = self.page(self.tokens["observe"]), self.page()
        for number in range(1, 501):
            greedy.send(op="send", id=number, port="goto.CancelSend", xml="<GoalFailed/>")
        begin = time.monotonic()
        other.send(op="ask", id=1, command="ps")
        self.assertTrue(other.answer(1)["ok"])
        self.assertLess(time.monotonic() - begin, 3.0)
        self.assertFalse(greedy.answer(500)["ok"])

    def test_a_layout_is_kept_beside_the_graph_by_operators_only(self):
        file = self.graph.with_suffix(".layout.json")
        with self.page(self.tokens["observe"]) as onlooker, self.page(self.tokens["operate"]) as operator:
            onlooker.send(op="layout", id=1, layout='{"goto":[1,2]}')
            self.assertIn(TELLS.format("operate", "observe"), onlooker.answer(1)["error"])
            self.assertFalse(file.exists())
            operator.send(op="layout", id=2, layout='{"goto":[1,2]}')
            self.assertEqual(operator.answer(2)["file"], str(file))
            onlooker.send(op="layout", id=3)
            self.assertEqual(json.loads(onlooker.answer(3)["text"]), {"goto": [1, 2]})
            operator.send(op="layout", id=4, layout='{"goto":"x"}')
            self.assertIn("two numbers", operator.answer(4)["error"])
            operator.send(op="layout", id=5, layout="{}")
            self.assertTrue(operator.answer(5)["ok"])
        self.assertFalse(file.exists())

    def test_the_addresses_are_in_a_file_of_the_user_alone(self):
        path = self.folder / "orca" / f"{self.NAME}.{self.port}.view"
        self.assertEqual(stat.S_IMODE(path.stat().st_mode), 0o600)
        self.assertEqual(path.read_text().split(), self.addresses)

    def test_files_are_served_with_a_policy_and_nothing_else_is(self):
        own = f"Host: 127.0.0.1:{self.port}"
        page = self.fetch("GET / HTTP/1.1", own)
        self.assertTrue(page.startswith("HTTP/1.1 200"), page)
        self.assertIn("default-src 'self'", page)
        self.assertNotIn("Set-Cookie", page)
        for target in ("/../CMakeLists.txt", "/nobody.js", "/lib/../index.html", "//etc/passwd"):
            self.assertTrue(self.fetch(f"GET {target} HTTP/1.1", own).startswith("HTTP/1.1 404"), target)
        self.assertTrue(self.fetch("POST / HTTP/1.1", own, "Content-Length: 0").startswith("HTTP/1.1 403"))
        self.assertTrue(self.fetch("GET / HTTP/1.1", "Host: evil.org").startswith("HTTP/1.1 403"))

    # ---- whatever clients do

    def test_nonsense_is_answered(self):
        page = self.page()
        for text in (b"", b"nonsense", b"[1]", b"{}", b'{"op":1}', b'{"op":"ask","id":-1}', b"[" * 100_000, bytes([0x80] * 5)):
            page.send_frame(TEXT, text)
            try:
                self.assertFalse(page.receive()["ok"])
            except EOFError:  # text that is no UTF-8 ends the connection, as RFC 6455 wants
                page = self.page()

    def test_a_page_that_asks_without_end_silences_nobody(self):
        greedy, other = self.page(self.tokens["observe"]), self.page()
        for number in range(1, 301):
            greedy.send(op="ask", id=number, command="ps")
        answers = {}
        while len(answers) < 300:
            message = greedy.receive()
            answers[message["id"]] = message
        self.assertTrue(answers[1]["ok"])
        self.assertIn("too many questions", answers[300]["error"])
        other.send(op="ask", id=1, command="estop")
        self.assertTrue(other.answer(1)["ok"])
        other.send(op="ask", id=2, command="estop", words=["--release"])
        self.assertTrue(other.answer(2)["ok"])
        other.send(op="ask", id=3, command="ps", words=["x" * 300_000])
        self.assertIn("too long", other.answer(3)["error"])

    def test_a_graph_goes_with_apply_and_diff_only(self):
        page = self.page()
        page.send(op="ask", id=1, command="ps", graph="<graph/>")
        self.assertIn("apply and diff only", page.answer(1)["error"])
        page.send(op="ask", id=2, command="diff", graph="<graph/>")
        self.assertFalse(page.answer(2)["ok"])
        self.assertEqual(list((self.folder / "orca").glob("*.view.xml")), [])

    def test_few_descriptors_end_nothing(self):
        limited = ["bash", "-c", 'ulimit -n 24; exec "$0" "$@"', BUILD / "bin" / "orcaview", self.NAME, "--port", "0"]
        other = subprocess.Popen(limited, env=self.environment, stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end, other)
        port = int(re.search(r":(\d+)/", other.stdout.readline())[1])
        token = other.stdout.readline().split("token=")[1].strip()
        page = WebSocket(port, token)
        self.addCleanup(page.socket.close)
        page.send(op="ask", id=1, command="ports")
        for number, row in enumerate(json.loads(page.answer(1)["text"]), 2):
            page.send(op="look", id=number, port=row["port"])
        crowd = [socket.create_connection(("127.0.0.1", port)) for _ in range(30)]
        time.sleep(0.5)
        for one in crowd:
            one.close()
        numbers = iter(range(1000, 2000))

        def answers():
            number = next(numbers)
            page.send(op="ask", id=number, command="ps")
            return page.answer(number)["ok"]

        await_that(answers, "the system is asked again")  # its connection may have been among what was lost

    def test_a_message_without_end_is_cut_off(self):
        page = self.page()
        page.socket.sendall(bytes([0x81, 0xFF]) + struct.pack(">Q", 1 << 30) + bytes(4))
        with self.assertRaises((EOFError, ConnectionError)):
            for _ in range(100):
                page.socket.sendall(b"x" * 100_000)
                time.sleep(0.01)
            page.receive()
        self.assertLess(self.memory(), 200_000)

    def test_heads_without_end_and_slow_ones_are_cut_off(self):
        with socket.create_connection(("127.0.0.1", self.port), timeout=10) as connection:
            with self.assertRaises((ConnectionError, AssertionError)):
                connection.sendall(b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 10_000)
                answer = connection.recv(1000)
                self.assertNotEqual(answer, b"")
        slow = [socket.create_connection(("127.0.0.1", self.port), timeout=30) for _ in range(20)]
        for one in slow:
            self.addCleanup(one.close)
        end = time.monotonic() + 25
        open_ones = list(slow)
        while open_ones and time.monotonic() < end:
            for one in list(open_ones):
                try:
                    one.sendall(b"G")
                    one.settimeout(0.01)
                    if one.recv(100) == b"":
                        open_ones.remove(one)
                except TimeoutError:
                    pass
                except OSError:
                    open_ones.remove(one)
            time.sleep(0.2)
        self.assertEqual(open_ones, [])

    def test_fifty_pages_that_stall_cost_bounded_memory_and_no_page_that_reads(self):
        stalled = [self.page() for _ in range(50)]
        for page in stalled:
            for number, port in enumerate((POSE, "base.OdometryPush", "base.SonarRangeReadingsPush", "avoid.motion"), 1):
                page.send(op="look", id=number, port=port)
        good = self.page()
        good.send(op="look", id=1, port=POSE)
        good.answer(1)
        before = self.memory()
        self.objects(good, 1, 100, limit=20)
        self.assertLess(self.memory() - before, 100_000)
        self.assertEqual(self.orcactl("ps").returncode, 0)

    def test_a_system_that_ends_is_missed_and_welcomed_back(self):
        page = self.page()
        page.send(op="look", id=1, port=POSE)
        page.answer(1)
        self.end(type(self).system)
        said = []
        while "system" not in said:
            message = page.receive()
            if isinstance(message, dict):
                said.append(message["op"])
        self.assertIn("lost", said)
        page.send(op="ask", id=2, command="ps")
        self.assertIn("does not run", page.answer(2)["error"])
        type(self).system = self.start_system()
        while True:
            message = page.receive()
            if isinstance(message, dict) and message["op"] == "hello":
                break
        page.send(op="look", id=3, port=POSE)
        self.assertEqual(page.answer(3)["op"], "looking")

    def test_it_ends_well_while_pages_are_open(self):
        other = subprocess.Popen([BUILD / "bin" / "orcaview", self.NAME], env=self.environment, stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end, other)
        port = int(re.search(r":(\d+)/", other.stdout.readline())[1])
        token = other.stdout.readline().split("token=")[1].strip()
        pages = [WebSocket(port, token) for _ in range(5)]
        for page in pages:
            self.addCleanup(page.socket.close)
            page.send(op="look", id=1, port=POSE)
            page.answer(1)
        with socket.create_connection(("127.0.0.1", port)):
            other.send_signal(signal.SIGTERM)
            self.assertEqual(other.wait(10), 0)

    def test_the_death_of_the_page_is_nobodys_loss(self):
        other = subprocess.Popen([BUILD / "bin" / "orcaview", self.NAME], env=self.environment, stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end, other)
        port = int(re.search(r":(\d+)/", other.stdout.readline())[1])
        token = other.stdout.readline().split("token=")[1].strip()
        with WebSocket(port, token) as page:
            page.receive()
            page.send(op="look", id=1, port=POSE)
            page.answer(1)
            other.kill()
            other.wait(10)
        states = self.orcactl("ps").stdout
        self.assertGreaterEqual(states.count(" WORK "), 6, states)


class Deployer(unittest.TestCase):
    def test_view_starts_a_page_that_ends_with_the_system(self):
        with tempfile.TemporaryDirectory(prefix="orca_view_") as folder:
            os.chmod(folder, 0o700)
            system = subprocess.Popen([BUILD / "bin" / "deployer", GRAPH, "--view", "--log", "error", "--no-progress"],
                                      env=os.environ | {"XDG_RUNTIME_DIR": folder}, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.PIPE, text=True)
            self.addCleanup(system.kill)
            line = system.stderr.readline()
            self.assertRegex(line, r"^look at it in a browser: http://127.0.0.1:\d+/#token=[0-9a-f]{32}$")
            port, token = int(re.search(r":(\d+)/", line)[1]), line.split("token=")[1].strip()
            with WebSocket(port, token) as page:
                hello = page.receive()
                while not hello.get("present"):
                    hello = page.receive()
                self.assertEqual(hello["role"], "change")
            system.send_signal(signal.SIGTERM)
            self.assertEqual(system.wait(30), 0)
            system.stderr.close()
            with self.assertRaises(ConnectionRefusedError):
                socket.create_connection(("127.0.0.1", port))


if __name__ == "__main__":
    sys.argv.pop()
    unittest.main()
