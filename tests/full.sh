#!/usr/bin/env bash
# The long sweeps of ./test --full: item buffers over many random views, random jumps over terrain. Usage: full.sh BUILD
set -euo pipefail
cd "$(dirname "$0")/.."
vicus=$1/vicus
data=${VICUS_DATA:-../shared/data}
scenes=(norvic norwich-2001)
if [ -d "$data" ]; then
  scenes+=("$data/perigueux/bdnb_perigeux8.shp" "$data/denhaag/DenHaag_01.city.json")
else
  echo "No real cities at hand: their sweeps are left out."
fi
for scene in "${scenes[@]}"; do
  echo "Culling over 1 000 random views of $scene"
  "$vicus" check "$scene" --views 1000 --size 320x180
done
streets=(norvic norvic:8000)
[ -d "$data" ] && streets+=("$data/perigueux/bdnb_perigeux8.shp" "$data/denhaag/DenHaag_01.city.json"
  "$data/lyon/buildings_lyon1.geojson")
for scene in "${streets[@]}"; do
  echo "What the cull map hides in 2 000 street views of $scene"
  "$vicus" check "$scene" --street --views 2000 --size 640x360 --pictures 20
done
echo "ROAM: 10 000 random jumps, published counts and journeys on large fields, long journeys over real terrain"
"$1/tests/test_terrain" --gtest_also_run_disabled_tests --gtest_filter='DISABLED_*InFull.*' --gtest_brief=1
"$1/tests/test_app" --gtest_also_run_disabled_tests --gtest_filter='DISABLED_RoamBoundInFull.*' --gtest_brief=1
echo "Walking: 100 000 random steps in each city"
"$1/tests/test_viewer" --gtest_also_run_disabled_tests --gtest_filter='*DISABLED_WalkSweepInFull*' --gtest_brief=1
echo "Rules: 10 000 random footprints over all styles"
"$1/tests/test_assets" --gtest_also_run_disabled_tests --gtest_filter='DISABLED_StylesInFull.*' --gtest_brief=1
echo "People: strips of their walks, and how far their feet slide"
"$1/tests/test_viewer" --gtest_also_run_disabled_tests --gtest_filter='*DISABLED_PeopleStripsInFull*' --gtest_brief=1
echo "A mesh of five million triangles"
python3 tests/measure_mesh.py "$vicus"
echo "Malformed files, and 10 000 damaged copies of small valid ones"
if [ -d "$data" ]; then
  "$1/tests/fuzz/fuzz_mutate" "$data/malformed"
  "$1/tests/fuzz/fuzz_mutate" --copies 10000 examples/*.toml tests/fuzz/seeds/*
fi
echo "Rules fuzzed for ten minutes"
if command -v clang++ > /dev/null; then
  cmake -S . -B build-fuzz -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang \
    -DVICUS_FUZZ=ON -DVICUS_SANITIZE=address,undefined > /dev/null
  cmake --build build-fuzz --target fuzz_rules
  found=$(mktemp -d)
  trap 'rm -rf "$found"' EXIT
  # What it finds that is new stays in a folder of its own; the kept corpus grows by hand (-merge=1).
  build-fuzz/tests/fuzz/fuzz_rules -max_total_time=600 -max_len=4096 -timeout=20 -rss_limit_mb=2048 -verbosity=0 \
    -artifact_prefix=build-fuzz/ "$found" tests/fuzz/rules assets/styles
else
  echo "No clang at hand: rules are not fuzzed."
fi
