#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that links and pictures in the Markdown of the tree lead to files and headings: doc_links.py ROOT [--list]

--list prints the documents and what they link to, which is what a site of them needs.
"""
import os
import pathlib
import re
import subprocess
import sys

LINK = re.compile(r"\[(?:[^\[\]]|\[[^\]]*\](?:\([^)]*\))?)*\]\(([^)\s]+)\)|!\[[^\]]*\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
INLINE = re.compile(r"`[^`\n]*`")


def documents(root):
    """The Markdown files of the tree: the tracked ones, or without git all outside build folders."""
    try:
        listed = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard", "*.md"], check=True,
                                capture_output=True, text=True).stdout.split("\n")
        return [name for name in listed if name and (root / name).is_file()]
    except (OSError, subprocess.CalledProcessError):
        found = (path.relative_to(root) for path in root.rglob("*.md"))
        return sorted(str(path) for path in found if path.parts[0] not in ("build", "demo"))


def anchors(text):
    """The anchors of a document's headings, as web pages of Markdown name them."""
    titles = re.findall(r"^#+ +(.*?) *#*$", CODE.sub("", text), re.MULTILINE)
    plain = (re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title).replace("`", "").lower() for title in titles)
    return {re.sub(r" ", "-", re.sub(r"[^\w\- ]", "", title)) for title in plain}


def links(text):
    prose = INLINE.sub("``", CODE.sub("", text))
    for match in LINK.finditer(prose):
        inner = re.findall(r"\]\(([^)\s]+)\)", match.group(0))  # a picture in a link has two
        yield from inner


def check(root, name):
    """The files that a document links to, and what is wrong with its links."""
    text = (root / name).read_text(encoding="utf-8")
    files, errors = set(), []
    for link in links(text):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = os.path.normpath(os.path.join(os.path.dirname(name), path)) if path else name
        if not (root / target).exists():
            errors.append(f"{name}: no such file: {link}")
            continue
        if (root / target).is_file():
            files.add(target)
        if anchor and target.endswith(".md") and anchor not in anchors((root / target).read_text(encoding="utf-8")):
            errors.append(f"{name}: no such heading: {link}")
    return files, errors


def main():
    root = pathlib.Path(sys.argv[1])
    files, errors = set(), []
    for name in documents(root):
        files.add(name)
        linked, wrong = check(root, name)
        files |= linked
        errors += wrong
    if "--list" in sys.argv[2:]:
        print("\n".join(sorted(files)))
    elif errors:
        sys.exit("\n".join(errors))


if __name__ == "__main__":
    main()
