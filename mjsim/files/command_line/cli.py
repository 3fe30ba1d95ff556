"""Command lines from dataclasses, with bad input told in one line."""

import contextlib
import io
import json
import logging
import math
import re
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Annotated, NoReturn, TypeVar

import tyro

from analytic.checks import meant
from mjsim.files.command_line.typed_options import TypedOptions
from mjsim.files.interruption import uninterrupted

Options = TypeVar("Options")
Plugins = Annotated[
    # tuple[str, ...] would be checked by typeguard, whose import takes as long as all of tyro
    tyro.conf.UseAppendAction[tuple],  # type: ignore[type-arg]
    tyro.conf.arg(
        metavar="MODULE",
        help="a module, or a .py file, that registers bodies or friction laws when it is imported; "
        "given again, or several with commas between",
        help_behavior_hint="",
    ),
]
"""Type of the field `plugin` of commands that take a scene; see mjsim.files.plugins.load."""

BAD_INPUT, FAILED = 2, 3  # exit codes, beside 0
ALL = "all"
_PLAINER = str.maketrans({"Δ": "D", "×": "x", "±": "+-", "°": "deg"})
_PATIENCE = 2.0  # s before a progress bar shows
_LONG = 10.0  # s before a command without a bar says that it goes on; chosen


_typed: dict[str, TypedOptions] = {}  # of the command of this process, for its messages


def fail(program: str, message: str) -> NoReturn:
    """Print one line on stderr and exit with the code for bad input.

    A message that begins with the key of an option that was typed begins with the option.
    """
    if program in _typed:
        message = _typed[program].named(message)
    print(f"{program}: error: {' '.join(message.split())}", file=sys.stderr)
    sys.exit(BAD_INPUT)


def warn(program: str, message: str) -> None:
    """Print one line on stderr."""
    print(f"{program}: {message}", file=sys.stderr)


class _Notes(logging.Handler):
    """Notes of the logger "mjsim", such as on what was made of a file, as lines on stderr."""

    def __init__(self, program: str) -> None:
        super().__init__()
        self._program, self._printed = program, set[str]()

    def emit(self, record: logging.LogRecord) -> None:
        """Print the note in one line, once."""
        line = " ".join(record.getMessage().split())
        if line not in self._printed:
            warn(self._program, line)
        self._printed.add(line)


def _print_notes(program: str) -> None:
    """Let notes be printed under the name of a command."""
    log = logging.getLogger("mjsim")
    for handler in [handler for handler in log.handlers if isinstance(handler, _Notes)]:
        log.removeHandler(handler)
    log.addHandler(_Notes(program))


def say(text: str) -> None:
    """Print, in ASCII letters where the terminal's encoding lacks some."""
    encoding = sys.stdout.encoding or "ascii"
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        text = text.translate(_PLAINER).encode(encoding, "replace").decode(encoding)
    print(text)


def strict_json(value: object) -> str:
    """JSON text, with null for NaN and infinite numbers."""

    def clean(item: object) -> object:
        if isinstance(item, dict):
            return {key: clean(part) for key, part in item.items()}
        if isinstance(item, list | tuple):
            return [clean(part) for part in item]
        return None if isinstance(item, float) and not math.isfinite(item) else item

    return json.dumps(clean(value), allow_nan=False)


def choose(name: str, text: str, valid: Iterable[str]) -> list[str]:
    """Names from a comma-separated list, or every one for "all".

    Raises:
        ValueError: a name is not among the valid ones.
    """
    names = list(valid)
    chosen = names if text == ALL else text.split(",")
    for word in chosen:
        if word not in names:
            raise ValueError(
                f"{name} must be one of {', '.join(names)}, {ALL}; got {word!r}{meant(word, names)}"
            )
    return chosen


@contextlib.contextmanager
def bar(text: str, total: int) -> Iterator[Callable[[int], None]]:
    """Progress bar on stderr for long work, where stderr is a terminal."""
    from tqdm import tqdm

    with tqdm(  # disable=None: where the file is no terminal
        total=total, desc=text, delay=_PATIENCE, leave=False, file=sys.stderr, disable=None
    ) as progress:

        def advance(steps: int) -> None:
            with uninterrupted():  # half drawn, a bar is not wiped off
                progress.update(steps)

        yield advance


