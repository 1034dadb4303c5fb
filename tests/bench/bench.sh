#!/bin/sh
# SPDX-License-Identifier: MIT
#
# bench - the figures of `make bench`: speed, load time and size, as a table with the commit
# and the machine. It does not fail on slow figures, because they depend on the machine and
# its load.
set -eu

build=${BUILD:-build}
cc=${CC:-cc} # may have words: ccache gcc
ladder=$build/ladder
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT

# field FILE NAME: prints a number from the JSON of `ladder bench --json`.
field() { tr -d '\n' <"$1" | sed -n "s/.*\"$2\": \([0-9.]*\).*/\1/p"; }
median() { tr -d '\n' <"$1" | sed -n "s/.*\"$2\": {[^}]*\"median\": \([0-9.]*\).*/\1/p"; }
least() { tr -d '\n' <"$1" | sed -n "s/.*\"$2\": {\"min\": \([0-9.]*\).*/\1/p"; }
# both INPUTS N: median and least time of a rung in p.json.
both() {
	echo "$(per "$(median "$tmp/p.json" "body_$1_ns")" "$2" %.2f) ($(per "$(least "$tmp/p.json" "body_$1_ns")" "$2" %.2f))"
}
per() { awk -v a="$1" -v b="$2" -v f="$3" 'BEGIN { printf f, a / b }'; }

commit=$(git rev-parse --short HEAD 2>/dev/null || echo 'no commit')
git diff --quiet HEAD 2>/dev/null || commit="$commit with changes"
cpu=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1)
echo "Commit $commit, $($cc --version | head -n 1), ${cpu:-$(uname -m)}."
echo 'Medians, in brackets the least. body: the program alone; scan: with the edges of the scan. Inputs: zero: all are FALSE;'
echo 'fixed: random ones that stay; random: all change in each scan; 1 ms: the same, and the scans are a millisecond apart.'
echo
echo '| program | rungs | body, zero ns/rung | fixed | random | 1 ms | scan, fixed ns/rung | read ms | check and translate ms | memory to load MB | code bytes/rung | with maps bytes/rung |'
echo '|---|---|---|---|---|---|---|---|---|---|---|---|'
for kind in seal mixed dense ton ctu compare sum product; do
	for n in 1000 10000; do
		[ "$n" = 10000 ] && [ "$kind" != seal ] && [ "$kind" != mixed ] && continue
		perl "$(dirname "$0")/programs.pl" $kind $n >"$tmp/p.rung"
		"$ladder" bench --json "$tmp/p.rung" >"$tmp/p.json" 2>/dev/null
		code=$(field "$tmp/p.json" code_bytes)
		image=$(field "$tmp/p.json" image_bytes)
		echo "| $kind | $n | $(both zero $n) | $(both fixed $n) | $(both random $n) | $(both paced $n)" \
			"| $(per "$(median "$tmp/p.json" scan_fixed_ns)" $n %.2f)" \
			"| $(per "$(field "$tmp/p.json" read_ns)" 1000000 %.2f)" \
			"| $(per "$(field "$tmp/p.json" build_ns)" 1000000 %.2f)" \
			"| $(per "$(field "$tmp/p.json" load_bytes)" 1000000 %.1f)" \
			"| $(per "$code" $n %.0f) | $(per "$image" $n %.0f) |"
	done
done
echo
echo 'What has not changed is left out, ns a scan:'
echo
echo '| program | rungs | body, nothing changes | whole scan | one input changes | all change | the same with --full-scan |'
echo '|---|---|---|---|---|---|---|'
for kind in seal mixed; do
	perl "$(dirname "$0")/programs.pl" $kind 10000 >"$tmp/p.rung"
	"$ladder" bench --json "$tmp/p.rung" >"$tmp/p.json" 2>/dev/null
	echo "| $kind | 10000 | $(median "$tmp/p.json" rest_body_ns) | $(median "$tmp/p.json" rest_scan_ns)" \
		"| $(median "$tmp/p.json" rest_one_ns) | $(median "$tmp/p.json" rest_all_ns) | $(median "$tmp/p.json" scan_random_ns) |"
