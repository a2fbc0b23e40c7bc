"""The examples of docs/python.md run, in their order, as a notebook would run them."""

import ast
import pathlib
import re

import numpy as np
import tracer

MANUAL = pathlib.Path(__file__).parents[4] / "docs" / "python.md"


def test_the_examples_of_the_manual_run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```", MANUAL.read_text(encoding="utf-8"), re.S | re.M)
    names, values = {}, []
    for block in blocks:
        tree = ast.parse(block)
        last = tree.body[-1] if isinstance(tree.body[-1], ast.Expr) else None
        body = ast.Module(tree.body[: -1 if last else None], [])
        exec(compile(body, str(MANUAL), "exec"), names)
        values.append(eval(compile(ast.Expression(last.value), str(MANUAL), "eval"), names) if last else None)
    assert len(blocks) == 8
    notebook, files, torus, skin, progress = values[:5]
    assert isinstance(notebook, tracer.Scene) and notebook._repr_png_().startswith(b"\x89PNG")
    assert files is None and (tmp_path / "balls.png").stat().st_size > 1000 and (tmp_path / "balls.exr").exists()
    assert torus.shape == (64, 96, 3) and skin.shape == (64, 64, 3)
    assert progress == 1.0
    told = capsys.readouterr().out
    assert "error[E0201]" in told and "did you mean `radius`?" in told
    # The program's picture is the module's.
    assert np.array_equal(names["picture"], tracer.render(names["scene"], samples=8))
    assert names["picture"].shape == (48, 64, 3)
