#!/bin/sh
# SPDX-License-Identifier: MIT
# floors - a room includes only rooms below it, never one above or beside it.
#
# Prints a TAP line for each room and lists each wrong include with its file. Tests may
# include every room. FLOORS_ROOT names another tree to check.
set -u
cd "${FLOORS_ROOT:-$(dirname "$0")/..}" || exit 1

# Rooms of the engine that the editor and both programs may include, as paths in includes.
doors='engine/ladder.h engine/base engine/model engine/scan engine/show engine/compare engine/xref engine/trial engine/text/pou_print.h'
# Each line: a room, then what it may include besides itself: rooms (folders) and single
# headers.
rooms="
runtime/engine/base       engine/catalog.def engine/diag.def
runtime/engine/scan       engine/base engine/catalog.def
runtime/engine/model      engine/base engine/catalog.def engine/properties.def engine/classic.def
runtime/engine/text       engine/base engine/model
runtime/engine/check      engine/base engine/model engine/scan/vm.h
runtime/engine/translate  engine/base engine/model engine/check engine/scan/code.h engine/catalog.def
runtime/engine/show       engine/base engine/model engine/scan engine/check engine/text engine/translate
runtime/engine/xref       engine/base engine/model engine/scan engine/check engine/text engine/translate
runtime/engine/compare    engine/base engine/model engine/scan engine/check engine/text engine/translate
runtime/engine/convert    engine/base engine/model engine/check engine/text
runtime/engine/exchange   engine/base engine/check/reserved.h
runtime/engine/exchange/classic engine/base engine/model engine/check engine/text engine/translate engine/xref engine/exchange engine/classic.def
runtime/engine/exchange/iec_file engine/base engine/text
runtime/engine/exchange/ldmicro engine/base engine/exchange
runtime/engine/exchange/openplc engine/base engine/exchange
runtime/engine/exchange/plcopen engine/base engine/model engine/exchange engine/check engine/text engine/xref
runtime/engine/exchange/image engine/base engine/scan engine/exchange
runtime/engine/trial      engine/base engine/model engine/scan engine/check engine/text engine/translate engine/classic.def
runtime/engine            engine engine/base engine/model engine/scan engine/check engine/text engine/translate engine/show engine/xref engine/compare engine/convert engine/exchange engine/exchange/classic engine/exchange/iec_file engine/exchange/plcopen engine/trial
hal                       engine/base engine/scan/image.h engine/scan/code_access.h
runtime/ladder            $doors engine/exchange engine/exchange/classic engine/exchange/image hal online engine/text engine/catalog.def
runtime/online            engine/base engine/scan
runtime/attach
runtime/modbus            engine/base hal online
runtime/peer              engine/base online hal
runtime/guard
runtime/ladderd           engine/ladder.h engine/base engine/model engine/scan hal online guard/say.h
editor-gtk/kit/gtk48      $doors
editor-gtk/kit            $doors editor-gtk/kit/gtk48
editor-gtk/edit           $doors editor-gtk/kit engine/classic.def
editor-gtk/draw           $doors editor-gtk/kit/gtk48 editor-gtk/kit editor-gtk/edit engine/exchange/classic/classic_say.h engine/exchange/drawing.h
editor-gtk/document       $doors editor-gtk/kit/gtk48 editor-gtk/kit editor-gtk/edit editor-gtk/draw hal engine/exchange/report.h engine/exchange/drawing.h
editor-gtk/sim            $doors editor-gtk/kit/gtk48 editor-gtk/kit editor-gtk/edit editor-gtk/draw editor-gtk/document hal
editor-gtk/online         $doors editor-gtk/kit/gtk48 editor-gtk/kit editor-gtk/edit editor-gtk/draw editor-gtk/document editor-gtk/sim hal online engine/exchange/image
editor-gtk/canvas         $doors editor-gtk/kit/gtk48 editor-gtk/kit editor-gtk/edit editor-gtk/draw editor-gtk/document editor-gtk/sim editor-gtk/online
"
sheets='editor-gtk/kit/gtk48 editor-gtk/kit editor-gtk/edit editor-gtk/draw editor-gtk/document editor-gtk/sim editor-gtk/online editor-gtk/canvas'
for room in ladder sfc fbd text iomap live; do
	rooms="$rooms
