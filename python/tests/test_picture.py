# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Pictures; left out where libcgt was installed without them."""
import copy
import pickle
import struct
import zlib

import numpy as np
import pytest

import cgt

try:
    import cgt.picture
except ImportError as error:
    pytest.skip(str(error), allow_module_level=True)

CAMERA = cgt.Camera((0, 0, 5), fov=40)


@pytest.fixture(scope="module")
def scene():
    """A red ball, id 0, before a blue square, id 1."""
    s = cgt.Scene()
    s.add(cgt.Spheres([[0.0, 0, 0]], 0.8))
    s.add(cgt.Triangles([[-2.0, -2, -1], [2, -2, -1], [2, 2, -1], [-2, 2, -1]], [[0, 1, 2], [0, 2, 3]]))
    s.commit()
    return s


LOOKS = {0: cgt.Look((0.8, 0.05, 0.05)), 1: cgt.Look((0.05, 0.05, 0.8))}


def decode(png):
    """The pixels of a PNG file whose rows have no filter."""
    place, data, head = 8, b"", None
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    while place < len(png):
        size, kind = struct.unpack(">I4s", png[place:place + 8])
        body, (crc,) = png[place + 8:place + 8 + size], struct.unpack(">I", png[place + 8 + size:place + 12 + size])
        assert zlib.crc32(kind + body) == crc
        head = struct.unpack(">IIBBBBB", body) if kind == b"IHDR" else head
        data += body if kind == b"IDAT" else b""
        place += 12 + size
    width, height, channels = head[0], head[1], {2: 3, 6: 4}[head[3]]
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(height, 1 + channels * width)
    assert not rows[:, 0].any()
    return rows[:, 1:].reshape(height, width, channels)


def test_looks_give_the_colours(scene, tmp_path):
    picture = cgt.Picture(80, 60, ambient=16).draw(scene, CAMERA, LOOKS)
    red, blue = picture.pixels[30, 40].astype(int), picture.pixels[5, 40].astype(int)
    assert red[0] > 100 > red[2] and blue[2] > 100 > blue[0]
    assert (picture.pixels[0, 0] == 255).all()
    assert np.array_equal(decode(picture._repr_png_()), picture.pixels)
    picture.save(tmp_path / "picture.png")
    assert (tmp_path / "picture.png").read_bytes() == picture._repr_png_()
    picture.save(tmp_path / "picture.png", dpi=300)
    file = (tmp_path / "picture.png").read_bytes()
    assert file[33:54] == b"\0\0\0\tpHYs" + (11811).to_bytes(4, "big") * 2 + b"\1" + file[50:54]
    for wrong in (0, -1, float("nan"), 2e6):
        with pytest.raises(cgt.InvalidArgument):
            picture.save(tmp_path / "picture.png", dpi=wrong)


def test_pictures_grow_by_samples(scene):
    whole = cgt.Picture(80, 60, ambient=8).draw(scene, CAMERA, LOOKS).pixels
    picture = cgt.Picture(80, 60, ambient=8)
    picture.begin(scene, CAMERA, LOOKS)
    first = picture.read().copy()
    steps = 1
    while picture.step(2):
        steps += 1
    assert steps == 4 and np.array_equal(picture.read(), whole) and not np.array_equal(first, whole)


def test_colours_of_each_primitive_and_vertex(scene):
    colors = np.zeros((4, 3))
    colors[:2] = 0.9  # below
    looks = {1: cgt.Look(colors=colors, per_vertex=True)}
    picture = cgt.Picture(80, 60, shading="plain").draw(scene, CAMERA, looks).pixels.astype(int)
    assert (picture[55, 40] > picture[4, 40] + 50).all()
    by_triangle = {1: cgt.Look(colors=[(0.9, 0, 0), (0, 0.9, 0)])}
    picture = cgt.Picture(80, 60, shading="plain").draw(scene, CAMERA, by_triangle).pixels.astype(int)
    assert picture[30, 60, 0] > picture[30, 60, 1] + 50 and picture[30, 20, 1] > picture[30, 20, 0] + 50
    s = cgt.Scene()
    s.add(cgt.Triangles(np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0], [5, 5, 0], [6, 5, 0], [5, 6, 0.0]])))
    s.commit()
    look = cgt.Look((1, 1, 1), vertex_normals=np.tile((0, 0, 1.0), (6, 1)))
    assert (cgt.Picture(80, 60).draw(s, CAMERA, {0: look}).pixels[30, 40] > 100).all()


