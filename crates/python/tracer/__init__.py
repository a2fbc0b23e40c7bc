"""tracer, a path tracer for scenes written by hand.

A scene is a dictionary, the text of one, or a path; what comes back is a numpy array of linear light:

>>> import tracer
>>> scene = {
...     "camera": {"position": [0, 0, 5]},
...     "background": [0.5, 0.6, 0.8],
...     "objects": [{"Sphere": {"center": [0, 0, 0], "radius": 1, "material": {"Diffuse": {"albedo": "#e8590c"}}}}],
... }
>>> picture = tracer.render(scene, size=(32, 24), samples=4)
>>> picture.shape, picture.dtype
((24, 32, 3), dtype('float32'))

What a scene may say is in docs/scene-reference.md of the project, for editors and type checkers in `tracer.words`.
"""

from ._assets import Mesh
from ._errors import Diagnostic, Place, SceneError, SceneWarning
from ._native import layers as _layers
from ._native import version as __version__
from ._scene import Picture, Scene, render

LAYERS = tuple(_layers)
"""The names of layers, for `layers` of `render`."""

__all__ = [
    "LAYERS",
    "Diagnostic",
    "Mesh",
    "Picture",
    "Place",
    "Scene",
    "SceneError",
    "SceneWarning",
    "__version__",
    "render",
]
