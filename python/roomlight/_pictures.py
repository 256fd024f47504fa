"""Pictures of scenes, and pictures in layers of light."""

import json
import os
from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _roomlight
from ._common import Bytes, Floats, Path, Place, Progress, Vec3, file_name, filled
from ._errors import InputError
from ._scene import Scene

Dial = Union[str, float, bool]


@dataclass
class View:
    """From where a scene is shown. What is None is chosen.

    camera: its name, or number from 0. kind: "camera", "top", "plan", "panorama" or "stereo". level, room: of top and
    plan; room: of panorama and stereo too. eye, target: look from there instead (m). vertical_fov: full vertical angle
    in degrees. cut: height above the level's floor above which nothing is seen (m). metres_per_pixel: scale of a plan.
    backdrop: "sky" or "none".
    """

    camera: Optional[Union[str, int]] = None
    kind: str = "camera"
    level: Optional[Union[str, int]] = None
    room: Optional[Union[str, int]] = None
    eye: Optional[Place] = None
    target: Optional[Place] = None
    vertical_fov: Optional[float] = None
    cut: Optional[float] = None
    metres_per_pixel: Optional[float] = None
    backdrop: Optional[str] = None

    def _struct(self) -> _roomlight.View:
        return filled(
            _roomlight.View(),
            camera=_text(self.camera),
            kind=self.kind,
            level=_text(self.level),
            room=_text(self.room),
            eye=self.eye,
            target=self.target,
            vertical_fov=self.vertical_fov,
            cut=self.cut,
            metres_per_pixel=self.metres_per_pixel,
            backdrop=self.backdrop,
        )


@dataclass
class Look:
    """How light is shown (docs/reference/conventions.md, exposure and display). What is None is the look's.

    look: "natural", "bright", "evening" or "technical". exposure: "auto", "home" or EV100 as on a light meter; of mixes
    also "mix". white_balance: "auto", "none", a warmth such as "20%" or a temperature such as "3000K". tone: "neutral",
    "agx", "filmic" or "clip". contrast: 0.5 to 2. saturation: 0 to 2. local_exposure: 0 to 1. glare: 0 to 0.5.
    vignette: 0 to 1.
    """

    look: str = "natural"
    exposure: Union[str, float] = "auto"
    white_balance: Optional[str] = None
    tone: Optional[str] = None
    contrast: Optional[float] = None
    saturation: Optional[float] = None
    local_exposure: Optional[float] = None
    glare: Optional[float] = None
    vignette: Optional[float] = None

    def _struct(self) -> _roomlight.DisplayOptions:
        return filled(
            _roomlight.DisplayOptions(),
            look=self.look,
            exposure=str(self.exposure),
            white_balance=self.white_balance,
            tone=self.tone,
            contrast=self.contrast,
            saturation=self.saturation,
            local_exposure=self.local_exposure,
            glare=self.glare,
            vignette=self.vignette,
        )


class LayerInfo(NamedTuple):
    """A layer: what gives its light."""

    name: str
    kind: str  # "lamp", "group", "mesh", "sun" or "sky"
    colour: Vec3  # linear Rec.709 of its light; luminance 1
    kelvin: Optional[float]
    flux: Optional[float]  # lm
    room: str  # empty: in none


