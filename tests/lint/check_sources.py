#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Checks the text of sources and pages. Prints "FILE:LINE: what is wrong" for each finding.

Usage: tests/lint/check_sources.py [RULE...]
       tests/lint/check_sources.py --self-test    (plants faults in made-up sources)

Without an argument, all rules are checked. Each is a function that takes a Tree and yields findings.
"""

import functools
import graphlib
import os
import posixpath
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FOLDERS = [".ci", "apps", "docs", "libplayerlike", "libsim", "tests", "worlds"]


class Tree:
    """The files of the repository: path -> text. Binary files have no text (None)."""

    def __init__(self, files):
        self.files = files
        self.paths = {"", *files}
        for path in files:
            while path := posixpath.dirname(path):
                self.paths.add(path)

    def texts(self, pattern):
        """(path, text) of each text file whose path begins with a match of the pattern."""
        begin = re.compile(pattern)
        return [(p, t) for p, t in self.files.items() if t is not None and begin.match(p)]

    def sources(self, *folders):
        return self.texts(rf"({'|'.join(folders)})/.*\.(h|c|cc|cpp)$")


def read_tree():
    """Reads the root's files and FOLDERS; build and output folders lie beside these."""
    files = {}
    names = [name for name in os.listdir(ROOT) if os.path.isfile(os.path.join(ROOT, name))]
    for folder in FOLDERS:
        for place, folders, found in os.walk(os.path.join(ROOT, folder)):
            folders[:] = [name for name in folders if name != "__pycache__"]
            names += [os.path.relpath(os.path.join(place, name), ROOT) for name in found]
    for name in sorted(names):
        with open(os.path.join(ROOT, name), "rb") as file:
            data = file.read()
        files[name] = None if b"\0" in data else data.decode("utf-8", "replace")
    return Tree(files)


def at(path, text, offset, message):
    """A finding at an offset of a file's text."""
    return f"{path}:{text.count(chr(10), 0, offset) + 1}: {message}"


TOKEN = re.compile(r"""
    ^[ \t]*\#[ \t]*include[ \t]*[<"][^>"\n]*[>"]
  | //[^\n]* | /\*.*?\*/
  | R"(?P<end>[^\s()\\]{0,16})\(.*?\)(?P=end)"
  | "(?:\\.|[^"\\\n])*"
  | (?<![0-9A-Za-z])'(?:\\[^\n]|[^'\\\n])+'""", re.DOTALL | re.MULTILINE | re.VERBOSE)


@functools.cache
def code_of(text):
    """The text without comments and the contents of literals. Line breaks and includes are kept."""
    def blank(match):
        token = match[0]
        if token.lstrip().startswith("#"):
            return token
        lines = "\n" * token.count("\n")
        return lines if token.startswith("/") else '""' + lines
    return TOKEN.sub(blank, text)


INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"\n]+)[>"]', re.MULTILINE)


# --- layering: which source may include what

def arrows(table):
    return {name: set(targets.split()) for name, targets in table.items()}


# Folder of libsim -> the other folders that it may include.
SIM = arrows({
    "core": "",
    "world": "core",
    "canvas": "core world",
    "io": "core world canvas",
    "scan": "core",
    "navigation": "core world",
    "physics": "core world scan",
    "devices": "core world io canvas scan navigation physics",
    "simulation": "core world io canvas scan navigation physics devices",
    "render": "core world canvas navigation simulation",
    "parallel": "core world io scan devices simulation",
})

# Folder of libplayerlike or apps -> the other folders of libplayerlike and apps that it may include.
# They are the layers of docs/architecture.md, each above those that it names.
PLAYERLIKE = arrows({
    "messages": "libplayerinterface",
    "view": "",
    "page": "",
    "process": "messages",
    "protocol": "messages libplayerinterface",
    "session": "messages libplayerinterface",
    "virtual_time": "process",
    "replay": "",
    "host": "messages process protocol session view page replay virtual_time",
    "remote": "messages process protocol session virtual_time",
    "connect": "messages process session virtual_time host remote",
    "testing": "messages process session host connect",
    "server": "messages process protocol session virtual_time host wire proxies libplayerinterface",
    # Headers that clients include.
    "libplayerinterface": "",
    "libplayercommon": "",
    "libplayererror": "libplayercommon",
    "libplayercore": "libplayercommon libplayerinterface",
    "libplayerc": "libplayercommon libplayerinterface",
    "libplayerc++": "libplayercommon libplayerinterface libplayerc",
    "libCCMorse": "libplayerc++",
    "libPlayer": "libCCMorse libplayerc++",
    "player-": "libplayerc libplayerc++ libplayercommon libplayerinterface",
    "imr-h": "",
    "replace": "",
    # Their implementation.
    "core": "messages process session virtual_time connect libCCMorse libplayerc++",
    "devices": "messages process session virtual_time connect libCCMorse libplayerc++ core",
    "proxies": "messages session virtual_time connect libCCMorse libplayerc++ core devices",
    "drivers": "messages session virtual_time libCCMorse libplayerc++ core devices proxies",
    "playerc": "virtual_time libplayerinterface libplayerc libplayerc++ core devices proxies",
    # Devices in the words of Player's protocol.
    "wire": "messages protocol session libplayerinterface libplayerc++ proxies",
    "imr": "virtual_time libplayerc++ imr-h",
    # Programs.
    "client": "libplayerc++",
    "test": "libplayerc++ testing",
    "par_common": "",
    "par_intro": "imr-h libCCMorse",
    "par_planning": "imr-h libCCMorse par_common",
    "par_exploration": "imr-h libCCMorse par_common",
    "par_traps": "imr-h libCCMorse par_common",
    "par_exploration_changing": "imr-h libCCMorse par_exploration",
    "par_chase": "imr-h libCCMorse par_common",
    "par_localization": "imr-h libCCMorse par_common",
    "playpen": "messages process host replay connect server page playpen/grade playpen/course "
               "playpen/batch",
    "playpen/grade": "messages host",
    "playpen/course": "messages host playpen/grade",
    "playpen/batch": "messages host playpen/grade",
    "playpen/view": "view",
    "playpen/page": "page server replay",
})

