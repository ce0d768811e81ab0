#!/usr/bin/env bash
# tests/packaging.sh PROGRAM SOURCE BUILD VERSION: what users get beside the program. Every command and option of --help
# stands in the man page and is completed; an installed program runs a case from elsewhere; the version is one.
set -euo pipefail
program=$1 source=$2 build=$3 version=$4
fail() { echo "error: $*" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

[[ "$("$program" --version)" =~ ^cnem\ $version(\ \([0-9a-f]+(-dirty)?\))?$ ]] || fail "--version: $("$program" --version)"
grep -q "^version: $version$" "$source/CITATION.cff" || fail "CITATION.cff names another version"
mkdir "$work/tarball"
cmake -DVERSION="$version" -DSOURCE="$work/tarball" -DINPUT="$source/app/version.cpp.in" -DOUTPUT="$work/version.cpp" \
  -P "$source/cmake/version.cmake"
grep -q "return \"$version\";" "$work/version.cpp" || fail "the version of sources without git"

# shellcheck source=../packaging/cnem.bash
source "$source/packaging/cnem.bash"
complete_words() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _cnem; }
page=$(sed 's/\\-/-/g; s/\\f[BIR]//g' "$build/cnem.1")
complete_words "$program" ""
commands=("${COMPREPLY[@]}")
[ ${#commands[@]} -ge 12 ] || fail "commands completed: ${commands[*]}"
for command in "${commands[@]}"; do
  [[ $command = -* ]] && continue
  section=$(grep -A1 "^$command " <<<"$page" | head -1) || fail "the man page lacks $command"
  complete_words "$program" "$command" --
  completed=" ${COMPREPLY[*]} "
  for option in $("$program" "$command" --help | grep -oE '^ +(-h,)?--[a-z-]+' | grep -oE -- '--[a-z-]+'); do
    [[ $completed = *" $option "* ]] || fail "$command $option is not completed:$completed"
    [ "$option" = --help ] || [[ $section = *"$option"* ]] || fail "the man page lacks $command $option"
  done
done
complete_words "$program" run case.toml --set time.en
[ "${COMPREPLY[*]}" = "time.end=" ] || fail "--set completes ${COMPREPLY[*]}"
cd "$source/cases/paper/shearing_sharp"
complete_words "$program" run ca
[ "${COMPREPLY[*]}" = case.toml ] || fail "cases complete to ${COMPREPLY[*]}"

cmake --install "$build" --prefix "$work/prefix" >/dev/null
cd "$work"
prefix/bin/cnem run prefix/share/cnem/cases/paper/shearing_sharp --set cloud.spacing="0.5 mm" --set time.end="1 us" >/dev/null
[ -s results/shearing_sharp/report.html ] || fail "the installed program left no report"

cmake -S "$source/tests/install" -B "$work/user" -DCMAKE_PREFIX_PATH="$work/prefix" >user.log && cmake --build "$work/user" >>user.log 2>&1 ||
  { cat user.log; fail "a program of somebody else's cannot be built"; }
"$work/user/user_of_cnem" prefix/share/cnem/cases/paper/shearing_sharp/case.toml
