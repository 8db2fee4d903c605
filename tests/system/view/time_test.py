#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a simulation in a browser: a person pauses it, steps and hastens it, and its trace hash stays.

    tests/system/view/time_test.py [--pictures FOLDER] BUILD_FOLDER
"""
import re
import subprocess

from page_case import PageCase, main, wait_for
from selenium.webdriver.support.select import Select
from view_case import BUILD, TREE, await_that

UNTIL = 40  # [s] of the run
WALL_COLOURS = """
const map = document.getElementById("map");
const { data } = map.getContext("2d").getImageData(0, 0, map.width, map.height);
return new Set(new Uint32Array(data.buffer)).size;"""


class SimulatedTime(PageCase):
    COMMAND = ("--clock", "virtual", "--until", f"{UNTIL}s", "--no-progress", "--log", "error")

    @classmethod
    def deployer(cls, *options):
        return subprocess.Popen([BUILD / "bin" / "deployer", TREE / "graphs" / f"{cls.NAME}.xml", *cls.COMMAND, *options],
                                env=cls.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)

    @classmethod
    def start_system(cls):
        system = cls.deployer("--pace", "1")
        cls.addClassCleanup(cls.end, system)
        await_that(lambda: cls.orcactl("ps").stdout.count(" WORK ") >= cls.COMPONENTS, "all components work")
        return system

    def pace(self):
        return self.rows_of("pace")[0]

    def shown_time(self):
        return float(self.text("#pace-time").split()[0] or 0)

    def test_time_stands_steps_and_passes_as_a_person_wants_and_the_trace_stays(self):
        self.click("#tab-world")
        wait_for("the robot drives", self.drives)
        self.assertGreater(self.browser.execute_script(WALL_COLOURS), 20, "cones, robot and way are drawn")
        self.click("#pace-pause")
        wait_for("time stands", lambda: self.text("#pace-state") == "Time stands.")
        paused = self.pace()
        self.assertTrue(paused["paused"])
        self.assertEqual(self.pace(), paused)
        self.assertEqual(self.text("#pace-pause"), "Go on")

        place = self.place()
        self.click('[data-step="0.1s"]')
        wait_for("a step of 0.1 s", lambda: round(self.pace()["time"] - paused["time"], 9) == 0.1)
        for _ in range(2):
            self.click('[data-step="1s"]')
        wait_for("two more of 1 s", lambda: round(self.pace()["time"] - paused["time"], 9) == 2.1)
        wait_for("the page shows when it is", lambda: abs(self.shown_time() - self.pace()["time"]) < 0.001)
        wait_for("the robot is seen elsewhere", lambda: self.distance(place) > 0.1)
        self.assertEqual(self.text("#notices"), "", "there is nothing to complain about")
        self.picture("pause")

        Select(self.part("#pace-factor")).select_by_value("2")
        self.assertTrue(self.pace()["paused"], "a pace that is chosen waits for the end of the pause")
        self.click("#pace-pause")
        wait_for("it goes on at the chosen pace", lambda: self.pace()["pace"] == 2.0)
        Select(self.part("#pace-factor")).select_by_value("fast")
        output, _ = self.system.communicate(timeout=60)
        self.assertEqual(self.system.returncode, 0)
        alone, _ = self.deployer().communicate(timeout=60)
        self.assertEqual(re.findall("trace-hash .*", output), re.findall("trace-hash .*", alone))
        wait_for("the page says that it is over", lambda: not self.part("#pacing").is_displayed())

    def tearDown(self):
        errors = [entry["message"] for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [], "the browser reports no error")


if __name__ == "__main__":
    main()
