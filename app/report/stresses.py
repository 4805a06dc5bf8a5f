"""Pictures and figures of stress gauges: parts of an obstacle's face."""

import numpy as np

import style
from read import running_mean
from style import plt

KPA = 1e-3
KINDS = (("normal", "normal", style.BLUE), ("up", "shear, up the face", style.RED), ("across", "shear, across", style.GREEN))
FIGURES = [("peak normal stress (mean of 15 ms)", "Pa", "normal_peak"), ("its time", "s", "normal_peak_time"),
           ("normal stress at the end (last 50 ms)", "Pa", "normal_final"), ("peak shear up the face", "Pa", "shear_up_peak"),
           ("shear up the face at the end", "Pa", "shear_up_final"), ("peak shear across", "Pa", "shear_across_peak"),
           ("first contact", "s", "first_contact"), ("area", "m2", "area")]


def title(gauge):
    of, name = gauge
    return f"Stress on gauge {name} of {of}"


def groups(runs):
    """For page.figures_table: the key figures of each gauge."""
    gauges = list(dict.fromkeys(gauge for run in runs for gauge in run.stresses))
    return [(title(gauge), [(what, unit, [run.figure(("obstacles", gauge[0], "gauges", gauge[1], key)) for run in runs])
                            for what, unit, key in FIGURES]) for gauge in gauges]


def packing_groups(replicates):
    """The same with mean, scatter, least and largest of all packings."""
    out = []
    for of, obstacle in replicates["obstacles"].items():
        for name, figures in obstacle.get("gauges", {}).items():
            rows = [(what, unit, [figures[key][column] for column in ("mean", "scatter", "least", "largest")])
                    for what, unit, key in FIGURES if key in figures]
            out.append((title((of, name)), rows))
    return out


def mean_stress(run, gauge, kind):
    return running_mean(run.time, run.windows["length"], run.stresses[gauge][kind]) * KPA


def of_packings(run, gauge, kind):
    """The 15 ms mean of each packing [kPa] at this run's times."""
    return np.array([np.interp(run.time, one.time, mean_stress(one, gauge, kind)) for one in run.packings])


def finish(axes, heading, runs):
    axes.axhline(0, color=style.GREY, linewidth=0.8)
    axes.set_title(heading)
    axes.set_ylabel("stress [kPa]")
    axes.set_xlim(0, max(run.time[-1] for run in runs))
    axes.legend(loc="best")


def one_run(run, path):
    """A panel for each gauge: the three stresses, means of 15 ms; with several packings their mean and scatter."""
    if not run.stresses or not len(run.time):
        return None
    figure, all_axes = plt.subplots(len(run.stresses), 1, figsize=(style.WIDTH, 3.6 * len(run.stresses)), sharex=True,
                                    squeeze=False, layout="constrained")
    for axes, gauge in zip(all_axes.flat, run.stresses):
        axes.plot(run.time, run.stresses[gauge]["normal"] * KPA, color=style.SKY, linewidth=0.5, label="normal, mean of a window")
        for kind, label, colour in KINDS:
            if run.packings:
                every = of_packings(run, gauge, kind)
                middle, scatter = every.mean(axis=0), every.std(axis=0, ddof=1)
                axes.fill_between(run.time, middle - scatter, middle + scatter, color=colour, alpha=0.25, linewidth=0)
                axes.plot(run.time, middle, color=colour, linewidth=2, label=f"{label}, {len(every)} packings")
            else:
                axes.plot(run.time, mean_stress(run, gauge, kind), color=colour, linewidth=2, label=label)
        finish(axes, title(gauge) + ": means of 15 ms", [run])
    all_axes.flat[-1].set_xlabel("time [s]")
    return style.save(figure, path)


def several(runs, labels, path):
    """Normal stress and shear up the face of all runs: a row for each gauge that at least one of them reads."""
    gauges = list(dict.fromkeys(gauge for run in runs for gauge in run.stresses if len(run.time)))
    if not gauges:
        return None
    figure, all_axes = plt.subplots(len(gauges), 2, figsize=(1.3 * style.WIDTH, 3.6 * len(gauges)), sharex=True, squeeze=False,
                                    layout="constrained")
    for row, gauge in zip(all_axes, gauges):
        reading = [(run, label, k) for k, (run, label) in enumerate(zip(runs, labels)) if gauge in run.stresses]
        for axes, (kind, what, _) in zip(row, KINDS):
            for run, label, k in reading:
                axes.plot(run.time, mean_stress(run, gauge, kind), color=style.SERIES[k % len(style.SERIES)], linewidth=2,
                          linestyle=style.DASHES[k % len(style.DASHES)], label=label)
            finish(axes, f"Gauge {gauge[1]} of {gauge[0]}: {what}", [run for run, _, _ in reading])
    for axes in all_axes[-1]:
        axes.set_xlabel("time [s]")
    return style.save(figure, path)
