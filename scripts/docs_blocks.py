"""The blocks of a Markdown page, and the commands in them, for scripts/check_docs, which says what the comments mean."""
import os
import re
import shutil
import subprocess

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), ".."))
PROGRAMS = os.path.join(ROOT, "build/devel/lib/uncertainty_identification")
PATH = PROGRAMS + ":" + os.environ["PATH"]
COMMENT = r"<!-- (synopsis|printed|(?:not run|file|keeps running|before)(?=: ))(?:: (.+))? -->"
FENCES = {"sh": "commands", "bash": "commands", "yaml": "configuration"}


class Failure(Exception):
    """What is wrong on a page, with its line."""


def kind(text):
    """Whether a block without a fence holds "commands", a "configuration" or "text"."""
    first = text.split()[0]
    if re.match(r"[a-z_]+:\s", text):
        return "configuration"
    known = shutil.which(first, path=PATH) or first in ("cd", "source", ".", "export")
    path = re.match(r"[A-Z_]+=|\.\.?/", first) or os.path.exists(os.path.join(ROOT, first.split("/")[0]))
    return "commands" if known or path or re.search(r"\s--?[a-z]", text.split("\n")[0]) else "text"


def is_begun(lines, at):
    """Whether the indented block goes on in this line: blank lines belong to it only between indented ones."""
    return lines[at].startswith("    ") or (not lines[at] and at + 1 < len(lines) and lines[at + 1].startswith("    "))


def blocks(path):
    """(line, mark, its argument, kind, text) of each block; a comment `before` is a block of commands without a mark."""
    with open(path) as page:
        lines = page.read().splitlines() + [""]
    mark, at = None, 0
    while at < len(lines):
        begin, comment = at, re.fullmatch(COMMENT, lines[at])
        at += 1
        if comment and comment[1] == "before":
            yield begin + 1, None, None, "commands", comment[2]
        elif comment:
            mark = comment.groups()
        elif lines[begin].startswith("```"):
            at = lines.index("```", at) + 1
            text = "\n".join(lines[begin + 1:at - 1])
            yield (begin + 2, *(mark or (None, None)), FENCES.get(lines[begin][3:], "text"), text)
            mark = None
        elif lines[begin].startswith("    ") and (not lines[begin - 1] or lines[begin - 1].startswith("<!--")):
            while is_begun(lines, at):
                at += 1
            text = "\n".join(line[4:] for line in lines[begin:at])
            yield (begin + 1, *(mark or (None, None)), kind(text), text)
            mark = None
        elif lines[begin] and (mark or lines[begin].startswith("<!--")):
            raise Failure(f"{path}:{begin + 1}: '{lines[begin]}': no block follows the comment, or it is not known")


def commands(line, text):
    """(line, command) of each command in a block: its lines, joined until bash finds them complete."""
    joined = []
    for number, part in enumerate(text.split("\n"), line):
        joined.append(part)
        command = "\n".join(joined)
        if not part.endswith("\\") and subprocess.run(["bash", "-n", "-c", command], capture_output=True).returncode == 0:
            yield number + 1 - len(joined), command
            joined = []
    if joined:
        yield number + 1 - len(joined), "\n".join(joined)
