#!/usr/bin/env python3
"""calibrate_test.py COULOIR SOURCE: the verb, small: what it reaches, that it goes on after Ctrl-C, what it refuses."""
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

COULOIR, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])

# Slippery, so that few slabs are needed.
SCENE = """
material: {name: model, density: 1500, internal_friction_angle: 25 deg, basal_friction_angle: 17 deg, source: made up}
terrain: {kind: flat, length: 1, width: 1}
release: {kind: uniform, height: 10 mm}
mode: grains
duration: 1
grains: {diameter: 4 mm}
"""


class Calibrate(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)
        self.scene = self.dir / "scene.yaml"
        self.scene.write_text(SCENE)

    def tearDown(self):
        self.folder.cleanup()

    def words(self, *words):
        return [COULOIR, "calibrate", *map(str, words), "--quick", "--replicates", "2", "--jobs", "1", "--out", str(self.dir / "out")]

    def calibrate(self, *words, code=0):
        done = subprocess.run(self.words(*words), capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_it_reaches_delta_within_its_own_uncertainty_and_goes_on_after_ctrl_c(self):
        run = subprocess.Popen(self.words(self.scene), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        kept = self.dir / "out/measurements.jsonl"
        deadline = time.time() + 120
        while run.poll() is None and time.time() < deadline and not (kept.exists() and kept.read_text().count("measurement")):
            time.sleep(0.02)
        run.send_signal(signal.SIGINT)
        _, told = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 3, told)
        self.assertIn("the same command goes on", told)
        before = kept.read_text().splitlines()
        self.assertGreaterEqual(len(before), 1)
        self.assertFalse(list((self.dir / "out").glob("measurement-*")), "what was under way is removed")

        with kept.open("a") as file:
            file.write('{"made_by": "a line that was cut')
        result = json.loads(self.calibrate(self.scene, "--json").stdout)
        self.assertTrue(set(filter(None, before)) <= set(kept.read_text().splitlines()), "what was measured is used again")
        delta = result["delta"]
        self.assertTrue(delta["met"], delta)
        self.assertLessEqual(abs(delta["reached"] - 17), max(delta["uncertainty"], 1.2), "a quick search is content with 0.02 in tan")
        self.assertEqual(result["material"], "model")
        text = (self.dir / "out/calibration.yaml").read_text()
        self.assertIn("source: 'made up'", text)

        lines = kept.read_text()
        self.assertIn("written:", self.calibrate(self.scene).stdout)
        self.assertEqual(kept.read_text(), lines, "nothing is measured again")
        self.assertEqual((self.dir / "out/calibration.yaml").read_text(), text, "the same bytes")
        self.assertFalse((SOURCE / "dem_inputs/calibrations/model-liggghts-4mm.yaml").exists())

    def test_what_is_refused(self):
        def told(words, *parts):
            done = self.calibrate(*words, code=2)
            for part in parts:
                self.assertIn(part, done.stderr)

        told(["quarz"], "material 'quarz' is unknown", "did you mean 'quartz'?")
        told(["quartz", "--diameter", "5 kg"], "--diameter is '5 kg'")
        told(["quartz", "--diameter", "0 mm"], "no diameter above 0")
        told(["quartz", "--diameter", "4"], "grains of 4000 mm are beyond what is calibrated")
        told(["quartz", "--engine", "pfc3d"], "pfc3d")
        told(["quartz", "--replicates", "0"], "replicates")
        self.scene.write_text(SCENE.replace("25 deg", "0 deg").replace("17 deg", "0 deg"))
        told([self.scene], "the material model has no measured angles", "internal_friction_angle")
        self.scene.write_text(SCENE.replace(", basal_friction_angle: 17 deg", ""))
        told([self.scene], "basal_friction_angle")
        self.scene.write_text(SCENE.replace("17 deg", "0 deg").replace("name: model", "name: quartz"))
        told([self.scene], f"{self.scene}: the material", "-quartz has no measured angles")
        (self.dir / "out").mkdir()
        (self.dir / "out/letter.txt").write_text("keep me")
        told(["quartz"], "is not empty and no folder of a calibration")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
