#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The doors of a simulated world in the page: a person opens and shuts them, by mouse and by keyboard.

    tests/system/view/doors_test.py [-k PART_OF_A_CASE'S_NAME] [--pictures FOLDER] BUILD_FOLDER
"""
import math
import re
import time

from page_case import PageCase, main, wait_for
from selenium.webdriver.common.keys import Keys
from view_case import TREE

WORLD = TREE / "sim" / "worlds" / "office_doors.xml"
SHUT = "office_2_door"  # at first
SHUT_LEAF = (9.0, 5.0)  # [m] its middle
OPEN_LEAF = (8.525, 4.5)  # [m] when it is open: it swings by -90 degrees
OTHER = "library_door"  # open at first


class Doors(PageCase):
    OPTIONS = ("--set", "command.rounds=0", "--set", f"world={WORLD}")

    def is_open(self, door):
        """Returns whether a door is open, or on its way to be, as the simulator knows it."""
        line = self.orcactl("echo", "world.ScenePush", "--count", "1", "--for", "10s").stdout
        begin = line.index(f'<doors name="{door}"')
        return 'open="true"' in line[begin:line.index(">", begin)]

    def wait_for_leaf(self, door, place):
        """Waits until a leaf has swung to a place, and the page has a scene of that."""
        def is_there():
            scene = self.orcactl("echo", "world.ScenePush", "--count", "1", "--for", "10s").stdout
            x, y = re.search(rf'<obstacles name="{door}" x="([^"]*)" y="([^"]*)"', scene).groups()
            return math.dist(place, (float(x), float(y))) < 0.05

        wait_for(f"the leaf at {place}", is_there)
        time.sleep(1.5)  # scenes come once a second

    def box(self, door):
        return self.part(f'#door-list input[value="{door}"]')

    def test_doors_open_and_shut_by_mouse_and_by_keyboard(self):
        self.click("#tab-world")
        wait_for("the doors", lambda: len(self.browser.find_elements("css selector", "#door-list input")) == 7)
        self.assertEqual((self.is_open(SHUT), self.is_open(OTHER)), (False, True))
        self.assertEqual((self.box(SHUT).is_selected(), self.box(OTHER).is_selected()), (False, True))

        self.click("#tool-change")
        self.click("#fit")
        self.mouse(self.pixel(SHUT_LEAF))
        wait_for("the leaf opens", lambda: f"{SHUT} opens" in self.text("#notices"))
        wait_for("the page shows it open", lambda: self.box(SHUT).is_selected())
        self.assertTrue(self.is_open(SHUT))
        self.wait_for_leaf(SHUT, OPEN_LEAF)
        self.mouse(self.pixel(SHUT_LEAF))  # nothing is there any more but free floor, so a box comes
        wait_for("a box in the opening", lambda: "comes to" in self.text("#notices"))
        self.picture("doors")
        self.mouse(self.pixel(OPEN_LEAF))
        wait_for("the leaf shuts", lambda: f"{SHUT} shuts" in self.text("#notices"))
        self.assertFalse(self.is_open(SHUT))

        self.box(OTHER).send_keys(Keys.SPACE)
        wait_for("the other one shuts", lambda: f"{OTHER} shuts" in self.text("#notices"))
        self.assertFalse(self.is_open(OTHER))
        wait_for("the page shows it shut", lambda: not self.box(OTHER).is_selected())
        self.box(OTHER).send_keys(Keys.SPACE)
        wait_for("it opens again", lambda: self.is_open(OTHER) and self.box(OTHER).is_selected())

    def test_no_leaf_is_pulled_away_and_what_is_refused_is_said(self):
        self.assertIn("is only opened and shut", self.orcactl("send", "world.ChangeSend", f'<WorldChange kind="TAKE_OBSTACLE" name="{OTHER}"/>').stderr)
        self.assertIn("is open already", self.orcactl("send", "world.ChangeSend", f'<WorldChange kind="OPEN_DOOR" name="{OTHER}"/>').stderr)
        self.assertIn("there is no door", self.orcactl("send", "world.ChangeSend", '<WorldChange kind="OPEN_DOOR" name="gate"/>').stderr)


if __name__ == "__main__":
    main()
