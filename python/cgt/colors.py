# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""Colours of values, as cgt-render has them, and what arguments for colours may be.

Colours are names of CSS, one of "rgbcmykw", "#rrggbb", bytes (uint8), or numbers from 0 to 1; all of them sRGB, as on a
screen, unless `linear` says that numbers are shares of light.

>>> import cgt
>>> cgt.colors.maps()[0]
'viridis'
>>> cgt.colors.palette()[cgt.colors.entries([0.0, 0.5, 1.0], low=0, high=1)].shape
(3, 3)
"""
from __future__ import annotations

import re
from typing import Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import F4, F8, U1, U2, U4, array_of, check_shape, numbers
from ._native import InvalidArgument, encoded, load_part, real, switch

ffi, lib = load_part("picture")
STEPS = 1024  # as in cgt-render
_NAMES = {word[:-6]: word[-6:] for word in """
    alicebluef0f8ff antiquewhitefaebd7 aqua00ffff aquamarine7fffd4 azuref0ffff beigef5f5dc bisqueffe4c4 black000000
    blanchedalmondffebcd blue0000ff blueviolet8a2be2 browna52a2a burlywooddeb887 cadetblue5f9ea0 chartreuse7fff00
    chocolated2691e coralff7f50 cornflowerblue6495ed cornsilkfff8dc crimsondc143c cyan00ffff darkblue00008b
    darkcyan008b8b darkgoldenrodb8860b darkgraya9a9a9 darkgreen006400 darkgreya9a9a9 darkkhakibdb76b darkmagenta8b008b
    darkolivegreen556b2f darkorangeff8c00 darkorchid9932cc darkred8b0000 darksalmone9967a darkseagreen8fbc8f
    darkslateblue483d8b darkslategray2f4f4f darkslategrey2f4f4f darkturquoise00ced1 darkviolet9400d3 deeppinkff1493
    deepskyblue00bfff dimgray696969 dimgrey696969 dodgerblue1e90ff firebrickb22222 floralwhitefffaf0 forestgreen228b22
    fuchsiaff00ff gainsborodcdcdc ghostwhitef8f8ff goldffd700 goldenroddaa520 gray808080 green008000 greenyellowadff2f
    grey808080 honeydewf0fff0 hotpinkff69b4 indianredcd5c5c indigo4b0082 ivoryfffff0 khakif0e68c lavendere6e6fa
    lavenderblushfff0f5 lawngreen7cfc00 lemonchiffonfffacd lightblueadd8e6 lightcoralf08080 lightcyane0ffff
    lightgoldenrodyellowfafad2 lightgrayd3d3d3 lightgreen90ee90 lightgreyd3d3d3 lightpinkffb6c1 lightsalmonffa07a
    lightseagreen20b2aa lightskyblue87cefa lightslategray778899 lightslategrey778899 lightsteelblueb0c4de
    lightyellowffffe0 lime00ff00 limegreen32cd32 linenfaf0e6 magentaff00ff maroon800000 mediumaquamarine66cdaa
    mediumblue0000cd mediumorchidba55d3 mediumpurple9370db mediumseagreen3cb371 mediumslateblue7b68ee
    mediumspringgreen00fa9a mediumturquoise48d1cc mediumvioletredc71585 midnightblue191970 mintcreamf5fffa
    mistyroseffe4e1 moccasinffe4b5 navajowhiteffdead navy000080 oldlacefdf5e6 olive808000 olivedrab6b8e23 orangeffa500
    orangeredff4500 orchidda70d6 palegoldenrodeee8aa palegreen98fb98 paleturquoiseafeeee palevioletreddb7093
    papayawhipffefd5 peachpuffffdab9 perucd853f pinkffc0cb plumdda0dd powderblueb0e0e6 purple800080
    rebeccapurple663399 redff0000 rosybrownbc8f8f royalblue4169e1 saddlebrown8b4513 salmonfa8072 sandybrownf4a460
    seagreen2e8b57 seashellfff5ee siennaa0522d silverc0c0c0 skyblue87ceeb slateblue6a5acd slategray708090
    slategrey708090 snowfffafa springgreen00ff7f steelblue4682b4 tand2b48c teal008080 thistled8bfd8 tomatoff6347
    turquoise40e0d0 violetee82ee wheatf5deb3 whiteffffff whitesmokef5f5f5 yellowffff00 yellowgreen9acd32
    rff0000 g008000 b0000ff c00bfbf mbf00bf ybfbf00 k000000 wffffff
""".split()}
_OF_BYTE = np.array([lib.cgt_srgb_decode(code) for code in range(256)], F4)


def code_of(text: str) -> Optional[str]:
    """A colour's name or code as "rrggbb"; None: it is neither."""
    if re.fullmatch("#[0-9a-fA-F]{6}|#[0-9a-fA-F]{3}", text):
        return text[1:] if len(text) == 7 else "".join(2 * digit for digit in text[1:])
    return _NAMES.get(text.lower().replace(" ", ""))


def code_of_light(linear: np.ndarray) -> str:
    """A linear colour as "rrggbb"."""
    return "".join(f"{lib.cgt_srgb_encode(x):02x}" for x in linear.tolist())


def _of_text(name: str, text: str) -> list:
    """Bytes of a colour's name or code."""
    code = code_of(text)
    if code is None:
        raise InvalidArgument(f"{name}: {text!r}: must be a colour's name, or #rrggbb")
    return [int(code[k:k + 2], 16) for k in (0, 2, 4)]