done
echo
echo 'Whole processes, from their start to their end:'
echo
echo '| program | rungs | `ladder check` ms | `ladderd`, one scan, ms | `ladderd` while it scans, KB in memory |'
echo '|---|---|---|---|---|'
for n in 1000 10000; do
	perl "$(dirname "$0")/programs.pl" seal $n >"$tmp/p.rung"
	echo "| seal | $n | $(perl "$(dirname "$0")/starts.pl" "$build" "$tmp/p.rung") |"
done
echo
echo '| 1,000 rungs of one family | body, zero ns/rung | fixed | random | code bytes/rung |'
echo '|---|---|---|---|---|'
for kind in $(perl "$(dirname "$0")/programs.pl" families); do
	perl "$(dirname "$0")/programs.pl" "$kind" 1000 >"$tmp/p.rung"
	"$ladder" bench --json "$tmp/p.rung" >"$tmp/p.json" 2>/dev/null
	cp "$tmp/p.json" "$tmp/$kind.json"
	echo "| $kind | $(both zero 1000) | $(both fixed 1000) | $(both random 1000)" \
		"| $(per "$(field "$tmp/p.json" code_bytes)" 1000 %.0f) |"
done
echo
echo "1,000 networks of 6 blocks: $(per "$(median "$tmp/network.json" body_fixed_ns)" 6000 %.1f) ns a block in FBD," \
	"$(per "$(median "$tmp/network_ld.json" body_fixed_ns)" 6000 %.1f) ns in LD."
if $cc -O2 -std=c11 -D_POSIX_C_SOURCE=200809L "$(dirname "$0")/real.c" -o "$tmp/real" -lm; then
	c=$("$tmp/real")
	vm=$(per "$(median "$tmp/real.json" body_fixed_ns)" 1000 %.2f)
	echo
	echo "1,000 REAL additions and comparisons: $vm ns each; the same C with -O2: $c ns; ratio $(per "$vm" "$c" %.1f)."
