"""Meshes and pictures from memory."""

import warnings

import numpy as np
import pytest
import tracer

POINTS = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
FACES = np.array([[0, 1, 2], [0, 2, 3]])
UVS = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
SETTINGS = {"size": (16, 16), "samples": 2}


def scene(mesh):
    return {"background": 1, "objects": [{"Mesh": mesh}]}


def test_arrays_lists_files_and_assets_are_one_mesh(tmp_path):
    off = "OFF\n4 2 0\n" + "".join("%g %g %g\n" % tuple(point) for point in POINTS) + "3 0 1 2\n3 0 2 3\n"
    (tmp_path / "a.off").write_text(off)
    expected = tracer.render(scene({"points": POINTS.tolist(), "faces": FACES.tolist()}), **SETTINGS)
    mesh = tracer.Mesh(POINTS, FACES)
    for other in [{"points": POINTS, "faces": FACES}, {"file": mesh}, {"file": {"points": POINTS, "faces": FACES}}]:
        assert np.array_equal(tracer.render(scene(other), **SETTINGS), expected)
    named = scene({"file": "a.off"})
    assert np.array_equal(tracer.render(named, base_dir=tmp_path, **SETTINGS), expected)
    for asset in [mesh, off.encode(), {"points": POINTS, "faces": FACES}]:
        assert np.array_equal(tracer.render(named, assets={"a.off": asset}, **SETTINGS), expected)


def test_materials_of_a_mesh_in_memory_are_found_there():
    obj = b"mtllib a.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"
    assets = {"m/a.obj": obj, "m/a.mtl": b"newmtl red\nKd 0.8 0 0\n"}
    picture = tracer.render(scene({"file": "m/a.obj"}), assets=assets, **SETTINGS)
    red, green, _ = picture[8, 8]
    assert red > 0.5 and green == 0


@pytest.mark.parametrize("kind", [np.uint8, np.uint16, np.float32, np.float64])
@pytest.mark.parametrize("shape", [(), (3,)])
def test_pictures_of_all_kinds_are_textures(kind, shape):
    white = 1 if np.dtype(kind).kind == "f" else np.iinfo(kind).max
    grey = np.full((2, 2, *shape), white, kind)
    grey[0] = 0
    mesh = {"file": tracer.Mesh(POINTS, FACES, uvs=UVS), "material": {"Diffuse": {"albedo": {"Texture": {
        "file": grey, "filter": "Nearest"}}}}}
    picture, layers = tracer.render(scene(mesh), layers=["albedo"], size=(16, 16), samples=1)
    assert layers["albedo"][6, 8].tolist() == [0, 0, 0] and layers["albedo"][10, 8].tolist() == [1, 1, 1]


def test_backgrounds_and_heights_are_arrays_too():
    sky = np.ones((4, 8, 3), np.float32) * [1, 2, 3]
    lit = {"background": {"Environment": {"file": sky}}, "objects": [{"Sphere": {"center": [0, 0, 0], "radius": 0.1}}]}
    assert np.allclose(tracer.render(lit, size=(8, 8), samples=1)[0, 0], [1, 2, 3])
    y, x = np.mgrid[0:9, 0:9]
    hill = np.exp(-((x - 4) ** 2 + (y - 4) ** 2) / 8)
    land = {"background": 1, "camera": {"position": [0, 4, 4]}, "objects": [{"HeightField": {
        "file": hill, "center": [0, 0, 0], "size": [2, 1, 2]}}]}
    assert tracer.render(land, **SETTINGS).shape == (16, 16, 3)


def test_normals_make_faces_round():
    flat = tracer.render(scene({"file": tracer.Mesh(POINTS, FACES)}), layers=["normal"], **SETTINGS)[1]["normal"]
    leaning = POINTS * 0.5 + [0, 0, 1]
    bent = tracer.render(scene({"file": tracer.Mesh(POINTS, FACES, normals=leaning)}), layers=["normal"], **SETTINGS)
    assert not np.allclose(flat[8, 4], bent[1]["normal"][8, 4])


