# SPDX-License-Identifier: LGPL-2.1-or-later
"""Long work in a thread of its own."""

from typing import Any, Callable

import umbilic

from ..compat import QtCore


class Worker(QtCore.QThread):
    """Runs `work(progress)`. Its signals arrive in the window's thread, the only one that may touch a document."""

    progressed = QtCore.Signal(float, str)
    done = QtCore.Signal(object)
    cancelled = QtCore.Signal()
    failed = QtCore.Signal(str)

    def __init__(self, work: Callable[[Callable[[float, str], bool]], Any]):
        super().__init__()
        self._work = work
        self._stopped = False

    def stop(self) -> None:
        """Asks the work to stop; `cancelled` follows."""
        self._stopped = True

    def run(self) -> None:
        def progress(fraction: float, text: str) -> bool:
            self.progressed.emit(fraction, text)
            return not self._stopped

        try:
            result = self._work(progress)
        except umbilic.Cancelled:
            self.cancelled.emit()
        except Exception as error:  # whatever it is, the person who waits must hear of it
            self.failed.emit(f"{error}" if isinstance(error, umbilic.Error) else f"{type(error).__name__}: {error}")
        else:
            self.done.emit(result)
