#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a batch in a browser: how far it is, its report, and a failed run that is made again.

    tests/system/view/batch_test.py [--pictures FOLDER] BUILD_FOLDER
"""
import http.client
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import page_case
from page_case import chromium, wait_for
from view_case import BUILD, ROLES, TREE, ViewCase

EXPERIMENT = f"""<experiment name="doors" seeds="1-2" until="20 s" graph="{TREE}/graphs/pioneer_laser_goto.xml">
  <variant name="LaserAvoid"><set arg="avoid" value="orca.LaserAvoid"/></variant>
  <variant name="VfhPlus"><set arg="avoid" value="orca.VfhPlus"/></variant>
  <world name="office"/>
</experiment>"""


class Batch(unittest.TestCase):
    """Half of the runs are there at first, and the other half in the second case. None of them has the time to succeed."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="orca_batch_")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.environment = os.environ | {"XDG_RUNTIME_DIR": folder.name}
        cls.experiment = cls.folder / "doors.xml"
        cls.experiment.write_text(EXPERIMENT)
        cls.simbatch("--shard", "1/2")
        cls.view = subprocess.Popen([BUILD / "bin" / "orcaview", "--batch", cls.folder / "out", "--port", "0", "--web", TREE / "web"],
                                    env=cls.environment, stdout=subprocess.PIPE, text=True)
        cls.addClassCleanup(ViewCase.end, cls.view)
        cls.addresses = [cls.view.stdout.readline().strip() for _ in ROLES]
        cls.port = int(re.search(r":(\d+)/", cls.addresses[0])[1])
        cls.tokens = {role: address.split("token=")[1] for role, address in zip(ROLES, cls.addresses)}
        profile = tempfile.TemporaryDirectory(prefix="orca_chromium_")
        cls.addClassCleanup(profile.cleanup)
        cls.browser = chromium.start_browser(1120, 700, profile.name)
        cls.addClassCleanup(cls.browser.quit)
        cls.browser.get(cls.addresses[0])

    @classmethod
    def simbatch(cls, *words):
        done = subprocess.run([BUILD / "bin" / "simbatch", cls.experiment, "--out", cls.folder / "out", *words], env=cls.environment,
                              capture_output=True, text=True, timeout=200)
        assert done.returncode == 0, done.stderr

    def fetch(self, path, token="", method="GET", **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        connection.request(method, f"/batch/{path}{'&' if '?' in path else '?'}token={token}", headers=headers)
        response = connection.getresponse()
        body = response.read().decode()
        connection.close()
        return response, body

    def text(self, selector):
        return self.browser.execute_script("return document.querySelector(arguments[0])?.textContent ?? ''", selector)

    def part(self, selector):
        return self.browser.find_element("css selector", selector)

    def tearDown(self):
        errors = [entry["message"] for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [], "the browser reports no error")

    def test_1_the_page_shows_how_far_a_batch_is(self):
        wait_for("half of the runs", lambda: self.text("#batch-done") == "2 of 4 runs")
        self.assertEqual((self.text("#batch-name"), self.text("#link")), ("doors", "not complete"))
        self.assertIn("1 of 2", self.text("#batch-variants"))
        self.assertFalse(self.part("#batch-report").is_displayed(), "there is no report yet")

    def test_2_it_goes_on_by_itself_and_leads_to_the_report(self):
        self.simbatch("--resume")
        wait_for("all runs", lambda: self.text("#batch-done") == "4 of 4 runs")
        self.assertEqual(self.text("#link"), "complete")
        wait_for("the way to the report", lambda: self.part("#batch-report").is_displayed())
        response, report = self.fetch("report.html", self.tokens["observe"])
        self.assertEqual(report, (self.folder / "out" / "report.html").read_text())
        policy = response.getheader("Content-Security-Policy")
        self.assertTrue(policy.startswith("sandbox; default-src 'none'"), policy)
        command = self.text(".failed-run pre")
        self.assertIn(command, (self.folder / "out" / "report.md").read_text(), "it is the command of the report")

    def test_3_a_failed_run_is_made_again_before_my_eyes(self):
        wait_for("the failed runs", lambda: self.browser.find_elements("css selector", ".failed-run"))
        self.part(".failed-run summary").click()
        self.part(".failed-run[open] button").click()
        wait_for("the address of its page", lambda: self.part("#watched-page").is_displayed(), 40)
        self.assertRegex(self.text("#watched-name"), "LaserAvoid in office, seed 1")
        address = self.part("#watched-page").get_attribute("href")
        if page_case.PICTURES:
            self.browser.save_screenshot(str(pathlib.Path(page_case.PICTURES) / "page_batch.png"))
        for role in ("observe", "operate"):
            _, status = self.fetch("status", self.tokens[role])
            self.assertEqual(json.loads(status)["watched"]["address"], "", "it has the role change")
            self.assertNotIn("token=", status)
        batch = self.browser.current_window_handle
        self.browser.switch_to.new_window("tab")
        try:
            self.browser.get(address)
            wait_for("it drives", lambda: self.text("#plain").startswith("Drives"), 40)
        finally:
            self.browser.close()
            self.browser.switch_to.window(batch)
        subprocess.run([BUILD / "bin" / "orcactl", "stop"], env=self.environment, capture_output=True, timeout=30)
        wait_for("the page says that it has ended", lambda: "has ended with 0" in self.text("#watched-state"))

    def test_4_only_who_has_a_token_may_look_and_only_the_role_change_begins_runs(self):
        for path in ("status", "report.html"):
            self.assertEqual(self.fetch(path)[0].status, 403, path)
            self.assertEqual(self.fetch(path, "0" * 32)[0].status, 403, path)
            self.assertEqual(self.fetch(path, self.tokens["observe"], Origin="http://evil.example")[0].status, 403, path)
            self.assertEqual(self.fetch(path, self.tokens["observe"])[0].status, 200, path)
        for role in ("observe", "operate"):
            self.assertEqual(self.fetch("watch?run=0", self.tokens[role], "POST")[0].status, 403)
        self.assertEqual(self.fetch("watch?run=0", self.tokens["change"], "GET")[0].status, 404)
        for number in ("99", "-1", "x", ""):
            self.assertEqual(self.fetch(f"watch?run={number}", self.tokens["change"], "POST")[0].status, 404, number)
        for path in ("results.sqlite", "../doors.xml", "%2e%2e/doors.xml", "runs.csv", ""):
            self.assertEqual(self.fetch(path, self.tokens["change"])[0].status, 404, path)
        for method in ("PUT", "DELETE"):
            self.assertEqual(self.fetch("status", self.tokens["change"], method)[0].status, 403, method)

    def test_5_who_may_not_watch_a_run_is_told_why(self):
        self.browser.get(self.addresses[ROLES.index("observe")])
        self.browser.refresh()
        wait_for("the failed runs", lambda: self.browser.find_elements("css selector", ".failed-run"))
        button = self.part(".failed-run button")
        self.assertFalse(button.is_enabled())
        self.assertIn("takes the role change", button.get_attribute("title"))


if __name__ == "__main__":
    page_case.main()
