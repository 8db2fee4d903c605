# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of the page have in common: a system, a browser that shows its page, and what a person does there.

    TEST.py [-k PART_OF_A_CASE'S_NAME] [--pictures FOLDER] BUILD_FOLDER

With a folder for pictures each case leaves one of the page there.
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

import browser as chromium
from view_case import BUILD, ViewCase

chromium.need_browser()
from selenium.common.exceptions import StaleElementReferenceException
from selenium.webdriver import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402

WORDS = sys.argv[1:-1]
PICTURES = WORDS.pop(WORDS.index("--pictures") + 1) if "--pictures" in WORDS else None
PICTURE = (1120, 700)  # [pixels]


def wait_for(what, condition, seconds=20):
    """Returns the first value of the condition that is not false; fails with `what` if there is none in time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            value = condition()
        except StaleElementReferenceException:  # the page has just drawn it anew
            value = None
        if value:
            return value
        time.sleep(0.05)
    raise AssertionError(f"{what}: not within {seconds} s")


class PageCase(ViewCase):
    """One system and one browser serve all cases of a class, in the order of their names. Each case works alone, too."""

    ADDRESS = 0  # of those that orcaview prints, the one that the browser opens
    SWITCHES = ()  # of the browser
    FRAMES = 10  # that it draws in a second at most: without a graphics card each costs 4 ms of processor time; 0: as many as it can

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        profile = tempfile.TemporaryDirectory(prefix="orca_chromium_")
        cls.addClassCleanup(profile.cleanup)
        width, height = PICTURE if PICTURES else (1280, 800)
        cls.browser = chromium.start_browser(width, height, profile.name, *cls.SWITCHES)
        cls.addClassCleanup(cls.browser.quit)
        if cls.FRAMES:
            chromium.draw_at_most(cls.browser, cls.FRAMES)
        cls.browser.get(cls.addresses[cls.ADDRESS])

    def tearDown(self):
        self.assertEqual((self.system.poll(), self.view.poll()), (None, None), "deployer and orcaview run")
        errors = [entry["message"] for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [], "the browser reports no error")

    def rows_of(self, *words):
        """Returns what orcactl prints as JSON."""
        done = self.orcactl(*words, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def follow(self, port):
        """Starts orcactl echo; its lines are objects with their text form."""
        return subprocess.Popen([BUILD / "bin" / "orcactl", "echo", port, "--json"], env=self.environment, stdout=subprocess.PIPE,
                                stderr=subprocess.DEVNULL, text=True)

    # ------------------------------------------------------------------------------------------------ what is seen

    def part(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.browser.execute_script("return document.querySelector(arguments[0])?.textContent ?? ''", selector)

    def number(self, selector):
        """Returns the number that a text begins with."""
        return float(re.match(r"[−\d.]+", self.text(selector))[0].replace("−", "-"))

    def place(self):
        """Returns where the page says that the robot is, [m]; None before it knows."""
        found = re.match(r"([−\d.]+), ([−\d.]+) m", self.text("#figure-place"))
        return None if found is None else tuple(float(number.replace("−", "-")) for number in found.groups())

    def distance(self, goal):
        return math.dist(self.place(), goal)

    def drives(self):
        return self.text("#plain").startswith("Drives")

    def pose(self):
        """Returns where the robot is, by its localizer."""
        xml = self.rows_of("query", "localizer.RobotPoseQuery", "<AskReading/>")["xml"]
        return tuple(float(re.search(rf' {axis}="([^"]+)"', xml)[1]) for axis in "xy")

    def picture(self, name, height=PICTURE[1], after=0.0):
        """Leaves a picture of the page, of so many pixels in height, after some seconds, with the newest message alone."""
        if not PICTURES:
            return
        time.sleep(after)
        self.browser.execute_script("for (const old of document.querySelectorAll('.notice:not(:last-child)')) old.remove()")
        if height != PICTURE[1]:
            self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": PICTURE[0], "height": height, "deviceScaleFactor": 1, "mobile": False})
            time.sleep(1.0)  # it draws anew
        self.browser.save_screenshot(str(pathlib.Path(PICTURES) / f"page_{name}.png"))
        if height != PICTURE[1]:
            self.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    # ------------------------------------------------------------------------------------------------ what is done

    def click(self, selector):
        def try_it():
            try:
                found = [each for each in self.browser.find_elements(By.CSS_SELECTOR, selector)
                         if each.is_displayed() and each.is_enabled()]
                if found:
                    found[0].click()
                return bool(found)
            except StaleElementReferenceException:  # the page has just drawn it anew
                return False
        wait_for(f"{selector} to click", try_it)

    def mouse(self, *steps, down=True, up=True):
        """Moves the mouse through pixels of the window: down at the first one, up at the last one."""
        chain = ActionChains(self.browser, duration=40)
        pointer = chain.w3c_actions.pointer_action
        pointer.move_to_location(*map(round, steps[0]))
        if down:
            pointer.pointer_down()
        for step in steps[1:]:
            pointer.move_to_location(*map(round, step))
        if up:
            pointer.pointer_up()
        chain.perform()

    def pixel(self, place):
        """Returns the pixel of the window that shows a place of the world."""
        x, y, scale = (float(word) for word in self.part("#map").get_attribute("data-view").split())
        box = self.part("#map").rect
        return (box["x"] + box["width"] / 2 + (place[0] - x) * scale, box["y"] + box["height"] / 2 - (place[1] - y) * scale)


def main():
    unittest.main(argv=[sys.argv[0], *(word for word in WORDS if word != "--pictures")], verbosity=2, failfast=True)
