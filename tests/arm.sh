#!/bin/sh
# SPDX-License-Identifier: MIT
# arm - the engine on arm64 and armhf in user mode of qemu: every unit test, the golden
# cases, the second evaluator, the cases of the standard, and programs with traces from
# this machine. EMULATED tells unit tests to try fewer random cases. `make arm` builds the
# programs. There is no GPIO here; tests/targets has machines for that.
set -u
cd "$(dirname "$0")/.." || exit 1
build=${BUILD:-build}
count=${COUNT:-500} # random programs for the second evaluator
export EMULATED=1
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT

failed=0
say() { # status text
	n=$((n + 1))
	if [ "$1" -eq 0 ]; then echo "ok $n - $2"; return; fi
	failed=1
	echo "not ok $n - $2"
	sed -n '/^not ok/s/^/#   /p; $s/^/#   /p' "$out"
}

# run_arch NAME EMULATOR CROSS PACKAGE
run_arch() {
	n=0 out=$tmp/$1.out
	if ! command -v "$2" >/dev/null || ! command -v "$3gcc" >/dev/null; then
		n=$((n + 1))
		echo "ok $n # SKIP $1 did not run: apt-get install qemu-user $4"
		# prove counts such a line as good and prints nothing about it.
		echo "arm.sh: $1 was skipped: apt-get install qemu-user $4" >&2
		return
	fi
	for program in "$build/$1"/unit/*/test_* "$build/$1"/unit/*/*/test_* "$build/$1"/tests/bin/iec_cases; do
		case $program in *.d | *.o) continue;; esac
		# Programs at the limits of the format differ by the size of a word, and arm64 has that of this machine.
		case $program in */arm64/*/test_limits) continue;; esac
		"$2" "$program" >"$out" 2>&1
		say $? "$1: ${program#"$build/$1"/}"
	done
	"$2" "$build/$1/tests/bin/differential" --count "$count" >"$out" 2>&1
	say $? "$1: the second evaluator, $count random programs"
	"$2" "$build/$1/replay" "$build/cases/programs.bundle" >"$out" 2>&1
	say $? "$1: 1,000 random programs: the traces of the machine that built, byte for byte"
	LADDER_BATCH="$2 $build/$1/tests/ladder_batch" perl tests/golden.t >"$out" 2>&1
	say $? "$1: the golden cases, byte by byte"
	return $failed
}

# Runs both at once and numbers the lines of both.
run_arch arm64 qemu-aarch64 aarch64-linux-gnu- \
	'gcc-aarch64-linux-gnu libc6-dev-arm64-cross' >"$tmp/arm64" &
run_arch armhf qemu-arm arm-linux-gnueabihf- \
	'gcc-arm-linux-gnueabihf libc6-dev-armhf-cross' >"$tmp/armhf"
failed=$?
wait $! || failed=1
awk '/^(not )?ok [0-9]/ { sub(/ok [0-9]+/, "ok " ++n) } { print } END { print "1.." n }' "$tmp/arm64" "$tmp/armhf"
exit $failed
