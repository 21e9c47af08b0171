"""Machine code of kernels on disk: used only while nothing that enters it has changed, and never a reason to fail.

Numba stamps the code of a kernel with the file of that kernel alone, and trusts every file that it finds. Here the
stamp covers all source that a kernel can reach, and a file that is not whole or not the one sought is compiled anew.
"""

import hashlib
import pickle
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from numba.core.caching import FunctionCache, IndexDataCacheFile

from .stamp import stamp_of

__all__ = ["keep_on_disk"]

_DIGEST_SIZE = hashlib.sha256().digest_size


def keep_on_disk(dispatcher: Any) -> None:
    """Keep what a dispatcher compiles where Numba keeps it: beside the source, else in the user's own cache folder."""
    with suppress(RuntimeError, OSError):  # neither can be written, or the source cannot be read: each process compiles
        dispatcher._cache = _KernelCache(dispatcher.py_func)


class _KernelCache(FunctionCache):
    """Numba's cache of one function, with our stamp; whatever goes wrong with it, the kernel is compiled."""

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)
        stamp = stamp_of(Path(function.__code__.co_filename))
        self._cache_file = _SealedFiles(self._cache_path, self._impl.filename_base, stamp)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Code for a signature, None to compile it."""
        try:
            return super().load_overload(sig, target_context)
        except Exception:  # a file from elsewhere can raise anything
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Store code for a signature; a full disk or a folder that is gone leaves it to the next process."""
        with suppress(OSError, pickle.PickleError):
            super().save_overload(sig, data)


class _SealedFiles(IndexDataCacheFile):
    """Files of one function, whose data tell by themselves if they are whole and what they are for.

    The index alone cannot: processes that save at once replace it, and give the same name to data of different
    signatures or of different sources.
    """

    def save(self, key: Any, data: Any) -> None:
        """Store data with all that they depend on."""
        super().save(key, (self._source_stamp, key, data))

    def load(self, key: Any) -> Any:
        """Data of a key, None if there are none of this key and of this source."""
        sealed = super().load(key)
        return sealed[2] if sealed is not None and sealed[:2] == (self._source_stamp, key) else None

    def _load_index(self) -> Any:
        try:
            return super()._load_index()
        except Exception:  # damaged: write a new one
            return {}

    def _save_data(self, name: str, data: Any) -> None:
        content = self._dump(data)
        with self._open_for_write(self._data_path(name)) as file:
            file.write(hashlib.sha256(content).digest() + content)

    def _load_data(self, name: str) -> Any:
        sealed = Path(self._data_path(name)).read_bytes()
        digest, content = sealed[:_DIGEST_SIZE], sealed[_DIGEST_SIZE:]
        return pickle.loads(content) if hashlib.sha256(content).digest() == digest else None
