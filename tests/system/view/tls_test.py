#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""orcaview at an address for other machines: TLS, by which names it is called, and that strangers shut nobody out.

    tests/system/view/tls_test.py BUILD_FOLDER
"""
import hashlib
import pathlib
import re
import signal
import socket
import ssl
import stat
import subprocess
import sys
import time
import unittest
import warnings

from view_case import BUILD, ROLES, ViewCase
from websocket import WebSocket

FAR = "127.0.0.2"  # another address than the plain door's, which is called 127.0.0.1
PORTS = ("localizer.RobotPosePush", "base.OdometryPush", "base.SonarRangeReadingsPush", "avoid.motion")


class Tls(ViewCase):
    VIEW_OPTIONS = ("--listen", f"{FAR}:0")

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.far_addresses = cls.addresses[len(ROLES):]
        cls.fingerprint = cls.view.stdout.readline().strip().removeprefix("SHA-256 of the certificate: ")
        cls.far_port = int(re.search(r":(\d+)/", cls.far_addresses[0])[1])
        cls.certificate = cls.folder / "config" / "orca" / "orcaview" / "certificate.pem"
        cls.tls = ssl.create_default_context(cafile=str(cls.certificate))

    def page(self, token=None, **fields):
        page = WebSocket(self.far_port, token or self.tokens["change"], address=FAR, tls=self.tls, **fields)
        self.addCleanup(page.socket.close)
        return page

    def greeted(self, token=None):
        page = self.page(token)
        self.assertEqual(page.status.split()[1], "101", page.status)
        self.assertEqual(page.receive()["op"], "hello")
        return page

    def fetch(self, *lines):
        with socket.create_connection((FAR, self.far_port), timeout=10) as plain:
            with self.tls.wrap_socket(plain, server_hostname=FAR) as connection:
                connection.sendall("\r\n".join([*lines, "", ""]).encode())
                return connection.recv(1 << 16).decode()

    def memory(self):
        """Returns the resident memory of orcaview [kB]."""
        return int(re.search(r"VmRSS:\s+(\d+)", pathlib.Path(f"/proc/{self.view.pid}/status").read_text())[1])

    def another(self, *options):
        """Starts one more orcaview and returns its exit status and its error."""
        done = subprocess.run([BUILD / "bin" / "orcaview", self.NAME, "--port", "0", *options], env=self.environment,
                              capture_output=True, text=True, timeout=20)
        return done.returncode, done.stderr

    # ---- what it shows

    def test_pages_and_addresses_are_those_of_the_certificate(self):
        for far, near in zip(self.far_addresses, self.addresses):
            self.assertRegex(far, rf"^https://{re.escape(FAR)}:\d+/#token=[0-9a-f]{{32}}$")
            self.assertEqual(far.split("#")[1], near.split("#")[1])
        self.assertTrue(self.fetch("GET / HTTP/1.1", f"Host: {FAR}:{self.far_port}").startswith("HTTP/1.1 200"))
        der = ssl.get_server_certificate((FAR, self.far_port))
        found = hashlib.sha256(ssl.PEM_cert_to_DER_cert(der)).hexdigest().upper()
        self.assertEqual(self.fingerprint.replace(":", ""), found)
        self.assertEqual(stat.S_IMODE(self.certificate.stat().st_mode), 0o600)
        file = (self.folder / "orca" / f"{self.NAME}.{self.port}.view").read_text()
        for address in self.addresses:
            self.assertIn(address + "\n", file)

    def test_a_page_sees_objects_and_stops_the_robot(self):
        page = self.greeted()
        page.send(op="look", id=1, port=PORTS[0])
        self.assertEqual(page.answer(1)["type"], "RobotPose")
        seen = 0
        while seen < 20:
            seen += isinstance(page.receive(), bytes)
        onlooker = self.greeted(self.tokens["observe"])
        onlooker.send(op="ask", id=1, command="log", stream=True)
        page.send(op="ask", id=2, command="estop")
        self.assertTrue(page.answer(2)["ok"])
        while True:
            message = onlooker.receive()
            if isinstance(message, dict) and message["op"] == "record" and "ESTOP" in message["record"]["text"]:
                break
        page.send(op="ask", id=3, command="estop", words=["--release"])
        self.assertTrue(page.answer(3)["ok"])

    # ---- who may

    def test_tokens_have_their_roles(self):
        onlooker = self.greeted(self.tokens["observe"])
        onlooker.send(op="ask", id=1, command="estop")
        self.assertIn("takes the role operate, and this address has observe", onlooker.answer(1)["error"])
        for token in ("", "0" * 32, self.tokens["change"][:-1]):
            self.assertIn("403", self.page(token or "x").status)

    def test_each_door_knows_its_own_names_and_origins_only(self):
        for fields in ({"Host": f"127.0.0.1:{self.far_port}"}, {"Host": f"localhost:{self.far_port}"}, {"Host": "evil.org"},
                       {"Origin": f"http://{FAR}:{self.far_port}"}, {"Origin": f"https://{FAR}"}, {"Origin": "https://evil.org"},
                       {"Origin": f"http://127.0.0.1:{self.port}"}, {"Origin": "null"},
                       {"Host": f"127.0.0.1:{self.port}", "Origin": f"http://127.0.0.1:{self.port}"}):
            self.assertIn("403", self.page(**fields).status, fields)
        self.assertIn("101", self.page(Origin=f"https://{FAR}:{self.far_port}").status)
        for fields in ({"Host": f"{FAR}:{self.port}"}, {"Origin": f"https://127.0.0.1:{self.port}"},
                       {"Host": f"{FAR}:{self.far_port}", "Origin": f"https://{FAR}:{self.far_port}"}):
            with WebSocket(self.port, self.tokens["change"], **fields) as page:
                self.assertIn("403", page.status, fields)

    def test_plain_requests_and_old_tls_get_nothing(self):
        with socket.create_connection((FAR, self.far_port), timeout=10) as plain:
            plain.sendall(f"GET / HTTP/1.1\r\nHost: {FAR}:{self.far_port}\r\n\r\n".encode())
            answer = b"".join(iter(lambda: plain.recv(1000), b""))
        self.assertNotIn(b"HTTP", answer)
        with socket.create_connection(("127.0.0.1", self.port), timeout=10) as plain:
            with self.assertRaises((ssl.SSLError, ConnectionError)):
                self.tls.wrap_socket(plain, server_hostname="127.0.0.1")
        for version in (ssl.TLSVersion.TLSv1, ssl.TLSVersion.TLSv1_1, ssl.TLSVersion.TLSv1_2, ssl.TLSVersion.TLSv1_3):
            client = ssl.create_default_context(cafile=str(self.certificate))
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", DeprecationWarning)
                client.minimum_version = client.maximum_version = version
            client.set_ciphers("ALL:@SECLEVEL=0")
            with socket.create_connection((FAR, self.far_port), timeout=10) as plain:
                if version < ssl.TLSVersion.TLSv1_2:
                    with self.assertRaisesRegex(ssl.SSLError, "ALERT_PROTOCOL_VERSION"):
                        client.wrap_socket(plain, server_hostname=FAR)
                else:
                    with client.wrap_socket(plain, server_hostname=FAR) as secured:
                        self.assertEqual(secured.version(), version.name.replace("_", "."))
                        self.assertRegex(secured.cipher()[0], "GCM|CHACHA20")

    # ---- whatever clients do

    def test_strangers_who_say_nothing_shut_nobody_out(self):
        before = self.memory()
        silent = []
        for _ in range(200):
            silent.append(socket.create_connection((FAR, self.far_port), timeout=10))
            self.addCleanup(silent[-1].close)
        for one in silent[150:]:
            one.sendall(b"\x16\x03\x01\x02\x00\x01")  # a hello that is never finished
        begin = time.monotonic()
        self.greeted()
        with WebSocket(self.port, self.tokens["change"]) as near:
            self.assertIn("101", near.status)
        self.assertLess(time.monotonic() - begin, 5.0)  # silent ones have 10 s
        self.assertLess(self.memory() - before, 50_000)
        for one in silent[:100]:  # the oldest were closed at once
            one.settimeout(1.0)
            self.assertEqual(one.recv(100), b"")
        for one in silent[150:]:  # and the others are, when they have had their time
            one.settimeout(20.0)
            self.assertEqual(one.recv(100), b"")

    def test_broken_records_end_their_connection_only(self):
        good = self.greeted()
        for rubbish in (bytes(1000), b"\xff" * 100_000, b"\x16\x03\x01\xff\xff" + bytes(70_000)):
            with socket.create_connection((FAR, self.far_port), timeout=20) as plain:
                try:
                    plain.sendall(rubbish)
                    while plain.recv(1000):
                        pass
                except ConnectionError:
                    pass
        broken = self.greeted()
        raw = socket.socket(fileno=broken.socket.detach())
        with raw:  # within an agreed connection
            raw.sendall(b"\x17\x03\x03\x00\x20" + bytes(32))
            raw.settimeout(10)
            try:
                while raw.recv(1 << 16):
                    pass
            except ConnectionError:
                pass
        good.send(op="ask", id=1, command="ps")
        self.assertTrue(good.answer(1)["ok"])

    def test_pages_that_stall_cost_bounded_memory_and_no_page_that_reads(self):
        stalled = [self.greeted() for _ in range(30)]
        for page in stalled:
            for number, port in enumerate(PORTS, 1):
                page.send(op="look", id=number, port=port)
        good = self.greeted()
        good.send(op="look", id=1, port=PORTS[0])
        good.answer(1)
        before, seen, end = self.memory(), 0, time.monotonic() + 20
        while seen < 100:
            self.assertLess(time.monotonic(), end, "objects came too slowly")
            seen += isinstance(good.receive(), bytes)
        self.assertLess(self.memory() - before, 100_000)

    # ---- its certificate

    def test_the_certificate_stays_the_same_and_pages_end_with_orcaview(self):
        other = subprocess.Popen([BUILD / "bin" / "orcaview", self.NAME, "--port", "0", *self.VIEW_OPTIONS], env=self.environment,
                                 stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end, other)
        lines = [other.stdout.readline().strip() for _ in range(2 * len(ROLES) + 1)]
        self.assertTrue(lines[-1].endswith(self.fingerprint), lines)
        far = lines[len(ROLES)]
        port, token = int(re.search(r":(\d+)/", far)[1]), far.split("token=")[1]
        with WebSocket(port, token, address=FAR, tls=self.tls) as page, socket.create_connection((FAR, port)):
            page.receive()
            other.send_signal(signal.SIGTERM)
            self.assertEqual(other.wait(10), 0)

    def test_what_is_wrong_with_an_address_or_a_certificate_is_said(self):
        given = self.folder / "given"
        given.mkdir()
        open_file = given / "certificate.pem"
        open_file.write_text(self.certificate.read_text())
        open_file.chmod(0o644)
        with socket.create_server((FAR, 0)) as taken:
            port = taken.getsockname()[1]
            for options, status, words in (
                    (("--listen", "robot"), 2, "needs an address"), (("--listen", f"{FAR}:70000"), 2, "needs an address"),
                    (("--tls", str(given)), 2, "--listen"), (("--listen", f"{FAR}:{port}"), 1, "in use"),
                    (("--listen", "192.0.2.1:0"), 1, "cannot listen at 192.0.2.1"),
                    (("--listen", FAR, "--tls", str(given)), 1, "chmod 0600"),
                    (("--listen", FAR, "--tls", "/nowhere"), 1, "No such file")):
                found, error = self.another(*options)
                self.assertEqual(found, status, (options, error))
                self.assertIn(words, error)
        open_file.chmod(0o600)
        other = subprocess.Popen([BUILD / "bin" / "orcaview", self.NAME, "--port", "0", *self.VIEW_OPTIONS, "--tls", given],
                                 env=self.environment, stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end, other)
        self.assertIn(self.fingerprint, [other.stdout.readline() for _ in range(2 * len(ROLES) + 1)][-1])


if __name__ == "__main__":
    sys.argv.pop()
    unittest.main()
