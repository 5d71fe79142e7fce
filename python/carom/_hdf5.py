"""The one door to HDF5, which is not made for threads."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

_lock = threading.RLock()


@contextmanager
def hdf5() -> Iterator[None]:
    """Keeps HDF5 to this thread: from other calls of carom and, where h5py is loaded, from h5py, which may share the library."""
    objects = sys.modules.get("h5py._objects")
    with _lock:
        if objects is None:
            yield
        else:
            with objects.phil:
                yield