# Includes that belong in a few places only: (start of the include, start of the paths that may have
# it, why not elsewhere). (?!libsim/) means: anywhere but in libsim.
PLACES = [(re.compile(include), re.compile(path), why) for include, path, why in [
    (r"\.\./", r"$.", "name it from the include folder"),
    (r"[bB]ox2[dD]/", r"libsim/src/physics/", "Box2D belongs in libsim/src/physics"),
    (r"opencv[24]?/", r"apps/playpen/view/|libsim/src/render/modules/.*_module\.cpp$",
     "OpenCV belongs in the modules of libsim/src/render/modules"),
    (r"lib(av[a-z]+|sw[a-z]+)/", r"libsim/src/render/modules/film_module\.cpp$",
     "FFmpeg belongs in libsim/src/render/modules/film_module.cpp"),
    (r"boost/", r"apps/playpen/page/|libplayerlike/include/imr-h/|(?!apps/|lib)",
     "Boost belongs in apps/playpen/page"),
    (r"opencv2/highgui\.hpp$|X11/", r"apps/playpen/view/", "windows belong in apps/playpen/view"),
    (r"png\.h$", r"libsim/src/canvas/png_codec\.cpp$",
     "libpng belongs in libsim/src/canvas/png_codec.cpp"),
    (r"jpeglib\.h$", r"libsim/src/canvas/jpeg_codec\.cpp$",
     "libjpeg belongs in libsim/src/canvas/jpeg_codec.cpp"),
    (r"zlib\.h$", r"libplayerlike/src/(wire|remote)/|apps/playpen/replay/",
     "zlib belongs in libplayerlike/src/wire, libplayerlike/src/remote and apps/playpen/replay"),
    (r"yaml-cpp/", r"libsim/src/io/", "YAML belongs in libsim/src/io"),
    (r"nlohmann/", r"(?!libsim/)|libsim/src/io/", "JSON belongs in libsim/src/io"),
    (r"(nlohmann|yaml-cpp|spdlog|fmt|CLI)/", r"(?!lib(sim|playerlike)/include/)",
     "public headers show no third-party types but Eigen's"),
    (r"(thread|mutex|shared_mutex|condition_variable|future|stop_token|barrier|latch|semaphore"
     r"|chrono|ctime|(sys/)?time\.h|pthread\.h|asio\.hpp)$"
     r"|asio/|boost/asio|sys/socket|netinet/|arpa/", r"(?!libsim/)|libsim/src/parallel/",
     "libsim has no threads, machine clocks, sockets or terminal"),
    # A failed assertion prints to standard error before it aborts: no caller can handle it.
    (r"iostream$", r"(?!libsim/)|libsim/src/core/assert\.cpp$",
     "libsim has no threads, machine clocks, sockets or terminal"),
    (r"playerlike/|libplayerc|libplayerinterface/|player-|libCCMorse/|libPlayer/|imr-h/|messages/"
     r"|protocol/|host/|session/|proxies/|playerc/|drivers/|server/", r"(?!libsim/)",
     "libsim knows no client"),
    (r"simulation/|sim/simulation/(?!scene_snapshot\.h$)",
     r"(?!libsim/(src|include/sim)/render/)", "pictures are drawn from a snapshot only"),
    (r"sim/", r"(?!libplayerlike/include/(libplayer|libCCMorse/|libPlayer/|imr-h/))",
     "clients are C++14, libsim's headers are C++20"),
    (r"protocol/", r"(?!libplayerlike/(src|include/playerlike)/host/)"
                   r"|libplayerlike/src/host/results/(run_log|reading_json|report_fields|recording_format)\.cpp$",
     "of a host only log, report and recording of a run are written in the protocol's words"),
    (r"asio(\.hpp$|/)", r"(?!libplayerlike/)|libplayerlike/src/(server|remote)/",
     "sockets belong in libplayerlike/src/server and libplayerlike/src/remote"),
    (rf"(libsim/(src|include/sim)/)?({'|'.join(SIM)})/", r"(?!apps/)", "programs include public headers only"),
]]

MACHINE = re.compile(
    r"\b(steady_clock|system_clock|high_resolution_clock|clock_gettime|gettimeofday|random_device"
    r"|default_random_engine|srand|std::rand|std::exit|quick_exit|std::cout|std::cerr|f?printf)\b")

