#!/bin/sh
# SPDX-License-Identifier: MIT
#
# compilers - every source compiles without a warning with gcc and with clang.
#
# The build has compiled everything with one of them, with warnings as errors; here the
# other one checks the syntax.
set -u
flags='-std=c11 -I. -Iruntime -Itests -D_POSIX_C_SOURCE=200809L -Wall -Wextra -Wshadow
	-Wstrict-prototypes -Wmissing-prototypes -Wswitch-enum -Wvla -Werror'
# all_at_once COMPILER FLAG... : checks the files that standard input names. For each file of a command clang
# starts itself once more, which takes as long as the file. Its front end takes all files in one process.
all_at_once() {
	front=
	if [ "$1" = clang ]; then
		front=$("$@" -fsyntax-only -x c '-###' /dev/null 2>&1 |
			sed -n '/"-cc1"/{ s/ "-main-file-name" "null"//; s/ "\/dev\/null"$//p; }')
	fi
	if [ -n "$front" ]; then eval "set -- $front"; else set -- "$@" -fsyntax-only; fi
	xargs -0 -P 2 -n 16 "$@"
}
# The editor, if its libraries are installed; warnings in their headers do not count. The
# headers are read once, into a precompiled header.
editor() { # compiler
	gtk=$(pkg-config --cflags gtk4 libadwaita-1 gtksourceview-5 2>/dev/null | sed 's/-I/-isystem /g')
	[ -n "$gtk" ] || return 0
	pkg-config --exists md4c && md4c= || md4c=markdown_md4c.c
	set -- "$1" -DGETTEXT_PACKAGE='"rungboard"' -DLOCALEDIR='""' -DDATADIR='""'
	printf '#include <adwaita.h>\n#include <gtksourceview/gtksource.h>\n' >"$tmp/gtk.h"
	case $1 in clang) made=$tmp/gtk.h.pch ;; *) made=$tmp/gtk.h.gch ;; esac
	# Their words are meant to be split.
	# shellcheck disable=SC2086
	"$@" $flags $gtk -x c-header -o "$made" "$tmp/gtk.h" &&
		find editor-gtk tests/editor tests/bench/editor*.c -name '*.c' ! -name "$md4c" -print0 |
		all_at_once "$@" $flags $gtk -include "$tmp/gtk.h"
}
case $(${CC:-cc} --version) in *clang*) cc=gcc ;; *) cc=clang ;; esac
if ! command -v "$cc" >/dev/null; then
	echo "ok 1 - $cc # SKIP $cc is not installed"
	echo 1..1
	exit 0
fi
tmp=$(mktemp -d) || exit 1
log=$tmp/log
trap 'rm -rf "$tmp"' EXIT
status=0
# The gpio drivers are compiled against both libgpiods by the HAL tests, a module of a kernel by its vehicle.
pkg-config --exists libmodbus && modbus= || modbus='runtime/modbus/*'
pkg-config --exists libxml-2.0 && xml= || xml=xml_libxml2.c
pkg-config --exists libiio && iio= || iio=iio_libiio.c
libraries=$(for library in libmodbus libiio libxml-2.0; do pkg-config --cflags $library 2>/dev/null; done | tr '\n' ' ')
# shellcheck disable=SC2086
if find runtime hal tests -name '*.c' ! -name 'gpiod_v*.c' ! -path 'tests/hal/*' ! -path 'tests/targets/guest/values/*' ! -path "$modbus" ! -name "$iio" ! -name "$xml" \
	! -path 'tests/editor/*' ! -path 'tests/bench/editor*' ! -name 'gpio_find.c' ! -name room.c ! -name '*_small.c' -print0 |
		all_at_once $cc $flags $libraries >"$log" 2>&1 &&
	find runtime -name '*_small.c' -print0 |
		xargs -0 $cc -fsyntax-only $flags -DRUNGBOARD_SMALL >>"$log" 2>&1 &&
	editor $cc >>"$log" 2>&1; then
	echo "ok 1 - $cc has nothing to say"
else
	echo "not ok 1 - $cc has nothing to say"
	sed 's/^/# /' "$log" | head -n 40
	status=1
fi
echo 1..1
exit $status
