# Shared by the scripts in tools/ and .ci/: packages and builds. Sourced, never run.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# The packages of tools/packages that purpose $1 needs and the machine lacks.
missing_packages() {
  local wanted
  wanted=$(awk -v purpose="$1" '
    /^#/ || NF < 2 { next }
    $2 == "build" || (purpose != "build" && $2 == "test") || (purpose == "ci" && $2 == "ci") { print $1 }' "$root/tools/packages")
  local name
  for name in $wanted; do
    dpkg -s "$name" 2>/dev/null | grep -q '^Status: install ok installed' || echo "$name"
  done
}

# Installs what purpose $1 (build, test, ci) needs. Says in plain words what to do where that is impossible.
install_packages() {
  if ! command -v dpkg >/dev/null || ! command -v apt-get >/dev/null; then
    echo "This is not a Debian system, so packages are not installed. Needed are: $(awk '!/^#/ {print $1}' "$root/tools/packages" | xargs)"
    return 0
  fi
  local missing
  missing=$(missing_packages "$1" | xargs)
  [ -n "$missing" ] || return 0
  local as_root=""
  if [ "$(id -u)" != 0 ]; then
    if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
      as_root="sudo"
    else
      echo "Some packages are missing and installing them needs the rights of the administrator. Please run this once:"
      echo
      echo "    sudo apt-get update && sudo apt-get install --no-install-recommends $missing"
      echo
      echo "and then start me again."
      return 1
    fi
  fi
  echo "Installing: $missing"
  local log
  log=$(mktemp)
  # The package lists may be fresh enough; they are fetched only if they are not.
  if $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing >"$log" 2>&1 ||
    { $as_root apt-get update -q >>"$log" 2>&1 &&
      $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing >>"$log" 2>&1; }; then
    rm -f "$log"
    return 0
  fi
  tail -n 15 "$log"
  echo
  echo "The packages could not be installed; the reason should stand in the lines above. Most often the network is missing"
  echo "or the sources in /etc/apt are not those of Debian 12. The whole output is in $log."
  return 1
}

# The build folder of preset $1 in CMakePresets.json.
build_folder() {
  case "$1" in
    debug) echo "$root/build" ;;
    *) echo "$root/build-$1" ;;
  esac
}

# build PRESET [TARGET...]: configures if that was not done yet, then builds.
build() {
  local preset=$1 folder
  shift
  folder=$(build_folder "$preset")
  local targets=()
  [ $# = 0 ] || targets=(--target "$@")
  local launcher=()
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  export CCACHE_BASEDIR="$root" CCACHE_NOHASHDIR=1
  if [ ! -f "$folder/build.ninja" ]; then
    (cd "$root" && cmake --preset "$preset" "${launcher[@]}" >"/tmp/ncport-configure.$$" 2>&1) || {
      cat "/tmp/ncport-configure.$$"
      rm -f "/tmp/ncport-configure.$$"
      return 1
    }
    rm -f "/tmp/ncport-configure.$$"
  fi
  cmake --build "$folder" -j "${NCPORT_JOBS:-$(nproc)}" "${targets[@]}"
}
