"""Static libraries: an archive of one object file with its index, as linkers read it."""

__all__ = ["archive"]

_MAGIC = b"!<arch>\n"


def archive(name: str, content: bytes, symbols: list[str]) -> bytes:
    r"""Bytes of an archive, in the format of System V and GNU.

    Parameters
    ----------
    name : str
        Of the object file, at most 15 characters.
    content : bytes
        Of the object file.
    symbols : list of str
        That it defines.

    Examples
    --------
    >>> archive("pendular.o", b"object", ["pendular_bridge"])[:11]
    b'!<arch>\n/  '
    """
    names = b"".join(symbol.encode() + b"\0" for symbol in symbols)
    size = 4 * (1 + len(symbols)) + len(names)
    place = len(_MAGIC) + len(_head("", 0)) + size + size % 2  # of the object
    index = len(symbols).to_bytes(4, "big") + len(symbols) * place.to_bytes(4, "big") + names
    return _MAGIC + _member("", index) + _member(name, content)


def _member(name: str, content: bytes) -> bytes:
    return _head(name, len(content)) + content + (len(content) % 2) * b"\n"


def _head(name: str, size: int) -> bytes:
    """Name, time, owner, group, mode and size: no time and no owner, so that equal contents make equal files."""
    return f"{name + '/':<16}{0:<12}{0:<6}{0:<6}{'100644' if name else '0':<8}{size:<10}`\n".encode()
