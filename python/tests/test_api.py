# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Every function and every field of a struct of the installed definitions is in the package, or left out by intent."""
import importlib
import inspect
import os
import re
import subprocess
import sys

import pytest

import cgt
import cgt.research
from cgt import _arrays, _calls, _frames, _native, _rays, context, geometry, results, scene

FUNCTIONS_LEFT_OUT = {
    **{f"cgt_{name}_init": "zeros are the defaults"
       for name in ("context_options", "scene_options", "trace_options", "frame", "shadow_options", "ambient_options",
                    "all_hits_options", "inside_options", "camera", "research_scene_options",
                    "research_trace_options")},
    "cgt_camera_get_ray": "camera_rays",
    **{"cgt_scene_get_" + name: "the geometries that were added"
       for name in ("geometries", "spheres", "triangles", "capsules")},
    "cgt_visit_all_rays": "trace_all_rays, whose arrays are what a visitor would fill",
    "cgt_trace_all_ray": "trace_all_rays of one ray",
    "cgt_context_run_tasks": "for C; Python has pools of its own",
    # cgt-picture
    "cgt_write_png": "Picture.save, which has zlib",
    "cgt_picture_draw": "begin, step and read are it",
    "cgt_picture_set_options": "another Picture",
    **{"cgt_camera_fit_" + name: "Camera.fit" for name in ("create", "release", "add", "add_box", "apply")},
    "cgt_srgb_from_linear": "cgt_srgb_encode, for colours that are given",
    # cgt-figure
    "cgt_figure_set": "set_lines, all at once", "cgt_figure_unset": "another figure of C's has the other options",
    "cgt_figure_set_source": "messages of data, which have no path",
    "cgt_figure_needs_frame": "a survey looks at all that it is given",
    "cgt_figure_set_stop": "pictures end by themselves",
    "cgt_figure_get_chosen": "Figure.camera; another figure chooses anew", "cgt_figure_get_up": "Figure.camera",
    "cgt_figure_describe": "the caller has the columns of what pick finds",
    **{f"cgt_figure_{name}": "for windows in C" for name in (
        "begin", "step", "read", "begin_keep", "keep", "show_frame", "frame_get_bytes", "frame_get_data",
        "frame_release")},
    # cgt-mpi
    "cgt_mpi_draw_rows": "rows come to rank 0", "cgt_mpi_get_scene": "a scene of one process has all calls",
    # cgt-trajectory
    "cgt_trajectory_open": "open_series of one path",
    "cgt_trajectory_find_column": "TrajectoryFrame.columns is a dictionary",
    "cgt_trajectory_set_follow": "for viewers; open it anew",
    "cgt_trajectory_get_origin": "TrajectoryFrame.origin",
    **{"cgt_trajectory_writer_" + name: "cgt-convert writes .frames"
       for name in ("open", "add", "open_triangles", "add_vertices", "finish", "close", "get_error_message")},
}
# What takes or gives the fields of a struct; all: as attributes, whatever they are.
ALL = [_native.struct_values]
RAYS, FRAME = [_calls, _rays], [_frames, results]
STRUCTS = {
    "cgt_context_options": [context], "cgt_log_hook": [context],
    "cgt_array": [_arrays], "cgt_spheres": [geometry.Spheres, geometry._Geometry],
    "cgt_triangles": [geometry.Triangles, geometry._Geometry],
    "cgt_capsules": [geometry.Capsules, geometry._Geometry],
    "cgt_scene_options": [scene], "cgt_scene_statistics": ALL, "cgt_trace_statistics": ALL,
    "cgt_trace_options": [_calls], "cgt_camera": [geometry.Camera], "cgt_tile": FRAME, "cgt_frame": FRAME,
    "cgt_rays": RAYS, "cgt_hits": RAYS + [results], "cgt_single_ray": RAYS, "cgt_hit": RAYS,
    "cgt_light": [geometry.Light, _frames], "cgt_points": RAYS, "cgt_shadow_options": [_frames],
    "cgt_ambient_options": [_frames], "cgt_all_hits_options": RAYS, "cgt_hit_rows": RAYS, "cgt_inside_options": RAYS,
    "cgt_media": RAYS, "cgt_surfaces": RAYS + [results], "cgt_bounced_rays": RAYS + [results],
    "cgt_research_scene_options": [cgt.research], "cgt_research_trace_options": [cgt.research],
    "cgt_research_scene_statistics": ALL, "cgt_research_trace_statistics": ALL, "cgt_trajectory_mesh": ALL,
}
HOOKS = "hooks for memory and tasks are for C"
RETURNED = "arrays are returned"
FIELDS_LEFT_OUT = {
    "cgt_memory_hooks": HOOKS, "cgt_task_runner": HOOKS, "cgt_context_options.memory": HOOKS,
    "cgt_context_options.tasks": HOOKS,
    "cgt_log_hook.user": "the logger needs none",
    "cgt_frame.visitor_user": "a function of Python's has its own", "cgt_shadow_options.visitor": RETURNED,
    "cgt_shadow_options.visitor_user": RETURNED, "cgt_ambient_options.visitor": RETURNED,
    "cgt_ambient_options.visitor_user": RETURNED,
    "cgt_media.inside_of_primitive": "inside_of_ray, indices[hits.primitive]",
    "cgt_media.geometries": "goes with inside_of_primitive",
    # cgt-picture
    "cgt_picture_work.stop": "a picture stops between its steps", "cgt_picture_work.stop_user": "goes with stop",
    "cgt_image.row_stride": "pixels are an array of the picture", "cgt_image.alpha": "pixels[..., 3]",
    "cgt_image.dpi": "Picture.save has it",
    # cgt-figure
    "cgt_figure_data.frame": "frames of cgt.read are given by their arrays",
    # cgt-trajectory
    "cgt_trajectory_options.max_count": "the default is the most that the library takes",
    "cgt_trajectory_options.stop": "follow ends by itself", "cgt_trajectory_options.stop_user": "goes with stop",
    "cgt_trajectory_frame.kind": "triangles is None or not",
    "cgt_trajectory_frame.box_min": "box_origin and box_edges",
    "cgt_trajectory_frame.box_max": "box_origin and box_edges",
}


