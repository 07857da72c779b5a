#!/usr/bin/env bash
# clang-tidy over all our sources with the compile commands of BUILD. Usage: lint.sh BUILD
set -euo pipefail
cd "$(dirname "$0")/.."
git ls-files '*.cpp' | grep -v '^tests/' | xargs -P "$(nproc)" -n 4 clang-tidy -p "$1" --quiet --warnings-as-errors='*' 2>/dev/null
