"""Runs every sh block of a document, one after the other in one folder, and loads every json block as a scene.

usage: commands.py DOCUMENT BIN WORK
       commands.py --list

--list prints the documents that have something to run. In the folder `data` is the repository's, and the programs of BIN are found. Commands of the table in tests/docs/README.md are
left out.
"""
import os
import pathlib
import shutil
import subprocess
import sys

from commands_table import commands_not_run, logical_lines, without_comment
from documents import ROOT, blocks, documents


def script_of(block, left_out):
    kept = [line for line in logical_lines(block.text) if without_comment(line) not in left_out]
    return "\n".join(kept)


def run(document, block, script, folder, environment):
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{document}:{block.line}: exit code {done.returncode} from\n{script}\n{done.stdout}")


def blocks_to_run(document):
    """Pairs of a block and its script; of a json block the script is None."""
    left_out, found = commands_not_run(), []
    for block in blocks(document):
        if block.language == "json":
            found.append((block, None))
        elif block.language == "sh" and (script := script_of(block, left_out)).strip():
            found.append((block, script))
    return found


def run_all(document, programs, work):
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    (work / "data").symlink_to(ROOT / "data")
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}")
    to_run = blocks_to_run(document)
    for block, script in to_run:
        if script is None:
            scene = work / f"scene-{block.line}.json"
            scene.write_text(block.text)
            script = f"penumbra classify --strict {scene.name}"
        run(document, block, script, work, environment)
    if not to_run:
        sys.exit(f"{document}: nothing to run")
    print(f"{document}: {len(to_run)} blocks run")


if sys.argv[1] == "--list":
    print("\n".join(str(document) for document in documents() if blocks_to_run(document)))
else:
    run_all(sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]))
