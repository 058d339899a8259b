"""A lightmap by two processes under mpirun is that of one alone, bit for bit, also where one of them is killed; and one process that is killed
loses no part that it has done.

usage: ranks_test.py PENUMBRA MPIRUN WORK

Exit code 77 where this penumbra was built without MPI.
"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from mpi_ranks import process_of_rank

ROOM = pathlib.Path(__file__).resolve().parents[3] / "data/bake/room.json"
PARTS_BEFORE = 5
TIMEOUT = 240

# Tests run as root in containers.
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def parts_in(folder):
    return len(list(folder.glob("*.f32"))) if folder.exists() else 0


def kill_midway(command, parts, rank=None):
    """Runs the command and kills it, or one of its ranks, when some parts are there. Returns the exit code."""
    running = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while parts_in(parts) < PARTS_BEFORE:
        if running.poll() is not None:
            sys.exit("the bake ended before it was killed")
        time.sleep(.002)
    os.kill(running.pid if rank is None else process_of_rank(running.pid, rank), signal.SIGKILL)
    return running.wait(TIMEOUT)


def main():
    penumbra, mpirun, work = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)

    def command(name, *flags, ranks=2):
        start = [mpirun, "-n", str(ranks), "--oversubscribe", *flags] if ranks > 1 else []
        return [*start, penumbra, "bake", str(ROOM), "--lightmap", str(work / name), "--texels", "512", "--texel-samples", "3", "--verbose"]

    def expect_same(name, what):
        if (work / name).read_bytes() != expected:
            sys.exit(f"the map is another {what}")
        if parts_in(work / (name + ".parts")):
            sys.exit(f"parts are left {what}")

    subprocess.run(command("alone.exr", ranks=1), check=True, timeout=TIMEOUT)
    expected = (work / "alone.exr").read_bytes()

    if kill_midway(command("killed.exr", ranks=1), work / "killed.exr.parts") == 0 or (work / "killed.exr").exists():
        sys.exit("a killed bake has a result")
    before = parts_in(work / "killed.exr.parts")
    again = subprocess.run(command("killed.exr", ranks=1), text=True, capture_output=True, check=True, timeout=TIMEOUT)
    if f"{before} of 64 parts were there already" not in again.stderr:
        sys.exit(f"{before} parts were not taken: {again.stderr}")
    expect_same("killed.exr", "after a process was killed and another went on")

    together = subprocess.run(command("together.exr"), text=True, capture_output=True, timeout=TIMEOUT)
    if "built without MPI" in together.stderr:
        sys.exit(77)
    if together.returncode != 0:
        sys.exit(together.stderr)
    expect_same("together.exr", "by two ranks")

    # With recovery the run goes on, and the part of the killed rank is done again.
    if kill_midway(command("recovers.exr", "--enable-recovery"), work / "recovers.exr.parts", rank=1) != 0:
        sys.exit("a killed rank ends a bake that recovers")
    expect_same("recovers.exr", "where a rank was killed")

    # Without, mpirun ends all. A second call, of one process, does what is missing.
    if kill_midway(command("ended.exr"), work / "ended.exr.parts", rank=1) == 0:
        sys.exit("mpirun does not say that a rank was killed")
    subprocess.run(command("ended.exr", ranks=1), check=True, timeout=TIMEOUT)
    expect_same("ended.exr", "where mpirun ended and one process went on")

    # What cannot be done ends all ranks.
    (work / "taken.exr.parts").mkdir()
    (work / "taken.exr.parts/letter").write_text("keep")
    refused = subprocess.run(command("taken.exr"), text=True, capture_output=True, timeout=TIMEOUT)
    if refused.returncode == 0 or "holds no parts" not in refused.stderr:
        sys.exit("a folder of others is taken for parts")
    print(f"{before} parts before a second call")


main()