def parts():
    """The definitions and the library of each part that is installed, and where its structs are."""
    yield _native.ffi, _native.lib, STRUCTS
    known = dict(STRUCTS)
    for name in ("picture", "figure", "trajectory", "mpi"):
        try:
            ffi, lib = _native.load_part(name)
            module = importlib.import_module("cgt." + name)
        except ImportError:
            continue
        if name == "picture":
            places = {name: [module.Picture] for name in ("options", "light", "lighting", "layer", "style", "bounces", "work")}
            more = {"cgt_look": [module.Look], "cgt_material": [module.Material], "cgt_image": [module.Picture],
                    "cgt_linear_pixel": [module.Picture]}
        elif name == "figure":
            data = [importlib.import_module("cgt._figure_data").FigureData]
            places = {name: data for name in ("column", "points", "triangles", "bonds", "box", "data")}
            more = {"cgt_figure_option": ALL, "cgt_figure_hit": ALL}
        elif name == "mpi":
            places, more = {"options": [module.Job], "geometry": [module.Job, geometry]}, {}
        else:
            places = {"options": [module.read, module.Trajectory], "frame": [module.TrajectoryFrame],
                      "column": [module.TrajectoryFrame]}
            more = {}
        known.update(more, **{f"cgt_{name}_{end}": place for end, place in places.items()})
        yield ffi, lib, known


def package_text():
    folder = os.path.dirname(cgt.__file__)
    texts = []
    for name in sorted(os.listdir(folder)):
        if name.endswith(".py") and name not in ("_definitions.py", "_picture.py", "_figure.py", "_trajectory.py",
                                                   "_mpi.py"):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                texts.append(file.read())
    return "".join(texts)


def test_all_functions_are_called_or_left_out():
    text = package_text()
    called = set(re.findall(r"(?:lib|library)\.(cgt_[a-z0-9_]+)", text))
    kinds = ("spheres", "triangles", "capsules")
    called.update(prefix + kind for prefix in re.findall(r'getattr\(lib, "(cgt_[a-z_]+_)"', text) for kind in kinds)
    declared = {name for _, lib, _ in parts() for name in dir(lib) if name.startswith("cgt_")}
    assert len(declared) > 40
    missing = declared - called - set(FUNCTIONS_LEFT_OUT)
    assert not missing, f"give these to Python, or tell in FUNCTIONS_LEFT_OUT why not: {sorted(missing)}"
    assert not called & set(FUNCTIONS_LEFT_OUT), "not left out any more"


