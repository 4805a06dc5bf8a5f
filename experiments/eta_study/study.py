#!/usr/bin/env python3
"""The share of momentum that the edge before a wall keeps: runs the scene for eta = 0, 0.1 .. 0.9, prints the table, draws both figures.

    /usr/bin/python3 experiments/eta_study/study.py [--runs runs/eta_study] [--pictures docs/results]

Runs that exist are not run again. Lengths in the dissertation's units of 33.33 mm, times in units of 58.29 ms.
"""
import argparse
import json
import pathlib
import subprocess

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
UNIT = 0.03333
TIME_UNIT = (UNIT / 9.81) ** 0.5
ETAS = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
FRONT, HEIGHT, LENGTH, HALF = 16.5, 2.4, 1.0, 2.4
THIN = 0.018  # 1 % of the release's greatest depth


def run(eta, folder):
    if not (folder / "summary.json").exists():
        duration = 24 if eta == 0.8 else 9
        subprocess.run([ROOT / "couloir", "run", HERE, "--no-report", "--out", folder, "--set", f"obstacles.wall.eta={eta}",
                        "--set", f"duration={duration}"], check=True, stdout=subprocess.DEVNULL)
    return json.loads((folder / "summary.json").read_text()), h5py.File(folder / "records.h5")


def frame_at(records, t):
    frames = records["frames"].values()
    return min(frames, key=lambda f: abs(f["time"][()] / TIME_UNIT - t))


def climbed(frame):
    front = frame["planes/front"]
    a, wet = front["a"][()] / UNIT, (front["h"][()] / UNIT >= THIN).any(axis=0)
    return a[wet].max() + 0.5 * (a[1] - a[0]) if wet.any() else 0.0


def heap(frame, grid):
    x, y = grid["x"][()] / UNIT, grid["y"][()] / UNIT
    column = np.searchsorted(x, FRONT) - 1
    return frame["h"][()][np.abs(y) < HALF, column].max() / UNIT


def table(runs):
    print("| eta | climbed at t = 9 | highest climb | depth at the foot at t = 9 | overflow by t = 9 [% of the mass] |")
    print("| --- | --- | --- | --- | --- |")
    for eta, (summary, records) in runs.items():
        wall, at9 = summary["obstacles"]["wall"], frame_at(records, 9)
        over = np.interp(9 * TIME_UNIT, records["windows/time"][()], records["windows/overtopped"][()])
        print(f"| {eta:g} | {climbed(at9):.1f} | {wall['max_climbed'] / UNIT:.1f} | {heap(at9, records['grid']):.1f} | "
              f"{100 * over / summary['mass']['initial']:.2g} |")


def side_view(axis, frame, grid, title):
    """The middle rows: depth above the slope, and above the front plane (to the left of it)."""
    x, y = grid["x"][()] / UNIT, grid["y"][()] / UNIT
    h = frame["h"][()][np.abs(y) < 0.15].mean(axis=0) / UNIT
    before = x < FRONT
    behind = x > FRONT + LENGTH
    axis.add_patch(plt.Rectangle((FRONT, 0), LENGTH, HEIGHT, color="0.45", lw=0))
    for part in (before, behind):
        axis.fill_between(x[part], 0, h[part], color="#d08a3c", lw=0)
    front, top = frame["planes/front"], frame["planes/top"]
    b = front["b"][()] / UNIT
    on_front = front["h"][()][np.abs(b) < 0.15].mean(axis=0) / UNIT
    axis.fill_betweenx(front["a"][()] / UNIT, FRONT - on_front, FRONT, where=on_front > THIN / 5, color="#2c6fa6", lw=0, alpha=0.85)
    on_top = top["h"][()][np.abs(b) < 0.15].mean(axis=0) / UNIT
    axis.fill_between(FRONT + top["a"][()] / UNIT, HEIGHT, HEIGHT + on_top, where=on_top > THIN / 5, color="#b3261e", lw=0)
    axis.set(title=title, xlim=(11, 18.5), ylim=(0, 6), aspect="equal")
    axis.title.set_fontsize(9)
    axis.tick_params(labelsize=7)


def draw_side_views(runs, path):
    figure, axes = plt.subplots(2, 5, figsize=(13, 5.2), sharex=True, sharey=True, layout="constrained")
    for axis, (eta, (_, records)) in zip(axes.flat, runs.items()):
        side_view(axis, frame_at(records, 9), records["grid"], f"eta = {eta:g}")
    figure.supxlabel("along the slope [units of 33.33 mm]", fontsize=9)
    figure.supylabel("along its normal", fontsize=9)
    figure.suptitle("t = 9, middle of the wall: depth on the slope (brown), on the front plane (blue), on the top (red: overflow)",
                    fontsize=10)
    figure.savefig(path, dpi=110)


def draw_from_above(records, path):
    figure, axes = plt.subplots(2, 4, figsize=(13, 4.6), sharex=True, sharey=True, layout="constrained")
    x, y = records["grid/x"][()] / UNIT, records["grid/y"][()] / UNIT
    for axis, t in zip(axes.flat, (3, 6, 9, 12, 15, 18, 21, 24)):
        h = frame_at(records, t)["h"][()] / UNIT
        image = axis.pcolormesh(x, y, np.ma.masked_less(h, THIN), vmin=0, vmax=1.5, cmap="viridis", rasterized=True)
        axis.add_patch(plt.Rectangle((FRONT, -HALF), LENGTH, 2 * HALF, fill=False, ec="k", lw=0.8))
        axis.set(title=f"t = {t}", aspect="equal", xlim=(0, 43), ylim=(-12, 12))
        axis.title.set_fontsize(9)
        axis.tick_params(labelsize=7)
    figure.colorbar(image, ax=axes, label="depth", shrink=0.8)
    figure.suptitle("eta = 0.8: depth from above, flow from left to right (units of 33.33 mm and 58.29 ms)", fontsize=10)
    figure.savefig(path, dpi=110)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--runs", type=pathlib.Path, default=ROOT / "runs/eta_study")
    options.add_argument("--pictures", type=pathlib.Path, default=ROOT / "docs/results")
    given = options.parse_args()
    given.runs.mkdir(parents=True, exist_ok=True)
    runs = {eta: run(eta, given.runs / f"eta_{eta:g}") for eta in ETAS}
    table(runs)
    draw_side_views(runs, given.pictures / "eta_study_side.png")
    draw_from_above(runs[0.8][1], given.pictures / "eta_study_top.png")


if __name__ == "__main__":
    main()
