#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Runs the commands of pages exactly as written. See usage().
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/install/pages.sh --list PAGE...
       tests/install/pages.sh --clone FOLDER --home FOLDER PAGE...

--list prints what of each page would be run, and what would not. Otherwise all commands of a page run
in its order in one shell, in the clone of Playpen and with the home folder that are given; the first one
that fails ends it. Pages are run one after the other, so that a later one may use what an earlier one has
installed.

A page's commands are its indented blocks, and its fenced blocks without a language or with sh or bash.
A fenced block in another language is a file, if a comment before it says so:
  <!-- file: NAME -->
It is written into the reader's folder, one for each page, when its turn comes. Other comments before a
block, each on a line of its own:
  <!-- run in: Playpen's folder -->       from here on in the clone, as at the page's begin
  <!-- run in: a folder of yours -->      from here on in the reader's folder
  <!-- run with: NAME of PAGE -->         lays out a file of another page in the present folder
  <!-- run together -->                   the block's first command runs while the others do, and is stopped
  <!-- not run: REASON -->                the next block is not run
  <!-- not run (COMMAND): REASON -->      this command of the next block is not run
TEXT
}

die() {
  printf 'pages: %s\n' "$@" >&2
  exit 1
}

# bare COMMAND: prints it without the comment at its end.
bare() { sed -E 's/[[:space:]]+#.*$//; s/[[:space:]]+$//' <<<"$1"; }

# file_of PAGE NAME: prints a file that a page contains.
file_of() {
  awk -v want="<!-- file: $2 -->" '
    inside && /^```/ { exit }
    inside { print }
    opening { if (!/^```/) exit; inside = 1; opening = 0 }
    $0 == want { opening = 1 }' "$1"
}

