"""Processes that mpirun started, for tests that kill one."""

import pathlib
import sys


def process_of_rank(mpirun, rank):
    """The number of the process of that rank, by Open MPI's variable; ends the program where there is none."""
    for children in pathlib.Path(f"/proc/{mpirun}/task").glob("*/children"):
        for child in children.read_text().split():
            if f"OMPI_COMM_WORLD_RANK={rank}".encode() in pathlib.Path(f"/proc/{child}/environ").read_bytes().split(b"\0"):
                return int(child)
    sys.exit(f"no process has rank {rank}")
