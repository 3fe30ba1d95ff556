"""Files that appear under their name only when they are complete."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """Make a hidden file beside `path`, of the same ending, to write to.

    It takes the name of `path` when the block ends without an error, and else is removed.

    Raises:
        OSError: it cannot be written; the message names `path`.
    """
    part: Path | None = None
    try:
        handle, name = tempfile.mkstemp(suffix=path.suffix, prefix=".part-", dir=path.parent)
        part = Path(name)
        os.close(handle)
        yield part
        part.chmod(0o666 & ~_umask())
        os.replace(part, path)
    except OSError as error:
        if error.errno is None or (part and error.filename not in (None, str(part))):
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error
    finally:
        if part is not None:
            part.unlink(missing_ok=True)


def check_folder(folder: Path) -> None:
    """Make a folder and try to write in it, before any work is done.

    Raises:
        ValueError: it cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise ValueError(
            f"out must be a folder that can be written, got {str(folder)!r}: {reason}"
        ) from error


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
