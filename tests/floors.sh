#!/bin/sh
# SPDX-License-Identifier: MIT
# floors - includes point down the floors of the house, never up or sideways.
#
# One TAP line a room; the offending includes are listed. Tests are exempt. The
# table is the rule: a room may include itself, libc, and what stands behind it.
set -u
cd "$(dirname "$0")/.." || exit 1

rooms='
runtime/engine/base     engine/base/ engine/catalog.def engine/diag.def
runtime/engine/scan     engine/base/ engine/catalog.def
runtime/engine/model    engine/base/ engine/catalog.def
runtime/engine/text     engine/base/ engine/model/
runtime/engine/import   engine/base/ engine/check/
runtime/engine/check    engine/base/ engine/model/
runtime/engine/translate engine/base/ engine/model/ engine/check/ engine/scan/code.h engine/catalog.def
runtime/engine/trial    engine/
runtime/engine/view     engine/
runtime/engine/exchange engine/
runtime/engine          engine/
hal                     engine/base/ engine/scan/image.h hal/
runtime/ladder          engine/ladder.h engine/base/ engine/import/report.h engine/model/ engine/scan/ engine/view/ engine/trial/ engine/exchange/ hal/ ladder/
runtime/ladderd         engine/ladder.h engine/base/ engine/model/ engine/scan/ hal/ ladderd/
editor-gtk              engine/ladder.h engine/base/ engine/import/report.h engine/import/classic_say.h engine/model/ engine/scan/ engine/view/ engine/trial/ hal/ editor-gtk/
'
# Libraries that a room may include with < >; all others are libc's.
foreign='gpiod.h:hal gtk/:editor-gtk glib:editor-gtk gio/:editor-gtk adwaita.h:editor-gtk gtksourceview/:editor-gtk pango/:editor-gtk cairo:editor-gtk libintl.h:editor-gtk'

n=0 failed=0
say() { # good text places
	n=$((n + 1))
	if [ "$1" -eq 0 ]; then echo "ok $n - $2"; return; fi
	failed=1
	echo "not ok $n - $2"
	printf '%s\n' "$3" | sed '/^$/d; s/^/#   /'
}

check_room() { # room allowed…
	room=$1; shift
	[ -d "$room" ] || return 0
	bad=
	for file in "$room"/*.[ch] "$room"/*.def; do
		[ -f "$file" ] || continue
		for path in $(sed -n 's/^[[:space:]]*#[[:space:]]*include[[:space:]]*"\([^"]*\)".*/\1/p' "$file"); do
			good=0
			for may in "$@" "${room#runtime/}/"; do
				case $path in "$may"*) good=1;; esac
			done
			case $room,$path in
			# The library knows nothing of its programs, and nobody of tests.
			runtime/engine*,hal/* | runtime/engine*,ladder*/*) good=0;;
			*,tests/*) good=0;;
			# Only the facade's own file stands above all rooms.
			runtime/engine/*,engine/ladder.h) good=0;;
			# trial, view and exchange do not meet each other.
			runtime/engine/trial,engine/view/* | \
			runtime/engine/trial,engine/exchange/* | \
			runtime/engine/view,engine/trial/* | \
			runtime/engine/view,engine/exchange/* | \
			runtime/engine/exchange,engine/trial/* | \
			runtime/engine/exchange,engine/view/*) good=0;;
			esac
			[ $good = 1 ] || bad="$bad
$file includes $path"
		done
		for path in $(sed -n 's/^[[:space:]]*#[[:space:]]*include[[:space:]]*<\([^>]*\)>.*/\1/p' "$file"); do
			# Our own files come with " ", where the table sees them.
			[ ! -f "runtime/$path" ] && [ ! -f "$path" ] || bad="$bad
$file includes <$path>"
			for row in $foreign; do
				case $path in "${row%%:*}"*)
					[ "$room" = "${row#*:}" ] || bad="$bad
$file includes <$path>";;
				esac
			done
		done
	done
	[ -z "$bad" ]; say $? "$room includes downwards only" "$bad"
}

while read -r line; do
	[ -n "$line" ] || continue
	# shellcheck disable=SC2086
	check_room $line
done <<TABLE
$rooms
TABLE

# A room that the table does not know would be a hole in it.
unknown=
for folder in runtime/*/ runtime/engine/*/ hal/ editor-gtk/; do
	[ -d "$folder" ] || continue
	printf '%s\n' "$rooms" | grep -q "^${folder%/} " ||
		unknown="$unknown
$folder"
done
[ -z "$unknown" ]; say $? "every room stands in the table" "$unknown"
echo "1..$n"
exit $failed
