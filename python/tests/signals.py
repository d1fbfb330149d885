"""Signals in the middle of long work."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable

import hssh
import pytest


def interrupting(seconds: float, work: Callable[[], object]) -> hssh.Interrupted:
    """What work raises that a signal interrupts."""
    timer = threading.Timer(seconds, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(hssh.Interrupted) as raised:
            work()
        return raised.value
    finally:
        timer.cancel()
