"""index.html: the verdict first, then figures, effects, events and pictures. One file, nothing from elsewhere."""

import base64
import sys
from html import escape

CSS = """
:root{--ink:#22272b;--soft:#5b636a;--line:#dfe3e6;--paper:#fff;--tint:#f5f7f8;--accent:#0072b2;--good:#00724f;--bad:#b34700}
*{box-sizing:border-box}
body{margin:0 auto;padding:1.5rem 1.1rem 4rem;max-width:64rem;background:var(--paper);color:var(--ink);
 font:1rem/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","DejaVu Sans",sans-serif}
h1{font-size:1.75rem;line-height:1.2;margin:.2rem 0 .3rem;letter-spacing:-.01em}
h2{font-size:1.2rem;margin:2.4rem 0 .6rem;padding-top:.9rem;border-top:1px solid var(--line)}
.about{color:var(--soft);margin:0 0 1.2rem}
.verdict{border-left:5px solid var(--good);background:var(--tint);padding:.8rem 1rem;margin:0 0 1.2rem;font-size:1.06rem}
.verdict.bad{border-color:var(--bad)}
.verdict b{white-space:nowrap}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(9.5rem,1fr));gap:.7rem;margin:0 0 1rem}
.card{border:1px solid var(--line);border-radius:.4rem;padding:.6rem .8rem}
.card strong{display:block;font-size:1.4rem;line-height:1.25;font-variant-numeric:tabular-nums}
.card span{color:var(--soft);font-size:.86rem}
.scroll{overflow-x:auto;-webkit-overflow-scrolling:touch}
table{border-collapse:collapse;width:100%;font-size:.94rem}
th,td{text-align:left;padding:.36rem .8rem .36rem 0;border-bottom:1px solid var(--line);vertical-align:top}
thead th{color:var(--soft);font-weight:600;border-bottom:2px solid var(--line)}
tbody th{font-weight:400;min-width:8.5rem}
tr.group th{font-weight:700;padding-top:1rem}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}td.n{white-space:nowrap}
td.u{color:var(--soft);white-space:nowrap}
.on{color:var(--good);font-weight:600}.off{color:var(--soft)}
figure{margin:0 0 1.4rem}
figure img{display:block;width:100%;height:auto}
figcaption{color:var(--soft);font-size:.9rem;margin-top:.3rem}
.player figure{max-width:46rem}.player[hidden],.player img[hidden]{display:none}
.curve{position:relative}
.marker{position:absolute;margin-left:-1px;border-left:2px solid var(--ink)}
.controls{display:grid;grid-template-columns:auto 1fr;gap:.4rem .8rem;align-items:center;margin:.4rem 0}
.controls output{grid-column:1/-1;min-height:1.55em;font-variant-numeric:tabular-nums}
.controls button{font:inherit;min-width:5.5rem;padding:.45rem .8rem;border:1px solid var(--accent);border-radius:.4rem;
 background:var(--accent);color:var(--paper)}
.controls input{width:100%;height:2rem;margin:0}
.aside{display:none}
@media (max-width:40rem){.scroll img.wide{width:46rem;max-width:none}body{padding:1rem .8rem 3rem}h1{font-size:1.4rem}
 .aside{display:inline}}
@page{margin:14mm}
@media print{body{max-width:none;padding:0;font-size:9pt;line-height:1.4}h2{break-after:avoid;margin-top:1.2rem}
 figure,tr,.card,.verdict{break-inside:avoid}.scroll{overflow:visible}.player,.aside{display:none}
 figure img{width:auto;max-width:100%;max-height:100mm}th,td{padding-top:.15rem;padding-bottom:.15rem}
 .cards{grid-template-columns:repeat(5,1fr)}.card{padding:.3rem .5rem}.card strong{font-size:1.1rem;white-space:nowrap}
 *{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
"""


def number(value, digits=4):
    """A number as people write it; an en dash for what there is not."""
    if value is None:
        return "–"
    if isinstance(value, int) or float(value).is_integer() and abs(value) < 1e7:
        return f"{int(value):,}".replace(",", "\u202f")
    size = abs(value)
    if size >= 1e6 or size < 1e-3:
        mantissa, exponent = f"{value:.{min(digits, 3) - 1}e}".split("e")
        return f"{mantissa}\u2009·\u200910<sup>{int(exponent)}</sup>".replace("-", "\u2212")
    if size >= 10**digits:
        return f"{value:,.0f}".replace(",", "\u202f")
    return f"{value:.{digits}g}".replace("-", "\u2212")


