#!/bin/sh
# SPDX-License-Identifier: MIT
# headers - every header compiles alone: it includes what it needs. The build has proved that for those that a
# source includes first; the others are compiled here, and those of the toolkit, because the build includes its
# headers before.
set -u
cd "$(dirname "$0")/.." || exit 1
CC=${CC:-cc}
flags='-std=c11 -I. -Iruntime -D_POSIX_C_SOURCE=200809L'
gtk=$(pkg-config --cflags gtk4 libadwaita-1 gtksourceview-5 2>/dev/null)
tmp=$(mktemp -d) || exit 1
trap 'rm -rf "$tmp"' EXIT

# Fakes of a library's headers are left out; those of the editor, too, if its libraries are not here.
find runtime hal editor-gtk tests -name '*.h' ! -path 'tests/hal/*' | sort >"$tmp/all"
if [ -z "$gtk" ]; then
	grep -v -e '^editor-gtk/' -e '^tests/editor/' -e '^tests/bench/editor' "$tmp/all" >"$tmp/here"
	mv "$tmp/here" "$tmp/all"
fi
# The toolkit's headers take longest. They are compiled once, for the headers that include them, by themselves
# or through others of ours.
if [ -n "$gtk" ]; then
	echo '#include <adwaita.h>' >"$tmp/toolkit.h"
	# Flags are words: they are meant to be split.
	# shellcheck disable=SC2086
	$CC $flags $gtk -x c-header -o "$tmp/toolkit.h.gch" "$tmp/toolkit.h" || exit 1
	tr '\n' '\0' <"$tmp/all" | xargs -0 awk '
		/^#include [<"]/ {
			gsub(/[<">]/, "", $2)
			if ($2 ~ /^(gtk\/|adwaita|gtksourceview)/) has[FILENAME] = 1
			else below[FILENAME] = below[FILENAME] " " ($2 ~ /^engine\// ? "runtime/" $2 : $2)
		}
		function reaches(file, list, n, i) {
			if (file in seen) return file in has
			seen[file] = 1
			n = split(below[file], list, " ")
			for (i = 1; i <= n; i++) if (reaches(list[i])) has[file] = 1
			return file in has
		}
		END { for (file in below) reaches(file); for (file in has) print file }' >"$tmp/toolkit"
else
	: >"$tmp/toolkit"
fi
# What the build has proved. A header of the editor without the toolkit's is not among them.
find runtime hal editor-gtk tests -name '*.c' -print0 | xargs -0 awk '
	FNR == 1 { found = 0 }
	!found && /^#include/ {
		found = 1
		if ($2 ~ /^"/) { gsub(/"/, "", $2); print $2; print "runtime/" $2 }
	}' | sort -u >"$tmp/first"
{ cat "$tmp/toolkit"; grep -v -e '^editor-gtk/' -e '^tests/editor/' -e '^tests/bench/editor' "$tmp/all"; } |
	sort -u | comm -12 - "$tmp/first" >"$tmp/proved"
comm -23 "$tmp/all" "$tmp/proved" >"$tmp/alone"
# shellcheck disable=SC2016
tr '\n' '\0' <"$tmp/alone" | CC=$CC flags=$flags gtk=$gtk tmp=$tmp xargs -0 -n 1 -P "$(getconf _NPROCESSORS_ONLN)" sh -c '
	case $1 in editor-gtk/*|tests/editor/*|tests/bench/editor*) more=$gtk;; *) more=;; esac
	if grep -qxF "$1" "$tmp/toolkit"; then more="$more -include $tmp/toolkit.h"; fi
	out=$tmp/said/$1
	mkdir -p "${out%/*}"
	$CC $flags $more -Wall -Wextra -Wno-unused-function -Wno-unused-variable -Werror \
		-fsyntax-only -x c -include "$1" /dev/null >"$out" 2>&1 || echo failed >"$out.failed"
' sh
n=0 failed=0
while read -r header; do
	n=$((n + 1))
	if grep -qxF "$header" "$tmp/proved"; then
		echo "ok $n - $header: a source includes it first"
	elif [ -f "$tmp/said/$header" ] && [ ! -f "$tmp/said/$header.failed" ]; then
		echo "ok $n - $header"
	else
		failed=1
		echo "not ok $n - $header"
		sed 's/^/#   /' "$tmp/said/$header" | head -20
	fi
done <"$tmp/all"
echo "1..$n"
exit $failed
