#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page in a browser: a person sees the robot, changes connections and code while it drives, and sends it somewhere.

    tests/system/view/view_test.py [--pictures FOLDER] BUILD_FOLDER
"""
import json
import math
import re
import shutil
import xml.etree.ElementTree

from page_case import PageCase, main, wait_for
from selenium.webdriver import ActionChains
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select
from view_case import BUILD

KITCHEN = (4.2, 9.8)
WAY_TO_KITCHEN = ((3.6, 6.0), (3.6, 7.6))
BOX = (2.4, 5.8)  # [m] in the corridor, where every way to its end leads
BEFORE_BOX = (3.6, 6.0)
BEHIND_BOX = (1.2, 6.0)
KITCHEN_FROM = 7.6  # [m] y of its door

# Where a line of the graph can be clicked: a point of it that nothing else covers.
POINT_OF_WIRE = """
const [from, to] = arguments;
for (const hit of document.querySelectorAll("#graph .hit")) {
  if (hit.textContent !== `${from} → ${to}`) continue;
  const matrix = hit.getScreenCTM();
  for (let share = 0.05; share < 1; share += 0.05) {
    const p = hit.getPointAtLength(share * hit.getTotalLength()).matrixTransform(matrix);
    if (document.elementFromPoint(p.x, p.y) === hit) return [p.x, p.y];
  }
}
return null;
"""
MIDDLE_OF = """
const box = document.querySelector(arguments[0]).getBoundingClientRect();
return [box.x + box.width / 2, box.y + box.height / 2];
"""


class Page(PageCase):
    def wires(self):
        return {(row["from"], row["to"]) for row in self.rows_of("graph")["connections"]}

    def point_of_wire(self, ends):
        return self.browser.execute_script(POINT_OF_WIRE, *ends)

    def middle_of(self, selector):
        return self.browser.execute_script(MIDDLE_OF, selector)

    def pull(self, begin, end, **more):
        """Pulls the mouse from port to port."""
        a, b = (self.middle_of(f'#graph [data-port="{port}"] path') for port in (begin, end))
        self.mouse(a, ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), b, **more)
        return b

    def open_graph(self):
        self.click("#tab-system")
        wait_for("the graph", lambda: self.browser.find_elements("css selector", "#graph [data-port]"))

    def look_at(self, component, port):
        self.click("#tab-component")
        self.click(f'#component-list [data-name="{component}"]')
        self.click(f'#component [aria-label="Look at {component}.{port}"]')
        wait_for("the object that passes", lambda: self.browser.find_elements("css selector", "#component .object tr"))

    def test_1_the_moving_robot_is_seen(self):
        self.click("#tab-world")
        wait_for("the robot drives", self.drives)
        before = self.place()
        wait_for("the robot is seen at another place", lambda: self.distance(before) > 0.3)
        self.assertEqual(self.text("#robot-name"), "Dewey")
        self.assertIn("live", self.text("#link"))
        self.assertFalse(self.part("#pacing").is_displayed(), "real time has no pace")
        self.assertLess(self.distance(self.pose()), 0.5, "the page shows the robot where it is")
        colours = self.browser.execute_script("""
            const map = document.getElementById("map");
            const { data } = map.getContext("2d").getImageData(0, 0, map.width, map.height);
            return new Set(new Uint32Array(data.buffer)).size;""")
        self.assertGreater(colours, 20, "cones, robot and way are drawn")
        self.picture("drive")

    def test_2_a_connection_is_removed_and_made_again(self):
        ends = ("goto.GoalPush", "avoid.goal")
        self.open_graph()
        point = wait_for("the line of the connection", lambda: self.point_of_wire(ends))
        self.assertIn(ends, self.wires())
        self.mouse(point)
        self.click("#disconnect")
        wait_for("the deployer has removed it", lambda: ends not in self.wires())
        wait_for("its line is gone", lambda: self.point_of_wire(ends) is None)
        self.click("#inspector .close")
        self.pull(*ends)
        wait_for("the deployer has made it", lambda: ends in self.wires())
        wait_for("its line is back", lambda: self.point_of_wire(ends))
        self.picture("system", after=5.0)

    def box(self, component):
        """Returns where a component stands on the sheet, [pixels] of its own."""
        return wait_for(f"the box of {component}", lambda: self.browser.execute_script("""
            const box = document.querySelector(arguments[0]);
            return box && [Number(box.getAttribute("x")), Number(box.getAttribute("y"))];""", f'#graph [data-component="{component}"] > rect'))

    def pull_box(self, component, dx, dy):
        """Pulls a component by its name, and returns where it stands then."""
        x, y = self.middle_of(f'#graph [data-component="{component}"] .name')
        before = self.box(component)
        self.mouse((x, y), (x + dx / 2, y + dy / 2), (x + dx, y + dy))
        wait_for("it has moved", lambda: math.dist(self.box(component), before) > 10)
        return self.box(component)

    def load_again(self):
        self.browser.refresh()
        self.open_graph()

    def test_2b_where_components_were_pulled_to_is_kept_beside_the_graph(self):
        layout = self.graph.with_suffix(".layout.json")
        self.open_graph()
        place = self.pull_box("goto", 40, 60)
        wait_for("the file beside the graph", layout.exists)
        self.assertEqual(list(json.loads(layout.read_text())), ["goto"])
        self.browser.execute_script("localStorage.clear()")
        self.load_again()
        wait_for("it stands there again", lambda: math.dist(self.box("goto"), place) < 1.5)
        self.click("#graph-tidy")
        wait_for("the file is gone", lambda: not layout.exists())
        wait_for("it stands elsewhere", lambda: math.dist(self.box("goto"), place) > 10)

    def test_2c_what_cannot_be_kept_beside_the_graph_is_kept_in_the_browser(self):
        layout = self.graph.with_suffix(".layout.json")
        layout.write_text('{"of": "somebody else"}')
        self.addCleanup(layout.unlink, missing_ok=True)
        self.open_graph()
        place = self.pull_box("goto", 40, 60)
        said = wait_for("what the page says", lambda: self.text("#notices .refused"))
        self.assertIn("Only this browser remembers", said)
        self.assertIn("layout.json", said)
        self.load_again()
        wait_for("it stands there again", lambda: math.dist(self.box("goto"), place) < 1.5)
        self.assertEqual(layout.read_text(), '{"of": "somebody else"}')
        layout.unlink()
        self.browser.execute_script("localStorage.clear()")
        self.load_again()

    def test_3_what_does_not_fit_is_said_and_not_done(self):
        self.open_graph()
        before = self.wires()
        end = self.pull("base.OdometryPush", "avoid.goal", up=False)
        self.assertEqual(self.text("#graph-hint"), "Odometry is no GoalPoint")
        self.mouse(end, down=False)
        refused = wait_for("the checker's word", lambda: self.text("#notices .refused"))
        self.assertIn("G021", refused)
        self.assertEqual(self.wires(), before)

    def verdict(self, sign):
        """Returns the part of the dialog's verdict that the sign finds."""
        found = wait_for("the verdict", lambda: re.search(f"{sign}|refused|error", self.text("#dialog .verdict")), 60)
        self.assertRegex(found[0], sign, self.text("#dialog .verdict"))
        return found[0]

    def test_4_code_is_exchanged_by_mouse_while_it_drives(self):
        self.click("#tab-world")
        wait_for("the robot drives", self.drives)
        self.open_graph()
        self.mouse(self.middle_of('#graph [data-component="avoid"] .name'))
        self.click("#inspector .row button:nth-child(2)")
        choice = Select(wait_for("the code that fits", lambda: self.browser.find_elements("css selector", "#swap-choice:enabled"))[0])
        offered = [option.text.split(" of ")[0] for option in choice.options]
        self.assertIn("orca.SonarAvoid", offered)
        self.assertNotIn("orca.Goto", offered, "its ports are others")
        self.assertFalse(self.part("#dialog .end button:nth-child(2)").is_enabled(), "nothing was tried yet")
        choice.select_by_index(offered.index("orca.SonarAvoid"))
        self.click("#dialog .end button:nth-child(1)")
        self.assertEqual(self.verdict("can take the place of avoid"), "can take the place of avoid")
        swaps = lambda: next(row["swaps"] for row in self.rows_of("plugins") if "avoid" in row["used_by"].split())
        self.assertEqual(swaps(), 0, "the trial has exchanged nothing")
        before = self.pose()
        self.click("#dialog .end button:nth-child(2)")
        self.verdict("runs the code")
        wait_for("it drives on", lambda: math.dist(before, self.pose()) > 0.2)
        self.picture("swap")
        self.assertEqual(swaps(), 1)
        self.click("#dialog .end button:last-child")

    def write(self, parameter, *words):
        """Writes into the field of a parameter, which is there as soon as its value was read."""
        field = f'#component [aria-label="{parameter}"]'
        wait_for(f"the field of {parameter}", lambda: self.browser.find_elements("css selector", field))
        self.part(field).clear()
        self.part(field).send_keys(*words)

    def value(self, parameter):
        return self.rows_of("get", parameter)[0]["value"]

    def test_5_parameters_are_set_at_once(self):
        self.click("#tab-component")
        self.click('#component-list [data-name="goto"]')
        self.write("goto.max_speed", "0.45")
        self.write("goto.slow_down", "70 %/s")
        self.assertEqual(self.text("#component .primary"), "Set 2 values at once")
        self.click("#component .primary")
        wait_for("why not", lambda: "slow_down" in self.text("#notices .refused"))
        self.assertEqual(self.value("goto.max_speed"), "0.5", "one is wrong, so none is set")
        self.write("goto.slow_down", "0.7", Keys.ENTER)
        wait_for("the new values", lambda: self.value("goto.max_speed") == "0.45")
        self.assertEqual(self.value("goto.slow_down"), "0.7")
        self.look_at("goto", "localizer")
        self.assertIn("RobotPose", self.text("#component .object .small"))
        self.picture("component")

    def change_speed(self, speed):
        """Writes the graph that runs with another speed of goto, and returns the file."""
        graph = xml.etree.ElementTree.fromstring(self.orcactl("graph").stdout)
        goto = next(node for node in graph.iter("component") if node.get("name") == "goto")
        for node in [each for each in goto.iter("param") if each.get("name") == "max_speed"]:
            goto.remove(node)
        xml.etree.ElementTree.SubElement(goto, "param", name="max_speed", value=speed)
        file = self.folder / "changed.xml"
        xml.etree.ElementTree.ElementTree(graph).write(file)
        return file

    def test_5b_an_applied_graph_is_taken_back(self):
        self.open_graph()
        self.assertEqual(self.orcactl("set", "goto.max_speed", "0.44").returncode, 0)  # no graph file says so
        file = self.change_speed("0.31")
        self.click("#graph-apply")
        self.part("#apply-own").send_keys(str(file))
        self.click("#dialog .end button:nth-child(2)")
        self.verdict("This has changed")
        self.assertEqual(self.value("goto.max_speed"), "0.31")
        self.click("#dialog .end button:last-child")
        self.click("#graph-undo")
        self.verdict("This would change")
        self.assertIn("0.44", self.text("#dialog .verdict"))
        self.assertEqual(self.value("goto.max_speed"), "0.31", "it only shows what would change")
        self.click("#dialog .end button:nth-child(1)")
        self.verdict("It has gone back")
        self.assertEqual(self.value("goto.max_speed"), "0.44")
        self.click("#dialog .end button:last-child")

    def test_5c_why_a_graph_cannot_be_taken_back_is_said(self):
        plugins = self.folder / "plugins"
        for name in ("test_life.so", "test_life.types"):
            shutil.copy(BUILD / "tests" / "host_plugins" / name, plugins)
        graph = self.orcactl("graph").stdout
        larger = self.folder / "larger.xml"
        larger.write_text(graph.replace("</graph>", '<component name="life" type="test.Life" autonomous="true"/></graph>'))
        before = self.folder / "smaller.xml"
        before.write_text(graph)
        done = self.orcactl("apply", str(larger))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.open_graph()
        self.click("#graph-apply")
        self.part("#apply-file").send_keys(str(before))
        self.click("#dialog .end button:nth-child(2)")
        self.verdict("This has changed")
        self.click("#dialog .end button:last-child")
        for file in plugins.iterdir():
            file.unlink()
        self.click("#graph-undo")
        self.verdict("The system cannot go back")
        self.assertIn("test.Life", self.text("#dialog .verdict"))
        self.assertFalse(self.part("#dialog .end button:nth-child(1)").is_enabled())
        self.click("#dialog .end button:last-child")

    def test_6_a_sensor_is_followed_to_the_wheels_and_a_field_is_plotted(self):
        self.look_at("goto", "localizer")
        self.click('#component [aria-label="Plot translational_velocity"]')
        self.click("#tab-time")
        self.click("#trace")
        wait_for("a way from a sensor to the wheels", lambda: re.search(r"(OdometryPush|ReadingsPush|RobotPosePush) → .+ → fuser\.base", self.text("#ways")))
        wait_for("the plot", lambda: self.browser.find_elements("css selector", "#plots canvas"))
        self.assertIn("localizer translational_velocity", self.text("#plots .legend"))
        self.picture("time", height=1000, after=8.0)
        self.click("#trace")

    def begin_anew(self):
        """Shows the world, and gives up whatever goal there is."""
        self.click("#tab-world")
        wait_for("the robot is seen", self.place)
        self.click("#give-up")
        wait_for("the goal is given up", lambda: "no goal" in self.text("#plain"))
        self.click("#fit")

    def order_drive(self, way, pull=None):
        """Clicks a way; the mouse is pulled at its end."""
        self.click("#tool-drive")
        for place in way[:-1]:
            self.shift_click(place)
        x, y = self.pixel(way[-1])
        self.mouse((x, y), *([] if pull is None else [(x + pull[0], y + pull[1])]))
        wait_for("it is on the way", lambda: "on the way to the place you chose" in self.text("#plain"))

    def test_7_a_click_sends_it_to_another_room(self):
        self.begin_anew()
        self.order_drive([*(WAY_TO_KITCHEN if self.place()[1] < KITCHEN_FROM else ()), KITCHEN], pull=(0, -40))
        wait_for("it drives", self.drives)
        self.picture("goal", after=1.0)
        wait_for("it has arrived in the kitchen", lambda: self.distance(KITCHEN) < 0.4, 60)
        wait_for("it stands and waits", lambda: self.text("#plain").startswith("Stands. It has no goal"))
        self.assertLess(abs(self.number("#figure-heading") - 90), 12, "it looks where the mouse was pulled to")

    def test_8_an_obstacle_that_was_dropped_in_its_way_is_driven_round(self):
        if not any(row["port"].endswith(".ChangeSend") for row in self.rows_of("ports")):
            self.skipTest("no component of this graph takes changes of the simulated world")
        self.begin_anew()
        self.order_drive([*(WAY_TO_KITCHEN[:0:-1] if self.place()[1] > KITCHEN_FROM else ()), BEFORE_BOX])
        wait_for("it stands before the place of the box", lambda: self.text("#plain").startswith("Stands. It has no goal"), 60)
        self.click("#tool-change")
        self.mouse(self.pixel(BOX))
        wait_for("the box is there", lambda: "comes to" in self.text("#notices"))
        self.order_drive([BEHIND_BOX])
        self.picture("obstacle", after=1.5)
        places = []

        def has_passed():
            places.append(self.place())
            if self.distance(BEHIND_BOX) < 0.4:
                return True
            # Without a map it may give up before the box: who watches clicks again.
            if self.text("#plain").startswith("Stands. It has no goal"):
                self.order_drive([BEHIND_BOX])
            return False

        wait_for("it has passed the box", has_passed, 120)
        beside = [abs(y - BOX[1]) for x, y in places if abs(x - BOX[0]) < 0.2]
        self.assertGreater(min(beside), 0.35, "it kept away from the box")
        self.assertNotIn("touches", self.text("#notices"))

    def shift_click(self, place):
        ActionChains(self.browser).key_down(Keys.SHIFT).perform()
        self.mouse(self.pixel(place))
        ActionChains(self.browser).key_up(Keys.SHIFT).perform()


if __name__ == "__main__":
    main()
