"""Pictures: what they are, and how they come to be."""

import json
import multiprocessing
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import tracer

RON = "Scene(image: Image(width: 24, height: 16), render: Render(samples: 4), background: 0.5, objects: [Sphere(center: (0, 0, 0), radius: 1)])"


def of_program(scene, *arguments):
    """What the program of the wheel makes of it."""
    command = ["tracer", "render", "-", "-o", "-", "--format", "pfm", "--quiet", *arguments]
    done = subprocess.run(command, input=json.dumps(scene).encode(), stdout=subprocess.PIPE, check=True)
    _, size, _, data = done.stdout.split(b"\n", 3)
    width, height = map(int, size.split())
    return np.frombuffer(data, "<f4").reshape(height, width, 3)[::-1]


def test_a_dictionary_a_text_and_a_path_are_one_scene_and_the_programs(ball, tmp_path):
    path = tmp_path / "ball.ron"
    path.write_text(RON)
    expected = tracer.render(ball)
    assert expected.shape == (16, 24, 3) and expected.dtype == np.float32 and expected.flags.writeable
    assert expected.min() >= 0 and 0.3 < expected.mean() < 0.6
    for scene in [RON, path, str(path), json.dumps(ball), tracer.Scene(ball)]:
        assert np.array_equal(tracer.render(scene), expected)
    assert np.array_equal(of_program(ball), expected)


def test_settings_are_those_of_the_program(ball):
    expected = of_program(ball, "--size", "12x10", "--samples", "3", "--seed", "7", "--exposure", "1")
    assert np.array_equal(tracer.render(ball, size=(12, 10), samples=3, seed=7, exposure=1), expected)
    whole = tracer.render(ball)
    assert np.array_equal(tracer.render(ball, crop=(3, 2, 10, 9)), whole[2:11, 3:13])
    assert np.array_equal(tracer.render(ball, threads=1), whole)
    assert not np.array_equal(tracer.render(ball, set={"camera.fov": 60}), whole)
    assert np.array_equal(tracer.render(ball, set={"objects[0].radius": np.float64(1)}), whole)
    assert tracer.Scene(ball).render(samples=64, noise=0.5).samples == (16, 16)


def test_layers_by_name(ball):
    picture, layers = tracer.render(ball, layers=["depth", "Normal", "object_id"])
    assert picture.shape == (16, 24, 3) and sorted(layers) == ["depth", "normal", "object_id"]
    assert layers["depth"].shape == (16, 24) and layers["normal"].shape == (16, 24, 3)
    assert layers["object_id"][8, 12] == 1 and layers["object_id"][0, 0] == 0
    assert np.isinf(layers["depth"][0, 0]) and 3.9 < layers["depth"][8, 12] < 4.1
    assert tracer.render(ball, layers=[])[1] == {}
    assert set(layers) < set(tracer.LAYERS)


def test_a_clear_background_has_alpha(ball):
    picture = tracer.Scene({**ball, "output": {"alpha": True}}).render()
    assert picture.linear.shape == (16, 24, 4) and picture.display.shape == (16, 24, 4)
    assert picture.linear[0, 0, 3] == 0 and picture.linear[8, 12, 3] == 1


def test_a_denoised_picture_keeps_the_noisy_one(ball):
    # Under its sky alone there is no noise of light.
    ball["lights"] = [{"SphereLight": {"center": [2, 3, 4], "radius": 1, "power": 500}}]
    picture = tracer.Scene(ball).render(denoise=True)
    assert list(picture.layers) == ["noisy"]
    assert np.array_equal(picture.layers["noisy"], tracer.render(ball))
    assert not np.array_equal(picture.linear, picture.layers["noisy"])
    with pytest.raises(ValueError, match="two samples"):
        tracer.render(ball, denoise=True, samples=1)
    with pytest.raises(ValueError, match='True, False or "oidn", and not \'on\''):
        tracer.render(ball, denoise="on")


def test_a_library_that_denoises_is_looked_for_first(ball, monkeypatch, tmp_path):
    monkeypatch.setenv("TRACER_OIDN", str(tmp_path / "none"))
    with pytest.raises(OSError, match="TRACER_OIDN names .*none, which is not there; install .*denoise=True needs none"):
        tracer.render(ball, denoise="oidn")