SIM_PREFIX = re.compile(r"libsim/include/sim/|libsim/src/|sim/")
PLAYERLIKE_PREFIX = re.compile(r"libplayerlike/include/playerlike/|libplayerlike/include/"
                               r"|libplayerlike/src/|playerlike/|apps/")


def first_folder(path):
    return path.split("/")[0] if "/" in path else ""


def sim_folder(path):
    """The folder of libsim of a source or an include: "sim/core/x.h" and "core/x.h" give "core"."""
    return first_folder(path[m.end():] if (m := SIM_PREFIX.match(path)) else path)


def playerlike_folder(path):
    """The folder of libplayerlike or apps of a source or an include: "playerlike/host/x.h" and
    "libplayerlike/src/host/x.h" give "host", "apps/playpen/grade/x.cpp" gives "playpen/grade". The
    places of headers in old versions of Player are one folder, "player-"."""
    place = path[m.end():] if (m := PLAYERLIKE_PREFIX.match(path)) else path
    if place.startswith("player-"):
        return "player-"
    if path.startswith("apps/") and (m := re.match(r"playpen/(batch|course|grade|page|view)(?=/)", place)):
        return m[0]
    if (m := re.match(r"(batch|course|grade)/", place)):
        return "playpen/" + m[1]
    return first_folder(place)


def cycle_in(graph):
    """A cycle as "a -> b -> a"; empty if there is none."""
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        return " -> ".join(reversed(error.args[1]))
    return ""


def layering(tree):
    """Includes follow the arrows of docs/architecture.md; libsim uses no clock or terminal."""
    used = {"libsim": {}, "others": {}}  # folder -> folders that its sources include
    for path, text in tree.sources("libsim", "libplayerlike", "apps"):
        in_sim = path.startswith("libsim/")
        known, folder_of = (SIM, sim_folder) if in_sim else (PLAYERLIKE, playerlike_folder)
        folder = folder_of(path)
        # playerconfig.h, replace.h and robot_types.h are beside the folders, as in Player; so is
        # playpen_batch.h, which programs in C include.
        is_loose = re.match(r"libplayerlike/include/[^/]*$|libsim/include/playpen_batch\.h$", path)
        if folder not in known and not is_loose:
            yield f"{path}:1: lies in no known folder of libsim, libplayerlike or apps"
        code = code_of(text)
        for match in INCLUDE.finditer(code):
            include = match[1]
            reasons = [why for start, allowed, why in PLACES
                       if start.match(include) and not allowed.match(path)]
            target = folder_of(include)
            if target in known and target != folder:
                used["libsim" if in_sim else "others"].setdefault(folder, set()).add(target)
                if folder in known and target not in known[folder]:
                    reasons.append(f"the arrow from {folder} to {target} does not exist")
            for why in reasons:
                yield at(path, code, match.start(1), f"includes {include}: {why}")
        if not in_sim:
            continue
        for match in MACHINE.finditer(code):
            if path != "libsim/src/core/assert.cpp" or match[0] != "std::cerr":
                yield at(path, code, match.start(),
                         f"uses {match[0]}, which a deterministic library without a terminal cannot")
    # The map of arrows has no cycle, and neither have the includes, whatever the map says.
    for graph in (SIM, PLAYERLIKE, *used.values()):
        if unknown := set().union(*graph.values()) - (SIM.keys() | PLAYERLIKE.keys()):
            yield f"tests/lint/check_sources.py:1: the map of arrows names {unknown}, which are no folders"
        if cycle := cycle_in(graph):
            yield f"tests/lint/check_sources.py:1: folders include each other: {cycle}"


def seam(tree):
    """Except for waiting, taking and sending, the class Session offers requests."""
    path = "libplayerlike/include/playerlike/session/session.h"
    code = code_of(tree.files.get(path) or "")
    begin = code.find("class Session {")
    count = len(re.findall(r"\bvirtual\b", code[begin:]))
    if begin < 0 or count > 14:
        yield f"{path}:1: class Session has {count} virtual functions, not 1 to 14"


# --- numbers: no locale in files and on wires, equal bits on every machine

LOCALE = [re.compile(r"\b(std::)?(sto[df]|stold|strto[df]|strtold|atof|sscanf)\s*\("),
          re.compile(r"printf\s*\([^;]*%[-+ #0-9.*]*[aefgAEFG]")]


C_MATHEMATICS = re.compile(r"std::(a?sin|a?cos|a?tan|atan2|hypot|cbrt|exp2?|expm1|log(?:2|10|1p)?|pow"
                           r"|a?sinh|a?cosh|a?tanh|erfc?|[lt]gamma|lerp)\s*\(")


def numbers(tree):
    """Numbers do not follow the locale: a student's program may set one with a decimal comma. Nor do
    they follow the C library's mathematics, whose last bits depend on it and on the processor."""
    for path, text in tree.sources("libsim", "libplayerlike/src", "libplayerlike/include/playerlike",
                                   "apps/playpen"):
        for match in C_MATHEMATICS.finditer(text):
            yield at(path, text, match.start(),
                     f"{match[0][:-1]} has other bits elsewhere: use sim/core/math.h")
    # Player's functions that print for users follow the locale, as Player's own do.
    for path, text in tree.sources("libsim/src", "libplayerlike/src(?!/playerc/)", "apps/playpen"):
        for pattern in LOCALE:
            for match in pattern.finditer(text):
                yield at(path, text, match.start(),
                         f"{match[0].split('(')[0]}() follows the locale: use sim/core/number_text.h")


