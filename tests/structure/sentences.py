#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the sentences of errors, warnings and notes in the sources with the lists in the folder sentences.

Tests match the place, the key and the kind of a fault. These lists alone hold its words, so a rewording changes one line.
A sentence is a text given to a function that reports (REPORTS), or a text of three words or more that a function returns as
a reason or that a table lists; in Rust, any such text. Values appear as {}, alternatives as {one|other}. A line is a
folder and a sentence.
"""
import argparse
import difflib
import pathlib
import re
import sys
from typing import Iterator

REPORTS = re.compile(
    r"(Trace)?Error|SetFault|RayError|invalid_argument|logic_error|out_of_range|ValidationError|setMessage|badArgument"
    r"|cannotWrite|addTo|wrong|say|(refuse|fail|usage|note|addNote|require|forbid|notify)\w*|(findings|tile)\.add"
    r"|.*notes\.(push|emplace)_back|fprintf")
REASON = re.compile(r"return|constexpr|error_|reason|fault|message|\w*text")
# Their other texts are help, labels, summaries or the content of files.
NO_REASONS = re.compile(r"format/(cli|info)/|window/(ui|input)/|runtime/(rays|scene)/|main\.cpp|report|option|_write")
WORD = re.compile(r"[A-Za-z][a-z'-]+")
PROSE = re.compile(r"\b(an?|are|as|cannot|did|has|is|it|not?|of|the|to)\b")
TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|\s+|^#[^\n]*|(?P<string>R"\((?P<raw>.*?)\)"|"(?P<text>(?:[^"\\\n]|\\.)*)"(?:sv|s)?)'
    r"|'(?:[^'\\\n]|\\.)+'|\d[\w']*|[A-Za-z_]\w*(?:(?:::|\.|->)~?[A-Za-z_]\w*)*|[-+*/|=!<>]=|&&|.", re.S | re.M)
FIELD = re.compile(r"\{[^{}]*\}|%[-+ #0]*[\d*]*(?:\.[\d*]+)?(?:hh|h|ll|l|z)?[diuxXfgeEcs]")
ESCAPES = {r"\n": " ", r"\"": '"', r"\\": "\\", r"\r": "", r"\t": " "}
TOOLS = {"format/info": "pointrt-info", "format": "format", "preprocess": "pointrt-bake", "runtime/rays": "pointrt-rays",
         "runtime/cast": "pointrt-rays", "runtime/studies": "pointrt-rays", "runtime": "pointrt-view"}
LONGEST = 200
# Words that a sentence may not contain, with their replacements.
BETTER = {"(?<!there )is no": "is not a", "is none of": "is not one of", "goes alone": "cannot be combined with",
          "lacks nothing": "has", "wants?": "needs", "asks?|asked": "requests, queries", "tells?|told": "reports",
          "sifts?|sifted": "culls", "settles?|settled": "resolves", "manieth": "n-th", "neighbors?": "neighbours"}
RULES = {"Error": "starts with Error", ".*  ": "has two spaces in a row", r".*[^.]\.$": "ends with a full stop",
         ".*[,;:!]$": "ends with a punctuation mark", f".{{{LONGEST}}}": f"is longer than {LONGEST} characters",
         **{rf".*\b({words})\b": f"write: {better}" for words, better in BETTER.items()}}
Tokens = list[str]


def tokensOf(source: str) -> Tokens:
    """The tokens without comments, spaces and directives; a string is its text after a quotation mark."""
    tokens = []
    for match in TOKEN.finditer(source):
        if match["raw"] is not None:
            tokens.append('"' + match["raw"])
        elif match["string"]:
            tokens.append('"' + re.sub(r"\\.", lambda escape: ESCAPES.get(escape[0], escape[0]), match["text"]))
        elif not re.match(r"//|/\*|\s|#", match[0]):
            tokens.append(match[0])
    return tokens


def upTo(tokens: Tokens, start: int, ends: str) -> int:
    """The first of `ends` outside brackets from `start` on, or the bracket that closes around it."""
    depth = 0
    for i in range(start, len(tokens)):
        if depth == 0 and tokens[i] in ends:
            return i
        depth += (tokens[i] in tuple("([{")) - (tokens[i] in tuple(")]}"))
        if depth < 0:
            return i
    return len(tokens)


def split(tokens: Tokens, separator: str) -> list[Tokens]:
    parts, start = [], 0
    while start <= len(tokens):
        end = upTo(tokens, start, separator)
        parts.append(tokens[start:end])
        start = end + 1
    return parts


def textOf(tokens: Tokens) -> str:
    """The text of an expression: its literals, {} for each value, {one|other} for a choice."""
    question = upTo(tokens, 0, "?")
    if question < len(tokens):
        colon = upTo(tokens, question + 1, ":")
        sides = [textOf(tokens[question + 1:colon]), textOf(tokens[colon + 1:])]
        return "{}" if set(sides) <= {"{}", ""} else "{" + "|".join(sides) + "}"
    text = "".join(map(operandText, split(tokens, "+")))
    return text if text.strip("{}") else text[:2]


def operandText(tokens: Tokens) -> str:
    if tokens and all(token[0] == '"' for token in tokens):
        return "".join(token[1:] for token in tokens)
    opening = next((i for i, token in enumerate(tokens[:2]) if token in ("(", "{")), None)
    if opening is None or upTo(tokens, opening + 1, "") != len(tokens) - 1:
        return "{}"
    arguments = split(tokens[opening + 1:-1], ",")
    if opening == 0:
        return textOf(arguments[-1])
    if tokens[0].endswith("format"):
        return formatted(arguments)
    return textOf(arguments[0]) if tokens[0] == "std::string" else "{}"


def formatted(arguments: list[Tokens]) -> str:
    """The text of a format string with its values."""
    values = iter(arguments[1:])
    text = textOf(arguments[0]).replace("{{", "(").replace("}}", ")")
    return FIELD.sub(lambda _: textOf(next(values, [])) or "{}", text)


def reported(name: str, arguments: list[Tokens]) -> Iterator[str]:
    """The sentences in a call of a function that reports."""
    if name.endswith("fprintf") and arguments[0] != ["stderr"]:
        return
    for i, argument in enumerate(arguments):
        text = textOf(argument)
        if "%" in text and i + 1 < len(arguments):
            yield formatted(arguments[i:])
            return
        yield text


def isSentence(text: str) -> bool:
    return len(WORD.findall(text)) >= 3 and PROSE.search(text) is not None


def reasons(word: str, tokens: Tokens) -> Iterator[str]:
    """The sentences that a return, an assignment or a table gives."""
    end = upTo(tokens, 0, ";(" if word == "constexpr" else ";")
    if word != "constexpr":
        yield textOf(tokens[tokens[0] in ("=", "+="):end])
    elif tokens[end:end + 1] == [";"]:  # not a function
        yield from (text[1:] for text in tokens[:end] if text[0] == '"')


def sentencesOf(path: str, tokens: Tokens) -> Iterator[str]:
    for i, token in enumerate(tokens[:-1]):
        name = token.split("::")[-1]
        if tokens[i + 1] in ("(", "{") and (REPORTS.fullmatch(name) or REPORTS.fullmatch(re.split(r"\.|->", name)[-1])):
            arguments = split(tokens[i + 2:upTo(tokens, i + 2, "")], ",")
            yield from (text for text in reported(name, arguments) if len(WORD.findall(text)) >= 2)
        if REASON.fullmatch(name) and not NO_REASONS.search(path):
            yield from filter(isSentence, reasons(name, tokens[i + 1:i + 1000]))


def sentencesOfFile(root: pathlib.Path, path: pathlib.Path) -> set[str]:
    source = path.read_text("utf-8")
    if path.suffix == ".rs":
        texts = re.findall(r'//[^\n]*|"((?:[^"\\\n]|\\.)*)"', source)
        return {FIELD.sub("{}", text) for text in texts if isSentence(text)}
    return {text.strip() for text in sentencesOf(path.relative_to(root).as_posix(), tokensOf(source))}


def listsOf(root: pathlib.Path) -> dict[str, list[str]]:
    """The lines of each list."""
    lists: dict[str, set[str]] = {tool: set() for tool in TOOLS.values()}
    for path in (path for top in ("format", "preprocess", "runtime") for path in (root / top).rglob("*")):
        room = path.parent.relative_to(root).as_posix()
        tool = next((TOOLS[head] for head in TOOLS if (room + "/").startswith(head + "/")), "")
        if path.suffix in (".cpp", ".h", ".hpp", ".rs"):
            lists[tool] |= {f"{room}: {text}" for text in sentencesOfFile(root, path)}
    return {tool: sorted(lines) for tool, lines in lists.items()}


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--update", action="store_true", help="rewrite the lists")
    parser.add_argument("repository", type=pathlib.Path)
    arguments = parser.parse_args()
    findings: list[str] = []
    for tool, lines in listsOf(arguments.repository).items():
        path = arguments.repository / f"tests/structure/sentences/{tool}.txt"
        if arguments.update:
            path.write_text("".join(line + "\n" for line in lines), "utf-8")
        listed = path.read_text("utf-8").splitlines()
        findings += difflib.unified_diff(listed, lines, str(path), "the sources", n=0, lineterm="")
        findings += [f"{line}: {advice}" for line in lines for rule, advice in RULES.items()
                     if re.match(rule, line.split(": ", 1)[1])]
    if findings:
        print(*findings, "To accept changed sentences: python3 tests/structure/sentences.py --update .", sep="\n")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
