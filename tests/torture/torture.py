#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The tools killed, or failed by the system, at any system call that writes: nothing damaged, nothing stale after the
next run.

    torture.py [CASE[.GROUP]...] [--all] [--table FILE.md]

CASE is a command of commands.py, GROUP what befalls it: killed (before a call, or amid a write), failed (EIO, ENOSPC,
EACCES, at one call or from one on) or short (a write takes less than it was given). Without a group all of them do,
without names all are run. First the command runs undisturbed, which tells its calls and what it leaves. Then it runs
once for each call, or without --all for as many as take seconds: those that are first of their kind, and others spread
evenly over the run.
POINTRT_BIN is the folder of the tools, POINTRT_NTH_CALL the program nth_call, POINTRT_DRIVER_CACHE where the driver keeps
compiled programs from case to case, if it is set.

What a killed or failed run leaves under a name is what was there before, or what an undisturbed run leaves there: all
of it. A run that failed says so in one line, with exit status 4, and leaves nothing else, but for what a bake of tiles
goes on with and caches. One that goes on all the same, which it may where the call was only of use, leaves what an
undisturbed run does. The same command again leaves that in any case, and not a file more.
"""
import argparse
import collections
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import typing

import commands

EVERY = 1 << 30  # runs: more than any command has calls
HANGS_S = 240  # as in tests/end_to_end/lib.sh
SKIPPED = 77   # CTest's
CANNOT = 125   # nth_call's
MOST_TOLD = 3  # complaints of a run

DATA = {"write", "pwrite", "writev", "pwritev", "pwritev2"}
NAMED = {"open", "open-nameless", "creat", "link", "symlink", "rename", "mkdir", "truncate", "unlink", "rmdir", "chmod",
         "fchmodat", "chown", "fchownat", "utimensat"}
TAKES_AWAY = {"unlink", "rmdir"}
TAKES_NO_SPACE = TAKES_AWAY | {"chmod", "fchmod", "fchmodat", "chown", "fchown", "fchownat", "utimensat"}
# Who goes on after these has not written what it says.
MUST_FAIL = DATA | {"copy_file_range", "sendfile", "splice", "fallocate", "ftruncate", "truncate", "fsync", "fdatasync"}

THERE = re.compile(r": .*exists; --force [^\n]*$")
ERROR = r"pointrt-[a-z]+: error: [^\n]+: [^\n]+\n"
TEMPORARY = re.compile(r"\.tmp-[A-Za-z0-9]+( \(deleted\))?$")

GROUPS = {
    "killed": {"kill": lambda name: True, "tear": lambda name: name in DATA},
    "failed": {
        "EIO": lambda name: True,
        "ENOSPC": lambda name: name not in TAKES_NO_SPACE,
        "ENOSPC+": lambda name: name not in TAKES_NO_SPACE,
        "EACCES": lambda name: name in NAMED,
        "EACCES+": lambda name: name in NAMED,
    },
    "short": {"short": lambda name: name in DATA},
}
# Left: by runs, beside what was there and what is to be. Wrong: something damaged, or not told as it should be.
TABLE_HEAD = """| command | what befalls it | calls | runs | done all the same | left | wrong | stale after the next run | what was left |
|---|---|---|---|---|---|---|---|---|
"""
UNDISTURBED = ("kill", 0)
SHORT = ("short", "halve")
SHORT_SHARE = 4  # such runs come to their end and take the longest


@dataclasses.dataclass(frozen=True)
class Fault:
    how: str
    at: int  # which call, from 1
    name: str
    path: str


class Ended(typing.NamedTuple):
    code: typing.Optional[int]  # none: it had to be ended
    stderr: str


def content_of(path, case, name):
    """What a file holds, as far as it is the same in each run."""
    data = path.read_bytes()
    if name not in case.told:
        return hashlib.sha256(data).hexdigest()
    try:
        return "a report" if json.loads(data) else "an empty report"
    except ValueError:
        return "damaged"


def tree_of(folder, case):
    """{path: what is there} of all below a folder."""
    tree = {}
    for path in folder.rglob("*"):
        name = str(path.relative_to(folder))
        if path.is_symlink():
            tree[name] = "link to " + os.readlink(path)
        else:
            tree[name] = "folder" if path.is_dir() else content_of(path, case, name)
    return tree


def below(folder, tree):
    return {name: what for name, what in tree.items() if (name + "/").startswith(folder + "/")}


def kind_of(path):
    """A path without what is another in each run, or in each file of many."""
    path = re.sub(r"#\d+ \(deleted\)$", "(nameless)", path)
    path = TEMPORARY.sub(".tmp-*", path)
    return re.sub(r"\d+", "N", path)


def spread(items, count):
    """So many of them, from the first to the last."""
    count = min(count, len(items))
    return [items[i * (len(items) - 1) // max(count - 1, 1)] for i in range(count)]


class Torture:
    def __init__(self, case, folder):
        self.case = case
        self.folder = folder / "tree"
        self.kept = folder / "before"
        self.log = folder / "calls"
        self.nth_call = os.environ["POINTRT_NTH_CALL"]
        self.environment = dict(
            os.environ, LC_ALL="C", HOME=str(self.folder / "home"), TMPDIR=str(self.folder / "tmp"),
            XDG_CACHE_HOME=str(self.folder / "cache"),
            # files that are not ours
            MESA_SHADER_CACHE_DIR=os.environ.get("POINTRT_DRIVER_CACHE", str(folder / "driver")),
            PATH=os.environ["POINTRT_BIN"] + os.pathsep + os.environ["PATH"], **case.environment)
        self.environment.pop("POINTRT_INDEX_CACHE", None)
        self.verdicts = {}  # of next runs, by the tree that they found
        self.told = []
        self.rows = {}
        self.names = collections.defaultdict(set)  # of what was left

    def prepare(self):
        """The tree before the command, and what the command does where nothing befalls it."""
        for name in ("in", "out", "home", "tmp"):
            (self.folder / name).mkdir(parents=True)
        self.case.prepare(self)
        shutil.copytree(self.folder, self.kept, symlinks=True)
        self.before = tree_of(self.folder, self.case)
        ended = self.run(*UNDISTURBED)
        if ended.code == CANNOT:
            print("SKIPPED: this kernel hands no system calls to another program", file=sys.stderr)
            sys.exit(SKIPPED)
        if ended.code != 0:
            sys.exit(f"the undisturbed run failed: {ended.stderr}")
        self.after = tree_of(self.folder, self.case)
        self.calls = self.read_log()
        if not self.calls:
            sys.exit("the undisturbed run writes nothing")
        wrong = self.again()
        if wrong:
            sys.exit("\n".join(["a second undisturbed run:"] + wrong))

    def tool(self, *words):
        """One of the tools, while the tree is prepared."""
        subprocess.run([str(each) for each in words], cwd=self.folder, env=self.environment, check=True,
                       stdin=subprocess.DEVNULL)

    def run(self, how, at):
        """The case's command, and what befalls its call at."""
        words = [self.nth_call, str(self.folder), str(self.log), how, str(at)]
        child = subprocess.Popen(words + self.case.command, cwd=self.folder, env=self.environment, text=True,
                                 stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                 start_new_session=True)
        try:
            stderr = child.communicate(timeout=HANGS_S)[1]
            return Ended(child.returncode, stderr)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            child.communicate()
            return Ended(None, "it hangs")

    def read_log(self):
        return [tuple(line.split(" ", 1)) for line in self.log.read_text().splitlines()]

    def restore(self):
        shutil.rmtree(self.folder)
        shutil.copytree(self.kept, self.folder, symlinks=True)

    def choose(self, group, most):
        """What befalls the command, at most so often: the first calls of each kind before the others."""
        first, others, met = [], [], set()
        for at, (name, path) in enumerate(self.calls, 1):
            for how in (how for how, can_be in GROUPS[group].items() if can_be(name)):
                kind = (how, name, kind_of(path))
                (others if kind in met else first).append(Fault(how, at, name, path))
                met.add(kind)
        if group == "short":
            most //= SHORT_SHARE
        chosen = spread(first, most)
        chosen += spread(others, most - len(chosen))
        if group == "short":
            chosen.append(Fault("halve", 1, *self.calls[0]))
        return chosen

    def damage(self, tree):
        """Names under which there is neither what was there nor what is to be."""
        found = [name for name in sorted(self.before.keys() | self.after.keys())
                 if tree.get(name) not in (self.before.get(name), self.after.get(name)) and not self.is_optional(name)
                 and not name.startswith(self.case.stays)]
        found += [folder for folder in self.case.whole
                  if below(folder, tree) not in (below(folder, self.before), below(folder, self.after))]
        return [f"damaged: {name}" for name in found]

    def differences(self, tree):
        """From what an undisturbed run leaves."""
        return sorted(name for name in tree.keys() | self.after.keys() if tree.get(name) != self.after.get(name))

    def is_optional(self, path):
        return path.startswith(self.case.optional)

    def complaints_of(self, fault, ended, tree):
        if ended.code is None:
            return ["it hangs"]
        if fault.how in ("kill", "tear"):
            was_killed = ended.code == 128 + signal.SIGKILL or not fault.name
            return self.damage(tree) + ([] if was_killed else [f"exit status {ended.code} where it was to be killed"])
        return (self.complaints_if_done if ended.code == 0 else self.complaints_if_failed)(fault, ended, tree)

    def complaints_if_done(self, fault, ended, tree):
        if self.case.is_window:
            return self.damage(tree) + ([] if re.fullmatch(f"({ERROR})*", ended.stderr) else [f"stderr is {ended.stderr!r}"])
        complaints = [f"done, with another {name}" for name in self.differences(tree)
                      if not self.is_optional(name) and (name in self.after or fault.name not in TAKES_AWAY)]
        if fault.how not in SHORT and fault.name in MUST_FAIL and not self.is_optional(fault.path[1:]):
            complaints.append("done, though a write failed")
        return complaints

    def complaints_if_failed(self, fault, ended, tree):
        complaints = self.damage(tree)
        if fault.how in SHORT or self.is_optional(fault.path[1:]) and not fault.how.endswith("+"):
            complaints.append("it failed, where it was to go on")
        if ended.code != 4:
            complaints.append(f"exit status {ended.code}")
        if not re.fullmatch(f"({ERROR})+" if self.case.is_window else ERROR, ended.stderr):
            complaints.append(f"stderr is {ended.stderr!r}")
        if fault.name not in TAKES_AWAY and fault.how != "EACCES+":  # who may take nothing away leaves it
            complaints += [f"left: {name}" for name in self.left(tree)
                           if not self.is_optional(name) and not name.startswith(self.case.stays)]
        return complaints

    def left(self, tree):
        """What an undisturbed run neither finds nor leaves."""
        return sorted(tree.keys() - self.before.keys() - self.after.keys())

    def befallen(self, fault):
        """With the call that it was in this run, or none: threads do not do the same each time."""
        calls = self.read_log()
        name, path = calls[fault.at - 1] if fault.at <= len(calls) else ("", "")
        fails = GROUPS["failed"].get(fault.how)
        if fails and not fault.how.endswith("+") and not fails(name):
            name, path = "", ""  # which nth_call let through
        return dataclasses.replace(fault, name=name, path=path)

    def next_run(self, tree):
        """What is wrong after the same command again, undisturbed."""
        if tree == self.before:
            return []
        key = frozenset((TEMPORARY.sub(".tmp-*", name), what) for name, what in tree.items())
        if key not in self.verdicts:
            self.verdicts[key] = self.again()
        return self.verdicts[key]

    def again(self):
        """The same command again: as the first one, or it says that all is there."""
        there = tree_of(self.folder, self.case)
        if self.case.is_window:
            self.take_away_whole(there)
        ended = self.run(*UNDISTURBED)
        says_there = ended.code == 4 and THERE.search(ended.stderr) and self.after.items() <= there.items()
        tree = tree_of(self.folder, self.case)
        wrong = [] if ended.code == 0 or says_there else [f"the next run: exit status {ended.code}: {ended.stderr.strip()}"]
        return wrong + [f"not repaired by the next run: {name}" if name in self.after else
                        f"stale after the next run: {name}" for name in self.differences(tree)]

    def take_away_whole(self, tree):
        """What a run has written to its end, since the next one would take other names."""
        for name in tree.keys() & self.after.keys() - self.before.keys():
            if tree[name] == self.after[name] != "folder":
                (self.folder / name).unlink()

    def inflict(self, fault):
        self.restore()
        ended = self.run(fault.how, fault.at)
        fault = self.befallen(fault)
        tree = tree_of(self.folder, self.case)
        complaints = self.complaints_of(fault, ended, tree)
        next_complaints = self.next_run(tree)
        row = self.rows.setdefault(fault.how, collections.Counter())
        row["runs"] += 1
        row["done"] += ended.code == 0
        row["left"] += bool(self.left(tree))
        self.names[fault.how] |= {kind_of(name) for name in self.left(tree) if os.path.dirname(name) not in self.left(tree)}
        row["wrong"] += bool(complaints)
        row["stale"] += bool(next_complaints)
        found = complaints + next_complaints
        if found:
            more = f"; and {len(found) - MOST_TOLD} more" if len(found) > MOST_TOLD else ""
            self.told.append(f"{fault.how} at call {fault.at}, {fault.name} {fault.path}: "
                             f"{'; '.join(found[:MOST_TOLD])}{more}")
            print(self.told[-1], flush=True)


