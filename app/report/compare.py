"""Pictures of several runs side by side."""

import style
from figures import common_box, common_instants, deepest, draw_depth
from read import running_mean
from style import plt


def forces(runs, labels, path):
    """The 15 ms means of all runs, one panel an obstacle that at least one of them has."""
    names = list(dict.fromkeys(name for run in runs for name in run.forces if len(run.time)))
    if not names:
        return None
    figure, axes = plt.subplots(len(names), 1, figsize=(style.WIDTH, 3.8 * len(names)), sharex=True, squeeze=False,
                                layout="constrained")
    for a, name in zip(axes.flat, names):
        for k, (run, label) in enumerate(zip(runs, labels)):
            if name not in run.forces or not len(run.time):
                continue
            f = run.forces[name]
            mean = running_mean(f["time"], run.windows["length"], f["fx"])
            a.plot(f["time"], f["fx"], color=style.line(k)["color"], linewidth=0.6, alpha=0.3)
            a.plot(f["time"], mean, **style.line(k), linewidth=2, label=label)
            a.plot(*run.peak(name), "o", color=style.line(k)["color"], markersize=6)
        a.axhline(0, color=style.GREY, linewidth=0.8)
        a.set_title(f"Force on {name}, along the slope")
        a.set_ylabel("force [N]")
        a.legend(loc="best")
    axes.flat[0].set_xlim(0, max(run.time[-1] for run in runs if len(run.time)))
    axes.flat[-1].set_xlabel("time [s]")
    return style.save(figure, path)


def depth(runs, labels, path, count=4):
    """Depth from above: a column a run, a row an instant, one scale for all."""
    runs_with = [(run, label) for run, label in zip(runs, labels) if run.frames and (run.has_flow or run.has_grains)]
    if not runs_with:
        return None
    runs, labels = zip(*runs_with)
    rows = common_instants(runs, count + 1)
    rows = rows[1:] or rows  # all begin alike
    box = common_box(runs, rows)
    top = max(deepest(run) for run in runs)
    ratio = (box[3] - box[2]) / (box[1] - box[0])
    figure, axes = style.map_grid(len(rows), len(runs), ratio, width=max(style.WIDTH, 3.2 * len(runs)), title_lines=2)
    for j, row in enumerate(rows):
        for k, (run, frame) in enumerate(zip(runs, row)):
            image = draw_depth(axes[j, k], run, frame, top, box)
            axes[j, k].set_title(f"{labels[k]}\nt = {frame.time:.3f} s" if j == 0 else f"t = {frame.time:.3f} s")
    for a in axes[:, 0]:
        a.set_ylabel("y [mm]")
    style.colour_bar(figure, axes, image, "depth along the normal [mm]")
    return style.save(figure, path)