def data(content, kind):
    """A picture as an address that holds it."""
    return f"data:image/{kind};base64,{base64.b64encode(content).decode()}"


def picture(path, caption, narrow=None):
    """`narrow`: the same drawn for the width of a phone; without it the picture scrolls sideways there."""
    if path is None:
        return ""
    image = f'<img alt="{escape(caption)}" src="{data(path.read_bytes(), "png")}"'
    if narrow:
        source = f'<source media="(max-width:40rem)" srcset="{data(narrow.read_bytes(), "png")}">'
        return f"<figure><picture>{source}{image}></picture><figcaption>{escape(caption)}</figcaption></figure>\n"
    return (f'<figure><div class="scroll">{image} class="wide"></div>'
            f'<figcaption><span class="aside">The picture goes on to the right. </span>{escape(caption)}</figcaption></figure>\n')


def cards(entries):
    """entries: (value, unit, what)."""
    body = "".join(f'<div class="card"><strong>{number(value, 3)} {escape(unit)}</strong><span>{escape(what)}</span></div>'
                   for value, unit, what in entries if value is not None)
    return f'<div class="cards">{body}</div>\n'


def figures_table(columns, groups):
    """columns: headings of the numbers; groups: (title, [(what, unit, [value a column])]). A text value is shown as it is."""
    head = "".join(f'<th class="n">{escape(c)}</th>' for c in columns)
    rows = []
    for title, entries in groups:
        entries = [e for e in entries if any(v is not None for v in e[2])]
        if not entries:
            continue
        rows.append(f'<tr class="group"><th colspan="{len(columns) + 2}">{escape(title)}</th></tr>')
        for what, unit, values in entries:
            cells = "".join(f'<td class="n">{escape(v) if isinstance(v, str) else number(v)}</td>' for v in values)
            rows.append(f'<tr><th>{escape(what)}</th>{cells}<td class="u">{escape(unit)}</td></tr>')
    return (f'<div class="scroll"><table><thead><tr><th></th>{head}<th>unit</th></tr></thead>'
            f'<tbody>{"".join(rows)}</tbody></table></div>\n')


def effects_table(effects):
    rows = "".join(f'<tr><th>{escape(e["name"])}</th><td class="{"on" if e["on"] else "off"}">{"on" if e["on"] else "off"}</td>'
                   f'<td>{escape(e["reason"])}</td></tr>' for e in sorted(effects, key=lambda e: not e["on"]))
    head = "<thead><tr><th>effect</th><th></th><th>why</th></tr></thead>"
    return f'<div class="scroll"><table>{head}<tbody>{rows}</tbody></table></div>\n'


def events_table(events):
    rows = "".join(f'<tr><td class="n">{time:.3f} s</td><td>{escape(text)}</td></tr>' for time, text in events)
    return f'<div class="scroll"><table><tbody>{rows}</tbody></table></div>\n'


def section(title, body):
    return f"<h2>{escape(title)}</h2>\n{body}" if body else ""


def page(title, about, verdict, good, body):
    """`verdict` is HTML; the rest of the texts are escaped."""
    return (f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width, initial-scale=1">'
            f"<title>{escape(title)}</title><style>{CSS}</style></head><body>\n<h1>{escape(title)}</h1>\n"
            f'<p class="about">{escape(about)}</p>\n<p class="verdict{"" if good else " bad"}">{verdict}</p>\n'
            f"{body}</body></html>\n")


def write_page(path, make, wrong):
    """Writes what make() returns; the exit code: 0, or 2 with one line, where the input is `wrong` or the page cannot be written."""
    try:
        path.mkdir(parents=True, exist_ok=True)
        (path / "index.html").write_text(make(), encoding="utf-8")
    except wrong as error:
        print(error, file=sys.stderr)
    except OSError as error:
        print(f"the page could not be written: {error}", file=sys.stderr)
    else:
        return 0
    return 2
