#!/usr/bin/env bash
# Fails when a C++ file is not formatted as .clang-format says; format.sh --fix formats them all.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
mode=(--dry-run --Werror)
if [[ "${1:-}" == --fix ]]; then mode=(-i); fi
find dbc target bench tests \( -name '*.hpp' -o -name '*.cpp' \) -print0 |
  xargs -0 -r -P "$(nproc)" -n 8 clang-format --style=file "${mode[@]}"
