#!/bin/sh
# SPDX-License-Identifier: MIT
# headers - every header compiles alone: it includes what it needs.
set -u
cd "$(dirname "$0")/.." || exit 1
CC=${CC:-cc}
n=0 failed=0
for header in $(find runtime hal editor-gtk tests -name '*.h' 2>/dev/null | sort); do
	case $header in
	tests/hal/*) continue;; # fakes of a library's headers
	editor-gtk/*|tests/editor/*|tests/bench/editor*) flags=$(pkg-config --cflags gtk4 libadwaita-1 gtksourceview-5 2>/dev/null) || continue;;
	*) flags=;;
	esac
	n=$((n + 1))
	# shellcheck disable=SC2086
	if said=$($CC -std=c11 -I. -Iruntime -D_POSIX_C_SOURCE=200809L $flags \
		-Wall -Wextra -Wno-unused-function -Wno-unused-variable -Werror \
		-fsyntax-only -x c -include "$header" /dev/null 2>&1); then
		echo "ok $n - $header"
	else
		failed=1
		echo "not ok $n - $header"
		printf '%s\n' "$said" | sed 's/^/#   /' | head -20
	fi
done
echo "1..$n"
exit $failed
