#!/usr/bin/env python3
"""What each effect of the continuum costs: runs the programs of effects_rate.cpp in turn and prints the table of docs/performance.md.

    cmake --build build/release --target effects_rate effects_rate_bare effects_rate_no_curvature
    bench/effects.py [rounds]          # 9 unless told; some 20 s each

A round runs every case once in each program, so that all suffer alike from what else runs. Rates are medians over the rounds of
millions of cell updates (cells times stages) in a second of processor time; the noise is half of the middle half's width.
"""

import json
import pathlib
import statistics
import subprocess
import sys

BIN = pathlib.Path(__file__).resolve().parent.parent / "build/release/bin"
WHOLE, BARE, NO_CURVATURE = "effects_rate", "effects_rate_bare", "effects_rate_no_curvature"
# effect, its case, the case of a scene that leaves it out, the program built without it
ROWS = [
    ("friction", "friction", "bare", BARE),
    ("earth pressure, active/passive", "earth_pressure", "bare", BARE),
    ("relief (obstacles by elevation)", "relief", "bare", BARE),
    ("curvature, with friction on an arc", "curvature", "arc", NO_CURVATURE),
]


def once(program):
    words = [BIN / program, "--benchmark_format=json", "--benchmark_counters_tabular=false"]
    done = subprocess.run(words, capture_output=True, check=True, text=True)
    return {b["name"].split("/min_time")[0]: (b["updates"] / 1e6, b["checksum"]) for b in json.loads(done.stdout)["benchmarks"]}


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 9
    rates, sums = {}, {}
    for _ in range(rounds):
        for program in (WHOLE, BARE, NO_CURVATURE):
            for case, (rate, checksum) in once(program).items():
                rates.setdefault((program, case), []).append(rate)
                sums.setdefault(case, set()).add(checksum)

    def text(program, case):
        values = rates[program, case]
        low, _, high = statistics.quantiles(values, n=4)
        return f"{statistics.median(values):.1f} ± {(high - low) / 2:.1f}"

    for scheme, prefix in (("central_upwind", ""), ("noc", "noc/")):
        print(f"| {scheme} | on | off by the scene | built without |\n| --- | --- | --- | --- |")
        for effect, on, off, without in ROWS:
            print(f"| {effect} | {text(WHOLE, prefix + on)} | {text(WHOLE, prefix + off)} | {text(without, prefix + off)} |")
        print(f"| one row of cells, all off | | {text(WHOLE, prefix + 'one_row')} | |\n")
    # The programs that leave an effect out must still compute the same flow.
    same = all(len(s) == 1 for s in sums.values())
    print("Every case gave one checksum in all programs and rounds." if same else "The programs differ in their results!")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
