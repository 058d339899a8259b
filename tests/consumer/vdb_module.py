"""The installed program opens OpenVDB when it writes a field as .vdb, never else, and says what to install where it cannot.

usage: vdb_module.py PREFIX SCENE
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

OPENVDB = re.compile(r"libopenvdb\.so[.\d]*")


def run(program, *words, **variables):
    return subprocess.run([str(program), *map(str, words)], capture_output=True, text=True, env=dict(os.environ, **variables))


def opened(program, *words):
    """What the loader says it opened, at the start and later."""
    done = run(program, *words, LD_DEBUG="files")
    assert done.returncode == 0, done.stderr[-2000:]
    assert "libembree" in done.stderr, "the loader says nothing"
    return set(OPENVDB.findall(done.stderr))


def refuses(program, field, reason, **variables):
    done = run(*field(program), **variables)
    message = " ".join(done.stderr.split())
    assert done.returncode == 1, (done.returncode, message)
    assert "install the Debian package libopenvdb-dev" in message and reason in message, message
    assert not field(program)[-1].exists()


def main():
    prefix, scene = map(pathlib.Path, sys.argv[1:])
    program = prefix / "bin" / "penumbra"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def field(which, extension="vdb"):
            return which, "field", scene, "--grid", "16", "--output", folder / f"seen.{extension}"

        assert not opened(program, "--version")
        assert not opened(*field(program, "npy"))
        libraries = opened(*field(program))
        assert len(libraries) == 1, libraries
        (folder / "seen.vdb").unlink()

        # No module where the run path leads.
        (folder / "bin").mkdir()
        alone = shutil.copy(program, folder / "bin")
        refuses(alone, field, "build Penumbra again")
        assert run(*field(alone, "npy")).returncode == 0

        # The module, but no OpenVDB.
        broken = folder / "broken"
        broken.mkdir()
        (broken / libraries.pop()).write_bytes(b"nothing that can be loaded")
        refuses(program, field, "libopenvdb.so", LD_LIBRARY_PATH=str(broken))
    print("OpenVDB is opened by a .vdb alone; where it is missing the program says what to install")


if __name__ == "__main__":
    main()
