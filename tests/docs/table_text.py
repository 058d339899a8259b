"""How tables.py shows numbers and rows."""


def number(value):
    """Three digits at most, or all of a whole number."""
    if value is None:
        return ""
    if value >= 100 or value == round(value):
        return f"{round(value):,}"
    return f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def error(value):
    return "" if value is None else "0" if value == 0 else f"{value:.5f}" if value < 0.001 else f"{value:.4f}"


def markdown(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n"