def unused_using(tree):
    """A using-declaration of a source is used there. (clang-tidy sees this in single sources only.)"""
    for path, text in tree.sources("libsim", "libplayerlike", "apps/playpen"):
        code = code_of(text)
        for match in re.finditer(r"^\s*using (?:\w+::)+(\w+);", code, re.MULTILINE):
            if path.endswith(".cpp") and len(re.findall(rf"\b{match[1]}\b", code)) == 1:
                yield at(path, code, match.start(1), f"'using {match[1]}' is not used: delete it")


# --- size: files and functions that can be read in one sitting

FILE_LINES = 700
FUNCTION_LINES = 80
# Functions that may be longer: (file, first line) -> lines that they may have. The list may only
# shrink.
LONG_FUNCTIONS = {
    # Most of it is the text of a script.
    ("apps/playpen/completion.cpp", "std::string bash_script(const CommandLine& line) {"): 84,
}


def functions_of(text):
    """(line, first line, lines) of functions formatted by clang-format: from the line that ends with
    the opening brace to the closing brace. Statements and lambdas may look like functions, but they
    are shorter than the function that contains them."""
    lines = text.split("\n")
    code = code_of(text).split("\n")
    braces = [line.count("{") - line.count("}") for line in code]
    for begin, line in enumerate(code):
        if line.rstrip().endswith(" {") and ")" in line:
            end = begin
            open_braces = 1  # also if the line closes another one
            while open_braces > 0 and end + 1 < len(code):
                end += 1
                open_braces += braces[end]
            yield begin + 1, lines[begin].strip(), end - begin + 1


def size(tree):
    """Files have 700 lines at most, functions 80. Tests, which are lists of cases, may have more."""
    excused = set()
    for path, text in tree.sources("libsim", "libplayerlike", "apps"):
        count = text.count("\n")
        if count > FILE_LINES:
            yield f"{path}:1: has {count} lines, not {FILE_LINES} at most: divide it along what it owns"
        for line, head, count in functions_of(text):
            most = LONG_FUNCTIONS.get((path, head), FUNCTION_LINES)
            if most != FUNCTION_LINES:
                excused.add((path, head))
                if count <= FUNCTION_LINES:
                    yield f"{path}:{line}: '{head}' is short: take it off LONG_FUNCTIONS"
            if count > most:
                yield f"{path}:{line}: '{head}' has {count} lines, not {most} at most"
    for path, head in LONG_FUNCTIONS.keys() - excused:
        if posixpath.dirname(path) in tree.paths:
            yield f"{path}:1: '{head}' is not there: take it off LONG_FUNCTIONS"


# --- words: plainer ones have replaced them

# Word -> what to write instead. A "+" divides each, so that this file does not contain it. The words
# of a group may be on different lines of a comment.
BANNED_PARTS = {
    "think+er": "thread id",
    "gone+_m": "cumulative_max_travel_m",
    "lock+_soon": "lock_with_priority",
    "kdisappoint+ment": "what decays, and in which unit",
    "is_+sound": "is_valid",
    "carry+_out": "execute",
}
BANNED_WHOLE = {  # only as a whole word, not as a part of one
    "st+irs": "is_moving",
    "men+ded": "repaired",
    "carried+ out": "executed",
}


def banned_in(text, parts, whole):
    """(offset, word, replacement) of each banned word in a text."""
    text = text.lower()
    for is_whole, words in ((False, parts), (True, whole)):
        for key, instead in words.items():
            word = key.replace("+", "")
            if word.split()[0] not in text:
                continue
            pattern = r"[\s/*#]+".join(re.escape(part) for part in word.split())
            if is_whole:
                pattern = rf"(?<![a-z0-9]){pattern}(?![a-z0-9])"
            for match in re.finditer(pattern, text):
                yield match.start(), word, instead


def words(tree):
    """Banned words are in no file and no name, except in CHANGELOG.md, which is about the past."""
    for path, text in tree.files.items():
        if path == "CHANGELOG.md":
            continue
        for where in (path, text or ""):
            for offset, word, instead in banned_in(where, BANNED_PARTS, BANNED_WHOLE):
                yield at(path, where, offset, f"'{word}': write {instead}")


# --- docs: links, lists and names of the pages

FENCE = re.compile(r"^```.*?(^```[^\n]*|\Z)", re.DOTALL | re.MULTILINE)


def without_fences(text):
    return FENCE.sub(lambda match: "\n" * match[0].count("\n"), text)


def links_of(text):
    """(offset, target) of links and pictures in prose, except links to the web."""
    prose = re.sub(r"`[^`\n]*`", lambda m: "x" * len(m[0]), without_fences(text))
    for match in re.finditer(r"\]\(([^()\s]+(\([^()\s]*\))?)\)", prose):
        if not re.match("https?://", match[1]):
            yield match.start(), match[1]


def anchors_of(text):
    """Anchors of headings: lower case, hyphens for blanks, without other characters."""
    return {re.sub(r"[^a-z0-9_-]", "", heading.lower().replace(" ", "-"))
            for heading in re.findall(r"^#+ (.*)$", without_fences(text), re.MULTILINE)}


