"""Opens the page of a small study in headless Chromium, uses it, and looks at what it shows.

usage: page_test.py PENUMBRA CHROMIUM WORK

Fails where a plot is not drawn, a click shows another picture than it should, a picture is not what the numbers say, or
the page writes an error to the console.
"""
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
DATA = HERE.parents[2] / "data/scenes"
SCENES = ["cube-medium", "torus-medium"]


def make_study(penumbra, folder):
    scenes = [str(DATA / f"{name}.json") for name in SCENES]
    subprocess.run([penumbra, "study", *scenes, "--output", folder, "--quick", "--size", "96x72", "--samples", "1024",
                    "--frames", "1", "--methods", "silhouette,reference,rays,hard", "--no-memory"], check=True)
    return json.loads((folder / "study.json").read_text())


def open_page(chromium, page, profile, size):
    """What page_actions.js has written into the page, and the lines of the console."""
    done = subprocess.run([chromium, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                           f"--user-data-dir={profile}", f"--window-size={size}", "--enable-logging=stderr",
                           "--virtual-time-budget=60000", "--dump-dom", page.as_uri()],
                          text=True, capture_output=True, timeout=240)
    found = re.search(r'<pre id="result">(.*?)</pre>', done.stdout, re.DOTALL)
    # The test itself reads canvases back, which Chromium remarks on.
    console = [line for line in done.stderr.splitlines() if "CONSOLE" in line and "willReadFrequently" not in line]
    if not found:
        sys.exit("the page did not come to its end:\n" + done.stdout[-2000:] + "\n" + "\n".join(console))
    return json.loads(html.unescape(found.group(1))), console


def main():
    penumbra, chromium, work = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    study = make_study(penumbra, work / "study")
    text = (work / "study/index.html").read_text()
    page = work / "tested.html"
    page.write_text(text.replace("</body>", "<script>" + (HERE / "page_actions.js").read_text() + "</script></body>"))
    for size in ("1280,1000", "390,844"):
        result, console = open_page(chromium, page, work / f"profile-{size}", size)
        faults = result["faults"] + console
        if result["rows"] != len(study["rows"]):
            faults.append(f"the page has {result['rows']} rows, the study {len(study['rows'])}")
        if result["checks"] < 20:
            faults.append(f"only {result['checks']} things were checked")
        if faults:
            sys.exit(f"at {size}:\n" + "\n".join(faults))
        print(f"{size}: {result['checks']} checks")


main()
