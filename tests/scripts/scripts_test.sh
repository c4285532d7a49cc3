#!/bin/bash
# Tests of ./run, ./check and scripts/, one case a call: scripts_test.sh CASE. Each case makes a project tree of its own, in
# a path with a space, a quote and a backslash, with stand-ins first in PATH that write down how they were called. Each
# case ends with its control: a fault is planted in the copied script or tree and the same question must then answer no.
set -u
source_root=$(dirname -- "$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")")
work=$(mktemp -d) || exit 1
trap 'rm -rf -- "$work"' EXIT
tree="$work/a \"sea\" \\ of it"
calls="$work/calls"
fail() { printf 'FAILED: %s\n' "$*" >&2; exit 1; }

# stand_in NAME TEXT: a bash program in front of the real one.
stand_in() {
  printf '#!/bin/bash\n%s\n' "$2" > "$work/bin/$1" && chmod +x "$work/bin/$1"
}

# A project tree that was built in its place, a driver in the cache, and no help from outside.
make_tree() {
  mkdir -p "$tree/scripts" "$tree/engine" "$tree/build/release" "$work/bin" "$work/home" "$work/caller" "$work/cache/seascape/driver"
  cp "$source_root/run" "$source_root/check" "$tree/"
  cp "$source_root"/scripts/*.sh "$source_root/scripts/packages.txt" "$tree/scripts/"
  printf 'int a;\n' > "$tree/engine/a.cpp"
  cat > "$tree/build/release/seascape" << 'EOF'
#!/bin/bash
printf '%s\n' "cwd=$PWD" "driver=${VK_DRIVER_FILES:-}" "older=${VK_ICD_FILENAMES:-}" "count=$#"
printf 'arg=[%s]\n' "$@"
case "${1:-}" in
  replay) while [ "$1" != --out ]; do shift; done; printf left > "$2/frame_0000_left.png"; printf right > "$2/frame_0000_right.png" ;;
  capture) if [ -e "$0.fault" ]; then exit 9; fi; while [ "$1" != --out ]; do shift; done; printf page > "$2/report.html" ;;
  *) exit 7 ;;
esac
EOF
  chmod +x "$tree/build/release/seascape"
  printf 'lib' > "$work/cache/seascape/driver/libvulkan_lvp.so"
  printf '3 libvulkan_lvp.so\n' > "$work/cache/seascape/driver/verified"
  for name in apt-get sudo dpkg-deb cmake; do stand_in "$name" "echo \"$name \$*\" >> '$calls'; exit 1"; done
  stand_in vulkaninfo 'echo "deviceType = PHYSICAL_DEVICE_TYPE_CPU"; echo "driverInfo = Mesa 25.0.7 (LLVM 15)"'
  stand_in id 'if [ "$*" = -u ]; then echo 1000; else exec /usr/bin/id "$@"; fi'
  stand_in dpkg-query "[ \"\$1\" = -W ] && shift 2; for name; do case \" \${LACKING:-} \" in *\" \$name \"*) ;; *) case \"\$name\" in mesa-vulkan-drivers) [ \$# -eq 1 ] && echo 22.3.6 || echo \"ii  \$name\" ;; *) echo \"ii  \$name\" ;; esac ;; esac; done"
  : > "$calls"
  mark_built
}
mark_built() {
  touch -d '2020-01-01' "$tree/engine" "$tree/engine/a.cpp" "$tree/scripts/packages.txt"
  printf '%s' "$tree" > "$tree/build/release/.seascape_built"
  # dpkg's own record on the machine at hand may be newer than any stamp made before this minute.
  touch -d '+1 minute' "$tree/build/release/.seascape_built"
}

# start ARGS: ./run from the caller's folder with the stand-ins; leaves status, and the texts in $work/out and $work/err.
start() {
  (cd "$work/caller" && env -u DISPLAY -u WAYLAND_DISPLAY -u VK_DRIVER_FILES -u VK_ICD_FILENAMES -u XDG_RUNTIME_DIR \
    PATH="$work/bin:$PATH" HOME="$work/home" XDG_CACHE_HOME="$work/cache" CI=true "${extra[@]}" "$tree/run" "$@" \
    > "$work/out" 2> "$work/err" < /dev/null)
  status=$?
}
extra=()
says() { grep -qF -- "$2" "$work/$1"; }
show() { cat "$work/out" "$work/err" "$calls" >&2; }

case "${1:-}" in
  icd_json)
    driver_text() { bash -c '. "$1/scripts/driver.sh"; icd_json "$2"' bash "$tree" "$1"; }
    make_tree
    frame='{"file_format_version": "1.0.0", "ICD": {"api_version": "1.3.0", "library_path": "%s"}}'
    same() { [ "$(driver_text "$1")" = "$(printf "${frame/\%s/%b}" "$2")" ]; }
    same '/plain/lib.so' '/plain/lib.so' || fail "a plain path"
    same '/with space/ü.so' '/with space/ü.so' || fail "a space and UTF-8"
    same '/a"b.so' '/a\\"b.so' || fail "a quote"
    same '/a\b.so' '/a\\\\b.so' || fail "a backslash"
    same $'/a\tb\nc.so' '/a\\u0009b\\u000ac.so' || fail "control characters"
    # Control: without escaping the quote is caught.
    sed -i "s/'\"' | '.')/'no' | 'such')/" "$tree/scripts/driver.sh"
    same '/a"b.so' '/a\\"b.so' && fail "control: the missing escape was not seen"
    ;;
  no_op)
    make_tree
    start anything
    [ "$status" -eq 7 ] || { show; fail "status $status"; }
    [ ! -s "$calls" ] || { show; fail "a set-up tool was called"; }
    [ ! -s "$work/err" ] || { show; fail "set-up said something"; }
    # Control: the same question where a package list is newer than the build finds the calls.
    touch -d '+5 minutes' "$tree/scripts/packages.txt"
    extra=(LACKING=g++)
    stand_in sudo "echo \"sudo \$*\" >> '$calls'; exit 1"
    start anything
    [ -s "$calls" ] || fail "control: sudo was not asked"
    ;;
  args_and_status)
    make_tree
    extra=(LC_ALL=de_DE.UTF-8)
    start query '' 'two words' '*' '--set=a="b"'
    [ "$status" -eq 7 ] || fail "status $status"
    cat > "$work/expected" << EOF
cwd=$work/caller
driver=$work/cache/seascape/driver/lvp_icd.json
older=$work/cache/seascape/driver/lvp_icd.json
count=5
arg=[query]
arg=[]
arg=[two words]
arg=[*]
arg=[--set=a="b"]
EOF
    cmp "$work/expected" "$work/out" || { show; fail "arguments, folder or driver"; }
    ln -s "$tree/run" "$work/bin/sea"
    (cd "$work/caller" && PATH="$work/bin:$PATH" XDG_CACHE_HOME="$work/cache" sea x > "$work/out" 2> "$work/err")
    [ $? -eq 7 ] && says out "cwd=$work/caller" || fail "through a symbolic link"
    # Control: a run that passes its arguments unquoted is caught.
    sed -i 's/exec "$program" "$@"/exec "$program" $*/' "$tree/run"
    start query '' 'two words' '*' '--set=a="b"'
    cmp -s "$work/expected" "$work/out" && fail "control: unquoted arguments were not seen"
    ;;
  user_driver)
    make_tree
    extra=(VK_DRIVER_FILES=/my/own.json)
    start x
    says out 'driver=/my/own.json' || { show; fail "VK_DRIVER_FILES was replaced"; }
    extra=(VK_ICD_FILENAMES=/my/older.json)
    start x
    says out 'older=/my/older.json' && ! says out 'lvp_icd' || { show; fail "VK_ICD_FILENAMES was replaced"; }
    # Control: a use_driver that does not look is caught.
    sed -i 's/^  if \[ -n "${VK_DRIVER_FILES:-}.*$//' "$tree/scripts/driver.sh"
    start x
    says out 'lvp_icd' || fail "control: the replaced driver was not seen"
    ;;
  stale_build)
    # Every kind of change must end the short way: here the tree cannot be built, so the program must not start.
    make_tree
    fresh() { start x; [ "$status" -eq 7 ]; }
    fresh || fail "the built tree itself"
    touch -d '+5 minutes' "$tree/engine/a.cpp"
    fresh && fail "an edited source was not seen"
    mark_built
    fresh || fail "marked again"
    touch -d '2020-01-01' "$tree/engine/b.cpp"; touch -d '+5 minutes' "$tree/engine"  # as a removed file leaves its folder
    fresh && fail "a removed source was not seen"
    mark_built
    rm "$tree/build/release/.seascape_built"
    fresh && fail "an unfinished build was not seen"
    # Control: without the comparison of times the edit is missed.
    mark_built
    touch -d '+5 minutes' "$tree/engine/a.cpp"
    sed -i 's/^newer_than() {/newer_than() { return 1;/' "$tree/scripts/setup.sh"
    fresh || fail "control: the comparison is not what found it"
    ;;
  moved_tree)
    make_tree
    mv "$tree" "$work/elsewhere" && tree="$work/elsewhere"
    start x
    [ "$status" -eq 1 ] && says err 'seascape: ' || { show; fail "a moved tree was taken for built"; }
    # Control: with the note of its new place it starts.
    mark_built
    start x
    [ "$status" -eq 7 ] || fail "control: it is not the place that was seen"
    ;;
  missing_without_sudo)
    make_tree
    rm "$tree/build/release/.seascape_built"
    extra=(LACKING='libpng-dev libhwy-dev')
    start x
    line='run: apt-get update && apt-get install -y --no-install-recommends libhwy-dev libpng-dev'
    other='run: apt-get update && apt-get install -y --no-install-recommends libpng-dev libhwy-dev'
    [ "$status" -eq 1 ] || { show; fail "status $status"; }
    says err "$line" || says err "$other" || { show; fail "not the exact line"; }
    grep -v '^sudo -n true$' "$calls" && fail "something was called"
    [ "$(wc -l < "$work/err")" -eq 1 ] && [ ! -s "$work/out" ] || { show; fail "more than one line"; }
    # Control: with nothing lacking the line is not there (it then fails to build the empty tree).
    extra=()
    start x
    says err 'apt-get install' && fail "control: the line appears always"
    ;;
  missing_with_sudo)
    make_tree
    rm "$tree/build/release/.seascape_built"
    stand_in sudo '[ "$1" = -n ] && shift; exec "$@"'
    stand_in apt-get "echo \"\$* [\$DEBIAN_FRONTEND] [\$(cat | wc -c)]\" >> '$calls'; exit 1"
    extra=(LACKING='libpng-dev')
    start x
    grep -qE -- '-o DPkg::Lock::Timeout=[0-9]+ .*install -y --no-install-recommends --no-remove libpng-dev \[noninteractive\] \[0\]$' "$calls" ||
      { show; fail "apt-get was called otherwise"; }
    [ "$status" -eq 1 ] && says err 'could not install' || { show; fail "apt-get's fault was lost"; }
    # Control: without its DEBIAN_FRONTEND the call is caught.
    : > "$calls"
    sed -i 's/DEBIAN_FRONTEND=noninteractive//' "$tree/scripts/setup.sh"
    extra=(LACKING='libpng-dev' DEBIAN_FRONTEND=)
    start x
    grep -q '\[noninteractive\]' "$calls" && fail "control: the missing setting was not seen"
    ;;
  full_disk)
    make_tree
    rm "$tree/build/release/.seascape_built"
    stand_in df 'printf "Filesystem 1048576-blocks Used Available Capacity Mounted\nfull 1000 990 10 99%% /\n"'
    stand_in sudo '[ "$1" = -n ] && shift; exec "$@"'
    extra=(LACKING='libpng-dev')
    start x
    [ "$status" -eq 1 ] && says err '10 MiB are free' || { show; fail "packages: the full disk was not seen"; }
    [ ! -s "$calls" ] || { show; fail "apt-get was called on a full disk"; }
    extra=()
    start x
    [ "$status" -eq 1 ] && says err '10 MiB are free and the build' || { show; fail "build: the full disk was not seen"; }
    # Control: with room it is not said.
    stand_in df 'printf "Filesystem 1048576-blocks Used Available Capacity Mounted\nroomy 100000 10 99990 1%% /\n"'
    start x
    says err 'MiB are free' && fail "control: it is said always"
    ;;
  no_backports)
    make_tree
    rm -r "$work/cache/seascape"
    start x
    [ "$status" -eq 7 ] && says err 'notice: Mesa 25 could not be fetched' && says out 'driver=' && ! says out 'lvp_icd' ||
      { show; fail "without backports it does not start with a notice"; }
    [ -z "$(find "$work/cache" -name '*.tmp')" ] || fail "a partial download was left"
    extra=(XDG_CACHE_HOME="$work/with:colon")
    start x
    [ "$status" -eq 7 ] && says err 'set XDG_CACHE_HOME' || { show; fail "a colon in the cache's path"; }
    # Control: with the driver in the cache there is no notice (the case no_op holds the rest).
    make_tree
    extra=()
    start x
    says err 'notice' && fail "control: the notice appears always"
    ;;
  broken_driver)
    make_tree
    # A download that was cut short: the stand-ins for apt-get and dpkg-deb bring a whole one.
    printf 'l' > "$work/cache/seascape/driver/libvulkan_lvp.so"
    touch "$work/cache/seascape/driver.abc.tmp"
    stand_in apt-get 'case "$*" in *indextargets*) echo http://mirror.example/debian ;; *download*) touch mesa-vulkan-drivers_25_amd64.deb ;; *update*) cat parts/*.sources >> "'"$calls"'" ;; esac'
    stand_in dpkg-deb 'mkdir -p "$3/usr/lib/x" "$3/usr/share/doc/mesa-vulkan-drivers"; echo whole > "$3/usr/lib/x/libvulkan_lvp.so"; echo c > "$3/usr/share/doc/mesa-vulkan-drivers/copyright"'
    start x
    [ "$status" -eq 7 ] && says out 'lvp_icd.json' || { show; fail "not repaired"; }
    [ "$(cat "$work/cache/seascape/driver/libvulkan_lvp.so")" = whole ] || fail "the broken library is still there"
    grep -qF "\"library_path\": \"$work/cache/seascape/driver/libvulkan_lvp.so\"" "$work/cache/seascape/driver/lvp_icd.json" || fail "the path"
    grep -qF 'URIs: http://mirror.example/debian' "$calls" || { show; fail "the system's mirror was not asked"; }
    [ -z "$(find "$work/cache" -name '*.tmp')" ] || fail "something was left beside it"
    # Control: a driver that reports 22 is not taken, and what was there is gone from use.
    rm -r "$work/cache/seascape/driver"
    stand_in vulkaninfo 'echo "driverInfo = Mesa 22.3.6 (LLVM 15)"'
    start x
    [ "$status" -eq 7 ] && says err "reports Mesa '22'" && ! says out lvp_icd || { show; fail "control: Mesa 22 was taken for 25"; }
    ;;
  hardware)
    # A device node and a Vulkan driver that is not a software one: the installed driver stays, and the answer is kept.
    make_tree
    stand_in ls "case \"\$*\" in *renderD*) echo /dev/dri/renderD128 ;; esac"
    stand_in vulkaninfo "echo vulkaninfo >> '$calls'; echo '	deviceType         = PHYSICAL_DEVICE_TYPE_DISCRETE_GPU'"
    start x
    [ "$status" -eq 7 ] && ! says out lvp_icd || { show; fail "a hardware GPU was passed over"; }
    start x
    [ "$(wc -l < "$calls")" -eq 1 ] || { show; fail "the answer was not kept"; }
    # Control: a node behind which only software answers is no hardware; a changed node is asked again.
    stand_in ls "case \"\$*\" in *renderD*) echo /dev/dri/renderD129 ;; esac"
    stand_in vulkaninfo "echo vulkaninfo >> '$calls'; echo '	deviceType         = PHYSICAL_DEVICE_TYPE_CPU'"
    start x
    says out lvp_icd && [ "$(wc -l < "$calls")" -eq 2 ] || { show; fail "control: a software driver was taken for hardware"; }
    ;;
  pictures)
    make_tree
    start
    [ "$status" -eq 0 ] || { show; fail "status $status"; }
    (cd "$work/caller/out" && [ "$(cat left.png)" = left ] && [ "$(cat right.png)" = right ] && [ "$(cat report.html)" = page ]) || fail "the files"
    [ "$(ls "$work/caller/out" | wc -l)" -eq 3 ] || fail "something else was left in out/"
    [ "$(cat "$work/out")" = $'out/left.png\nout/right.png\nout/report.html' ] || { show; fail "standard output"; }
    # Control and the other branch: with a display the program explores instead.
    extra=(DISPLAY=:7)
    start
    [ "$status" -eq 7 ] && says out 'arg=[explore]' && says out 'arg=[auto]' || { show; fail "control: a display makes no difference"; }
    ;;
  picture_fault)
    make_tree
    touch "$tree/build/release/seascape.fault"
    start
    [ "$status" -eq 9 ] || { show; fail "the program's status was lost: $status"; }
    [ -z "$(find "$work/caller/out" -name '*.tmp')" ] || fail "a partial folder was left"
    [ ! -s "$work/out" ] || fail "files were named that are not there"
    # Control: without the fault the status is 0.
    rm "$tree/build/release/seascape.fault"
    start
    [ "$status" -eq 0 ] || fail "control: it fails always"
    # Nor does the page of that earlier run pass for one of a capture that writes none.
    sed -i 's/printf page.*;;/;;/' "$tree/build/release/seascape"
    touch -d "-1 minute" "$work/caller/out/report.html"
    start
    [ "$status" -eq 1 ] && says err 'report.html: the capture did not write it' || { show; fail "an old report was taken for new"; }
    ;;
  mutants)
    # What plants faults (tests/mutants) still fits the code: every planted fault changes its file and names a test that is there.
    mutants="$source_root/tests/mutants"
    bash -n "$mutants/run" || fail "tests/mutants/run"
    "$mutants/run" --check > "$work/out" 2> "$work/err" || { show; fail "planted faults that do not fit; mend or remove them"; }
    [ "$(find "$mutants/planted" -name '*.fault' | wc -l)" -ge 12 ] || fail "fewer than 12 planted faults"
    for wrong in --bogus '--swaps' '--swaps -1' '--seed 1,5' extra; do
      "$mutants/run" $wrong > "$work/out" 2> "$work/err" && fail "$wrong: is taken"
    done
    # One seed gives one list, another another.
    "$mutants/run" --swaps 50 --seed 3 --list > "$work/one" && "$mutants/run" --swaps 50 --seed 3 --list > "$work/two" && "$mutants/run" --swaps 50 --seed 4 --list > "$work/three"
    [ "$(wc -l < "$work/one")" -eq 50 ] && cmp -s "$work/one" "$work/two" && ! cmp -s "$work/one" "$work/three" || fail "lists of swaps"
    # Of this text nothing but its operators: no comment, string, directive, bracket, pointer, sign or assertion.
    cat > "$work/text.cpp" << 'TEXT'
