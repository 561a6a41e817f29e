"""Ctrl-C and SIGTERM ask for a clean stop; a second one stops at once."""

from __future__ import annotations

import signal
import threading
from types import FrameType


class CleanStop:
    """`with CleanStop() as stop`: `stop.requested` turns true on the first signal."""

    def __init__(self) -> None:
        self.signal: int | None = None
        self._previous: dict[int, object] = {}

    @property
    def requested(self) -> bool:
        return self.signal is not None

    @property
    def exit_code(self) -> int:
        """As a shell reports a process that the signal ended."""
        return 0 if self.signal is None else 128 + self.signal

    def __enter__(self) -> CleanStop:
        if threading.current_thread() is threading.main_thread():
            for number in (signal.SIGINT, signal.SIGTERM):
                self._previous[number] = signal.signal(number, self._request)
        return self

    def __exit__(self, *_: object) -> None:
        self._restore()

    def _request(self, number: int, _frame: FrameType | None) -> None:
        self.signal = number
        self._restore()

    def _restore(self) -> None:
        for number, handler in self._previous.items():
            signal.signal(number, handler)  # type: ignore[arg-type]
        self._previous.clear()