fi
echo
echo '| 10,000 lines of Structured Text | read ms | check and translate ms | together (60) | memory to load MB (60) |'
echo '|---|---|---|---|---|'
for of in 'lines:one program' 'blocks:blocks of 100 lines' 'parts:blocks of 10 lines'; do
	perl "$(dirname "$0")/programs.pl" "${of%%:*}" 10000 >"$tmp/p.rung"
	best=
	for _ in 1 2 3 4 5; do # the least, as other programs only add to it
		"$ladder" bench --json --scans 1 "$tmp/p.rung" >"$tmp/p.json" 2>/dev/null
		now="$(field "$tmp/p.json" read_ns) $(field "$tmp/p.json" build_ns)"
		best=$(echo "$now $best" | awk '{ print NF == 2 || $1 + $2 < $3 + $4 ? $1 " " $2 : $3 " " $4 }')
	done
	read=${best% *} translate=${best#* }
	echo "| ${of#*:} | $(per "$read" 1000000 %.1f) | $(per "$translate" 1000000 %.1f) | $(per "$((read + translate))" 1000000 %.1f)" \
		"| $(per "$(field "$tmp/p.json" load_bytes)" 1000000 %.1f) |"
done
# loop FILE ROUNDS TITLE: a program in ST beside the same in C, ns of one of its rounds.
loop() {
	"$ladder" bench --json "$(dirname "$0")/st/$1.st" >"$tmp/loop.json" 2>/dev/null
	st=$(per "$(median "$tmp/loop.json" body_fixed_ns)" "$2" %.2f)
	c=$(per "$(awk -v name="$1" '$1 == name { print $2 }' "$tmp/loops.txt")" "$2" %.2f)
	echo "| $3 | $st | $c | $(per "$st" "$c" %.1f) |"
}
if $cc -O2 -std=c11 -D_POSIX_C_SOURCE=200809L "$(dirname "$0")/loops.c" -o "$tmp/loops"; then
	"$tmp/loops" >"$tmp/loops.txt"
	echo
	echo '| Structured Text | ns | C with -O2, without checks, ns | ratio |'
	echo '|---|---|---|---|'
	loop int 1000 'a round of INT arithmetic with MOD'
	loop real 1000 'a round of a REAL product and sum'
	loop product 1000 'a round of the product of two arrays of INT'
	loop sort 1 'bubble sort of 100 INT, a scan'
	loop states 1 'a state machine of 50 states by CASE, a scan'
	loop pid 1 'a PID in REAL, a scan'
fi
# chart NAME FILE: prints a row of the table of charts.
chart() {
	"$ladder" bench --json "$2" >"$tmp/chart.json" 2>/dev/null
	echo "| $1 | $(median "$tmp/chart.json" body_fixed_ns) | $(median "$tmp/chart.json" body_random_ns)" \
		"| $(median "$tmp/chart.json" scan_fixed_ns)" \
		"| $(per "$(field "$tmp/chart.json" read_ns)" 1000000 %.2f)" \
		"| $(per "$(field "$tmp/chart.json" build_ns)" 1000000 %.2f) |"
}
nine=$(dirname "$0")/../../ladders/sequence-s0-s8.rung
echo
echo '| chart | body, at rest ns a scan | moving: random inputs | scan, at rest ns | read ms | check and translate ms |'
echo '|---|---|---|---|---|---|'
chart 'chart of nine steps (ladders/sequence-s0-s8)' "$nine"
for n in 200 1000; do
	perl "$(dirname "$0")/programs.pl" chart $n >"$tmp/p.rung"
	chart "$n steps, $((n * 6 / 5)) transitions, $((n / 50)) active" "$tmp/p.rung"
done
echo
echo 'Nine steps, as they were published: translated by hand to C, on a PC with 2.53 GHz, 66 ns a scan on average,'
echo 'at most 1.49 ms (with its user interface running).'
if [ -x "$build/ladderd" ]; then
	{
		echo 'BOARD "levels in memory"'
		for bit in 0 1 2 3 4 5; do echo "%IX0.$bit sim"; done
		for bit in 5 6 7; do echo "%QX0.$bit sim safe=0"; done
	} >"$tmp/nine.io"
	"$build/ladderd" "$nine" --io "$tmp/nine.io" --period 1ms --watchdog 1000 --scans 3000 2>/dev/null |
		sed -n 's/^body: \(.*\)/`ladderd`, a scan every ms, the program with the edges of its scan and two looks at the clock: \1./p'
fi
perl "$(dirname "$0")/programs.pl" empty 1 >"$tmp/p.rung"
"$ladder" bench --json "$tmp/p.rung" >"$tmp/p.json" 2>/dev/null
echo
echo '| recorder of a simulation | bytes of state | scans kept | MB | scans from frame to frame | scan us | with recorder us | showing any: median ms | worst ms |'
echo '|---|---|---|---|---|---|---|---|---|'
for of in 'noise 1000 100000' 'mixed 1000 100000' 'mixed 5000 30000' 'seal 5000 30000'; do
	set -- $of
	perl "$(dirname "$0")/programs.pl" "$1" "$2" >"$tmp/p.rung"
	"$build/tests/bench/record" "$1, $2 rungs" "$tmp/p.rung" "$3"
done
echo
echo "One whole scan of a program of one rung: $(median "$tmp/p.json" scan_fixed_ns) ns."
if [ -x "$build/ladderd" ]; then
	cp "$build/ladderd" "$tmp/ladderd"
	${STRIP:-strip} "$tmp/ladderd"
	echo "ladderd, stripped: $(wc -c <"$tmp/ladderd") bytes."
fi
echo
echo 'Other tools, 1,000 rungs, ns a rung, inputs zero / fixed / random; a virtual machine with 2 AMD EPYC processors, gcc 12.2 -O2.'
echo 'matiec 9d0e618 (2017-09-04), 2026-12-01, medians of 5 runs, alternately with Rungboard 0d81d673 (seal 0.53 in all cases, mixed 2.7):'
echo 'seal as ST 1.21 / 1.66 / 7.7, as IL 2.8 in all cases, mixed as ST 2.6 / 2.7 / 7.9.'
echo 'ClassicLadder cce0bb6 (2023-04-03, 0.9.114), 2026, before this project began, one input toggles: seal 104, mixed 123.'
