#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page at its three addresses, in a browser: what a role may not do cannot be pressed and says why, also if the page is tampered with.

    tests/system/view/role_page_test.py [-k PART_OF_A_CASE'S_NAME] [--pictures FOLDER] BUILD_FOLDER
"""
import signal

from page_case import PageCase, main, wait_for
from selenium.webdriver.common.keys import Keys
from view_case import ROLES

ENDS_OF_CORRIDOR = ((1.2, 6.0), (9.0, 6.0))  # [m]
STEERING = ("#stop", "#tool-drive", "#tool-change", "#give-up", "#sensor-list input", "#goal-list button")
ORDERS = ("Suspend", "Swap code …", "Restart process")


class RolePage(PageCase):
    def open_as(self, role):
        self.browser.get(self.addresses[ROLES.index(role)])
        self.browser.refresh()  # another fragment loads nothing anew
        wait_for("its role", lambda: (role in self.text("#link")) == (role != "change") and "live" in self.text("#link"))
        self.click("#tab-world")
        wait_for("the robot is seen", self.place)
        wait_for("its name", lambda: self.text("#robot-name") == "Dewey")

    def assert_refused(self, selector, needed, role):
        """A control cannot be pressed, and says why."""
        reason = f"This takes the role {needed}; this address has {role}."
        wait_for(f"{selector} cannot be pressed", lambda: not self.part(selector).is_enabled() and self.part(selector).get_attribute("title") == reason)
        self.assertTrue(self.part(selector).is_displayed(), selector)

    def assert_offered(self, selector):
        wait_for(f"{selector} can be pressed", lambda: self.part(selector).is_enabled())
        self.assertNotIn("takes the role", self.part(selector).get_attribute("title"))

    def motors_are_held(self):
        return any(row["kind"] == "ESTOP" and row["active"] for row in self.rows_of("alarms"))

    def about(self, component):
        """Opens the view of a component; returns of each of its buttons whether it can be pressed, and what it says of that."""
        self.click("#tab-component")
        self.click(f'#component-list [data-name="{component}"]')
        wait_for("its values", lambda: self.browser.find_elements("css selector", f'#component [aria-label="{component}.max_speed"]'))
        # At one moment, since the page makes them anew.
        return self.browser.execute_script("""return Object.fromEntries(Array.from(document.querySelectorAll("#component button"),
            button => [button.textContent.trim(), {enabled: !button.disabled, title: button.title}]))""")

    def test_1_who_may_observe_sees_everything_and_presses_nothing(self):
        self.open_as("observe")
        self.assertIn("it looks, and gives no orders", self.text("#role"))
        for selector in STEERING:
            self.assert_refused(selector, "operate", "observe")
        self.picture("observe")
        self.part("body").send_keys(Keys.ESCAPE)
        self.part("#map").send_keys("d")
        self.assertNotEqual(self.part("#map").get_attribute("data-tool"), "drive")
        buttons = self.about("goto")
        for text in ORDERS:
            self.assertFalse(buttons[text]["enabled"], text)
        self.assertFalse(self.part('#component [aria-label="goto.max_speed"]').is_enabled())
        self.click("#tab-system")
        self.assert_refused("#graph-apply", "change", "observe")
        self.assertFalse(self.motors_are_held(), "the Esc key does no more than the button")

    def test_2_a_page_that_was_tampered_with_is_refused_by_the_server(self):
        self.open_as("observe")
        self.browser.execute_script("document.getElementById('stop').disabled = false; document.getElementById('stop').click()")
        wait_for("the refusal", lambda: 'STOP is not confirmed: "estop" takes the role operate, and this address has observe' in self.text("#notices"))
        self.assertFalse(self.motors_are_held())
        self.assertIn("by page as observe", self.orcactl("log", "audit").stdout)

    def test_3_who_may_operate_steers_and_changes_nothing(self):
        self.open_as("operate")
        self.assertIn("does not change its software", self.text("#role"))
        for selector in STEERING:
            self.assert_offered(selector)
        self.click("#tool-drive")
        self.mouse(self.pixel(max(ENDS_OF_CORRIDOR, key=self.distance)))
        wait_for("it is on the way", lambda: "on the way to the place you chose" in self.text("#plain"))
        self.click("#give-up")
        wait_for("it has no goal", lambda: "It has no goal" in self.text("#plain"))
        buttons = self.about("goto")
        self.assertTrue(buttons["Suspend"]["enabled"])
        for text in ORDERS[1:]:
            self.assertFalse(buttons[text]["enabled"], text)
            self.assertIn("takes the role change", buttons[text]["title"])
        self.assertFalse(self.part('#component [aria-label="goto.max_speed"]').is_enabled())
        self.click("#tab-system")
        self.assert_refused("#graph-apply", "change", "operate")
        self.click("#stop")
        wait_for("the motors are held", self.motors_are_held)
        self.click("#release")
        wait_for("they are free", lambda: not self.motors_are_held())

    def test_4_a_stop_that_a_stopped_deployer_does_not_confirm_says_so(self):
        self.open_as("operate")
        self.system.send_signal(signal.SIGSTOP)
        try:
            self.click("#stop")
            wait_for("the warning", lambda: "STOP IS NOT CONFIRMED" in self.text("#notices"), 5)
        finally:
            self.system.send_signal(signal.SIGCONT)
        wait_for("the motors are held", self.motors_are_held)
        wait_for("the page says so", lambda: "All motors are held, confirmed after" in self.text("#notices"))
        self.click("#release")
        wait_for("they are free", lambda: not self.motors_are_held())

    def test_5_who_may_change_is_offered_everything(self):
        self.open_as("change")
        self.assertFalse(self.part("#role").is_displayed())
        for selector in STEERING:
            self.assert_offered(selector)
        buttons = self.about("goto")
        for text in ORDERS:
            self.assertTrue(buttons[text]["enabled"], text)


if __name__ == "__main__":
    main()