def light_of(name: str, colors, shape: tuple = (3,), linear: bool = False) -> np.ndarray:
    """The one rule for colours: what an argument gives, as linear float32 of its own, of a shape that ends with 3."""
    linear = switch("linear", linear)
    if isinstance(colors, str):
        a = np.array(_of_text(name, colors), U1)
    else:
        a = array_of(name, colors)
        if a.dtype.kind == "U" or (a.dtype == object and a.size and all(isinstance(x, str) for x in a.flat)):
            words, place = np.unique(a.astype(str), return_inverse=True)
            a = np.array([_of_text(name, str(w)) for w in words], U1)[place.reshape(a.shape)]
    if a.ndim and a.shape[-1] == 4 and len(a.shape) == len(shape) and a.size and (
            a[..., 3] == (255 if a.dtype == U1 else 1)).all():
        a = a[..., :3]  # what matplotlib and trimesh give for opaque ones
    check_shape(name, a, shape)
    if a.dtype == U1:
        if linear and not isinstance(colors, str):
            raise InvalidArgument(f"{name}: uint8: bytes are sRGB: without linear")
        return _OF_BYTE[a]
    b = numbers(name, a, F4)
    if b.size and not (b.min() >= 0 and b.max() <= 1):
        raise InvalidArgument(f"{name}: {b.min():g} to {b.max():g}: must be from 0 to 1, or bytes: uint8")
    return b.astype(F4) if linear else _decoded(b)


def _decoded(encoded: np.ndarray) -> np.ndarray:
    """cgt_srgb_to_linear of an array; of a large one by the same formula."""
    if encoded.size <= 3 * (STEPS + 1):
        return np.array([lib.cgt_srgb_to_linear(x) for x in encoded.flat], F4).reshape(encoded.shape)
    curve = np.power((encoded + F4.type(0.055)) / F4.type(1.055), F8.type(F4.type(2.4)), dtype=F8)
    return np.where(encoded <= F4.type(0.04045), encoded / F4.type(12.92), curve).astype(F4)


def maps() -> Tuple[str, ...]:
    """The names of the colour maps; the first is the default. With "_r" behind it a name is the map reversed."""
    names, found = lib.cgt_get_colormap_names(), []
    while names[len(found)]:
        found.append(ffi.string(names[len(found)]).decode())
    return tuple(found)


def _color(of, *arguments) -> list:
    out = ffi.new("float[3]")
    of(*arguments, out)
    return list(out)


def unknown() -> np.ndarray:
    """The colour of values that are not finite or masked, which no map contains: (3,) float32."""
    return np.array(_color(lib.cgt_get_unknown_color), F4)


def palette(map: Optional[str] = None) -> np.ndarray:
    """The 1,024 colours of a map and `unknown`, for `cgt.Look` with the entries of `entries`: (1025, 3) float32."""
    found = lib.cgt_find_colormap(ffi.NULL if map is None else encoded("map", str(map)))
    if found == ffi.NULL:
        raise InvalidArgument(f"map: {map!r}: one of {', '.join(maps())}")
    return np.array([_color(lib.cgt_get_map_color, found, k / (STEPS - 1)) for k in range(STEPS)] + [unknown()], F4)


def entries(values: ArrayLike, low: Optional[float] = None, high: Optional[float] = None) -> np.ndarray:
    """The entries of `palette` for values, (n,) uint16.

    Parameters
    ----------
    values : (n,) numbers
        What is masked or not finite gets the last entry.
    low, high : float, optional
        Ends of the map; None: the quantiles of 1 and 99 percent of the values.
    """
    values = numbers("values", values, F8, ("n",), np.nan)
    low, high = (None if x is None else real(name, x) for name, x in (("low", low), ("high", high)))
    for name, end in (("low", low), ("high", high)):
        if end is not None and not np.isfinite(end):
            raise InvalidArgument(f"{name}: {end}: must be finite")
    if low is not None and high is not None and low > high:
        raise InvalidArgument(f"low: {low}: above high, {high}")
    known = np.isfinite(values)
    ends = (0.0, 1.0)
    if known.any():
        if max(values[known].max(), -values[known].min()) > 1e300:  # their differences would be infinite
            values, low, high = (None if x is None else x / 1024 for x in (values, low, high))
        ends = np.quantile(values[known], (0.01, 0.99))
    low, high = ends[0] if low is None else low, ends[1] if high is None else high
    share = (np.where(known, values, low) - low) / (high - low if high > low else np.inf)
    return np.where(known, np.clip(share, 0, 1) * (STEPS - 1) + 0.5, STEPS).astype(U2)


def by_value(values: ArrayLike, map: Optional[str] = None, low: Optional[float] = None,
             high: Optional[float] = None) -> np.ndarray:
    """The colours of values by a map, (n, 3) float32; arguments are those of `palette` and `entries`."""
    return palette(map)[entries(values, low, high)]


def _of_kinds(of, name, kinds) -> np.ndarray:
    values, place = np.unique(numbers(name, kinds, U4, ("n",)), return_inverse=True)
    return np.array([_color(of, int(v)) for v in values], F4).reshape(-1, 3)[place.reshape(-1)]


def by_type(types: ArrayLike) -> np.ndarray:
    """The colours of types, (n,) int from 1 on: sixteen, of which everyone can tell the first eight apart, again and again: (n, 3) float32."""
    return _of_kinds(lib.cgt_get_type_color, "types", types)


def by_element(numbers: ArrayLike) -> np.ndarray:
    """The colours of elements, (n,) atomic numbers, Jmol's; 0 is unknown, a light pink: (n, 3) float32."""
    return _of_kinds(lib.cgt_get_element_color, "numbers", numbers)
