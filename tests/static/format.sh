#!/usr/bin/env bash
# Lists the places in C++ files whose format differs from .clang-format, and fails if there are any; format.sh --fix formats the files.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
# Twenty files a process: the start of clang-format takes longer than the formatting of a file.
clang_format() { find dbc target bench tests \( -name '*.hpp' -o -name '*.cpp' \) -print0 | xargs -0 -r -P "$(nproc)" -n 20 clang-format "$@"; }
if [[ "${1:-}" == --fix ]]; then
  clang_format -i
  exit
fi
if ! clang_format --dry-run -Werror; then
  echo "format them by: bash tests/static/format.sh --fix"
  exit 1
fi
