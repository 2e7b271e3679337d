"""Runs the notebooks and writes them as pages: see README.md beside it."""

import pathlib
import re
import sys

import jupytext
import nbclient
import nbformat

HERE = pathlib.Path(__file__).parent
PAGES = HERE.parents[1] / "docs/notebooks"
# Not shown: pictures as SVG that are the same in every run.
SETUP = """
import matplotlib_inline.backend_inline as inline, matplotlib.pyplot as plt
inline.set_matplotlib_formats("svg", metadata={"Date": None})
plt.rcParams.update({"svg.hashsalt": "", "svg.fonttype": "none", "font.sans-serif": ["DejaVu Sans"],
    "figure.figsize": (7, 3.8), "axes.grid": True, "grid.alpha": 0.3, "font.size": 9})
"""


def smaller(svg: str) -> str:
    """A path in a line, and no digits that nobody sees."""
    svg = re.sub(r" *\n(?=[MLQCz\"])", " ", svg)
    return re.sub(r"(\d+\.\d\d)\d+", r"\1", svg)


def page(source: pathlib.Path) -> tuple[str, dict[str, str]]:
    """The text of a page, and its pictures by file names."""
    notebook = jupytext.read(source)
    notebook.cells.insert(0, nbformat.v4.new_code_cell(SETUP))
    nbclient.NotebookClient(
        notebook, timeout=600, kernel_name="python3", resources={"metadata": {"path": str(HERE)}}
    ).execute()
    parts, pictures = [], {}
    for cell in notebook.cells[1:]:
        if cell.cell_type == "markdown":
            parts.append(cell.source)
            continue
        parts.append(f"```python\n{cell.source}\n```")
        for output in cell.outputs:
            if output.get("name") == "stderr":
                continue
            data = output.get("data", {})
            if "image/svg+xml" in data:
                name = f"{source.stem}-{len(pictures) + 1}.svg"
                pictures[name] = smaller(data["image/svg+xml"])
                parts.append(f"![{source.stem.replace('-', ' ')}]({name})")
            elif text := output.get("text", data.get("text/plain", "")):
                parts.append(f"```text\n{text.rstrip()}\n```")
    link = f"../../examples/notebooks/{source.name}"
    parts.append(f"*This page is the output of [{source.name}]({link}).*")
    return "\n\n".join(parts) + "\n", pictures


def main() -> None:
    check, stale = "--check" in sys.argv, []
    for source in sorted(HERE.glob("*-*.py")):
        text, pictures = page(source)
        target = PAGES / f"{source.stem}.md"
        if check:
            # Pictures differ with the fonts of the system; the text does not.
            if not target.exists() or target.read_text(encoding="utf-8") != text:
                stale.append(source.stem)
            continue
        target.write_text(text, encoding="utf-8")
        for name, svg in pictures.items():
            (PAGES / name).write_text(svg, encoding="utf-8")
    if stale:
        sys.exit(f"pages that would change: {', '.join(stale)}; run render.py and read them")


if __name__ == "__main__":
    main()
