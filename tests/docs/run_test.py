#!/usr/bin/python3
"""run_test.py COULOIR SOURCE PAGE: what a page tells its reader to save and to type, in a scratch folder, as a reader would.

A block of another language than sh is a file: the sentence before it ends in its name and a colon.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from pages import blocks


def main():
    couloir, source, page = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    commands = 0
    with tempfile.TemporaryDirectory(prefix="couloir-docs-") as scratch:
        scratch = Path(scratch)
        (scratch / "couloir").symlink_to(couloir)
        (scratch / "experiments").symlink_to(source / "experiments")
        for language, lines, before in blocks(page.read_text()):
            if language not in ("", "sh"):
                name = re.search(r"`([\w/.]+)`:\s*\Z", before)
                if not name:
                    sys.exit(f"{page.name}: no name stands before the {language} block that begins with: {lines[0]}")
                (scratch / name[1]).write_text("\n".join(lines) + "\n")
                continue
            for line in lines if language == "sh" else [line for line in lines if line.startswith("./couloir")]:
                commands += 1
                done = subprocess.run(["bash", "-ec", line], cwd=scratch, capture_output=True, text=True, timeout=300,
                                      env={**os.environ, "OMP_NUM_THREADS": "1"})
                if done.returncode:
                    sys.exit(f"{page.name}: exit code {done.returncode} of\n    {line}\n{done.stdout}{done.stderr}")
        named = re.findall(r"`(runs/[\w/.-]+)`", page.read_text())
        missing = [name for name in named if not (scratch / name).exists()]
        if missing:
            sys.exit(f"{page.name} names what its commands did not make: {', '.join(missing)}")
    if not commands:
        sys.exit(f"{page.name} has no commands")


main()