class Layers(Sequence[Floats]):
    """A picture in layers of light: every lamp, the sun and the sky apart.

    Light adds up, so any state of the lamps is a sum: nothing is rendered again. `layers[i]` is one layer as it was
    rendered, (h, w, 3) float32 in cd/m².
    """

    def __init__(self, layers: _roomlight.Layers) -> None:
        self._layers = layers

    @property
    def width(self) -> int:
        """Pixels in a row."""
        return self._layers.width()

    @property
    def height(self) -> int:
        """Rows of pixels."""
        return self._layers.height()

    @property
    def list(self) -> List[LayerInfo]:
        """What gives the light of each layer."""
        return [LayerInfo(*l) for l in self._layers.infos()]

    @property
    def names(self) -> List[str]:
        """The names in `list`."""
        return [l.name for l in self.list]

    def __len__(self) -> int:
        return len(self._layers.infos())

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        if isinstance(index, str):
            if index not in self.names:
                raise InputError(f"layer '{index}': there are {', '.join(self.names)}")
            index = self.names.index(index)
        count = len(self)
        if not -count <= index < count:
            raise IndexError(f"layer {index}: there are {count}, numbered from 0")
        return self._layers.image(index % count)

    def __contains__(self, name: object) -> bool:
        return name in self.names

    def gains(
        self,
        lamps: Optional[Mapping[str, Dial]] = None,
        *,
        kelvin: Optional[float] = None,
        sun: Optional[Dial] = None,
        sky: Optional[Dial] = None,
    ) -> Floats:
        """What each layer is multiplied by, (n, 3) float32 in linear Rec.709. Arguments: as of `mix`."""
        return self._layers.gains(_dials(lamps, kelvin, sun, sky))

    def mix(
        self,
        lamps: Optional[Mapping[str, Dial]] = None,
        *,
        kelvin: Optional[float] = None,
        sun: Optional[Dial] = None,
        sky: Optional[Dial] = None,
    ) -> Floats:
        """The picture with lamps dimmed, coloured and switched: (h, w, 3) float32 in cd/m², read-only.

        lamps: by name, where * and ? stand for any text and letter: "60%", "off", "2700K", "#ffd080", several of them
        with commas between, or a number: 0.6 is 60 %, True and False are on and off. Later ones go first. kelvin: of
        all lamps whose colour is not said. sun, sky: like lamps; None: as rendered.
        """
        return self._layers.mix(_dials(lamps, kelvin, sun, sky))

    def display(
        self,
        lamps: Optional[Mapping[str, Dial]] = None,
        *,
        kelvin: Optional[float] = None,
        sun: Optional[Dial] = None,
        sky: Optional[Dial] = None,
        look: Union[str, Look] = "natural",
        exposure: Union[str, float, None] = None,
    ) -> Bytes:
        """The mix as displays show it: (h, w, 3) uint8 in sRGB; (h, w, 4) with opacity where there is any.

        Exposure and white of "auto" are those of the unmixed picture, so that dimmed lamps look dimmed; "mix": those of
        this mix. Other arguments: as of `mix`.
        """
        return self._layers.display(_dials(lamps, kelvin, sun, sky), _look(look, exposure))

    def save(
        self,
        path: Path,
        lamps: Optional[Mapping[str, Dial]] = None,
        *,
        kelvin: Optional[float] = None,
        sun: Optional[Dial] = None,
        sky: Optional[Dial] = None,
        look: Union[str, Look] = "natural",
        exposure: Union[str, float, None] = None,
    ) -> None:
        """Writes a mix: .exr (linear, cd/m²), .png, .jpg or .webp. Arguments: as of `display`."""
        dials = _dials(lamps, kelvin, sun, sky)
        if os.fspath(path).lower().endswith(".exr"):
            self._layers.write_linear(dials, file_name(path))
        else:
            write(self._layers.display(dials, _look(look, exposure)), path)

    def __repr__(self) -> str:
        return f"<roomlight.Layers: {self.width}x{self.height}, {', '.join(self.names)}>"


