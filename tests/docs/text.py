"""Checks of the documents' text that need no program: links, samples, the README's size, the table of commands that are not run.

usage: text.py links|samples|not-run
"""
import re
import sys

from documents import ROOT, blocks, documents, outside_fences
from commands_table import commands_not_run, commands_of

MOST_README_BYTES = 8192
SAMPLE_FOLDERS = ("apps/examples", "tests/consumer")


def anchor_of(heading):
    """As GitHub makes it."""
    plain = re.sub(r"[^\w\- ]", "", heading.strip().lower())
    return plain.replace(" ", "-")


def anchors(path):
    return {anchor_of(line.lstrip("#")) for line in path.read_text().splitlines() if line.startswith("#")}


def bad_links(document):
    for number, line in outside_fences(document):
        for target in re.findall(r"\]\(([^)\s]+)\)", line):
            if target.startswith(("http://", "https://")):
                continue
            name, _, anchor = target.partition("#")
            path = (ROOT / document).parent / name if name else ROOT / document
            if not path.exists():
                yield f"{document}:{number}: no file {target}"
            elif anchor and (path.is_dir() or anchor not in anchors(path)):
                yield f"{document}:{number}: no heading {target}"


def check_links():
    faults = [fault for document in documents() for fault in bad_links(document)]
    size = (ROOT / "README.md").stat().st_size
    if size > MOST_README_BYTES:
        faults.append(f"README.md: {size} bytes, more than {MOST_README_BYTES}")
    return faults


def sources(pattern):
    return {path.relative_to(ROOT): path.read_text() for folder in SAMPLE_FOLDERS
            for path in sorted((ROOT / folder).rglob(pattern))}


def check_samples():
    """C++ blocks are files that are compiled, word for word; CMake blocks are parts of such files, line by line."""
    programs, projects = sources("*.cpp"), sources("CMakeLists.txt")
    faults = []
    for document in documents():
        for block in blocks(document):
            where = f"{document}:{block.line}"
            if block.language == "cpp" and block.text not in programs.values():
                faults.append(f"{where}: no file of {' or '.join(SAMPLE_FOLDERS)} is this sample, word for word")
            if block.language == "cmake" and not any(block.text in text for text in projects.values()):
                faults.append(f"{where}: no CMakeLists.txt of {' or '.join(SAMPLE_FOLDERS)} has these lines")
    return faults


def check_not_run():
    """Every row of the table names a command that some document has; commands are in fences."""
    faults = []
    there = {command for document in documents() for command in commands_of(document)}
    for command in sorted(commands_not_run() - there):
        faults.append(f"tests/docs/README.md: no document has the command {command}")
    for document in documents():
        for number, line in outside_fences(document):
            if re.match(r"    +(penumbra|\./run|cmake|find_package)", line):
                faults.append(f"{document}:{number}: a command outside of a fence")
    return faults


checks = {"links": check_links, "samples": check_samples, "not-run": check_not_run}
found = checks[sys.argv[1]]()
print("\n".join(found) or "nothing found")
sys.exit(1 if found else 0)