# shellcheck disable=SC2094  # a page is only read
# steps PAGE: prints a script that calls in_clone, in_own, lay_out, lay_out_here, step, background,
# end_together and excused.
steps() {
  local page=$1 number=0 line kind='' name='' block='' blank=true
  local excuse='' together=false
  local -A excused_commands=()
  local mark='' file_name=''

  at() { die "$page:$number: $*"; }

  # Ends a block of commands: joins continued lines, and decides which lines are run.
  end_commands() {
    local text='' command first=true
    while IFS= read -r command; do
      text+=$command
      if [[ $text == *\\ ]]; then
        text+=$'\n'
        continue
      fi
      command=$text text=''
      [[ -n ${command//[[:space:]]/} ]] || continue
      [[ $(bare "$command") != '' && $command != '#'* ]] || continue
      local key
      key=$(bare "$command")
      if [[ -n $excuse ]]; then
        printf 'excused %q %q\n' "$command" "$excuse"
      elif [[ -n ${excused_commands[$key]+x} ]]; then
        printf 'excused %q %q\n' "$command" "${excused_commands[$key]}"
        unset 'excused_commands[$key]'
      elif $together && $first; then
        printf 'background %q\n' "$command"
        first=false
      else
        printf 'step %q\n' "$command"
      fi
    done <<<"$block"
    [[ -z $text ]] || at "a block ends with a continued line"
    if $together; then echo 'end_together'; fi
    for key in "${!excused_commands[@]}"; do
      at "'not run' names a command that the block does not have: $key"
    done
    excuse='' together=false block='' kind=''
  }

  while IFS= read -r line || [[ -n $line ]]; do
    number=$((number + 1))
    case $kind in
      file | commands)
        if [[ $line == '```'* ]]; then
          if [[ $kind == file ]]; then
            printf 'lay_out %q %q\n' "$name" "$block"
            kind='' block=''
          else
            end_commands
          fi
        else
          block+=$line$'\n'
        fi
        blank=false
        continue
        ;;
      other)
        if [[ $line == '```'* ]]; then kind=''; fi
        blank=false
        continue
        ;;
      indented)
        if [[ $line == '    '* ]]; then
          block+=${line#    }$'\n'
          continue
        fi
        end_commands
        ;;
    esac

    if [[ $line == '<!--'* ]]; then
      # Patterns are in variables, because bash takes quotes in a pattern literally.
      local with='^<!-- run with: ([^ ]+) of ([^ ]+) -->$' not='^<!-- not run: (.+) -->$'
      local one='^<!-- not run \((.+)\): (.+) -->$' is_file='^<!-- file: ([A-Za-z0-9_./+-]+) -->$'
      if [[ $line == "<!-- run in: Playpen's folder -->" ]]; then
        echo in_clone
      elif [[ $line == '<!-- run in: a folder of yours -->' ]]; then
        echo in_own
      elif [[ $line == '<!-- run together -->' ]]; then
        together=true
      elif [[ $line =~ $with ]]; then
        local other name=${BASH_REMATCH[1]} text
        other=$(dirname "$page")/${BASH_REMATCH[2]}
        [[ -f $other ]] || at "there is no page $other"
        text=$(file_of "$other" "$name")
        [[ -n $text ]] || at "$other has no file $name"
        printf 'lay_out_here %q %q\n' "$name" "$text"$'\n'
      elif [[ $line =~ $one ]]; then
        excused_commands[${BASH_REMATCH[1]}]=${BASH_REMATCH[2]}
      elif [[ $line =~ $not ]]; then
        excuse=${BASH_REMATCH[1]}
      elif [[ $line =~ $is_file ]]; then
        file_name=${BASH_REMATCH[1]}
      else
        at "what does this comment mean? $line"
      fi
      mark=$number
      blank=true
      continue
    fi

    if [[ $line == '```'* ]]; then
      block=''
      if [[ -n $file_name ]]; then
        kind=file name=$file_name file_name=''
      elif [[ $line =~ ^\`\`\`(sh|bash)?$ ]]; then
        kind=commands
      else
        kind=other
      fi
    elif [[ $line == '    '* ]] && $blank; then
      kind=indented block=${line#    }$'\n'
    elif [[ -n ${line//[[:space:]]/} ]]; then
      if [[ -n $file_name || -n $excuse || ${#excused_commands[@]} != 0 ]] || $together; then
        at "the comment in line $mark has no block after it"
      fi
    fi
    if [[ -z ${line//[[:space:]]/} ]]; then blank=true; else blank=false; fi
  done <"$page"
  [[ $kind != indented ]] || end_commands
  [[ -z $kind ]] || at "a fenced block is not closed"
  if [[ -n $file_name || -n $excuse || ${#excused_commands[@]} != 0 ]]; then
    at "the comment in line $mark has no block after it"
  fi
}

clone='' home='' list=false
while (($# > 0)); do
  case $1 in
    --help | -h)
      usage
      exit 0
      ;;
    --list) list=true && shift ;;
    --clone)
      clone=$(cd "${2:?pages: --clone needs a folder}" && pwd)
      shift 2
      ;;
    --home)
      home=${2:?pages: --home needs a folder}
      mkdir -p "$home"
      home=$(cd "$home" && pwd)
      shift 2
      ;;
    -*) die "unknown option '$1'; see --help" ;;
    *) break ;;
  esac
done
if (($# == 0)) || { ! $list && [[ -z $clone || -z $home ]]; }; then
  usage >&2
  exit 2
fi

if $list; then
  # shellcheck disable=SC2317  # what `steps` prints calls them
  for page in "$@"; do
    script=$(steps "$page")
    commands=0
    step() { printf '  run      %s\n' "${1//$'\n'/ }" && commands=$((commands + 1)); }
    background() { step "$1"; }
    excused() { printf '  not run  %s (%s)\n' "${1//$'\n'/ }" "$2"; }
    in_clone() { :; }
    in_own() { :; }
    end_together() { :; }
    lay_out() { printf '  file     %s\n' "$1"; }
    lay_out_here() { lay_out "$1"; }
    echo "$page"
    eval "$script"
    ((commands > 0)) || die "$page has no command that is run"
  done
  exit 0
fi

# The prelude of a page's shell. No variable of the caller's environment is visible to a command.
read -r -d '' prelude <<'EOF_PRELUDE' || true
set -uo pipefail
own=$HOME/$PAGE_NAME
rm -rf -- "$own"
mkdir -p -- "$own"
cd "$CLONE"
failed() { printf 'pages: %s: failed: %s\n' "$PAGE" "$1" >&2 && exit 1; }
in_clone() { cd "$CLONE" || exit 1; }
in_own() { cd "$own" || exit 1; }
lay_out() { mkdir -p -- "$own/$(dirname -- "$1")" && printf '%s' "$2" >"$own/$1" || failed "writing $1"; }
lay_out_here() { printf '%s' "$2" >"$1" || failed "writing $1"; }
excused() { printf -- '--- not run (%s): %s\n' "$2" "$1"; }
together=''
step() {
  printf -- '--- %s\n' "$1"
  local start=$SECONDS
  if [[ -n $together ]]; then
    together+=$1$'\n'
    return
  fi
  eval "$1" </dev/null || failed "$1"
  if ((SECONDS - start > 4)); then printf -- '--- (%d s)\n' $((SECONDS - start)); fi
}
background() { printf -- '--- (together with what follows) %s\n' "$1" && together=$1$'\n'; }
end_together() {
  local text=$together
  together=''
  # Isolated ports, where the system provides them.
  local alone=()
  if unshare -rn ip link set lo up 2>/dev/null; then alone=(unshare -rn); fi
  TEXT=$text "${alone[@]}" bash -c '
    if [[ $1 == alone ]]; then ip link set lo up; fi
    mapfile -t commands <<<"$TEXT"
    log=$(mktemp)
    eval "exec ${commands[0]}" >"$log" 2>&1 &
    first=$!
    # The server is ready after it has printed where it listens.
    until grep -q listening "$log"; do
      kill -0 "$first" 2>/dev/null || { cat "$log"; exit 1; }
      sleep 0.1
    done
    status=0
    for command in "${commands[@]:1}"; do eval "$command" </dev/null || status=1; done
    kill "$first"
    wait "$first"
    cat "$log"
    rm -f "$log"
    exit "$status"' - "${alone[0]:+alone}" || failed "$text"
}
EOF_PRELUDE

environment=("PATH=$PATH" "HOME=$home" "LANG=${LANG:-C.UTF-8}")
for name in CCACHE_DIR CCACHE_BASEDIR TMPDIR; do
  if [[ -n ${!name:-} ]]; then environment+=("$name=${!name}"); fi
done
# A different home folder has a different cache.
if [[ -z ${CCACHE_DIR:-} ]] && command -v ccache >/dev/null 2>&1; then
  environment+=("CCACHE_DIR=$(ccache --get-config cache_dir)")
fi
for page in "$@"; do
  script=$(steps "$page")
  printf '=== %s\n' "$page"
  env -i "${environment[@]}" "CLONE=$clone" "PAGE=$page" "PAGE_NAME=$(basename "$page" .md)" \
    bash -c "$prelude"$'\n'"$script"
done
