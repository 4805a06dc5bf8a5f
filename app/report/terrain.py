"""The terrain in true proportions with the flow on it at some instants, for reports: its depth, and obstacles, many times enlarged."""

import matplotlib.pyplot as plt
import numpy as np

import style
from figures import deepest, wet_depth
from read import pick

MM = 1e3
SHARE = 0.12  # of the picture's larger side that the deepest flow fills


def enlarged(run, size):
    """By how much depths are drawn larger, a round number: the deepest then has SHARE of `size` [m]."""
    wanted = SHARE * size / max(deepest(run, 100), 1e-9)
    return max(n for n in (1, 2, 5, 10, 20, 50, 100) if n == 1 or n <= wanted)


def picture(run, path, count=4):
    """None on a plane: there the view from the side says it all."""
    surface = run.file["surface"]
    x, angle, line = surface["x"][()], surface["angle"][()], surface["line"][()]
    if not run.frames or np.ptp(angle) == 0:
        return None
    size = max(np.ptp(line[:, 0]), np.ptp(line[:, 2]))
    times = enlarged(run, size)

    def above(s, n):
        """Where it is in the level frame [mm], its height above the bed enlarged."""
        zeta = np.interp(s, x, angle)
        return ((np.interp(s, x, line[:, 0]) + times * n * np.sin(zeta)) * MM,
                (np.interp(s, x, line[:, 2]) + times * n * np.cos(zeta)) * MM)

    ratio = (np.ptp(line[:, 2]) + 2 * SHARE * size) / (np.ptp(line[:, 0]) + SHARE * size)
    figure, axes = plt.subplots(figsize=(style.WIDTH, min(style.WIDTH, 0.9 * style.WIDTH * ratio + 0.8)), layout="constrained")
    frames = pick(run.frames, count)
    for frame, colour in zip(frames, plt.get_cmap("viridis")(np.linspace(0.85, 0.1, len(frames)))):
        s, y, h = run.depth(frame)
        h = h[int(np.argmin(np.abs(y)))]
        for part in np.split(np.arange(len(s)), np.flatnonzero(np.diff(h > wet_depth(run))) + 1):
            if h[part[0]] <= wet_depth(run):
                continue
            foot, top = above(s[part], 0 * h[part]), above(s[part], h[part])
            axes.fill(np.r_[top[0], foot[0][::-1]], np.r_[top[1], foot[1][::-1]], color=colour, alpha=0.25, linewidth=0)
            axes.plot(*top, color=colour, linewidth=1.6)
        axes.plot([], [], color=colour, linewidth=1.6, label=f"t = {frame.time:.3g} s")
    axes.plot(line[:, 0] * MM, line[:, 2] * MM, color=style.INK, linewidth=1.8)
    for o in run.obstacles.values():
        corners = [above(s, n) for s, n in ((o["x"], 0), (o["x"], o["height"]), (o["x"] + o["length"], o["height"]),
                                            (o["x"] + o["length"], 0))]
        axes.fill(*zip(*corners), facecolor="#C9CDD1", edgecolor=style.INK, linewidth=1.2, zorder=3)
    axes.set_aspect("equal")
    axes.set_xlabel("horizontally [mm]")
    axes.set_ylabel("height [mm]")
    axes.set_title(f"heights above the bed {times} times" if times > 1 else "heights above the bed as they are")
    axes.legend(loc="upper right")
    return style.save(figure, path)
