#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a recording: it plays, stands, and shows the robot where the recording says that it was.

    tests/system/view/replay_test.py [--pictures FOLDER] BUILD_FOLDER
"""
import csv
import io
import math
import subprocess

from page_case import PageCase, main, wait_for
from view_case import BUILD, TREE

LENGTH = 12  # [s] of the recorded run
MOMENTS = (9.0, 2.5, 6.0)  # [s] since it began
# What a person does who pulls the slider to a moment.
SCRUB = """
const slider = document.getElementById("replay-at");
slider.value = String(Number(slider.min) + arguments[0]);
slider.dispatchEvent(new Event("change"));
"""


class Replay(PageCase):
    @classmethod
    def shown(cls):
        return cls.folder / "run.mcap"

    @classmethod
    def start_system(cls):
        graph = TREE / "graphs" / f"{cls.NAME}.xml"
        subprocess.run([BUILD / "bin" / "deployer", graph, "--no-progress", "--log", "error", "--clock", "virtual", "--until", f"{LENGTH}s", "--record", cls.shown()],
                       env=cls.environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, timeout=60, check=True)
        table = cls.orcactl("bag", "csv", str(cls.shown()), "localizer.RobotPosePush").stdout
        cls.poses = [(float(row["stamp"]), float(row["x"]), float(row["y"])) for row in csv.DictReader(io.StringIO(table))]

    def tearDown(self):
        self.assertIsNone(self.view.poll(), "orcaview runs")
        errors = [entry["message"] for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [], "the browser reports no error")

    def recorded_place(self, moment):
        """Returns where the robot was, by the last pose that had passed [m]."""
        return [pose[1:] for pose in self.poses if pose[0] <= moment][-1]

    def stand(self):
        self.click("#tab-world")
        wait_for("the bar", lambda: self.part("#replay").is_displayed())
        if self.text("#replay-play") == "Pause":
            self.click("#replay-play")
        wait_for("it stands", lambda: self.text("#replay-play") == "Play")

    def scrub(self, moment):
        self.browser.execute_script(SCRUB, moment)
        wait_for("the moment", lambda: abs(self.moment() - moment) < 0.1)

    def moment(self):
        return float(self.text("#replay-time").split("(")[-1].split(" s")[0])

    def test_1_it_stands_where_it_stood(self):
        self.stand()
        self.assertEqual(self.text("#link"), "recording")
        self.assertFalse(self.part("#stop").is_displayed(), "there are no motors to stop")
        for moment in MOMENTS:
            self.scrub(moment)
            place = self.recorded_place(moment)
            wait_for(f"the robot at {place} after {moment} s", lambda: self.place() is not None and self.distance(place) < 0.05)
        self.assertEqual(self.text("#notices"), "", "there is nothing to complain about")
        self.picture("replay")

    def test_2_it_plays_and_stands_again(self):
        self.stand()
        self.scrub(MOMENTS[1])
        begin = self.recorded_place(MOMENTS[1])
        self.click("#replay-play")
        wait_for("it drives", lambda: self.moment() > MOMENTS[1] + 3.0)
        self.click("#replay-play")
        wait_for("it stands", lambda: self.text("#replay-play") == "Play")
        moment = self.moment()
        self.assertGreater(math.dist(begin, self.place()), 0.3)
        wait_for("the robot where it was", lambda: self.distance(self.recorded_place(moment)) < 0.15)
        self.assertAlmostEqual(self.moment(), moment, delta=0.3)

    def test_3_it_plays_faster_to_the_end(self):
        self.stand()
        self.scrub(MOMENTS[1])
        self.browser.execute_script("""
            const speed = document.getElementById("replay-speed");
            speed.value = "10";
            speed.dispatchEvent(new Event("change"));""")
        self.click("#replay-play")
        wait_for("the end", lambda: self.text("#replay-play") == "Play" and self.moment() > LENGTH - 2, 8)
        wait_for("the last place", lambda: self.distance(self.poses[-1][1:]) < 0.05)

    def test_4_the_graph_is_there(self):
        self.click("#tab-system")
        wait_for("the graph", lambda: self.browser.find_elements("css selector", '#graph [data-component="goto"]'))
        wait_for("its connections", lambda: self.browser.find_elements("css selector", "#graph .hit"))


if __name__ == "__main__":
    main()
