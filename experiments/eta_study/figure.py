#!/usr/bin/env python3
"""Draws Figures 6.3 and 6.4 from the runs of `couloir check experiments/eta_study`.

    /usr/bin/python3 experiments/eta_study/figure.py runs/check docs/results/eta_study.png

Lengths in the dissertation's units of 33.33 mm, times in units of 58.29 ms.
"""
import pathlib
import re
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

UNIT, CELL = 0.03333, 0.1
TIME_UNIT = (UNIT / 9.81) ** 0.5
FRONT, HEIGHT, LENGTH, HALF = 16.5, 2.4, 1.0, 2.4
ETAS = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
THIN = 0.018  # 1 % of the release's greatest depth


def records_by_eta(folder):
    """The runs with cells of 0.1 as (eta, duration) -> records; of several the latest."""
    runs = {}
    for run in sorted(pathlib.Path(folder).glob("*eta_study*/"), key=lambda path: path.stat().st_mtime):
        records = h5py.File(run / "records.h5")
        x, times = records["grid/x"][()] / UNIT, records["windows/time"][()]
        if abs(x[1] - x[0] - CELL) > 1e-6:
            continue
        eta = float(re.search(r"\beta: *([\d.eE+-]+)", (run / "scene.yaml").read_text()).group(1))
        runs[round(eta, 6), round(times[-1] / TIME_UNIT)] = records
    return runs


def frame_at(records, t):
    return min(records["frames"].values(), key=lambda frame: abs(frame["time"][()] / TIME_UNIT - t))


def side_view(axis, records, title):
    """The middle rows: depth above the slope, on the front plane (to the left of it) and on the top."""
    frame = frame_at(records, 9)
    x, y = records["grid/x"][()] / UNIT, records["grid/y"][()] / UNIT
    h = frame["h"][()][np.abs(y) < 0.15].mean(axis=0) / UNIT
    axis.add_patch(plt.Rectangle((FRONT, 0), LENGTH, HEIGHT, color="0.45", lw=0))
    for part in (x < FRONT, x > FRONT + LENGTH):
        axis.fill_between(x[part], 0, h[part], color="#d08a3c", lw=0)
    front, top = frame["planes/front"], frame["planes/top"]
    across = np.abs(front["b"][()] / UNIT) < 0.15
    on_front, on_top = front["h"][()][across].mean(axis=0) / UNIT, top["h"][()][across].mean(axis=0) / UNIT
    axis.fill_betweenx(front["a"][()] / UNIT, FRONT - on_front, FRONT, where=on_front > THIN / 5, color="#2c6fa6", lw=0, alpha=0.85)
    axis.fill_between(FRONT + top["a"][()] / UNIT, HEIGHT, HEIGHT + on_top, where=on_top > THIN / 5, color="#b3261e", lw=0)
    axis.set(xlim=(11, 19.5), ylim=(0, 6), aspect="equal")
    axis.set_title(title, fontsize=9)
    axis.tick_params(labelsize=7)


def from_above(axis, records, t):
    x, y = records["grid/x"][()] / UNIT, records["grid/y"][()] / UNIT
    h = frame_at(records, t)["h"][()] / UNIT
    image = axis.pcolormesh(x, y, np.ma.masked_less(h, THIN), vmin=0, vmax=1.5, cmap="viridis", rasterized=True)
    axis.add_patch(plt.Rectangle((FRONT, -HALF), LENGTH, 2 * HALF, fill=False, ec="k", lw=0.8))
    axis.set(aspect="equal", xlim=(0, 43), ylim=(-12, 12))
    axis.set_title(f"t = {t}", fontsize=9)
    axis.tick_params(labelsize=7)
    return image


def main():
    if len(sys.argv) != 3:
        sys.exit("figure.py: needs the folder of the check's runs and the picture's path: figure.py runs/check docs/results/eta_study.png")
    runs = records_by_eta(sys.argv[1])
    missing = [key for key in [(eta, 9) for eta in ETAS] + [(0.8, 24)] if key not in runs]
    if missing:
        sys.exit(f"figure.py: {sys.argv[1]} has no run for (eta, duration) {missing}; run couloir check experiments/eta_study first")
    figure = plt.figure(figsize=(13, 9.6), layout="constrained")
    upper, lower = figure.subfigures(2, 1, height_ratios=(1.05, 1))
    for axis, eta in zip(upper.subplots(2, 5, sharex=True, sharey=True).flat, ETAS):
        side_view(axis, runs[eta, 9], f"eta = {eta:g}")
    upper.suptitle("As Figure 6.3: t = 9, middle of the wall; depth on the slope (brown), on the front plane (blue), on the top "
                   "plane (red: overflow)", fontsize=10)
    axes = lower.subplots(2, 4, sharex=True, sharey=True)
    for axis, t in zip(axes.flat, (3, 6, 9, 12, 15, 18, 21, 24)):
        image = from_above(axis, runs[0.8, 24], t)
    lower.colorbar(image, ax=axes, label="depth", shrink=0.8)
    lower.suptitle("As Figure 6.4: eta = 0.8, depth from above, the slope falls to the right", fontsize=10)
    figure.savefig(sys.argv[2], dpi=90)


if __name__ == "__main__":
    main()
