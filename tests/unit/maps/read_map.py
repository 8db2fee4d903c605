# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a map with the readers of others, which Debian has for its own Python, and prints what they find. Exit 77: there are none."""
import pathlib
import sys

try:
    import yaml
    from PIL import Image
except ImportError as missing:
    print(f"{missing}; install the Debian packages python3-pil and python3-yaml")
    sys.exit(77)

path = pathlib.Path(sys.argv[1])
head = yaml.safe_load(path.read_text())
with Image.open(path.parent / head["image"]) as picture:
    print(picture.mode, picture.size, list(picture.getdata()), head["resolution"], head["origin"], head["negate"],
          head["occupied_thresh"], head["free_thresh"])
