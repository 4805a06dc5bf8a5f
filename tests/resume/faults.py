#!/usr/bin/env python3
"""faults.py COULOIR SOURCE [--rounds N] [--seed S] [--case NAME]... [--fault NAME]...

Breaks runs at random instants, goes on with `couloir resume` until they are done, and compares with the unbroken run: every
dataset, forces.csv, the XDMF files, the summary's figures.
"""
import argparse
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from same_run import differences  # noqa: E402

QUICK = ["record.frames=10 ms", "record.checkpoint=4 ms", "grains.timeout=3 s"]
CASES = {  # scene overrides, words beside them
    "continuum": (["mode=continuum", "continuum.cell=5 mm"], []),
    "adaptive": (["mode=continuum", "continuum.adapt={levels: 2, interval: 4}", "continuum.block=8"], ["--threads", "2"]),
    "coupled": (["duration=0.12 s"], []),
    "coupled_two_ranks": (["duration=0.12 s", "grains.ranks=2", "grains.timeout=10 s"], []),  # ranks beside other work may pause
    "coupled_yade": (["duration=0.08 s", "grains.engine=yade"], []),
    "grains": (["mode=grains", "duration=0.05 s", "record.checkpoint=2 ms"], []),
}


class Bench:
    def __init__(self, couloir, source, folder):
        self.couloir, self.scene, self.folder = couloir, source / "tests/scenes/small_wall.yaml", folder
        self.whole = {}  # case -> folder, seconds

    def words(self, case, out):
        settings, more = CASES[case]
        words = [self.couloir, "run", self.scene, "--out", out, "--no-report", *more]
        for s in QUICK + settings:
            words += ["--set", s]
        return [str(w) for w in words]

    def unbroken(self, case):
        if case not in self.whole:
            out, begin = self.folder / f"{case}_whole", time.monotonic()
            for _ in range(2):  # the first may settle the packing
                shutil.rmtree(out, ignore_errors=True)
                begin = time.monotonic()
                done = subprocess.run(self.words(case, out), capture_output=True, text=True)
                assert done.returncode == 0, done.stderr
            self.whole[case] = out, time.monotonic() - begin
        return self.whole[case]


def descendants(pid):
    parents = {}
    for entry in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = entry.read_text()
        except OSError:
            continue
        parents.setdefault(int(text.rsplit(")", 1)[1].split()[1]), []).append(int(entry.parent.name))
    found, look = [], [pid]
    while look:
        children = parents.get(look.pop(), [])
        found += children
        look += children
    return found


def workers(pid):
    """The engine's processes below this one, not mpirun."""
    out = []
    for child in descendants(pid):
        try:
            line = pathlib.Path(f"/proc/{child}/cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if b"mpirun" not in line[0] and any(b"couloir_" in word and b"_worker" in word for word in line[:3]):
            out.append(child)
    return sorted(out)


def told(process, number):
    """False where it had ended, or there was nobody to tell."""
    if process.poll() is not None:
        return False
    os.kill(process.pid, number)
    return True


def to_worker(number):
    def fault(process, chance):
        there = workers(process.pid) if process.poll() is None else []
        if not there:
            return False
        try:
            os.kill(chance.choice(there), number)
        except ProcessLookupError:
            return False
        return True
    return fault


FAULTS = {
    "interrupted": lambda process, chance: told(process, signal.SIGINT),
    "terminated": lambda process, chance: told(process, signal.SIGTERM),
    "killed": lambda process, chance: told(process, signal.SIGKILL),
    "worker_killed": to_worker(signal.SIGKILL),
    "worker_stopped": to_worker(signal.SIGSTOP),
    "file_limit": None,  # no process may make a file longer than a random limit
    "disk_full": None,   # a file system of a random size in memory; for root alone
}


class Disk:
    """A file system of a few hundred kB."""

    def __init__(self, place):
        self.place = place
        place.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "none", place], check=True)

    def resize(self, size):
        subprocess.run(["mount", "-o", f"remount,size={size}", self.place], check=True)

    def used(self):
        found = os.statvfs(self.place)
        return (found.f_blocks - found.f_bfree) * found.f_frsize

    def remove(self):
        subprocess.run(["umount", self.place], check=True)
        self.place.rmdir()


def limit_files(size):
    def before():
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))
    return before


