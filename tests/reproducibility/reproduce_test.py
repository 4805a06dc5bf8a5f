#!/usr/bin/env python3
"""reproduce_test.py COULOIR SOURCE: runs made again from their own records: what is compared, said, kept and refused."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py

COULOIR, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SCENE = SOURCE / "tests/scenes/small_wall.yaml"
FINE = ["--mode", "continuum", "--set", "continuum.cell=4 mm", "--set", "record.checkpoint=2 ms"]
SHORT = ["--set", "duration=0.14 s", "--set", "record.frames=20 ms"]


class Reproduce(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def couloir(self, *words, code=0):
        done = subprocess.run([COULOIR, *map(str, words)], capture_output=True, text=True, timeout=300, cwd=self.dir)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def run_scene(self, mode, *more, scene=SCENE, name="run"):
        self.couloir("run", scene, "--mode", mode, "--no-report", "--out", name, *more)

    def same_bits(self, *words):
        done = self.couloir("reproduce", "run", *words)
        self.assertIn("expected: the same bits\nreproduced: the same bits\n", done.stdout)
        return done.stdout

    def interrupted(self, *words, folder):
        """What a verb says that is stopped once its run has a checkpoint."""
        process = subprocess.Popen([COULOIR, *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, cwd=self.dir)
        while process.poll() is None and not (self.dir / folder / "checkpoint/state").exists():
            time.sleep(0.001)
        os.kill(process.pid, signal.SIGINT)
        said = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 3, said)
        return said

    def record(self, name="run"):
        return h5py.File(self.dir / name / "records.h5", "r+")

    def test_continuum_with_other_threads(self):
        self.run_scene("continuum", "--set", "record.gauges={foot: {position: [390 mm, 0]}}")
        said = self.same_bits("--threads", 2)
        self.assertIn("  threads: 1; now 2\n", said)
        self.assertIn("the second run was removed", said)
        self.assertFalse((self.dir / "run-again").exists())

    def test_coupled_and_what_out_keeps(self):
        self.run_scene("coupled", *SHORT)
        self.assertIn("the second run: kept", self.same_bits("--out", "kept"))
        self.couloir("reproduce", "run", "--with", "kept")

    def test_grains(self):
        self.run_scene("grains", "--set", "duration=30 ms")
        self.same_bits()

    def test_each_packing(self):
        self.run_scene("coupled", *SHORT, "--set", "grains.replicates=2")
        said = json.loads(self.couloir("reproduce", "run", "--json").stdout)
        self.assertEqual([r["verdict"] for r in said["runs"]], ["same bits"] * 2)
        self.assertEqual([r["name"] for r in said["runs"]], ["seed 20011", "seed 20012"])
        shutil.rmtree(next((self.dir / "run/replicates").iterdir()))
        self.assertIn("is not there", self.couloir("reproduce", "run", "--with", "run", code=2).stderr)

    def edit_summary(self, edit, name="run"):
        file = self.dir / name / "summary.json"
        summary = json.loads(file.read_text())
        edit(summary)
        file.write_text(json.dumps(summary))

    def test_damaged_packings_are_told_before_the_second_run(self):
        self.run_scene("grains", "--set", "duration=10 ms", "--set", "grains.replicates=2")
        shutil.copytree(self.dir / "run", self.dir / "whole")
        no_run = "run/summary.json: its replicates name no run of seed 20011; couloir resume run runs what is missing"
        for edit in (lambda s: s["replicates"].update(runs=[]), lambda s: s["replicates"].pop("seeds"), lambda s: s.update(replicates=None),
                     lambda s: s["replicates"].update(seeds=[1, 2]), lambda s: s["replicates"].update(seeds=["a", None])):
            self.edit_summary(edit)
            self.assertIn(no_run, self.couloir("reproduce", "run", code=2).stderr)
            shutil.copy(self.dir / "whole/summary.json", self.dir / "run/summary.json")
        (self.dir / "run/summary.json").write_text("{")
        self.assertIn("run/summary.json, which names the runs of the packings, cannot be read; run the scene anew",
                      self.couloir("reproduce", "run", code=2).stderr)
        shutil.copy(self.dir / "whole/summary.json", self.dir / "run/summary.json")
        shutil.rmtree(self.dir / "run/replicates")
        said = self.couloir("reproduce", "run", code=2).stderr
        self.assertRegex(said, "the run of seed 20012, run/replicates/.*, is not there; couloir resume run runs what is missing")
        self.assertFalse((self.dir / "run-again").exists())
        self.couloir("resume", "run", "--no-report")
        self.couloir("reproduce", "run", "--with", "whole")

    def test_a_record_that_lacks_something_is_told_before_the_second_run(self):
        self.run_scene("continuum", "--set", "duration=60 ms", "--set", "record.gauges={foot: {position: [390 mm, 0]}}")
        shutil.copy(self.dir / "run/records.h5", self.dir / "whole.h5")
        for gone, what in {"forces": "group forces/wall", "stresses": "group stresses", "gauges": "group gauges/foot", "measures": "group measures", "frames/000000": "group frames/000000",
                           "windows/time": "dataset windows/time", "forces/wall/fx": "dataset forces/wall/fx",
                           "frames/000001/h": "dataset frames/000001/h", "events/text": "dataset events/text"}.items():
            with self.record() as file:
                del file[gone]
            said = self.couloir("reproduce", "run", code=2).stderr
            self.assertIn(f"run/records.h5 is damaged: it has no {what}; take a whole copy of it, or run the scene anew", said)
            self.assertFalse((self.dir / "run-again").exists())
            shutil.copy(self.dir / "whole.h5", self.dir / "run/records.h5")
        self.same_bits()

    def test_a_summary_that_is_not_of_the_record(self):
        self.run_scene("continuum")
        self.couloir("reproduce", "run", "--out", "again")

        def doubled(summary):
            summary["obstacles"]["wall"]["force_peak"] *= 2

        self.edit_summary(doubled)
        done = self.couloir("reproduce", "run", code=1)
        self.assertRegex(done.stdout, "summary.json is not of this record: obstacles.wall.force_peak [0-9.]+ for [0-9.]+\n"
                                      "NOT reproduced: the record is, but not its summary.json\n")
        with self.record() as file:
            file.attrs["git_revision"] = "of another time"
        self.couloir("reproduce", "run", "--with", "again", code=1)
        self.couloir("reproduce", "run", "--with", "again", "--tolerance", "60 %")
        (self.dir / "run/summary.json").write_text("{")
        self.assertIn("run/summary.json cannot be read", self.couloir("reproduce", "run", "--with", "again", code=1).stdout)
        (self.dir / "run/summary.json").unlink()
        said = json.loads(self.couloir("reproduce", "run", "--with", "again", "--json", code=1).stdout)
        self.assertIn("run/summary.json is missing", said["runs"][0]["summary"])
        self.assertEqual((said["reproduced"], said["runs"][0]["verdict"]), (False, "differs"))

    def test_a_run_that_was_resumed(self):
        self.interrupted("run", SCENE, *FINE, "--no-report", "--out", "run", folder="run")
        said = self.couloir("reproduce", "run", code=2).stderr
        self.assertIn("run: this run is not done, its record says interrupted", said)
        self.couloir("resume", "run", "--no-report")
        self.same_bits()

    def test_an_interrupted_second_run_can_be_gone_on_with(self):
        self.couloir("run", SCENE, *FINE, "--no-report", "--out", "run")
        said = self.interrupted("reproduce", "run", folder="run-again")
        self.assertIn("after couloir resume run-again, couloir reproduce run --with run-again compares the two", said)
        self.couloir("resume", "run-again", "--no-report")
        self.same_bits("--with", "run-again")

    def test_from_the_record_alone(self):
        """The scene's folder, its STL file and the material's file are not looked at again, nor an edited scene.yaml."""
        dam = self.dir / "dam"
        shutil.copytree(SOURCE / "experiments/catching_dam", dam)
        self.run_scene("continuum", "--set", "duration=0.1 s", "--set", "continuum.cell=40 mm", scene=dam)
        shutil.rmtree(dam)
        (self.dir / "run/scene.yaml").write_text("gone\n")
        self.same_bits()

    def test_other_numbers_of_the_same_build_are_a_failure(self):
        self.run_scene("continuum")
        with self.record() as file:
            file["forces/wall/fx"][200] += 1e-9
        done = self.couloir("reproduce", "run", code=1)
        self.assertIn("force on wall", done.stdout)
        self.assertIn("first other bits: forces/wall/fx row 200", done.stdout)
        self.assertIn("NOT reproduced: the same build on the same kind of machine must give the same bits", done.stdout)
        self.assertTrue((self.dir / "run-again/summary.json").exists(), "kept on difference")

    def test_numbers_of_another_build_are_held_to_a_tolerance(self):
        self.run_scene("continuum")
        with self.record() as file:
            most = max(abs(file["forces/wall/fx"][()]))
            file["forces/wall/fx"][200] += 0.01 * most
            file.attrs["git_revision"] = "of another time"
        said = self.couloir("reproduce", "run", "--out", "again", code=1).stdout
        self.assertIn("git revision: of another time; now ", said)
        self.assertIn("NOT reproduced: beyond the tolerance of 1e-06", said)
        said = self.couloir("reproduce", "run", "--with", "again", "--tolerance", "2 %").stdout
        self.assertIn("reproduced: not the same bits, but all quantities agree within 0.02", said)

    def test_refuses_what_cannot_be_compared(self):
        self.assertIn("nowhere is no folder", self.couloir("reproduce", "nowhere", code=2).stderr)
        (self.dir / "empty").mkdir()
        self.assertIn("holds no records.h5", self.couloir("reproduce", "empty", code=2).stderr)
        self.run_scene("continuum", "--set", "duration=50 ms")
        for words in (["--tolerance", "2 mm"], ["--tolerance", "much"]):
            self.assertIn("must be a share of at least 0, such as 1e-6 or 2 %", self.couloir("reproduce", "run", *words, code=2).stderr)
        self.run_scene("continuum", "--set", "duration=40 ms", name="other")
        self.assertIn("other is a run of another scene than run", self.couloir("reproduce", "run", "--with", "other", code=2).stderr)
        with self.record() as file:
            scene = file.attrs["scene"]
            file.attrs["scene"] = scene.replace("cfl:", "courant:")
        said = self.couloir("reproduce", "run", code=2).stderr
        self.assertIn("the scene in its record is none for this program", said)
        self.assertIn("courant is unknown", said)
        with self.record() as file:
            file.attrs["format_version"] = 7
        self.assertIn("its record is of layout 7, this program reads 1", self.couloir("reproduce", "run", code=2).stderr)
        (self.dir / "run/records.h5").write_bytes((self.dir / "run/records.h5").read_bytes()[:3000])
        self.assertIn("run: its record cannot be read", self.couloir("reproduce", "run", code=2).stderr)
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["empty", "other", "run"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
