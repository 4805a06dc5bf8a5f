#!/usr/bin/python3
"""Pictures and tables of one run, or of several side by side.

    report.py RUN [RUN...] [--out DIR]

One run: RUN/report/index.html. Several: report/ beside the first. Prints nothing but errors.
Exit codes: 0 done, 2 a RUN is no run or the report cannot be written.
"""

import argparse
import html
import sys
from pathlib import Path

import budgets
import compare
import control_volume
import costs
import figures
import spectra
import stresses
import style
import terrain
from page import cards, effects_table, events_table, figures_table, number, page, picture, section
from player import player
from read import MODES, NoRun, Run

# (what, unit, path in summary.json): the rows of the key figures, group by group.
GROUPS = [
    ("Mass", [("released", "kg", "mass.initial"), ("entered", "kg", "mass.entered"),
              ("in the domain at the end", "kg", "mass.final"),
              ("left the domain", "kg", "mass.left_domain"), ("went over the obstacles", "kg", "mass.overtopped"),
              ("largest error over the released", "", "mass.relative_error"),
              ("largest momentum residual over the largest momentum", "", "momentum.relative_residual")]),
    ("Continuum", [("cells at the end", "", "continuum.cells"), ("steps", "", "continuum.steps"),
                   ("least depth before clipping", "m", "continuum.min_depth"),
                   ("cell updates a second", "1/s", "continuum.cell_updates_per_second")]),
    ("Grains", [("inserted", "", "grains.inserted"), ("returned to the continuum", "", "grains.returned"),
                ("most at one time", "", "grains.peak_count"), ("engine steps", "", "grains.steps"),
                ("grains times steps a second", "1/s", "grains.particle_steps_per_second"),
                ("largest overlap over diameter", "", "grains.max_overlap")]),
    ("Cost", [("simulated", "s", "time.simulated"), ("time waited", "s", "time.wall"), ("processor time", "s", "time.cpu"),
              ("of it continuum", "s", "time.cpu_continuum"), ("of it engine", "s", "time.cpu_engine"),
              ("of it coupling", "s", "time.cpu_coupling")]),
]
FORCES = [("peak force (mean of 15 ms)", "N", "force_peak"), ("its time", "s", "force_peak_time"),
          ("peak of a single window", "N", "force_peak_window"), ("mean force since the first contact", "N", "force_mean"),
          ("force at the end (last 50 ms)", "N", "force_final"), ("impulse", "N s", "impulse"),
          ("first contact", "s", "first_contact"), ("largest depth on its top", "m", "max_depth_on_top")]


def wanted(run, group):
    """Whether a group of figures says anything about this run."""
    needed = {"Continuum": "continuum.cells", "Grains": "grains.peak_count"}
    return group not in needed or bool(run.figure(needed[group]))


def key_figures(runs, names):
    obstacles = list(dict.fromkeys(name for run in runs for name in run.obstacles))
    groups = [(f"Force on {o}, along the slope", [(what, unit, [run.figure(("obstacles", o, key)) for run in runs])
                                                  for what, unit, key in FORCES]) for o in obstacles]
    groups.append(control_volume.group(runs))
    groups += stresses.groups(runs)
    groups += spectra.groups(runs)
    for title, rows in GROUPS:
        shown = [run if wanted(run, title) else None for run in runs]
        groups.append((title, [(what, unit, [run.figure(path) if run else None for run in shown]) for what, unit, path in rows]))
    return figures_table(names, groups)


def packings_table(run):
    """Mean and scatter of the forces over all packings."""
    if not run.packings:
        return ""
    groups = []
    for name, figures_of in run.summary["replicates"]["obstacles"].items():
        rows = [(what, unit, [figures_of[key][column] for column in ("mean", "scatter", "least", "largest")])
                for what, unit, key in FORCES if key in figures_of]
        groups.append((f"Force on {name}, along the slope", rows))
    groups += stresses.packing_groups(run.summary["replicates"])
    return figures_table(["mean", "scatter", "least", "largest"], groups)