class Picture:
    """A picture of a scene, in linear light."""

    def __init__(self, picture: _roomlight.Picture) -> None:
        self._picture = picture

    @property
    def pixels(self) -> Floats:
        """(h, w, 3) float32, read-only, rows from the top: linear Rec.709 in cd/m².

        Luminance is 0.2126 R + 0.7152 G + 0.0722 B. The array is the picture's own memory, not a copy; it stays valid
        when the picture is gone.
        """
        return self._picture.pixels()

    @property
    def width(self) -> int:
        """Pixels in a row."""
        return int(self.pixels.shape[1])

    @property
    def height(self) -> int:
        """Rows of pixels."""
        return int(self.pixels.shape[0])

    @property
    def complete(self) -> bool:
        """False: stopped early, the best so far."""
        return self._picture.complete()

    @property
    def camera(self) -> str:
        """Name of its camera."""
        return self._picture.camera()

    @property
    def stats(self) -> Dict[str, Any]:
        """Time and memory of each stage, and what was counted, as `render --stats` writes it."""
        stats: Dict[str, Any] = json.loads(self._picture.stats())
        return stats

    def display(self, look: Union[str, Look] = "natural", exposure: Union[str, float, None] = None) -> Bytes:
        """The picture as displays show it: (h, w, 3) uint8 in sRGB; (h, w, 4) with opacity where there is any."""
        return self._picture.display(_look(look, exposure))

    def save(
        self, path: Path, look: Union[str, Look] = "natural", exposure: Union[str, float, None] = None
    ) -> None:
        """Writes .exr (linear, in layers where there are any), .png or .jpg (as displays show it)."""
        self._picture.write(file_name(path), _look(look, exposure))

    def layers(self) -> Layers:
        """The light of each lamp, the sun and the sky apart, of a picture that was rendered with layers=True."""
        return Layers(self._picture.layers())

    def __repr__(self) -> str:
        return f"<roomlight.Picture: {self.width}x{self.height}, camera '{self.camera}'>"


class Renderer:
    """A scene lit for pictures: light is found with the first of them and kept.

    views: all that pictures will be taken of, as cameras' names, numbers, or `View` objects; none: the default camera.
    They have one size. Other arguments: as of `render`.
    """

    def __init__(
        self,
        scene: Scene,
        views: Sequence[Union[str, int, View]] = (),
        *,
        quality: Optional[str] = None,
        width: int = 0,
        height: int = 0,
        technique: Optional[str] = None,
        samples: int = 0,
        seed: int = 0,
        threads: int = 0,
        time_limit: float = 0,
        noise_level: float = 0,
        layers: Union[bool, str] = False,
        settings: Optional[Mapping[str, Any]] = None,
    ) -> None:
        wish = _settings(
            quality=quality,
            width=width,
            height=height,
            technique=technique,
            samples=samples,
            seed=seed,
            threads=threads,
            time_limit=time_limit,
            noise_level=noise_level,
            layers=layers,
            settings=settings,
        )
        structs = [(v if isinstance(v, View) else View(v))._struct() for v in views]
        self._renderer = _roomlight.Renderer.of(scene._home, wish, structs)

    def __len__(self) -> int:
        """How many views there are."""
        return self._renderer.view_count()

    def picture(self, view: int = 0, progress: Optional[Progress] = None) -> Picture:
        """The picture of a view, by its number. Threads that ask at once get theirs one after the other."""
        if not 0 <= view < len(self):
            raise IndexError(f"view {view}: there are {len(self)}, numbered from 0")
        return Picture(self._renderer.picture(view, progress))

    def __iter__(self) -> Iterator[Picture]:
        return (self.picture(i) for i in range(len(self)))