def test_transparent_pictures_have_opacity(scene):
    picture = cgt.Picture(80, 60, transparent=True).draw(scene, CAMERA, LOOKS)
    assert picture.pixels.shape == (60, 80, 4)
    assert picture.pixels[30, 40, 3] == 255 and picture.pixels[0, 0, 3] == 0
    assert np.array_equal(decode(picture._repr_png_()), picture.pixels)


def test_lights_cast_shadows(scene):
    light = cgt.Light((-1, 0, 1), "directional")
    lit = cgt.Picture(80, 60, lights=[(light, (0.9, 0.9, 0.9), 0)]).draw(scene, CAMERA, LOOKS).pixels
    assert lit[30, 66, 2] < 20 < lit[30, 14, 2]  # behind the ball, and before it
    soft = cgt.Picture(80, 60, lights=[(light, (0.9, 0.9, 0.9), 5.0)], light_samples=16)
    assert len(np.unique(soft.draw(scene, CAMERA, LOOKS).pixels[30, :, 2])) > len(np.unique(lit[30, :, 2]))


def test_errors_are_named(scene):
    for make, message in (
        (lambda: cgt.Picture(shading="cartoon"), "shading: 'cartoon': one of bounces, full, plain"),
        (lambda: cgt.Look(colors=np.zeros(3)), r"colors: shape \(3,\)"),
        (lambda: cgt.Picture(lights=[(cgt.Light((0, 1, 0)), (1, 1, 1), 0)] * 9), "lights: 9: at most 8"),
        (lambda: cgt.Picture(antialias=3).draw(scene, CAMERA), "antialias"),
        (lambda: cgt.Picture().draw(scene, CAMERA, {7: cgt.Look()}), "geometry 7 does not exist"),
        (lambda: cgt.Picture().draw(scene, CAMERA, {0: cgt.Look(colors=np.zeros((2, 3)))}), "colors: 2 .* must be 1"),
        (lambda: cgt.Picture().read(), "it has not begun"),
        (lambda: cgt.Picture().step(), "it has not begun"),
        (lambda: cgt.Picture(0, 5), "width: 0: must be from 1"),
        (lambda: cgt.Picture(5, -1), "height: -1: must be from 1"),
        (lambda: cgt.Picture(5.5), "width: 5.5: must be a whole number"),
        (lambda: cgt.Picture(ambient="a"), "ambient: 'a': must be a whole number"),
        (lambda: cgt.Picture(sky=None), "sky: None: must be a number"),
        (lambda: cgt.Picture(cue=1), "cue: 1: must be three numbers"),
        (lambda: cgt.Picture(rows=3), "rows: 3: must be two values"),
        (lambda: cgt.Picture(lights=[cgt.Light((0, 0, 1))]), "lights: .*: must be a light, its color and its size"),
        (lambda: cgt.Picture(lights=[((0, 0, 1), (1, 1, 1), 0)]), "lights: tuple: must be cgt.Light"),
        (lambda: cgt.Picture(materials=["glass"]), "materials: str: must be cgt.Material"),
        (lambda: cgt.Picture(8, 8).draw(scene, CAMERA, {0: (1, 0, 0)}), "looks: tuple: must be cgt.Look"),
        (lambda: cgt.Picture(8, 8).draw(scene, CAMERA, [cgt.Look()]), "looks: list: must be a mapping"),
        (lambda: cgt.Picture(8, 8).draw(scene, None), "camera: NoneType: must be cgt.Camera"),
        (lambda: cgt.Look(material=256), "material: 256: must be from 0 to 255"),
    ):
        with pytest.raises(cgt.InvalidArgument, match=message):
            make()
    with pytest.raises(cgt.NotCommitted):
        cgt.Picture(8, 8).draw(cgt.Scene(), CAMERA)


