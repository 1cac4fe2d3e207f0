# What .ci/run and .ci/nightly share: stages by name, each timed. Sourced by bash.
export CI=true
exec < /dev/null
source "$(dirname "${BASH_SOURCE[0]}")/../.cmake/setup.sh"
cd "$source_folder"

# Tests about the source and the page, which say the same under every compiler.
about_source='^(headers|headers_catches|layering|page$)'

# run_stages NAME...: each by its function stage_NAME, up to the first that fails.
run_stages() {
  local stage started status timings=""
  install_missing build test ci
  for stage in $*; do
    echo "== $stage"
    started=$SECONDS
    # In a shell of its own: `set -e` does not reach into a function called as a condition.
    status=0
    (set -e; "stage_$stage") & wait $! || status=$?
    timings+="$(printf '%-10s %4d s' "$stage" $((SECONDS - started)))"$'\n'
    if [ "$status" != 0 ]; then
      printf '%s' "$timings"
      echo "CI FAILED: $stage"
      exit 1
    fi
  done
  printf '%s' "$timings"
  echo "CI passed in $SECONDS s"
}
