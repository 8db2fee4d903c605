#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page at an address for other machines, in a browser that trusts the certificate: the robot is seen, and stopped.

    tests/system/view/tls_page_test.py [-k PART_OF_A_CASE'S_NAME] [--pictures FOLDER] BUILD_FOLDER
"""
import time

import page_case
from page_case import PageCase, wait_for
from view_case import ROLES


class FarPage(PageCase):
    VIEW_OPTIONS = ("--listen", "127.0.0.2:0")
    ADDRESS = len(ROLES)
    SWITCHES = ("--ignore-certificate-errors",)

    def test_the_robot_is_seen_and_stopped(self):
        self.assertTrue(self.browser.current_url.startswith("https://127.0.0.2:"), self.browser.current_url)
        wait_for("the robot drives", self.drives)
        before = self.place()
        wait_for("the robot is seen at another place", lambda: self.distance(before) > 0.3)
        self.click("#stop")
        wait_for("the page says so", lambda: "All motors are held" in self.text("body"))
        time.sleep(1.0)  # the robot brakes
        stood = self.pose()
        time.sleep(1.0)
        self.assertEqual(self.pose(), stood)


if __name__ == "__main__":
    page_case.main()