def links(tree):
    """Links lead to files and headings that exist."""
    for page, text in tree.texts(r"([^/]*|(docs|apps)/.*)\.md$"):
        for offset, link in links_of(text):
            target, _, anchor = link.partition("#")
            path = posixpath.normpath(posixpath.join(posixpath.dirname(page), target))
            path = page if target == "" else "" if path == "." else path
            if path not in tree.paths:
                yield at(page, without_fences(text), offset, f"no such file: {link}")
            elif anchor and anchor not in anchors_of(tree.files.get(path) or ""):
                yield at(page, without_fences(text), offset, f"no such heading: {link}")


def index(tree):
    """docs/index.md lists every page."""
    listed = {target for _, target in links_of(tree.files.get("docs/index.md") or "")}
    for page, _ in tree.texts(r"docs/.*\.md$"):
        if page != "docs/index.md" and page.removeprefix("docs/") not in listed:
            yield f"docs/index.md:1: does not list {page}"


def glossary(tree):
    """The glossary is alphabetical."""
    page = "docs/glossary.md"
    text = tree.files.get(page) or ""
    rows = list(re.finditer(r"^\| ([^|\n]+) \|", text, re.MULTILINE))[1:]  # after the heading
    for before, row in zip(rows, rows[1:]):
        if row[1].lower() < before[1].lower():
            yield at(page, text, row.start(), f"'{row[1]}' comes before '{before[1]}'")


def which_world(tree):
    """Each row of docs/which_world.md runs the world that it links to."""
    page = "docs/which_world.md"
    text = tree.files.get(page) or ""
    row = re.compile(r"\| \[(\w+)\]\(\.\./worlds/(\S+)\) \| `playpen run (\w+) ")
    for match in row.finditer(text):
        file = posixpath.splitext(posixpath.basename(match[2]))[0]
        if not match[1] == match[3] == file:
            yield at(page, text, match.start(), f"'{match[1]}' runs {match[3]} and links to {file}")


TEST = re.compile(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)")


def promises(tree):
    """The tests that docs/trust.md names in its tables exist; '*' is a wildcard."""
    page = "docs/trust.md"
    text = tree.files.get(page) or ""
    tests = "\n".join(f"{suite}.{name}" for _, source in tree.texts(r"tests/.*\.cpp$")
                      for suite, name in TEST.findall(source))
    for row in re.finditer(r"^\|.*$", text, re.MULTILINE):
        for name in re.findall(r"`([A-Z][A-Za-z0-9]*\.[A-Za-z0-9_*]+)`", row[0]):
            pattern = "^" + re.escape(name).replace(r"\*", ".*") + "$"
            if not re.search(pattern, tests, re.MULTILINE):
                yield at(page, text, row.start(), f"there is no test {name}")


ERROR_ID = re.compile(
    r'"((?:file|json|world|device|map|run|stage|task|class|plan|server|access)/[a-z0-9-]+)"')


def error_ids(tree):
    """docs/errors.md explains each error's name in the sources, and no other."""
    page = "docs/errors.md"
    text = tree.files.get(page) or ""
    listed = {m[1]: m.start() for m in re.finditer(r"^### `([a-z]+/[a-z0-9-]+)`", text, re.MULTILINE)}
    # The pages of the protocols explain the errors in answers to clients.
    elsewhere = "".join(tree.files.get(f"docs/{name}.md") or "" for name in ("protocol", "remote"))
    used = set()
    for path, source in tree.texts(r"(libsim/src|libplayerlike/src|apps)/.*\.(h|cpp)$"):
        for found in ERROR_ID.finditer(source):
            name = found[1]
            of_servers = name.startswith(("server/", "access/"))
            if name not in used | set(listed) and not (of_servers and f"`{name}`" in elsewhere):
                yield at(path, source, found.start(), f"{page} does not explain {name}")
            used.add(name)
    for name, place in listed.items():
        if name not in used:
            yield at(page, text, place, f"{name} is used no more")


# Words that begin a story instead of naming a subject.
NARRATIVE = re.compile(r"(A|An|The|Who|What|So|It|Does|Do)(?=[A-Z])")


def test_names(tree):
    """A test's name is Subject_State_Result: one to three parts in plain words, at most 60 characters."""
    part = r"[A-Z][A-Za-z0-9]*"
    for path, source in tree.texts(r"tests/.*\.(cpp|cc|h)$"):
        for match in TEST.finditer(source):
            name = match[2]
            if not re.fullmatch(f"{part}(_{part}){{0,2}}", name) or len(name) > 60 or NARRATIVE.match(name):
                yield at(path, source, match.start(), f"the test's name {name} is not Subject_State_Result")


# --- add_a_device: the page that explains the compass

