#!/usr/bin/python3
"""Engines and modes on the same scenes, several packings each: a table and a picture of the force in time, as docs/results/grains.md
and docs/results/coupling.md have them.

    packings.py RUN... --out PICTURE      runs of one or more scenes, by both engines, coupled or as grains, with several grains.seed

Runs are grouped by their scene (title), engine and mode; figures are mean and standard deviation over the packings.
"""
import argparse
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "app" / "report"))
import style  # noqa: E402
from read import Run, running_mean  # noqa: E402

COLOURS = {("LIGGGHTS", "grains"): style.BLUE, ("YADE", "grains"): style.RED, ("LIGGGHTS", "coupled"): style.ORANGE,
           ("YADE", "coupled"): style.GREEN, ("", "continuum"): style.GREY}


def far(run, share=0.99):
    """[m] along the slope that the last `share` of the grains in the last frame has not passed."""
    grains = run.frames[-1].grains()
    order = np.argsort(grains["s"])
    volume = np.cumsum(grains["radius"][order] ** 3)
    return float(grains["s"][order][np.searchsorted(volume, share * volume[-1])])


def figures(run):
    (wall,) = run.summary["obstacles"].values()
    grains, time = run.summary["grains"], run.summary["time"]
    return {
        "peak of 15 ms [N]": wall["force_peak"],
        "impulse [N s]": wall["impulse"],
        "force at the end [N]": wall["force_final"],
        "first contact [s]": wall["first_contact"],
        "overtopped [g]": 1e3 * run.summary["mass"]["overtopped"],
        "run-out of 99 % [m]": far(run) if run.summary["mode"] == "grains" else np.nan,
        "largest overlap [d]": grains["max_overlap"],
        "largest momentum residual": run.summary["momentum"]["relative_residual"],
        "processor time [s]": time["cpu"],
        "million particle-steps a second of it": 1e-6 * grains["particle_steps"] / time["cpu_engine"] if time["cpu_engine"] else 0.0,
    }


def shown(values):
    if np.isnan(values).all():
        return "-"
    spread = f" ± {values.std(ddof=1):.2g}" if len(values) > 1 else ""
    return f"{values.mean():.4g}{spread}"


def label(kind):
    engine, mode = kind
    return mode if mode == "continuum" else engine if mode == "grains" else f"{engine}, {mode}"


def table(scene, runs):
    rows = {kind: [figures(run) for run in runs[scene, kind]] for kind in COLOURS if (scene, kind) in runs}
    heads = [f"{label(kind)}, {len(found)} packing{'s' if len(found) > 1 else ''}" for kind, found in rows.items()]
    print(f"\n{scene}\n\n| | " + " | ".join(heads) + " |")
    print("| --- " * (1 + len(rows)) + "|")
    for name in next(iter(rows.values()))[0]:
        print(f"| {name} | " + " | ".join(shown(np.array([row[name] for row in found])) for found in rows.values()) + " |")


def history(run):
    (force,) = run.forces.values()
    return force["time"], running_mean(force["time"], run.windows["length"], force["fx"])


def picture(scenes, runs, path):
    figure, axes = style.plt.subplots(len(scenes), 1, figsize=(style.WIDTH, 3.4 * len(scenes)), squeeze=False, layout="constrained")
    for a, scene in zip(axes.flat, scenes):
        for kind, colour in COLOURS.items():
            found = [history(run) for run in runs.get((scene, kind), [])]
            if not found:
                continue
            times = found[0][0]
            every = np.array([np.interp(times, t, mean) for t, mean in found])
            for mean in every:
                a.plot(times, mean, color=colour, linewidth=0.6, alpha=0.5)
            if len(every) > 1:
                middle, scatter = every.mean(axis=0), every.std(axis=0, ddof=1)
                a.fill_between(times, middle - scatter, middle + scatter, color=colour, alpha=0.2, linewidth=0)
            a.plot(times, every.mean(axis=0), color=colour, linewidth=2, label=f"{label(kind)}: mean and scatter of {len(every)} packings")
        a.set_title(scene)
        a.set_ylabel("force along the slope [N]\nmeans of 15 ms")
        a.set_xlim(left=0)
        a.set_ylim(bottom=0)
        a.legend(loc="upper right")
    axes.flat[-1].set_xlabel("time [s]")
    style.save(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="RUN")
    parser.add_argument("--out", required=True, help="the picture")
    options = parser.parse_args()
    runs = {}
    for path in options.runs:
        run = Run(path)
        mode = run.summary["mode"]
        engine = "" if mode == "continuum" else run.summary["engine"].split()[0]
        runs.setdefault((run.title, (engine, mode)), []).append(run)
    scenes = list(dict.fromkeys(scene for scene, _ in runs))
    for scene in scenes:
        table(scene, runs)
    picture(scenes, runs, options.out)


if __name__ == "__main__":
    main()