def verdict_of(run):
    """One or two sentences: how it ended, the force, whether the sums close."""
    s = run.summary
    if not s:
        last = float(run.time[-1]) if len(run.time) else 0.0
        return f"Unfinished: the record ends at {number(last)} s and there is no summary."
    end = {"done": "Done", "interrupted": "Interrupted", "failed": "Failed"}.get(s["status"], s["status"])
    text = f"<b>{end}</b>: {number(s['time']['simulated'])} s simulated in {number(s['time']['wall'], 3)} s"
    text += f" ({s['reason']}). " if s.get("reason") else ". "
    for name, o in s["obstacles"].items():
        if o["first_contact"] is None:
            text += f"The flow did not touch {name}. "
        else:
            text += (f"Force on {name}: peak <b>{number(o['force_peak'], 3)} N</b> at {o['force_peak_time']:.3f} s, "
                     f"impulse <b>{number(o['impulse'], 3)} N s</b>. ")
    for name, of in run.summary.get("replicates", {}).get("obstacles", {}).items() if run.packings else []:
        peak, impulse = of["force_peak"], of["impulse"]
        text += (f"Over {len(run.packings)} packings: peak {number(peak['mean'], 3)} &plusmn; {number(peak['scatter'], 2)} N, "
                 f"impulse {number(impulse['mean'], 3)} &plusmn; {number(impulse['scatter'], 2)} N s. ")
    failed = s.get("replicates", {}).get("failed", [])
    if failed:
        text += (f"<b>{len(failed)} of {len(failed) + s['replicates']['count']} packings are missing</b>: "
                 + "; ".join(f"seed {f['seed']}, {html.escape(f['reason'])}" for f in failed) + ". ")
    return text + (f"In every window mass closes to {number(s['mass']['relative_error'], 2)} of the released, "
                   f"momentum to {number(s['momentum']['relative_residual'], 2)} of its largest.")


def about(run):
    a = run.attributes
    engine = run.figure("engine") or a["engine"]
    made_by = f"couloir {a['couloir_version']} ({a['git_revision']})"
    parts = [f"{run.mode} mode", engine, f"run {run.name}", made_by, a["start_time"]]
    return " · ".join(str(part) for part in parts if part)


def twice(draw, *arguments, caption):
    """The picture that draw(..., path) makes, and the same for a phone."""
    path = draw(*arguments)
    return picture(path, caption, path and style.narrow(draw, *arguments))


def side_caption(run, name):
    parts = ["grains within two diameters of it, coloured by speed"] if run.has_grains else []
    if run.has_flow:
        parts.append("line: surface of the flow" + (", in the zone the mean over a cell" if run.has_grains else ""))
    where = "the centre line" if name is None else f"the middle of {name}" if len(run.obstacles) > 1 else "the middle of the obstacle"
    return f"Section through {where}: {'; '.join(parts)}. Heights along the normal, not exaggerated."