def test_all_fields_are_used_or_left_out():
    seen, missing = set(), []
    for ffi, _, structs in parts():
        for name in ffi.list_types()[0]:
            try:
                kind = ffi.typeof(name)
            except ffi.error:  # a type of functions
                continue
            if kind.kind != "struct" or not kind.fields:
                continue
            seen.add(name)
            if name in FIELDS_LEFT_OUT:
                continue
            assert name in structs, f"tell where Python has {name}, or in FIELDS_LEFT_OUT why it has not"
            if structs[name] is ALL:
                continue
            text = "".join(inspect.getsource(place) for place in structs[name])
            for field, _ in kind.fields:
                full = f"{name}.{field}"
                if full in FIELDS_LEFT_OUT:
                    seen.add(full)
                elif not re.search(rf"""\.{field}\b|["']{field}["']|\b{field}=""", text):
                    missing.append(full)
    assert not missing, f"give these to Python, or tell in FIELDS_LEFT_OUT why not: {missing}"
    assert len(seen) > 20
    if len(list(parts())) == 5:
        assert not set(FIELDS_LEFT_OUT) - seen, "no longer there"


def test_a_new_call_or_field_would_be_noticed(monkeypatch):
    names = dir(_native.lib)

    class More:
        """The library with one more function."""

        def __dir__(self):
            return names + ["cgt_fold_space"]

    monkeypatch.setattr(_native, "lib", More())
    with pytest.raises(AssertionError, match="cgt_fold_space"):
        test_all_functions_are_called_or_left_out()
    monkeypatch.undo()
    monkeypatch.setitem(STRUCTS, "cgt_camera", [geometry.Light])
    with pytest.raises(AssertionError, match="cgt_camera.projection"):
        test_all_fields_are_used_or_left_out()


# ---- names and types ----


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    """Checks programs as their writers do, against the package that is installed."""
    pytest.importorskip("mypy", reason="no mypy (Debian: apt-get install mypy)")
    folder = os.path.dirname(os.path.dirname(cgt.__file__))
    command = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--follow-imports=silent",
               "--cache-dir", str(tmp_path_factory.mktemp("mypy"))]
    return lambda *files: subprocess.run([*command, *map(str, files)], capture_output=True, text=True, check=False,
                                         env={**os.environ, "MYPYPATH": folder})


def test_examples_have_the_types_that_they_use(mypy):
    examples = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples")
    found = mypy(*(os.path.join(examples, name) for name in os.listdir(examples) if name.endswith(".py")))
    assert found.returncode == 0, found.stdout


def test_a_type_checker_knows_names_and_types(mypy, tmp_path):
    program = tmp_path / "program.py"
    program.write_text("import cgt\ncgt.shwo(1)\ncgt.Camera(fov='wide')\nreveal_type(cgt.show([[0, 0, 0]]))\n"
                       "reveal_type(cgt.read('a')[0].step)\ncgt.trimesh, cgt.colors.palette, cgt.research\n")
    lines = mypy(program).stdout.splitlines()
    assert len([line for line in lines if "error:" in line]) == 2, lines
    for words in (':2: error: Module has no attribute "shwo"', ":3: error: Argument", 'type is "cgt.figure.Figure"',
                  'type is "builtins.int"'):
        assert any(words in line for line in lines), (words, lines)


def test_all_names_are_found():
    code = "import cgt; print(' '.join(dir(cgt))); from cgt import *; print(' '.join(sorted(globals())))"
    child = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    listed, imported = (line.split() for line in child.stdout.splitlines())
    assert set(cgt.__all__) < set(listed) and set(cgt.__all__) <= set(imported)
    assert {"show", "read", "Figure", "Picture", "colors", "trimesh", "research"} <= set(listed) and "importlib" not in listed
    for name in cgt.__all__:
        thing = getattr(cgt, name)
        assert thing is not None and (not callable(thing) or thing.__doc__), name


def test_help_begins_with_what_a_call_does():
    for call in (cgt.show, cgt.Figure.movie, cgt.Scene.trace_rays, cgt.Scene.trace_hit_rows, cgt.Picture.__init__):
        assert len(str(inspect.signature(call))) < 1000 and "_typing" not in str(inspect.signature(call))
