"""The documents that readers see, and the fenced blocks in them."""
import dataclasses
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
LANGUAGES = {"sh", "cpp", "cmake", "json", "python", "text"}


@dataclasses.dataclass
class Block:
    language: str
    line: int
    text: str


def documents():
    """README, CONTRIBUTING and all of docs/, as paths below ROOT."""
    found = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return [path.relative_to(ROOT) for path in found]


def blocks(document):
    """The fenced blocks of a document. Fails where a fence has no language or does not end."""
    found, current = [], None
    for number, line in enumerate((ROOT / document).read_text().splitlines(), 1):
        fence = re.match(r"\s*```(.*)", line)
        if fence and current is None:
            language = fence[1].strip()
            if language not in LANGUAGES:
                raise SystemExit(f"{document}:{number}: a fence of language '{language}'; use one of {sorted(LANGUAGES)}")
            current = Block(language, number + 1, "")
        elif fence:
            found.append(current)
            current = None
        elif current is not None:
            current.text += line + "\n"
    if current is not None:
        raise SystemExit(f"{document}:{current.line}: the fence does not end")
    return found


def outside_fences(document):
    """Numbered lines that are in no fence."""
    inside = False
    for number, line in enumerate((ROOT / document).read_text().splitlines(), 1):
        if line.lstrip().startswith("```"):
            inside = not inside
        elif not inside:
            yield number, line
