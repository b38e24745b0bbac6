#!/usr/bin/env bash
# Makes the pictures of the report page anew. Flies the flights of docs/tutorial.md in virtual time with their seeds, so that every machine gets
# the same bits, and takes pictures of parts of the report pages with headless Chromium. Packages: chromium fonts-dejavu-core.
#   docs/images/make.sh [BUILD]        BUILD: folder of hil-bench (default: build/default)
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
case "${1:-}" in -h | --help) sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "$here/make.sh"; exit ;; esac
bench=$(cd "${1:-$root/build/default}" && pwd)/hil-bench
[[ -x $bench ]] || { echo "make.sh: no program $bench: expected a build folder" >&2; exit 2; }
command -v chromium >/dev/null || { echo "make.sh: no chromium: expected Debian's package chromium" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$root"

fly() { # fly PAGE ARGUMENTS...: flies and writes the report page, without the time at which it was made; the flight may fail its checks
  local page=$work/$1.html code=0
  shift
  "$bench" run bench/flights/transfer_alignment.toml "$@" --html "$page" >"$work/text" 2>&1 || code=$?
  if ((code != 0 && code != 1 && code != 3)); then cat "$work/text" >&2; exit 2; fi
  sed -i -E 's/ &middot; [0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z//' "$page"
}

picture() { # picture NAME PAGE WIDTH,HEIGHT STYLE [CHROMIUM OPTIONS...]: takes a picture of a page; the CSS in STYLE hides the other parts of the page
  local name=$1 page=$2 size=$3 style=$4 shown=$work/shown.html
  shift 4
  sed "s|</head>|<style>$style</style></head>|" "$work/$page.html" >"$shown"
  timeout 120 chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --force-device-scale-factor=1 --user-data-dir="$work/profile" \
    --window-size="$size" --screenshot="$here/$name.png" "$@" "file://$shown" >"$work/chromium" 2>&1 || { cat "$work/chromium" >&2; exit 1; }
  echo "$name.png $(stat -c %s "$here/$name.png") bytes"
}

printf '[[fault]]\nname = "gyro bias"\nkind = "bias"\nquantity = "imu.rate.z"\nby_degps = 0.2\nfrom_s = 15\n' >"$work/gyro.toml"
fly timed --bus 'in-process?bitrate=500000'
fly fault --bus in-process --faults "$work/gyro.toml"

only() { echo "section:not(#$1),nav{display:none}"; }
no_head='h1,.sub,.verdict,h2{display:none}body{padding-top:0}'
picture report_pass timed 1000,920 "$(only checks)"
picture report_estimates timed 1000,655 "$(only estimates)$no_head"'figure:nth-of-type(n+3) figcaption,figure:nth-of-type(n+5){display:none}'
picture report_latency timed 1000,1120 "$(only timing)$no_head"
picture report_fault fault 1000,455 "$(only estimates)"'h2,h3:not(figure h3),figcaption,figure:first-of-type,figure:nth-of-type(n+4){display:none}'
# The page that pytest keeps of the failed test of docs/python.md.
(cd "$work" && PATH=$(dirname "$bench"):$PATH PYTHONPATH=$root/python PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -m pytest -q -p canhil.pytest_plugin -p no:cacheprovider \
  --rootdir "$work" "$root/docs/examples/python/test_bias.py" --canhil-bus in-process --canhil-artefacts kept >"$work/text") || true
cp "$work"/kept/*/report.html "$work/python.html" || { cat "$work/text" >&2; exit 1; }
picture python_fail python 1000,560 "section:not(#checks):not(#estimates),nav,#checks,h1,.sub{display:none}"'h3:not(figure h3),figcaption,figure:nth-of-type(n+5),figure:nth-of-type(-n+2){display:none}'
picture report_fail fault 420,1250 "$(only checks)" --blink-settings=preferredColorScheme=0
