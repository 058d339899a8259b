"""Compares the options in docs/command-line.md with the registry.

usage: options.py PENUMBRA

Fails where a method, an option or a default of `PENUMBRA methods --json` is missing or differs, and where a section of a
method has an option that the registry does not know.
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
    rows = rows_of(render)
    known = json.loads(subprocess.run([sys.argv[1], "methods", "--json"], check=True, capture_output=True).stdout)
    faults = []
    for method in known:
        if f"`{method['name']}`" not in render:
            faults.append(f"method {method['name']} is not named")
        if method["default"] and rows.get("method") != method["name"]:
            faults.append(f"the default of --method is {method['name']}, not {rows.get('method')}")
        for option in method["options"]:
            if rows.get(option["name"]) != option["default"]:
                faults.append(f"--{option['name']} has the default {option['default']}, not {rows.get(option['name'])}")
    options = {option["name"] for method in known for option in method["options"]}
    for name in rows_of(render.partition("Methods `")[2]):
        if name not in options:
            faults.append(f"--{name} is no option of any method")
    if faults:
        sys.exit("docs/command-line.md:\n" + "\n".join(faults))


main()