def test_scenes_that_go_while_a_picture_grows():
    for shading in ("full", "plain"):
        for end in (lambda s: s.close(), lambda s: s.commit()):
            s = cgt.Scene()
            s.add(cgt.Spheres(np.zeros((1, 3), "f4"), 1.0))
            s.commit()
            picture = cgt.Picture(8, 8, ambient=4, shading=shading)
            picture.begin(s, CAMERA)
            end(s)
            with pytest.raises(cgt.NotCommitted, match="committed anew or closed"):
                picture.step() if shading == "full" else picture.read()
    s.add(cgt.Spheres(np.zeros((1, 3), "f4"), 1.0))  # not committed
    picture = cgt.Picture(8, 8)
    with pytest.raises(cgt.NotCommitted):
        picture.begin(s, CAMERA)
    with pytest.raises(cgt.InvalidArgument):
        picture.read()


def test_rows_and_linear_pixels():
    scene = cgt.Scene()
    ball = scene.add(cgt.Spheres(np.zeros((1, 3), "f4"), 1.0))
    scene.commit()
    looks = {ball: cgt.Look((0.8, 0.4, 0.2))}
    whole = cgt.Picture(40, 31, ambient=4, linear=True).draw(scene, CAMERA, looks)
    hit = whole.linear["id"] == 0
    assert hit.any() and np.isfinite(whole.linear["depth"][hit]).all() and np.isinf(whole.linear["depth"][~hit]).all()
    upper = cgt.Picture(40, 31, ambient=4, rows=(0, 12)).draw(scene, CAMERA, looks)
    lower = cgt.Picture(40, 31, ambient=4, rows=(12, 0)).draw(scene, CAMERA, looks)
    assert not upper.pixels[12:].any() and not lower.pixels[:12].any()
    assert np.array_equal(upper.pixels + lower.pixels, whole.pixels)
    with pytest.raises(cgt.InvalidArgument, match="rows from row"):
        cgt.Picture(40, 31, rows=(31, 1)).draw(scene, CAMERA, looks)
    fog = cgt.Picture(40, 31, ambient=4, cue=(1, 0, 1), background=(1, 1, 1)).draw(scene, CAMERA, looks)
    assert (fog.pixels == 255).all()  # everything lies behind depth 1
    ghost = cgt.Picture(40, 31, ambient=4, layers=[(2, 0.25)], background=(1, 1, 1))
    masked = cgt.Scene()
    ball = masked.add(cgt.Spheres(np.zeros((1, 3), "f4"), 1.0, mask=2))
    masked.commit()
    assert (ghost.draw(masked, CAMERA, looks).pixels.astype(int) - whole.pixels)[hit].min() > 0
    for wrong in ([(0, 0.5)], [(2, 0.5), (6, 0.5)], [(2, 2.0)], [(1 << k, 0.5) for k in range(9)]):
        with pytest.raises(cgt.InvalidArgument, match="layer"):
            cgt.Picture(8, 8, layers=wrong).draw(masked, CAMERA, looks)


def test_halves_of_capsules():
    scene = cgt.Scene()
    stick = scene.add(cgt.Capsules(np.array([[-1, 0, 0], [1, 0, 0]], "f4"), 0.3))
    scene.commit()
    look = cgt.Look(colors=[[0.9, 0, 0], [0, 0, 0.9]], halves=True)
    pixels = cgt.Picture(60, 40, background=(0, 0, 0)).draw(scene, CAMERA, {stick: look}).pixels
    left, right = pixels[:, :28].reshape(-1, 3), pixels[:, 32:].reshape(-1, 3)
    assert left[:, 0].any() and not left[:, 2].any() and right[:, 2].any() and not right[:, 0].any()
    with pytest.raises(cgt.InvalidArgument, match="colors: 1 of them: must be 2"):
        cgt.Picture(8, 8).draw(scene, CAMERA, {stick: cgt.Look(colors=[[1, 0, 0]], halves=True)})


