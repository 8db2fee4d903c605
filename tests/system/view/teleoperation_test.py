#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A person drives the robot from the page: by gamepad, keys and pointer, each with a dead man's switch.

    tests/system/view/teleoperation_test.py [--pictures FOLDER] BUILD_FOLDER
"""
import json
import re
import signal
import threading
import time

from page_case import PageCase, main, wait_for

STANDS = 0.01  # [m/s]
DRIVES = 0.1  # [m/s]
LIMIT = 0.3  # [s] from letting go to the last command to the base that moves it
DEAD_MAN = 1.0  # [s] parameter of Teleop, so long that it is the page that stops the robot
REST = 0.8  # [s] from that command to the robot at rest: it brakes as its base does
QUIET = 0.5  # [s] in which nothing may move
SHOULDER = 5  # the dead man's button
ARROWS = {"ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}
SHIFT = 8

# A gamepad as the browser would report it. The test moves it: window.pad is the state of the only one, null if none is connected.
GAMEPAD = """
window.pad = null;
navigator.getGamepads = () => [null, window.pad && { id: "a test's", index: 1, connected: true, mapping: "standard", timestamp: performance.now(),
  axes: window.pad.axes, buttons: Array.from({ length: 17 }, (_, i) => ({ pressed: window.pad.held.includes(i), touched: false, value: 0 })) }];
