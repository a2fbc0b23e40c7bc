"""Mistakes: what is raised, where it points, what it says."""

import pickle

import pytest
import tracer

SPHERE = {"Sphere": {"center": [0, 0, 0], "radius": 1}}


def fault(scene, **settings):
    with pytest.raises(tracer.SceneError) as told:
        tracer.render(scene, **settings)
    return told.value


@pytest.mark.parametrize(
    "scene, code, path, words",
    [
        ({"background": 1, "objects": [{"Sphere": {"center": [0, 0, 0], "radius": -1}}]}, "E0301", "objects[0].radius", "must be positive"),
        ({"background": 1, "objects": [{"Sphere": {"center": [0, 0], "radius": 1}}]}, None, "objects[0].center", "three"),
        ({"background": 1, "objects": [{"Spher": {"center": [0, 0, 0], "radius": 1}}]}, None, None, "Sphere"),
        ({"background": 1, "objets": [SPHERE], "objects": [SPHERE]}, "E0201", None, "objects"),
        ({"background": 1, "objects": [{"Sphere": {"center": [0, 0, 0]}}]}, None, None, "radius"),
        ({"background": 1, "objects": []}, None, "objects", None),
        ({"background": 1, "objects": [{"Sphere": {"center": [0, 0, float("nan")], "radius": 1}}]}, None, None, "NaN"),
        ({"background": 1, "objects": [{"Sphere": {**SPHERE["Sphere"], "material": "glas"}}], "materials": {"glass": {"Mirror": {}}}}, "E0401", None, "glass"),
        ({"background": 1, "objects": [{"Mesh": {"file": "none.obj"}}]}, "E0501", None, "none.obj"),
        ({"background": 1, "objects": [SPHERE], "camera": {"fov": True}}, None, "camera.fov", None),
    ],
)
def test_ten_mistakes(scene, code, path, words):
    error = fault(scene)
    assert len([d for d in error.diagnostics if d.severity == "error"]) == 1, str(error)
    assert error.file == "<scene>" and error.line >= 1 and error.column >= 1
    assert code in (None, error.code) and path in (None, error.path)
    assert words is None or words in str(error)
    assert f"<scene>:{error.line}:{error.column}" in str(error) and error.code in str(error)


def test_all_that_is_wrong_is_told_at_once():
    error = fault(
        {
            "background": -1,
            "materials": {"never": {"Mirror": {}}},
            "objects": [{"Sphere": {"center": [0, 0, 0], "radius": 0}}, {"Mesh": {"file": "none.obj"}}],
        }
    )
    errors = [d.code for d in error.diagnostics if d.severity == "error"]
    assert errors == ["E0302", "E0301", "E0501"] and error.code == "E0302" and len(error.diagnostics) > len(errors)
    again = pickle.loads(pickle.dumps(error))
    assert again.diagnostics == error.diagnostics and str(again) == str(error)


def test_places_are_those_of_files(tmp_path):
    path = tmp_path / "a.ron"
    path.write_text("Scene(\n  background: 1,\n  objects: [Sphere(center: (0, 0, 0), radus: 1)],\n)\n")
    error = fault(path)
    assert (error.file, error.line, error.column, error.code) == (str(path), 3, 39, "E0201")
    place, replacement = error.diagnostics[0].edit
    assert (place.line, place.column, place.end_column, replacement) == (3, 39, 44, "radius")
    with pytest.raises(FileNotFoundError, match="did you mean .*a.ron"):
        tracer.render(tmp_path / "b.ron")
    with pytest.raises(OSError, match="folder"):
        tracer.render(tmp_path)


def test_an_asset_of_nearly_the_name_is_told():
    scene = {"background": 1, "objects": [{"Mesh": {"file": "wood.obj"}}]}
    assert "`assets` has 'wod.obj', and the scene names 'wood.obj'" in str(fault(scene, assets={"wod.obj": b""}))


def test_settings_that_cannot_be():
    scene = {"background": 1, "objects": [SPHERE]}
    for settings, kind, words in [
        ({"sample": 3}, TypeError, "did you mean samples"),
        ({"width": 64}, TypeError, r"did you mean size=\(width, height\)"),
        ({"samples": 0}, ValueError, "samples is 0"),
        ({"samples": 2.5}, TypeError, "whole number"),
        ({"size": 64}, TypeError, "size is"),
        ({"size": (0, 5)}, tracer.SceneError, "image.width|width"),
        ({"size": (64, 10**6)}, tracer.SceneError, "height"),
        ({"layers": "depth"}, TypeError, r"layers=\['depth'\]"),
        ({"layers": ["dept"]}, ValueError, "did you mean \"depth\""),
        ({"crop": (0, 0, 9999, 1)}, ValueError, "does not lie in the picture"),
        ({"noise": "1%"}, TypeError, "noise is a number"),
        ({"noise": -1}, tracer.SceneError, "noise"),
        ({"set": {"camera.fow": 3}}, tracer.SceneError, "fov"),
        ({"syntax": "yaml"}, None, None),
        ({"base_dir": "/none", "assets": {"a": 1}}, TypeError, "asset 'a'"),
    ]:
        if kind is not None:
            with pytest.raises(kind, match=words):
                tracer.render(scene, **settings)
    with pytest.raises(ValueError, match="yaml"):
        tracer.render("background: 1\n", syntax="yaml")
    for wrong, words in [(None, "NoneType"), (b"Scene()", "bytes"), ({"objects": [{1: 2}]}, "key 1"), ({"objects": [object()]}, r"objects\[0\]")]:
        with pytest.raises(TypeError, match=words):
            tracer.render(wrong)
    loop = {}
    loop["objects"] = [loop]
    with pytest.raises(ValueError, match="holds itself"):
        tracer.render(loop)


def test_what_is_doubtful_is_a_warning_that_names_the_callers_line():
    dark = {"objects": [SPHERE], "lights": [{"SphereLight": {"center": [0, 0, 0], "radius": 0.1, "power": 1}}], "image": {"width": 4, "height": 4}}
    with pytest.warns(tracer.SceneWarning) as told:
        scene = tracer.Scene(dark)
    assert told[0].filename == __file__ and scene.warnings and scene.warnings[0].severity == "warning"
    assert scene.warnings[0].code in str(told[0].message)


def test_settings_are_told_where_they_belong():
    scene = {"background": 1, "objects": [SPHERE]}
    for call, words in [
        (lambda: tracer.Scene(scene, kamera="top"), r"Scene\(\) has no setting 'kamera'; did you mean camera\?"),
        (lambda: tracer.Scene(scene, samples=3), r"it belongs to Scene\(..\).render\(samples=..\)"),
        (lambda: tracer.Scene(scene).render(frame=1), r"it belongs to Scene\(.., frame=..\)"),
        (lambda: tracer.Scene(scene).render(sampels=1), "did you mean samples"),
        (lambda: tracer.render(scene, fram=1), "did you mean frame"),
        (lambda: tracer.render(scene, camera=3), "camera is the name of one"),
        (lambda: tracer.render(scene, frame="1"), "frame is a whole number"),
    ]:
        with pytest.raises(TypeError, match=words):
            call()
    assert "there is no frame 3" in str(fault(scene, frame=3))
    assert 'there is no camera "top"' in str(fault(scene, camera="top"))