def report_one(run, out):
    forces = [(run.figure(("obstacles", name, key)), unit, f"{what} on {name}") for name in run.obstacles
              for key, unit, what in (("force_peak", "N", "peak force"), ("impulse", "N s", "impulse"))]
    body = cards([*forces, (run.figure("mass.overtopped") if run.obstacles else None, "kg", "went over the obstacles"),
                  (run.figure("grains.peak_count") or None, "", "grains at most"), (run.figure("time.wall"), "s", "time waited")])
    body += player([run], [run.mode])
    body += section("Forces", twice(figures.forces, run, out / "forces.png",
                                    caption="Thin: mean of each window. Thick: running mean of 15 ms, whose peak is quoted"
                                    + ("; with its scatter, that of all packings. The peak is the first one's."
                                       if run.packings else ".")))
    body += section("One force by two measures", twice(control_volume.picture, run, out / "control_volume.png",
                                                       caption="What the obstacles feel, and what the material loses to them: "
                                                       "gravity less bed, sides and storage."))
    body += section("Spectrum", twice(spectra.picture, [run], [run.mode], out / "spectrum.png",
                                      caption="Welch's estimate with Hann's weights. What is exchanged once a window would stand "
                                      "out at the dashed lines."))
    body += section("Stresses", picture(stresses.one_run(run, out / "stresses.png"),
                                        "By the grains on parts of a front: into the face, along its height, across. Thick: "
                                        "running mean of 15 ms."))
    body += section("From above", picture(figures.top_view(run, out / "top.png"),
                                          "Depth of the flow with its outline" + ("; hatched: obstacles" if run.obstacles else "")
                                          + ("; dashed: the zone that the grains hold, where a thin flow shows as single grains."
                                             if any(len(frame.zones) for frame in run.frames) else ".")))
    body += section("The mesh over the flow", picture(figures.mesh_view(run, out / "mesh.png"),
                                                      "Outlines of the blocks: each has as many cells, at each level half as long."))
    body += section("On the terrain", picture(terrain.picture(run, out / "terrain.png"),
                                              "The centre line in true proportions; only heights above the bed are enlarged, along the normal."))
    body += section("From the side", "".join(picture(path, side_caption(run, name))
                                             for name, path in figures.side_views(run, out).items()))
    body += section("Packings", packings_table(run))
    body += section("Key figures", key_figures([run], ["value"]) if run.summary else "")
    body += section("Effects", effects_table(run.summary["effects"]) if run.summary.get("effects") else "")
    if run.summary.get("costs"):
        body += section("What it cost", picture(costs.shares([run.summary["costs"]], [run.mode], out / "costs.png"),
                                                "By the effect that asks for it; blue: the flow itself.") + costs.table(run.summary["costs"]))
    body += section("Events", events_table(run.events) if run.events else "")
    body += section("Mass and momentum", picture(budgets.ledger(run, out / "ledger.png"),
                                                 "Where the mass is, what changed the momentum, and what is left unexplained."))
    body += section("Counts", picture(budgets.counts(run, out / "counts.png"), "Numbers and rates against time."))
    return page(run.title, about(run), verdict_of(run), run.status == "done", body)


def cost(run):
    """Processor seconds for a simulated second, or None."""
    cpu, simulated = run.figure("time.cpu"), run.figure("time.simulated")
    return cpu / simulated if cpu and simulated else None


def ratio(value):
    """Two decimals, or two digits of what is small."""
    return f"{value:.2f}" if abs(value) >= 0.1 else f"{value:.2g}"


def ratio_table(runs, names, best):
    """Forces and cost over those of the most accurate run."""
    rows = []
    for name in runs[best].obstacles:
        for what, _, key in FORCES:
            if key in ("force_peak", "force_mean", "force_final", "impulse"):
                rows.append((f"{what} on {name}", ("obstacles", name, key)))
    rows += [("went over the obstacles", "mass.overtopped"), ("time waited", "time.wall"), ("processor time", "time.cpu"),
             ("processor time for a simulated second", cost)]
    entries = []
    for what, path in rows:
        values = [path(run) if callable(path) else run.figure(path) for run in runs]
        base = values[best]
        entries.append((what, "", [ratio(v / base) if v is not None and base else None for v in values]))
    return figures_table(names, [(f"Ratio to {names[best]}", entries)])


def places(run):
    """Of a run's obstacles: {name: where it stands and how large it is}."""
    return {name: tuple(float(o[key]) for key in ("x", "y", "length", "width", "height") if key in o) for name, o in run.obstacles.items()}