def test_mirrors_and_glass():
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], "f4")
    faces = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6],
                      [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]], "u4")
    cube = cgt.Triangles(corners, faces)
    bodies, count = cgt.find_bodies(cube)
    assert count == 1 and not bodies.any()
    with pytest.raises(cgt.InvalidArgument, match="closed"):
        cgt.find_bodies(cgt.Triangles(corners, faces[1:]))
    with pytest.raises(cgt.InvalidArgument, match="side by side"):
        cgt.find_bodies(cgt.Triangles(corners.astype("f8"), faces))
    scene = cgt.Scene()
    ball = scene.add(cgt.Spheres(np.array([[0, 0, -4]], "f4"), 1.0))
    box = scene.add(cgt.Triangles(corners, faces))
    scene.commit()
    light = [(cgt.Light((0, 1, 1), "directional"), (1, 1, 1), 0)]
    materials = [cgt.Material(), cgt.Material("glass", index=1.0), cgt.Material("mirror", color=(0.5, 0.5, 0.5))]

    def draw(material):
        picture = cgt.Picture(40, 40, shading="bounces", lights=light, materials=materials, background=(0, 0, 1))
        looks = {ball: cgt.Look((0.9, 0.1, 0.1)), box: cgt.Look((0.1, 0.9, 0.1), material=material, bodies=bodies)}
        return picture.draw(scene, CAMERA, looks).pixels[20, 20]

    matte, clear, mirror = draw(0), draw(1), draw(np.full(12, 2, np.uint8))
    assert matte[1] > matte[0] and clear[0] > clear[1] and mirror[2] > mirror[0]
    with pytest.raises(cgt.InvalidArgument, match="material that does not exist"):
        draw(3)
    with pytest.raises(cgt.InvalidArgument, match="kind: 'wood': one of"):
        cgt.Material("wood")


def test_masks_of_shadows():
    """A ball between the light and a floor casts a shadow, half of one as glass, or none."""
    s = cgt.Scene()
    floor = s.add(cgt.Triangles(np.array([[-9, -9, 0], [9, -9, 0], [0, 18, 0]], "f4"), mask=1))
    s.add(cgt.Spheres(np.array([[0, 0, 6]], "f4"), 1.0, mask=2))
    s.commit()
    camera, light = cgt.Camera((0, 0, 4), fov=40), [(cgt.Light((0, 0, 1), "directional"), (0.6, 0.6, 0.6), 0)]

    def middle(**masks):
        picture = cgt.Picture(9, 9, shading="bounces", lights=light, **masks)
        return int(picture.draw(s, camera, {floor: cgt.Look((1, 1, 1), sheet=True)}).pixels[4, 4, 0])

    dark, glass, lit = middle(), middle(shadow_mask=1, glass_mask=2), middle(shadow_mask=1)
    assert dark < glass < lit
    share = [cgt.picture.lib.cgt_srgb_to_linear(x / 255) for x in (dark, glass, lit)]
    assert (share[1] - share[0]) / (share[2] - share[0]) == pytest.approx(0.6, abs=0.02)


