#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page for everybody: on a phone, dark and light, by keyboard alone, and for eyes that see fewer colours.

    tests/system/view/access_test.py [--pictures FOLDER] BUILD_FOLDER
"""
import itertools

from colours import VISIONS, contrast, difference, read_colour
from page_case import PageCase, main, wait_for

ENDS_OF_CORRIDOR = ((1.2, 6.0), (9.0, 6.0))  # [m]
DOORS = ("world", "system", "component", "time")
PHONE = {"width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": True}
LEAST_TARGET = 44  # [pixels] that a finger hits (WCAG 2.2, 2.5.5)
LEAST_CONTRAST = 4.5  # of text (WCAG 2.2, 1.4.3)
LEAST_GRAPHIC = 3  # of what is drawn (WCAG 2.2, 1.4.11)
LEAST_DIFFERENCE = 20  # CIELAB; 2.3 are just seen side by side
KEYS = {"Tab": 9, "Enter": 13, "Escape": 27, " ": 32, "ArrowLeft": 37, "ArrowRight": 39, "+": 187}

# What is drawn in the same shape has to differ in its colour for everybody.
SAME_SHAPE = (("motion", "wish", "trail"), ("command", "path"), ("laser", "echo", "particle"), ("sonar-edge", "laser", "robot-edge"))
DRAWN = ("wall", "robot-edge", "sonar-edge", "laser", "motion", "command", "wish", "path", "goal", "sure", "contact", "particle", "echo")
WRITTEN = ("ink", "muted", "wish", "goal")  # names in the picture, with a rim as the floor is

OVERFLOWING = """
const scrolls = (each) => each.closest("nav") !== null || each.parentElement.closest("svg") !== null;  // lists of names may, and drawings
return [document.documentElement.scrollWidth, ...[...document.querySelectorAll("body *")]
  .filter((each) => each.checkVisibility() && each.getBoundingClientRect().right > innerWidth + 0.5 && !scrolls(each))
  .map((each) => `${each.tagName} #${each.id} .${each.className}`)];
"""
STOP_IN_REACH = """
const stop = document.getElementById("stop");
const box = stop.getBoundingClientRect();
const inside = box.top >= 0 && box.left >= 0 && box.bottom <= innerHeight && box.right <= innerWidth;
return [inside && stop.contains(document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2)), box.height, box.width];
"""
BOXES_IN_SIGHT = """
const view = document.getElementById("graph").getBoundingClientRect();
const inside = (box) => box.left >= view.left && box.right <= view.right && box.top >= view.top && box.bottom <= view.bottom;
return [...document.querySelectorAll(arguments[0])].map((each) => inside(each.getBoundingClientRect()));
"""
SMALL_TARGETS = """
return [...document.querySelectorAll("button, select, input")]
  .filter((each) => each.checkVisibility() && !each.matches(".plain, .look, [type=checkbox], .value input") && each.getBoundingClientRect().height < arguments[0])
  .map((each) => `${each.id || each.textContent} ${each.getBoundingClientRect().height}`);
"""
# Text with its colour and what is behind it, as the browser computes both. In the drawing of the graph a text may stand on a box, a frame or the page.
WRITTEN_TEXTS = """
const read = (text) => {
  const [r, g, b, a = 1] = text.match(/[\\d.]+/g).map(Number);
  return [r, g, b, a];
};
const over = ([r, g, b, a], below) => [r, g, b].map((each, i) => each * a + below[i] * (1 - a));
const behind = (each) => {
  if (each === null) return [255, 255, 255];
  const colour = read(getComputedStyle(each).backgroundColor);
  return colour[3] === 1 ? colour.slice(0, 3) : over(colour, behind(each.parentElement));
};
const opacity = (each) => each === null ? 1 : Number(getComputedStyle(each).opacity) * opacity(each.parentElement);
const variable = (name) => {
  const probe = document.createElement("i");
  probe.style.color = `var(--${name})`;
  document.body.append(probe);
  const colour = read(getComputedStyle(probe).color).slice(0, 3);
  probe.remove();
  return colour;
};
const found = new Map();
for (const each of document.querySelectorAll("body *")) {
  const text = each.matches("input") ? each.value || each.placeholder : [...each.childNodes].filter((node) => node.nodeType === 3).map((node) => node.data).join("").trim();
  if (text === "" || each.matches(":disabled, option, title, script, canvas *") || !each.checkVisibility({ opacityProperty: true })) continue;
  const drawn = each.closest("svg") !== null;
  const style = getComputedStyle(each, each.matches("input") && each.value === "" ? "::placeholder" : null);
  const ink = read(drawn ? style.fill : style.color);
  for (const ground of drawn ? ["card", "shade", "page"].map(variable) : [behind(each)]) {
    const colour = over([ink[0], ink[1], ink[2], ink[3] * opacity(each)], ground);
    found.set(JSON.stringify([colour, ground]), `${each.tagName}#${each.id}.${each.getAttribute("class")} ${text.slice(0, 30)}`);
  }
}
return [...found].map(([key, name]) => [...JSON.parse(key), name]);
"""
# All that can be operated now, except messages that vanish. Of tabs, one is reached by Tab and the others from it by arrows.
CONTROLS = """
return [...document.querySelectorAll("button, select, input, summary, a[href], [tabindex]")]
  .filter((each) => each.checkVisibility() && !each.disabled && each.tabIndex >= 0 && each.closest("#notices") === null).map((each) => window.nameOf(each));
