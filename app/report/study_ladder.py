"""The ladder of a study: what each rung is off by against what it costs, and which to take."""

from html import escape

import numpy as np

import style
from page import number, picture
from style import plt

MARKS = {"mass point": "X", "continuum": "o", "coupled": "s", "grains": "^"}


def points(ladder, quantity):
    """(number from 1, rung, its cost, its figures) where it has all of them."""
    whole = enumerate(zip(ladder["rungs"], quantity["rungs"]), 1)
    return [(n, rung, rung["cpu"], figures) for n, (rung, figures) in whole if rung["cpu"] and figures["error"] is not None]


def draw_quantity(axes, ladder, quantity):
    shown = points(ladder, quantity)
    exact = [f["error"] for *_, f in shown if f["error"] > 0]
    least = 0.5 * min(exact, default=0.01)  # where what is not off at all is drawn
    for n, (mode, mark) in enumerate(MARKS.items()):
        own = [(cpu, max(f["error"], least), f["doubt"] or 0) for _, rung, cpu, f in shown if rung["mode"] == mode]
        if not own:
            continue
        cpu, error, doubt = (100 * np.array(part) if k else np.array(part) for k, part in enumerate(zip(*own)))
        low = np.minimum(doubt, error - 100 * least / 2)
        axes.errorbar(cpu, error, [np.maximum(low, 0), doubt], fmt=mark, color=style.SERIES[n], markersize=7, capsize=3, linewidth=1,
                      label=mode)
    front = sorted((cpu, 100 * max(f["error"], least)) for _, _, cpu, f in shown if f["front"])
    if len(front) > 1:
        axes.step(*zip(*front), where="post", color=style.GREY, linestyle="--", linewidth=1, zorder=0, label="nothing cheaper is better")
    if quantity["floor"]:
        axes.axhspan(0, 100 * quantity["floor"], color=style.GREY, alpha=0.15, linewidth=0, label="one run of the reference")
    for n, (label, _, cpu, f) in enumerate(sorted(shown, key=lambda point: point[2])):  # neighbours' above and below
        axes.annotate(label, (cpu, 100 * max(f["error"], least)), textcoords="offset points", xytext=(7, -11 if n % 2 else 5),
                      fontsize=7.5, color=style.INK)
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.yaxis.set_minor_formatter("")
    axes.margins(x=0.2, y=0.15)
    for axis in (axes.xaxis, axes.yaxis):
        style.log_ticks(axis, *axis.get_view_interval())
    axes.set_xlabel("processor time of one run [s]")
    axes.set_ylabel("error [%]")
    axes.set_title(quantity["quantity"], loc="left")
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1), fontsize=8)


def draw(ladder, path):
    shown = [q for q in ladder["quantities"] if points(ladder, q)]
    if not shown:
        return None
    figure, axes = plt.subplots(len(shown), 1, figsize=(style.WIDTH, 4.6 * len(shown)), squeeze=False, layout="constrained")
    for a, quantity in zip(axes[:, 0], shown):
        draw_quantity(a, ladder, quantity)
    return style.save(figure, path)


def share(value):
    return "–" if value is None else f"{number(100 * value, 2)} %"


def rungs_table(ladder, quantity):
    head = ["", "rung", "model", f"value [{quantity['unit'] or '1'}]", "error", "bias", "known to", "to finer", "scatter", "packings", "processor time [s]", ""]
    body = ""
    for n, (rung, f) in enumerate(zip(ladder["rungs"], quantity["rungs"]), 1):
        cells = [number(f["value"]), *(share(f[k]) for k in ("error", "bias", "doubt", "step", "scatter")), number(rung["packings"]), number(rung["cpu"], 3)]
        body += (f"<tr><td class='n'>{n}</td><td>{escape(rung['name'])}</td><td>{escape(rung['mode'])}</td>" + "".join(f'<td class="n">{c}</td>' for c in cells) +
                 f"<td>{'on the front' if f['front'] else ''}</td></tr>")
    return table(head, body)


def choices_table(quantity):
    body = ""
    for c in quantity["choices"]:
        if c["rung"] is None:
            body += f'<tr><td class="n">{share(c["wanted"])}</td><td>no rung</td><td></td><td></td><td></td></tr>'
            continue
        body += (f'<tr><td class="n">{share(c["wanted"])}</td><td>{escape(c["rung"])}</td><td class="n">{c["packings"]}</td>'
                 f'<td class="n">{share(c["error"])}</td><td class="n">{number(c["cpu"], 3)}</td></tr>')
    return table(["wanted", "take", "packings", "error of their mean", "processor time [s]"], body)


def table(head, body):
    cells = "".join(f"<th>{escape(h)}</th>" for h in head)
    return f'<div class="scroll"><table><thead><tr>{cells}</tr></thead><tbody>{body}</tbody></table></div>\n'


def ladder_section(ladder, path):
    caption = ("What one run of each rung, by its number below, is off by: bias against the reference and scatter of its packings; bars: to which the bias is "
               "known. Below the grey band, the scatter of the reference's own packings, one run tells nothing.")
    body = picture(draw(ladder, path), caption)
    for q in ladder["quantities"]:
        floor = f", whose packings scatter by {share(q['floor'])}" if q["floor"] else ""
        body += f"<p>{escape(q['quantity'])}, against {escape(q['source'])}{floor}:</p>\n" + rungs_table(ladder, q) + choices_table(q)
    return body