def add_a_device(tree):
    """docs/add_a_device.md shows the code of the sources and names each file of the compass."""
    page = "docs/add_a_device.md"
    text = tree.files.get(page) or ""
    compass = re.compile("[Cc]ompass")  # not COMPASS, because Player has a constant of that name
    named = set(re.findall(r"^\| `([^`]+)` \|", text, re.MULTILINE))
    of_program = {path for path, source in tree.texts(r"(?!tests/|docs/|worlds/|CHANGELOG\.md)")
                  if compass.search(source)}
    for file in sorted(named):
        if not compass.search(tree.files.get(file) or ""):
            yield f"{page}:1: names {file}, which does not mention the compass"
    for file in sorted(of_program - named):
        yield f"{page}:1: does not name {file}, which mentions the compass"
    if len(of_program) > 6:
        yield f"{page}:1: the compass changes {len(of_program)} files, not 6 at most"
    blocks = list(re.finditer(r"<!-- from: (\S+) -->\n```cpp\n(.*?)\n```", text, re.DOTALL))
    for block in blocks:
        if block[2] not in (tree.files.get(block[1]) or ""):
            yield at(page, text, block.start(), f"shows other code than {block[1]} has")
    if len(blocks) != text.count("<!-- from: ") or len(blocks) < 7:
        yield f"{page}:1: {len(blocks)} blocks of code follow a 'from:', not all or fewer than 7"


# What a rule must find to read at all: (pattern of paths, pattern in the text, least number).
LEAST = [
    (r"libsim/.*\.(h|cpp)$", r"#include", 500),
    (r"libplayerlike/.*\.(h|cpp)$", r"#include", 500),
    (r"apps/.*/explorer\.cc$", r"#include", 1),  # programs of the course are .cc files
    (r"docs/.*\.md$", r"\]\(", 500),
    (r"docs/glossary\.md$", r"\n\| [^|]+ \|", 50),
    (r"docs/which_world\.md$", r"\| \[\w+\]\(\.\./worlds/\S+\) \| `playpen run ", 16),
    (r"docs/trust\.md$", r"`[A-Z][A-Za-z0-9]*\.[A-Z]", 21),
]


def least(tree):
    """The other rules have something to read."""
    for paths, pattern, number in LEAST:
        count = sum(len(re.findall(pattern, text)) for _, text in tree.texts(paths))
        if count < number:
            yield f"{paths}:1: has {count} matches of {pattern}, not {number} or more"


RULES = [layering, seam, numbers, unused_using, size, words, links, index, glossary, which_world,
         promises, error_ids, test_names, add_a_device, least]


# --- Tests of the rules themselves: each planted fault is found, and its neighbour is not.

