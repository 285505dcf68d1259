# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
"""make_pages.py WORK SITE_FOLDER: from WORK/pages, the tree's texts, to what mkdocs takes.

The navigation is that of the tables in docs/README.md. Each header becomes a page: a heading for each declaration, its
comment as text, the declaration as code.
"""
import pathlib
import re
import shutil
import sys

work = pathlib.Path(sys.argv[1])
site = pathlib.Path(sys.argv[2])
pages = work / "pages"


def plain(comment):
    """The lines of a comment without its marks."""
    lines = comment.strip()[2:-2].split("\n")
    return [re.sub(r"^ ?\* ?", "", line.strip() if i else line) for i, line in enumerate(lines)]


def text_of(comment):
    """A comment as Markdown: rows such as "  name   meaning" and "Word:   meaning" become a list."""
    out = []
    for raw in plain(comment):
        line = raw.rstrip().replace("<", "&lt;").replace("|", "\\|").replace("*", "\\*").replace("_", "\\_")
        row = re.match(r"^ {1,3}([\w\[\].\\,]+(?: [\w.\\]+)?) {2,}(\S.*)", line) or re.match(r"^([A-Z][a-z, ]+): +(\S.*)", line)
        if row:
            out.append(("" if out and out[-1].startswith(("- ", "  ")) else "\n") + f"- **{row[1].strip()}**: {row[2]}")
        elif out and line.startswith(" ") and "- **" in "".join(out[-6:]):
            out.append("  " + line.strip())
        else:
            out.append(line.strip())
    return "\n".join(out).strip()


def name_of(code):
    found = (re.search(r"^CGT_API [^(]*?(cgt_\w+)\(", code, re.M) or re.search(r"^\}\s*(cgt_\w+);", code, re.M) or
             re.search(r"^typedef [^;{]*?(cgt_\w+)(?:\(|;)", code, re.M) or re.search(r"^#define (\w+)", code, re.M))
    return found[1] if found else None


def page_of(header):
    source = header.read_text()
    out = [f"# &lt;cgt/{header.name}&gt;\n"]
    head = re.match(r"/\*.*?\*/", source, re.S)[0]
    out.append("```text\n" + "\n".join(plain(head)[2:]).strip() + "\n```\n")
    body = source[len(head):]
    for block in re.split(r"\n\n+", body):
        block = block.strip("\n")
        section = re.match(r"/\* -{4} (.*?) -+ \*/$", block)
        if section:
            out.append(f"## {section[1]}\n")
            continue
        comment = re.match(r"/\*.*?\*/", block, re.S)
        code = block[comment.end():].strip("\n") if comment else block
        name = name_of(code)
        if not name or name.endswith("_H") or name == "CGT_API":
            continue
        out.append(f"### {name}\n")
        if comment:
            out.append(text_of(comment[0]) + "\n")
        out.append("```c\n" + code + "\n```\n")
        # further functions of the block, which share its text
        for other in re.findall(r"^CGT_API [^(]*?(cgt_\w+)\(", code, re.M)[1:]:
            out.append(f'<a id="{other}"></a>\n')
    return "\n".join(out)


def quoted(text):
    return '"' + text.replace('"', '\\"') + '"'


headers = sorted((pages / "include/cgt").glob("*.h"), key=lambda h: (h.name != "cgt.h", h.name))
headers = [h for h in headers if h.name != "version.h"]
(pages / "reference").mkdir()
for h in headers:
    (pages / "reference" / (h.stem + ".md")).write_text(page_of(h))

# A text that is no Markdown is shown as it is.
news = pages / "NEWS"
(pages / "NEWS.md").write_text("# News\n\n```text\n" + news.read_text() + "```\n")

front = pages / "README.md"
if (pages / "web").is_dir():
    heading = "# libcgt\n"
    front.write_text(front.read_text().replace(
        heading, heading + '\n<iframe class="traces" src="web/cgt-web.html" title="A run, traced in this page"></iframe>\n', 1))

# Markdown of Python wants an empty line before a list, where GitHub's does not.
for path in pages.rglob("*.md"):
    if pages / "tests" in path.parents:
        continue
    lines, out, code = path.read_text().split("\n"), [], False
    for line in lines:
        if line.startswith("```"):
            code = not code
        if not code and re.match(r"(- |\d+\. )", line) and out and out[-1].strip() and not re.match(r"(- |\d+\. |  )", out[-1]):
            out.append("")
        out.append(line)
    path.write_text("\n".join(out))

nav = ["  - Home: README.md"]
for section in re.split(r"^## ", (pages / "docs/README.md").read_text(), flags=re.M)[1:]:
    title = re.split(r"[:\n]", section)[0]
    nav.append(f"  - {quoted(title)}:")
    for link in re.findall(r"^\| \[[^]]*\]\(([^)#]*\.md)\)", section, re.M):
        target = (pages / "docs" / link).resolve().relative_to(pages.resolve())
        first = re.search(r"^# (.*)", (pages / target).read_text(), re.M)[1]
        nav.append(f"    - {quoted(first.replace('`', ''))}: {target}")
    if title == "Guide":
        nav.append('  - "Reference":')
        nav.extend(f"    - {quoted('cgt/' + h.name)}: reference/{h.stem}.md" for h in headers)
nav += ["  - News: NEWS.md"]
shutil.copy(site / "site.css", pages)
config = (site / "mkdocs.yml").read_text()
(work / "mkdocs.yml").write_text(config + "docs_dir: pages\nnav:\n" + "\n".join(nav) + "\n")
