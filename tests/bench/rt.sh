#!/bin/sh
# SPDX-License-Identifier: MIT
#
# rt - the figures of `make bench-rt`: how late ladderd wakes up for its scan, and how late
# cyclictest does on the same machine at the same time. ladderd scans a small program on
# simulated pins, so the figures contain the clock, the kernel and the overhead of a scan.
# Both programs run alternately, and the median of each percentile counts. Nothing fails:
# the figures depend on the load of the machine.
#
#   TURNS=5 SCANS=4000 PERIOD=1000 PRIORITY=40   SCANS per turn, at PERIOD us
set -eu

build=${BUILD:-build}
turns=${TURNS:-5}
scans=${SCANS:-4000}
period=${PERIOD:-1000}
priority=${PRIORITY:-40}
ladderd=$build/ladderd
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT

if ! command -v cyclictest >/dev/null; then
	echo 'cyclictest is not here: apt-get install rt-tests' >&2
	exit 1
fi

cat >"$tmp/lamp.rung" <<'END'
RUNGBOARD 1
PROJECT "Lamp"

VAR
  Start AT %IX0.0 : BOOL;
  Stop  AT %IX0.1 : BOOL;
  Lamp  AT %QX0.0 : BOOL;
  Blink AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start   | NC Stop | COIL Lamp |
  | NO Lamp   ^|
RUNG
  | NO SM0.5   | ---     | COIL Blink |
END_PROGRAM
END
cat >"$tmp/desk.io" <<'END'
BOARD "desk"
%IX0.0 sim
%IX0.1 sim
%QX0.0 sim safe=0
%QX0.1 sim safe=0
END

# Real-time priority and locked memory for both programs, or for neither.
real="--rt $priority" cyclic="-m -p $priority" kind="SCHED_FIFO $priority"
if ! cyclictest -q -m -p "$priority" -l 1 >/dev/null 2>&1; then
	real='' cyclic='' kind='no real-time priority: not allowed to this user'
fi

turn=0
while [ "$turn" -lt "$turns" ]; do
	turn=$((turn + 1))
	# The options are words.
	# shellcheck disable=SC2086
	cyclictest -q -t 1 $cyclic -i "$period" -l "$scans" -h 100000 |
		sed -n "s/^\\([0-9]\\{6\\}\\) \\([0-9]*\\)\$/count $turn \\1 \\2/p
			s/^# Max Latencies: 0*\\([0-9]\\)/most $turn \\1/p" >>"$tmp/figures"
	# shellcheck disable=SC2086
	"$ladderd" "$tmp/lamp.rung" --io "$tmp/desk.io" --period "${period}us" \
		$real --watchdog 1000 --scans "$scans" |
		sed -n "s/^wake-up:/wake $turn/p; s/^late:/late $turn/p" >>"$tmp/figures"
done

cpu=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
echo "$turns turns of $scans scans of $period us, $kind; $(uname -r), ${cpu:-$(uname -m)}, $(nproc) processors."
awk '
# The steps of ladderd'"'"'s own histogram: an eighth of a doubling, rounded up.
function step(us,  ns, octave) {
	ns = us * 1000
	for (octave = 1; octave * 2 <= ns; octave *= 2)
		;
	return octave < 8 ? us : (int(ns / (octave / 8)) + 1) * (octave / 8) / 1000
}
function share(turn, part,  want, i, seen) {
	want = total[turn] * part
	for (i = 0; i < 100000; i++) {
		seen += count[turn, i]
		if (seen >= want)
			return step(i) < most[turn] ? step(i) : most[turn]
	}
	return most[turn]
}
function of(line, word,  at) {
	at = index(line, word " ")
	return at ? substr(line, at + length(word) + 1) + 0 : 0
}
# Prints the median of figure[1..turns].
function median(  i, k, t) {
	for (i = 2; i <= turns; i++)
		for (k = i; k > 1 && figure[k] < figure[k - 1]; k--) {
			t = figure[k]; figure[k] = figure[k - 1]; figure[k - 1] = t
		}
	return figure[int((turns + 1) / 2)]
}
function ours(word,  t) {
	for (t = 1; t <= turns; t++)
		figure[t] = of(wake[t], word)
	return median()
}
function theirs(part,  t) {
	for (t = 1; t <= turns; t++)
		figure[t] = share(t, part)
	return median()
}
$1 == "count" { count[$2, $3 + 0] = $4; total[$2] += $4 }
$1 == "most" { most[$2] = $3 + 0; if (most[$2] > top) top = most[$2] }
$1 == "wake" { wake[$2] = $0; turns = $2; if (of($0, "max") > max) max = of($0, "max") }
$1 == "late" { late += $3 }
END {
	if (!turns || !total[turns]) { print "no figures"; exit 1 }
	printf "\n| wake-up, us | p50 | p99 | p99.9 | max of all |\n|---|---|---|---|---|\n"
	printf "| ladderd | %.1f | %.1f | %.1f | %.1f |\n", ours("p50"), ours("p99"), ours("p99.9"), max
	printf "| cyclictest | %.1f | %.1f | %.1f | %.1f |\n", theirs(.5), theirs(.99), theirs(.999), top
	printf "\np99.9 of ladderd / cyclictest: %.2f. Late scans: %d.\n", ours("p99.9") / theirs(.999), late
	print "Percentiles are rounded up to the steps of ladderd'"'"'s histogram, an eighth of a doubling, for both."
}' "$tmp/figures"