def self_test():
    failures = 0

    def expect(what, found, expected):
        nonlocal failures
        found = list(found)
        if len(found) != len(expected) or not all(e in f for e, f in zip(expected, found)):
            print(f"{what}:\n  expected {expected}\n  found    {found}")
            failures += 1

    def rule(check, files, *expected):
        expect(f"{check.__name__} in {files}", check(Tree(files)), expected)

    def includes(path, include, *expected):
        rule(layering, {path: f'#include "{include}"\n'}, *expected)

    expect("includes", [m[1] for m in INCLUDE.finditer(code_of(
        '#include <a/b.h>\n// #include <c>\n/* #include <d>\n#include <e>\n*/\n  # include "f.h"  // g\n'
        'auto s = R"(\n#include <h>\n)";\n'))], ["a/b.h", "f.h"])
    expect("code", [code_of('a("\\"b", \'"\', 1\'000, R"x(c)")x"); // d')], ['a("", "", 1\'000, ""); '])

    includes("libsim/include/sim/core/x.h", "sim/world/description.h", "x.h:1: includes sim/world")
    includes("libsim/src/scan/x.cpp", "physics/physics_world.h", "from scan to physics")
    includes("libsim/src/simulation/x.cpp", "sim/render/render.h", "from simulation to render")
    includes("libsim/src/render/x.cpp", "sim/simulation/simulation.h", "snapshot")
    includes("libsim/src/render/x.cpp", "sim/simulation/scene_snapshot.h")
    includes("libsim/src/physics/x.cpp", "sim/scan/scan_kernel.h")
    includes("libsim/src/new/x.cpp", "vector", "no known folder")
    includes("libsim/src/core/x.cpp", "libplayerc++/playerc++.h", "no client")
    includes("libsim/src/core/x.cpp", "mutex", "no threads")
    includes("libsim/src/parallel/x.cpp", "mutex")
    includes("libsim/src/simulation/x.cpp", "sim/parallel/batch.h", "from simulation to parallel")
    includes("libsim/src/core/x.cpp", "iostream", "no threads")
    includes("libsim/src/core/assert.cpp", "iostream")
    includes("libsim/src/core/x.cpp", "../x.h", "include folder")
    rule(layering, {"libsim/src/core/x.cpp": "int i;\nauto t = std::chrono::steady_clock::now();"},
         "x.cpp:2: uses steady_clock")
    rule(layering, {"libsim/src/core/x.cpp": '// std::cout\nauto s = "printf";\n'})

    from_to = [("session", "host/core.h", "host"), ("virtual_time", "playerlike/host/host.h", "host"),
               ("host", "remote/socket_session.h", "remote"), ("remote", "host/core.h", "host"),
               ("proxies", "playerlike/host/host.h", "host"), ("proxies", "playerc/device.h", "playerc"),
               ("proxies", "drivers/goal_thread.h", "drivers"), ("protocol", "server/peer.h", "server"),
               ("host", "playerlike/server/server.h", "server")]
    for folder, include, target in from_to:
        includes(f"libplayerlike/src/{folder}/x.cpp", include, f"from {folder} to {target}")
    for folder, include in [("connect", "remote/socket_session.h"), ("drivers", "proxies/link.h"),
                            ("playerc", "playerc/device.h"), ("server", "asio.hpp"),
                            ("remote", "asio.hpp"), ("server", "nlohmann/json.hpp"),
                            ("protocol", "sim/core/pose.h")]:
        includes(f"libplayerlike/src/{folder}/x.cpp", include)
    includes("libplayerlike/src/new/x.cpp", "vector", "no known folder")
    includes("libplayerlike/include/robot_types.h", "vector")
    includes("libsim/include/playpen_batch.h", "stdint.h")
    includes("libsim/include/other.h", "stdint.h", "no known folder")
    includes("libplayerlike/src/host/x.cpp", "protocol/codec.h", "report and recording of a run")
    includes("libplayerlike/src/host/x.cpp", "asio/ip/tcp.hpp", "sockets belong")
    includes("libplayerlike/include/playerlike/server/x.h", "asio.hpp", "sockets belong")
    includes("libplayerlike/include/playerlike/host/x.h", "nlohmann/json.hpp", "public headers")
    includes("libplayerlike/include/libCCMorse/x.h", "sim/core/pose.h", "C++14")
    includes("libplayerlike/src/server/x.cpp", "zlib.h", "zlib")
    includes("apps/par_common/src/x.cpp", "libCCMorse/CCMorse.h", "from par_common to libCCMorse")
    includes("apps/par_intro/template/x.cc", "libCCMorse/CCMorse.h")
    includes("apps/playpen/x.cpp", "world/x.h", "public headers only")
    includes("apps/playpen/x.cpp", "X11/Xlib.h", "windows belong")
    includes("apps/playpen/batch/x.cpp", "course/x.h", "from playpen/batch to playpen/course")
    includes("apps/playpen/batch/x.cpp", "grade/x.h")
    includes("apps/playpen/course/x.cpp", "batch/x.h", "from playpen/course to playpen/batch")

    includes("libsim/src/devices/x.cpp", "box2d/box2d.h", "Box2D")
    includes("libsim/src/physics/x.cpp", "box2d/box2d.h")
    includes("libsim/src/render/x.cpp", "opencv2/core.hpp", "OpenCV belongs in the modules")
    includes("libsim/src/render/modules/x_module.cpp", "opencv2/core.hpp")
    includes("libsim/src/render/film.cpp", "libavcodec/avcodec.h", "film_module.cpp")
    includes("libsim/src/render/modules/x_module.cpp", "opencv2/highgui.hpp", "apps/playpen/view")
    includes("libsim/src/devices/x.cpp", "nlohmann/json.hpp", "JSON")
    includes("libsim/src/devices/x.cpp", "yaml-cpp/yaml.h", "YAML")
    includes("libsim/src/render/png.cpp", "png.h", "png_codec.cpp")
    includes("libsim/src/io/x.cpp", "jpeglib.h", "jpeg_codec.cpp")

    expect("cycles", [cycle_in(graph) for graph in (
        {"a": {"b"}, "b": {"c"}, "d": {"a", "c"}}, {"a": {"b"}, "b": {"c"}, "c": {"b"}},
        {"a": {"a"}})], ["", "b", "a -> a"])
    rule(layering, {"libplayerlike/src/host/x.cpp": '#include "remote/x.h"\n',
                    "libplayerlike/src/remote/x.cpp": '#include "host/x.h"\n'},
         "from host to remote", "from remote to host", "include each other")

    session = "libplayerlike/include/playerlike/session/session.h"
    rule(seam, {session: "class Session {\n" + "virtual void f();\n" * 14 + "// virtual"})
    rule(seam, {session: "class Session {\n" + "virtual void f();\n" * 15}, "15 virtual")

    rule(numbers, {"libsim/src/x.cpp": "x = std::stod(t);\ny = strtod(t, &e);"}, ":1: std", ":2: str")
    rule(numbers, {"apps/playpen/x.cpp": 'snprintf(a, n, "%s: %6.2f", b, c);'}, "printf()")
    rule(numbers, {"libsim/include/sim/x.h": "y = std::sqrt(x);\nz = std::atan2(y, x);"}, ":2: std::atan2 ")
    rule(numbers, {"apps/playpen/x.cpp": 'snprintf(a, n, "%06d of %s", b, c);',
                   "libplayerlike/src/playerc/x.cpp": "strtod(t, &e);"})

    expect("functions", [f"{head} {lines}" for _, head, lines in functions_of(
        'namespace {\nint one() { return 1; }\nint two(int a,\n        int b) const {\n'
        "  if (a == '}') return 0;  // }\n  return R\"(\n}}\n)\";\n}\nclass C {\n  void three() {\n  }\n"
        "};\n}  // namespace")], ["int b) const { 6", "void three() { 2"])
    rule(size, {"apps/x.cc": "int f() {\n" + "  g();\n" * 78 + "}\n"})
    rule(size, {"apps/x.cc": "\nint f() {\n" + "  g();\n" * 79 + "}\n"}, "x.cc:2: 'int f() {' has 81")
    rule(size, {"libsim/src/x.h": "\n" * 700})
    rule(size, {"libsim/src/x.h": "\n" * 701}, "has 701 lines")
    rule(size, {"apps/playpen/x.cpp": "\n"}, "is not there")
    rule(size, {"apps/playpen/completion.cpp":
                "std::string bash_script(const CommandLine& line) {\n}\n"}, "is short")

    rule(unused_using, {"libsim/src/a.cpp": "using sim::Pose;\nusing std::min;\nPose p; // min\n",
                        "libsim/src/a.h": "using sim::Pose;\n"}, "a.cpp:2: 'using min'")

    def banned(text, *expected):
        found = banned_in(text, {"qu+ux": "x"}, {"fr+ob": "y", "foo+ bar": "z"})
        expect(text, [f"{offset} {word}" for offset, word, _ in found], expected)

    banned("class QuuxId;\n\n  // the foo\n  // bar, 2 foo  bars\n", "6 quux", "24 foo bar")
    banned("old_quux_\nfrob(), x.frob", "4 quux", "10 frob", "20 frob")
    banned("frobs, afrob, foo barn, foobar, foo, bar, quu")
    word = "st" + "irs"
    rule(words, {"a.h": f"\n// {word}", f"{word}.png": None, "CHANGELOG.md": word}, "a.h:2:", ".png:1:")

    expect("links", [target for _, target in links_of(
        "[a](b.md) and ![c](d/e.png)\n`[f](g)`\n```\n[h](i)\n```\n[j](#k)\n[web](https://a.org/x)\n")],
           ["b.md", "d/e.png", "#k"])
    rule(links, {"docs/y.md": "## Units\n```\n# none\n```\n", "tests/run.sh": "",
                 "docs/x.md": "# A b: c\n[1](no.md) [2](y.md)\n[3](y.md#units) [4](y.md#none)\n"
                              "[5](#a-b-c) [6](#d) [7](../tests/run.sh) [8](../tests) [9](..)"},
         "x.md:2: no such file: no.md", "x.md:3: no such heading: y.md#none", "heading: #d")
    rule(index, {"docs/index.md": "[a](a/b.md)", "docs/a/b.md": "", "docs/c.md": ""}, "docs/c.md")
    rule(glossary, {"docs/glossary.md": "\n| term | x |\n|--|--|\n| A | x |\n| c | x |\n| B | x |\n"},
         "glossary.md:6: 'B'")
    rule(which_world, {"docs/which_world.md":
                       "| [a](../worlds/b/a.json) | `playpen run a -- x` |\n"
                       "| [c](../worlds/c.json) | `playpen run d -- x` |\n"
                       "| [e](../worlds/f.json) | `playpen run e -- x` |\n"}, ":2: 'c'", ":3: 'e'")
    rule(promises, {"tests/x_test.cpp": "TEST(A, BcD) {}\nTEST_F(E,\n       F_Is) {}\n",
                    "docs/trust.md": "| `A.B*D`, `E.F_*` |\n| `A.Bc` |\n| `E.F_I` |\n`A.X`\n"},
         ":2: there is no test A.Bc", ":3: there is no test E.F_I")

    rule(error_ids, {"libsim/src/x.cpp": 'a("map/one");\nb("map/two", "server/busy", "map/two");',
                     "docs/errors.md": "### `map/one`\n### `run/old`\n", "docs/remote.md": "`server/busy`"},
         "x.cpp:2: docs/errors.md does not explain map/two", "errors.md:2: run/old is used no more")

    page = "".join(f"<!-- from: {name}.h -->\n```cpp\ncompass {name}\n```\n" for name in "abcdefg")
    rule(test_names, {"tests/x_test.cpp": "TEST(A, B_IsC) {}\nTEST(A, TheB) {}\nTEST_F(A, B_C_D_E) {}\n"
                                          "TEST_P(A,\n    b) {}\nTEST(A, Theta) {}\nTEST(A, Bc) {}\n"},
         ":2: the test's name TheB", ":3: the test's name B_C_D_E", ":4: the test's name b")
    device = {"docs/add_a_device.md": "| `a.h` |\n| `tests/t.h` |\n" + page, "tests/t.h": "Compass"}
    sources = {f"{name}.h": f"compass {name}\n" for name in "abcdefg"}
    rule(add_a_device, {**device, "a.h": "compass"},
         *[f"other code than {name}.h" for name in "abcdefg"])
    rule(add_a_device, {**device, **sources}, *[f"not name {name}.h" for name in "bcdefg"], "7 files")
    rule(add_a_device, {**device, "tests/t.h": "", "docs/add_a_device.md": "| `tests/t.h` |\n"},
         "names tests/t.h", "0 blocks")
    return failures


def main(arguments):
    if arguments == ["--self-test"]:
        return 1 if self_test() else 0
    rules = {rule.__name__: rule for rule in RULES}
    if arguments == ["--help"]:
        print(__doc__ + "\n" + "\n".join(f"{name:13} {rule.__doc__}" for name, rule in rules.items()))
        return 0
    unknown = [name for name in arguments if name not in rules]
    if unknown:
        print(f"no rules: {', '.join(unknown)}; there are {', '.join(rules)}", file=sys.stderr)
        return 2
    tree = read_tree()
    findings = [finding for name in arguments or rules for finding in rules[name](tree)]
    print("\n".join(findings), end="\n" if findings else "")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
