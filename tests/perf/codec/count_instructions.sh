#!/bin/sh
# Counts the instructions of one pack() and of one unpack() with callgrind. The goals for a message with four signals: at most 30 instructions for
# unpack(), at most 60 for pack(). Exit code 1 if a goal is missed.
# usage: count_instructions.sh path/to/codec_instructions
set -eu
program=${1:?usage: count_instructions.sh path/to/codec_instructions}
times=1000
out=$(mktemp)
trap 'rm -f "$out" "$out.log"' EXIT
status=0
for message in SlaveImuDeltaTheta FourSignals FourSignalsBig; do
  for way in unpack pack; do
    valgrind --tool=callgrind --toggle-collect="${way}_$message" --callgrind-out-file="$out" "$program" $times \
      > "$out.log" 2>&1 || { cat "$out.log"; exit 2; }
    total=$(sed -n 's/^\(summary\|totals\): *//p' "$out" | head -n 1)
    count=$((${total:-0} / times))
    if [ "$count" -eq 0 ]; then
      echo "count_instructions.sh: callgrind counted nothing in ${way}_$message() of $program" >&2
      exit 1
    fi
    goal=30
    [ $way = pack ] && goal=60
    echo "instructions per $way of $message: $count (goal: at most $goal)"
    [ "$count" -le $goal ] || status=1
  done
done
exit $status
