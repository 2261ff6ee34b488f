#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Kills the tools, or lets system calls fail, at each system call that writes. Checks that no file is damaged, and that
nothing stale remains after the next run.

    torture.py [CASE[.GROUP]...] [--all] [--table FILE.md]

CASE is a command of commands.py. GROUP is a kind of fault: killed (before a call, or amid a write), failed (EIO, ENOSPC or
EACCES, at one call or from one call on) or short (a write accepts fewer bytes than it was given). Default: all groups of
all cases. The command first runs undisturbed, which gives its calls and its results. Then it runs once for each call;
without --all, only for the first call of each kind and some others spread evenly over the run, so that a case takes
seconds.
POINTRT_BIN: the folder of the tools. POINTRT_NTH_CALL: the program nth_call. POINTRT_DRIVER_CACHE (optional): where the
driver caches compiled programs from case to case.

After a killed or failed run, each file must be complete: either as before the run, or as after an undisturbed one. A
failed run must print one line and exit with 4. It must leave no other files, except caches and the work folder from which
a bake of tiles resumes. A run may succeed in spite of the fault if the call is optional: then its results must be those
of an undisturbed run. In any case, the next run of the same command must have these results, and leave no file more.
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
MOST_SHOWN = 3  # complaints of a run

DATA = {"write", "pwrite", "writev", "pwritev", "pwritev2"}
NAMED = {"open", "open-nameless", "creat", "link", "symlink", "rename", "mkdir", "truncate", "unlink", "rmdir", "chmod",
         "fchmodat", "chown", "fchownat", "utimensat"}
TAKES_AWAY = {"unlink", "rmdir"}
TAKES_NO_SPACE = TAKES_AWAY | {"chmod", "fchmod", "fchmodat", "chown", "fchown", "fchownat", "utimensat"}
# If one of these fails and the tool still reports success, its output is incomplete.
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
# Left over: runs with files that are neither there before nor after an undisturbed run. Wrong: runs with a damaged file, or
# with a wrong exit status or message.
TABLE_HEAD = """| command | fault | calls | runs | succeeded | left over | wrong | stale after the next run | files left over |
|---|---|---|---|---|---|---|---|---|
"""
UNDISTURBED = ("kill", 0)
SHORT = ("short", "halve")
# one short fault per this many faults of the other groups: these runs are the longest, because they complete
SHORT_SHARE = 4


@dataclasses.dataclass(frozen=True)
class Fault:
    how: str
    at: int  # which call, from 1
    name: str
    path: str


class Ended(typing.NamedTuple):
    code: typing.Optional[int]  # none: it hung and was killed
    stderr: str


def content_of(path, case, name):
    """A summary of the file's content that is the same for each run."""
    data = path.read_bytes()
    if name not in case.reports:
        return hashlib.sha256(data).hexdigest()
    try:
        return "a report" if json.loads(data) else "an empty report"
    except ValueError:
        return "damaged"


def tree_of(folder, case):
    """{path: summary} of all files and folders in a folder."""
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
    """A path without the parts that differ between runs, or between files of a series."""
    path = re.sub(r"#\d+ \(deleted\)$", "(nameless)", path)
    path = TEMPORARY.sub(".tmp-*", path)
    return re.sub(r"\d+", "N", path)


