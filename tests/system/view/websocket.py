# SPDX-License-Identifier: GPL-3.0-or-later
"""A WebSocket client that can also misbehave, for tests of orcaview. Python's own library has none."""
import base64
import json
import os
import socket
import struct

TEXT, PONG, PING = 1, 10, 9


class WebSocket:
    """A connection; `head` is the answer, `status` its first line. Header fields are replaced by those given. With a context of TLS
    it is encrypted."""

    def __init__(self, port, token, limit=10.0, address="127.0.0.1", tls=None, **fields):
        self.socket = socket.create_connection((address, port))
        self.socket.settimeout(limit)
        if tls:
            self.socket = tls.wrap_socket(self.socket, server_hostname=address)
        head = {
            "Host": f"{address}:{port}",
            "Upgrade": "websocket",
            "Connection": "Upgrade",
            "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(),
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Protocol": "orca.view.v1",
        } | fields
        lines = [f"GET /ws?token={token} HTTP/1.1", *(f"{name}: {value}" for name, value in head.items()), "", ""]
        self.socket.sendall("\r\n".join(lines).encode())
        self.rest = b""
        while b"\r\n\r\n" not in self.rest:
            self._fill()
        answer, self.rest = self.rest.split(b"\r\n\r\n", 1)
        self.head = answer.decode()
        self.status = self.head.splitlines()[0]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def _fill(self):
        more = self.socket.recv(1 << 16)
        if not more:
            raise EOFError
        self.rest += more

    def _take(self, count):
        while len(self.rest) < count:
            self._fill()
        taken, self.rest = self.rest[:count], self.rest[count:]
        return taken

    def receive(self):
        """Returns the next message: a dict for a text, bytes for an object. EOFError at the end."""
        while True:
            first, second = self._take(2)
            size = second & 127
            if size == 126:
                size = struct.unpack(">H", self._take(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self._take(8))[0]
            payload = self._take(size)
            if first & 15 == PING:
                self.send_frame(PONG, payload)
            elif first & 15 == TEXT:
                return json.loads(payload)
            elif first & 15 == 2:
                return payload
            else:
                raise EOFError

    def send_frame(self, opcode, payload):
        size = len(payload)
        length = (bytes([0x80 | size]) if size < 126 else
                  bytes([0xFE]) + struct.pack(">H", size) if size < 1 << 16 else
                  bytes([0xFF]) + struct.pack(">Q", size))
        self.socket.sendall(bytes([0x80 | opcode]) + length + bytes(4) + payload)

    def send(self, **message):
        self.send_frame(TEXT, json.dumps(message).encode())

    def answer(self, number):
        """Returns the answer to a message, and drops what comes before."""
        while True:
            message = self.receive()
            if isinstance(message, dict) and message.get("id") == number and message["op"] not in ("record",):
                return message