def row_of(case_name, how, run):
    row, names = run.rows[how], ", ".join(f"`{name}`" for name in sorted(run.names[how]))
    numbers = [str(row[each]) for each in ("runs", "done", "left", "wrong", "stale")]
    return f"| {' | '.join([case_name, how, str(len(run.calls))] + numbers)} | {names} |"


def torture(name, options, folder):
    """Runs a case, with one group or all; its complaints, and its rows for the table."""
    case_name, _, only = name.partition(".")
    case = commands.case_of(case_name)
    run = Torture(case, folder)
    run.prepare()
    for group in [only] if only else GROUPS:
        faults = run.choose(group, EVERY if options.all else case.most)
        print(f"{case_name}.{group}: {len(run.calls)} calls, {len(faults)} runs", flush=True)
        for fault in faults:
            run.inflict(fault)
    return run.told, [row_of(case_name, how, run) for how in run.rows]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="CASE[.GROUP]")
    parser.add_argument("--all", action="store_true", help="every call")
    parser.add_argument("--table", type=pathlib.Path, help="the rows of a table are appended to it")
    options = parser.parse_args()
    complaints = []
    for name in options.names or commands.names():
        with tempfile.TemporaryDirectory() as folder:
            told, rows = torture(name, options, pathlib.Path(folder).resolve())
        complaints += told
        if options.table:
            head = "" if options.table.exists() else TABLE_HEAD
            with open(options.table, "a") as table:
                table.write(head + "\n".join(rows) + "\n")
    sys.exit(f"{len(complaints)} runs were not as they should be" if complaints else 0)


if __name__ == "__main__":
    main()