def test_palettes_ids_and_lines(scene):
    colors = np.array([[0.8, 0.1, 0.1], [0.1, 0.8, 0.1], [0.1, 0.1, 0.8]], "f4")
    s = cgt.Scene()
    balls = s.add(cgt.Spheres([[-1.0, 0, 0], [0, 0, 0], [1, 0, 0]], 0.45))
    s.commit()
    index = np.array([2, 0, 1])
    by_colors = cgt.Picture(80, 60).draw(s, CAMERA, {balls: cgt.Look(colors=colors[index])})
    look = cgt.Look(index=index, palette=colors, ids=[70, 80, 90])
    by_index = cgt.Picture(80, 60, linear=True).draw(s, CAMERA, {balls: look})
    assert np.array_equal(by_colors.pixels, by_index.pixels)
    assert sorted(set(by_index.linear["id"].ravel().tolist())) == [70, 80, 90, cgt.INVALID_ID]
    assert by_index.hits == by_colors.hits == (by_index.linear["id"] != cgt.INVALID_ID).sum() > 500
    black = [(cgt.Picture(80, 60, outline=2).draw(s, CAMERA, {balls: cgt.Look((1, 1, 1), lineless_from=k)}).pixels == 0)
             .all(axis=2).sum() for k in (None, 2, 1, 0)]
    assert black[0] > black[1] > black[2] > black[3] == 0
    # along the palette from vertex to vertex: entries 0 and 2 have 1 between them
    wall = cgt.Scene()
    square = wall.add(cgt.Triangles([[-2.0, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]], [[0, 1, 2], [0, 2, 3]]))
    wall.commit()
    for steps, green in ((3, True), (0, False)):
        look = cgt.Look(index=[0, 2, 2, 0], palette=colors, palette_steps=steps, per_vertex=True)
        pixel = cgt.Picture(80, 60, shading="plain").draw(wall, CAMERA, {square: look}).pixels[30, 40].astype(int)
        assert (pixel[1] > pixel[0] + 50) == green
    for make, message in (
        (lambda: cgt.Look(index=[0]), "palette: it goes with index"),
        (lambda: cgt.Look(index=[0.5], palette=colors), "index: dtype float64: must be whole numbers, uint16"),
        (lambda: cgt.Look(index=[70000], palette=colors), "index: 70000 to 70000: must fit uint16"),
        (lambda: cgt.Look(colors=[["red"] * 3]), r"colors: shape \(1, 3, 3\)"),
        (lambda: cgt.Look(material=np.full(3, 256)), "material: 256 to 256: must fit uint8"),
        (lambda: cgt.Look(index=[0], palette=colors, palette_steps=4), "palette_steps: 4: more than the palette has"),
        (lambda: cgt.Picture(8, 8).draw(s, CAMERA, {balls: cgt.Look(index=[0, 1, 3], palette=colors)}),
         "index: 3, of 3 colours"),
        (lambda: cgt.Picture(8, 8).draw(s, CAMERA, {balls: cgt.Look(index=[0, 1], palette=colors)}),
         "index: 2 of them: must be 3"),
    ):
        with pytest.raises(cgt.InvalidArgument, match=message):
            make()


def test_what_is_looped_over_once_means_the_same(scene):
    light = cgt.Light((5, 0, 5))
    given = {"lights": [(light, (1, 0, 0), 0.0)], "layers": [(2, 0.5)], "materials": [cgt.Material("mirror")],
             "cue": (0.5, 1, 9), "up": (0, 0, 1), "rows": (3, 20)}
    for name, values in given.items():
        wanted = cgt.Picture(40, 30, **{name: values})
        for once in (iter(values), (v for v in values), map(lambda v: v, values)):
            picture = cgt.Picture(40, 30, **{name: once})
            for other in (picture, copy.copy(picture), copy.deepcopy(picture)):
                assert repr(other._given[name]) == repr(wanted._given[name])
                assert np.array_equal(other.draw(scene, CAMERA).pixels, wanted.draw(scene, CAMERA).pixels), name
    assert not np.array_equal(cgt.Picture(40, 30).draw(scene, CAMERA).pixels,
                              cgt.Picture(40, 30, lights=iter(given["lights"])).draw(scene, CAMERA).pixels)
    for name, value in (("lights", light), ("lights", 5), ("layers", 5), ("materials", cgt.Material()),
                        ("layers", "ab"), ("lights", [light]), ("materials", None), ("rows", 3), ("layers", [5])):
        with pytest.raises(cgt.InvalidArgument, match=f"^{name}: "):
            cgt.Picture(40, 30, **{name: value})


