#!/usr/bin/env bash
# Lists the C++ files whose format differs from .clang-format, and fails if there are any; format.sh --fix formats them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
each_file() { find dbc target bench tests \( -name '*.hpp' -o -name '*.cpp' \) -print0 | xargs -0 -r -P "$(nproc)" -n 1 "$@"; }
if [[ "${1:-}" == --fix ]]; then
  each_file clang-format -i
  exit
fi
if ! each_file bash -c 'clang-format "$0" | cmp -s - "$0" || { echo "$0: not formatted"; exit 1; }'; then
  echo "format them by: bash tests/static/format.sh --fix"
  exit 1
fi
