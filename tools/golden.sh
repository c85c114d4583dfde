#!/usr/bin/env bash
# Builds the test of the golden state with each compiler there is and at each level of optimisation, and runs it: all must come to the
# state that tests/physics/golden_test.cpp has. tools/golden.sh [TEST-CASE]: another test case of test_physics, by its name.
set -u
cd "$(dirname "$0")/.." || exit 4
wanted=${1:-the golden state*} failed=0
for compiler in g++ clang++; do
    command -v "$compiler" >/dev/null || { echo "tools/golden.sh: there is no $compiler" >&2; failed=1; continue; }
    for level in O0 O2 O3; do
        folder=build/golden/$compiler-$level
        cmake -S . -B "$folder" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="-$level -DNDEBUG" >/dev/null &&
            ninja -C "$folder" test_physics >"$folder/build.log" 2>&1 || { echo "$compiler -$level: not built, see $folder/build.log"; failed=1; continue; }
        if "$folder/tests/test_physics" -tc="$wanted" >"$folder/test.log" 2>&1; then echo "$compiler -$level: the same"
        else echo "$compiler -$level: another state: $(grep -m1 -o 'CHECK( [0-9a-f]* ==' "$folder/test.log")"; failed=1; fi
    done
done
exit $failed
