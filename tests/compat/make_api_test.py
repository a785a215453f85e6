#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Writes programs that use all of Player's interface, from its tables in player-api/.

api_test.cpp names every class and member of libplayerc++ with its exact type, calls every overload
with each number of arguments that it takes, and looks at every constant, data type and function of
the C library. api_test.c does so for the C library from C, and can be linked. They only have to
compile; nothing that stands in them is forgotten, since it is all that the tables have.
"""

import argparse
import pathlib
import re
import sys

HEAD = "// Written by make_api_test.py from the tables in player-api; do not change it.\n"

# Members of the tables that need another form than a plain function.
SPECIAL = {
    ("PlayerClient", "mutex_t mMutex"): """
  PlayerClient::mutex_t::scoped_lock lock(object->mMutex);
  lock.unlock();
  static_assert(std::is_same<decltype((object->mMutex)), PlayerClient::mutex_t&>::value, "");
""",
    ("ClientProxy", "template<typename T> connection_t ConnectReadSignal(T aSubscriber)"): """
  ClientProxy::connection_t of_function = object->ConnectReadSignal(&call_me);
  ClientProxy::connection_t of_lambda = object->ConnectReadSignal([] { call_me(); });
  ClientProxy::connection_t of_bind = object->ConnectReadSignal(std::bind(&call_me));
  of_function.disconnect();
  object->DisconnectReadSignal(of_lambda);
  use(of_bind);
""",
}

CXX_BEGIN = """#include <libplayerc++/playerc++.h>

#include <cstddef>
#include <functional>
#include <type_traits>

// What programs include beside it, and as programs for a certain version do.
#include <libplayerc++/clientproxy.h>
#include <libplayerc++/playerc++config.h>
#include <libplayerc++/playerclient.h>
#include <libplayerc++/playererror.h>
#include <libplayerc/playerc.h>
#include <libplayercommon/playercommon.h>
#include <libplayercore/player.h>
#include <libplayercore/playercommon.h>
#include <libplayererror/error.h>
#include <libplayerinterface/player.h>
#include <libplayerinterface/player_interfaces.h>
#include <player-2.0/libplayerc++/playerc++.h>
#include <player-2.1/libplayerc++/playerc++.h>
#include <player-3.0/libplayerc++/playerc++.h>
#include <player-3.1/libplayerc++/playerc++.h>
#include <playerconfig.h>

using namespace std;
using namespace PlayerCc;

namespace {

template <typename T>
void use(const T&) {}

// An argument of a call that is compiled and never made.
template <typename T>
T& arg() {
  static typename std::remove_const<T>::type* nothing = nullptr;
  return *nothing;
}

constexpr bool same_text(const char* a, const char* b) {
  return *a == *b && (*a == 0 || same_text(a + 1, b + 1));
}

void call_me() {}

// As the tables call it.
typedef ClientProxy::connection_t connection_t;
"""

CXX_END = """
// What subclasses of ClientProxy touch.
class Subclass : public ClientProxy {
 public:
  Subclass(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) { Subscribe(aIndex); }
  ~Subclass() { Unsubscribe(); }
  int Value() const { return GetVar(mValue); }
  void Values(int* aTo) const { GetVarByRef(&mValue, &mValue + 1, aTo); }
  void Touch() {
    scoped_lock_t lock(mPc->mMutex);
    playerc_client_t* client = mClient;
    playerc_device_t* info = mInfo;
    mFresh = client == nullptr && info != nullptr;
  }
  read_signal_t* Signal() { return nullptr; }

 protected:
  void Subscribe(uint32_t aIndex) { use(aIndex); }
  void Unsubscribe() {}

