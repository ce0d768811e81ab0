# Sourced by run, test and .ci/*: installs what is missing, configures and builds. Does nothing twice.

# What libraries keep until the end of the process is no leak (AddressSanitizer).
export LSAN_OPTIONS=suppressions=$root/.ci/leaks.supp:print_suppressions=0

say() { printf '%s\n' "$*" >&2; }

# Installs the packages of setup/packages.txt, or of the list named, that this machine lacks; needs root, or sudo, only
# then.
install_packages() {
  local missing=() package list=${1:-$root/setup/packages.txt}
  while read -r package; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
  done < <(grep -v '^#' "$list")
  [ ${#missing[@]} -eq 0 ] && return 0
  say "installing Debian packages: ${missing[*]}"
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      say "error: these packages are missing, and installing them needs root or sudo"
      return 1
    fi
    as_root=(sudo)
  fi
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"; } \
    >"$log" 2>&1; then
    cat "$log" >&2
    say "error: the packages could not be installed (see above)"
    return 1
  fi
  rm -f "$log"
}

# Configures build/ once; afterwards only when an option changes.
configure() {
  local options=(-DCMAKE_BUILD_TYPE=Release -DCNEM_UNITY=ON "$@") wanted="$root/build/.configured"
  if [ "$(cat "$wanted" 2>/dev/null)" != "${options[*]}" ]; then
    say "configuring build/"
    cmake -S "$root" -B "$root/build" -G Ninja "${options[@]}" >"$root/build.log" 2>&1 || {
      cat "$root/build.log" >&2
      return 1
    }
    mv "$root/build.log" "$root/build/configure.log"
    printf '%s' "${options[*]}" >"$wanted"
  fi
}

# Builds targets (all without arguments) with as many jobs as the memory allows (about 2 GB each).
build() { build_in build "$@"; }

# build_in FOLDER [targets...]: the same in another build folder.
build_in() {
  local folder=$1 cores memory jobs
  shift
  cores=$(nproc)
  memory=$(awk '/MemAvailable/ { print int($2 / 2000000) }' /proc/meminfo)
  jobs=$((memory < cores ? (memory > 0 ? memory : 1) : cores))
  cmake --build "$root/$folder" --parallel "$jobs" ${1:+--target "$@"} >&2
}

# configure_in FOLDER options...: a build folder for a check, from a preset or from options.
configure_in() {
  local folder=$1
  shift
  mkdir -p "$root/$folder"
  cmake -S "$root" -B "$root/$folder" "$@" >"$root/$folder/configure.log" 2>&1 || {
    cat "$root/$folder/configure.log" >&2
    return 1
  }
}
