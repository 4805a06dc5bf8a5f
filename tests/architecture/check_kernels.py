#!/usr/bin/env python3
"""check_kernels.py TABLE OBJECT...: of each merged object of kernels nothing is visible but its table (cmake/kernels.cmake), and that of
the baseline uses no AVX registers. Else a machine without AVX may meet them through a template that all share."""
import pathlib
import re
import subprocess
import sys

table, objects = sys.argv[1], sys.argv[2:]
bad = []
for name in objects:
    isa = pathlib.Path(name).stem.rsplit("_", 1)[1]
    symbols = subprocess.run(["nm", "--defined-only", "--extern-only", name], capture_output=True, text=True, check=True).stdout
    visible = [line.split()[-1] for line in symbols.splitlines()]
    if visible != [f"{table}_{isa}"]:
        bad.append(f"{name}: visible are {visible}")
    code = subprocess.run(["objdump", "-d", "--no-show-raw-insn", name], capture_output=True, text=True, check=True).stdout
    widest = "zmm" if "%zmm" in code else "ymm" if "%ymm" in code else "xmm"
    if isa == "baseline" and (widest != "xmm" or re.search(r"\tv[a-z0-9]+ .*%xmm", code)):
        bad.append(f"{name}: AVX instructions in the baseline")
    print(f"{isa}: widest register {widest}")
print("\n".join(bad))
sys.exit(1 if bad or not objects else 0)
