#!/usr/bin/python3
"""parse_test.py COULOIR SOURCE: every documented command has a verb that there is, flags that it takes, and a scene that can be planned.

Commands of run and plan are planned with their mode and keys, those of study are listed (--dry-run); nothing is computed.
"""

import re
import subprocess
import sys
import unittest
from pathlib import Path

from pages import all_pages, couloir_commands

COULOIR, SOURCE = sys.argv[1], Path(sys.argv[2])


def said(*words):
    return subprocess.run([COULOIR, *words], cwd=SOURCE, capture_output=True, text=True, timeout=120)


class Flags:
    """What a verb takes: flags, and which of them have a value."""

    def __init__(self, verb):
        text = said(verb, "--help").stdout
        self.all = set(re.findall(r"--[a-z-]+", text))
        self.valued = set(re.findall(r"(--[a-z-]+) (?:TEXT|INT)", text))

    def split(self, words):
        """(positionals, {flag: values}, what is wrong)"""
        positionals, flags, wrong, k = [], {}, [], 0
        while k < len(words):
            flag, equals, value = words[k].partition("=")
            if not words[k].startswith("--"):
                positionals.append(words[k])
            elif flag not in self.all:
                wrong.append(f"there is no {flag}")
            elif flag in self.valued and not equals:
                k += 1
                flags.setdefault(flag, []).append(words[k] if k < len(words) else "")
            else:
                flags.setdefault(flag, []).append(value)
            k += 1
        return positionals, flags, wrong


def is_placeholder(word):
    return not word or word.isupper() or "$" in word or "..." in word or "<" in word


class Commands(unittest.TestCase):
    verbs = dict.fromkeys(re.findall(r"^  ([a-z]+) {2,}", said("--help").stdout, flags=re.M))
    front_door = set(re.findall(r'"\$\{1:-\}" = (\w+)', (SOURCE / "couloir").read_text()))

    def wrong(self, words):
        """What is wrong with a command, or an empty text."""
        verb, rest = words[0], words[1:]
        if verb not in self.verbs:
            return "" if verb in self.front_door else f"there is no verb {verb}"
        self.verbs[verb] = self.verbs[verb] or Flags(verb)
        positionals, flags, wrong = self.verbs[verb].split(rest)
        if wrong:
            return wrong[0]
        known = [p for p in positionals if not is_placeholder(p) and not p.startswith(("my/", "runs/"))]
        keys = [word for value in flags.get("--set", []) if not is_placeholder(value) for word in ("--set", value)]
        keys += [word for value in flags.get("--mode", []) if not is_placeholder(value) for word in ("--mode", value)]
        if verb in ("run", "plan", "study"):
            for scene in known:
                listed = ("study", scene, "--dry-run", *keys) if verb == "study" else ("plan", scene, *keys)
                done = self.planned.setdefault(listed, None) or said(*listed)
                self.planned[listed] = done
                if done.returncode:
                    return done.stderr.strip()
        elif verb == "calibrate":
            return "; ".join(f"{m} is no material and no scene" for m in known
                             if not (SOURCE / "dem_inputs/materials" / f"{m}.yaml").exists() and not (SOURCE / m).exists())
        for variant in flags.get("--variant", []):
            cases = [file.read_text() for path in known for file in (SOURCE / path).glob("**/*.yaml")]
            if not is_placeholder(variant) and not any(re.search(rf"\b{re.escape(variant)}: *[{{\n]", text) for text in cases):
                return f"no case of {' '.join(known)} has a variant {variant}"
        return "; ".join(f"{path} does not exist" for path in known if verb != "calibrate" and not (SOURCE / path).exists())

    planned = {}

    def test_all_of_them(self):
        count, broken = 0, []
        for page in all_pages(SOURCE):
            for words in couloir_commands(page.read_text()):
                count += 1
                wrong = self.wrong(words)
                if wrong:
                    broken.append(f"{page.relative_to(SOURCE)}: couloir {' '.join(words)}\n    {wrong}")
        self.assertEqual(broken, [], "\n" + "\n".join(broken))
        self.assertGreater(count, 100, "the pages have lost their commands, or this test its eyes")

    def test_broken_ones_are_seen(self):
        text = ("    ./couloir rum experiments/chiou_wall\n\nSay `./couloir run --mood continuum`.\n\n```sh\n"
                "for s in 1 2; do ./couloir run tests/scenes/no_wall.yaml --set grains.seed=$s; done\n"
                "./couloir plan tests/scenes/slab.yaml --set grains.sead=1  # a comment\n./couloir calibrate custard | tee x\n"
                "./couloir check experiments/chiou_refinement --variant sead\n```\n")
        told = [self.wrong(words) for words in couloir_commands(text)]
        for k, part in enumerate(("no_wall.yaml", "grains.sead", "custard is no material", "no verb rum", "no --mood", "variant sead")):
            self.assertTrue(any(part in sentence for sentence in told), f"{part}: {told}")
        self.assertEqual(len(told), 6)

    def test_the_site_has_all_pages(self):
        nav = (SOURCE / "mkdocs.yml").read_text()
        named = re.findall(r": (\S+\.md)$", nav, flags=re.M)
        self.assertEqual(sorted(named), sorted(str(p.relative_to(SOURCE / "docs")) for p in SOURCE.glob("docs/**/*.md")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