#include <a + b>
#define X a + \
  b + c
// a + b
/* a + b
 c - d */ int e = f + g;
template <class T> void f(T&& a, int* b);
const char* s = "a + b\" - c";  // 1 - 2
auto r = R"x(a + b
c + d)" + e)x"; int q = 1'000 + 1e-5 - .5, c = '+' + ' ';
std::vector<float> v; if (a < -b && c >= d) x += std::min(a, b) * -c;
assert(a == b);
std::cout << a; p->q; auto m = hn::Add(a, b); auto k = [&](auto&& z) { return *p / *z; };
TEXT
    places() { awk -v seed=1 -f "$1" "$work/text.cpp" | cut -f 2-4 | sort -n -k 1,1 -k 2,2 | tr '\t\n' ': '; }
    want='6:21:+ 10:31:+ 10:38:- 10:52:+ 11:29:< 11:34:&& 11:39:>= 11:47:+= 11:55:min 11:65:* 13:36:Add 13:82:/ '
    [ "$(places "$mutants/swaps.awk")" = "$want" ] || fail "operators: $(places "$mutants/swaps.awk")"
    # Controls: a generator that knows no comments, and faults that fit no longer.
    sed 's|if (two == "//") break||' "$mutants/swaps.awk" > "$work/swaps.awk"
    [ "$(places "$work/swaps.awk")" = "$want" ] && fail "control: comments"
    mkdir -p "$tree/tests/mutants" && cp -r "$source_root/scripts" "$source_root/engine" "$source_root/platform" "$source_root/ocean" "$source_root/app" "$source_root/shaders" "$tree/"
    (cd "$source_root" && find tests -name '*_test.cpp' -o -path 'tests/mutants/*' -type f) | (cd "$source_root" && xargs -d '\n' cp --parents -t "$tree")
    "$tree/tests/mutants/run" --check > "$work/out" || { cat "$work/out" >&2; fail "control: the copy"; }
    sed -i 's/tanh_of(k \* depth_m))/tanh_of(depth_m * k))/' "$tree/ocean/waves/dispersion.cpp"
    sed -i 's/^TEST(SeaBlend, IsTheOldSea/TEST(SeaBlend, WasTheOldSea/' "$tree/tests/ocean/sea/sea_change_test.cpp"
    "$tree/tests/mutants/run" --check > "$work/out" && fail "control: stale faults"
    [ "$(grep -c fault: "$work/out")" -eq 2 ] || { cat "$work/out" >&2; fail "control: which faults are stale"; }
    ;;
  house_rules)
    # No python in the scripts, and each is valid bash. Control: a planted line is found by the same search.
    make_tree
    scripts=("$source_root/run" "$source_root/check" "$source_root/.ci/run" "$source_root"/scripts/*.sh "$source_root/tests/mutants/run")
    for script in "${scripts[@]}"; do bash -n "$script" || fail "$script"; done
    grep -nE '\bpython3?\b' "${scripts[@]}" && fail "python in a script"
    printf 'python3 -c 1\n' > "$work/planted"
    grep -qE '\bpython3?\b' "$work/planted" || fail "control"
    # Debian 12's package names only: each line is `run NAME` or `check NAME`, none twice.
    grep -vE '^(#.*|(run|check) [a-z0-9][a-z0-9+.-]+)$' "$source_root/scripts/packages.txt" && fail "packages.txt"
    [ -z "$(grep -v '^#' "$source_root/scripts/packages.txt" | cut -d' ' -f2 | sort | uniq -d)" ] || fail "a package twice"
    ;;
  check_usage)
    make_tree
    usage_of() { "$tree/check" "$@" > "$work/out" 2> "$work/err" < /dev/null; status=$?; }
    for wrong in --bogus '--fuzz' '--all --fuzz -1' '--all --fuzz 1,5' '--all --fuzz 12345678901234567890' '--fuzz 5' extra; do
      usage_of $wrong
      [ "$status" -eq 2 ] && [ "$(grep -c '^seascape: ' "$work/err")" -eq 1 ] || { show; fail "check $wrong: $status"; }
    done
    # Control: a right use is not refused.
    usage_of --all --fuzz 5 --long --help
    [ "$status" -eq 0 ] && says out '--fuzz MINUTES' || { show; fail "control: --help"; }
    ;;
  check_counts)
    # The whole of ./check on a project without a compiler: two unit tests, one program test that fails, one that skips
    # itself, and no test of the other labels.
    tree="$work/a sea"
    make_tree
    rm "$work/bin/cmake"
    mkdir -p "$tree/tests"
    : > "$tree/tests/a_program_test.cpp"
    printf '{"version": 6, "configurePresets": [%s], "buildPresets": [%s]}\n' \
      "$(for p in release asan tsan; do printf '%s{"name": "%s", "generator": "Ninja", "binaryDir": "${sourceDir}/build/%s"}' "${sep:-}" $p $p; sep=', '; done)" \
      "$(sep=; for p in release asan tsan; do printf '%s{"name": "%s", "configurePreset": "%s"}' "$sep" $p $p; sep=', '; done)" \
      > "$tree/CMakePresets.json"
    cat > "$tree/CMakeLists.txt" << 'EOF'
cmake_minimum_required(VERSION 3.25)
project(fake LANGUAGES NONE)
enable_testing()
add_test(NAME one COMMAND true)
add_test(NAME two COMMAND true)
set_tests_properties(one two PROPERTIES LABELS unit)
add_test(NAME three COMMAND ${CMAKE_SOURCE_DIR}/three)
add_test(NAME four COMMAND false)
set_tests_properties(three PROPERTIES LABELS program)
set_tests_properties(four PROPERTIES LABELS program SKIP_RETURN_CODE 1)
EOF
    printf '#!/bin/bash\nexit 1\n' > "$tree/three" && chmod +x "$tree/three"
    printf '#!/bin/bash\n' > "$tree/scripts/format.sh" && chmod +x "$tree/scripts/format.sh"
    check_of() {
      (cd "$work/caller" && env PATH="$work/bin:$PATH" XDG_CACHE_HOME="$work/cache" CI=true "$tree/check" "$@" > "$work/out" 2> "$work/err" < /dev/null)
      status=$?
    }
    check_of
    # packages, format and build release count one each, unit two; program one failed.
    [ "$(tail -n 1 "$work/out")" = '5 passed, 1 failed' ] && [ "$status" -eq 1 ] || { show; fail "the sum: $status"; }
    check_of --all
    # And build asan one, and its unit two.
    [ "$(tail -n 1 "$work/out")" = '8 passed, 1 failed' ] && [ "$status" -eq 1 ] || { show; fail "the sum: $status"; }
    says out 'failed: tests program' && says out '1 of these tests skipped themselves' || { show; fail "what failed"; }
    says out 'tests golden: no test has this label' || { show; fail "an absent label"; }
    # A label whose sources are there and whose tests are not found is a failure.
    : > "$tree/tests/a_golden_test.cpp"
    check_of
    [ "$(tail -n 1 "$work/out")" = '5 passed, 2 failed' ] || { show; fail "a label without its tests"; }
    # Control: when nothing fails, the same reading says so.
    rm "$tree/tests/a_golden_test.cpp"
    printf '#!/bin/bash\nexit 0\n' > "$tree/three"
    check_of --all
    [ "$(tail -n 1 "$work/out")" = '9 passed, 0 failed' ] && [ "$status" -eq 0 ] || { show; fail "control: it fails always"; }
    # The headset's proof counts its own tests. It is neither where it skips itself (it is not root here), and failed where it says nothing.
    : > "$tree/tests/a_headset_test.cpp"
    for case in '9 passed, 0 failed:' '14 passed, 2 failed:printf "[  PASSED  ] 5 tests.\n[  FAILED  ] 2 tests, listed below:\n"; exit 1' '9 passed, 1 failed:exit 1'; do
      if [ -n "${case#*:}" ]; then printf '#!/bin/bash\n%s\n' "${case#*:}" > "$tree/scripts/headset_proof.sh"; fi
      check_of --all
      [ "$(tail -n 1 "$work/out")" = "${case%%:*}" ] && { [ -n "${case#*:}" ] || says out 'note: the proof skipped itself'; } || { show; fail "not $case"; }
    done
    ;;
  headset_proof)
    # What scripts/headset_proof.sh says where it cannot run, and when it makes its root.
    make_tree
    proof() {
      (cd "$work/caller" && env PATH="$work/bin:$PATH" XDG_CACHE_HOME="$work/cache" "$tree/scripts/headset_proof.sh" "$@" > "$work/out" 2> "$work/err" < /dev/null)
      status=$?
    }
    skips() { [ "$status" -eq 77 ] && [ "$(wc -l < "$work/err")" -eq 1 ] && says err "notice: headset proof skipped: $1"; }
    for wrong in --bogus --build '--root here' --only extra; do
      proof $wrong
      [ "$status" -eq 2 ] && [ "$(grep -c '^seascape: ' "$work/err")" -eq 1 ] || { show; fail "$wrong: $status"; }
    done
    proof --help
    [ "$status" -eq 0 ] && says out '--only FILTER' || { show; fail "--help"; }
    proof
    skips 'only root' || { show; fail "not root: $status"; }
    stand_in id 'echo 0'
    stand_in unshare 'exit 1'
    proof
    skips 'this machine does not let root' || { show; fail "no namespace: $status"; }
    stand_in unshare "[ \"\${!#}\" = true ] && exit 0; echo \"unshare \$*\" >> '$calls'; exit 3"
    proof
    [ "$status" -eq 1 ] && says err 'tests_headset is not there' || { show; fail "nothing built: $status"; }
    printf '#!/bin/bash\nprintf "Some.\\n  Test\\n"\n' > "$tree/build/release/tests_headset" && chmod +x "$tree/build/release/tests_headset"
    stand_in timeout 'exit 1'  # the question whether a mirror answers
    stand_in mmdebstrap "echo \"mmdebstrap \$*\" >> '$calls'; for word; do case \"\$word\" in */headset_root.new) mkdir \"\$word\" ;; esac; done; exit \${MADE:-0}"
    proof
    skips 'no mirror of Debian answers' || { show; fail "no network: $status"; }
    stand_in timeout 'exit 0' && MADE=1 proof
    [ "$status" -eq 1 ] && [ -z "$(find "$work/cache" -name 'headset_root*' -type d)" ] || { show; fail "a root that could not be made: $status"; }
    # It is made once, entered each time, and made anew where it lacks a package. The status is that of the tests.
    for made in 2 2 3; do
      if [ "$made" -eq 3 ]; then sed -i 's/xvfb xdotool/another &/' "$tree/scripts/headset_proof.sh"; fi
      proof
      [ "$status" -eq 3 ] && [ "$(grep -c ^mmdebstrap "$calls")" -eq "$made" ] || { show; fail "made $made times: $status"; }
    done
    # Control: a script that does not ask who it is goes on.
    stand_in id 'echo 1000' && sed -i 's/^can_run$//' "$tree/scripts/headset_proof.sh"
    proof
    [ "$status" -eq 3 ] || { show; fail "control: the question is not what stopped it"; }
    ;;
  *) fail "no such case: ${1:-}" ;;
esac
exit 0