def render(
    scene: Scene,
    camera: Optional[Union[str, int]] = None,
    *,
    view: Union[str, View, None] = None,
    quality: Optional[str] = None,
    width: int = 0,
    height: int = 0,
    technique: Optional[str] = None,
    samples: int = 0,
    seed: int = 0,
    threads: int = 0,
    time_limit: float = 0,
    noise_level: float = 0,
    layers: Union[bool, str] = False,
    settings: Optional[Mapping[str, Any]] = None,
    progress: Optional[Progress] = None,
) -> Picture:
    """Renders one picture of a scene.

    camera: its name, or number from 0; None: the default. view: a `View`, or its kind: "camera", "top", "plan",
    "panorama" or "stereo". quality: "draft", "good" or "best". width, height: in pixels; 0: as the home says, else 960
    and 540. technique: "hybrid" (the default), "path" and others (`roomlight.techniques()`). samples: a pixel.
    seed: the same seed gives the same picture, with any number of threads. threads: 0: all cores. time_limit: in
    seconds after loading. noise_level: stop below this part of the light, such as 0.02. layers: True: the light of
    every lamp, the sun and the sky apart as well; "room": lamps of a room together. settings: all else, as `render
    --settings` takes it (docs/reference/command-line.md); arguments go first.

    progress: called as progress(stage, fraction), with a fraction from 0 to 1, from one thread at a time, which is not
    the caller's. Where it returns False, the best picture so far is returned, or `Interrupted` raised where there is
    none. What it raises ends the work and is raised here. Ctrl-C raises KeyboardInterrupt. Other threads of Python run
    meanwhile.
    """
    wish = _settings(
        quality=quality,
        width=width,
        height=height,
        technique=technique,
        samples=samples,
        seed=seed,
        threads=threads,
        time_limit=time_limit,
        noise_level=noise_level,
        layers=layers,
        settings=settings,
    )
    if isinstance(view, View):
        if camera is not None:
            raise InputError("camera: is the view's to say where a View is given")
        seen = view
    else:
        seen = View(camera, kind=view or "camera")
    return Picture(_roomlight.render(scene._home, seen._struct(), wish, progress))


def open_layers(path: Path) -> Layers:
    """Opens a picture in layers: .exr by `render --layers`, or by `Picture.save`."""
    return Layers(_roomlight.Layers.open(file_name(path)))


def write(image: npt.ArrayLike, path: Path) -> None:
    """Writes an sRGB image, uint8 of the shape (h, w, 3) or (h, w, 4), as .png, .jpg or .webp."""
    array = np.asarray(image)
    if array.dtype != np.uint8 or array.ndim != 3 or array.shape[2] not in (3, 4):
        raise InputError(
            f"image: must be uint8 of the shape (h, w, 3) or (h, w, 4), and is {array.dtype} of {array.shape};"
            " linear pixels are written by Picture.save and Layers.save"
        )
    _roomlight.write(np.ascontiguousarray(array), file_name(path))


def techniques() -> Dict[str, str]:
    """Names of techniques, and what they are."""
    return dict(_roomlight.techniques())


def qualities() -> Dict[str, str]:
    """Names of qualities, and what they are for."""
    return dict(_roomlight.qualities())


def _text(value: Optional[Union[str, int]]) -> Optional[str]:
    return None if value is None else str(value)


def _look(look: Union[str, Look], exposure: Union[str, float, None]) -> _roomlight.DisplayOptions:
    struct = (look if isinstance(look, Look) else Look(look))._struct()
    return filled(struct, exposure=None if exposure is None else str(exposure))


def _settings(
    *, settings: Optional[Mapping[str, Any]], layers: Union[bool, str], **values: object
) -> _roomlight.Settings:
    if isinstance(layers, str) and layers != "room":
        raise InputError(f"layers: must be True, False or 'room', and is '{layers}'")
    return filled(
        _roomlight.Settings(),
        settings=None if settings is None else json.dumps(settings, default=lambda v: v.item()),
        layers=bool(layers),
        layers_by_room=layers == "room",
        **values,
    )


def _dial(dial: Dial) -> str:
    if isinstance(dial, str):
        return dial
    if isinstance(dial, (bool, np.bool_)):
        return "on" if dial else "off"
    return f"{100 * float(dial):.9g}%"


def _dials(
    lamps: Optional[Mapping[str, Dial]], kelvin: Optional[float], sun: Optional[Dial], sky: Optional[Dial]
) -> _roomlight.Dials:
    return filled(
        _roomlight.Dials(),
        lamps=[(name, _dial(dial)) for name, dial in (lamps or {}).items()],
        kelvin=kelvin,
        sun=None if sun is None else _dial(sun),
        sky=None if sky is None else _dial(sky),
    )
