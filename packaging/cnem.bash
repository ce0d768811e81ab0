# Completion of cnem in bash. Commands and options are those that the program tells of itself; keys of --set are those
# of its case reference.
_cnem() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" --help 2>/dev/null |
      awk '/^Subcommands:/ { all = 1; next } all && NF { print $1 }') --help --version" -- "$word")
  elif [ "$before" = --set ]; then
    compopt -o nospace 2>/dev/null || true # fails outside of a completion
    mapfile -t COMPREPLY < <(compgen -S = -W "$("$program" schema --markdown 2>/dev/null | awk -F'`' '
      /^### / { table = $2; next }
      /^## / { table = "" }
      /^\| `/ && table && table !~ /NAME|\[\]/ { print table "." $2 }')" -- "$word")
  elif [[ "$word" = -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" "$command" --help 2>/dev/null | grep -o -- '^ *--[a-z-]*\|-h,--help' |
      sed 's/.*--/--/')" -- "$word")
  else
    compopt -o filenames 2>/dev/null || true
    local name ending='\.toml$'
    case $command in restart | report | movie) ending='/$' ;; esac
    while read -r name; do
      if [ -d "$name" ] || [[ "$name" =~ $ending ]]; then COMPREPLY+=("$name"); fi
    done < <(compgen -f -- "$word")
  fi
}
complete -F _cnem cnem
