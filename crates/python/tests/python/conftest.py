"""What all tests share."""

import pytest


@pytest.fixture
def ball():
    """A ball in front of a grey sky, small."""
    return {
        "image": {"width": 24, "height": 16},
        "render": {"samples": 4},
        "background": 0.5,
        "objects": [{"Sphere": {"center": [0, 0, 0], "radius": 1}}],
    }
