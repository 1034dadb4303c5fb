# shellcheck shell=sh
# SPDX-License-Identifier: MIT
# vehicle - the common part of all vehicles: names, folders, skipping, failing, booting a
# guest and printing its output. Sourced by them.
#
# A vehicle ends in one of four ways, with a last line in $out/result: passed, FAILED,
# skipped (a package is missing), or broken while building.
set -u
# Variables of the caller do not affect the builds here.
unset MAKEFLAGS MFLAGS MAKEOVERRIDES CC AR CROSS HAL SMALL LINK WORDS STATIC CFLAGS CPPFLAGS LDFLAGS
vehicle=$(basename "$0")
cd "$(dirname "$0")/../.." || exit 1
# shellcheck disable=SC2034 # for those that source this
here=tests/targets/lib
BUILD=${BUILD:-build}
out=$BUILD/targets/$vehicle
cache=${RUNGBOARD_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/rungboard}
mkdir -p "$out" "$cache" || exit 1
rm -f "$out/result"
began=$(date +%s)

# Writes the last line at every end.
ended() {
	code=$?
	took=$(($(date +%s) - began))
	[ -s "$out/result" ] || echo "FAILED: it ended before its tests" >"$out/result"
	echo "# $vehicle took $took s"
	[ -z "$guest" ] || kill "$guest"
	[ -z "$watcher" ] || kill "$watcher" 2>/dev/null
	printf '%-8s %s (%s s)\n' "$vehicle" "$(cat "$out/result")" "$took" >"$out/result.new"
	mv "$out/result.new" "$out/result"
	progress "$(cat "$out/result")"
	exit "$code"
}
guest='' watcher=''
trap ended EXIT
trap 'exit 130' INT TERM

# prove keeps back what a vehicle prints; what this prints is seen at once.
progress() { echo "# $vehicle, $(($(date +%s) - began)) s: $*" >&2; }
note() {
	echo "# $*"
	progress "$*"
}
skip() {
	echo "1..0 # SKIP $*"
	echo "SKIPPED: $*" >"$out/result"
	exit 0
}
# broken WHAT [LOG] : a build failed, which is no reason to skip.
broken() {
	# Not `Bail out!`, after which prove would leave the other machines running.
	echo "not ok 1 - $1"
	echo 1..1
	echo "FAILED: $1" >"$out/result"
	[ -z "${2:-}" ] || tail -n 25 "$2" | sed 's/^/# /'
	exit 1
}

# needs PROGRAM=PACKAGE... : prints all missing packages in one command.
needs() {
	lacking=
	for pair in "$@"; do
		case ${pair%%=*} in
		/*) [ -e "${pair%%=*}" ] ;;
		*) command -v "${pair%%=*}" >/dev/null ;;
		esac || case " $lacking " in
		*" ${pair#*=} "*) ;;
		*) lacking="$lacking ${pair#*=}" ;;
		esac
	done
	[ -z "$lacking" ] || skip "something is missing: apt-get install$lacking"
}

# boot EMULATOR... : runs an emulator until it ends. $out/console collects the output of the
# guests; guest_said prints it as one TAP and ends the vehicle.
: >"$out/console"
boot() {
	booted=$(date +%s)
	echo BOOT >>"$out/console"
	seen=$(stat -c %s "$out/console")
	# 0: no limit for the whole run. When this is ended, it ends the emulator and all its processes.
	timeout -k 5 0 "$@" </dev/null >>"$out/console" 2>&1 &
	guest=$!
	tail -s 0.2 -c "+$seen" -f --pid=$guest "$out/console" | while IFS= read -r line; do
		case $line in
		'# '*' -- '[0-9]*:* | BEGIN\ * | 'not ok '*) progress "$line" ;;
		esac
	done &
	teller=$!
	until_dead >/dev/null 2>&1 &
	watcher=$!
	wait $guest
	guest=
	kill $watcher 2>/dev/null
	watcher=
	wait $teller
	note "the guest ran for $(($(date +%s) - booted)) s"
}
# What a kernel prints when it goes no further. Some boards stop there and their emulator goes on.
dying='Kernel panic|System is deadlocked|Internal error:|Unable to handle kernel|Reboot failed|BUG: '
# Ends the emulator when its kernel has died, and after $HANGS seconds without a new line of TAP. A test
# takes less, also on a slow machine. What a dying kernel prints again and again is no line of TAP.
# guest_said prints why.
HANGS=${HANGS:-900}
until_dead() {
	quiet=0 before=
	# Counted and not by the clock: a machine that was suspended has not waited.
	while [ "$quiet" -lt "$HANGS" ]; do
		sleep 2
		kill -0 $guest 2>/dev/null || return
		why=$(tail -c "+$seen" "$out/console" | tr -d '\r' | grep -aEm 1 "$dying")
		[ -z "$why" ] || break
		now=$(grep -acE '^(not )?ok [0-9]|^# |^BEGIN |^RC=|^END' "$out/console")
		if [ "$now" = "$before" ]; then quiet=$((quiet + 2)); else quiet=0 before=$now; fi
	done
	[ -z "$why" ] || sleep 2 # the rest of what it prints
	printf '\nENDED %s\n' "${why:-it printed no line of TAP for $HANGS s}" >>"$out/console"
	kill $guest
}

# Each command of a guest has its own plan; one more line reports whether the plan was kept
# and the command ended well.
guest_said() {
	tr -d '\r' <"$out/console" | dying=$dying awk '
		function verdict(good, text) {
			print (good ? "" : "not ") "ok " ++all " - " text
			failed += !good
		}
		$0 ~ ENVIRON["dying"] && !died { died = "; its kernel said: " $0 }
		/^BOOT$/ { boots++; part = ""; next }
		/^END$/ { boots-- }
		/^BEGIN / { part = $2; count = 0; plan = "none"; next }
		/^RC=[0-9]+$/ && part {
			verdict($0 == "RC=0" && plan == count,
				part " ended: " count " tests of " plan ", status " substr($0, 4))
			part = ""
			next
		}
		/^ENDED / { verdict(0, "the guest was ended: " substr($0, 7)); next }
		!part || /^$/ { next }
		/^1\.\./ { plan = substr($1, 4); next }
		/^(not )?ok [0-9]+/ {
			count++
			failed += /^not / && !/ # (TODO|SKIP)/
			sub(/ok [0-9]+/, "ok " ++all)
		}
		/^ok [0-9]+ .*# SKIP/ { skipped++ }
		{ print }
		END {
			if (boots)
				verdict(0, "each guest came to its end" died)
			print "1.." all
			print (failed ? "FAILED: " failed " of " all : "passed: " all) " tests" \
				(skipped ? ", " skipped " of them skipped" : "") >result
			exit failed != 0
		}' result="$out/result"
	code=$?
	[ $code -eq 0 ] || tail -n 25 "$out/console" | sed 's/^/# console: /'
	exit $code
}
