#!/usr/bin/env python3
"""study_test.py COULOIR SOURCE: whole studies through the program: tables, runs that are used again, what stops and goes on."""
import csv
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy as np

COULOIR, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])

SPEED = "gauges.middle.max_speed"


def slab_speed(slope, friction=20):
    """Exact for the middle of a block that slides down for 0.1 s."""
    a = math.radians(slope)
    return 9.81 * (math.sin(a) - math.tan(math.radians(friction)) * math.cos(a)) * 0.1


class StudyTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)
        (self.dir / "slab").mkdir()
        (self.dir / "slab/scene.yaml").write_text((SOURCE / "tests/scenes/slab.yaml").read_text())

    def tearDown(self):
        self.folder.cleanup()

    def write(self, text):
        (self.dir / "slab/study.yaml").write_text(text)

    def study(self, *words, code=0, report=False):
        command = [COULOIR, "study", *words] + ([] if report else ["--no-report"])
        done = subprocess.run(command, capture_output=True, text=True, timeout=300, cwd=self.dir)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def rows(self, out="runs/study-slab"):
        with open(self.dir / out / "study.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def runs(self):
        return {p.name: p.stat().st_mtime_ns for p in (self.dir / "runs/check").iterdir()}


class Tables(StudyTest):
    def test_a_grid_in_csv_and_hdf5(self):
        self.write(f"""title: Slopes
quantities: [{{quantity: {SPEED}, unit: mm/s, name: speed}}, {SPEED} / time.simulated]
variants: {{default: {{}}, seed: {{continuum.scheme: noc}}}}
tables:
  - name: grid
    columns:
      - {{set: terrain.angle, values: [25 deg, 30 deg], name: slope}}
      - {{set: continuum.cell, values: [10 mm, 0.02]}}
""")
        done = self.study("slab", report=True)
        self.assertIn("8 done, 0 failed, 0 not run", done.stdout)
        rows = self.rows()
        self.assertEqual([(r["variant"], r["terrain.angle [deg]"], r["continuum.cell [mm]"]) for r in rows],
                         [(v, a, c) for v in ("default", "seed") for a in ("25", "30") for c in ("10", "20")])
        for r in rows:
            self.assertAlmostEqual(float(r[f"{SPEED} [mm/s]"]), 1000 * slab_speed(float(r["terrain.angle [deg]"])), delta=1)
            self.assertAlmostEqual(float(r[f"{SPEED} over time.simulated [(m/s)/s]"]), float(r[f"{SPEED} [mm/s]"]) / 100, delta=1e-9)
            self.assertEqual(r["hash"], r["run"].rsplit("-", 1)[1])
            summary = json.loads((self.dir / r["run"] / "summary.json").read_text())
            self.assertEqual(float(r[f"{SPEED} [mm/s]"]), summary["gauges"]["middle"]["max_speed"] / 0.001)
            self.assertEqual(float(r["cpu [s]"]), summary["time"]["cpu"])
            self.assertEqual(float(r["cell updates"]), summary["continuum"]["cell_updates"])
        self.compare_with_hdf5(rows)
        for name in ("grid.png", "index.html"):
            self.assertGreater((self.dir / "runs/study-slab" / name).stat().st_size, 5000)

    def compare_with_hdf5(self, rows):
        with h5py.File(self.dir / "runs/study-slab/study.h5") as file:
            self.assertEqual(file.attrs["study"], (self.dir / "slab/study.yaml").read_text())
            self.assertEqual(file.attrs["status"], "done")
            names = file.attrs["columns"].split("\n")
            self.assertEqual(sorted(names), sorted(file["rows"]))
            heads = list(rows[0])
            self.assertEqual(len(heads), len(names))
            for head, name in zip(heads, names):  # same order, and bit for bit
                data = file["rows"][name]
                self.assertTrue(data.attrs["description"] and data.attrs["role"], name)
                if h5py.check_string_dtype(data.dtype):
                    self.assertEqual([r[head] for r in rows], [v.decode() for v in data[()]])
                else:
                    self.assertEqual(head, name if data.attrs["unit"] == "1" else f"{name} [{data.attrs['unit']}]")
                    np.testing.assert_array_equal([float(r[head] or "nan") for r in rows], data[()])

    def test_a_search_and_its_reference(self):
        self.write(f"""tables:
  - name: critical
    search: {{key: material.basal_friction_angle, from: 20 deg, to: 28 deg, step: 0.5 deg, quantity: {SPEED}, bound: 0.1 m/s}}
    quantities: [critical, {{quantity: {SPEED}, unit: m/s}}]
    columns: [{{set: terrain.angle}}, {{reference: critical, unit: deg, source: u = m t}}]
    rows: [[30 deg, 24.78], [28 deg, ~]]
""")
        self.study("slab", "--jobs", "2")
        for r, slope, critical in zip(self.rows(), (30, 28), (25, 23)):
            self.assertLess(slab_speed(slope, critical), 0.1)
            self.assertGreater(slab_speed(slope, critical - 0.5), 0.1)
            self.assertEqual(float(r["critical [deg]"]), critical)
            self.assertAlmostEqual(float(r[f"{SPEED} [m/s]"]), slab_speed(slope, critical), delta=1e-3)  # of the critical run
            self.assertEqual(int(r["runs"]), 5)
        self.assertEqual([r["critical reference [deg]"] for r in self.rows()], ["24.78", ""])

    def test_json_and_dry_run(self):
        self.write(f"quantities: [{SPEED}]\ntables: [{{name: t, columns: [{{set: terrain.angle, values: [25 deg, 30 deg]}}]}}]\n")
        plan = json.loads(self.study("slab", "--dry-run", "--json").stdout)
        self.assertEqual([r["set"] for r in plan["rows"]], [{"terrain.angle": "25 deg"}, {"terrain.angle": "30 deg"}])
        self.assertTrue(all(r["planned"] > 0 and not r["done"] for r in plan["rows"]))
        self.assertFalse((self.dir / "runs").exists(), "a dry run makes nothing")
        out = json.loads(self.study("slab", "--json", "--out", "here").stdout)
        self.assertEqual(out["status"], "done")
        self.assertEqual([str(r[SPEED]) for r in out["rows"]], [r[f"{SPEED} [m/s]"] for r in self.rows("here")])
        self.assertTrue(all(r["done"] for r in json.loads(self.study("slab", "--dry-run", "--json").stdout)["rows"]))

    def test_mean_and_scatter_over_grain_seeds(self):
        (self.dir / "grains.yaml").write_text("""scene: small.yaml
modes: [continuum, coupled]
replicates: [20011, 5]
quantities: [obstacles.wall.impulse]
tables: [{name: wall, set: {duration: 0.2 s}}]
""")
        (self.dir / "small.yaml").write_text((SOURCE / "tests/scenes/small_wall.yaml").read_text())
        self.study("grains.yaml", "--out", "out", report=True)
        alone, *seeds = self.rows("out")
        self.assertEqual([r["seed"] for r in (alone, *seeds)], ["", "20011", "5"])
        values = [float(r["obstacles.wall.impulse [N s]"]) for r in seeds]
        self.assertNotEqual(values[0], values[1])
        for r in seeds:
            self.assertAlmostEqual(float(r["obstacles.wall.impulse mean [N s]"]), np.mean(values), delta=1e-12)
            self.assertAlmostEqual(float(r["obstacles.wall.impulse scatter [N s]"]), np.std(values, ddof=1), delta=1e-12)
            self.assertGreater(float(r["particle steps"]), 0)
        self.assertEqual(alone["obstacles.wall.impulse scatter [N s]"], "")
        self.assertIn("2 seeds", (self.dir / "out/index.html").read_text())


class Experiments(StudyTest):
    def test_every_study_can_be_read(self):
        for file in sorted((SOURCE / "experiments").glob("*/study.yaml")):
            for words in ([], ["--quick"]):
                self.assertTrue(json.loads(self.study(str(file), "--dry-run", "--json", *words).stdout)["rows"], file)


class Runs(StudyTest):
    def test_runs_are_used_again_and_only_new_ones_made(self):
        study = f"quantities: [{SPEED}]\ntables: [{{name: t, columns: [{{set: terrain.angle, values: [25 deg, 30 degMORE]}}]}}]\n"
        self.write(study.replace("MORE", ""))
        self.study("slab")
        before, table = self.runs(), (self.dir / "runs/study-slab/study.csv").read_text()
        self.assertEqual(len(before), 2)
        done = self.study("slab")
        self.assertEqual(done.stdout.count("; was there"), 2)
        self.assertEqual(self.runs(), before)
        self.assertEqual((self.dir / "runs/study-slab/study.csv").read_text(), table)
        self.write(study.replace("MORE", ", 35 deg"))
        self.study("slab")
        self.assertEqual({name: self.runs()[name] for name in before}, before)
        self.assertEqual(len(self.runs()), 3)

    def test_rows_that_share_a_run_count_its_cost_once(self):
        columns = "columns: [{set: terrain.angle, values: [25 deg, 30 deg]}]"
        self.write(f"quantities: [{SPEED}]\ntables: [{{name: a, {columns}}}, {{name: b, {columns}}}]\n")
        self.study("slab")
        rows = self.rows()
        self.assertEqual((len(rows), len(self.runs())), (4, 2))
        with h5py.File(self.dir / "runs/study-slab/study.h5") as file:
            self.assertAlmostEqual(file.attrs["total_cpu"], sum(float(r["cpu [s]"]) for r in rows) / 2, delta=1e-9)

    def test_what_dead_processes_left_is_removed(self):
        dead = subprocess.Popen(["true"])
        dead.wait()
        name = "slab-0123456789abcdef.part-"
        for process in (dead.pid, os.getpid()):
            (self.dir / "runs/check" / f"{name}{process}").mkdir(parents=True)
            (self.dir / "runs/check" / f"{name}{process}.log").write_text("")
        (self.dir / "runs/check" / f"notes.part-{dead.pid}").write_text("")
        self.write(f"quantities: [{SPEED}]\ntables: [{{name: t, columns: [{{set: terrain.angle, values: [25 deg]}}]}}]\n")
        self.study("slab")
        left = sorted(n for n in self.runs() if ".part" in n)
        self.assertEqual(left, [f"notes.part-{dead.pid}", f"{name}{os.getpid()}", f"{name}{os.getpid()}.log"])

    def test_a_kept_run_that_is_damaged_is_made_again(self):
        self.write(f"quantities: [{SPEED}]\ntables: [{{name: t, columns: [{{set: terrain.angle, values: [25 deg, 30 deg]}}]}}]\n")
        self.study("slab")
        table = [r[f"{SPEED} [m/s]"] for r in self.rows()]
        first, other = (self.dir / r["run"] for r in self.rows())
        summary = first / "summary.json"
        before = other.stat().st_mtime_ns
        for damage, fault in [(lambda: summary.write_text("{"), "summary.json cannot be read"),
                              (summary.unlink, "summary.json is missing"),
                              (lambda: summary.write_text("{}"), "summary.json does not say that it is done"),
                              (lambda: summary.write_text('{"status": ["done"]}'), "summary.json does not say that it is done"),
                              ((first / "records.h5").unlink, "records.h5 is missing")]:
            damage()
            self.assertEqual([r["done"] for r in json.loads(self.study("slab", "--dry-run", "--json").stdout)["rows"]], [False, True])
            said = self.study("slab").stderr
            self.assertEqual(said, f"couloir: {first.relative_to(self.dir)} is damaged ({fault}) and is made again\n")
            self.assertEqual([r[f"{SPEED} [m/s]"] for r in self.rows()], table)
            self.assertEqual(len(self.runs()), 2, "nothing is left beside them")
        self.assertEqual(other.stat().st_mtime_ns, before)

    def test_a_summary_of_another_form_fails_its_row_alone(self):
        self.write(f"quantities: [{SPEED}]\ntables: [{{name: t, columns: [{{set: terrain.angle, values: [25 deg, 30 deg]}}]}}]\n")
        self.study("slab")
        (self.dir / self.rows()[0]["run"] / "summary.json").write_text('{"status": "done", "time": 3}')
        self.study("slab", code=1)
        self.assertEqual([r["status"] for r in self.rows()], ["failed", "done"])
        self.assertIn("the quantity time.cpu is not in the run's summary.json", self.rows()[0]["reason"])

    def test_a_run_that_fails_is_a_row_and_the_others_go_on(self):
        (self.dir / "small.yaml").write_text((SOURCE / "tests/scenes/small_wall.yaml").read_text())
        (self.dir / "study.yaml").write_text("""scene: small.yaml
modes: [continuum]
quantities: [obstacles.wall.overflow]
tables:
  - name: planes
    set: {obstacles.wall.method: planes, obstacles.wall.eta: 1}
    columns: [{set: obstacles.wall.overflow, values: [error, warn]}]
""")
        done = self.study("study.yaml", "--out", "out", code=1, report=True)
        self.assertIn("1 done, 1 failed, 0 not run", done.stdout)
        failed, good = self.rows("out")
        self.assertEqual((failed["status"], good["status"]), ("failed", "done"))
        self.assertIn("ended with exit code 3: ", failed["reason"])
        self.assertIn("came over the upper edges of wall", failed["reason"])
        self.assertEqual((failed["obstacles.wall.overflow set"], good["obstacles.wall.overflow set"]), ("error", "warn"))
        self.assertEqual((failed["obstacles.wall.overflow [kg]"], failed["run"]), ("", ""))
        self.assertGreater(float(good["obstacles.wall.overflow [kg]"]), 0)

    def test_wrong_input_is_told_before_any_run(self):
        right = f"quantities: [{SPEED}]\ntables:\n  - name: t\n    columns: [{{set: terrain.angle, values: [25 deg]}}]\n"
        for old, new, message in [("columns", "colums", "study.yaml:4: colums is unknown; did you mean 'columns'?"),
                                  (SPEED, "gauges.midle.max_speed", "did you mean 'middle'?"),
                                  ("terrain.angle", "terrain.angel", "study.yaml:3: t, 25 deg: --set terrain.angel"),
                                  ("[25 deg]", "[25 deg, 95 deg]", "t, 95 deg: ")]:
            self.write(right.replace(old, new))
            self.assertIn(message, self.study("slab", code=2).stderr)
        self.assertFalse((self.dir / "runs").exists())
        self.write(right)
        (self.dir / "taken").mkdir()
        (self.dir / "taken/precious").write_text("")
        self.assertIn("choose another --out", self.study("slab", "--out", "taken", code=2).stderr)
        self.assertIn("there is no such file or folder", self.study("nowhere", code=2).stderr)
        self.assertIn("give another --variant", self.study("slab", "--variant", "seed", code=2).stderr)

    def test_interrupted_it_keeps_what_is_done_and_goes_on(self):
        # Each row takes about a second of one core.
        self.write(f"""quantities: [{SPEED}]
tables: [{{name: t, set: {{continuum.cell: 1.25 mm}}, columns: [{{set: terrain.angle, values: [25 deg, 28 deg, 31 deg, 34 deg]}}]}}]
""")
        whole = lambda: [p for p in (self.dir / "runs/check").glob("slab-*/summary.json") if ".part" not in str(p)]
        run = subprocess.Popen([COULOIR, "study", "slab", "--jobs", "1", "--no-report"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True, cwd=self.dir)
        deadline = time.time() + 120
        while time.time() < deadline and not ((self.dir / "runs/check").exists() and whole()):
            time.sleep(0.01)
        run.send_signal(signal.SIGINT)
        _, said = run.communicate(timeout=120)
        self.assertEqual(run.returncode, 3, said)
        kept = {p: p.stat().st_mtime_ns for p in whole()}
        self.assertIn(len(kept), (1, 2, 3))
        self.assertIn(f"interrupted; {len(kept)} of 4 rows are done and in runs/study-slab/study.csv", said)
        self.assertEqual(len(self.runs()), len(kept), "nothing half done is left")
        status = [r["status"] for r in self.rows()]
        self.assertEqual(status, ["done"] * len(kept) + ["not run"] * (4 - len(kept)))
        self.study("slab")
        self.assertEqual([r["status"] for r in self.rows()], ["done"] * 4)
        self.assertEqual({p: p.stat().st_mtime_ns for p in kept}, kept)



class Packings(StudyTest):
    """couloir run with grains.replicates."""

    def run_wall(self, *words, code=0):
        command = [COULOIR, "run", str(SOURCE / "tests/scenes/small_wall.yaml"), "--set", "grains.replicates=3", "--set",
                   "duration=0.15 s", "--out", "run", "--json", *words]
        done = subprocess.run(command, capture_output=True, text=True, timeout=300, cwd=self.dir)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return json.loads((self.dir / "run/summary.json").read_text())

    def test_every_force_has_a_mean_and_a_scatter(self):
        summary = self.run_wall()
        all = summary["replicates"]
        seed = 20011
        self.assertEqual((all["count"], all["seeds"], all["failed"]), (3, [seed, seed + 1, seed + 2], []))
        runs = [json.loads((self.dir / "run" / folder / "summary.json").read_text()) for folder in all["runs"]]
        for figure in ("force_peak", "impulse"):
            values = [run["obstacles"]["wall"][figure] for run in runs]
            self.assertEqual(len(set(values)), 3, "each packing has its own bits")
            self.assertAlmostEqual(all["obstacles"]["wall"][figure]["mean"], np.mean(values), delta=1e-12 * np.mean(values))
            self.assertAlmostEqual(all["obstacles"]["wall"][figure]["scatter"], np.std(values, ddof=1), delta=1e-9 * np.mean(values))
        page = (self.dir / "run/report/index.html").read_text()
        self.assertIn("Over 3 packings: peak", page)

    def test_nothing_in_a_continuum_is_random(self):
        self.assertNotIn("replicates", self.run_wall("--mode", "continuum", "--no-report"))


LADDER = f"""
ladder:
  quantities: [{{quantity: {SPEED}, unit: mm/s}}, gauges.middle.arrival]
  reference:
    - {{quantity: {SPEED}, value: {slab_speed(30)} m/s, source: exact}}
    - {{quantity: gauges.middle.arrival, value: 1 s, source: made up}}
  errors: [20 %, 0.001 %]
  rungs:
    - {{name: point, mode: mass point}}
    - {{name: coarse, set: {{continuum.cell: 40 mm}}}}
    - {{name: fine, set: {{continuum.cell: 20 mm}}}}
"""


class Ladders(StudyTest):
    def test_errors_costs_and_choices_in_all_files(self):
        self.write(LADDER)
        done = self.study("slab", "--keep", report=True)
        self.assertIn(f"{SPEED} against exact: 181.28 mm/s", done.stdout)
        self.assertIn("for 20 %: ", done.stdout)
        self.assertIn(f"ladder: slab/ladder.json", done.stdout)
        kept = json.loads((self.dir / "slab/ladder.json").read_text())
        self.assertEqual(kept, json.loads((self.dir / "runs/study-slab/ladder.json").read_text()))
        figures = kept["quantities"][0]["rungs"]
        for row, f in zip(self.rows(), figures):
            error = abs(float(row[f"{SPEED} [mm/s]"]) / 1000 / slab_speed(30) - 1)
            self.assertAlmostEqual(f["error"], error, delta=1e-12)
            self.assertAlmostEqual(float(row[f"{SPEED} error"]), error, delta=1e-12)
        self.assertEqual([r["rung"] for r in self.rows()], ["point", "coarse", "fine"])
        self.assertLess(figures[2]["error"], 0.01)
        self.assertTrue(figures[0]["front"], "nothing is cheaper than the point")
        with h5py.File(self.dir / "runs/study-slab/study.h5") as file:
            self.assertEqual(json.loads(file["ladder"][0]), kept)
        self.assertTrue((self.dir / "runs/study-slab/ladder.png").stat().st_size > 10000)
        self.assertIn("What accuracy costs", (self.dir / "runs/study-slab/index.html").read_text())

    def test_a_file_of_another_name_has_a_folder_of_its_own(self):
        (self.dir / "slab/accuracy.yaml").write_text(LADDER)
        self.study("slab/accuracy.yaml", "--dry-run")
        self.study("slab/accuracy.yaml")
        self.assertTrue((self.dir / "runs/study-slab-accuracy/ladder.json").exists())
        self.assertFalse((self.dir / "slab/ladder.json").exists())

    def test_what_keeps_no_ladder(self):
        self.write(LADDER)
        self.assertIn("the short ladder is none to go by", self.study("slab", "--keep", "--quick", code=2).stderr)
        self.write(f"tables: [{{name: a, quantities: [{SPEED}]}}]\n")
        self.assertIn("--keep keeps a ladder, but this study has none", self.study("slab", "--keep", code=2).stderr)


class Advise(StudyTest):
    def advise(self, *words, code=0):
        done = subprocess.run([COULOIR, "advise", *words], capture_output=True, text=True, timeout=60, cwd=self.dir)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_by_a_kept_ladder(self):
        self.write(LADDER)
        self.study("slab", "--keep")
        said = self.advise("slab", "--error", "20 %", "--ladders", ".").stdout
        self.assertIn("distance 0, much like this scene", said)
        self.assertRegex(said, "for 20 %: (coarse|fine)\n")
        command = said.split("couloir run ")[1].splitlines()[0]
        self.assertIn("mode=continuum", command)
        done = subprocess.run(f"{COULOIR} run {command} --no-report --out advised", shell=True, capture_output=True, text=True, cwd=self.dir,
                              timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        whole = json.loads(self.advise("slab", "--error", "0.2", "--ladders", "slab", "--json").stdout)
        self.assertLess(whole["error"], 0.2)
        self.assertEqual(whole["distance"], 0)
        self.assertIn("no rung, not even by the mean of 30 packings",
                      self.advise("slab", "--error", "0.001 %", "--ladders", ".", "--quantity", "gauges.middle.arrival", code=1).stdout)

    def test_refuses_what_it_cannot_answer(self):
        self.assertIn("--error is required", self.advise("slab", code=2).stderr)
        self.assertIn("--error much: must be a share", self.advise("slab", "--error", "much", code=2).stderr)
        self.assertIn("no model is exact", self.advise("slab", "--error", "0", code=2).stderr)
        self.assertIn("slab holds no ladder.json", self.advise("slab", "--error", "10 %", "--ladders", "slab", code=2).stderr)
        (self.dir / "slab/ladder.json").write_text("{")
        self.assertIn("slab/ladder.json: cannot be read as a ladder", self.advise("slab", "--error", "10 %", "--ladders", "slab", code=2).stderr)
        self.assertIn("there is no such file", self.advise("nowhere", "--error", "10 %", code=2).stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