def test_copies_have_what_the_picture_was_made_of(scene):
    paper, line, color, layers = np.array([1.0, 0, 0]), [0.0, 1, 0], np.array([1.0, 0, 0]), [(1, 0.5)]
    rows, lights = [0, 20], [[cgt.Light((0, 0, 9)), color, 0.0]]
    picture = cgt.Picture(40, 30, background=paper, outline_color=line, outline=2.0, lights=lights, layers=layers,
                          rows=rows)
    expected = picture.draw(scene, CAMERA).pixels
    paper[:], line[:], color[:], rows[:], lights[0][2] = 0, [1, 1, 0], 0.5, [0, 10], None
    layers.clear()
    for other in (copy.copy(picture), copy.deepcopy(picture), pickle.loads(pickle.dumps(picture))):
        assert np.array_equal(other.draw(scene, CAMERA).pixels, expected)


def test_lights_without_shadows(scene):
    light = cgt.Light((-1, 0, 1), "directional")
    dark, lit = (cgt.Picture(80, 60, lights=[(light, (0.9, 0.9, 0.9), size)]).draw(scene, CAMERA, LOOKS).pixels
                 for size in (0, None))
    assert dark[30, 66, 2] < 20 < lit[30, 66, 2]


def test_colours_of_values_types_and_elements():
    assert len(cgt.colors.maps()) >= 4
    for name in cgt.colors.maps():
        assert cgt.colors.palette(name).shape == (1025, 3)
    values = np.r_[np.linspace(0, 1, 1001), np.nan, np.inf]
    table = cgt.colors.palette()
    by = cgt.colors.by_value(values, low=0, high=1)
    assert np.array_equal(by[[0, 1000]], table[[0, 1023]]) and np.array_equal(by[1001:], [cgt.colors.unknown()] * 2)
    assert cgt.colors.entries([-5, 9], low=0, high=1).tolist() == [0, 1023]
    entries = cgt.colors.entries(values)
    assert entries[0] == entries[10] == 0 and entries[10] < entries[30] and entries[500] in (511, 512)
    assert entries.dtype == np.uint16 and cgt.colors.entries([3.0, 3.0]).tolist() == [0, 0]
    assert cgt.colors.entries([np.nan]).tolist() == [1024] and cgt.colors.entries([]).shape == (0,)
    for low, high, name in ((np.nan, 1, "low"), (-np.inf, 1, "low"), (0, np.inf, "high"), (None, np.nan, "high")):
        for call in (cgt.colors.entries, cgt.colors.by_value,
                     lambda v, **ends: cgt.Look(colors=v, map="magma", **ends)):
            with pytest.raises(cgt.InvalidArgument, match=f"^{name}: .*: must be finite"):
                call([0, 1, 2.0], low=low, high=high)
    with np.errstate(all="raise"):
        for largest in (1e308, np.finfo("f8").max):
            assert cgt.colors.entries([-largest, 0, largest, np.nan]).tolist() == [0, 512, 1023, 1024]
            assert cgt.colors.entries([-largest, largest]).tolist() == [0, 1023]
            assert cgt.colors.entries([-largest, 0.5, largest], low=0, high=1).tolist() == [0, 512, 1023]
    with pytest.raises(cgt.InvalidArgument, match="map: 'rainbow': one of viridis"):
        cgt.colors.palette("rainbow")
    kinds = cgt.colors.by_type([1, 2, 17])
    assert np.array_equal(kinds[0], kinds[2]) and not np.array_equal(kinds[0], kinds[1])
    oxygen, unknown = cgt.colors.by_element(np.array([8, 0], "u1"))
    assert oxygen[0] > oxygen[1] and unknown.min() > 0 and cgt.colors.by_type([]).shape == (0, 3)
    with pytest.raises(cgt.InvalidArgument, match="types: -1 to 2: must fit uint32"):
        cgt.colors.by_type([2, -1])


