#!/usr/bin/env python3
"""command_line_test.py COULOIR SOURCE: the verb resume: what it says, refuses and prints."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

COULOIR, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SCENE = SOURCE / "tests/scenes/small_wall.yaml"


class Resume(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def couloir(self, *words, code):
        done = subprocess.run([COULOIR, *map(str, words)], capture_output=True, text=True, timeout=120, cwd=self.dir)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def broken(self, name="run", stop=signal.SIGINT):
        """A run that was stopped after its first checkpoint."""
        words = [COULOIR, "run", SCENE, "--mode", "continuum", "--set", "continuum.cell=4 mm", "--set", "record.checkpoint=2 ms",
                 "--no-report", "--out", name]
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, cwd=self.dir)
        while process.poll() is None and not (self.dir / name / "checkpoint/state").exists():
            time.sleep(0.001)
        os.kill(process.pid, stop)
        said = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 3 if stop == signal.SIGINT else -stop, said)
        return said

    def test_goes_on_where_the_message_says(self):
        said = self.broken()
        self.assertIn("couloir: interrupted; what was computed is in run; couloir resume run goes on from t = ", said)
        done = self.couloir("resume", "run", "--no-report", code=0)
        self.assertIn("goes on from the checkpoint at t = ", done.stderr)
        self.assertIn("run: run", done.stdout)
        again = self.couloir("resume", "run", code=2)
        self.assertIn("run: this run is done, there is nothing to go on with", again.stderr)

    def test_prints_the_summary_alone_with_json_after_a_kill(self):
        self.broken(stop=signal.SIGKILL)
        done = self.couloir("resume", "run", "--json", "--no-report", "--threads", 2, code=0)
        summary = json.loads(done.stdout)
        self.assertEqual(done.stderr, "")
        self.assertEqual(summary["status"], "done")
        self.assertEqual([r["reason"] for r in summary["resumed"]], ["resumed"])

    def test_refuses_what_is_no_run(self):
        self.assertIn("nowhere is no folder; name the folder of a run", self.couloir("resume", "nowhere", code=2).stderr)
        (self.dir / "empty").mkdir()
        self.assertIn("so it is not the folder of a run", self.couloir("resume", "empty", code=2).stderr)

    def test_refuses_a_run_without_a_checkpoint(self):
        self.broken()
        (self.dir / "run/checkpoint/state").unlink()
        self.assertIn("run: this run has no checkpoint", self.couloir("resume", "run", code=2).stderr)

    def test_refuses_a_scene_that_has_changed(self):
        self.broken()
        scene = self.dir / "run/scene.yaml"
        text = scene.read_text()
        scene.write_text(text.replace("cfl: 0.45", "cfl: 0.4"))
        said = self.couloir("resume", "run", code=2).stderr
        self.assertIn("the scene has changed since the checkpoint: '", said)
        self.assertIn("cfl: 0.45", said)
        scene.write_text(text)
        self.couloir("resume", "run", "--no-report", code=0)

    def test_run_says_that_an_unfinished_run_can_be_gone_on_with(self):
        self.broken()
        said = self.couloir("run", SCENE, "--out", "run", code=2).stderr
        self.assertIn("it holds an unfinished run, with which couloir resume run goes on", said)

    def test_missing_packings_are_run(self):
        settings = ["--set", "duration=20 ms", "--set", "grains.replicates=2"]
        self.couloir("run", SCENE, "--out", "run", "--no-report", *settings, code=0)
        summary = json.loads((self.dir / "run/summary.json").read_text())
        whole = summary.pop("replicates")
        (self.dir / "run/summary.json").write_text(json.dumps(summary))
        self.couloir("resume", "run", "--no-report", code=0)
        self.assertEqual(json.loads((self.dir / "run/summary.json").read_text())["replicates"], whole)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
