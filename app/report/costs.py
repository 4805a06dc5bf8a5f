"""What the parts of a run cost: the shares of its processor time, by the effect that asks for them."""

from html import escape

import style
from style import plt

# The flow's own parts are told apart: they are what remains when no effect is on.
FLOW = {"fluxes": "fluxes", "update": "update, weight, friction", "reconstruction": "reconstruction", "ghosts": "ghosts",
        "velocities": "velocities", "rates": "time step"}
FLOW_COLOURS = ("#0B3C5D", "#125C8E", "#2A7AB5", "#5B9BCB", "#8DBBDD", "#B5D3EA", "#D9E8F4")
EFFECTS = {"basal_friction": (style.RED, ""), "earth_pressure": (style.ORANGE, ""), "steps_of_the_bed": (style.GREEN, ""),
           "elevation": (style.GREEN, "////"), "planes": (style.GREEN, "xxxx"), "refinement": (style.PURPLE, ""),
           "coupling": ("#F0E442", ""), "airborne": ("#F0E442", "////"), "grain_engine": ("#9C6B30", "")}
OTHERS = {"records": ("#4A5056", ""), "ledgers": ("#8D9399", ""), "set_up": ("#BFC4C9", ""), "checkpoints": ("#BFC4C9", "////")}
WORDS = {"steps_of_the_bed": "steps of the bed", "earth_pressure": "earth pressure: K", "basal_friction": "friction: rest, shocks",
         "grain_engine": "grain engine", "coupling": "coupling", "ledgers": "ledgers, forces", "set_up": "set-up, rest"}
LABELLED = 0.04  # shares from here on carry their number
SEEN = 0.005  # smaller ones go with the rest
COLUMNS = 4  # of the legend


def grouped(costs):
    """label -> share, in the order of the picture."""
    out = {}

    def add(label, share):
        out[label] = out.get(label, 0.0) + share

    for c in costs:
        if c["effect"] == "depth_averaged_flow":
            add(FLOW.get(c["part"], "rest of the flow"), c["share"])
        elif c["effect"] is not None:
            add(WORDS.get(c["effect"], c["effect"]), c["share"])
        else:
            part = c["part"] if c["part"] in OTHERS else "set_up"
            add(WORDS.get(part, part), c["share"])
    return out


def looks():
    """label -> (colour, hatch), in the order of the picture."""
    out = {label: (FLOW_COLOURS[k], "") for k, label in enumerate([*FLOW.values(), "rest of the flow"])}
    out.update({WORDS.get(e, e): look for e, look in EFFECTS.items()})
    out.update({WORDS.get(o, o): look for o, look in OTHERS.items()})
    return out


def shares(all_costs, names, path):
    """A bar a run; all_costs: summary.json's `costs` of each."""
    rows = [grouped(c) for c in all_costs]
    if not any(rows):
        return None
    rest = WORDS["set_up"]
    for label in set().union(*rows) - {rest}:  # what would not be seen in any bar
        if max(row.get(label, 0.0) for row in rows) < SEEN:
            for row in rows:
                row[rest] = row.get(rest, 0.0) + row.pop(label, 0.0)
    labels = [label for label in looks() if any(row.get(label, 0.0) > 0 for row in rows)]
    heights = [0.42 * len(rows) + 0.6, 0.22 * -(-len(labels) // COLUMNS)]
    figure, (axes, below) = plt.subplots(2, 1, figsize=(style.WIDTH, sum(heights) + 0.3), height_ratios=heights, layout="constrained")
    left = [0.0] * len(rows)
    for label, (colour, hatch) in looks().items():
        if label not in labels:
            continue
        widths = [100 * row.get(label, 0.0) for row in rows]
        bars = axes.barh(range(len(rows)), widths, left=left, height=0.72, color=colour, hatch=hatch, edgecolor="white",
                         linewidth=0.5, label=label)
        dark = sum(w * int(colour[k:k + 2], 16) for w, k in ((0.3, 1), (0.59, 3), (0.11, 5))) < 125  # luma
        for k, bar in enumerate(bars):
            if widths[k] >= 100 * LABELLED:
                axes.text(left[k] + widths[k] / 2, bar.get_y() + bar.get_height() / 2, f"{widths[k]:.0f}", ha="center", va="center",
                          fontsize=8.5, color="white" if dark else style.INK)
            left[k] += widths[k]
    axes.set_yticks(range(len(rows)), names)
    axes.invert_yaxis()
    axes.set_xlim(0, 100)
    axes.set_xlabel("share of the processor time [%]")
    axes.grid(axis="y", visible=False)
    below.axis("off")
    below.legend(*axes.get_legend_handles_labels(), loc="upper center", ncols=COLUMNS, fontsize=8.5)
    return style.save(figure, path)


def table(costs):
    """HTML: the parts, largest first."""
    rows = "".join(f'<tr><th>{escape(c["part"])}</th><td>{escape(c["effect"] or "")}</td><td class="n">{c["seconds"]:.3g} s</td>'
                   f'<td class="n">{100 * c["share"]:.1f} %</td></tr>'
                   for c in sorted(costs, key=lambda c: -c["seconds"]))
    head = '<thead><tr><th>part</th><th>effect</th><th class="n">processor time</th><th class="n">share</th></tr></thead>'
    return f'<div class="scroll"><table>{head}<tbody>{rows}</tbody></table></div>\n'