def test_cameras_fit_turn_and_light():
    camera = cgt.Camera((0, 0, 5))
    camera.orbit(90)
    assert np.allclose(camera.eye, (5, 0, 0), atol=1e-6)
    assert np.allclose(camera.axes, [(0, 0, -1), (0, 1, 0), (-1, 0, 0)], atol=1e-6)
    assert np.dot(camera.key_light(80, 60), (1, 0, 0)) > 0
    balls = cgt.Spheres(np.array([[100.0, 7, 0], [104, 7, 0]]), np.array([1, 0.5]), origin=(100, 7, 0))
    stick = cgt.Capsules(np.array([[0, 0, 0], [0, 30, 0], [0, 0, 0], [4, 0, 0]], "f4"), np.array([0.2, 0.9]))
    mesh = cgt.Triangles(np.array([[0, -20, 0], [1, 0, 0], [0, 0, 1]], "f4"))
    for shapes in (balls, stick, mesh, [balls, stick, mesh]):
        for projection in ("perspective", "orthographic"):
            camera = cgt.Camera((3, 2, 5), projection=projection)
            camera.fit(shapes, 600, 400)
            scene = cgt.Scene()
            for shape in shapes if isinstance(shapes, list) else [shapes]:
                scene.add(shape)
            scene.commit()
            hit = scene.trace_camera(camera, 600, 400).hit
            rows, columns = np.flatnonzero(hit.any(axis=1)), np.flatnonzero(hit.any(axis=0))
            assert rows[0] > 3 and rows[-1] < 396 and columns[0] > 5 and columns[-1] < 594
            assert columns[-1] - columns[0] > 530 or rows[-1] - rows[0] > 350
    for ends in (cgt.Capsules(np.array([[0, 0, 0], [0, 30, 0]], "f4"), 0.2, [[0, 1]]),
                 cgt.Capsules(np.array([[0, 0, 0]], "f4"), 0.2, ends=np.array([[0, 30, 0]], "f4")),
                 cgt.Capsules(np.array([[0, 0, 0], [0, 30, 0]], "f4"), np.array([5, 0.2]), types=np.array([1], "u1"))):
        one, two = cgt.Camera((3, 2, 5)), cgt.Camera((3, 2, 5))
        one.fit(ends, 90, 60)
        two.fit(cgt.Spheres([[0, 0, 0], [0, 30.0, 0]], np.float32(0.2)), 90, 60)
        assert np.array_equal(one.eye, two.eye)
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1000, 0, 0]], "f8")
    for used, dtype in ((corners[:3], "u4"), (corners, "i8"), (corners, "u8"), (corners, "u1")):
        camera = cgt.Camera()
        camera.fit(iter([cgt.Triangles(used, np.array([[0, 1, 2]], dtype))]), 90, 60)
        assert camera.eye[0] == 0.5
    for shape, name in ((cgt.Triangles(corners, [[0, 1, 4]]), "indices"),
                        (cgt.Triangles(corners, [[0, 1, -1]]), "indices"),
                        (cgt.Capsules(corners, 0.5, [[0, 4]]), "indices"),
                        (cgt.Capsules(corners, 0.5, [[-1, 0]]), "indices"),
                        (cgt.Spheres(corners, [1.0, 2], types=[0, 1, 2, 0]), "types"), (5, "geometries"),
                        (cgt.Spheres(corners, [1.0, 2], types=[0, 1, -1, 0]), "types"), (None, "geometries")):
        eye = camera.eye
        with pytest.raises(cgt.InvalidArgument, match=f"^{name}: "):
            camera.fit(shape, 90, 60)
        assert np.array_equal(camera.eye, eye)
    for nothing in ([], cgt.Spheres(np.zeros((0, 3))), cgt.Spheres(np.full((1, 3), np.nan), 1.0)):
        with pytest.raises(cgt.InvalidArgument, match="nothing to show"):
            camera.fit(nothing, 90, 60)
    with pytest.raises(cgt.InvalidArgument, match="geometries: ndarray"):
        camera.fit([np.zeros((1, 3))], 90, 60)
