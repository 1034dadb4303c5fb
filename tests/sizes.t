#!/bin/sh
# SPDX-License-Identifier: MIT
# sizes - ladderd for armhf, without the C library, stays within its limits: all of it, and what
# SMALL=1 makes with all words, with those of the core, and with the serial line beside them. `make sizes` has more figures, with
# another C library and for a Cortex-M3.
set -u
cd "$(dirname "$0")/.." || exit 1
cross=arm-linux-gnueabihf-
build=${BUILD:-build}/armhf
if ! command -v ${cross}gcc >/dev/null; then
	echo '1..0 # SKIP no compiler for armhf: apt-get install gcc-arm-linux-gnueabihf libc6-dev-armhf-cross'
	exit 0
fi
tmp=$(mktemp -d) || exit 1
trap 'rm -rf "$tmp"' EXIT

n=0 failed=0
# measure TITLE LIMIT FOLDER VARIABLE=VALUE... : the bytes of code and data of our own.
measure() {
	title=$1 limit=$2 folder=$build$3
	shift 3
	n=$((n + 1))
	rm -f "$folder/ladderd"
	if ! env -u CC -u MAKEFLAGS make -s BUILD="$folder" CROSS=$cross STATIC=1 HAL=uapi \
	    LDFLAGS="-static -Wl,-Map=$tmp/map" "$@" "$folder/ladderd" >"$tmp/log" 2>&1; then
		echo "not ok $n - $title can be built"
		tail -n 5 "$tmp/log" | sed 's/^/# /'
		failed=1
		return
	fi
	perl tests/targets/lib/rooms.pl "$tmp/map" >"$tmp/rooms"
	sed 's/^/# /' "$tmp/rooms"
	bytes=$(awk '!/C library|other/ { sum += $NF } END { print sum + 0 }' "$tmp/rooms")
	not=
	if [ "$bytes" -eq 0 ] || [ "$bytes" -gt "$limit" ]; then not='not ' failed=1; fi
	echo "${not}ok $n - $title has $bytes bytes, at most $limit"
}
# 342 KB with the link; 20 KB more for tasks that interrupt, alarms, clocks and what the guard needs; 27 KB for
# Structured Text and the declarations of plain IEC files; 5 KB for bit strings as numbers, pointers and TIME();
# 16 KB for parts of numbers, calls with EN and =>, AND_THEN, powers of integers, references, and the messages of ST;
# 2 KB for shorter ways through elements and loops, and for SWITCH;
# 6 KB for VAR_CONFIG, texts in double quotes, constants that are cut, and Structured Text in charts.
# 8 KB for EXECUTE boxes, arrays of blocks by an index, and bits and bytes of numbers in ladders and by name.
# 8 KB for actions, calls of programs, numbers of enumerations by expressions, and the names of object-oriented parts.
# 3 KB for labels and jumps of Structured Text, and for coils that write parts of one number.
# 10 KB for blocks and structures in declarations, what pointers lead to, unions, and structures with an address.
# 2 KB for indices that differ from a variable by a constant.
# 6 KB for programs that a CONFIGURATION connects, and blocks in functions.
# 14 KB for the lines of an I/O map that are values, buses, modules and windows.
# 4 KB for SPLIT_DATE and its kind, bytes the other way round, letters by numbers, labels in CASE, and edges in lists.
# 13 KB for channels of analog values and the drivers pwm, w1 and hwmon.
# 5 KB for gateways: their services, and their points in the map.
# 3 KB for MB_READ, MB_WRITE and what they ask for in a map, and for what a device takes in one request.
# 25 KB for Function Block Diagram: networks, wires and their types, feedback; for charts in function blocks, and for values that VAR_CONFIG gives to parts.
# 4 KB for all dimensions of arrays, NOT before outputs, places that overlap, types with names of instructions, and words of a map.
# 12 KB for values of several enumerations by their place, several resources, parts of numbers behind =>, blocks with a task
# of their own, and addresses of variables within blocks.
# 2 KB for numbers that plain IEC text converts by itself, values to begin with by other variables, and ENO of blocks.
# 3 KB for comparisons with three sides, members of other tools, resets of blocks, and two turns of truth tables at once.
# 4 KB for forces in the quality of values, serial lines that are not there, and what to do about a line or a disk that fails.
measure 'ladderd' 570368 '' CFLAGS=-O2
# The alarms and clocks are in all words; on a Cortex-M3 it has 120,237 of 124,928 bytes.
measure 'ladderd, SMALL=1' 105472 /small SMALL=1
measure 'ladderd, SMALL=1 WORDS=core' 67584 /small-core SMALL=1 WORDS=core
# 256 bytes more than the limit before, for lines of a map that are checked further after an error, and for quotes that stand
# twice in a text and lines that OpenPLC adds.
measure 'ladderd, SMALL=1 LINK=serial WORDS=core' 87296 /small-serial SMALL=1 LINK=serial WORDS=core

# ladder-guard: its code and all its tables. `make sizes` has the whole file with a C library: 40 KB at most.
n=$((n + 1)) not=
# In a folder of their own: tests/arm.sh builds some of them with other options.
guard=$(for file in runtime/guard/*.c; do echo "$build/guard/${file%.c}.o"; done)
# shellcheck disable=SC2086
if env -u CC -u MAKEFLAGS make -s BUILD="$build/guard" CROSS=$cross STATIC=1 HAL=uapi CFLAGS=-Os $guard >"$tmp/log" 2>&1; then
	bytes=$(${cross}size $guard | awk 'NR > 1 { sum += $4 } END { print sum + 0 }')
	[ "$bytes" -le 30720 ] || not='not ' failed=1
else
	not='not ' failed=1 bytes=?
	tail -n 5 "$tmp/log" | sed 's/^/# /'
fi
echo "${not}ok $n - ladder-guard has $bytes bytes with its tables, at most 30720"
# What allocates, or brings what does.
n=$((n + 1)) not=
# shellcheck disable=SC2086
calls=$(${cross}nm -u $guard | grep -wE '(m|c|re)alloc|strdup|realpath|(open|fdopen)dir|scandir|getline|fopen|[a-z]*printf|setenv|putenv|asprintf')
[ -z "$calls" ] || not='not ' failed=1
[ -z "$calls" ] || echo "$calls" | sed 's/^/# /'
echo "${not}ok $n - ladder-guard calls nothing that allocates"
echo "1..$n"
exit $failed
