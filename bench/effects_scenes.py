#!/usr/bin/env python3
"""Which effects run in a set of scenes, why, and what each costs: the tables and the picture of docs/results/effects.md.

    bench/effects_scenes.py [--rounds 5] [--picture docs/results/effects.png] [name...]

Runs each scene by `couloir run` and reads `effects` and `costs` of its summary. Friction, curvature and earth pressure are also
terms within the solver's loops, which no clock can see alone: the scene runs with and without them (`effects.<name>: off`) in turn,
and what is compared is the least processor time of a cell update over the rounds, since the flows differ.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "app/report"))
import costs  # noqa: E402

TERMS = ("basal_friction", "curvature", "earth_pressure")
INCLINE, CHUTE, WALL = "bench/scenes/incline.yaml", "experiments/chiou_wall", "tests/scenes/small_wall.yaml"
FRICTION = ["material.basal_friction_angle=24 deg"]
SHORT = ["duration=0.5 s", "mode=continuum"]
# name, scene, what is set, whether the terms within the loops are measured
SCENES = [
    ("incline", INCLINE, [], False),
    ("incline, friction", INCLINE, FRICTION, False),
    ("incline, friction, K", INCLINE, [*FRICTION, "continuum.closure=active_passive"], True),
    ("chute with an arc", CHUTE, [*SHORT, "obstacles={}"], True),
    ("wall as a step", CHUTE, SHORT, False),
    ("wall by elevation", CHUTE, [*SHORT, "obstacles.wall.method=elevation"], False),
    ("wall of planes", CHUTE, [*SHORT, "obstacles.wall.method=planes"], False),
    ("wall, refined twice", CHUTE, [*SHORT, "continuum.cell=10 mm", "continuum.adapt.levels=2"], False),
    ("wall by elevation, noc", CHUTE, [*SHORT, "obstacles.wall.method=elevation", "continuum.scheme=noc"], False),
    ("two obstacles", "experiments/slit_and_pillars", ["mode=continuum"], False),
    ("coupled, grains at a wall", WALL, [], False),
    ("grains alone at a wall", WALL, ["mode=grains"], False),
]


def run(scene, settings, more=()):
    """summary.json of the run."""
    with tempfile.TemporaryDirectory() as folder:
        words = [str(ROOT / "build/release/bin/couloir"), "run", str(ROOT / scene), "--json", "--no-report", "--out", folder + "/run"]
        for setting in [*settings, *more]:
            words += ["--set", setting]
        done = subprocess.run(words, capture_output=True, text=True, cwd=ROOT)
    if done.returncode:
        sys.exit(f"{' '.join(words)} ended with {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def update_time(summary):
    """[ns] of a cell update."""
    return 1e9 * summary["time"]["cpu_continuum"] / summary["continuum"]["cell_updates"]


def terms_of(scene, settings, summary, rounds):
    """effect -> share of a cell update's time that goes without it [-]."""
    on = [e["name"] for e in summary["effects"] if e["on"] and e["name"] in TERMS]
    least = {}
    for _ in range(rounds if on else 0):
        for name in ["", *on]:
            took = update_time(run(scene, settings, [f"effects.{name}=off"] if name else []))
            least[name] = min(took, least.get(name, took))
    return {name: 1 - least[name] / least[""] for name in on}


def by_effect(all_costs):
    own = {}
    for c in all_costs:
        own[c["effect"]] = own.get(c["effect"], 0) + c["share"]
    return own


def print_shares(names, found):
    """All scenes in one table; found: costs of each."""
    shares = [by_effect(f) for f in found]
    effects = [e for e in dict.fromkeys(e for s in shares for e in s) if e and max(s.get(e, 0) for s in shares) >= costs.SEEN]
    print(f"\n| share [%] | {' | '.join(e.replace('_', ' ') for e in effects)} | none |\n| --- |{' --- |' * (len(effects) + 1)}")
    for name, s in zip(names, shares):
        cells = [f"{100 * s[e]:.1f}" if s.get(e, 0) >= 0.0005 else "" for e in [*effects, None]]
        print(f"| {name} | {' | '.join(cells)} |")


def print_scene(name, scene, settings, summary, terms):
    own = by_effect(summary["costs"])
    words = " ".join(f"--set '{s}'" if " " in s or "{" in s else f"--set {s}" for s in settings)
    print(f"\n### {name[0].upper() + name[1:]}\n\n    ./couloir run {scene} {words}".rstrip())
    rate = summary["continuum"]["cell_updates_per_second"]
    print(f"\n{summary['time']['cpu']:.2g} s of processor time" + (f"; {rate / 1e6:.0f} million cell updates a second." if rate else "."))
    print("\n| effect | why | own parts | terms within the loops |\n| --- | --- | --- | --- |")
    for e in summary["effects"]:
        if e["on"]:
            share = f"{100 * own[e['name']]:.1f} %" if own.get(e["name"], 0) > 0 else ""
            term = f"{100 * terms[e['name']]:.0f} %" if e["name"] in terms else ""
            print(f"| {e['name']} | {e['reason']} | {share} | {term} |")
    print(f"| none of them | set-up, ledgers, records | {100 * own.get(None, 0):.1f} % | |")
    stray = sum(own.get(e["name"], 0) for e in summary["effects"] if not e["on"])
    print(f"\nOff: {', '.join(e['name'] for e in summary['effects'] if not e['on'])}; together {100 * stray:.2f} %.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", help="scenes; none: all")
    parser.add_argument("--rounds", type=int, default=5, help="runs with and without each term")
    parser.add_argument("--picture", type=pathlib.Path)
    parser.add_argument("--json", type=pathlib.Path, help="costs of each scene, as its summary has them")
    arguments = parser.parse_args()
    unknown = set(arguments.names) - {s[0] for s in SCENES}
    if unknown:
        parser.error(f"{', '.join(unknown)}: there is no such scene; there are {'; '.join(s[0] for s in SCENES)}")
    chosen = [s for s in SCENES if not arguments.names or s[0] in arguments.names]
    found = []
    for name, scene, settings, with_terms in chosen:
        summary = run(scene, settings)
        terms = terms_of(scene, settings, summary, arguments.rounds) if with_terms else {}
        print_scene(name, scene, settings, summary, terms)
        sys.stdout.flush()
        found.append(summary["costs"])
    print_shares([s[0] for s in chosen], found)
    if arguments.json:
        arguments.json.write_text(json.dumps(dict(zip([s[0] for s in chosen], found)), indent=1) + "\n")
    if arguments.picture:
        costs.shares(found, [s[0] for s in chosen], arguments.picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