def test_colours_of_points_are_shown():
    shown = {"Diffuse": {"albedo": {"VertexColor": {}}}}
    for colors, expected in [
        (np.full((4, 3), 128, np.uint8), 0.2158605),
        (np.full((4, 4), 0.5, np.float32), 0.5),
        (np.full((4, 3), 0.25), 0.25),
    ]:
        for mesh in [{"file": tracer.Mesh(POINTS, FACES, colors=colors)}, {"points": POINTS, "faces": FACES, "colors": colors}]:
            _, layers = tracer.render(scene({**mesh, "material": shown}), layers=["albedo"], size=(8, 8), samples=1)
            assert np.allclose(layers["albedo"][4, 4], expected, atol=1e-6)
    with pytest.raises(ValueError, match=r"colors\[1\] is \[0.0, 2.0, 0.0\]"):
        tracer.Mesh(POINTS, FACES, colors=np.array([[0, 0, 0], [0, 2, 0], [0, 0, 0], [0, 0, 0]], float))
    with pytest.raises(TypeError, match="uint8"):
        tracer.Mesh(POINTS, FACES, colors=np.zeros((4, 3), int))
    with pytest.raises(ValueError, match="n x 3 or n x 4"):
        tracer.Mesh(POINTS, FACES, colors=np.zeros((4, 2)))
    with pytest.raises(tracer.SceneError, match="there are 3 colors"):
        tracer.render(scene({"file": tracer.Mesh(POINTS, FACES, colors=np.zeros((3, 3))), "material": shown}), **SETTINGS)


def test_what_is_wrong_with_arrays_is_told():
    with pytest.raises(tracer.SceneError) as told:
        tracer.render(scene({"points": POINTS, "faces": np.array([[0, 1, 9]])}))
    assert told.value.code == "E0510" and "faces[0]: there is no vertex 9" in told.value.message
    assert told.value.line and "array-1" in str(told.value)
    with pytest.raises(ValueError, match=r"points is an array of n x 3 numbers, not of shape \(4, 2\)"):
        tracer.Mesh(POINTS[:, :2], FACES)
    with pytest.raises(TypeError, match="whole numbers, not of float64"):
        tracer.Mesh(POINTS, FACES.astype(float))
    with pytest.raises(ValueError, match="count from 0"):
        tracer.Mesh(POINTS, FACES - 1)
    texture = {"Diffuse": {"albedo": {"Texture": {"file": np.full((2, 2), 7.0)}}}}
    with pytest.raises(tracer.SceneError, match="outside of 0 to 1"):
        tracer.render({"background": 1, "objects": [{"Sphere": {"center": [0, 0, 0], "radius": 1, "material": texture}}]})
    with pytest.raises(TypeError, match="asset 'a.png' is of type int"):
        tracer.render(scene({"file": "a.off"}), assets={"a.png": 3})
    with pytest.raises(ValueError, match=r"not of shape \(2, 2, 5\)"):
        tracer.render(scene({"file": "a.off"}), assets={"a.png": np.zeros((2, 2, 5), np.uint8)})
    with pytest.warns(tracer.SceneWarning, match="does not name the assets 'b.off'"):
        tracer.render(scene({"file": "a.off"}), assets={"a.off": tracer.Mesh(POINTS, FACES), "b.off": b""}, **SETTINGS)


def test_trimesh_and_images_are_taken_as_they_are():
    class Trimesh:
        vertices, faces = POINTS, FACES

    class Image:
        def __array__(self, dtype=None, copy=None):
            return np.full((2, 2, 3), 255, np.uint8)

    mesh = {"file": Trimesh(), "material": {"Diffuse": {"albedo": {"Texture": {"file": Image()}}}}}
    with warnings.catch_warnings():
        # It has no texture coordinates, which is told.
        warnings.simplefilter("ignore", tracer.SceneWarning)
        assert tracer.render(scene(mesh), **SETTINGS).shape == (16, 16, 3)