 private:
  int mValue = 0;
};

void check_subclass(PlayerClient* client) {
  Subclass object(client, 0);
  object.Touch();
  object.Values(nullptr);
  use(object.Value());
  use(object.Signal());
}

// Functions and constants of namespace PlayerCc beside the classes.
void check_functions() {
  double number = PlayerCc::rtod(1.0) + PlayerCc::dtor(1.0) + PlayerCc::normalize(4.0);
  number += rtod(1.0) + dtor(1.0) + normalize(4.0);
  number += min(1.0, 2.0) + max(1.0, 2.0) + limit(1.0, 2.0, 3.0) + min(1, 2) + max(1, 2) +
            limit(1, 2, 3);
  number += PlayerCc::min(1.0, 2.0) + PlayerCc::max(1.0f, 2.0f) + PlayerCc::limit(1, 2, 3);
  number += DTOR(90) + RTOD(1.0) + NORMALIZE(4.0) + MIN(1, 2) + MAX(1, 2) + TRUE + M_PI;
  uint whole = 1;
  use(whole);
  use(number);
  static_assert(PlayerCc::PLAYER_PORTNUM == 6665, "");
  static_assert(std::is_same<decltype(PlayerCc::PLAYER_PORTNUM), const int>::value, "");
  static_assert(std::is_same<decltype(PlayerCc::PLAYER_HOSTNAME), const std::string>::value, "");
}

// Errors are caught by value as often as by reference, and printed.
void check_errors() {
  try {
    call_me();
  } catch (PlayerCc::PlayerError& e) {
    std::cerr << e << std::endl;
  }
  try {
    call_me();
  } catch (PlayerError e) {
    cerr << e << endl;
  }
}

}  // namespace

