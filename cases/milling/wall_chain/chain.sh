#!/usr/bin/env bash
# From chips to a surface, one command: ./chain.sh [CNEM [FOLDER]]
# CNEM: the program (build/cnem of this tree), FOLDER: where results go (results/wall_chain). A stage whose results are
# there is not done again. Chips take four runs of about a minute of a processor each, the rest a minute together.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)
cnem=${1:-$root/build/cnem}
out=${2:-$root/results/wall_chain}
mkdir -p "$out/cases"

done_in() { [ -e "$1/status.json" ] && grep -q '"exit": 0' "$1/status.json"; }
stage() { # NAME: a case of this folder, beside the law
  done_in "$out/$1" && return
  "$cnem" run "$out/cases/$1.toml" --output "$out/$1" --force
}

cp "$here"/{cut,wall,modes,lobes,surface}.toml "$out/cases/"
if [ ! -e "$out/cases/law.toml" ]; then
  "$cnem" sweep "$root/cases/cutting/coefficients" --output "$out/chips"
  "$cnem" coefficients "$out/chips"
  cp "$out/chips/law.toml" "$out/cases/law.toml"
fi
stage modes
stage lobes
stage surface
for name in modes lobes surface; do
  echo "$name: $(sed -n 's/^ *"reason": "\(.*\)",*$/\1/p' "$out/$name/status.json")"
done
