"""Scenes: files, arrays that are views, errors with the engine's messages."""

import copy
import gc
import pickle

import numpy as np
import pytest

import dpe
from conftest import DATA, small_cloth


def test_saving_a_scene_gives_the_same_scene_back(tmp_path, cloth):
    cloth.save(tmp_path / "cloth.txt")
    again = dpe.Scene.load(tmp_path / "cloth.txt")
    assert again.to_json() == cloth.to_json()
    assert pickle.loads(pickle.dumps(cloth)).to_json() == cloth.to_json()


def test_copies_are_independent(cloth):
    before = cloth.to_json()
    for other in (cloth.copy(), copy.copy(cloth), copy.deepcopy(cloth)):
        other.mass = 3.0
        other.wind[1] = 9.0
        assert cloth.to_json() == before
        assert other.to_json() != before


def test_arrays_have_the_documented_shapes():
    scene = dpe.Scene.load(DATA / "corners.txt")
    n, s, t = 144, 726, 242
    assert scene.positions.shape == scene.velocities.shape == (n, 3)
    assert scene.mass.shape == scene.fixed.shape == scene.vertex_group.shape == (n,)
    assert scene.springs.shape == (s, 2)
    assert scene.stiffness.shape == scene.rest_length.shape == (s,)
    assert scene.triangles.shape == (t, 3)
    assert scene.fixed.dtype == bool and scene.fixed.sum() == 4
    assert scene.positions.dtype == np.float64
    assert scene.springs.max() == n - 1
    assert scene.wind.shape == scene.gravity.shape == (3,)
    assert scene.gravity[1] == -9.81
    assert set(scene.spring_kind) == {"stretch", "shear", "bend"}
    ends = scene.positions[scene.springs]
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    np.testing.assert_allclose(scene.rest_length, lengths, rtol=1e-14)


def test_writing_into_a_view_changes_the_scene(cloth):
    cloth.mass[5] = 0.25
    cloth.positions[5] = [1.0, 2.0, 3.0]
    cloth.fixed[5] = True
    cloth.wind[0] = -4.0
    cloth.triangles[0] = cloth.triangles[0][::-1].copy()
    again = dpe.Scene.parse(cloth.to_json())
    assert again.mass[5] == 0.25
    assert again.positions[5].tolist() == [1.0, 2.0, 3.0]
    assert again.fixed[5]
    assert again.wind[0] == -4.0
    assert again.triangles[0].tolist() == cloth.triangles[0].tolist()


def test_a_view_keeps_its_scene_alive():
    mass = small_cloth().mass
    expected = small_cloth().mass.copy()
    gc.collect()
    hoard = [small_cloth() for _ in range(20)]  # would reuse memory that was freed
    np.testing.assert_array_equal(mass, expected)
    assert len(hoard) == 20


def test_views_survive_a_cloth_that_is_added(cloth):
    first = cloth.objects[0]
    mass = cloth.mass
    other = small_cloth(5, 3)
    for _ in range(20):
        cloth.add(other.objects[0])
    mass[2] = 0.125
    assert first.mass[2] == 0.125
    assert len(cloth.objects) == 21
    assert cloth.objects[20].mass.shape == (15,)
    with pytest.raises(AttributeError, match="21 objects"):
        cloth.mass


def test_assigning_the_wrong_shape_names_both(cloth):
    with pytest.raises(ValueError, match=r"\(5,\).*\(16,\)"):
        cloth.mass = np.ones(5)
    with pytest.raises(ValueError, match=r"positions has shape \(16, 2\)"):
        cloth.positions = np.ones((16, 2))


def test_errors_have_the_engine_s_messages(tmp_path, cloth):
    cloth.mass[3] = -1.0
    with pytest.raises(dpe.SceneError, match=r"vertMass\[3\].*-1"):
        cloth.validate()
    with pytest.raises(dpe.SceneError, match="nowhere.txt"):
        dpe.Scene.load(tmp_path / "nowhere.txt")
    with pytest.raises(dpe.SceneError, match="letter \"Q\""):
        cloth.settings = "nQ"
    assert issubclass(dpe.SceneError, ValueError)


def test_what_is_worth_a_look_is_a_warning(cloth):
    text = cloth.to_json().replace('"title"', '"tilte"')
    with pytest.warns(dpe.SceneWarning, match="tilte"):
        dpe.Scene.parse(text)


def test_presets_are_the_data_scenes():
    for name in ("side", "corners", "flag", "flag_no_wind"):
        made = dpe.Scene.preset(name)
        loaded = dpe.Scene.load(DATA / f"{name}.txt")
        np.testing.assert_array_equal(made.positions, loaded.positions)
        np.testing.assert_array_equal(made.stiffness, loaded.stiffness)
        np.testing.assert_array_equal(made.fixed, loaded.fixed)
        np.testing.assert_array_equal(made.wind, loaded.wind)


def test_a_mesh_makes_the_cloth_that_a_grid_makes(tmp_path):
    grid = dpe.Scene.grid(4, 5, 2.0, density=0.3, pins=[1])
    made = dpe.Scene.from_mesh(grid.positions, grid.triangles, density=0.3, pins=[1])
    assert made.to_json() == grid.to_json()
    lines = ["v {} {} {}".format(*map(repr, map(float, p))) for p in grid.positions]
    lines += ["f {} {} {}".format(*(t + 1)) for t in grid.triangles]
    (tmp_path / "cloth.obj").write_text("\n".join(lines))
    read = dpe.Scene.from_obj(tmp_path / "cloth.obj", density=0.3, pins=[1])
    np.testing.assert_allclose(read.mass, grid.mass, rtol=1e-12)


def test_parameters_and_back(cloth):
    cloth.settings = "GL"
    cloth.estimate_damping = True
    p = cloth.parameters
    blocks = cloth.parameter_blocks
    assert [b.kind for b in blocks] == ["mass", "stiffness", "damping"]
    assert [b.mode for b in blocks] == ["G", "L", "G"]
    assert sum(b.size for b in blocks) == len(p)
    p[blocks[1].slice] = 7.0
    changed = cloth.with_parameters(p)
    moved = np.asarray(blocks[1].element_to_value) >= 0
    assert (changed.stiffness[moved] == 7.0).all() and moved.sum() > 20
    assert (changed.stiffness[~moved] == cloth.stiffness[~moved]).all()
    with pytest.raises(ValueError, match="parameters"):
        cloth.with_parameters(p[:-1])


def test_pins_paths_and_colliders(cloth):
    cloth.unpin_all()
    assert not cloth.fixed.any()
    assert cloth.pin_box([-9, -9, -9], [9, 9, 9]) == 16
    cloth.unpin_all()
    path = np.array([[0.0, 0.1 * f, 0.0] for f in range(10)])
    cloth.prescribe(0, path)
    cloth.colliders = [dpe.Collider.sphere([0, -1, 0], 0.5)]
    assert cloth.colliders[0].type == "sphere" and cloth.colliders[0].scale[0] == 1.0
    moved = dpe.simulate(cloth, 10).positions
    np.testing.assert_allclose(moved[:, 0], path, atol=1e-12)
