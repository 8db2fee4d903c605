# SPDX-License-Identifier: GPL-3.0-or-later
"""A browser without a screen, and a running system with its page, for tests."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

TREE = pathlib.Path(__file__).resolve().parents[3]
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


def start_browser(width=1280, height=800, profile=None):
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for switch in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--force-device-scale-factor=1",
                   "--disable-dev-shm-usage", f"--window-size={width},{height}", f"--user-data-dir={profile}"):
        options.add_argument(switch)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    extra = browser.execute_script("return window.outerHeight - window.innerHeight")
    browser.set_window_size(width, height + extra)
    return browser


def wait_for(what, condition, seconds=20):
    """Returns the first value of the condition that is not false; fails with `what` if there is none in time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.05)
    raise AssertionError(f"{what}: not within {seconds} s")


class System:
    """A deployer with orcaview beside it, in a folder of their own. Ends both with everything that they started."""

    def __init__(self, programs, graph, *words):
        self.programs = pathlib.Path(programs)
        self.folder = tempfile.TemporaryDirectory(prefix="orca_view_")
        self.environment = {**os.environ, "XDG_RUNTIME_DIR": self.folder.name}
        self.log = open(pathlib.Path(self.folder.name) / "log", "w+", encoding="utf-8")
        self.deployer = self._start("deployer", str(TREE / "graphs" / graph), "--no-progress", *words, stdout=self.log, stderr=self.log)
        self.view = self._start("orcaview", pathlib.Path(graph).stem, "--port", "0", "--web", str(TREE / "web"), stdout=subprocess.PIPE, stderr=self.log)
        self.address = self.view.stdout.readline().strip()
        if not self.address.startswith("http"):
            self.end()
            raise AssertionError(f"orcaview printed no address: {self.address!r}")

    def _start(self, program, *words, **streams):
        return subprocess.Popen([self.programs / program, *words], env=self.environment, stdin=subprocess.DEVNULL, text=True, **streams)

    def orcactl(self, *words):
        """Returns what orcactl prints as JSON."""
        done = subprocess.run([self.programs / "orcactl", *words, "--json"], env=self.environment, capture_output=True, text=True, timeout=60)
        if done.returncode != 0:
            raise AssertionError(f"orcactl {' '.join(words)}: {done.stderr}")
        return json.loads(done.stdout) if done.stdout.strip() else []

    def follow(self, port):
        """Starts orcactl echo; its lines are objects with their text form."""
        return self._start("orcactl", "echo", port, "--json", stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)

    def words(self):
        """Returns what the programs have printed."""
        return pathlib.Path(self.log.name).read_text(encoding="utf-8")

    def end(self):
        for process in (self.view, self.deployer):
            if process.poll() is None:
                process.send_signal(signal.SIGTERM)
        for process in (self.view, self.deployer):
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        if self.view.stdout is not None:
            self.view.stdout.close()
        self.log.close()
        self.folder.cleanup()
