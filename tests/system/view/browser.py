# SPDX-License-Identifier: GPL-3.0-or-later
"""A browser without a screen, for tests."""
import os
import shutil
import sys

DEBIAN_PYTHON = "/usr/bin/python3"
SKIPPED = 77


def need_browser():
    """Leaves with the status of a skipped test if a part of the browser is missing. Debian's selenium is only in Debian's Python."""
    try:
        import selenium  # noqa: F401
    except ImportError:
        if os.path.exists(DEBIAN_PYTHON) and os.path.realpath(sys.executable) != os.path.realpath(DEBIAN_PYTHON):
            os.execv(DEBIAN_PYTHON, [DEBIAN_PYTHON, "-B", *sys.argv])
        skip("python3-selenium")
    for program, package in (("chromium", "chromium"), ("chromedriver", "chromium-driver")):
        if shutil.which(program) is None:
            skip(package)


def skip(package):
    print(f"SKIPPED: {package} is not installed; ./dev setup installs it")
    sys.exit(SKIPPED)


def start_browser(width, height, profile, *switches):
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for switch in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--force-device-scale-factor=1",
                   "--disable-dev-shm-usage", f"--window-size={width},{height}", f"--user-data-dir={profile}", *switches):
        options.add_argument(switch)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    extra = browser.execute_script("return window.outerHeight - window.innerHeight")
    browser.set_window_size(width, height + extra)
    return browser


def draw_at_most(browser, frames):
    """Lets the pages that a browser opens from now on draw at most so many frames per second."""
    browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {
        "source": f"{{ const next = requestAnimationFrame.bind(window); requestAnimationFrame = draw => setTimeout(() => next(draw), {1000 // frames}); }}"})
