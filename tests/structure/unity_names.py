#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Finds names that clash when sources are compiled in one batch: unity_names.py REPOSITORY united.txt

cmake/Unity.cmake writes united.txt: for each target, its name and the sources that it may batch. Names with internal
linkage (in anonymous namespaces, or static) must differ between them, even if today no batch holds both sources: the
next file moves the borders. Functions may share a name if their parameters differ.
"""
import collections
import pathlib
import re
import sys
from typing import Iterator

TOKEN = re.compile(r"""//[^\n]*|/\*.*?\*/|\s+|^[ \t]*\#(?:[^\n\\]|\\.)*
    |(?P<token>R"(\w*)\(.*?\)\2"|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)+'
    |\d(?:[\w.']|(?<=[eEpP])[+-])*|[A-Za-z_]\w*|::|->|&&|[-+*/%&|^<>=!]=|.)""", re.S | re.M | re.X)
NAME = re.compile(r"[A-Za-z_]\w*")
OPENING, CLOSING = {"(": ")", "[": "]", "{": "}"}, ")]}"
TYPES = ("struct", "class", "enum", "union")
SPECIFIERS = ("static", "inline", "constexpr", "consteval", "constinit", "thread_local", "extern", "noexcept")
Tokens = list[str]


class Name(collections.namedtuple("Name", "scope name kind text")):
    """A declaration with internal linkage. scope: its namespaces. kind: "function", "type", "alias" or "variable". text:
    a function's parameters, or what an alias stands for."""

    def clashesWith(self, other: "Name") -> bool:
        if self.kind == other.kind and self.kind in ("function", "alias"):
            return (self.text != other.text) == (self.kind == "alias")
        return True


def tokensOf(source: str) -> Tokens:
    return [match["token"] for match in TOKEN.finditer(source) if match["token"]]


def closingOf(tokens: Tokens, opening: int) -> int:
    """The index of the bracket that closes tokens[opening]."""
    depth = 0
    for i in range(opening, len(tokens)):
        depth += (tokens[i] in OPENING) - (tokens[i] in CLOSING)
        if depth == 0:
            return i
    return len(tokens) - 1


def afterAngles(tokens: Tokens, opening: int) -> int:
    """The index behind the > that closes the < at opening."""
    depth, i = 0, opening
    while i < len(tokens):
        if tokens[i] in OPENING:
            i = closingOf(tokens, i)
        depth += (tokens[i] == "<") - (tokens[i] == ">")
        i += 1
        if depth == 0:
            break
    return i


def declarationEnd(tokens: Tokens, start: int) -> int:
    """The index behind the declaration that starts there: behind its semicolon, or behind the body of a function."""
    may_be_function, i = True, start
    while i < len(tokens) and tokens[i] != ";":
        is_type = tokens[i] in TYPES and "(" not in tokens[start:i] and tokens[i - 1] not in ("<", ",")
        may_be_function = may_be_function and not is_type and tokens[i] != "="
        if tokens[i] in OPENING:
            is_body = tokens[i] == "{" and may_be_function
            i = closingOf(tokens, i)
            if is_body and tokens[i + 1:i + 2] not in (["{"], [","], [";"]):
                return i + 1
        i += 1
    return i + 1


def namesIn(tokens: Tokens, scope: tuple[str, ...] = (), is_anonymous: bool = False) -> Iterator[Name]:
    """The names with internal linkage in a namespace."""
    i = 0
    while i < len(tokens):
        opening = next((k for k in range(i, len(tokens)) if tokens[k] in ("{", ";", "=", "(")), i)
        head = " ".join(tokens[i:opening])
        if tokens[opening] == "{" and re.match(r'(inline )?namespace\b|extern "', head):
            inner = tuple(re.findall(r"\w+", re.sub(r'inline|namespace|extern "C"', "", head)))
            end = closingOf(tokens, opening)
            yield from namesIn(tokens[opening + 1:end], scope + inner, is_anonymous or head == "namespace")
            i = end + 1
            continue
        end = declarationEnd(tokens, i)
        declaration = tokens[i:end]
        if is_anonymous or "static" in declaration[:4]:
            yield from namesOf(declaration, scope)
        i = end


def namesOf(declaration: Tokens, scope: tuple[str, ...]) -> Iterator[Name]:
    """The names that a declaration outside of functions and classes declares."""
    parameters: Tokens = []
    start = 0
    while start < len(declaration):
        if declaration[start] == "template":
            end = afterAngles(declaration, start + 1)
            parameters += templateParameters(declaration[start + 2:end - 1])
            start = end
        elif declaration[start:start + 2] == ["[", "["]:
            start = closingOf(declaration, start) + 1
        elif declaration[start] in SPECIFIERS:
            start += 1
        else:
            break
    tokens = [f"T{parameters.index(token)}" if token in parameters else token for token in declaration[start:]]
    if len(tokens) < 2 or tokens[0] in ("namespace", "static_assert", "friend", "asm"):
        return
    if tokens[0] in ("using", "typedef"):
        if tokens[0] == "using" and tokens[2] == "=":
            yield Name(scope, tokens[1], "alias", " ".join(tokens[3:]))
    elif tokens[0] in TYPES and "{" in tokens:
        yield from typeNames(tokens, scope)
    elif tokens[0] not in TYPES or "(" in tokens or "=" in tokens:
        yield from functionOrVariables(tokens, scope)


def templateParameters(tokens: Tokens) -> Tokens:
    return [part[-1] for part in split([t for t in tokens if t != "."]) if part and NAME.fullmatch(part[-1])]


def typeNames(tokens: Tokens, scope: tuple[str, ...]) -> Iterator[Name]:
    body = tokens.index("{")
    is_scoped = tokens[1] in ("class", "struct")
    head = tokens[1 + is_scoped:body]
    if head and NAME.fullmatch(head[0]) and "<" not in head and "::" not in head[:2]:
        yield Name(scope, head[0], "type", "")
    end = closingOf(tokens, body)
    if tokens[0] == "enum" and not is_scoped:
        yield from (Name(scope, part[0], "variable", "") for part in split(tokens[body + 1:end]) if part)
    variables = (part[0] for part in split(tokens[end + 1:-1]) if part)
    yield from (Name(scope, name, "variable", "") for name in variables if NAME.fullmatch(name))


def split(tokens: Tokens) -> list[Tokens]:
    """The parts between commas outside of brackets and of template arguments."""
    parts: list[Tokens] = [[]]
    i = 0
    while i < len(tokens):
        end = i + 1
        if tokens[i] in OPENING:
            end = closingOf(tokens, i) + 1
        elif tokens[i] == "<" and parts[-1] and NAME.fullmatch(parts[-1][-1]) and "=" not in parts[-1]:
            end = afterAngles(tokens, i)
        if tokens[i] == ",":
            parts.append([])
        else:
            parts[-1] += tokens[i:end]
        i = end
    return parts


def functionOrVariables(tokens: Tokens, scope: tuple[str, ...]) -> Iterator[Name]:
    i = 0
    while i < len(tokens) and tokens[i] not in ("(", "=", "{", "[", ";"):
        if tokens[i] == "operator":
            opening = tokens.index("(", i + (2 if tokens[i + 1] == "(" else 1))
            yield Name(scope, "".join(tokens[i:opening]), "function", signatureOf(tokens, opening))
            return
        i = afterAngles(tokens, i) if tokens[i] == "<" else i + 1
    if i < 2 or i >= len(tokens) or not NAME.fullmatch(tokens[i - 1]) or tokens[i - 2] == "::":
        return  # a macro such as TEST, or a member
    if tokens[i] == "(" and not isValue(tokens[i + 1:closingOf(tokens, i)]):
        yield Name(scope, tokens[i - 1], "function", signatureOf(tokens, i))
        return
    yield Name(scope, tokens[i - 1], "variable", "")
    for part in split(tokens[i:])[1:]:
        if part and NAME.fullmatch(part[0]) and part[1:2] and part[1] in ("=", "{", "[", ";"):
            yield Name(scope, part[0], "variable", "")


def isValue(arguments: Tokens) -> bool:
    """Whether these are the arguments of a constructor rather than parameters."""
    return bool(arguments) and re.match(r"[\d\"'-]|R\"|k[A-Z]", arguments[0]) is not None


def signatureOf(tokens: Tokens, opening: int) -> str:
    """The types of a function's parameters, without their names and default values."""
    types = []
    for part in split(tokens[opening + 1:closingOf(tokens, opening)]):
        part = part[:part.index("=")] if "=" in part else part
        while part[-1:] == ["]"]:
            part = part[:len(part) - 1 - part[::-1].index("[")]
        words = [token for token in part if token not in ("const", "volatile")]
        if len(words) > 1 and NAME.fullmatch(part[-1]) and part[-2] != "::" and words[-2] not in ("unsigned", "typename"):
            part = part[:-1]
        if "&" not in part and "*" not in part:
            part = [token for token in part if token != "const"]
        types.append(" ".join(part))
    return ", ".join(types)


def clashes(target: str, sources: dict[str, str]) -> Iterator[str]:
    """A line for each clash. sources: {path: text} of a target."""
    seen: dict[tuple, list[tuple[str, Name]]] = collections.defaultdict(list)
    for path, source in sorted(sources.items()):
        for name in dict.fromkeys(namesIn(tokensOf(source))):
            others = seen[name.scope, name.name]
            clashing = next((other for other, theirs in others if other != path and name.clashesWith(theirs)), None)
            if clashing:
                signature = f"({name.text})" if name.kind == "function" else ""
                yield f"{target}: {clashing} and {path} both have {name.name}{signature}"
            others.append((path, name))


def main() -> int:
    repository, united = map(pathlib.Path, sys.argv[1:])
    targets = [line.split("|") for line in united.read_text("utf-8").splitlines()]
    if not targets:
        print(f"{united}: has no targets")
        return 1
    findings = [line for target, files in targets
                for line in clashes(target, {file: (repository / file).read_text("utf-8") for file in files.split()})]
    if findings:
        print(*findings, sep="\n")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
