# What samples/run, tests/run and .ci/run share: install what is missing, then build. Sourced by bash.
# Words go to stderr, so that stdout belongs to whatever is run; nothing is said when there is nothing to do.

source_folder=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
export HOME=${HOME:-/tmp}
# Where CMakePresets.json builds: outside the source tree, one folder a clone.
cache_folder=$HOME/.cache/tweenfall$source_folder

say() { echo "tweenfall: $*" >&2; }
fail() { say "$*"; exit 1; }

# install_missing GROUP...: the packages of these groups of .cmake/packages.
install_missing() {
  local wanted missing as_root=()
  wanted=$(awk -v groups=" $* " '!/^#/ && index(groups, " " $1 " ") {print $2}' "$source_folder/.cmake/packages")
  command -v dpkg-query > /dev/null || return 0  # not Debian: CMake will say what it does not find
  missing=$(comm -23 <(sort <<< "$wanted") \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2> /dev/null | sed -n 's/^installed //p' | sort))
  [ -n "$missing" ] || return 0
  missing=$(tr '\n' ' ' <<< "$missing")
  # One at a time: the second of two first runs finds done what it would do.
  if [ -z "${tweenfall_install_lock:-}" ] && command -v flock > /dev/null; then
    mkdir -p "$HOME/.cache/tweenfall"
    local tweenfall_install_lock=held
    { flock 8; install_missing "$@"; } 8> "$HOME/.cache/tweenfall/install.lock"
    return
  fi
  say "installing from Debian: $missing"
  if [ "$(id -u)" != 0 ]; then
    command -v sudo > /dev/null || fail "neither root nor sudo; as root, run: apt-get install $missing"
    as_root=(sudo)
  fi
  local log
  log=$(mktemp)
  # apt waits for others' locks too; lists that another run of it holds are as new as ours would be.
  { { "${as_root[@]}" apt-get update || sleep 5; } &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 install -y --no-install-recommends $missing
  } > "$log" 2>&1 < /dev/null || { cat "$log" >&2; fail "could not install: $missing"; }
  rm -f "$log"
}

# configure PRESET: when it never was, or the presets have changed since.
configure() {
  local preset=$1 folder=$cache_folder/$1 log
  mkdir -p "$folder"
  log=$folder/configure.log
  if [ ! -f "$folder/build.ninja" ] || [ "$source_folder/CMakePresets.json" -nt "$folder/build.ninja" ]; then
    (cd "$source_folder" && cmake --preset "$preset") > "$log" 2>&1 < /dev/null ||
      { cat "$log" >&2; fail "cmake could not configure the $preset build"; }
  fi
}

# build PRESET [TARGET...]: configure when needed, then compile; the compiler's words only when it has some.
build() {
  local preset=$1 folder=$cache_folder/$1
  shift
  mkdir -p "$folder"
  # Two builds in one folder write over each other: the second waits, and then finds little to do.
  {
    if command -v flock > /dev/null; then
      flock -n 8 || { say "another run builds here ($preset); waiting for it"; flock 8; }
    fi
    configure "$preset"
    # What ninja leaves running must not hold the lock.
    ninja -C "$folder" "$@" 2>&1 < /dev/null 8>&- | show_build "$preset" >&2 8>&- || fail "the $preset build failed"
  } 8> "$folder/build.lock"
}

# build_readers TARGET...: what reads input that others wrote, watched by sanitizers; all else is the release build's.
build_readers() {
  build release
  cmake --install "$cache_folder/release" --prefix "$cache_folder/installed" > "$cache_folder/installed.log" ||
    { cat "$cache_folder/installed.log" >&2; fail "could not install the release build"; }
  build readers "$@"
}

# What ninja says, less what nobody needs: progress on a terminal, else only that it builds and what compilers say.
show_build() {
  local line told=
  while IFS= read -r line; do
    case $line in
      *"] Re-checking globbed"* | *"] Re-running CMake"* | "-- "* | "ninja: no work"* | "ninja: Entering"*) ;;
      "["[0-9]*"/"*"] "*)
        [ -n "$told" ] || say "building ($1)"
        told=yes
        if [ -t 1 ]; then printf '\r\033[K%.79s' "$line"; fi
        ;;
      *) printf '%s\n' "$line" ;;
    esac
  done
  if [ -n "$told" ] && [ -t 1 ]; then printf '\r\033[K'; fi
}

# run_tests PRESET [ARGUMENT...]: ctest; what tests skipped is said before its summary.
run_tests() {
  local preset=$1
  shift
  (cd "$source_folder" && ctest --preset "$preset" -j "$(nproc)" "$@" 2>&1 < /dev/null) | {
    local line
    while IFS= read -r line && [[ $line != *"% tests passed, "* ]]; do printf '%s\n' "$line"; done
    grep -oh 'SKIPPED: .*' "$cache_folder/$preset/Testing/Temporary/LastTest.log" 2> /dev/null | sort -u || true
    if [ -n "$line" ]; then printf '%s\n' "$line"; fi
    cat
  }
}
