# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a recording with the readers of others, decodes every message, and prints how many there are. Exit 77: no readers."""
import sys
from pathlib import Path

try:
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory
    from rosbags.highlevel import AnyReader
except ImportError as missing:
    print(f"{missing}; install the Python packages mcap, mcap-ros2-support and rosbags")
    sys.exit(77)

path = Path(sys.argv[1])
with path.open("rb") as file:
    reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
    by_mcap = [(channel.topic, message.log_time) for _, channel, message, _ in reader.iter_decoded_messages()]
    attachments = sorted(Path(a.name).name for a in reader.iter_attachments())
with AnyReader([path]) as reader:
    by_rosbags = []
    for connection, time, raw in reader.messages():
        reader.deserialize(raw, connection.msgtype)
        by_rosbags.append((connection.topic, time))
assert sorted(by_mcap) == sorted(by_rosbags), "the two readers do not agree"
print(len(by_mcap), *attachments)
