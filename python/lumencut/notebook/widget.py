"""The widget of a notebook: its traits, and the messages between the page and the kernel."""

from __future__ import annotations

import base64
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.resources import files
from typing import Any

import anywidget
import numpy as np
import traitlets

from lumencut.base.checks import numbers
from lumencut.errors import CameraError, LumencutError
from lumencut.notebook.first_view import FirstView, checked_camera
from lumencut.notebook.pictures import Pace, as_jpeg, as_png
from lumencut.notebook.scene import Scene
from lumencut.notebook.shown import Shown
from lumencut.notebook.steps import take
from lumencut.pictures.frame import Frame
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings
from lumencut.scene.vessel_tree import VesselTree

_LINKED = ("straightened", "section")


def _front(name: str) -> str:
    """Return the text of a file of the page."""
    return files("lumencut.notebook").joinpath("front", name).read_text("utf-8")


class _ClosedError(Exception):
    """The widget was closed while its picture was made."""


class VesselWidget(anywidget.AnyWidget):
    """A view of vessels in a notebook; :func:`lumencut.show` makes it.

    Assigning to a trait updates the view, and actions of the user change the traits: both can be
    observed (``widget.observe(function, "picked")``). An error changes nothing.

    Attributes
    ----------
    camera : Camera
        The view.
    settings : Settings
        The settings of the view.
    tree : VesselTree or None
        The vessels; while tracing, including those traced so far.
    picked : tuple of 3 floats, or None
        The world point of the cross-hair (mm, LPS).
    vessel : int or None
        The id of the picked vessel in the tree; a name can be assigned too.
    picture : bytes
        The picture at rest with its labels, a PNG file.
    """

    # One module, because a notebook cannot load a second one.
    _esm = "\n".join(_front(f"{name}.js") for name in ("asking", "pane", "pointers", "view"))
    _css = _front("view.css")

    camera = traitlets.Instance(Camera)
    settings = traitlets.Instance(Settings)
    tree = traitlets.Instance(VesselTree, allow_none=True)
    picked = traitlets.Any(None, allow_none=True).tag(sync=True)
    vessel = traitlets.Any(None, allow_none=True).tag(sync=True)
    picture = traitlets.Bytes(b"").tag(sync=True)
    _straightened = traitlets.Bytes(b"").tag(sync=True)
    _section = traitlets.Bytes(b"").tag(sync=True)
    _shown = traitlets.Dict().tag(sync=True)

    def __init__(self, view: FirstView, *, trace: bool, linked: bool, names: bool) -> None:
        self._lock, self._is_quiet, self._is_closed = threading.RLock(), True, False
        self._pace = Pace()
        self._view = Shown.first(view, is_traced=trace, is_linked=linked, has_names=names)
        self._before = self._view
        first = {
            "camera": view.camera,
            "settings": view.settings,
            "tree": view.scene.tree,
            "picture": self._picture(self._view),
            "_shown": self._view.state(),
        }
        self._at_rest = self._key(self._view)
        super().__init__(**first)
        self.on_msg(self._hear)
        self._is_quiet = False

    def __repr__(self) -> str:
        """Return what is shown."""
        if self._is_closed:
            return "VesselWidget(closed; show makes another one)"
        return f"VesselWidget({self._view.scene.volume!r}, {self.tree!r})"

    def frame(self) -> Frame:
        """Return the view with all its images, as :meth:`lumencut.Renderer.render` does.

        ``widget.frame().save("view.png", annotate=True)`` writes the view.
        """
        with self._lock:
            return self._view.frame(images=None)

    def replace(self, volume: Any, tree: VesselTree | None = None) -> None:
        """Show another volume with its vessels; settings stay, and so does the view if both lie in one place.

        After changing voxels in place, call this with the same volume.

        Parameters
        ----------
        volume : Volume, or anything :func:`lumencut.render` takes as one
            The angiography.
        tree : VesselTree, optional
            Its centerlines.

        Raises
        ------
        VolumeError, VesselTreeError, SettingsError
            As :func:`lumencut.show`; the widget keeps its present view.
        """
        with self._lock:
            other = self._view.with_volume(volume, tree)
            self._take_over(other)

    def close(self) -> None:
        """Remove the widget from the page; running work stops within 0.1 s."""
        self._is_closed = True
        super().close()

    def _repr_mimebundle_(self, **kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]] | None:
        """The live view, and its picture for viewers of notebooks without a kernel."""
        bundle = super()._repr_mimebundle_(**kwargs)
        if bundle is not None:
            bundle[0]["image/png"] = base64.b64encode(self.picture).decode("ascii")
        return bundle

    @traitlets.validate("camera")
    def _check_camera(self, proposal: Any) -> Camera:
        return checked_camera(proposal["value"])

    @traitlets.validate("picked")
    def _check_picked(self, proposal: Any) -> tuple[float, ...] | None:
        if proposal["value"] is None:
            return None
        point = numbers(CameraError, "picked point", proposal["value"], (3,))
        if not np.isfinite(point).all():
            raise CameraError("picked point", str(point.tolist()), "three finite numbers (mm, LPS)")
        return tuple(point.tolist())

    @traitlets.validate("vessel")
    def _check_vessel(self, proposal: Any) -> int | None:
        word = proposal["value"]
        return None if word is None else self._view.vessel_id(word)

    @traitlets.observe("camera", "settings", "tree", "picked", "vessel")
    def _assigned(self, change: Any) -> None:
        """Show the value that the user assigned to a trait; restore the old value if that fails."""
        with self._lock:
            # Inside the lock, because a thread that answers the page also updates the traits.
            if self._is_quiet:
                return
            try:
                self._take_over(self._view.assigned(change["name"], change["new"]))
            except LumencutError:
                with self._quietly():
                    self.set_trait(change["name"], change["old"])
                raise

    @contextmanager
    def _quietly(self) -> Iterator[None]:
        """Traits set in this context were not assigned by the user."""
        before, self._is_quiet = self._is_quiet, True
        try:
            yield
        finally:
            self._is_quiet = before

    def _take_over(self, other: Shown) -> None:
        """Show another view at rest; nothing changes if that fails."""
        key = self._key(other)
        picture = self.picture if key == self._at_rest else self._picture(other)
        small = {name: as_png(image) for name, image in other.linked_pictures().items()}
        self._view, self._at_rest = other, key
        with self.hold_sync(), self._quietly():
            self.picture = picture
            self._straightened, self._section = (small.get(name, b"") for name in _LINKED)
            self._update_traits()

    def _update_traits(self) -> None:
        """Set the traits to the state of the view."""
        view = self._view
        self.camera, self.settings, self.tree = view.camera, view.settings, view.scene.tree
        self.vessel, self.picked = view.vessel, view.picked
        self._shown = view.state()

    def _key(self, view: Shown) -> tuple[Scene, Camera, Settings]:
        """Return the part of the state on which the picture of the turning view depends."""
        return view.seen, view.camera, view.settings

    def _picture(self, view: Shown) -> bytes:
        frame = view.frame(progress=self._go_on)
        return as_png(frame.annotated(vessel_names=view.has_names))

    def _go_on(self, done: int, total: int) -> None:
        if self._is_closed:
            raise _ClosedError

    def _hear(self, _: Any, content: Any, __: Any) -> None:
        """Handle a request of the page; an answer is always sent."""
        with self._lock:
            if self._is_closed:
                return
            answer: dict[str, Any] = {"kind": "answer", "answers": content.get("id"), "words": ""}
            buffers: list[bytes] = []
            try:
                buffers = self._done(content, answer)
            except _ClosedError:
                return
            except LumencutError as error:
                answer["words"] = str(error)
            except Exception as error:
                answer["words"] = f"unexpected {type(error).__name__}: {error}"
                raise
            finally:
                if not self._is_closed:
                    self.send(answer, buffers)

    def _done(self, content: dict[str, Any], answer: dict[str, Any]) -> list[bytes]:
        """Apply the steps. Return the pictures of a moving view; at rest the traits hold the pictures."""
        taken = take(self._view, self._before, content["steps"])
        answer["words"], self._before = taken.words, taken.before
        if not content["moving"]:
            self._take_over(taken.view)
            return []
        pictures = self._moving_pictures(taken.view)
        self._view = taken.view
        with self._quietly(), self.hold_sync():
            self._update_traits()
        answer["pictures"] = list(pictures)
        return list(pictures.values())

    def _moving_pictures(self, view: Shown) -> dict[str, bytes]:
        """Return the changed pictures by name."""
        found = {}
        if self._key(view) != self._key(self._view):
            start = time.perf_counter()
            frame = view.moving(self._pace.share, self._go_on)
            # Only the picture at rest has names, because names take longer than the picture of a large tree.
            found["vessels"] = as_jpeg(frame.annotated())
            self._pace.took((time.perf_counter() - start) * 1000)
        if view.linked is not self._view.linked:
            found |= {name: as_jpeg(image) for name, image in view.linked_pictures().items()}
        return found
