# What .ci/run and .ci/nightly share: stages by name, each timed. Sourced by bash.
export CI=true
exec < /dev/null
source "$(dirname "${BASH_SOURCE[0]}")/../.cmake/setup.sh"
cd "$source_folder"

# Tests about the source and the page, which say the same under every compiler.
about_source='^(headers|headers_catches|layering|page$)'

# What is about numbers over long runs, whose code shorter tests run too; each takes ten seconds to minutes under
# sanitizers.
long_when_sanitized='^(anim/(crowd/(clip|size)|graph/random_graphs)'
long_when_sanitized+='|importers/document/(contact_scenarios|hostile_physics)'
long_when_sanitized+='|physics/(collision/(broad_phase|oracle|triangle_contacts)|stage/(blows|saving)|state/(copies|saving)'
long_when_sanitized+='|step/(energy|impact|integrators|momentum|riders|small_islands)))$'

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