def spread(items, count):
    """At most count items, evenly spread from the first to the last."""
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
            # the driver's files do not count
            MESA_SHADER_CACHE_DIR=os.environ.get("POINTRT_DRIVER_CACHE", str(folder / "driver")),
            PATH=os.environ["POINTRT_BIN"] + os.pathsep + os.environ["PATH"], **case.environment)
        self.environment.pop("POINTRT_INDEX_CACHE", None)
        self.verdicts = {}  # complaints about next runs, by the tree they start with
        self.messages = []
        self.rows = {}
        self.names = collections.defaultdict(set)  # of files left over

    def prepare(self):
        """Makes the tree before the command, and runs the command undisturbed to get its calls and results."""
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
        """Runs a tool to prepare the tree."""
        subprocess.run([str(each) for each in words], cwd=self.folder, env=self.environment, check=True,
                       stdin=subprocess.DEVNULL)

    def run(self, how, at):
        """Runs the case's command with the fault how at call number at."""
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
        """At most `most` faults of a group: the first calls of each kind before the others."""
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
        """Files whose content is neither that before the run nor that after an undisturbed run."""
        found = [name for name in sorted(self.before.keys() | self.after.keys())
                 if tree.get(name) not in (self.before.get(name), self.after.get(name)) and not self.is_optional(name)
                 and not name.startswith(self.case.stays)]
        found += [folder for folder in self.case.whole
                  if below(folder, tree) not in (below(folder, self.before), below(folder, self.after))]
        return [f"damaged: {name}" for name in found]

    def differences(self, tree):
        """Files that differ from those after an undisturbed run."""
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
            complaints.append("it failed, although it could continue")
        if ended.code != 4:
            complaints.append(f"exit status {ended.code}")
        if not re.fullmatch(f"({ERROR})+" if self.case.is_window else ERROR, ended.stderr):
            complaints.append(f"stderr is {ended.stderr!r}")
        if fault.name not in TAKES_AWAY and fault.how != "EACCES+":  # otherwise the tool could not delete its files
            complaints += [f"left: {name}" for name in self.left(tree)
                           if not self.is_optional(name) and not name.startswith(self.case.stays)]
        return complaints

    def left(self, tree):
        """Files that are there neither before nor after an undisturbed run."""
        return sorted(tree.keys() - self.before.keys() - self.after.keys())

    def fault_in_log(self, fault):
        """The fault with the call that it actually hit, or none: the order of calls varies with threads."""
        calls = self.read_log()
        name, path = calls[fault.at - 1] if fault.at <= len(calls) else ("", "")
        fails = GROUPS["failed"].get(fault.how)
        if fails and not fault.how.endswith("+") and not fails(name):
            name, path = "", ""  # nth_call did not make this call fail
        return dataclasses.replace(fault, name=name, path=path)

    def next_run(self, tree):
        """Complaints about the next undisturbed run of the command."""
        if tree == self.before:
            return []
        key = frozenset((TEMPORARY.sub(".tmp-*", name), what) for name, what in tree.items())
        if key not in self.verdicts:
            self.verdicts[key] = self.again()
        return self.verdicts[key]

    def again(self):
        """Runs the command again, undisturbed: it must have the same results, or report that the output exists."""
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
        """Deletes the files that a run of the window has completed: the next one would choose other names."""
        for name in tree.keys() & self.after.keys() - self.before.keys():
            if tree[name] == self.after[name] != "folder":
                (self.folder / name).unlink()

    def inflict(self, fault):
        self.restore()
        ended = self.run(fault.how, fault.at)
        fault = self.fault_in_log(fault)
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
            more = f"; and {len(found) - MOST_SHOWN} more" if len(found) > MOST_SHOWN else ""
            self.messages.append(f"{fault.how} at call {fault.at}, {fault.name} {fault.path}: "
                                 f"{'; '.join(found[:MOST_SHOWN])}{more}")
            print(self.messages[-1], flush=True)


def row_of(case_name, how, run):
    row, names = run.rows[how], ", ".join(f"`{name}`" for name in sorted(run.names[how]))
    numbers = [str(row[each]) for each in ("runs", "done", "left", "wrong", "stale")]
    return f"| {' | '.join([case_name, how, str(len(run.calls))] + numbers)} | {names} |"


def torture(name, options, folder):
    """Runs a case with one group of faults, or all. Returns its complaints and its rows of the table."""
    case_name, _, only = name.partition(".")
    case = commands.case_of(case_name)
    run = Torture(case, folder)
    run.prepare()
    for group in [only] if only else GROUPS:
        faults = run.choose(group, EVERY if options.all else case.most)
        print(f"{case_name}.{group}: {len(run.calls)} calls, {len(faults)} runs", flush=True)
        for fault in faults:
            run.inflict(fault)
    return run.messages, [row_of(case_name, how, run) for how in run.rows]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="CASE[.GROUP]")
    parser.add_argument("--all", action="store_true", help="every call")
    parser.add_argument("--table", type=pathlib.Path, help="the rows of a table are appended to it")
    options = parser.parse_args()
    complaints = []
    for name in options.names or commands.names():
        with tempfile.TemporaryDirectory() as folder:
            messages, rows = torture(name, options, pathlib.Path(folder).resolve())
        complaints += messages
        if options.table:
            head = "" if options.table.exists() else TABLE_HEAD
            with open(options.table, "a") as table:
                table.write(head + "\n".join(rows) + "\n")
    sys.exit(f"{len(complaints)} runs were not as they should be" if complaints else 0)


if __name__ == "__main__":
    main()
