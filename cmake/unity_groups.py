#!/usr/bin/env python3
"""Which source files can be compiled together: prints "file=group;file=group" for cmake's UNITY_GROUP.

Files of a group are compiled as one, which parses headers once. Helpers in anonymous namespaces then share a scope, so a file that
has a helper and one that says the same word are kept apart, also where it is in a header that a file alone would not see. So are
files that take a name from another namespace (`using a::name`) and those that say that word without it. Files that define macros or
open namespaces (`using namespace`) stay alone. Not seen are overloads: a header's that one file lacks, or an operator's.
Usage: unity_groups.py FILES_A_GROUP INCLUDE_FOLDER[:INCLUDE_FOLDER...] FILE...
"""
import functools
import pathlib
import re
import sys

KEYWORDS = {"TEST", "TEST_F", "TEST_P", "if", "for", "while", "switch", "return", "void", "operator", "namespace", "public", "private"}
TYPE = re.compile(r"(?:struct|class|union|enum(?:\s+class)?)\s+(?:alignas\([^)]*\)\s*)?(\w+)")
ALIAS = re.compile(r"(?:using|namespace)\s+(\w+)\s*=")
OTHER = re.compile(r"^[^(={;\[]*?(\w+)\s*[(={;\[]")
ALONE = re.compile(r"^(\s*#\s*(define|undef)\b|using\s+namespace\b)", re.M)
USED = re.compile(r"^using\s+([^=;]*);", re.M)
CONTINUED = re.compile(r"\s+(k[A-Z]\w*)\s*[={,]")  # a constant, on a line after its type's
NEXT = re.compile(r",\s*(\w+)\s*=")


def declared(line):
    """The names that a line at the outermost level declares."""
    line = re.sub(r"^template\s*<.*?>\s*(?=\w)", "", line)
    for pattern in (TYPE, ALIAS, OTHER):
        match = pattern.match(line)
        if match:
            return {match.group(1), *NEXT.findall(line)} - KEYWORDS
    return set()


def names(text):
    """Names of anonymous namespaces and static functions; what clang-format leaves at the start of a line is outermost."""
    found, anonymous = set(), False
    for line in text.splitlines():
        if line == "namespace {":
            anonymous = True
        elif anonymous and line.startswith("}") and re.match(r"\}\s*// namespace$", line):
            anonymous = False
        elif anonymous and (constant := CONTINUED.match(line)):
            found.add(constant.group(1))
        elif re.match(r"\w", line) and (anonymous or line.startswith("static ")):
            found |= declared(line)
    return found


@functools.cache
def declared_in(header):
    lines = header.read_text().splitlines()
    return set().union(*(declared(line) for line in lines if re.match(r"\w", line)))


@functools.cache
def included(file, folders):
    """Our headers that a file names."""
    written = re.findall(r'^#include "(.+)"', file.read_text(), re.M)
    return [header for name in written for header in (folder / name for folder in folders) if header.is_file()]


def headers(file, folders, found=None):
    """All of our headers that a file includes."""
    found = set() if found is None else found
    for header in included(file, folders):
        if header not in found:
            found.add(header)
            headers(header, folders, found)
    return found


def words(text):
    """What a file says but for comments, texts, members and names of namespaces."""
    text = re.sub(r"""R"\w*\(.*?\)\w*"|'(?:[^'\\\n]|\\.)'""", " ", text, flags=re.S)
    text = re.sub(r'//.*|"(?:[^"\\\n]|\\.)*"', " ", text)
    return set(re.findall(r"(?<![\w.>:])[A-Za-z_]\w*", text))


def used(text):
    """Names taken from other namespaces, and what they stand for."""
    return {name.split("::")[-1].strip(): name.strip() for line in USED.findall(text) for name in line.split(",")}


def fit(a, b):
    """Whether no helper of one file meets a name of the other, or of a header that only the other includes."""
    if a["own"] & b["words"] or b["own"] & a["words"] or any(b["used"].get(name, whole) != whole for name, whole in a["used"].items()):
        return False
    return not any(one["own"] & (other["seen"] - one["seen"]) or one["used"].keys() & (other["words"] | other["own"]) - other["used"].keys()
                   for one, other in ((a, b), (b, a)))


def main():
    most, folders = int(sys.argv[1]), tuple(map(pathlib.Path, sys.argv[2].split(":")))
    groups, out = [], []
    for path in sys.argv[3:]:
        text = pathlib.Path(path).read_text()
        if ALONE.search(text):
            continue
        file = {"own": names(text), "words": words(text), "used": used(text), "seen": set().union(*map(declared_in, headers(pathlib.Path(path), folders)))}
        number = next((i for i, group in enumerate(groups) if len(group) < most and all(fit(file, other) for other in group)), len(groups))
        if number == len(groups):
            groups.append([])
        groups[number].append(file)
        out.append(f"{path}=group{number}")
    print(";".join(out), end="")


main()
