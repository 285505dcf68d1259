# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# To be sourced: sets `python` to one that has all that the package's tests need, or ends as a test that is left out.
python=
for candidate in ${CGT_PYTHON:-/usr/bin/python3 python3}; do
    if "$candidate" -c 'import setuptools, cffi, numpy, pip, pytest, wheel' 2>/dev/null; then
        python=$candidate
        break
    fi
done
if [ -z "$python" ]; then
    echo "left out: no Python with cffi, numpy, pytest, pip, setuptools and wheel (Debian: apt-get install" \
        "python3-cffi python3-numpy python3-pytest python3-pip python3-setuptools python3-wheel)"
    exit 77
fi
