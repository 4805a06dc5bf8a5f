"""The pages as these tests read them: blocks of code, and the commands in them."""

import re
import shlex
from pathlib import Path


def blocks(text):
    """(language, lines, the text before) of each fenced block, and of each indented one with an empty language."""
    found, open_at, language, before = [], None, "", 0
    lines = text.splitlines()
    indented = []
    for number, line in enumerate([*lines, ""]):
        if line.lstrip().startswith("```"):
            if open_at is None:
                open_at, language = number, line.strip()[3:]
            else:
                found.append((language, lines[open_at + 1:number], "\n".join(lines[before:open_at])))
                open_at, before = None, number + 1
        elif open_at is None and line.startswith("    ") and line.strip():
            indented.append(line[4:])
        elif open_at is None and indented:
            found.append(("", indented, ""))
            indented = []
    return found


def words_of(line, variables):
    """The simple commands of a line of shell, each as its words, with the first value of each loop's variable set in."""
    for name, value in variables.items():
        line = re.sub(rf"\$\{{?{name}\b\}}?", lambda _: value, line)
    lexer = shlex.shlex(line, posix=True, punctuation_chars=True)
    lexer.whitespace_split = True
    command, commands = [], []
    for word in lexer:
        if set(word) <= set(";|&<>()"):
            commands.append(command)
            command = []
        else:
            command.append(word)
    return [words for words in [*commands, command] if words]


def couloir_commands(text):
    """The words after `couloir` of every command of a page, in blocks and within sentences."""
    places = [lines for _, lines, _ in blocks(text)]
    prose = re.sub(r"```.*?```", "", text, flags=re.S)
    places += [[code] for code in re.findall(r"`((?:[A-Z_]+=\S+ )?(?:\./)?couloir [^`]*)`", prose)]
    found = []
    for lines in places:
        block = "\n".join(lines).replace("\\\n", " ")
        variables = {name: shlex.split(values)[0] for name, values in re.findall(r"\bfor (\w+) in ([^;\n]+)", block)}
        for line in block.splitlines():
            if not re.search(r"(^|[ ;`])(\./)?couloir [a-z]", line):
                continue
            for words in words_of(line, variables):
                words = [w for w in words if w != "do" and not re.fullmatch(r"[A-Z_]+=\S*", w)]
                if len(words) > 1 and words[0] in ("./couloir", "couloir"):
                    found.append(words[1:])
    return found


def all_pages(source):
    return [source / "README.md", source / "CONTRIBUTING.md", *sorted(source.glob("docs/**/*.md")),
            *sorted(source.glob("experiments/*/README.md")), *sorted(Path(source / "bench").glob("*.md"))]
