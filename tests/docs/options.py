"""Compares the options in docs/command-line.md and in the pages of docs/methods with the registry.

usage: options.py PENUMBRA

Fails where a method, an option or a default of `PENUMBRA methods --json` is missing or differs, and where a section of a
method, or its page, has an option that the registry does not know. A page that begins with `# METHOD`, or `# METHOD and METHOD`, is that of its methods.
"""
import json
import re
import subprocess
import sys

from documents import ROOT


def rows_of(text):
    """The default of every option that has a row."""
    return {name: usual.strip() for name, usual in re.findall(r"^\| `--([a-z-]+) [A-Z|]+` \| ([^|]*)\|", text, re.MULTILINE)}


def main():
    text = (ROOT / "docs/command-line.md").read_text()
    render = text.partition("## render")[2].partition("\n## ")[0]
    pages = {path.name: path.read_text() for path in sorted((ROOT / "docs/methods").glob("*.md"))}
    rows = rows_of(render)
    faults = []
    for name, page in pages.items():
        for option, usual in rows_of(page).items():
            if rows.setdefault(option, usual) != usual:
                faults.append(f"--{option} has the default {usual} in methods/{name}, but {rows[option]} elsewhere")
    titles = {name for page in pages.values() for name in page.partition("\n")[0].removeprefix("# ").split(" and ")}
    known = json.loads(subprocess.run([sys.argv[1], "methods", "--json"], check=True, capture_output=True).stdout)
    for method in known:
        if f"`{method['name']}`" not in render and method["name"] not in titles:
            faults.append(f"method {method['name']} is not named, and has no page")
        if method["default"] and rows.get("method") != method["name"]:
            faults.append(f"the default of --method is {method['name']}, not {rows.get('method')}")
        for option in method["options"]:
            if rows.get(option["name"]) != option["default"]:
                faults.append(f"--{option['name']} has the default {option['default']}, not {rows.get(option['name'])}")
    options = {option["name"] for method in known for option in method["options"]}
    for name in rows_of(render.partition("Methods `")[2]).keys() | {n for page in pages.values() for n in rows_of(page)}:
        if name not in options:
            faults.append(f"--{name} is no option of any method")
    if faults:
        sys.exit("docs/command-line.md and docs/methods:\n" + "\n".join(faults))


main()