// Keeps the compiler from calling all of the above unused.
void api_test_entry();
void api_test_entry() {
  use(&check_subclass);
  use(&check_functions);
  use(&check_errors);
@USES@}
"""


def fail(text):
    sys.exit("make_api_test.py: " + text)


def split_top(text, separator=","):
    """Splits where the separator stands outside of all brackets."""
    parts, depth, part = [], 0, ""
    for char in text:
        depth += char in "(<[{"
        depth -= char in ")>]}"
        if char == separator and depth == 0:
            parts.append(part.strip())
            part = ""
        else:
            part += char
    if part.strip():
        parts.append(part.strip())
    return parts


def type_of(declaration):
    """The type that a declaration of one thing gives to its name, and the name."""
    pointer = re.match(r"^(.*)\(\s*\*\s*(\w+)\s*\)\s*([\[(].*)$", declaration)
    if pointer:  # a pointer to a function or to an array
        return f"{pointer[1].strip()} (*){pointer[3]}", pointer[2]
    match = re.match(r"^(.*?)(\w+)\s*((?:\[[^\]]*\])*)$", declaration.strip())
    if not match or not match[1].strip():
        fail(f"cannot read the declaration '{declaration}'")
    return match[1].strip() + match[3], match[2]


class Parameter:
    def __init__(self, text):
        parts = split_top(text, "=")
        self.optional = len(parts) > 1
        nameless = re.match(r"^(\w+|.*[*&])$", parts[0])
        kind = parts[0] if nameless else type_of(parts[0])[0]
        # As a parameter, an array is a pointer, and its const does not matter to callers.
        self.type = re.sub(r"\[[^\]]*\]$", "*", kind)
        bare = re.sub(r"^const (?!.*[*&]$)", "", self.type)
        self.argument = f"arg<{bare.rstrip('&').strip()}>()"


class Function:
    def __init__(self, text):
        match = re.match(r"^(?:(?P<type>.*?)\s*)??(?P<name>~?\w+|operator\s*\[\])\s*"
                         r"\((?P<parameters>.*)\)\s*(?P<const>const)?$", text)
        if not match:
            fail(f"cannot read the member '{text}'")
        self.type = (match["type"] or "").replace("virtual", "").strip()
        self.name = match["name"].replace(" ", "")
        self.const = match["const"] or ""
        inside = match["parameters"].strip()
        self.parameters = [] if inside == "void" else [Parameter(p) for p in split_top(inside)]

    def arities(self):
        """How many arguments a call can have."""
        required = sum(not p.optional for p in self.parameters)
        return range(required, len(self.parameters) + 1)

    def types(self, arity=None):
        return ", ".join(p.type for p in self.parameters[:arity])

    def arguments(self, arity):
        return ", ".join(p.argument for p in self.parameters[:arity])


def read_classes(path):
    """Class name -> its members as the table has them, in order."""
    classes = {}
    for block in re.split(r"^## ", path.read_text(encoding="utf-8"), flags=re.M)[1:]:
        name = block.split()[0]
        classes[name] = re.findall(r"^- `(.*)`$", block, re.M)
        if not classes[name]:
            fail(f"{path}: the class {name} has no members")
    return classes


def read_table(path, columns):
    """The rows of a table without its heading."""
    rows = [line.split("\t") for line in path.read_text(encoding="utf-8").splitlines()[1:] if line]
    for row in rows:
        if len(row) < columns:
            fail(f"{path}: a row has {len(row)} columns, not {columns}: {row}")
    return rows


def read_c_library(path):
    """The functions of the C library, and its structs with their fields."""
    text = path.read_text(encoding="utf-8")
    functions_part, structs_part = re.split(r"^## Structs.*$", text, flags=re.M)
    functions = re.findall(r"^- `(.*)`$", functions_part, re.M)
    structs = re.findall(r"^- `(\w+)`: (.*)$", structs_part, re.M)
    if not functions or not structs:
        fail(f"{path}: no functions or no structs")
    return [Function(f) for f in functions], structs


def fields_of(text):
    """The fields of a struct: pairs of type and name."""
    fields = []
    for declaration in split_top(text, ";"):
        first, *more = split_top(declaration)
        kind, name = type_of(first)
        fields.append((kind, name))
        base = re.sub(r"[\s*]*(\[[^\]]*\])*$", "", kind)
        for declarator in more:
            kind, name = type_of(base + " " + declarator)
            fields.append((kind, name))
    return fields


def cxx_class(name, members):
    """A function that uses a class, and the checks of it that need no object."""
    lines = []
    body = [f"\nvoid check_{name}({name}* object) {{"]
    for text in members:
        special = SPECIAL.get((name, text))
        if special:
            body.append(special.rstrip())
            continue
        function = Function(text)
        if function.name == "~" + name:
            continue
        if function.name == name:
            for arity in function.arities():
                types = "".join(", " + p.type for p in function.parameters[:arity])
                lines.append(f"static_assert(std::is_constructible<{name}{types}>::value, "
                             f'"{text}");'.replace('"' + text + '"', '""'))
            continue
        body.append(f"  {{\n    {function.type} ({name}::*member)({function.types()}) "
                    f"{function.const} = &{name}::{function.name};\n    use(member);\n  }}")
        target = f"const_cast<const {name}*>(object)" if function.const else "object"
        for arity in function.arities():
            call = f"{target}->{function.name}({function.arguments(arity)})"
            if function.name == "operator[]":
                call = f"(*{target})[{function.arguments(arity)}]"
            body.append(f"  {call};" if function.type == "void" else f"  use({call});")
    if name == "PlayerError":
        lines.append(f"static_assert(std::is_copy_constructible<{name}>::value, \"\");")
    elif name != "PlayerClient":
        lines.append(f"static_assert(std::is_base_of<ClientProxy, {name}>::value, \"\");")
        lines.append(f"static_assert(std::has_virtual_destructor<{name}>::value, \"\");")
        if name != "ClientProxy":
            lines.append(f"static_assert(std::is_constructible<{name}, PlayerClient*, int>::value, "
                         '"");')
    body.append("  std::cout << *object << std::endl;\n  cerr << *object;")
    body.append("}")
    return "\n" + "\n".join(lines + body) + "\n"


def constant_checks(rows):
    """One check a constant; the enumeration of the table is written as a row too."""
    out = []
    for _, name, value in (row[:3] for row in rows):
        value = value.split("  payload")[0].strip()
        if name.startswith("enum "):
            for number, constant in enumerate(split_top(value)):
                out.append(f'static_assert({constant} == {number}, "");')
            continue
        out.append(f"#ifndef {name}\n#error \"{name} is no macro\"\n#endif")
        if value.startswith('"'):
            out.append(f'static_assert(same_text({name}, {value}), "");')
        else:
            out.append(f'static_assert(({name}) == ({value}), "");')
    return out


def struct_checks(name, text):
    """The types, the order and the places of a struct's fields; it has no others."""
    fields = fields_of(text)
    expected = f"expected_{name}"
    out = [f"struct {expected} {{ {text}; }};",
           f'static_assert(sizeof({expected}) == sizeof({name}), "");',
           f'static_assert(std::is_standard_layout<{name}>::value && std::is_trivial<{name}>::value, '
           '"");']
    for kind, field in fields:
        out.append(f'static_assert(std::is_same<decltype({name}::{field}), {kind}>::value, "");')
        out.append(f'static_assert(offsetof({name}, {field}) == offsetof({expected}, {field}), "");')
    return out


