#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# site.sh [OUTPUT]
# Builds the site, build/site by default: the texts as they lie in the tree, and a reference of all calls from the headers.
# Its pages load nothing from the network. Where scripts/web.sh has built the page that traces, the front shows it.
# Ends by checking each link, heading and picture, and that each public function has its place.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v mkdocs >/dev/null || scripts/dependencies.sh site
out=$(realpath -m "${1:-build/site}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/pages"
cp -R README.md CONTRIBUTING.md NEWS LICENSE docs include examples "$work/pages"
mkdir -p "$work/pages/scripts" "$work/pages/tests/readers"
cp -R tests/readers/data "$work/pages/tests/readers"
if [ -e build/web/cgt-web.html ]; then
    mkdir "$work/pages/web"
    cp build/web/cgt-web.* "$work/pages/web"
fi
# Debian 12's theme asks for two scripts under names that its package has not; the second one is not needed.
mkdir "$work/pages/js"
cp /usr/share/javascript/jquery/jquery.min.js "$work/pages/js/jquery-3.6.0.min.js"
: >"$work/pages/js/theme_extra.js"
python3 scripts/site/make_pages.py "$work" scripts/site
mkdocs build --quiet --strict --config-file "$work/mkdocs.yml" --site-dir "$out"
rm "$out/404.html" # its links begin at the root of a server
python3 scripts/site/check_pages.py "$out" include/cgt
