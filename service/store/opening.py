"""Which store: the embedded one, or one elsewhere."""

from __future__ import annotations

from symboslam.service.settings import Settings
from symboslam.service.store._base import Store


def open_store(settings: Settings) -> Store:
    """The store that the settings name, not started yet.

    Raises:
        StoreError: it cannot be opened.
    """
    if settings.store is not None:
        from symboslam.service.store.remote import RemoteStore

        return RemoteStore(settings)
    from symboslam.service.store.oxigraph import OxigraphStore

    return OxigraphStore(settings)
