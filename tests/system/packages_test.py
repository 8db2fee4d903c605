#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the Debian packages, installs them in a new Debian 12, and uses them there as a newcomer does.

    tests/system/packages_test.py BUILD

It needs root, debootstrap and a Debian mirror; without them it is skipped, and says so.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from page_reader import BUILD, TREE, Reader

SKIPPED = 77
MIRROR = "http://deb.debian.org/debian"
LIMIT = 300.0  # [s] from the first command of a newcomer to the own component that drives


def run(*words, limit=900, **options):
    """Returns what a command prints; it must succeed."""
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=limit, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, words))} ended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def skip(reason):
    print(f"SKIPPED: {reason}")
    sys.exit(SKIPPED)


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = pathlib.Path(tempfile.mkdtemp(prefix="orca_packages_"))
        cls.addClassCleanup(shutil.rmtree, scratch)
        cls.debian = scratch / "debian"
        made = subprocess.run(["debootstrap", "--variant=minbase", "bookworm", cls.debian, MIRROR], capture_output=True, text=True,
                              timeout=900)
        if made.returncode != 0:
            skip(f"debootstrap made no Debian from {MIRROR}: {made.stdout[-300:]}{made.stderr}")
        shutil.copy("/etc/resolv.conf", cls.debian / "etc/resolv.conf")
        (cls.debian / "etc/dpkg/dpkg.cfg.d/fast").write_text("force-unsafe-io\n")  # nobody keeps this Debian
        cls.packages = cls.debian / "packages"
        run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", scratch / "made")
        cls.made = sorted((scratch / "made").glob("*.deb"))
        cls.packages.mkdir()
        for package in cls.made:
            shutil.copy(package, cls.packages)

    def inside(self, folder="/root"):
        """The beginning of a command that runs in a folder of the new Debian, with processes of its own."""
        enter = 'mount --rbind /dev "$0/dev" && mount -t proc proc "$0/proc" && exec chroot "$0" "$@"'
        return ["env", "-i", "PATH=/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND=noninteractive", "ORCA=/usr/share/orca", "unshare", "--mount",
                "--pid", "--fork", "sh", "-c", enter, self.debian, "sh", "-c", 'cd "$0" && exec "$@"', folder]

    def call(self, *words):
        return run(*self.inside(), *words)

    def install(self, *names):
        """Installs packages, those of Orca from their files."""
        files = [f"/packages/{next(self.packages.glob(name + '_*')).name}" if name.startswith("orca-") else name for name in names]
        self.call("apt-get", "install", "-q", "-y", "--no-install-recommends", *files)

    def test_lintian_finds_nothing(self):
        if shutil.which("lintian") is None:
            self.skipTest("SKIPPED: lintian is not installed; ./dev package installs it")
        found = run("lintian", "--fail-on", "error,warning", "--allow-root", *self.made)
        self.assertEqual(found, "")

    def test_a_newcomer_drives_builds_and_tries(self):
        self.call("apt-get", "update", "-q")
        self.install("systemd")
        begin = time.monotonic()
        self.install("orca-runtime", "orca-simulator")
        self.assertIn("arrived meeting", self.call("deployer", "graphs/scout_goto.xml", "--clock", "virtual"))
        self.call("deployer", "graphs/scout_goto.xml", "--until", "2s")
        first_drive = time.monotonic() - begin
        self.install("orca-dev", "orca-tools", "ninja-build")
        installed = time.monotonic() - begin
        (self.debian / "hello").mkdir()
        reader = Reader("orcactl new", self.debian / "hello", pathlib.Path("/usr"), self.inside("/hello"))
        reader.run(reader.run("orcactl new component follow_light\n"))
        self.assertIn("100% tests passed, 0 tests failed out of 1", reader.out)
        self.assertIn("trace-hash", reader.out)
        self.assertNotIn("contact", reader.out)
        taken = time.monotonic() - begin
        print(f"first drive after {first_drive:.0f} s, compiler installed after {installed:.0f} s, own component drives after {taken:.0f} s")
        self.assertLess(taken, LIMIT)
        self.check_service()
        self.check_others()
        self.check_containerfile()

    def check_service(self):
        """The user is there, and systemd finds nothing wrong with the unit."""
        self.assertIn("orca", self.call("id", "orca"))
        unit = self.call("systemd-analyze", "verify", "--man=no", "orca@robot.service")
        self.assertEqual(unit, "")
        self.call("runuser", "-u", "orca", "--", "deployer", "graphs/scout_goto.xml", "--hold", "--until", "1s")

    def check_others(self):
        """The other packages can be installed, each program says what it does, and all of them can be removed again."""
        self.install("orca-web", "orca-drivers", "orca-doc")
        for program in ("orcactl", "orcaview", "hwprobe", "simbatch"):
            self.assertIn(program, self.call(program, "--help"))
        self.assertIn("orca.hw.P2os", self.call("deployer", "--types"))
        self.call("apt-get", "purge", "-q", "-y", "orca-*")
        self.assertEqual([path for path in self.debian.glob("usr/*/orca*")], [])

    def check_containerfile(self):
        """The last step of Containerfile makes an Orca that drives. Its first step is ./dev package in a new Debian."""
        text = (TREE / "Containerfile").read_text().replace("\\\n", "")
        self.assertIn("COPY --from=build /orca/build/release/packages /packages\n", text)
        self.call("sh", "-e", "-c", text.splitlines()[-1].removeprefix("RUN "))
        self.assertIn("arrived meeting", self.call("deployer", "graphs/scout_goto.xml", "--clock", "virtual"))
        self.assertIn("no system", self.call("sh", "-c", "orcaview 2>&1 || true"))


if __name__ == "__main__":
    if os.geteuid() != 0:
        skip("only root can make a Debian to install in")
    if shutil.which("debootstrap") is None:
        skip("debootstrap is not installed; ./dev package installs it")
    unittest.main()
