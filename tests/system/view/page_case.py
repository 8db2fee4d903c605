# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of the page have in common: a system, a browser that shows its page, and what a person does there."""
import argparse
import math
import pathlib
import re
import tempfile
import unittest

import browser as chromium

chromium.need_browser()
from selenium.webdriver import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", help="folder of deployer, orcactl and orcaview")
    parser.add_argument("--pictures", help="folder that gets a picture of the page in each case")
    return parser.parse_args()


ARGUMENTS = arguments()


class PageCase(unittest.TestCase):
    """One system and one browser serve all cases of a class, in the order of their names."""

    GRAPH = "scout_goto_processes.xml"
    WORDS = ("--set", "command.rounds=0")

    @classmethod
    def setUpClass(cls):
        cls.system = chromium.System(ARGUMENTS.programs, cls.GRAPH, *cls.WORDS)
        cls.addClassCleanup(cls.system.end)
        cls.profile = tempfile.TemporaryDirectory(prefix="orca_chromium_")
        cls.addClassCleanup(cls.profile.cleanup)
        cls.browser = chromium.start_browser(profile=cls.profile.name)
        cls.addClassCleanup(cls.browser.quit)
        cls.browser.get(cls.system.address)

    def tearDown(self):
        self.assertEqual((self.system.deployer.poll(), self.system.view.poll()), (None, None), f"deployer and orcaview run\n{self.system.words()[-2000:]}")
        errors = [entry["message"] for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [], "the browser reports no error")

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
        xml = self.system.orcactl("query", "localizer.RobotPoseQuery", "<AskReading/>")["xml"]
        return tuple(float(re.search(rf' {axis}="([^"]+)"', xml)[1]) for axis in "xy")

    def picture(self, name):
        if ARGUMENTS.pictures:
            self.browser.save_screenshot(str(pathlib.Path(ARGUMENTS.pictures) / f"page_{name}.png"))

    # ------------------------------------------------------------------------------------------------ what is done

    def click(self, selector):
        def try_it():
            found = [each for each in self.browser.find_elements(By.CSS_SELECTOR, selector) if each.is_displayed() and each.is_enabled()]
            if found:
                found[0].click()
            return bool(found)
        chromium.wait_for(f"{selector} to click", try_it)

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
    unittest.main(argv=["view_test"], verbosity=2, failfast=True)
