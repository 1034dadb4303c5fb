#!/bin/sh
# SPDX-License-Identifier: MIT
#
# compilers - every source compiles without a warning with gcc and with clang.
#
# The build has done it with its own compiler and flags; here only the syntax is
# looked at, so that the other compiler costs seconds.
set -u
flags='-std=c11 -I. -Iruntime -Itests -D_POSIX_C_SOURCE=200809L -Wall -Wextra -Wshadow
	-Wstrict-prototypes -Wmissing-prototypes -Wswitch-enum -Wvla -Werror -fsyntax-only'
# The editor, where its libraries are; their headers are not ours to judge.
editor() { # compiler
	gtk=$(pkg-config --cflags gtk4 libadwaita-1 gtksourceview-5 2>/dev/null) || return 0
	# Their words are meant to be split.
	# shellcheck disable=SC2046,SC2086
	find editor-gtk tests/editor tests/bench/editor*.c -name '*.c' -print0 |
		xargs -0 -P 2 -n 8 "$1" $flags $(echo "$gtk" | sed 's/-I/-isystem /g') \
			-DGETTEXT_PACKAGE='"rungboard"' -DLOCALEDIR='""' -DDATADIR='""'
}
n=0
status=0
for cc in gcc clang; do
	n=$((n + 1))
	if ! command -v $cc >/dev/null; then
		echo "ok $n - $cc # SKIP $cc is not installed"
		continue
	fi
	log=$(mktemp)
	# The gpio drivers are compiled against both libgpiods by the HAL tests.
	# shellcheck disable=SC2086
	if find runtime hal tests -name '*.c' ! -name 'gpiod_v*.c' ! -path 'tests/hal/*' \
		! -path 'tests/editor/*' ! -path 'tests/bench/editor*' ! -name 'gpio_find.c' ! -name '*_small.c' -print0 |
			xargs -0 -P 2 -n 8 $cc $flags >"$log" 2>&1 &&
		find runtime -name '*_small.c' -print0 |
			xargs -0 $cc $flags -DRUNGBOARD_SMALL >>"$log" 2>&1 &&
		editor $cc >>"$log" 2>&1; then
		echo "ok $n - $cc has nothing to say"
	else
		echo "not ok $n - $cc has nothing to say"
		sed 's/^/# /' "$log" | head -n 40
		status=1
	fi
	rm -f "$log"
done
echo "1..$n"
exit $status
