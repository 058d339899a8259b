"""A study by two processes under mpirun has the rows of one alone but for times, also where one of them is killed.

usage: ranks_test.py PENUMBRA MPIRUN WORK

Exit code 77 where this penumbra was built without MPI.
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from mpi_ranks import process_of_rank

DATA = pathlib.Path(__file__).resolve().parents[3] / "data/scenes"
STUDY = ["study", *(str(DATA / f"{name}.json") for name in ("cube-small", "torus-small")), "--size", "64x48", "--samples", "64",
         "--frames", "1", "--no-memory", "--methods", "silhouette,reference,rays"]
ROWS_BEFORE = 4
TIMEOUT = 240

# Tests run as root in containers.
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def rows_of(folder):
    return {row["key"]: row for row in json.loads((folder / "study.json").read_text())["rows"]}


def errors_of(folder):
    return {key: row["error"] for key, row in rows_of(folder).items()}


def written(folder):
    path = folder / "rows.jsonl"
    return path.read_text().count('{"row":') if path.exists() else 0


def kill_one(command, folder):
    """Runs the command, and kills rank 1 when some rows are there. Returns the exit code."""
    running = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while written(folder) < ROWS_BEFORE:
        if running.poll() is not None:
            sys.exit("the study ended before a rank was killed")
        time.sleep(.01)
    os.kill(process_of_rank(running.pid, 1), signal.SIGKILL)
    return running.wait(TIMEOUT)


def main():
    penumbra, mpirun, work = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)

    def command(name, *flags, ranks=True):
        start = [mpirun, "-n", "2", "--oversubscribe", *flags] if ranks else []
        return [*start, penumbra, *STUDY, "--output", str(work / name)]

    subprocess.run(command("alone", ranks=False), check=True, timeout=TIMEOUT)
    expected = errors_of(work / "alone")
    together = subprocess.run(command("together"), text=True, capture_output=True, timeout=TIMEOUT)
    if "built without MPI" in together.stderr:
        sys.exit(77)
    if together.returncode != 0:
        sys.exit(together.stderr)
    if errors_of(work / "together") != expected:
        sys.exit("errors by two ranks are not those of one alone")
    pictures = {path.name for path in (work / "alone/pictures").iterdir()}
    if {path.name for path in (work / "together/pictures").iterdir()} != pictures:
        sys.exit("pictures by two ranks are not those of one alone")

    # With recovery the run goes on, and the row of the killed rank is done again.
    if kill_one(command("killed", "--enable-recovery"), work / "killed") != 0:
        sys.exit("a killed rank ends a study that recovers")
    if errors_of(work / "killed") != expected:
        sys.exit("errors are others after a rank was killed")

    # Without, mpirun ends all. A second call does what is missing.
    if kill_one(command("ended"), work / "ended") == 0:
        sys.exit("mpirun does not say that a rank was killed")
    before = written(work / "ended")
    if not ROWS_BEFORE <= before < len(expected):
        sys.exit(f"{before} of {len(expected)} rows were there when all had ended")
    subprocess.run(command("ended"), check=True, timeout=TIMEOUT)
    if errors_of(work / "ended") != expected:
        sys.exit("errors are others after a second call")
    print(f"{len(expected)} rows; {before} before a second call")


main()