def report_several(runs, out):
    modes = [run.mode for run in runs]
    names = [run.mode if modes.count(run.mode) == 1 else run.name for run in runs]
    if len(set(names)) < len(names):  # runs of the same name in different folders
        names = [f"{name} ({k})" for k, name in enumerate(names, 1)]
    best = min(range(len(runs)), key=lambda k: MODES.index(runs[k].mode))
    told = []
    for k, run in enumerate(runs):
        if k == best:
            continue
        parts = []
        for obstacle in runs[best].obstacles:
            own, base = (r.figure(("obstacles", obstacle, "force_peak")) for r in (run, runs[best]))
            if own is not None and base:
                parts.append(f"peak on {obstacle} " + f"{100 * (own / base - 1):+.0f} %".replace("-", "\u2212"))
        own, base = cost(run), cost(runs[best])
        if own and base:
            parts.append(f"{number(base / own, 2)} times as fast" if own <= base else f"{number(own / base, 2)} times as slow")
        told.append(f"<b>{html.escape(names[k])}</b>: " + (", ".join(parts) or "nothing to compare"))
    ended = [run.status == "done" for run in runs]
    what = "the first of these runs" if len(set(modes)) == 1 else "of the mode that simulates most"
    verdict = f"Against <b>{html.escape(names[best])}</b>, {what}: " + "; ".join(told) + "."
    unlike = [word for word, of in (("titles", [run.title for run in runs]), ("obstacles", [places(run) for run in runs]))
              if any(one != of[0] for one in of)]
    verdict += f" They are not of one scene: their {' and '.join(unlike)} differ." if unlike else ""
    verdict += "" if all(ended) else " Not all runs are done: " + ", ".join(f"{n}: {r.status}" for n, r in zip(names, runs)) + "."
    covered = [run.figure("time.simulated") or 0 for run in runs]
    if max(covered) > 1.01 * min(covered):
        verdict += (f" They cover different times, {number(min(covered), 3)} s to {number(max(covered), 3)} s: impulses, "
                    "means and forces at the end do not compare.")
    body = player(runs, names)
    body += section("Forces", twice(compare.forces, runs, names, out / "forces.png",
                                    caption="Means of 15 ms, their peaks marked; faint: means of a window."))
    body += section("Spectra", twice(spectra.picture, runs, names, out / "spectrum.png",
                                     caption="Welch's estimate with Hann's weights; dashed: the windows' frequency and its harmonics."))
    body += section("Stresses", picture(stresses.several(runs, names, out / "stresses.png"),
                                        "By the grains on parts of a front: running means of 15 ms."))
    body += section("Ratios", ratio_table(runs, names, best))
    if all(run.summary.get("costs") for run in runs):
        body += section("What they cost", picture(costs.shares([run.summary["costs"] for run in runs], names, out / "costs.png"),
                                                  "By the effect that asks for it; blue: the flow itself."))
    body += section("Depth", picture(compare.depth(runs, names, out / "depth.png"), "Depth at the same instants, on one scale."))
    body += section("Key figures", key_figures(runs, names))
    title = runs[best].title if len({run.title for run in runs}) == 1 else "Comparison of runs"
    return page(title, " · ".join(f"{n}: {r.name}" for n, r in zip(names, runs)), verdict, all(ended), body)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", nargs="+", metavar="RUN", help="folder of a run")
    parser.add_argument("--out", type=Path, help="folder of the report")
    arguments = parser.parse_args()
    try:
        out = arguments.out
        runs = [Run(path) for path in arguments.runs]
        out = out or (runs[0].path if len(runs) == 1 else runs[0].path.resolve().parent) / "report"
        out.mkdir(parents=True, exist_ok=True)
        html = report_one(runs[0], out) if len(runs) == 1 else report_several(runs, out)
        (out / "index.html").write_text(html, encoding="utf-8")
    except NoRun as error:
        print(error, file=sys.stderr)
        return 2
    except (ValueError, KeyError) as error:
        print(f"the run's files are not whole: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"the report could not be written: {error.filename or out}: {error.strerror}; choose another --out", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
