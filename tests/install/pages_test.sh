#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Tests of pages.sh with small pages in a scratch folder. Usage: tests/install/pages_test.sh FOLDER
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=${1:?pages_test: which folder may be emptied?}
rm -rf -- "$scratch"
mkdir -p -- "$scratch/clone" "$scratch/home"
cd "$scratch"

fail() {
  printf 'pages_test: %s\n' "$@" >&2
  exit 1
}

# page: writes the page from standard input, in which ::: stands for a fence.
page() { sed 's/:::/```/' >page.md; }
run() { "$here/pages.sh" --clone clone --home home page.md >log 2>&1; }
passes() { run || fail "a page failed:" "$(cat page.md log)"; }
# fails PATTERN: the page must fail with a matching message.
fails() {
  if run; then fail "a page passed that should not:" "$(cat page.md)"; fi
  grep -qE -- "$1" log || fail "expected the message '$1':" "$(cat log)"
}

# Commands run in order, in one shell, in the folders that the page names, after the files before
# them.
page <<'TEXT'
Text with `false` in it.

    touch in_clone; export WORD="two  words"   # a comment

- a list
  that goes on

<!-- file: sub/data.txt -->
:::json
a # b
:::

<!-- run in: a folder of yours -->

:::sh
grep -x 'a # b' sub/data.txt
echo one \
  more > ~/more; echo "$WORD" > words
:::

:::cpp
int not_a_command;
:::

<!-- run in: Playpen's folder -->
<!-- not run (false): it fails -->

    touch again
    false   # not run

<!-- not run: there is no such command -->

    no_such_command
TEXT
passes
[[ -f clone/in_clone && -f clone/again && $(<home/more) == "one more" ]] || fail "wrong folders"
[[ $(<home/page/words) == "two  words" ]] || fail "a variable was lost"

# A failing command ends the page, even as the first of two; later commands are not run.
printf 'Text.\n\n    false && true\n    touch after\n' >page.md
fails 'page\.md: failed: false && true'
[[ ! -e clone/after ]] || fail "a page went on after a failure"

# No variable of this shell's environment is visible.
# shellcheck disable=SC2016  # literal text of the page
printf '\n    test -z "${SECRET:-}"\n' >page.md
SECRET=1 passes

# A server that runs while the other commands run.
page <<'TEXT'

<!-- run together -->

    echo listening; while true; do sleep 0.1; done
    touch while_serving
TEXT
sed -i 's/^    echo listening.*/    bash -c "echo listening; while true; do sleep 0.1; done"/' page.md
passes
[[ -f clone/while_serving ]] || fail "the second command did not run"
printf '<!-- run together -->\n\n    bash -c "exit 3"\n    touch without_server\n' >page.md
fails 'failed: bash -c "exit 3"'
printf '<!-- run together -->\n\n    bash -c "echo listening; exec sleep 1000"\n    false\n' >page.md
fails 'failed: '

# Invalid comments are errors, so that none excuses a command by mistake.
printf '<!-- not run (make al): no makefile -->\n\n    make all\n' >page.md
fails "page\.md:.* 'not run' names a command that the block does not have: make al"
printf '<!-- no run: oops -->\n\n    true\n' >page.md
fails 'page\.md:1: what does this comment mean'
printf '<!-- not run: no block -->\n\nText.\n\n    true\n' >page.md
fails 'line 1 has no block after it'
printf '    true\n\n<!-- file: x -->\n' >page.md
fails 'line 3 has no block after it'
printf '```sh\ntrue\n' >page.md
fails 'a fenced block is not closed'
printf '<!-- run with: a.cc of other.md -->\n\n    true\n' >page.md
fails 'there is no page \./other\.md'

# A file of another page.
# shellcheck disable=SC2016  # these are fences
printf 'Text\n\n<!-- file: a.cc -->\n```cpp\nint a;\n```\n' >other.md
printf '<!-- run in: a folder of yours -->\n<!-- run with: a.cc of other.md -->\n\n    grep -x "int a;" a.cc\n' >page.md
passes
if "$here/pages.sh" --list other.md >log 2>&1; then fail "a page without commands was listed"; fi
echo "pages_test: all passed"
