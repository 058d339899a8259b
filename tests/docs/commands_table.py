"""Commands in the documents' sh blocks, and those that are not run."""
import re

from documents import ROOT, blocks


def commands_not_run():
    """The first column of the table in tests/docs/README.md."""
    text = (ROOT / "tests/docs/README.md").read_text().partition("## Commands that are not run")[2]
    return set(re.findall(r"^\| `([^`]+)` \|", text, re.MULTILINE))


def without_comment(line):
    return line.split(" #")[0].strip()


def logical_lines(text):
    """Lines of a script; what a backslash continues is one of them."""
    return text.replace("\\\n", " ").splitlines()


def commands_of(document):
    return {without_comment(line) for block in blocks(document) if block.language == "sh"
            for line in logical_lines(block.text)}
