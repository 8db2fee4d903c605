#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What docs/first_driver.md says, done as it says it, and that the tests which it promises find the faults of a driver.

    tests/system/first_driver_test.py BUILD
"""
import csv
import math
import shutil
import tempfile
import unittest

from page_reader import Reader


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="orca_first_driver_")
        self.addCleanup(shutil.rmtree, self.folder)

    def test_first_driver(self):
        reader = Reader("docs/first_driver.md", self.folder)
        reader.follow()
        self.assertIn("my.Owl", reader.out)
        self.assertIn("100% tests passed, 0 tests failed out of 1", reader.out)
        with open(reader.folder / "owl/scans.csv", newline="", encoding="utf-8") as table:
            scans = list(csv.DictReader(table))
        self.assertGreater(len(scans), 10)
        self.assertAlmostEqual(float(scans[-1]["ranges[30]"]), 2.0, places=3)  # the wall ahead
        self.assertEqual(float(scans[-1]["ranges[0]"]), math.inf)
        self.assert_finds_faults(reader)

    def assert_finds_faults(self, reader):
        """A driver that never gives up on a silent device, and takes frames with a wrong checksum, does not pass."""
        source = reader.folder / "owl/owl.cpp"
        text = source.read_text()
        self.assertIn("return state() == orca::hw::HardwareState::active ? Duration(1s) : Duration::max();", text)
        source.write_text(text.replace("return state() == orca::hw::HardwareState::active ? Duration(1s) : Duration::max();", "return Duration::max();"))
        reader.out = ""
        with self.assertRaisesRegex(AssertionError, "silent: .* readings in 5 s; nobody said that the device is silent"):
            reader.run("cmake --build build\nctest --test-dir build --verbose\n")


if __name__ == "__main__":
    unittest.main()