def test_pictures_become_files(ball, tmp_path):
    picture = tracer.Scene(ball).render(layers=["albedo"])
    assert picture._repr_png_().startswith(b"\x89PNG") and tracer.Scene(ball)._repr_png_().startswith(b"\x89PNG")
    for name in ["a.png", "a.exr", "a.hdr", "a.pfm"]:
        picture.save(tmp_path / name)
        assert (tmp_path / name).read_bytes() == picture.encode(name[2:])
    picture.save(tmp_path / "a.png", bits=16)
    with pytest.raises(ValueError, match="png, exr, hdr, pfm"):
        picture.save(tmp_path / "a.tiff")
    with pytest.raises(OSError, match="no folder"):
        picture.save(tmp_path / "none" / "a.png")
    assert np.array_equal(np.asarray(picture), picture.linear) and np.asarray(picture, np.float64).dtype == np.float64


def test_what_a_scene_is_made_of_is_not_overwritten(ball, tmp_path):
    tracer.Scene(ball).render().save(tmp_path / "wall.png")
    scene = {"background": 1, "objects": [{"Sphere": {"center": [0, 0, 0], "radius": 1, "material": {
        "Diffuse": {"albedo": {"Texture": {"file": "wall.png"}}}}}}]}
    picture = tracer.Scene(scene, base_dir=tmp_path).render(size=(8, 8), samples=1)
    with pytest.raises(ValueError, match="not overwritten"):
        picture.save(tmp_path / "wall.png")


def test_progress_grows_to_one_in_the_callers_thread(ball):
    told, threads = [], set()

    def progress(part):
        told.append(part)
        threads.add(threading.get_ident())

    tracer.render(ball, size=(128, 128), samples=200, progress=progress)
    assert told == sorted(told) and told[-1] == 1.0 and threads == {threading.get_ident()}


def test_progress_may_end_it_or_fail(ball):
    picture = tracer.Scene(ball).render(size=(256, 256), samples=100_000, progress=lambda part: False)
    assert picture.stopped and picture.samples[1] < 100_000

    def fails(part):
        raise RuntimeError("enough")

    began = time.monotonic()
    with pytest.raises(RuntimeError, match="enough"):
        tracer.render(ball, size=(256, 256), samples=100_000, progress=fails)
    assert time.monotonic() - began < 20


def test_ctrl_c_ends_it_soon(ball, tmp_path):
    script = tmp_path / "long.py"
    script.write_text(
        "import sys, time, tracer\n"
        "try:\n"
        "    tracer.render({'background': 1, 'objects': [{'Sphere': {'center': [0, 0, 0], 'radius': 1}}]},\n"
        "                  samples=10_000_000, progress=lambda part: print('on', flush=True))\n"
        "except KeyboardInterrupt:\n"
        "    print('ended')\n"
    )
    process = subprocess.Popen([sys.executable, str(script)], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "on\n"
    process.send_signal(signal.SIGINT)
    began = time.monotonic()
    out, _ = process.communicate(timeout=60)
    assert out.endswith("ended\n") and process.returncode == 0
    assert time.monotonic() - began < 15


def test_other_threads_of_python_go_on(ball):
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    tracer.Scene(ball).render(size=(256, 256), samples=2_000_000, time=0.5)
    done.set()
    thread.join()
    assert counted[0] - before > 20


def of_child(scene):
    return tracer.render(scene).sum()


@pytest.mark.skipif(not hasattr(__import__("os"), "fork"), reason="there is no fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_process_may_fork_between_pictures(ball):
    expected = tracer.render(ball).sum()
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(of_child, [ball, ball]).get(timeout=120) == [expected, expected]


def test_several_threads_render_at_once(ball):
    scene, expected, made = tracer.Scene(ball), tracer.render(ball), []
    threads = [threading.Thread(target=lambda: made.append(scene.render().linear)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(made) == 4 and all(np.array_equal(picture, expected) for picture in made)


def test_a_scene_is_of_one_frame_and_one_camera(ball):
    film = {
        **{name: value for name, value in ball.items() if name != "camera"},
        "animation": {"frames": 3},
        "cameras": {"a b": {"position": ["=3 + frame", 0, 5]}, "top": {"position": [0, 5, 0.1]}},
    }
    of = lambda **which: tracer.render(film, size=(12, 8), samples=2, **which)
    one, other, top = of(frame=1, camera="a b"), of(frame=2, camera="a b"), of(camera="top")
    assert not np.array_equal(one, other) and not np.array_equal(one, top)
    assert np.array_equal(one, of(set={"animation.frame": 1, "camera": "\"a b\""}))
    assert np.array_equal(other, of(frame=np.int64(2), camera="a b", set={"animation.frame": 1, "camera": "top"}))
