"""Windows of a scene as numbers, if the settings give a window by name or not at all."""

from __future__ import annotations

import functools
from dataclasses import replace

from lumencut import _lumencut
from lumencut.errors import VolumeError
from lumencut.scene.settings import ContextName, Settings
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume
from lumencut.scene.window import Window


class SceneWindows:
    """The windows of a volume; each is computed once, on first use.

    Parameters
    ----------
    volume : Volume or None
        The volume shown; without a volume every window raises a ``VolumeError``.
    tree : VesselTree or None
        The vessels along which the main window is taken. Renderers of other trees of the same volume share
        it, so that the picture does not become lighter or darker with the tree.
    """

    def __init__(self, volume: Volume | None, tree: VesselTree | None) -> None:
        self._volume, self._tree = volume, tree
        self._named: dict[str, Window] = {}

    @functools.cached_property
    def main(self) -> Window:
        """Return the window of cut surface and context if the settings name none."""
        return Window.from_data(self._shown, self._tree)

    def used(self, settings: Settings, *, has_tree: bool) -> Settings:
        """Return the settings with numbers for each window that is a name or missing."""
        window, context_window = map(self._known, (settings.window, settings.context_window))
        if window is None and has_tree:
            window = self.main
        if context_window is None and settings.context is not None:
            context_window = self._of_context(settings.context)
        if (window, context_window) == (settings.window, settings.context_window):
            return settings
        return replace(settings, window=window, context_window=context_window)

    def _of_context(self, context: ContextName) -> Window:
        """Return the window of a context if the settings name none."""
        name = _lumencut.context_window(context, self._tree is not None)
        return self.main if name == "auto" else self._kept(name)

    def _known(self, window: Window | str | None) -> Window | None:
        """Return a window as numbers; a named window is computed from the whole volume."""
        return self._kept(window) if isinstance(window, str) else window

    def _kept(self, name: str) -> Window:
        if name not in self._named:
            self._named[name] = Window._found(name, self._shown)
        return self._named[name]

    @property
    def _shown(self) -> Volume:
        if self._volume is None:
            raise VolumeError("volume of the renderer", "None", "a volume to take the window from")
        return self._volume._overview