class LongWork(contextlib.AbstractContextManager["LongWork"]):
    """A line on stderr, once after 10 s, where that is no terminal and so shows no progress bar."""

    def __init__(self, program: str) -> None:
        self._doing = ""
        self._timer = threading.Timer(
            _LONG, lambda: warn(program, f"{self._doing}: it goes on, and may take minutes")
        )
        self._timer.daemon = True

    def does(self, *words: str) -> None:
        """Name what comes next, with which the line begins; the first one starts the clock."""
        begins, self._doing = not self._doing, " ".join(words)
        if begins and not sys.stderr.isatty():
            self._timer.start()

    def __exit__(self, *_: object) -> None:
        self._timer.cancel()


@contextlib.contextmanager
def reference_bar(ground: str) -> Iterator[None]:
    """Progress bar of what is solved for in this block, one path after another."""
    from analytic.progress import listening

    with bar(f"reference on {ground}", 100) as advance, listening(_Percent(advance)):
        yield


class _Percent:
    """Listener that moves a bar of 100 steps, back to its beginning for another path."""

    def __init__(self, advance: Callable[[int], None]) -> None:
        self._advance, self._shown = advance, 0

    def __call__(self, done: int, total: int) -> None:
        percent = 100 * done // total
        if percent != self._shown:
            self._advance(percent - self._shown)
            self._shown = percent


def parse(
    kind: type[Options], program: str, argv: Sequence[str] | None, examples: Sequence[str] = ()
) -> Options:
    """Read options into a dataclass whose field comments are the help.

    Exits with 0 after --help, and with 2 and one line for a word it cannot read.

    Args:
        kind: the dataclass; its documentation says in two lines what the command does.
        program: name of the command.
        argv: what was typed; that of this process if None.
        examples: that the help ends with, without the name of the command.
    """
    printed = io.StringIO()
    _print_notes(program)
    words = list(sys.argv[1:] if argv is None else argv)
    _typed[program] = TypedOptions(kind, words)
    try:
        with contextlib.redirect_stderr(printed):
            return tyro.cli(kind, prog=program, args=words, config=(tyro.conf.FlagCreatePairsOff,))
    except SystemExit as stop:
        if stop.code == 0:
            say("\n".join(["examples:", *(f"  {program} {words}" for words in examples)]))
            raise
    fail(program, _typed_message(_first_message(printed.getvalue()), _typed[program]))


def _first_message(text: str) -> str:
    """First sentence in tyro's box, however it is drawn, in one line."""
    words = re.sub(r"\x1b\[[0-9;]*m", "", text)
    body: list[str] = []
    for line in words.splitlines()[1:]:  # the first is the box's title
        inner = line.strip("│| \t")
        if inner and not set(inner) <= set("─-╰╯+"):
            body.append(inner)
        elif body:
            break
    return " ".join(body) or words


def _typed_message(message: str, typed: TypedOptions) -> str:
    """Tyro's message in the words of analytic.checks, with the option that was typed or meant."""
    number = re.fullmatch(
        r"(?i)Error parsing (?:--\S+/)?--([^\s/]+): .*\b(int|float)\b.*(?:: |from \[)('.*?')\]?\.?",
        message,
    )
    if number is not None:
        name, kind, word = number.groups()
        whole = "whole " if kind.lower() == "int" else ""
        return f"{typed.as_typed(f'--{name}')} must be a {whole}number, got {word}"
    choice = re.fullmatch(
        r"invalid choice '(.*)' for argument '(\S+?)'\. Expected one of \((.*)\)\.", message
    )
    if choice is not None:
        word, name, listed = choice.groups()
        valid = sorted(set(re.findall(r"'([^']*)'", listed)) - {"None"})
        option = typed.as_typed(name.partition("/")[0])
        return f"{option} must be one of {', '.join(valid)}; got {word!r}{meant(word, valid)}"
    strange = re.fullmatch(r"Unrecognized options: (.*)", message)
    if strange is not None:
        message = typed.unknown(strange.group(1).split(", "))
    return f"{message} (see --help)"
