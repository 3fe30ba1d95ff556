"""Run the notebooks and keep what they print and draw, without what is large: `make notebooks`."""

from pathlib import Path

import nbclient
import nbformat
from nbformat import NotebookNode

TOP = Path(__file__).resolve().parent.parent
NOTEBOOKS = (
    *sorted((TOP / "docs" / "tutorials").glob("*.ipynb")),
    TOP / "examples" / "one_walk.ipynb",
)
_KEPT = ("image/png", "text/plain")


def run(path: Path) -> NotebookNode:
    """A notebook with what its cells print and draw."""
    notebook = nbformat.read(path, as_version=4)
    client = nbclient.NotebookClient(
        notebook, timeout=300, resources={"metadata": {"path": str(TOP)}}
    )
    client.execute()
    for cell in notebook.cells:
        cell.metadata.clear()
        if cell.cell_type == "code":
            cell.outputs = _joined([small for output in cell.outputs if (small := _small(output))])
    return notebook


def _joined(outputs: list[NotebookNode]) -> list[NotebookNode]:
    """Outputs with all lines that follow each other in one."""
    joined: list[NotebookNode] = []
    for output in outputs:
        if joined and output.output_type == joined[-1].output_type == "stream":
            joined[-1].text += output.text
        else:
            joined.append(output)
    return joined


def _small(output: NotebookNode) -> NotebookNode | None:
    """An output without what a page cannot show; None of progress bars and of figures' names."""
    if output.output_type == "stream":
        return output if output.name == "stdout" else None
    kept = next((kind for kind in _KEPT if kind in output.data), None)
    if kept is None or (kept == "text/plain" and output.data[kept].startswith("<Figure")):
        return None
    output.data = NotebookNode({kept: output.data[kept]})
    output.metadata = NotebookNode()
    return output


def printed(notebook: NotebookNode) -> str:
    """All that the cells print."""
    return "".join(output.text for cell in notebook.cells if cell.cell_type == "code"
                   for output in cell.outputs if output.output_type == "stream")  # fmt: skip


if __name__ == "__main__":
    for name in NOTEBOOKS:
        nbformat.write(run(name), name)
        print(name.relative_to(TOP))
