"""The words of scenes as types, for editors and type checkers.

Made of the schema (`tracer schema`); `UPDATE_EXPECT=1 cargo test -p tracer-python --test words` makes it anew.

>>> from tracer.words import SceneDict
>>> scene: SceneDict = {"background": 1, "objects": [{"Sphere": {"center": [0, 0, 0], "radius": 1}}]}
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict, Literal, Sequence, TypedDict
from typing import Union as Either

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._assets import Mesh as MeshArrays

    Array = npt.NDArray[Any]
    File = Either[str, "os.PathLike[str]", Array, MeshArrays]
else:
    Array = Any
    File = Any

AlignItem = TypedDict("AlignItem", {"Align": "Align"})
AmbientOcclusionItem = TypedDict("AmbientOcclusionItem", {"AmbientOcclusion": "AmbientOcclusion"})
ArrowItem = TypedDict("ArrowItem", {"Arrow": "Arrow"})
BlackmanHarrisItem = TypedDict("BlackmanHarrisItem", {"BlackmanHarris": "BlackmanHarris"})
BlinnPhongItem = TypedDict("BlinnPhongItem", {"BlinnPhong": "BlinnPhong"})
BoxItem = TypedDict("BoxItem", {"Box": "Box"})
CapsuleItem = TypedDict("CapsuleItem", {"Capsule": "Capsule"})
CenterToItem = TypedDict("CenterToItem", {"CenterTo": "Either[CenterTo, Sequence[Either[float, str]], Array, str]"})
CheckerboardItem = TypedDict("CheckerboardItem", {"Checkerboard": "Checkerboard"})
ColorRampItem = TypedDict("ColorRampItem", {"ColorRamp": "ColorRamp"})
ConductorItem = TypedDict("ConductorItem", {"Conductor": "Conductor"})
ConeItem = TypedDict("ConeItem", {"Cone": "Cone"})
CylinderItem = TypedDict("CylinderItem", {"Cylinder": "Cylinder"})
DifferenceItem = TypedDict("DifferenceItem", {"Difference": "Difference"})
DiffuseItem = TypedDict("DiffuseItem", {"Diffuse": "Diffuse"})
DiskItem = TypedDict("DiskItem", {"Disk": "Disk"})
DotsItem = TypedDict("DotsItem", {"Dots": "Dots"})
DropToItem = TypedDict("DropToItem", {"DropTo": "Either[DropTo, float, str]"})
EmissiveItem = TypedDict("EmissiveItem", {"Emissive": "Emissive"})
EnvironmentItem = TypedDict("EnvironmentItem", {"Environment": "Environment"})
ExtrudeItem = TypedDict("ExtrudeItem", {"Extrude": "Extrude"})
FisheyeItem = TypedDict("FisheyeItem", {"Fisheye": "Fisheye"})
FitToItem = TypedDict("FitToItem", {"FitTo": "FitTo"})
GaussianItem = TypedDict("GaussianItem", {"Gaussian": "Gaussian"})
GradientItem = TypedDict("GradientItem", {"Gradient": "Gradient"})
GridItem = TypedDict("GridItem", {"Grid": "Grid"})
GroupItem = TypedDict("GroupItem", {"Group": "Group"})
HeightFieldItem = TypedDict("HeightFieldItem", {"HeightField": "HeightField"})
IncludeItem = TypedDict("IncludeItem", {"Include": "Include"})
IntersectionItem = TypedDict("IntersectionItem", {"Intersection": "Intersection"})
LatheItem = TypedDict("LatheItem", {"Lathe": "Lathe"})
LinesItem = TypedDict("LinesItem", {"Lines": "Lines"})
MarbleItem = TypedDict("MarbleItem", {"Marble": "Marble"})
MatrixItem = TypedDict("MatrixItem", {"Matrix": "Matrix"})
MeshItem = TypedDict("MeshItem", {"Mesh": "Mesh"})
MirrorItem = TypedDict("MirrorItem", {"Mirror": "Mirror"})
MixItem = TypedDict("MixItem", {"Mix": "Mix"})
MultiplyItem = TypedDict("MultiplyItem", {"Multiply": "Multiply"})
NoiseItem = TypedDict("NoiseItem", {"Noise": "Noise"})
ObjectItem = TypedDict("ObjectItem", {"Object": "ObjectKind"})
OrthographicItem = TypedDict("OrthographicItem", {"Orthographic": "Orthographic"})
PickItem = TypedDict("PickItem", {"Pick": "Pick"})
PlanarItem = TypedDict("PlanarItem", {"Planar": "Planar"})
PlaneItem = TypedDict("PlaneItem", {"Plane": "Plane"})
PolygonItem = TypedDict("PolygonItem", {"Polygon": "Polygon"})
RectangleItem = TypedDict("RectangleItem", {"Rectangle": "Rectangle"})
RepeatItem = TypedDict("RepeatItem", {"Repeat": "Repeat"})
RingItem = TypedDict("RingItem", {"Ring": "Ring"})
RotateItem = TypedDict("RotateItem", {"Rotate": "Rotate"})
ScaleItem = TypedDict("ScaleItem", {"Scale": "Either[Scale, float, str, Sequence[Either[float, str]], Array]"})
ScatterItem = TypedDict("ScatterItem", {"Scatter": "Scatter"})
SphereItem = TypedDict("SphereItem", {"Sphere": "Sphere"})
SphereLightItem = TypedDict("SphereLightItem", {"SphereLight": "SphereLight"})
SphericalItem = TypedDict("SphericalItem", {"Spherical": "Spherical"})
StereoItem = TypedDict("StereoItem", {"Stereo": "Stereo"})
TextureItem = TypedDict("TextureItem", {"Texture": "Texture"})
ThinLensItem = TypedDict("ThinLensItem", {"ThinLens": "ThinLens"})
TorusItem = TypedDict("TorusItem", {"Torus": "Torus"})
TranslateItem = TypedDict("TranslateItem", {"Translate": "Either[Sequence[Either[float, str]], Array, str]"})
TransparentItem = TypedDict("TransparentItem", {"Transparent": "Transparent"})
TriplanarItem = TypedDict("TriplanarItem", {"Triplanar": "Triplanar"})
TubeItem = TypedDict("TubeItem", {"Tube": "Tube"})
UnionItem = TypedDict("UnionItem", {"Union": "Union"})
UvItem = TypedDict("UvItem", {"Uv": "Uv"})
VertexColorItem = TypedDict("VertexColorItem", {"VertexColor": "VertexColor"})
VoronoiItem = TypedDict("VoronoiItem", {"Voronoi": "Voronoi"})
WoodItem = TypedDict("WoodItem", {"Wood": "Wood"})
WorldItem = TypedDict("WorldItem", {"World": "World"})

_PickRequired = TypedDict(
    "_PickRequired",
    {
    "from": "Sequence[Any]",
    "index": "Either[int, str, PickItem]",
    },
)
_PickFields = TypedDict("_PickFields", {
}, total=False)


class Pick(_PickRequired, _PickFields, total=False):
    """One of several values, by a number: `Pick(from: ["red", "blue"], index: "=i")`.

    from: The values, a thousand at most: anything that may stand where the pick does.
    index: Which of them, counted from 0; after the last one the first follows again.
    """


class _RepeatRequired(TypedDict):
    count: Either[int, str, PickItem]
    items: Sequence[Any]


class Repeat(_RepeatRequired, total=False):
    """Puts its items into the list so many times.

    count: How many times.
    index: The name that counts from 0 in expressions within.
    vars: Values by name, reckoned anew each time.
    items: What is put into the list each time.
    """

    index: Either[str, PickItem]
    vars: Dict[str, Any]


class Animation(TypedDict, total=False):
    """A film of this scene, frame by frame. In expressions `frame` is the frame's number, from 0, and `time` its seconds from the start. Each frame is a picture of its own; `shutter` of the camera blurs what moves in it.

    frames: How many frames there are.
    fps: Frames in a second: `time` is `frame / fps`. Unit: per second.
    frame: The frame that is seen unless the command line names others (`--frame 12`, `--frames 0-47`).
    """

    frames: Either[int, str, PickItem]
    fps: Either[float, str, PickItem]
    frame: Either[int, str, PickItem]


class Camera(TypedDict, total=False):
    """A camera: a pinhole, unless `effects` give it a lens or `projection` makes it another. Pixels are square: of one whose fx and fy differ, stretch the picture afterwards.

    position: Eye point. Unit: the scene's unit.
    look_at: A point in the middle of the picture. Unit: the scene's unit.
    up: The direction that is up in the picture.
    matrix: Instead of `position`, `look_at` and `up`, as other programs say it: three rows of four numbers, whose columns are the directions to the right, upwards and backwards in the picture, and the eye point, as in glTF and Blender. It turns and moves, nothing else.
    fov: Field of view in degrees: the picture's height, unless `fov_axis` says otherwise.
    fov_axis: Side of the picture that `fov` is measured along.
    focal_length: Instead of `fov`, as photographers say it: the focal length of a lens before film that is `sensor_width` wide. 50 is normal for film of 36 mm, 24 wide, 85 a portrait. The picture's width sees 2 atan(sensor_width / 2 focal_length). How sharp it is, `effects` say. Unit: millimetres.
    sensor_width: Width of the film for `focal_length`. Unit: millimetres.
    shift: Moves the film, as a view camera does: what is seen moves by so many picture heights to the right and up, and upright walls stay parallel where `up` lies in the film. (0, 0.5) shows the upper half twice as high up. Unit: picture heights.
    near: What is nearer than this along the view is not seen by the camera: a wall between it and the room, say. It still shades and shows in mirrors. Unit: the scene's unit.
    shutter: Motion blur: the shutter is open from the frame's `time` on, for this share of a frame. What is an expression of `time` moves meanwhile; each sample sees the scene at a moment of its own. 0.5 is what films have. 0: nothing moves while a picture is taken.
    projection: How directions become places in the picture.
    stereo: Two pictures in one, for two eyes; with `Perspective` and `Panorama`.
    """

    position: Either[Sequence[Either[float, str]], Array, str, PickItem]
    look_at: Either[Sequence[Either[float, str]], Array, str, PickItem]
    up: Either[Sequence[Either[float, str]], Array, str, PickItem]
    matrix: Any
    fov: Either[float, str, PickItem]
    fov_axis: Either[FovAxis, PickItem]
    focal_length: Any
    sensor_width: Either[float, str, PickItem]
    shift: Either[Sequence[Either[float, str]], Array, str, PickItem]
    near: Any
    shutter: Either[float, str, PickItem]
    projection: Either[Projection, PickItem]
    stereo: Either[Stereoscopy, PickItem]


FovAxis = Literal["Vertical", "Horizontal", "Diagonal", "Smaller", "Larger"]

Projection = Either[Literal["Perspective", "Panorama"], "OrthographicItem", "FisheyeItem"]

class _OrthographicRequired(TypedDict):
    height: Either[float, str, PickItem]


class Orthographic(_OrthographicRequired, total=False):
    """Parallel rays from the plane of `position`: nothing becomes smaller with distance, as in plans and figures. What lies behind that plane is not seen.

    height: What the picture's height shows. Unit: the scene's unit.
    """


class Fisheye(TypedDict, total=False):
    """A fisheye lens: a round picture in the middle of the frame, as large as its shorter side. Around it there is nothing: black, and no part of `alpha`.

    fov: The whole angle that the circle shows; 360 is all there is. Unit: degrees.
    mapping: From the angle to the view direction to the distance from the middle.
    """

    fov: Either[float, str, PickItem]
    mapping: Either[FisheyeMapping, PickItem]


FisheyeMapping = Literal["Equidistant", "Equisolid", "Stereographic", "Orthographic"]

Stereoscopy = Any

class _StereoRequired(TypedDict):
    separation: Either[float, str, PickItem]


class Stereo(_StereoRequired, total=False):
    """Two pictures in one, for two eyes that stand to the left and right of `position` and look the same way. Each has half of `image`: for two pictures of 1280x720 side by side it is 2560x720. With `Panorama` they are omnidirectional: whichever way one looks, the eyes stand beside each other across it.

    separation: From eye to eye: 0.064 for people, where the scene's unit is the metre. Unit: the scene's unit.
    convergence: How far away, along the view axis, things are that both eyes see at the same place of their pictures: they seem to lie in the screen, nearer ones before it. `None`: infinitely far, both look straight ahead. Unit: the scene's unit.
    layout: How the two pictures lie in the one.
    """

    convergence: Any
    layout: Either[StereoLayout, PickItem]


StereoLayout = Literal["SideBySide", "TopBottom"]

class Image(TypedDict, total=False):
    """Size of the picture in pixels.

    width: Pixels across. Unit: pixels.
    height: Pixels down. Unit: pixels.
    """

    width: Either[int, str, PickItem]
    height: Either[int, str, PickItem]


class Render(TypedDict, total=False):
    """How to render.

    samples: Camera samples per pixel.
    max_bounces: Scattering events after the first hit: a path has at most `max_bounces + 1` segments from the camera through surfaces, and one more to a light. Each side of glass that is seen through is one: a glass in a glass has eight sides, and what lies behind them is black with fewer.
    seed: Seed of all random choices.
    acceleration: What finds the hits; the picture is the same, byte for byte.
    integrator: What the picture is of, and with or without what saves noise.
    reuse: Whether the pixels of a block share what they find.
    caustics: How light comes over mirrors and glass to diffuse surfaces.
    indirect: How light comes to second vertices over further surfaces.
    clamp: The most that one camera sample counts: where the largest channel of what it has found, lamps in view included, is more than this (before exposure), all three are scaled down together, so that the hue stays. That takes fireflies, and their light with them: such pixels stay too dark however many samples follow. The report says how much was taken. `None` takes nothing. What one light path brings (`caustics`) counts at most as much; a caustic of many may be brighter. Unit: W/(sr m^2).
    noise: The rendering ends as soon as the noise is no more than this: the root mean square over the pixels of their standard error, relative to the mean luminance, as the report has it. 0.01 is hardly seen. It is told by how two halves of the samples differ, 0.8 to 1.2 times the true error (docs/noise.md), where few pixels bear it half to twice as much, and where something moves while the shutter is open by how they scatter, which is more. With `alpha` or `backdrop` it is that of the picture without the background. `samples` are the most. It is looked at after whole passes only, four times while the samples double, so the picture depends on nothing else; first when all pixels have 16 samples, where something moves 16 or 64. What is rarer is missing in a picture that ends then, and in its noise. `None`: all samples.
    adaptive: Whether parts of the picture that are quiet take fewer samples than those that are noisy: tiles of 16x16 pixels a half, a quarter or an eighth of them, from 64 samples per pixel on. It is unbiased: four pictures of one sample per pixel, which are not shown, tell which, and where less than a fifth of the samples would be saved all tiles take all. `samples` are those of the noisy ones then (docs/noise.md). Where something moves while the shutter is open all take all.
    time: The rendering ends when the program has run so long. `samples` are the most. `None`: all samples. Unit: seconds.
    """

    samples: Either[int, str, PickItem]
    max_bounces: Either[int, str, PickItem]
    seed: Either[int, str, PickItem]
    acceleration: Either[Acceleration, PickItem]
    integrator: Either[Integrator, PickItem]
    reuse: Either[Reuse, PickItem]
    caustics: Either[Caustics, PickItem]
    indirect: Either[Indirect, PickItem]
    clamp: Any
    noise: Any
    adaptive: Either[Adaptive, PickItem]
    time: Any


Acceleration = Any

Integrator = Either[Literal["Full", "Path", "Direct"], "AmbientOcclusionItem"]

class AmbientOcclusion(TypedDict, total=False):
    """No light at all: how much of the half space above each surface that the camera sees is free, weighted by the cosine. 1 is free, 0 all closed; where nothing is seen it is 0. Materials and lights do not matter, glass and lamps are in the way like all else.

    distance: What is further off than this does not count. `None`: everything counts. Unit: the scene's unit.
    """

    distance: Any


Reuse = Any

Caustics = Any

Indirect = Literal["Map", "Paths"]

Adaptive = Literal["WithNoise", "Always", "Never"]

class Effects(TypedDict, total=False):
    """Film and lens effects.

    antialiasing: The pixel's reconstruction filter.
    depth_of_field: Lens; `None` is a pinhole.
    exposure: Exposure in stops: the radiance is multiplied by 2^exposure.
    tone_map: Curve from exposed radiance to display.
    """

    antialiasing: Either[PixelFilter, PickItem]
    depth_of_field: Either[DepthOfField, PickItem]
    exposure: Either[float, str, PickItem]
    tone_map: Either[ToneMap, PickItem]


PixelFilter = Any

class Gaussian(TypedDict, total=False):
    """A Gaussian of this standard deviation, in pixels.

    sigma: Standard deviation in pixels.
    """

    sigma: Either[float, str, PickItem]


class BlackmanHarris(TypedDict, total=False):
    """The Blackman-Harris window, 4 terms, of this radius in pixels.

    radius: Half width in pixels.
    """

    radius: Either[float, str, PickItem]


DepthOfField = Any

class _ThinLensRequired(TypedDict):
    aperture: Either[float, str, PickItem]


class ThinLens(_ThinLensRequired, total=False):
    """A thin lens: a disc-shaped aperture, or one with blades, sharp at the plane of focus. Where that is, is said by exactly one of `focus_distance` and `focus_on`.

    aperture: Diameter of the lens, in the scene's unit: a point at distance d along the view axis is blurred to a disc that is aperture * |d - focus_distance| / d across in the plane of focus. A photographer's f-number is focal length over aperture.
    focus_distance: Distance from the eye to the plane of focus, along the view axis. Unit: the scene's unit.
    focus_on: A point that is sharp: the plane of focus goes through it. Unit: the scene's unit.
    blades: Blades of the aperture, three or more: blurred lights become polygons with so many corners, as large as the disc. 0: discs.
    rotation: Turns the aperture, counter-clockwise as the picture shows it; at 0 it has a corner to the right. A disc has none. Unit: degrees.
    tilt: Turns the plane of focus about the picture's right, then about its up, as a view camera does: (-80, 0) makes a table sharp from front to back. Unit: degrees.
    """

    focus_distance: Any
    focus_on: Any
    blades: Either[int, str, PickItem]
    rotation: Either[float, str, PickItem]
    tilt: Either[Sequence[Either[float, str]], Array, str, PickItem]


ToneMap = Any

class Output(TypedDict, total=False):
    """What is written beside the picture.

    layers: Layers that EXR files get beside the picture: what camera rays hit first. The picture is the same with and without them.
    alpha: Leaves the background out, to lay the picture over another one: PNG and EXR files say how much of each pixel is covered. It still lights the scene, and shows in mirrors and through glass.
    backdrop: A colour to see instead of the background, whatever exposure and tone map do to the rest: `1` is white paper. The background still lights the scene, and shows in mirrors and through glass.
    cryptomatte: Mattes that EXR files get beside the picture, in the form of Cryptomatte: compositing programs cut out any object or material by its name, with soft edges.
    masks: Masks that EXR files get beside the picture: for each of these names the share of every pixel that the objects and lights of that name cover, as `mask.NAME.Y`.
    light_groups: Tells apart what each group of lights brings: EXR files get `light.GROUP.R`, `.G`, `.B` for every `group` that lights, shining objects and the background have, and `light.rest.R`, `.G`, `.B` for those that have none. They sum to the picture. Each sample is traced once for every group.
    marks: Points by names: `{ "A": (0, 1, 0) }`. The report (`--report`) tells for each the pixel that shows it, how far away it is, and whether something hides it: for labels that are laid over the picture.
    """

    layers: Sequence[Either[Layer, RepeatItem, PickItem]]
    alpha: Either[bool, str, PickItem]
    backdrop: Any
    cryptomatte: Sequence[Either[Matte, RepeatItem, PickItem]]
    masks: Sequence[Either[str, RepeatItem, PickItem]]
    light_groups: Either[bool, str, PickItem]
    marks: Dict[str, Either[Sequence[Either[float, str]], Array, str]]


Layer = Literal["Albedo", "Normal", "Depth", "Position", "Uv", "Emission", "ObjectId", "MaterialId", "Variance", "Alpha", "Noise", "PathLength", "Nodes", "Leaves", "Direct", "Indirect", "Samples", "Motion", "DenoisingAlbedo", "DenoisingNormal"]

Matte = Literal["Objects", "Materials"]

Background = EnvironmentItem

class _EnvironmentRequired(TypedDict):
    file: File


class Environment(_EnvironmentRequired, total=False):
    """Light from all directions as a picture has it: 360 degrees across, 180 down. Its middle lies where a camera looks by default, to -z, what is right of there to +x, and its top row at `up`. It is linear between the middles of its texels, so that a sun of one texel is two wide, and at the poles as in its first and last row.

    file: HDR, EXR, PNG or JPEG, relative to the scene file; twice as wide as it is high.
    scale: Radiance where the picture has 1: one number, or three of red, green and blue. Unit: W/(sr m^2).
    rotation: Turns it about `up`, counter-clockwise seen from there. Unit: degrees.
    up: Direction of the top row.
    camera_visible: Whether the camera sees it; what it lights, and mirrors and glass show it in any case.
    group: The group of lights that it is of: with `output.light_groups`, what each group brings to the picture is told apart. Several may have one.
    """

    scale: Either[float, Sequence[Either[float, str]], Array, str, PickItem]
    rotation: Either[float, str, PickItem]
    up: Either[Sequence[Either[float, str]], Array, str, PickItem]
    camera_visible: Either[bool, str, PickItem]
    group: Any


Light = SphereLightItem

class _SphereLightRequired(TypedDict):
    center: Either[Sequence[Either[float, str]], Array, str, PickItem]
    radius: Either[float, str, PickItem]


class SphereLight(_SphereLightRequired, total=False):
    """A luminous sphere; it emits and does not reflect. How much it emits is said by exactly one of `intensity`, `radiance` and `power`, or, as people see it, of `luminous_intensity`, `luminance` and `luminous_power`.

    center: Centre. Unit: the scene's unit.
    radius: Radius. Unit: the scene's unit.
    intensity: Radiant intensity: L = I / (pi r^2). Unit: W/sr.
    radiance: Radiance L of every point of the sphere. Unit: W/(sr m^2).
    power: Power: L = P / (4 pi^2 r^2). Unit: W.
    luminous_intensity: Luminous intensity: 683 times the luminance Y of an intensity in W/sr. Unit: cd.
    luminance: Luminance: 683 Y of a radiance. Unit: cd/m^2.
    luminous_power: Luminous flux, as lamps are sold: 683 Y of a power. A bulb of 60 W in old times is one of 800 lm. Unit: lm.
    color: The colour of the light. Only what it is beside its own luminance counts: the amount times color / Y(color). `"=blackbody(2700)"` is that of a bulb.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still shines, and is seen in mirrors and through glass.
    name: What it is called: `--set lights.NAME.radius=2` finds it where no other has this name.
    group: The group of lights that it is of: with `output.light_groups`, what each group brings to the picture is told apart. Several may have one.
    """

    intensity: Any
    radiance: Any
    power: Any
    luminous_intensity: Any
    luminance: Any
    luminous_power: Any
    color: Either[float, Sequence[Either[float, str]], Array, str, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any
    group: Any


Pattern = Either["TextureItem", "CheckerboardItem", "LinesItem", "DotsItem", "GradientItem", "NoiseItem", "WoodItem", "MarbleItem", "VoronoiItem", "ColorRampItem", "MixItem", "MultiplyItem", "VertexColorItem"]

class _TextureRequired(TypedDict):
    file: File


class Texture(_TextureRequired, total=False):
    """A picture laid over a surface by `vt` on meshes and by longitude and latitude on spheres.

    file: PNG, JPEG, HDR or EXR, relative to the scene file. Numbers of HDR and EXR files beyond 0 to 1 are clipped, and what is none is 0; of an EXR file of several parts the first with R, G and B is taken. In memory a texel takes 4 bytes, of HDR, EXR and PNG of 16 bits 12. A picture within a glTF file is called by its place in it: `model.glb/images[0]`.
    filter: Between texels.
    wrap: Beyond the borders.
    color_space: What the picture's numbers mean.
    channel: What of the picture counts.
    mapping: Where it lies.
    """

    filter: Either[TextureFilter, PickItem]
    wrap: Either[TextureWrap, PickItem]
    color_space: Either[TextureColorSpace, PickItem]
    channel: Either[TextureChannel, PickItem]
    mapping: Either[Mapping, PickItem]


TextureFilter = Literal["Bilinear", "Nearest"]

TextureWrap = Literal["Repeat", "Clamp", "Mirror"]

TextureColorSpace = Literal["Auto", "Srgb", "Linear"]

TextureChannel = Literal["Auto", "Red", "Green", "Blue", "Alpha", "Luminance"]

Mapping = Either["UvItem", "PlanarItem", "SphericalItem", "TriplanarItem"]

class Uv(TypedDict, total=False):
    """By the surface's texture coordinates: scaled, then turned, then moved.

    scale: So many times along each side, or one number for both.
    rotation: Angle, counter-clockwise where v points up. Unit: degrees.
    offset: Added at last.
    """

    scale: Either[float, str, Sequence[Either[float, str]], Array, PickItem]
    rotation: Either[float, str, PickItem]
    offset: Either[Sequence[Either[float, str]], Array, str, PickItem]


class Planar(TypedDict, total=False):
    """Seen along a direction, as if a projector far away threw it on the object: from there it is upright, what faces away shows it mirrored, what runs along the direction shows it drawn out. It goes by the coordinates that the shape is written in, before its `transform` and `placements`, and needs no texture coordinates. To the right and upwards are those of a `Rectangle` with this normal: to the right is (0, 1, 0) x normal, or (1, 0, 0) where the normal is upright.

    origin: Where its lower left corner is. Unit: the scene's unit.
    normal: The direction that it is seen from.
    size: How far it goes to the right and upwards before it begins again, or one number for both. Unit: the scene's unit.
    """

    origin: Either[Sequence[Either[float, str]], Array, str, PickItem]
    normal: Either[Sequence[Either[float, str]], Array, str, PickItem]
    size: Either[float, str, Sequence[Either[float, str]], Array, PickItem]


class Spherical(TypedDict, total=False):
    """By longitude and latitude about a point, as a map lies on a globe: u goes round once and v is 0 at the lower pole and 1 at the upper one, as on a `Sphere`. It goes by the coordinates that the shape is written in, before its `transform` and `placements`, and needs no texture coordinates.

    center: The point in the middle. Unit: the scene's unit.
    axis: The direction of the upper pole. Where it is upright u begins at -z and is 1/2 at +z.
    scale: So many times round and from pole to pole, or one number for both.
    """

    center: Either[Sequence[Either[float, str]], Array, str, PickItem]
    axis: Either[Sequence[Either[float, str]], Array, str, PickItem]
    scale: Either[float, str, Sequence[Either[float, str]], Array, PickItem]


class Triplanar(TypedDict, total=False):
    """Seen along x, along y and along z at once, each as much as the surface faces that way: no seams, no drawn out sides, no texture coordinates. It is three `Planar` mappings in one, of the normals (1, 0, 0), (0, 1, 0) and (0, 0, 1), mixed by |n|^(1 / `blend`) with n the normal in the coordinates that the shape is written in.

    scale: So many times along a unit of length.
    blend: How softly one side goes over into the next: near 0 with a sharp edge.
    """

    scale: Either[float, str, PickItem]
    blend: Either[float, str, PickItem]


class Checkerboard(TypedDict, total=False):
    """Squares of two colours, one square a unit of the mapped coordinates: `a` where the sum of their whole parts is even. In space they are cubes, and a face that lies where two meet is in the upper one.

    a: One colour.
    b: The other one.
    mapping: How the squares lie: `Uv(scale: 8)` puts eight along each side of a rectangle, `Object(scale: 2)` two along a unit of length.
    """

    a: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    b: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    mapping: Either[SolidMapping, PickItem]


SolidMapping = Either["UvItem", "ObjectItem", "WorldItem", "PlanarItem", "SphericalItem", "TriplanarItem"]

class ObjectKind(TypedDict, total=False):
    """By the coordinates that the shape is written in, before its `transform` and `placements` and those of groups: the texture goes with the object, which is turned to turn it. A `center` other than the origin is such a coordinate, too.

    scale: So many cells of the texture a unit along each axis, or one number for all.
    offset: Added at last.
    """

    scale: Either[float, str, Sequence[Either[float, str]], Array, PickItem]
    offset: Either[Sequence[Either[float, str]], Array, str, PickItem]


class World(TypedDict, total=False):
    """By the scene's coordinates, after all transforms: objects move through the texture, and those side by side share it.

    scale: So many cells of the texture a unit along each axis, or one number for all.
    offset: Added at last.
    """

    scale: Either[float, str, Sequence[Either[float, str]], Array, PickItem]
    offset: Either[Sequence[Either[float, str]], Array, str, PickItem]


class Lines(TypedDict, total=False):
    """Lines where the mapped coordinates are whole: a grid, tiles with joints, stripes.

    a: The colour of the lines.
    b: The colour between them.
    width: How wide a line is; lines are one apart. 0.5 makes even stripes.
    along: Which way the lines run.
    mapping: How they lie: `Uv(scale: 8)` puts eight along each side of a rectangle.
    """

    a: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    b: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    width: Either[float, str, PickItem]
    along: Either[LinesAlong, PickItem]
    mapping: Either[Mapping, PickItem]


LinesAlong = Literal["Both", "U", "V"]

class Dots(TypedDict, total=False):
    """Round dots, one in the middle of each unit square of the mapped coordinates.

    a: The colour between the dots.
    b: The colour of the dots.
    radius: Half a dot's width; dots are one apart.
    mapping: How they lie: `Uv(scale: 8)` puts eight along each side of a rectangle.
    """

    a: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    b: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    radius: Either[float, str, PickItem]
    mapping: Either[Mapping, PickItem]


class Gradient(TypedDict, total=False):
    """From `a` where the mapped coordinate is 0 to `b` where it is 1, linear between, and constant beyond.

    a: The colour at 0.
    b: The colour at 1.
    axis: What runs from 0 to 1.
    mapping: How it lies.
    """

    a: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    b: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    axis: Either[GradientAxis, PickItem]
    mapping: Either[SolidMapping, PickItem]


GradientAxis = Literal["Y", "X", "Z", "Radial"]

class Noise(TypedDict, total=False):
    """Perlin's improved noise (2002), mixed from octaves: clouds, dirt, wear. It seldom comes near its two colours: of `Fbm` with six octaves 98 % of all points have t from 0.32 to 0.68, of `Perlin` from 0.21 to 0.80, of `Turbulence` from 0.06 to 0.46 (half of them below 0.21). For more contrast take `a` darker and `b` lighter than what is to be seen.

    a: The colour where the noise is lowest.
    b: The colour where it is highest.
    kind: How octaves are mixed.
    octaves: How many; Perlin has one whatever is said here.
    lacunarity: Each octave is so many times finer than the last.
    gain: Each octave counts so many times what the last does.
    mapping: How it lies: `Object(scale: 4)` puts four cells of noise along a unit of length.
    """

    a: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    b: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    kind: Either[NoiseKind, PickItem]
    octaves: Either[int, str, PickItem]
    lacunarity: Either[float, str, PickItem]
    gain: Either[float, str, PickItem]
    mapping: Either[SolidMapping, PickItem]


NoiseKind = Literal["Fbm", "Perlin", "Turbulence"]

class Wood(TypedDict, total=False):
    """Rings around the trunk's axis, one a unit of the mapped coordinates, bent by noise. Along the axis it looks like the side of a plank, in stripes; across it, at the end of a plank, like a cut tree, in rings about the origin. A floor or a table top shows stripes with `axis: (1, 0, 0)`, rings with the default. With `mapping: Object()` it turns with the object's `transform`. The axis passes through the origin: an `offset` of the mapping moves it.

    a: The colour in a ring's middle, and on the axis.
    b: The colour between.
    distortion: How far noise bends the rings, in rings.
    axis: Direction of the trunk, in the mapped coordinates: grain runs along it.
    mapping: How it lies: `Object(scale: 4)` makes it four times finer.
    """

    a: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    b: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    distortion: Either[float, str, PickItem]
    axis: Either[Sequence[Either[float, str]], Array, str, PickItem]
    mapping: Either[SolidMapping, PickItem]


class Marble(TypedDict, total=False):
    """Veins across an axis, one a unit of the mapped coordinates, bent by six octaves of turbulence. With `mapping: Object()` they turn with the object's `transform`, as `Wood` does.

    a: The colour of the veins.
    b: The colour between them.
    distortion: How far turbulence bends the veins, in veins.
    axis: Direction across the veins, in the mapped coordinates: they follow each other along it.
    mapping: How it lies: `Object(scale: 4)` makes it four times finer.
    """

    a: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    b: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    distortion: Either[float, str, PickItem]
    axis: Either[Sequence[Either[float, str]], Array, str, PickItem]
    mapping: Either[SolidMapping, PickItem]


class Voronoi(TypedDict, total=False):
    """Cells about scattered points, one point in each unit cube of the mapped coordinates (Worley 1996): stones, scales, cracks.

    a: The colour where the feature is 0.
    b: The colour where it is 1.
    feature: What goes from 0 to 1.
    jitter: How far points are from the middles of their cubes: at 0 they are there, at 1 anywhere in the cube.
    mapping: How it lies: `Object(scale: 4)` puts four cells along a unit of length.
    """

    a: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    b: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    feature: Either[VoronoiFeature, PickItem]
    jitter: Either[float, str, PickItem]
    mapping: Either[SolidMapping, PickItem]


VoronoiFeature = Literal["F1", "F2MinusF1", "Cell"]

class _ColorRampRequired(TypedDict):
    input: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    stops: Sequence[Either[Stop, RepeatItem, PickItem]]


class ColorRamp(_ColorRampRequired, total=False):
    """Colours by the luminance of another texture: what is dark there has the first colour, what is light the last, with any number of steps between.

    input: What says which colour: the luminance of a texture, from 0 to 1. A picture here is read as numbers: see `color_space`.
    stops: 2 to 64 colours, each at a number from 0 to 1 that is not below the one before: `[(at: 0, color: 0.1), (at: 0.6, color: "#c03020")]`. Two at the same number make an edge.
    interpolation: Between two stops.
    """

    interpolation: Either[RampInterpolation, PickItem]


class _StopRequired(TypedDict):
    at: Either[float, str, PickItem]
    color: Either[float, Sequence[Either[float, str]], Array, str, PickItem]


class Stop(_StopRequired, total=False):
    """A colour of a ramp.

    at: Where it is.
    color: The colour there.
    """


RampInterpolation = Literal["Linear", "Smooth", "Constant"]

class Mix(TypedDict, total=False):
    """Between two colours or textures, by a number or a texture: a + weight (b - a).

    a: What shows where the weight is 0.
    b: What shows where it is 1.
    weight: How much of `b` shows; of colours the luminance counts. A picture here is read as numbers: see `color_space`.
    """

    a: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    b: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    weight: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]


class Multiply(TypedDict, total=False):
    """The product of two colours or textures, channel by channel: one tints the other, or darkens it.

    a: One.
    b: The other.
    """

    a: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    b: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]


class VertexColor(TypedDict, total=False):
    """The colours of a mesh's vertices, between vertices by where a point lies in its triangle: scans, sculptures, simulations. They are decoded to linear light before they are mixed, and numbers beyond 0 to 1 are clipped. OBJ (`v x y z r g b`), OFF (`COFF`, or without saying so; 0 to 255, or 0 to 1 where none is above), PLY (`red green blue`, `diffuse_red ..` or `r g b`) and glTF (`COLOR_0`) files have them, and meshes that a scene writes out with `colors`; alpha does not count, nor do colours of faces, nor those that some programs hide in STL files. Where some vertices have none they are white. It is an error on an object that has no such colours.

    color_space: What their numbers mean.
    """

    color_space: Either[VertexColorSpace, PickItem]


VertexColorSpace = Literal["Auto", "Srgb", "Linear"]

Material = Either["DiffuseItem", "MirrorItem", "TransparentItem", "BlinnPhongItem", "ConductorItem", "EmissiveItem"]

class Diffuse(TypedDict, total=False):
    """Lambert: albedo / pi.

    albedo: Reflected share per channel.
    """

    albedo: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]


class Mirror(TypedDict, total=False):
    """A perfect mirror.

    reflectance: Reflected share per channel.
    """

    reflectance: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]


class _TransparentRequired(TypedDict):
    ior: Either[float, str, PickItem]


class Transparent(_TransparentRequired, total=False):
    """A smooth dielectric: exact Fresnel reflection and refraction. What lies flat against another thing is glued to it: no air is between, and most of what a floor beneath sends up is reflected back within the glass. Lifted by a thousandth of its height it stands on the floor with air between.

    ior: Index of refraction of the inside against the outside, below 1 where the inside is the thinner: an air bubble in water is 1/1.33 = 0.752, water within glass 1.33/1.5 = 0.887.
    transmittance: Share of refracted light that passes each surface, per channel.
    """

    transmittance: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]


class _BlinnPhongRequired(TypedDict):
    exponent: Either[float, str, Pattern, PickItem]
    specular: Either[float, str, Pattern, PickItem]


class BlinnPhong(_BlinnPhongRequired, total=False):
    """Blinn-Phong: albedo * ((1 - s)/pi + s (alpha + 2)/(2 pi) cos^alpha theta_h).

    albedo: Colour of both lobes.
    exponent: alpha: 1 is dull, 100000 nearly a mirror. A picture goes from 0 to 1: `Multiply(a: Texture(..), b: 1000)` or a `Mix` between two numbers by it.
    specular: s: share of the glossy lobe, 0 to 1.
    energy_conserving: The glossy lobe after Ashikhmin and Shirley, that never reflects more than it gets.
    """

    albedo: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    energy_conserving: Either[bool, str, PickItem]


class Conductor(TypedDict, total=False):
    """A metal, smooth or rough: GGX. What it reflects is said by exactly one of `metal`, `ior` (with `k`) and `reflectance`.

    metal: A measured metal.
    ior: Index of refraction per channel, for Fresnel's equations.
    k: Extinction coefficient per channel; with `ior` only.
    reflectance: Reflected share at normal incidence per channel; it grows to 1 at grazing angles (F82-tint model).
    edge_tint: What the reflected share at about 82 degrees is multiplied by, per channel; with `reflectance` only. None: 1.
    roughness: r: 0 is a mirror, 1 dull. The width of the lobe is alpha = r^2.
    multiple_scattering: Whether light that is reflected several times among the bumps counts (Kulla and Conty 2017): without it rough metals are too dark.
    """

    metal: Any
    ior: Any
    k: Any
    reflectance: Any
    edge_tint: Any
    roughness: Either[float, str, Pattern, PickItem]
    multiple_scattering: Either[bool, str, PickItem]


Metal = Literal["Silver", "Gold", "Copper", "Aluminum", "Iron", "Chromium", "Nickel", "Titanium", "Brass", "Platinum", "Steel"]

class Emissive(TypedDict, total=False):
    """A surface that shines and reflects nothing: whatever shape has it is a light. How much it shines is said by exactly one of `radiance`, `power` and `intensity`, or, as people see it, of `luminance`, `luminous_power` and `luminous_intensity`.

    radiance: Radiance L of every point, in all directions. Unit: W/(sr m^2).
    power: Power of each copy: L = P / (pi A), A the true area that shines (both sides where `two_sided`). Not of solids and their parts: nobody knows how much of their surface is left. Unit: W.
    intensity: Radiant intensity of each copy: of `Rectangle`, `Disk` and `Polygon` along the normal, L = I / A, A the area of one side; of `Sphere` L = 4 I / A, the mean over all directions where it was scaled unequally. Other shapes have none. Unit: W/sr.
    luminance: Luminance of every point: 683 times the luminance Y of a radiance. Unit: cd/m^2.
    luminous_power: Luminous flux of each copy, as lamps are sold: 683 Y of a power. Unit: lm.
    luminous_intensity: Luminous intensity of each copy: 683 Y of an intensity. Unit: cd.
    color: The colour of the light. Of a constant one only what it is beside its own luminance counts: the amount times color / Y(color). `"=blackbody(2700)"` is that of a bulb. A texture says how much of the amount, which is `radiance` or `luminance` then, each point has: where it is white all of it, where it is black nothing. So `luminance: 300, color: Texture(file: "screen.png")` is a screen whose white has 300 cd/m^2.
    two_sided: Whether it shines to both sides; else only to the normal's: outwards.
    group: The group of lights that what shines so is of: with `output.light_groups`, what each group brings to the picture is told apart.
    """

    radiance: Any
    power: Any
    intensity: Any
    luminance: Any
    luminous_power: Any
    luminous_intensity: Any
    color: Either[float, Sequence[Either[float, str]], Array, str, Pattern, PickItem]
    two_sided: Either[bool, str, PickItem]
    group: Any


Object = Either["SphereItem", "PlaneItem", "RectangleItem", "BoxItem", "DiskItem", "CylinderItem", "ConeItem", "CapsuleItem", "LatheItem", "ExtrudeItem", "TubeItem", "TorusItem", "ArrowItem", "HeightFieldItem", "PolygonItem", "MeshItem", "UnionItem", "IntersectionItem", "DifferenceItem", "GroupItem", "IncludeItem"]

class _SphereRequired(TypedDict):
    radius: Either[float, str, PickItem]


class Sphere(_SphereRequired, total=False):
    """A sphere; an ellipsoid by `Scale` in `transform`.

    center: Centre. Unit: the scene's unit.
    radius: Radius. Unit: the scene's unit.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last; textures turn along.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
    """

    center: Either[Sequence[Either[float, str]], Array, str, PickItem]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


Transform = Either["TranslateItem", "ScaleItem", "RotateItem", "DropToItem", "CenterToItem", "MatrixItem", "AlignItem", "FitToItem"]

class _ScaleRequired(TypedDict):
    factor: Either[float, str, Sequence[Either[float, str]], Array, PickItem]


class Scale(_ScaleRequired, total=False):
    """Scales; `Scale(2)` is short for `Scale(factor: 2)`.

    factor: One factor, or one per axis; negative ones mirror.
    about: Fixed point; `None`: the shape's middle (of meshes the mean of the vertices), in `placements` the origin. Unit: the scene's unit.
    """

    about: Any


class _RotateRequired(TypedDict):
    axis: Either[Sequence[Either[float, str]], Array, str, PickItem]
    degrees: Either[float, str, PickItem]


class Rotate(_RotateRequired, total=False):
    """Rotates by the right-hand rule.

    axis: Axis of rotation (any length but zero).
    degrees: Angle in degrees.
    about: Fixed point; `None`: the shape's middle (of meshes the mean of the vertices), in `placements` the origin. Unit: the scene's unit.
    """

    about: Any


class _DropToRequired(TypedDict):
    y: Either[float, str, PickItem]


class DropTo(_DropToRequired, total=False):
    """Moves along y so that the lowest point lies at this height.

    y: Height of the lowest point. Unit: the scene's unit.
    """


class _CenterToRequired(TypedDict):
    point: Either[Sequence[Either[float, str]], Array, str, PickItem]


class CenterTo(_CenterToRequired, total=False):
    """Moves so that the middle of its bounds lies at this point: half way between the lowest and the highest that it reaches along x, y and z of the world. Meshes of CAD and of scans lie far from the origin: `FitTo(size: 2)`, `CenterTo((0, 0, 0))` and `DropTo(0)` set any of them in the middle of the floor.

    point: Where the middle of its bounds is then. Unit: the scene's unit.
    """


class _MatrixRequired(TypedDict):
    rows: Either[Sequence[Either[Sequence[Either[float, str]], Array, str]], Array, PickItem]


class Matrix(_MatrixRequired, total=False):
    """An affine map, about the origin: the point (px, py, pz) comes to a px + b py + c pz + x, and so on. It may turn, scale, mirror, shear and move. Blender's `matrix_world` and Mitsuba's `to_world` have these rows and a fourth, which is left out; glTF and pbrt list columns. Worlds of POV-Ray and pbrt are mirrored: there the signs of x's row and then of x's column change.

    rows: Three rows of four numbers: three factors, and how far it moves.
    """


_AlignRequired = TypedDict(
    "_AlignRequired",
    {
    "to": "Either[Sequence[Either[float, str]], Array, str, PickItem]",
    },
)
_AlignFields = TypedDict("_AlignFields", {
    "from": "Either[Sequence[Either[float, str]], Array, str, PickItem]",
    "about": "Any",
}, total=False)


class Align(_AlignRequired, _AlignFields, total=False):
    """Turns by the least rotation that takes one direction to another. Where they are opposite it is half a turn about what is right on a `Rectangle` whose normal is `from`: x for (0, 1, 0).

    from: The direction that is turned (any length but zero).
    to: The direction that it is turned to.
    about: Fixed point; `None`: the shape's middle (of meshes the mean of the vertices), in `placements` the origin. Unit: the scene's unit.
    """


class FitTo(TypedDict, total=False):
    """Scales by one factor so that the object has this extent along one axis of the world, or as its largest. What has no extent along that axis is an error.

    height: Extent along y, from the lowest point to the highest. Unit: the scene's unit.
    width: Extent along x. Unit: the scene's unit.
    depth: Extent along z. Unit: the scene's unit.
    size: The largest of the three. Unit: the scene's unit.
    about: Fixed point; `None`: the shape's middle (of meshes the mean of the vertices), in `placements` the origin. Unit: the scene's unit.
    """

    height: Either[float, str, PickItem]
    width: Either[float, str, PickItem]
    depth: Either[float, str, PickItem]
    size: Either[float, str, PickItem]
    about: Any


PlacementPattern = Either["GridItem", "RingItem", "ScatterItem"]

class _GridRequired(TypedDict):
    count: Either[Sequence[Either[float, str]], Array, str, PickItem]


class Grid(_GridRequired, total=False):
    """Rows and columns about the origin, x first, then y, then z: `Grid(count: (5, 1, 5), spacing: (2, 1, 2))`.

    count: How many along x, y and z.
    spacing: From one to the next along x, y and z. Unit: the scene's unit.
    """

    spacing: Either[Sequence[Either[float, str]], Array, str, PickItem]


class _RingRequired(TypedDict):
    count: Either[int, str, PickItem]
    radius: Either[float, str, PickItem]


class Ring(_RingRequired, total=False):
    """Evenly on a circle about the origin, counter-clockwise seen from the tip of `axis`.

    count: How many.
    radius: Radius of the circle. Unit: the scene's unit.
    axis: What the circle goes round.
    start: Angle of the first copy. At 0 it stands where (0, 1, 0) x axis points, or (1, 0, 0) where the axis is upright. Unit: degrees.
    turn: Whether copies turn with the circle, as the seats of a carousel do; else all look the same way.
    """

    axis: Either[Sequence[Either[float, str]], Array, str, PickItem]
    start: Either[float, str, PickItem]
    turn: Either[bool, str, PickItem]


class _ScatterRequired(TypedDict):
    count: Either[int, str, PickItem]
    min: Either[Sequence[Either[float, str]], Array, str, PickItem]
    max: Either[Sequence[Either[float, str]], Array, str, PickItem]


class Scatter(_ScatterRequired, total=False):
    """By chance, evenly over a box.

    count: How many.
    min: A corner of the box. Unit: the scene's unit.
    max: The corner opposite, greater or less along each axis; the same y gives copies on the ground. Unit: the scene's unit.
    seed: Another number gives other places.
    spacing: Least distance between copies. A copy that finds no room in 32 tries is left out, which is a warning. Unit: the scene's unit.
    turn: Axis about which each copy is turned by an angle of its own; `None`: none is.
    scale: The least and the greatest factor of the copies' sizes.
    """

    seed: Either[int, str, PickItem]
    spacing: Any
    turn: Any
    scale: Either[Sequence[Either[float, str]], Array, str, PickItem]


class Plane(TypedDict, total=False):
    """A plane without an end, to the horizon: a floor, a wall, water. Seen against its normal, right is (0, 1, 0) x normal, or (1, 0, 0) where the normal is upright; texture coordinates grow to the right and upwards by 1 for each unit of the scene, from (0, 0) at `point`. It is open: it has no inside. What lies in it is seen where it is as opaque, or shines. It cannot be dropped, centred or fitted, as it has neither a lowest point nor a middle nor an extent.

    point: A point of it. Unit: the scene's unit.
    normal: Direction that it faces.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
    """

    point: Either[Sequence[Either[float, str]], Array, str, PickItem]
    normal: Either[Sequence[Either[float, str]], Array, str, PickItem]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


class Rectangle(TypedDict, total=False):
    """A flat rectangle. Seen against its normal, its sides run to the right and upwards: to the right is (0, 1, 0) x normal, or (1, 0, 0) where the normal is upright. Texture coordinates grow along the sides from 0 to 1. Where it shines it shines to the normal's side.

    center: Its middle. Unit: the scene's unit.
    normal: Direction that it faces.
    size: Lengths of its sides to the right and upwards, or one number for both. Unit: the scene's unit.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
    """

    center: Either[Sequence[Either[float, str]], Array, str, PickItem]
    normal: Either[Sequence[Either[float, str]], Array, str, PickItem]
    size: Either[float, str, Sequence[Either[float, str]], Array, PickItem]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


class Box(TypedDict, total=False):
    """A box with right angles, its sides along the axes before `transform`. Each face has texture coordinates from 0 to 1, as a `Rectangle` that faces outwards: on the four upright ones v grows along y, and u to the right as seen from outside; on top and bottom u grows along x, and v along -z on top and along z below.

    center: Its middle. Unit: the scene's unit.
    size: Lengths of its sides along x, y and z, or one number for all. Unit: the scene's unit.
    rounding: Radius of its edges and corners, at most half the shortest side; 0: they are sharp. A box with round edges is made of triangles, shaded as round; of a face's texture the rounded border shows what lies inwards of it. Unit: the scene's unit.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
    """

    center: Either[Sequence[Either[float, str]], Array, str, PickItem]
    size: Either[float, str, Sequence[Either[float, str]], Array, PickItem]
    rounding: Either[float, str, PickItem]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


class Disk(TypedDict, total=False):
    """A flat disk, or a ring. Seen against its normal, right is (0, 1, 0) x normal, or (1, 0, 0) where the normal is upright; texture coordinates grow to the right and upwards from 0 to 1 over the square around it. It is open: it has no inside.

    center: Its middle. Unit: the scene's unit.
    normal: Direction that it faces.
    radius: Radius. Unit: the scene's unit.
    inner_radius: Radius of the hole in its middle, less than `radius`; 0: there is none. Unit: the scene's unit.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
    """

    center: Either[Sequence[Either[float, str]], Array, str, PickItem]
    normal: Either[Sequence[Either[float, str]], Array, str, PickItem]
    radius: Either[float, str, PickItem]
    inner_radius: Either[float, str, PickItem]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


_CylinderRequired = TypedDict(
    "_CylinderRequired",
    {
    "radius": "Either[float, str, PickItem]",
    },
)
_CylinderFields = TypedDict("_CylinderFields", {
    "from": "Either[Sequence[Either[float, str]], Array, str, PickItem]",
    "to": "Either[Sequence[Either[float, str]], Array, str, PickItem]",
    "caps": "Either[bool, str, PickItem]",
    "material": "Either[str, Material, PickItem]",
    "transform": "Sequence[Either[Transform, RepeatItem, PickItem]]",
    "placements": "Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]",
    "camera_visible": "Either[bool, str, PickItem]",
    "name": "Any",
}, total=False)


class Cylinder(_CylinderRequired, _CylinderFields, total=False):
    """A round cylinder. With its caps it is closed; without them it is a tube of no thickness, which is seen from inside, too. Its front is its outside. Texture coordinates: u goes once round it from 0 to 1, counter-clockwise seen from beyond `to`, v from 0 at `from` to 1 at `to`; on the caps both grow from 0 to 1 as on a `Disk` that faces outwards.

    from: Middle of its first end. Unit: the scene's unit.
    to: Middle of its other end. Unit: the scene's unit.
    radius: Radius. Unit: the scene's unit.
    caps: Whether disks close its ends.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
    """


_ConeRequired = TypedDict(
    "_ConeRequired",
    {
    "radius": "Either[float, str, PickItem]",
    },
)
_ConeFields = TypedDict("_ConeFields", {
    "from": "Either[Sequence[Either[float, str]], Array, str, PickItem]",
    "to": "Either[Sequence[Either[float, str]], Array, str, PickItem]",
    "tip_radius": "Either[float, str, PickItem]",
    "caps": "Either[bool, str, PickItem]",
    "material": "Either[str, Material, PickItem]",
    "transform": "Sequence[Either[Transform, RepeatItem, PickItem]]",
    "placements": "Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]",
    "camera_visible": "Either[bool, str, PickItem]",
    "name": "Any",
}, total=False)


class Cone(_ConeRequired, _ConeFields, total=False):
    """A round cone, or a part of one: a lampshade, a bucket. With its caps it is closed; without them it has no thickness and is seen from inside, too. Texture coordinates are those of a `Cylinder`.

    from: Middle of the end of radius `radius`. Unit: the scene's unit.
    to: The tip, or the middle of the end of radius `tip_radius`. Unit: the scene's unit.
    radius: Radius at `from`. Unit: the scene's unit.
    tip_radius: Radius at `to`; 0: a tip. Unit: the scene's unit.
    caps: Whether disks close its ends.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
    """


_CapsuleRequired = TypedDict(
    "_CapsuleRequired",
    {
    "radius": "Either[float, str, PickItem]",
    },
)
_CapsuleFields = TypedDict("_CapsuleFields", {
    "from": "Either[Sequence[Either[float, str]], Array, str, PickItem]",
    "to": "Either[Sequence[Either[float, str]], Array, str, PickItem]",
    "material": "Either[str, Material, PickItem]",
    "transform": "Sequence[Either[Transform, RepeatItem, PickItem]]",
    "placements": "Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]",
    "camera_visible": "Either[bool, str, PickItem]",
    "name": "Any",
}, total=False)


class Capsule(_CapsuleRequired, _CapsuleFields, total=False):
    """A cylinder with half spheres on its ends: all points at most `radius` away from the way between two points. Texture coordinates: u goes round it, v along its outline from 0 below `from` to 1 beyond `to`, by the length of the way.

    from: Middle of its first half sphere. Unit: the scene's unit.
    to: Middle of the other one. Unit: the scene's unit.
    radius: Radius. Unit: the scene's unit.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
    """


class _LatheRequired(TypedDict):
    profile: Either[Sequence[Either[Sequence[Either[float, str]], Array, str, RepeatItem, PickItem]], Array, str]


class Lathe(_LatheRequired, total=False):
    """What a profile passes over as it turns about the y axis: a vase, a glass, a chess piece. Where both ends of the profile lie on the axis, or its last point is its first, it is closed and faces outwards, either way round. Else it is open: it has no thickness, and its front is on the right of its profile, drawn with the axis on the left: outwards where the profile goes up. An open `Emissive` one shines to its front, and open glass has no inside. It is made of triangles. Texture coordinates: u goes round from 0 to 1 as a sphere's, beginning at -z and at 1/4 at -x, v grows from 0 at the first point to 1 at the last, by length along the profile.

    profile: Two or more points (distance from the axis, height). A point that repeats the last one is left out. Unit: the scene's unit.
    curve: How the points are joined. A `CatmullRom` curve swings out where a long way between points meets a short one: between two points of a thin stem it comes nearer to the axis than they are, and one that would cross the axis goes along it. Points at even distances prevent that.
    segments: How many flat pieces go round; curves of the profile are as fine.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last. Turns and scales without `about` are about the middle of its bounds.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.segments=64` finds it where no other has this name.
    """

    curve: Either[Curve, PickItem]
    segments: Either[int, str, PickItem]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


Curve = Literal["Linear", "CatmullRom"]

class _ExtrudeRequired(TypedDict):
    outline: Either[Sequence[Either[Sequence[Either[Sequence[Either[float, str]], Array, str, RepeatItem, PickItem]], Array, str, RepeatItem, PickItem]], Array, str]
    depth: Either[float, str, PickItem]


class Extrude(_ExtrudeRequired, total=False):
    """An outline that is pushed along z: a letter, a star, a moulding, a plate with holes. It is closed, faces outwards, and is made of triangles. Texture coordinates of the ends go from 0 to 1 over the square around the outline, which has its middle, as on a `Rectangle` that faces outwards: of the end at `depth`, seen from +z, u grows along x and v along y; of that at 0, seen from -z, u grows along -x. On the sides u goes from 0 to 1 once round each ring, counter-clockwise round the outer one and clockwise round holes, from the ring's first point, and v from 0 at z = 0 to 1 at `depth`.

    outline: Rings of three or more points (x, y): the outer one first, then those of holes. Either way round; none meets itself or another. A point that repeats the last one, or at the end the first, is left out. Unit: the scene's unit.
    depth: How far it is pushed: from z = 0 to this. Unit: the scene's unit.
    curve: How the points of each ring are joined.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last. Turns and scales without `about` are about the middle of its bounds.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.depth=2` finds it where no other has this name.
    """

    curve: Either[Curve, PickItem]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


class _TubeRequired(TypedDict):
    points: Either[Sequence[Either[Sequence[Either[float, str]], Array, str, RepeatItem, PickItem]], Array, str]
    radius: Either[float, str, Sequence[Either[float, str, RepeatItem, PickItem]], Array, PickItem]


class Tube(_TubeRequired, total=False):
    """What a ball passes over as it goes along a path: a cable, a spring, a tree's branch, a knot. It is closed: its ends are round, and so are its elbows where the points are joined by straight lines; a ball that swallows others is round, too. It is made of triangles, shaded as round. Where the path bends tighter than the radius, an elbow has less room than its inner side takes, or the path turns straight back, it passes through itself, which shows in glass and in the `power` of a light only. Texture coordinates: u goes round, v from 0 to 1 by length along it, round ends and the outer side of elbows included.

    points: Two or more points that the middle of the ball passes, three or more of a closed one; with `curve: Bezier` each but the last is followed by two handles. Of points that repeat the last one, or at the end of a closed one the first, one is left, with the largest radius. Unit: the scene's unit.
    radius: The ball's radius, or one for each point that is passed (handles have none); between them it changes evenly, smoothly where the curve is not `Linear`. Unit: the scene's unit.
    curve: How the points are joined.
    closed: Whether the path goes on from the last point to the first. That of a closed one with `curve: Bezier` is written to its end: the last point is the first once more.
    segments: How many flat pieces go round; curves of the path are as fine.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last. Turns and scales without `about` are about the middle of its bounds.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.segments=64` finds it where no other has this name.
    """

    curve: Either[TubeCurve, PickItem]
    closed: Either[bool, str, PickItem]
    segments: Either[int, str, PickItem]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


TubeCurve = Literal["CatmullRom", "Linear", "Bezier"]

class _TorusRequired(TypedDict):
    radius: Either[float, str, PickItem]
    tube_radius: Either[float, str, PickItem]


class Torus(_TorusRequired, total=False):
    """A ring with a round section, closed. Texture coordinates: u goes round its axis as a sphere's, v round its section, 1/2 on the outside, where it grows along the axis.

    center: Its middle. Unit: the scene's unit.
    axis: Direction that it goes round.
    radius: From its middle to the middle of the section. Unit: the scene's unit.
    tube_radius: Radius of the section, at most `radius`. Unit: the scene's unit.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last. Turns and scales without `about` are about its middle.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
    """

    center: Either[Sequence[Either[float, str]], Array, str, PickItem]
    axis: Either[Sequence[Either[float, str]], Array, str, PickItem]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


_ArrowRequired = TypedDict(
    "_ArrowRequired",
    {
    "radius": "Either[float, str, PickItem]",
    },
)
_ArrowFields = TypedDict("_ArrowFields", {
    "from": "Either[Sequence[Either[float, str]], Array, str, PickItem]",
    "to": "Either[Sequence[Either[float, str]], Array, str, PickItem]",
    "head_radius": "Any",
    "head_length": "Any",
    "segments": "Either[int, str, PickItem]",
    "material": "Either[str, Material, PickItem]",
    "transform": "Sequence[Either[Transform, RepeatItem, PickItem]]",
    "placements": "Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]",
    "camera_visible": "Either[bool, str, PickItem]",
    "name": "Any",
}, total=False)


class Arrow(_ArrowRequired, _ArrowFields, total=False):
    """A round shaft with a cone at its tip: an axis, a direction, a force. It is closed, and made of triangles. Texture coordinates: u goes round it as round a cylinder, v from 0 to 1 by length along its outline.

    from: Middle of its flat end. Unit: the scene's unit.
    to: Its tip. Unit: the scene's unit.
    radius: Radius of the shaft. Unit: the scene's unit.
    head_radius: Radius of the head; without it 2.5 times that of the shaft. Unit: the scene's unit.
    head_length: Length of the head; without it 6 radii of the shaft, or half of the arrow where that is less. As long as the arrow: it is a cone. Unit: the scene's unit.
    segments: How many flat pieces go round.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last. Turns and scales without `about` are about the middle between its ends.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
    """


class _HeightFieldRequired(TypedDict):
    file: File
    size: Either[Sequence[Either[float, str]], Array, str, PickItem]


class HeightField(_HeightFieldRequired, total=False):
    """A landscape: a picture whose pixels are heights. Each pixel is a point, so a picture has two pixels or more along each side; between four of them are two triangles. Seen from above with -z up it looks as the picture does: its top row lies at -z, its first column at -x. Texture coordinates: u from 0 to 1 along x, v from 0 to 1 along -z, so that the same picture as a texture lies on its heights.

    file: PNG, JPEG, EXR or HDR file, relative to the scene file, of at most 8192 x 8192 pixels. Grey of 16 bits has the finest steps. Heights are its numbers as they stand, without a curve: 0.5 or 128 is half. Of colours their luminance is taken. EXR and HDR may go below 0 and above 1.
    size: How far it reaches along x, how high white is over black, and how far it reaches along z. Unit: the scene's unit.
    center: Its middle along x and z; black is as high as this. Unit: the scene's unit.
    smooth: Whether it is shaded as round, but at creases of more than 40 degrees; else every triangle is flat.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last. Turns and scales without `about` are about its `center`.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.smooth=false` finds it where no other has this name.
    """

    center: Either[Sequence[Either[float, str]], Array, str, PickItem]
    smooth: Either[bool, str, PickItem]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


class _PolygonRequired(TypedDict):
    points: Either[Sequence[Either[Sequence[Either[float, str]], Array, str, RepeatItem, PickItem]], Array, str]


class Polygon(_PolygonRequired, total=False):
    """A flat face with any number of corners: a roof, a window that is no rectangle. Its front is the side from which they go round counter-clockwise; an `Emissive` one shines to that side, and the back is seen as the front is. Seen from the front, u grows to the right and v upwards, as on a `Rectangle` that faces the same way: right is (0, 1, 0) x normal, or (1, 0, 0) where the normal is upright. The square around it that has the same middle has coordinates from 0 to 1. It is open: it has no inside.

    points: Three or more corners, in one plane (to a ten-thousandth of its size). Its sides do not meet but at the corners. A corner that repeats the last one, or at the end the first, is left out. Unit: the scene's unit.
    material: Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last. Turns and scales without `about` are about the middle of its bounds.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.transform=[]` finds it where no other has this name.
    """

    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


class Mesh(TypedDict, total=False):
    """A triangle mesh, from a file or written out as `points` and `faces`.

    file: OBJ, OFF, PLY, STL, glTF or GLB file, relative to the scene file. Of glTF the triangles of the default scene are taken, where its nodes place them, with its materials and pictures, and the colours of its vertices where a `VertexColor` reads them; its lights, cameras, skins, morph targets and animations are not.
    part: With `file`: only this part of it, as if the file held nothing else. In OBJ the faces of objects (`o`) and groups (`g`) of this name, in glTF nodes, with all that is below them, and meshes of this name; all of them where several have it. It stays where the file has it. Other formats have no parts.
    points: Instead of a file: the points of the mesh, three or more. Unit: the scene's unit.
    faces: With `points`: the faces, each the numbers of three or more points, counted from 0, counterclockwise seen from outside. Faces of more than three corners are cut into triangles, also where they are not convex.
    colors: With `points`: a colour for each of them, which a `VertexColor` of the material shows. Numbers are linear, or sRGB, as matplotlib gives them, with `VertexColor(color_space: Srgb)`.
    material: Its material, by name or written here; without one those of the file (the MTL of OBJ, glTF's own), else `Diffuse(albedo: 0.8)`.
    transform: Transforms, applied first to last.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    instances: Whether copies share one tree of triangles, those of other objects with the same file and shading among them.
    shading: Whether normals are interpolated.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
    """

    file: File
    part: Any
    points: Either[Sequence[Either[Sequence[Either[float, str]], Array, str, RepeatItem, PickItem]], Array, str]
    faces: Either[Sequence[Either[Sequence[Either[int, str, RepeatItem, PickItem]], Array, str, RepeatItem, PickItem]], Array, str]
    colors: Either[Sequence[Either[float, Sequence[Either[float, str]], Array, str, RepeatItem, PickItem]], Array, str]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    instances: Either[Instances, PickItem]
    shading: Either[Shading, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


Instances = Literal["Auto", "Always", "Never"]

Shading = Literal["Auto", "Smooth", "Flat"]

class _UnionRequired(TypedDict):
    objects: Sequence[Either[Object, RepeatItem, PickItem]]


class Union(_UnionRequired, total=False):
    """Closed shapes put together to one body: there are no walls inside it, also where they touch. Every surface has the material of the shape that it is of, and its texture coordinates. It may shine, whole or in parts, by `radiance` or `luminance`; light samples find it, photons and light paths do not start on it.

    objects: The shapes, at least one: `Sphere`, `Box`, `Cylinder` and `Cone` with caps, `Capsule`, `Torus`, `Union`, `Intersection`, `Difference`, with their transforms and without placements; 64 at most, those within each other counted. Where surfaces coincide that of the first shows. Solids that have an end may have a `Plane`, too, which is all of space behind it, as seen from where its normal points.
    material: The material of those shapes in it that have none of their own.
    transform: Transforms of all of it, applied first to last, after those of the shapes in it. Turns and scales without `about` are about the origin. `DropTo`, `CenterTo` and `FitTo` go by the boxes of the shapes.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.transform=[]` finds it where no other has this name. Masks know the whole, by this name.
    """

    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


class _IntersectionRequired(TypedDict):
    objects: Sequence[Either[Object, RepeatItem, PickItem]]


class Intersection(_IntersectionRequired, total=False):
    """What closed shapes have in common: of two balls a lens. Every surface has the material of the shape that it is of, and its texture coordinates. It may shine as a `Union` may.

    objects: The shapes, as those of a `Union`. Where surfaces coincide that of the first shows.
    material: The material of those shapes in it that have none of their own.
    transform: Transforms of all of it, applied first to last, after those of the shapes in it. Turns and scales without `about` are about the origin. `DropTo`, `CenterTo` and `FitTo` go by what the boxes of the shapes have in common.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.transform=[]` finds it where no other has this name. Masks know the whole, by this name.
    """

    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


class _DifferenceRequired(TypedDict):
    objects: Sequence[Either[Object, RepeatItem, PickItem]]


class Difference(_DifferenceRequired, total=False):
    """The first of several closed shapes without the others: a wall with a window, a bowl. Where it is cut the surface is that of the shape that cuts, with its material, where it has one, and its texture coordinates. It may shine as a `Union` may.

    objects: The shapes, as those of a `Union`: first what is cut, then what is taken away. Where both have a face in one place, and what is taken away lies behind it, it is gone: no skin is left.
    material: The material of those shapes in it that have none of their own.
    transform: Transforms of all of it, applied first to last, after those of the shapes in it. Turns and scales without `about` are about the origin. `DropTo`, `CenterTo` and `FitTo` go by the box of the first shape.
    placements: Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.transform=[]` finds it where no other has this name. Masks know the whole, by this name.
    """

    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


class Group(TypedDict, total=False):
    """Objects and lights that are moved and copied as one. What stands in it may be a group again, sixteen deep.

    objects: What is in it.
    material: The material of those objects in it that have none of their own.
    transform: Transforms of all of it, applied first to last, after those of the objects in it. Turns and scales without `about` are about the origin; `DropTo`, `CenterTo` and `FitTo` go by all that stands in it.
    placements: Copies of all of it: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    lights: Lights that move with it. Each copy has one, as bright as it is written.
    camera_visible: Whether the camera sees what is in it. If not, camera rays pass as if nothing were there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.placements=[]` finds it where no other has this name.
    """

    objects: Sequence[Either[Object, RepeatItem, PickItem]]
    material: Either[str, Material, PickItem]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    lights: Sequence[Either[Light, RepeatItem, PickItem]]
    camera_visible: Either[bool, str, PickItem]
    name: Any


class _IncludeRequired(TypedDict):
    file: File


class Include(_IncludeRequired, total=False):
    """The objects and lights of another scene, moved and copied as one. Its names are its own: materials, textures and `vars` of this scene are not seen there, nor its own here. Its camera, picture, background and how it is rendered are not taken.

    file: The scene file, in any syntax. Paths in it start from its own folder.
    vars: Other values for its `vars`.
    materials: Other materials for names of its `materials`: names of this scene, or written here.
    transform: Transforms of all of it, applied first to last. Turns and scales without `about` are about the origin; `DropTo`, `CenterTo` and `FitTo` go by all that stands in it.
    placements: Copies of all of it: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
    camera_visible: Whether the camera sees what is in it. If not, camera rays pass as if nothing were there; it still throws shadows, shines, and is seen in mirrors and through glass.
    name: What it is called: `--set objects.NAME.placements=[]` finds it where no other has this name.
    """

    vars: Dict[str, Any]
    materials: Dict[str, Either[str, Material]]
    transform: Sequence[Either[Transform, RepeatItem, PickItem]]
    placements: Either[Sequence[Either[Sequence[Either[Transform, RepeatItem, PickItem]], RepeatItem, PickItem]], str, PlacementPattern, PickItem]
    camera_visible: Either[bool, str, PickItem]
    name: Any


_SceneDictRequired = TypedDict(
    "_SceneDictRequired",
    {
    "objects": "Sequence[Either[Object, RepeatItem, PickItem]]",
    },
)
_SceneDictFields = TypedDict("_SceneDictFields", {
    "version": "Either[int, str, PickItem]",
    "include": "Sequence[Either[str, RepeatItem, PickItem]]",
    "vars": "Dict[str, Any]",
    "animation": "Animation",
    "cameras": "Dict[str, Camera]",
    "camera": "Either[str, Camera, PickItem]",
    "image": "Image",
    "render": "Render",
    "effects": "Effects",
    "output": "Output",
    "background": "Either[float, Sequence[Either[float, str]], Array, str, Background, PickItem]",
    "lights": "Sequence[Either[Light, RepeatItem, PickItem]]",
    "textures": "Dict[str, Either[float, Sequence[Either[float, str]], Array, str, Pattern]]",
    "materials": "Dict[str, Material]",
    "$schema": "str",
}, total=False)


class SceneDict(_SceneDictRequired, _SceneDictFields, total=False):
    """A whole scene: one file.

    version: Version of the language. Files of version 1 load for ever.
    include: Files whose `vars`, `textures`, `materials`, `cameras`, `image`, `render`, `effects`, `output` and `background` are taken as if they stood here, but that what this file says wins, name by name and field by field, and of two files what the later says. Paths in a file start from its folder.
    vars: Values by name, for expressions: texts that begin with `=`, which may stand for any number, vector, colour or truth value.
    animation: Frames and time, for expressions.
    cameras: Cameras by name.
    camera: The camera, or the name of one of `cameras`, as `--camera` chooses it. It may be left out where there is one among `cameras`, or none; those of files that are included count where the scene has none of its own.
    image: The picture's size.
    render: How to render.
    effects: Film and lens effects.
    output: What is written beside the picture.
    background: Radiance of everything that no object covers. Unit: W/(sr m^2).
    lights: Lights. A scene needs one, or a background.
    textures: Textures by name, for colours of materials and of other textures: `albedo: "bricks"`. A text that begins with `#` is a colour there, and one that begins with `=` an expression; any other is a name.
    materials: Materials by name, for objects to use.
    objects: What is to be seen; at least one.
    $schema: Where this schema is, for the editor.
    """


