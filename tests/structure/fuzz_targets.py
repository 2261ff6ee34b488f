#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every input format has a fuzz target with a corpus: fuzz_targets.py REPOSITORY

The formats are the rows of POINTRT_INPUT_FORMATS (preprocess/ingest/formats.h), the targets the readers in the loop over
targets/scan_reader.cpp (tests/fuzz/CMakeLists.txt).
"""
import pathlib
import re
import sys
from typing import Iterable, Iterator

# Readers that no target fuzzes, and why: {"kName": "reason"}.
WITHOUT: dict[str, str] = {}


def formatsIn(header: str) -> list[str]:
    return re.findall(r"^ *FORMAT\((\w+),", header, re.M)


def fuzzedIn(cmake: str) -> list[str]:
    loop = re.search(r"foreach\(reader IN ITEMS ([^)]*)\)(?:(?!endforeach).)*scan_reader\.cpp", cmake, re.S)
    return ["k" + name for name in loop[1].split()] if loop else []


def findings(formats: list[str], fuzzed: list[str], corpora: Iterable[str]) -> Iterator[str]:
    """A line for each format without a target, target without a format or corpus, and outdated exception."""
    if not formats:
        yield "preprocess/ingest/formats.h: no formats found"
    for name in formats:
        if name not in fuzzed and name not in WITHOUT:
            yield f"{name}: has no fuzz target; add it to the readers in tests/fuzz/CMakeLists.txt"
    for name in fuzzed:
        if name not in formats:
            yield f"{name}: has a fuzz target, but is not a format of preprocess/ingest/formats.h"
        if f"scan_{name[1:].lower()}" not in corpora:
            yield f"{name}: tests/fuzz/corpus has no folder scan_{name[1:].lower()} for its target"
    for name in WITHOUT:
        if name in fuzzed or name not in formats:
            yield f"{name}: is an exception in tests/structure/fuzz_targets.py without need"


def main() -> int:
    repository = pathlib.Path(sys.argv[1])
    lines = list(findings(formatsIn((repository / "preprocess/ingest/formats.h").read_text("utf-8")),
                          fuzzedIn((repository / "tests/fuzz/CMakeLists.txt").read_text("utf-8")),
                          [folder.name for folder in (repository / "tests/fuzz/corpus").iterdir()]))
    if lines:
        print(*lines, sep="\n")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