for (const end of ["keyup", "pointerup"]) addEventListener(end, () => { window.letGoAt = Date.now() / 1000; }, { capture: true });
document.addEventListener("visibilitychange", () => { if (document.hidden) window.leftAt = Date.now() / 1000; }, { capture: true });
"""


class Line:
    """What passes a port: times [s since 1970] and objects as text."""

    def __init__(self, process):
        self.process = process
        self.objects = []
        self.reader = threading.Thread(target=self.read, daemon=True)  # a test that is ended waits for nobody
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            row = json.loads(line)
            self.objects.append((row["passed"], row["xml"]))

    def end(self):
        self.process.terminate()
        self.reader.join()
        self.process.wait()
        self.process.stdout.close()

    def since(self, begin):
        return [(passed, xml) for passed, xml in self.objects if passed >= begin]


def speed_of(xml):
    return float(re.search(' translational_velocity="([^"]+)"', xml)[1])


def turn_rate_of(xml):
    return float(re.search(' steering_velocity="([^"]+)"', xml)[1])


class ByHand(PageCase):
    NAME = "scout_teleop"
    OPTIONS = ("--set", "teleop.keyboard=", "--set", f"teleop.dead_man={DEAD_MAN} s")
    COMPONENTS = 4

    @classmethod
    def start_system(cls):
        """The page sees what runs in host processes, so all goes into one."""
        text = cls.graph.read_text()
        text = text.replace('<component name=', '<process name="robot"/>\n  <component name=', 1).replace(' type="orca.', ' process="robot" type="orca.')
        cls.graph.write_text(text.replace('<hardware name="scout" process="robot"', '<hardware name="scout"'))
        return super().start_system()

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": GAMEPAD})
        cls.browser.refresh()
        cls.odometry, cls.commands = (Line(cls.follow(cls, port)) for port in ("base.OdometryPush", "fuser.base"))
        for line in (cls.odometry, cls.commands):
            cls.addClassCleanup(line.end)
            wait_for("what passes", lambda line=line: line.objects)

    def setUp(self):
        self.click("#tab-world")
        wait_for("the page drives by hand", lambda: self.part("#teleoperation").is_displayed())

    # ------------------------------------------------------------------------------------------------ what a hand does

    def hold(self, forward=0.0, left=0.0, held=(SHOULDER,)):
        """Moves the stick of the gamepad; forward and left are in [-1, 1]. Returns when [s since 1970]."""
        pad = {"axes": [-left, -forward, 0, 0], "held": list(held)}
        return self.browser.execute_script("window.pad = arguments[0]; return Date.now() / 1000", pad)

    def unplug(self):
        return self.browser.execute_script("window.pad = null; return Date.now() / 1000")

    def key(self, kind, key, **more):
        self.browser.execute_cdp_cmd("Input.dispatchKeyEvent", {"type": kind, "key": key, "code": key, "windowsVirtualKeyCode": ARROWS[key], **more})

    def touch(self, kind, *points):
        self.browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": list(points)})

    def let_go_at(self):
        return self.browser.execute_script("return window.letGoAt")

    # ------------------------------------------------------------------------------------------------ what the robot does

    def speed(self):
        return speed_of(self.odometry.objects[-1][1])

    def drives(self, sign=1):
        wait_for("it drives", lambda: sign * self.speed() > DRIVES)

    def assert_stops(self, released, limit=LIMIT):
        """Nothing but stops reaches the base later than the limit, and the robot rests."""
        wait_for("some time later", lambda: self.odometry.objects[-1][0] > released + limit + REST + QUIET)
        driving = [passed - released for passed, xml in self.commands.since(released) if 'kind="FULLSTOP"' not in xml]
        self.assertLess(max(driving, default=0), limit, "the last command that moves it")
        self.assertTrue(self.commands.since(released + limit), "the base is told to stop")
        fastest = max(abs(speed_of(xml)) for _, xml in self.odometry.since(released + limit + REST))
        self.assertLess(fastest, STANDS)

    def rests(self):
        wait_for("it rests", lambda: abs(self.speed()) < STANDS)

    def assert_nothing_moves(self):
        begin = self.odometry.objects[-1][0]
        wait_for("some time later", lambda: self.odometry.objects[-1][0] > begin + QUIET)
        self.assertLess(max(abs(speed_of(xml)) for _, xml in self.odometry.since(begin)), STANDS)

    # ------------------------------------------------------------------------------------------------ cases

    def test_1_a_gamepad_drives_while_its_button_is_held(self):
        self.hold(forward=1, held=())
        self.assert_nothing_moves()
        self.hold(forward=1, held=[each for each in range(17) if each != SHOULDER])
        self.assert_nothing_moves()
        self.hold(forward=1)
        self.drives()
        self.picture("by_hand")
        self.assert_stops(self.hold(forward=1, held=()))
        self.hold(left=1)
        wait_for("it turns left", lambda: turn_rate_of(self.odometry.objects[-1][1]) > 0.3)
        self.hold(left=-1)
        wait_for("it turns right", lambda: turn_rate_of(self.odometry.objects[-1][1]) < -0.3)
        self.hold(forward=0.1, left=-0.1)  # the middle of a stick is never exact
        wait_for("it stands", lambda: abs(turn_rate_of(self.odometry.objects[-1][1])) < 0.01 and abs(self.speed()) < STANDS)
        self.hold(held=())

    def test_2_a_gamepad_that_vanishes_stops_the_robot(self):
        self.hold(forward=1)
        self.drives()
        self.assert_stops(self.unplug())

    def test_3_after_stop_the_button_has_to_be_pressed_anew(self):
        self.hold(forward=-1)
        self.drives(-1)
        self.click("#stop")
        self.assert_stops(self.let_go_at())
        self.click("#release")
        self.assert_nothing_moves()
        self.hold(held=())
        time.sleep(0.2)
        self.hold(forward=1)
        self.drives()
        self.assert_stops(self.hold(held=()))

    def test_4_an_arrow_key_drives_while_it_is_held(self):
        self.key("keyDown", "ArrowUp")
        self.drives()
        self.key("keyUp", "ArrowUp")
        self.assert_stops(self.let_go_at())
        self.key("keyDown", "ArrowDown", modifiers=SHIFT)
        self.assert_nothing_moves()
        self.key("keyUp", "ArrowDown", modifiers=SHIFT)
        self.click("#tab-time")
        self.key("keyDown", "ArrowDown")
        self.assert_nothing_moves()
        self.key("keyUp", "ArrowDown")

    def test_5_the_pad_drives_while_it_is_held(self):
        box = self.part("#pad").rect
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        self.mouse((x, y), (x, y + 70), up=False)
        self.drives(-1)
        self.mouse((x, y + 70), down=False)
        self.assert_stops(self.let_go_at())
        self.browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True})
        self.addCleanup(self.browser.execute_cdp_cmd, "Emulation.setTouchEmulationEnabled", {"enabled": False})
        self.touch("touchStart", {"x": x, "y": y})
        self.touch("touchMove", {"x": x, "y": y - 70})
        self.drives()
        self.touch("touchEnd")
        self.assert_stops(self.let_go_at())

    def test_6_to_leave_the_page_or_to_lose_the_connection_is_to_stop(self):
        self.hold(forward=1)
        self.drives()
        page = self.browser.current_window_handle
        self.browser.switch_to.new_window("tab")
        self.rests()
        self.browser.close()
        self.browser.switch_to.window(page)
        self.assert_stops(self.browser.execute_script("return window.leftAt"))
        self.assert_nothing_moves()

        self.hold(held=())
        time.sleep(0.2)
        self.hold(forward=-1)
        self.drives(-1)
        self.view.send_signal(signal.SIGSTOP)
        self.addCleanup(self.view.send_signal, signal.SIGCONT)
        self.assert_stops(time.time(), DEAD_MAN + 0.2)  # a lap of Teleop later
        self.hold(held=())


if __name__ == "__main__":
    main()
