#!/usr/bin/env bash
# Makes the API pages and fails on every warning of Doxygen: wrong documentation, or a public type, function
# or enumeration without a comment. Fields of structs need no comment, because their names contain their units.
# Defaulted operators need no comment either.
#   api.sh FOLDER        writes the pages to FOLDER/html; takes about a second
set -euo pipefail
[[ $# == 1 ]] || { echo "api.sh: expected a folder for the pages" >&2; exit 2; }
mkdir -p "$1"
CANHIL_API=$(cd "$1" && pwd)
export CANHIL_API
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
rm -rf "$CANHIL_API/html"
doxygen docs/Doxyfile >"$CANHIL_API/log" 2>&1 || { cat "$CANHIL_API/log"; exit 1; }
if grep -vE '\(variable\) of (struct|class)|Member operator(==|\|=|\+=)\(|\((friend|typedef)\) of|^$' "$CANHIL_API/log" | sed "s|^$PWD/||" | sort -u | grep .; then
  echo "api.sh: Doxygen complains of the above"
  exit 1
fi
[[ -s $CANHIL_API/html/index.html ]] || { echo "api.sh: no pages"; exit 1; }