"""
NAME_OF = """
window.nameOf = (each) => {
  if (each === null || each === document.body) return "";
  window.names ??= new Map();
  if (!window.names.has(each)) window.names.set(each, `${each.id || each.dataset?.component || each.ariaLabel || each.textContent.trim()} (${window.names.size})`);
  return window.names.get(each);
};
"""
FOCUSED = """
const each = document.activeElement;
const shown = each.matches(".box") ? getComputedStyle(each.querySelector("rect")) : getComputedStyle(each);
const ring = each.matches(".box") ? parseFloat(shown.strokeWidth) : shown.outlineStyle === "none" ? 0 : parseFloat(shown.outlineWidth);
const box = each.getBoundingClientRect();
return [window.nameOf(each), each.matches(":focus-visible") && ring >= 2 && (each.matches(".box") || (box.bottom > 0 && box.top < innerHeight && box.right > 0 && box.left < innerWidth))];
"""
NEED_NAMES = {"button", "checkbox", "combobox", "link", "tab", "textbox", "searchbox", "slider", "dialog", "DisclosureTriangle", "toolbar", "tablist", "tabpanel",
              "Canvas", "image", "graphics-document", "spinbutton", "switch", "radio", "menuitem", "listbox"}
# Whether the drawings of the picture dash their lines, and how wide these are, by colour. The pen only writes down what it is told.
STROKES = """
const done = arguments[arguments.length - 1];
import("/world_draw.js").then((draw) => {
  const strokes = {};
  const pen = { dash: [], setLineDash(dash) { this.dash = dash; }, stroke() { strokes[this.strokeStyle] = this.dash.length > 0; } };
  for (const name of ["beginPath", "moveTo", "lineTo", "arc", "fill", "closePath", "ellipse"]) pen[name] = () => {};
  const palette = new Proxy({}, { get: (_, name) => name });
  const pose = { x: 0, y: 0, yaw: 0 };
  const wish = { speed: 1, direction: 0, turnRate: 1, stops: false, silent: false };
  const robot = { shown: pose, outline: { radius: 1, length: 0, width: 0 }, trail: [pose], motion: { forward: 1, left: 0, turnRate: 1 }, command: wish,
    wishes: new Map([["goto", wish]]), way: { name: "kitchen", points: [pose, pose, pose] }, goal: null, ordered: null };
  const labels = [];
  draw.drawTrail(pen, robot, 1, palette);
  draw.drawMotion(pen, robot, 1, palette);
  draw.drawWishes(pen, robot, 1, palette, labels);
  delete strokes.goal;
  draw.drawWay(pen, robot, 1, palette, labels);
  done([strokes, labels.map(({ text }) => text)]);
}).catch((error) => done([String(error), []]));
"""
# Each state with its mark, and the class that gives it a colour.
MARKS = """
const done = arguments[arguments.length - 1];
import("/system_view.js").then(({ markOf }) => done(arguments[0].map(markOf)));
"""
STATES = ("WORK", "WORK_DONE", "IDLE", "INIT", "CONNECT", "UNLOADED", "SUSPENDED", "WORK_FAILED", "EXIT", "what nobody knows")


class Access(PageCase):
    def cdp(self, command, **words):
        return self.browser.execute_cdp_cmd(command, words)

    def tearDown(self):
        self.cdp("Emulation.clearDeviceMetricsOverride")
        self.cdp("Emulation.setTouchEmulationEnabled", enabled=False)
        self.cdp("Emulation.setEmulatedMedia", features=[])
        super().tearDown()

    def open(self, door):
        self.browser.execute_script("document.getElementById(arguments[0]).click()", f"tab-{door}")
        ready = {"world": "#goal-list button", "system": "#graph [data-port]", "component": "#component .value", "time": "#happenings li"}[door]
        wait_for(f"what {door} shows", lambda: self.browser.find_elements("css selector", ready))

    def open_swap(self):
        """Opens the dialog that exchanges code."""
        self.open("component")
        self.browser.execute_script("[...document.querySelectorAll('#component button')].find((each) => each.textContent === 'Swap code …').click()")
        wait_for("the dialog", lambda: self.part("#dialog").is_displayed() and self.part("#swap-choice").is_enabled())

    # ------------------------------------------------------------------------------------------------ on a phone

    def touch(self, kind, *points):
        self.cdp("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)])

    def tap(self, x, y):
        self.touch("touchStart", (x, y))
        self.touch("touchEnd")

    def tap_on(self, selector):
        box = self.browser.execute_script("const b = document.querySelector(arguments[0]).getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]", selector)
        self.tap(*box)

    def become_phone(self, **more):
        self.cdp("Emulation.setDeviceMetricsOverride", **(PHONE | more))
        self.cdp("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)

    def test_1_everything_fits_a_phone_and_stop_is_in_reach(self):
        for size in ({}, {"width": 844, "height": 390}):
            self.become_phone(**size)
            for door in DOORS:
                with self.subTest(door=door, **size):
                    self.open(door)
                    self.assertEqual(self.browser.execute_script(OVERFLOWING), [size.get("width", PHONE["width"])], "wider than the screen")
                    in_reach, height, width = self.browser.execute_script(STOP_IN_REACH)
                    self.assertTrue(in_reach, "STOP is seen without scrolling")
                    self.assertGreaterEqual(min(height, width), LEAST_TARGET)
                    self.assertEqual(self.browser.execute_script(SMALL_TARGETS, LEAST_TARGET), [], "too small for a finger")
                    self.picture(f"phone_{door}{size.get('width', '')}")
            self.open("system")
            wait_for("the whole graph fits", lambda: all(self.browser.execute_script(BOXES_IN_SIGHT, "#graph .box")))
            self.tap_on("#graph [data-component=base] .name")
            wait_for("all about the base", lambda: self.part("#inspector").is_displayed())
            self.assertEqual(self.browser.execute_script(BOXES_IN_SIGHT, "#graph .chosen"), [True], "what was tapped stays in sight")
            self.picture(f"phone_base{size.get('width', '')}")
            self.tap_on("#inspector .close")
            self.open_swap()
            self.assertTrue(self.browser.execute_script(STOP_IN_REACH)[0], "STOP is seen beside a dialog")
            self.assertTrue(self.browser.execute_script("return document.getElementById('dialog').getBoundingClientRect().bottom <= innerHeight"), "all of it")
            self.assertEqual(self.browser.execute_script(OVERFLOWING), [size.get("width", PHONE["width"])], "wider than the screen")
            self.picture(f"phone_swap{size.get('width', '')}")
            self.click("#dialog .end button:last-child")

    def scale(self):
        return float(self.part("#map").get_attribute("data-view").split()[2])

    def test_2_fingers_zoom_and_a_tap_sends_the_robot(self):
        self.become_phone()
        self.open("world")
        wait_for("the robot is seen", self.place)
        before = self.scale()
        x, y = self.pixel(self.place())
        self.touch("touchStart", (x - 30, y), (x + 30, y))
        for spread in (40, 50, 60):
            self.touch("touchMove", (x - spread, y), (x + spread, y))
        self.touch("touchEnd")
        wait_for("two fingers zoom", lambda: 1.6 < self.scale() / before < 2.4)
        gestures = self.browser.execute_script("return [visualViewport.scale, getComputedStyle(document.getElementById('map')).touchAction]")
        self.assertEqual(gestures, [1, "none"], "they zoom the picture, not the page")
        self.tap_on("#fit")
        wait_for("all is shown again", lambda: self.scale() < 1.2 * before)
        self.tap_on("#closer")
        wait_for("a button zooms", lambda: self.scale() > 1.2 * before)
        self.tap_on("#fit")
        wait_for("all is shown again", lambda: self.scale() < 1.2 * before)
        self.tap_on("#tool-drive")
        self.tap(*self.pixel(max(ENDS_OF_CORRIDOR, key=self.distance)))
        wait_for("it is on the way", lambda: "on the way to the place you chose" in self.text("#plain"))
        self.tap_on("#tool-look")

    # ------------------------------------------------------------------------------------------------ dark and light

    def palette(self, *names):
        return {name: read_colour(self.browser.execute_script("return getComputedStyle(document.documentElement).getPropertyValue(`--${arguments[0]}`)", name)) for name in names}

    def in_both_schemes(self):
        for scheme in ("dark", "light"):
            self.cdp("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
            yield scheme

    def assert_readable(self):
        texts = self.browser.execute_script(WRITTEN_TEXTS)
        self.assertGreater(len(texts), 3)
        faint = [(round(contrast(ink, ground), 2), name) for ink, ground, name in texts if contrast(ink, ground) < LEAST_CONTRAST]
        self.assertEqual(faint, [], "too faint to read")

    def test_3_all_text_can_be_read_in_the_dark_and_in_the_light(self):
        grounds = set()
        for scheme in self.in_both_schemes():
            for door in DOORS:
                with self.subTest(scheme=scheme, door=door):
                    self.open(door)
                    self.assert_readable()
                    self.picture(f"{scheme}_{door}")
            with self.subTest(scheme=scheme, door="swap"):
                self.open_swap()
                self.assert_readable()
                self.click("#dialog .end button:last-child")
            with self.subTest(scheme=scheme, door="picture of the world"):
                floor = self.palette("floor")["floor"]
                grounds.add(floor)
                for names, least in ((WRITTEN, LEAST_CONTRAST), (DRAWN, LEAST_GRAPHIC)):
                    faint = {name: round(contrast(colour, floor), 2) for name, colour in self.palette(*names).items() if contrast(colour, floor) < least}
                    self.assertEqual(faint, {}, "too faint on the floor")
        self.assertEqual(len(grounds), 2, "the page follows the scheme")

    # ------------------------------------------------------------------------------------------------ by keyboard

    def press(self, key):
        words = {"key": key, "code": "Space" if key == " " else key, "windowsVirtualKeyCode": KEYS[key] if key in KEYS else ord(key.upper())}
        self.cdp("Input.dispatchKeyEvent", type="keyDown", text={"Enter": "\r", " ": " "}.get(key, key if len(key) == 1 else ""), **words)
        self.cdp("Input.dispatchKeyEvent", type="keyUp", **words)

    def go_round(self):
        """Presses Tab until all was focused. Returns the names of what was, and of what did not look like it."""
        self.browser.execute_script(NAME_OF)
        self.browser.execute_script("document.activeElement.blur(); getSelection().removeAllRanges(); scrollTo(0, 0)")
        controls = set(self.browser.execute_script(CONTROLS))
        reached, unseen = set(), set()
        for _ in range(len(controls) + 12):
            self.press("Tab")
            name, looks_so = self.browser.execute_script(FOCUSED)
            reached.add(name)
            if name and not looks_so:
                unseen.add(name)
        controls &= set(self.browser.execute_script(CONTROLS))  # what the page has drawn anew meanwhile does not count
        return controls - reached, unseen, reached

    def tab_to(self, condition):
        """Presses Tab until the condition, a function of the focused element in JavaScript, holds."""
        for _ in range(150):
            self.press("Tab")
            if self.browser.execute_script(f"return ((each) => {condition})(document.activeElement)"):
                return
        self.fail(f"Tab does not reach {condition}")

    def test_4_tab_reaches_everything_and_shows_where_it_is(self):
        for door in DOORS:
            with self.subTest(door=door):
                self.open(door)
                missed, unseen, reached = self.go_round()
                self.assertEqual((missed, unseen), (set(), set()), "not reached, not seen to be reached")
                self.assertTrue(any(name.startswith("stop ") for name in reached))
                self.assertTrue(any(name.startswith(f"tab-{door} ") for name in reached))
                self.assert_named()

    def assert_named(self):
        """Everything that can be operated has a name for who hears the page."""
        nodes = self.cdp("Accessibility.getFullAXTree")["nodes"]
        named = [(node["role"]["value"], node.get("name", {}).get("value", "")) for node in nodes if not node["ignored"] and node["role"]["value"] in NEED_NAMES]
        self.assertGreater(len(named), 8)
        self.assertEqual([role for role, name in named if name.strip() == ""], [], "without a name")

    def test_5_everything_is_done_by_keyboard(self):
        self.open("world")
        self.tab_to("each.id === 'tab-world'")
        self.press("ArrowRight")
        self.assertTrue(self.part("#view-system").is_displayed())
        wait_for("the graph", lambda: self.browser.find_elements("css selector", "#graph [data-component=goto]"))
        self.tab_to("each.dataset.component === 'goto'")
        self.press("Enter")
        wait_for("its values", lambda: self.browser.find_elements("css selector", '#inspector [aria-label="goto.max_speed"]'))
        self.tab_to("each.ariaLabel === 'goto.max_speed'")
        self.browser.execute_script("document.activeElement.select()")
        self.cdp("Input.insertText", text="0.43")
        self.press("Enter")
        wait_for("the new value", lambda: self.rows_of("get", "goto.max_speed")[0]["value"] == "0.43")

        self.tab_to("each.textContent === 'Swap code …'")
        self.press(" ")
        wait_for("the dialog", lambda: self.part("#dialog").is_displayed() and self.part("#swap-choice").is_enabled())
        self.assertTrue(self.browser.execute_script("return document.activeElement.closest('#dialog') !== null"), "the focus is in the dialog")
        self.assert_named()
        self.tab_to("each.textContent === 'Try'")
        self.press("Enter")
        wait_for("the verdict", lambda: "can take the place of goto" in self.text("#dialog .verdict"), 60)
        self.press("Escape")
        self.assertFalse(self.part("#dialog").is_displayed(), "Escape closes it")
        self.release_motors("Enter")

        self.tab_to("each.id === 'stop'")
        self.press(" ")
        self.release_motors(" ")

        self.tab_to("each.id === 'tab-system'")
        self.press("ArrowLeft")
        self.tab_to("each.id === 'map'")
        before = self.scale()
        self.press("+")
        wait_for("it zooms", lambda: self.scale() > 1.1 * before)
        self.press("0")
        self.press("d")
        self.press("Enter")
        wait_for("it is on the way", lambda: "on the way to the place you chose" in self.text("#plain"))

    def release_motors(self, key):
        """The motors are held, and let go by a key."""
        wait_for("the motors are held", lambda: self.part("#release").is_displayed())
        self.tab_to("each.id === 'release'")
        self.press(key)
        wait_for("the motors are free", lambda: not self.part("#release").is_displayed())

    # ------------------------------------------------------------------------------------------------ colour-blind eyes

    def test_6_no_colour_says_anything_alone(self):
        for scheme in self.in_both_schemes():
            with self.subTest(scheme=scheme):
                colours = self.palette(*itertools.chain(*SAME_SHAPE))
                for vision, names in itertools.product(VISIONS, SAME_SHAPE):
                    for one, other in itertools.combinations(names, 2):
                        self.assertGreater(difference(colours[one], colours[other], vision), LEAST_DIFFERENCE, f"{one} and {other}, {vision}")
        strokes, texts = self.browser.execute_async_script(STROKES)
        dashed = {"motion": False, "wish": False, "trail": False, "command": True, "path": True}
        self.assertEqual({name: strokes[name] for name in dashed}, dashed)
        self.assertIn("goto", texts, "a wish has the name of who wishes")
        kinds = {}
        for mark, kind in self.browser.execute_async_script(MARKS, STATES):
            kinds.setdefault(mark, set()).add(kind)
        self.assertEqual({mark: kind for mark, kind in kinds.items() if len(kind) > 1}, {}, "a mark means one thing")


if __name__ == "__main__":
    main()
