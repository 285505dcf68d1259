# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""check_pages.py SITE HEADERS: each link, heading and picture of the site is there, each public function has its place,
and no page loads anything from elsewhere."""
import html.parser
import pathlib
import re
import sys
import urllib.parse

site = pathlib.Path(sys.argv[1]).resolve()
ids, links = {}, []


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.path = path
        ids[path] = set()

    def handle_starttag(self, tag, attributes):
        a = dict(attributes)
        ids[self.path].update(x for x in (a.get("id"), a.get("name")) if x)
        for key in ("href", "src"):
            if a.get(key):
                links.append((self.path, tag, key, a[key], a.get("rel")))


for page in site.rglob("*.html"):
    if "web" not in page.relative_to(site).parts:
        Page(page.resolve()).feed(page.read_text())
bad = []
for path, tag, key, link, rel in links:
    where = f"{path.relative_to(site)}: {link}"
    parts = urllib.parse.urlsplit(link)
    if parts.scheme or link.startswith("//"):
        if key == "src" or (tag == "link" and rel != "canonical"):
            bad.append(f"{where}: loaded from elsewhere")
        continue
    target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
    if target.is_dir():
        target /= "index.html"
    if not target.exists():
        bad.append(f"{where}: no such file")
    elif parts.fragment and target in ids and urllib.parse.unquote(parts.fragment) not in ids[target]:
        bad.append(f"{where}: no such heading")
functions = 0
for header in sorted(pathlib.Path(sys.argv[2]).glob("*.h")):
    for name in re.findall(r"^CGT_API [^(;]*?(cgt_\w+)\(", header.read_text(), re.M):
        functions += 1
        if name not in ids.get(site / "reference" / (header.stem + ".html"), ()):
            bad.append(f"reference/{header.stem}.html: no {name}")
print("\n".join(sorted(set(bad))), end="\n" if bad else "")
if bad or functions < 50:
    sys.exit(1)
print(f"{len(ids)} pages, {len(links)} links, {functions} functions")
