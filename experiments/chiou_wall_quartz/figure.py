#!/usr/bin/env python3
"""Draws a run at the times of Figure 4.8: from above and from the side.

    /usr/bin/python3 experiments/chiou_wall_quartz/figure.py runs/chiou_wall_quartz-grains docs/results/chiou_wall_quartz.png
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "app" / "report"))
import figures
import style
from read import Run

TIMES = (0.28, 0.56, 0.84, 1.8, 8.2)  # [s]; a run that ends at rest before stands for the last
LENGTH, SIDE, TOP = (0.05, 1.75), (0.45, 0.70), 0.11  # [m] what is shown: along the slope from above and from the side, height


def main(folder, path):
    run = Run(folder)
    frames = [min(run.frames, key=lambda frame: abs(frame.time - t)) for t in TIMES]
    box, deepest = (*LENGTH, -0.45, 0.45), figures.deepest(run)
    figure, axes = style.plt.subplots(len(frames), 2, figsize=(1.1 * style.WIDTH, 2 * len(frames)), layout="constrained")
    for row, frame, wanted in zip(axes, frames, TIMES):
        image = figures.draw_depth(row[0], run, frame, deepest, box)
        late = f", the run's end, for {wanted} s" if wanted - frame.time > 0.1 else ""
        row[0].set_title(f"t = {frame.time:.2f} s{late}")
        row[0].set_xticks(range(250, 1751, 500))
        row[0].set_ylabel("y [mm]")
        dots = figures.draw_side(row[1], run, frame, 0, 1.5)
        style.plain_map(row[1])
        row[1].set_xlim(1e3 * SIDE[0], 1e3 * SIDE[1])
        row[1].set_ylim(-5, 1e3 * TOP)
        row[1].set_ylabel("height [mm]")
    for a in axes[-1]:
        a.set_xlabel("x, down the slope [mm]")
    style.colour_bar(figure, axes[:, 0], image, "depth along the normal [mm]")
    if dots is not None:
        style.colour_bar(figure, axes[:, 1], dots, "speed of the grains [m/s]")
    style.save(figure, path)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
