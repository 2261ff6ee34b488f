#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the commands in documents give options that the tools have: doc_options.py BIN DOCUMENT...

A command is a line of a code block, or a piece of inline code, that runs a tool of the folder BIN.
"""
import functools
import pathlib
import re
import subprocess
import sys

COMMAND = re.compile(r"\bpointrt-(bake|view|rays|info)\b([^|;&#]*)")
OPTION = re.compile(r"(?<![\w-])--?[a-zA-Z][\w-]*")


def codeOf(text):
    """Pieces of code, each with the number of its line."""
    fenced = False
    for number, line in enumerate(text.replace("\\\n", " ").split("\n"), 1):
        if line.startswith("```"):
            fenced = not fenced
        elif fenced:
            yield number, line.split(" # ")[0]
        else:
            for piece in re.findall(r"`([^`]+)`", line):
                yield number, piece


@functools.cache
def helpOf(folder, tool, command=""):
    arguments = [f"{folder}/pointrt-{tool}", *([command] if command else []), "--help"]
    return subprocess.run(arguments, check=True, capture_output=True, text=True).stdout


def commandOf(folder, tool, words):
    """The command of a tool that has some, like pointrt-rays; else nothing."""
    listed = helpOf(folder, tool).partition("Commands:\n")[2].partition("\n\n")[0]
    commands = re.findall(r"^  (\w+)", listed, re.MULTILINE)
    return next((word for word in words.split() if word in commands), "")


def check(folder, document):
    """What is wrong, and how many options were checked."""
    errors, checked = [], 0
    for line, code in codeOf(pathlib.Path(document).read_text(encoding="utf-8")):
        for tool, rest in COMMAND.findall(code):
            command = commandOf(folder, tool, rest)
            own, _, baked = rest.partition(" --bake ")
            for name, words, of in ((tool, own, command), ("bake", baked, "")):
                for option in OPTION.findall(words):
                    checked += 1
                    if option not in OPTION.findall(helpOf(folder, name, of)):
                        errors.append(f"{document}:{line}: " + f"pointrt-{name} {of}".rstrip() + f" has no option {option}")
    return errors, checked


def main():
    errors, checked = [], 0
    for document in sys.argv[2:]:
        wrong, count = check(sys.argv[1], document)
        errors += wrong
        checked += count
    if errors:
        sys.exit("\n".join(errors))
    if not checked:
        sys.exit("no option found in any document: this check looks for the wrong thing")
    print(f"{checked} options")


if __name__ == "__main__":
    main()
