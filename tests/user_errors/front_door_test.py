#!/usr/bin/env python3
"""front_door_test.py SOURCE: ./couloir on machines that have some, all or none of the packages.

A copy of the script, with nothing on its PATH but a few tools and what stands here for dpkg-query, apt-get, sudo and cmake: nothing is
installed or built.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1])
TOOLS = ["bash", "cat", "dirname", "env", "grep", "mkdir", "nproc", "readlink", "rm", "sed", "tail"]

# As the real one: what it does not know is an error, and the others are listed all the same.
DPKG_QUERY = """#!/bin/bash
code=0
for word in "${@:3}"; do
  if grep -qx -- "$word" "$STATE/installed"; then printf 'installed %s\\n' "$word"
  elif grep -qx -- "$word" "$STATE/removed"; then printf 'config-files %s\\n' "$word"
  else printf 'dpkg-query: no packages found matching %s\\n' "$word" >&2; code=1; fi
done
exit $code
"""
APT_GET = """#!/bin/bash
printf '%s\\n' "$*" >>"$STATE/apt"
if [ -e "$STATE/fail-$1" ]; then printf 'E: the mirror is gone\\n' >&2; exit 100; fi
[ "$1" = install ] || exit 0
for word in "$@"; do case $word in install | -*) ;; *) printf '%s\\n' "$word" >>"$STATE/installed" ;; esac; done
"""
CMAKE = """#!/bin/bash
printf '%s\\n' "$*" >>"$STATE/cmake"
if [ -e "$STATE/fail-cmake" ]; then printf 'CMake Error: no compiler\\n' >&2; exit 1; fi
mkdir -p "$HERE/build/release/bin"
printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\\n' "$HERE" >"$HERE/build/release/CMakeCache.txt"
printf '' >"$HERE/build/release/build.ninja"
printf '#!/bin/bash\\nprintf "the program got %%s\\\\n" "$*"\\n' >"$HERE/build/release/bin/couloir"
"$STATE/chmod" +x "$HERE/build/release/bin/couloir"
"""


class FrontDoor(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.dir = pathlib.Path(folder.name).resolve()
        self.path, self.state, self.here = self.dir / "path", self.dir / "state", self.dir / "couloir here"
        for made in (self.path, self.state, self.here):
            made.mkdir()
        shutil.copy(SOURCE / "couloir", self.here)
        for tool in TOOLS:
            (self.path / tool).symlink_to(shutil.which(tool))
        (self.state / "chmod").symlink_to(shutil.which("chmod"))
        for name, text in (("dpkg-query", DPKG_QUERY), ("apt-get", APT_GET), ("cmake", CMAKE), ("sudo", '#!/bin/bash\nexec "$@"\n')):
            self.put(name, text)
        self.user(0)
        for name in ("installed", "removed"):
            (self.state / name).write_text("")

    def put(self, name, text):
        (self.path / name).write_text(text)
        (self.path / name).chmod(0o755)

    def user(self, number):
        self.put("id", f"#!/bin/bash\necho {number}\n")

    def couloir(self, *words):
        environment = {"PATH": str(self.path), "STATE": str(self.state), "HERE": str(self.here)}
        return subprocess.run([str(self.here / "couloir"), *map(str, words)], capture_output=True, text=True, env=environment, timeout=60)

    def told(self, name):
        path = self.state / name
        return path.read_text().splitlines() if path.exists() else []

    def asked_for(self):
        """What apt-get was to install."""
        return [w for line in self.told("apt") if line.startswith("install") for w in line.split()[1:] if not w.startswith("-")]

    def test_packages_that_the_machine_has_never_heard_of_are_installed(self):
        (self.state / "installed").write_text("g++\ncmake\npython3\n")
        (self.state / "removed").write_text("ninja-build\n")  # was there once: its settings still are
        done = self.couloir("plan", "a scene.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "the program got plan a scene.yaml\n")
        asked = self.asked_for()
        for package in ("ninja-build", "libp4est-dev", "liggghts", "python3-h5py"):
            self.assertIn(package, asked)
        for package in ("g++", "cmake", "python3", "libyade"):
            self.assertNotIn(package, asked)
        self.assertIn("installing Debian packages: ninja-build ", done.stderr)

    def test_none_of_the_packages_and_a_user_with_sudo(self):
        self.user(1000)
        done = self.couloir("plan", "a.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("g++", self.asked_for())

    def test_nothing_is_installed_twice(self):
        self.assertEqual(self.couloir("plan", "a.yaml").returncode, 0)
        (self.state / "apt").unlink()
        done = self.couloir("plan", "a.yaml")
        self.assertEqual((done.returncode, done.stderr, self.told("apt")), (0, "", []))

    def test_yade_only_where_it_is_asked_for(self):
        scene, other = self.dir / "yade.yaml", self.dir / "scene.yml"
        for file in (scene, other):
            file.write_text("grains:\n  engine: yade\n")
        for words in (["run", "a.yaml", "--set", "grains.engine=yade"], ["calibrate", "quartz", "--engine", "yade"],
                      ["calibrate", "quartz", "--engine=yade"], ["run", scene], ["run", other], ["run", self.dir]):
            (self.state / "installed").write_text("")
            (self.state / "apt").unlink(missing_ok=True)
            self.assertEqual(self.couloir(*words).returncode, 0)
            self.assertIn("libyade", self.asked_for(), words)

    def test_where_apt_fails(self):
        for step in ("update", "install"):
            (self.state / f"fail-{step}").touch()
            done = self.couloir("plan", "a.yaml")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("E: the mirror is gone", done.stderr)
            self.assertIn("the packages could not be installed; the whole log is build/install.log", done.stderr)
            self.assertIn("E: the mirror is gone", (self.here / "build/install.log").read_text())
            self.assertEqual(self.told("cmake"), [], "nothing is built")
            (self.state / f"fail-{step}").unlink()

    def test_a_user_who_may_not_install(self):
        self.user(1000)
        (self.path / "sudo").unlink()
        (self.state / "installed").write_text("g++\n")
        done = self.couloir("plan", "a.yaml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("these Debian packages are missing and there is no sudo to install them: cmake ", done.stderr)
        self.assertEqual(self.told("apt"), [])

    def test_where_configuring_fails(self):
        (self.state / "fail-cmake").touch()
        done = self.couloir("plan", "a.yaml")
        self.assertEqual(done.returncode, 3)
        self.assertIn("CMake Error: no compiler", done.stderr)
        self.assertIn("configuring failed; the whole log is build/release.log", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
