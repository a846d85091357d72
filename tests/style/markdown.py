#!/usr/bin/python3
"""markdown.py links|lines [DIR]: what is wrong with the Markdown files below DIR, a line each; exit code 1 if anything.

links: every relative link leads to a file that is there, and every anchor to a heading of it.
lines: no line is longer than LONGEST characters but for rows of tables and what cannot be broken, a single link. Pages
that a program writes say so in their first lines and are not looked at.
"""
import functools
import os
import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LONGEST = 120
GENERATED = "<!-- Written by"
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)")
FENCE = re.compile(r"^ *(```|~~~).*?^ *\1 *$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"(`+)(?!`)[^\n]*?(?<!`)\1(?!`)")


def pages(top):
    """Every Markdown file but those of builds, runs and hidden folders."""
    for folder, folders, files in os.walk(top):
        folders[:] = [name for name in folders if not name.startswith((".", "build")) and name != "runs"]
        yield from (pathlib.Path(folder) / name for name in sorted(files) if name.endswith(".md"))


def blanked(match):
    """Spaces in place of code, so that places stay."""
    return re.sub(r"[^\n]", " ", match.group())


def slug(heading):
    """The anchor that GitHub makes of a heading: the text of links, without the marks of code and emphasis."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


@functools.cache
def anchors(page):
    found, seen = set(), {}
    for heading in re.findall(r"^#{1,6} +(.*?)(?: +#+)? *$", FENCE.sub(blanked, page.read_text()), re.MULTILINE):
        name = slug(heading)
        count = seen[name] = seen.get(name, -1) + 1
        found.add(f"{name}-{count}" if count else name)
    return found


def wrong_links(page):
    text = CODE.sub(blanked, FENCE.sub(blanked, page.read_text()))
    for match in LINK.finditer(text):
        target = match.group(1)
        if re.match(r"[a-z][a-z0-9+.-]*:", target):  # elsewhere: http, mailto
            continue
        path, _, anchor = target.partition("#")
        there = page.parent / path if path else page
        line = text.count("\n", 0, match.start()) + 1
        if path.startswith("/") or not there.exists():
            yield line, f"link to '{target}': no such file; links are relative to the page that holds them"
        elif anchor and there.suffix == ".md" and anchor not in anchors(there.resolve()):
            yield line, f"link to '{target}': no heading of {path or 'this page'} has the anchor '{anchor}'"


def long_lines(page):
    lines = page.read_text().splitlines()
    if any(line.startswith(GENERATED) for line in lines[:10]):
        return
    for number, line in enumerate(lines, 1):
        if len(line) <= LONGEST or line.lstrip().startswith("|") or re.fullmatch(r"\s*\W*!?\[[^\]]*\]\(\S*\)\W*", line):
            continue
        yield number, f"{len(line)} characters, at most {LONGEST} are allowed; break the line"


def problems(check, top):
    return [f"{page.relative_to(top)}:{line}: {text}" for page in pages(top) for line, text in check(page)]


def main():
    checks = {"links": wrong_links, "lines": long_lines}
    if len(sys.argv) not in (2, 3) or sys.argv[1] not in checks:
        sys.exit(__doc__)
    found = problems(checks[sys.argv[1]], pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else SOURCE)
    print("\n".join(found) if found else "no problem found")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
