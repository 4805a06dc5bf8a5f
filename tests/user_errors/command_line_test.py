#!/usr/bin/env python3
"""command_line_test.py COULOIR SOURCE: what a user types, the exit code and the sentence that comes back."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

COULOIR, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SMALL = SOURCE / "tests/scenes/small_wall.yaml"


def couloir(*words, **options):
    return subprocess.run([COULOIR, *map(str, words)], capture_output=True, text=True, timeout=300, **options)


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def scene(self, old, new):
        text = SMALL.read_text()
        self.assertIn(old, text)
        path = self.dir / "scene.yaml"
        path.write_text(text.replace(old, new))
        return path

    def expect(self, done, code, *parts):
        self.assertEqual(done.returncode, code, done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    def run_until_grains_start(self):
        run = subprocess.Popen([COULOIR, "run", str(SMALL), "--out", str(self.dir / "run"), "--no-report"], stderr=subprocess.PIPE,
                               stdout=subprocess.DEVNULL, text=True)
        log = self.dir / "run" / "log.txt"
        deadline = time.time() + 120
        while time.time() < deadline and not (log.exists() and "grains start" in log.read_text()):
            time.sleep(0.02)
        return run

    def test_a_window_or_a_step_too_long_for_the_flow(self):
        self.expect(couloir("run", SMALL, "--set", "grains.window=5000", "--out", self.dir / "run"), 2, "grains.window", "use at most")
        self.expect(couloir("run", SMALL, "--set", "grains.timestep=1 ms", "--out", self.dir / "run"), 2, "grains.timestep", "at most")
        self.assertFalse((self.dir / "run").exists(), "nothing is made for a scene that is wrong")

    def test_a_list_is_no_scene(self):
        (self.dir / "list.yaml").write_text("[1, 2]")
        self.expect(couloir("plan", self.dir / "list.yaml", "--mode", "grains"), 2, "list.yaml:1", "a scene is a mapping of keys")

    def test_a_misspelt_key(self):
        scene = self.scene("basal_friction_angle", "basal_frction_angle")
        self.expect(couloir("plan", scene), 2, "scene.yaml:9", "basal_frction_angle", "did you mean 'basal_friction_angle'?")

    def test_a_wrong_unit(self):
        self.expect(couloir("plan", self.scene("height: 30 mm", "height: 30 kg")), 2, "height", "mm")

    def test_a_wall_outside_the_domain(self):
        self.expect(couloir("run", self.scene("[400 mm, 0]", "[900 mm, 0]"), "--out", self.dir / "run"), 2, "wall", "domain")
        self.assertFalse((self.dir / "run").exists(), "nothing is made for a scene that is wrong")

    def test_grains_larger_than_the_flow_is_deep(self):
        self.expect(couloir("run", self.scene("  diameter: 6 mm\n  zone", "  diameter: 40 mm\n  zone"), "--out", self.dir / "run"), 2,
                    "diameter", "40 mm")

    def test_an_output_folder_that_cannot_be_written(self):
        (self.dir / "file").write_text("in the way")
        self.expect(couloir("run", SMALL, "--out", self.dir / "file" / "run"), 2, str(self.dir / "file"))

    def test_an_output_folder_that_is_not_empty(self):
        (self.dir / "run").mkdir()
        (self.dir / "run" / "precious").write_text("")
        self.expect(couloir("run", SMALL, "--out", self.dir / "run"), 2, "not empty", "--out")

    def test_a_missing_scene(self):
        self.expect(couloir("run", self.dir / "nothing.yaml"), 2, "nothing.yaml")

    def test_a_wrong_override(self):
        self.expect(couloir("plan", SMALL, "--set", "grains.sed=7"), 2, "grains.sed", "did you mean 'seed'?")
        self.expect(couloir("plan", SMALL, "--set", "grains.seed"), 2, "a key and a value")

    def test_an_unknown_verb(self):
        self.expect(couloir("fly"), 2, "no verb 'fly'", "check")

    def test_words_that_a_verb_does_not_take(self):
        for words, what, remedy in ((["run"], "SCENE is required", "couloir run --help"),
                                    (["run", SMALL, "--threads", "x"], "--threads", "couloir run --help"),
                                    (["check", "--nope", SMALL], "--nope", "couloir check --help"),
                                    (["--nope"], "required", "couloir --help")):
            done = couloir(*words)
            self.expect(done, 2, what, f"; {remedy} lists ")
            self.assertEqual(done.stderr.count("\n"), 1)

    def ranks(self, *words):
        """Two ranks, as the front door starts them."""
        environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        together = ["mpirun", "-q", "-n", "2", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1", "--mca",
                    "btl_vader_single_copy_mechanism", "none", COULOIR, *map(str, words), "--ranks", "2"]
        run = subprocess.Popen(together, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment, start_new_session=True)
        self.addCleanup(lambda: run.poll() is None and os.killpg(run.pid, signal.SIGKILL))
        return run

    def test_several_ranks_tell_once(self):
        (self.dir / "run").mkdir()
        (self.dir / "run" / "precious").write_text("")
        out = ["--mode", "continuum", "--out", self.dir / "run"]
        for words in (["run", self.dir / "nothing.yaml"], ["run", SMALL, "--threads", "x"], ["run", SMALL, *out],
                      ["run", SMALL, *out, "--set", "continuum.scheme=noc", "--set", "obstacles.wall.method=elevation"]):
            run = self.ranks(*words)
            _, errors = run.communicate(timeout=120)
            self.assertEqual(run.returncode, 2, errors)
            self.assertEqual(errors.count("error in the input"), 1, errors)

    def test_interrupted_ranks_save_their_state(self):
        """SIGUSR1 is what the front door makes of Ctrl-C: mpirun hands it on to the ranks."""
        run = self.ranks("run", SMALL, "--mode", "continuum", "--set", "continuum.cell=1 mm", "--out", self.dir / "run", "--no-report")
        forces = self.dir / "run" / "forces.csv"
        deadline = time.time() + 120
        while time.time() < deadline and not (forces.exists() and forces.stat().st_size > 200):
            time.sleep(0.02)
        run.send_signal(signal.SIGUSR1)
        _, errors = run.communicate(timeout=120)
        self.assertEqual(run.returncode, 3, errors)
        self.assertEqual(errors.count("couloir resume"), 1, errors)
        self.assertEqual(json.loads((self.dir / "run/summary.json").read_text())["status"], "interrupted")
        self.assertGreater((self.dir / "run/checkpoint/state").stat().st_size, 100000)

    def test_an_instruction_set_that_is_none(self):
        for word in ("avx1024", "AVX2"):
            self.expect(couloir("plan", SMALL, env={**os.environ, "COULOIR_ISA": word}), 2, word, "baseline, avx2 or avx512")
        plan = json.loads(couloir("plan", SMALL, "--json", env={**os.environ, "COULOIR_ISA": "baseline"}).stdout)
        self.assertEqual(plan["continuum"]["instruction_set"], "baseline")

    def beside(self, flow_rate):
        """The program in a folder of its own, with or without a program flow_rate that prints this."""
        program = self.dir / "couloir"
        shutil.copy(COULOIR, program)
        if flow_rate:
            (self.dir / "flow_rate").write_text(f"#!/bin/sh\ncat <<'END'\n{flow_rate}\nEND\n")
            (self.dir / "flow_rate").chmod(0o755)
        return program

    def test_bench_without_its_program(self):
        done = subprocess.run([self.beside(None), "bench"], capture_output=True, text=True)
        self.expect(done, 2, "./couloir bench", "libbenchmark-dev", "flow_rate")

    def test_bench_prints_what_its_program_measured(self):
        cases = [{"name": "effect/all/min_time:0.4/manual_time", "best": 7.25e7, "rate": 7e7, "bytes_per_cell": 141.5, "stepped_per_wet": 1},
                 {"name": "wet/1:64/manual_time", "best": 5e7, "rate": 4e7, "bytes_per_cell": 133, "stepped_per_wet": 6},
                 {"name": "stream/24kB", "best": 1.5e11, "rate": 1e11}]
        program = self.beside(json.dumps({"context": {"instruction_set": "avx2"}, "benchmarks": cases}))
        table = subprocess.run([program, "bench"], capture_output=True, text=True).stdout
        for line in (r"instructions avx2", r"all +72\.5 +70\.0 +141\.5 bytes a cell\n", r"1:64 .*6\.00 cells stepped", r"24kB +150\.0 +100\.0 GB/s\n"):
            self.assertRegex(table, line)
        found = json.loads(subprocess.run([program, "bench", "--json"], capture_output=True, text=True).stdout)
        self.assertEqual(found["cases"][0], {"group": "effect", "name": "all", "best": 7.25e7, "mean": 7e7, "bytes_per_cell": 141.5,
                                             "stepped_per_wet": 1})

    def test_a_report_of_no_run(self):
        self.expect(couloir("report", self.dir), 2, "is not a run folder")

    def kill_worker(self, run):
        children, deadline = [], time.time() + 60  # one that is started again may take a while
        while not children and time.time() < deadline:
            children = pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
        self.assertEqual(len(children), 1)
        os.kill(int(children[0]), signal.SIGKILL)

    def test_a_killed_worker_ends_with_4_and_the_state_named(self):
        run = self.run_until_grains_start()
        self.kill_worker(run)
        log, deadline = self.dir / "run/log.txt", time.time() + 60
        while time.time() < deadline and "goes on from the checkpoint" not in log.read_text():
            time.sleep(0.005)
        self.kill_worker(run)  # the second time
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 4, errors)
        self.assertIn("killed by signal 9", errors)
        self.assertIn(str(self.dir / "run"), errors)
        self.assertIn(f"couloir resume {self.dir / 'run'} goes on from t = ", errors)
        summary = json.loads((self.dir / "run/summary.json").read_text())
        self.assertEqual(summary["status"], "failed")

    def test_ctrl_c_saves_and_says_where(self):
        run = self.run_until_grains_start()
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 3, errors)
        self.assertIn(f"couloir resume {self.dir / 'run'} goes on from t = ", errors)
        self.assertEqual(json.loads((self.dir / "run/summary.json").read_text())["status"], "interrupted")

    def test_json_is_json_alone(self):
        done = couloir("run", SMALL, "--mode", "continuum", "--out", self.dir / "run", "--json", "--no-report")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads(done.stdout)
        self.assertEqual(summary["status"], "done")
        self.assertLessEqual(summary["mass"]["relative_error"], 1e-12)
        self.assertEqual(done.stderr, "")
        plan = couloir("plan", SMALL, "--json")
        self.assertEqual(json.loads(plan.stdout)["mode"], "coupled")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
