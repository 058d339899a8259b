"""Runs every sh block of a document, one after the other in one folder, and loads every json block as a scene.

usage: commands.py DOCUMENT BIN WORK

In the folder `data` is the repository's, and the programs of BIN are found. Commands of the table in tests/docs/README.md are
left out.
"""
import os
import pathlib
import shutil
import subprocess
import sys

from commands_table import commands_not_run, logical_lines, without_comment
from documents import ROOT, blocks


def script_of(block, left_out):
    kept = [line for line in logical_lines(block.text) if without_comment(line) not in left_out]
    return "\n".join(kept)


def run(document, block, script, folder, environment):
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{document}:{block.line}: exit code {done.returncode} from\n{script}\n{done.stdout}")


def main():
    document, programs, work = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    (work / "data").symlink_to(ROOT / "data")
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}")
    left_out, count = commands_not_run(), 0
    for block in blocks(document):
        if block.language == "sh":
            script = script_of(block, left_out)
            if script.strip():
                run(document, block, script, work, environment)
                count += 1
        elif block.language == "json":
            scene = work / f"scene-{block.line}.json"
            scene.write_text(block.text)
            run(document, block, f"penumbra classify --strict {scene.name}", work, environment)
            count += 1
    print(f"{document}: {count} blocks run")


main()