def break_once(bench, case, fault, chance, words, instant, disk):
    """Starts it and breaks it after `instant` s. Returns its end: exit code, what it said, whether the fault hit."""
    before = None
    records = (bench.whole[case][0] / "records.h5").stat().st_size
    if fault == "file_limit":
        before = limit_files(int(records * chance.uniform(0.05, 0.95)))
    if disk:
        disk.resize(int(disk.used() + records * chance.uniform(0.05, 1.2)))
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, preexec_fn=before)
    hit = FAULTS[fault] is None
    if not hit:
        while "worker" in fault and process.poll() is None and not workers(process.pid):
            time.sleep(0.005)
        try:
            process.wait(instant)
        except subprocess.TimeoutExpired:
            hit = FAULTS[fault](process, chance)
    said = process.communicate(timeout=300)[1]
    return process.returncode, said, hit


EXPECTED = {"interrupted": {3}, "terminated": {3}, "killed": {-9}, "worker_killed": {0}, "worker_stopped": {0}, "file_limit": {3}, "disk_full": {3, 4}}


def one_round(bench, case, fault, chance, breaks):
    if fault != "disk_full":
        return break_and_compare(bench, case, fault, chance, breaks, bench.folder / f"{case}_{fault}", None)
    disk = Disk(bench.folder / "disk")
    try:
        return break_and_compare(bench, case, fault, chance, breaks, disk.place / "run", disk)
    finally:
        disk.remove()


def break_and_compare(bench, case, fault, chance, breaks, out, disk):
    """Breaks one run up to `breaks` times. Returns (how often it was broken, sentences that say what is wrong)."""
    whole, seconds = bench.unbroken(case)
    shutil.rmtree(out, ignore_errors=True)
    broken, wrong, words = 0, [], bench.words(case, out)
    for attempt in range(breaks):
        code, said, hit = break_once(bench, case, fault, chance, words, chance.uniform(0.02, 0.9) * seconds * (0.7 if "worker" in fault else 1), disk)
        log = out / "log.txt"
        broken += hit and (code != 0 or "goes on from the checkpoint" in (log.read_text() if log.exists() else ""))
        if hit and code not in EXPECTED[fault] | {0} and said:
            wrong.append(f"exit code {code}: {said}")
        if code == 0:
            break
        if not (out / "checkpoint/state").exists():  # before the first checkpoint there is nothing to go on from
            shutil.rmtree(out, ignore_errors=True)
            words = bench.words(case, out)
            continue
        words = [bench.couloir, "resume", str(out), "--no-report"]
        early = code in (-signal.SIGTERM, -signal.SIGINT) and not said  # before it listens to signals
        said_so = early or fault == "killed" or f"couloir resume {out} goes on" in said
        if not said_so:
            wrong.append(f"it did not name the way on: {said}")
    if not (out / "summary.json").exists() or '"status": "done"' not in (out / "summary.json").read_text():
        if disk:
            disk.resize("1g")
        if not out.exists():
            words = bench.words(case, out)
        done = subprocess.run(words, capture_output=True, text=True, timeout=600)
        if done.returncode != 0:
            return broken, wrong + [f"{' '.join(words)} ended with {done.returncode}: {done.stderr}"]
    return broken, wrong + differences(whole, out)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("couloir")
    arguments.add_argument("source", type=pathlib.Path)
    arguments.add_argument("--rounds", type=int, default=10)
    arguments.add_argument("--breaks", type=int, default=2, help="times that one run is broken, at most")
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--case", action="append", choices=CASES)
    arguments.add_argument("--fault", action="append", choices=FAULTS)
    given = arguments.parse_args()
    bad = 0
    with tempfile.TemporaryDirectory(prefix="couloir-faults-") as folder:
        bench = Bench(given.couloir, given.source, pathlib.Path(folder))
        for case in given.case or CASES:
            for fault in given.fault or FAULTS:
                if "worker" in fault and "mode=continuum" in CASES[case][0]:
                    continue
                if fault == "file_limit" and "grains.ranks=2" in CASES[case][0]:
                    continue  # MPI's ranks share files that are longer
                if fault == "disk_full" and os.geteuid() != 0:
                    continue
                chance = random.Random(f"{given.seed} {case} {fault}")
                broken, wrong = 0, []
                for count in range(given.rounds + 5):
                    if count >= given.rounds and broken > 0:
                        break  # more only where every instant missed the run
                    times, sentences = one_round(bench, case, fault, chance, given.breaks)
                    broken += times
                    wrong += sentences
                    runs = count + 1
                print(f"{case:18} {fault:15} {runs} runs, broken {broken} times: {'all the same' if not wrong else 'WRONG'}", flush=True)
                for sentence in wrong:
                    print("   ", sentence.strip()[:600], flush=True)
                bad += bool(wrong) or broken == 0
                if broken == 0:
                    print("    no run was broken: the instants miss it", flush=True)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