def write_cxx(path, tables, only):
    classes = read_classes(tables / "proxies.md")
    unknown = set(only or []) - set(classes)
    if unknown:
        fail(f"no such class in the tables: {', '.join(sorted(unknown))}")
    constants = read_table(tables / "constants.tsv", 3)
    interfaces = read_table(tables / "interfaces.tsv", 2)
    structs = read_table(tables / "structs.tsv", 3)
    functions, c_structs = read_c_library(tables / "playerc-c-library.md")

    out = [HEAD, CXX_BEGIN, "\n// Codes of interfaces, and constants."]
    out += [f'static_assert(PLAYER_{name.upper()}_CODE == {code}, "");'
            for name, code in (row[:2] for row in interfaces)]
    out += constant_checks(constants)
    out.append("\n// Data types, under their tags too.")
    for _, name, fields in (row[:3] for row in structs):
        tag = re.sub(r"_t$", "", name)
        out.append(f'static_assert(std::is_same<struct {tag}, {name}>::value, "");')
        out += struct_checks(name, fields)
    out.append("\n// The C library.")
    for name, fields in c_structs:
        out += struct_checks(name, fields)
    out += [f'static_assert(std::is_same<decltype({f.name}), {f.type}({f.types()})>::value, "");'
            for f in functions]
    uses = ""
    out.append("\n// Classes.")
    for name, members in classes.items():
        if only and name not in only:
            continue
        out.append(cxx_class(name, members))
        uses += f"  use(&check_{name});\n"
    out.append(CXX_END.replace("@USES@", uses))
    path.write_text("\n".join(out), encoding="utf-8")


def write_c(path, tables):
    functions, c_structs = read_c_library(tables / "playerc-c-library.md")
    structs = read_table(tables / "structs.tsv", 3)
    out = [HEAD, "#include <libplayerc/playerc.h>", "#include <libplayercommon/playercommon.h>",
           "#include <libplayerinterface/player.h>", "#include <playerconfig.h>", "#include <stddef.h>",
           "#include <stdio.h>", "", "typedef void (*any_function)(void);", "",
           "static size_t fields(void) {", "  size_t sum = 0;"]
    for name, text in [row[1:3] for row in structs] + c_structs:
        for _, field in fields_of(text):
            out.append(f"  sum += offsetof({name}, {field});")
    out += ["  return sum;", "}", "", "static int missing(void) {", "  int count = 0;"]
    # Called through a variable, so that the compiler must assume that the function may be missing.
    for number, function in enumerate(functions):
        out.append(f"  {function.type} (*volatile f{number})({function.types() or 'void'}) = "
                   f"{function.name};")
        out.append(f"  count += f{number} == NULL;")
    out += ["  return count;", "}", "", "int main(void) {",
            f'  printf("{len(functions)} functions, %d missing\\n", missing());',
            "  return missing() == 0 && fields() > 0 ? 0 : 1;", "}", ""]
    path.write_text("\n".join(out), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tables", type=pathlib.Path, required=True, help="folder of the tables")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder to write to")
    parser.add_argument("--only", help="names of classes, with commas between: leave out the others")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    write_cxx(options.out / "api_test.cpp", options.tables,
              options.only.split(",") if options.only else None)
    write_c(options.out / "api_test.c", options.tables)


if __name__ == "__main__":
    main()
