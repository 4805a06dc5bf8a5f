"""Pictures of the force on all obstacles together: by their own forces, and by what the material lost."""

import numpy as np

import style
from read import running_mean
from style import plt

FIGURES = [("peak by their own forces (mean of 15 ms)", "N", "own.force_peak"),
           ("peak by the control volume", "N", "control_volume.force_peak"),
           ("impulse by their own forces", "N s", "own.impulse"), ("impulse by the control volume", "N s", "control_volume.impulse"),
           ("largest difference (mean of 15 ms)", "N", "difference.largest"), ("mean difference", "N", "difference.mean"),
           ("largest difference over the own peak", "", "difference.relative")]


def group(runs):
    """For page.figures_table."""
    return ("Force on all obstacles together, along the slope",
            [(what, unit, [run.figure("obstacles_together." + key) for run in runs]) for what, unit, key in FIGURES])


def picture(run, path):
    """The 15 ms means of both above, their difference below."""
    if not run.obstacles or "force_by_control_volume" not in run.windows or not len(run.time):
        return None
    own, other = (run.windows[name] for name in ("force_together", "force_by_control_volume"))
    length = run.windows["length"]
    figure, (above, below) = plt.subplots(2, 1, figsize=(style.WIDTH, 5.6), sharex=True, layout="constrained",
                                          gridspec_kw={"height_ratios": (2, 1)})
    span = mean_of(run.time, length)
    above.plot(run.time, span(own), color=style.BLUE, linewidth=2.2, label="own forces, mean of 15 ms")
    above.plot(run.time, span(other), color=style.RED, linewidth=1.6, linestyle=style.DASHES[1],
               label="control volume, mean of 15 ms")
    above.set_title("Force on all obstacles together, along the slope")
    above.set_ylabel("force [N]")
    above.legend(loc="best")
    difference = other - own
    below.plot(run.time, difference, color=style.SKY, linewidth=0.6, label="mean of a window")
    below.plot(run.time, span(difference), color=style.INK, linewidth=1.4, label="mean of 15 ms")
    below.set_title("Control volume less own forces")
    below.set_ylabel("difference [N]")
    below.set_xlabel("time [s]")
    below.margins(y=0.3)
    below.legend(loc="best", ncols=2)
    for axes in (above, below):
        axes.axhline(0, color=style.GREY, linewidth=0.8)
    below.set_xlim(run.time[0] - length[0], run.time[-1])
    return style.save(figure, path)


def mean_of(time, length):
    return lambda force: running_mean(time, length, force) if np.any(force) else force
