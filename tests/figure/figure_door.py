# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""figure_door.py FILE [NAME[=VALUE]...]: pictures of a file by cgt.Figure, as bytes on standard output, for doors.sh."""
import sys

import cgt

options = {}
for argument in sys.argv[2:]:
    name, has_value, value = argument.partition("=")
    options.setdefault(name.replace("-", "_"), []).append(value if has_value else True)
mesh = options.pop("mesh", None)
known = cgt.figure.options()
options = {name: values if name in known and known[name].repeats else values[-1] for name, values in options.items()}
try:
    figure = cgt.Figure(size=(96, 64), **options)
    if mesh:
        figure.set_mesh(cgt.read(mesh[0]).read())
    run = cgt.read(sys.argv[1], all_bonds=True, leave_out_sites=True)
    figure.survey(run)
    for frame in run:
        sys.stdout.buffer.write(figure.show(frame).draw().tobytes())
    sys.stderr.writelines(f"{notice}\n" for notice in figure.notices)
except cgt.Error as error:
    sys.exit(f"figure_door: {error}")