editor-gtk/$room $doors $sheets hal online"
done
sheets="$sheets editor-gtk/ladder editor-gtk/sfc editor-gtk/fbd editor-gtk/text editor-gtk/iomap editor-gtk/live"
rooms="$rooms
editor-gtk/panels $doors $sheets online hal
editor-gtk/render $doors $sheets online hal
editor-gtk/window $doors $sheets online editor-gtk/panels editor-gtk/render hal
"
# Libraries that a room may include with < >, by the beginning of the path; all others
# belong to libc.
foreign='gpiod.h:hal iio.h:hal/iio_calls.c modbus.h:runtime/modbus/line.c avahi-client/:runtime/online/finder_avahi.c avahi-common/:runtime/online/finder_avahi.c md4c.h:editor-gtk/kit/ gtk/:editor-gtk/ glib:editor-gtk/ gio/:editor-gtk/ adwaita.h:editor-gtk/ gtksourceview/:editor-gtk/ pango/:editor-gtk/ cairo:editor-gtk/ libintl.h:editor-gtk/'
# Rooms of the editor that are built and tested without a toolkit.
plain='editor-gtk/edit'

n=0 failed=0
say() { # good text places
	n=$((n + 1))
	if [ "$1" -eq 0 ]; then echo "ok $n - $2"; return; fi
	failed=1
	echo "not ok $n - $2"
	printf '%s\n' "$3" | sed '/^$/d; s/^/#   /'
}

check_library() { # file path: may the file's room include <path>?
	# Our own headers are included with " ", where the table applies.
	[ ! -f "runtime/$2" ] && [ ! -f "$2" ] || return 1
	for row in $foreign; do
		case $2 in "${row%%:*}"*)
			case $1 in "$plain"/*) return 1;; "${row#*:}"*) return 0;; *) return 1;; esac;;
		esac
	done
}

check_room() { # room allowed…
	room=$1; shift
	if [ ! -d "$room" ]; then
		say 1 "$room is there" "$room: no such folder; take it out of the table"
		return
	fi
	bad=
	# One process for a room: a file, the kind of its include, and the path.
	while read -r file kind path; do
		[ -n "$file" ] || continue
		if [ "$kind" = '<' ]; then
			check_library "$file" "$path" || bad="$bad
$file includes <$path>"
			continue
		fi
		good=0
		for may in "$@" "${room#runtime/}"; do
			[ "${path%/*}" != "$may" ] && [ "$path" != "$may" ] || good=1
		done
		# Only the file of the facade is above all rooms of the engine.
		case $room,$path in runtime/engine/*,engine/ladder.h) good=0;; esac
		[ $good = 1 ] || bad="$bad
$file includes $path"
	done <<INCLUDES
$(find "$room" -maxdepth 1 \( -name '*.[ch]' -o -name '*.def' \) -exec awk '
	match($0, /^[ \t]*#[ \t]*include[ \t]*["<][^">]*[">]/) {
		path = substr($0, RSTART, RLENGTH)
		sub(/^[ \t]*#[ \t]*include[ \t]*/, "", path)
		print FILENAME, substr(path, 1, 1), substr(path, 2, length(path) - 2)
	}' {} + | LC_ALL=C sort -k1,1 -s)
INCLUDES
	[ -z "$bad" ]; say $? "$room includes only rooms below it" "$bad"
}

while read -r line; do
	[ -n "$line" ] || continue
	# shellcheck disable=SC2086
	check_room $line
done <<TABLE
$rooms
TABLE

# Folders with sources that are not in the table.
unknown=
for folder in $(find runtime hal editor-gtk -name '*.[ch]' -o -name '*.def' | sed 's|/[^/]*$||' | sort -u); do
	printf '%s\n' "$rooms" | grep -Eq "^$folder( |\$)" || unknown="$unknown
$folder"
done
[ -z "$unknown" ]; say $? "every folder with sources is a room of the table" "$unknown"
echo "1..$n"
exit $failed
