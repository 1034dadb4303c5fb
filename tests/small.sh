#!/bin/sh
# SPDX-License-Identifier: MIT
# small - the build for small boards (make SMALL=1) on this machine: its words and its
# smaller checksum give the same results as those of the full build.
set -u
cd "$(dirname "$0")/.." || exit 1
build=${BUILD:-build}
tmp=$(mktemp -d) || exit 1
trap 'rm -rf "$tmp"' EXIT

n=0 failed=0
say() { # status text
	n=$((n + 1))
	if [ "$1" -eq 0 ]; then echo "ok $n - $2"; return; fi
	failed=1
	echo "not ok $n - $2"
	sed 's/^/#   /' "$tmp/out" | tail -n 12
}
said() { # status wanted text : a test of the last command: its output and status
	[ "$1" -eq "$2" ] && grep -q "$3" "$tmp/out"
}

"$build/small/replay" "$build/cases/programs.bundle" >"$tmp/out" 2>&1
say $? '1,000 random programs: every scan byte for byte'

image() { "$build/ladder" build --small "$1" -o "$2" >"$tmp/out" 2>&1; }
check() { "$build/$1/ladderd" "$2" --io "$tmp/io" --check >"$tmp/out" 2>&1; }
printf 'BOARD "sim"\n' >"$tmp/io"
image tests/golden/word-real-errors/main.rung "$tmp/real.rungc"
say $? 'an image with words that WORDS=core has not'
image tests/golden/word-timers/main.rung "$tmp/ton.rungc"
say $? 'one with words of the core'
check small "$tmp/real.rungc"
said $? 0 'data:'; say $? 'all words: the first is accepted'
check small "$tmp/ton.rungc"
said $? 0 'data:'; say $? 'all words: so is the second'
check small-core "$tmp/real.rungc"
said $? 1 LD613; say $? 'WORDS=core: the first is refused'
check small-core "$tmp/ton.rungc"
said $? 0 'data:'; say $? 'WORDS=core: the second is accepted'
"$build/small/ladderd" tests/golden/word-timers/main.rung --io "$tmp/io" --check >"$tmp/out" 2>&1
said $? 1 LD610; say $? 'a rung file is not a code image'
: >"$tmp/io"
check small "$tmp/ton.rungc"
said $? 1 'LD101: file is empty'; say $? 'an empty I/O map: the text beside the code'
printf 'BOARD "sim"\n# \377\n' >"$tmp/io"
check small "$tmp/ton.rungc"
said $? 1 'LD104: not valid UTF-8'; say $? 'an I/O map that is not UTF-8: the same'
printf '\377\376B\0O\0' >"$tmp/io"
check small "$tmp/ton.rungc"
said $? 1 'LD142: this is UTF-16'; say $? 'an I/O map in UTF-16: the same'
# tests/online/small_line.py has the rest of it.
check small-serial "$tmp/ton.rungc"
said $? 1 UTF-16; say $? 'LINK=serial: the same of a map'
printf 'BOARD "sim"\n' >"$tmp/io"
check small-serial "$tmp/ton.rungc"
said $? 0 'data:'; say $? 'LINK=serial: the image is accepted'
"$build/small/ladderd" --help >"$tmp/out" && ! grep -q -- --serial "$tmp/out"
say $? 'without it there is no --serial'
"$build/small-serial/ladderd" --help >"$tmp/out" && grep -q -- --serial "$tmp/out" && ! grep -q -- --link "$tmp/out"
say $? 'LINK=serial: there is, and no --link'
! ${NM:-nm} -D "$build/small-serial/ladderd" | grep -E 'pthread|fork|exec' >"$tmp/out"
say $? 'LINK=serial: it starts no thread and no process'
# shellcheck disable=SC2069
make LINK=serial -n "$build/ladderd" 2>&1 >/dev/null | grep LINK=serial >"$tmp/out"
say $? 'LINK=serial needs SMALL=1'
# A change of the running program needs names, which it has not.
for kind in small small-core small-serial; do
	! ${NM:-nm} "$build/$kind/ladderd" | grep -i carry >"$tmp/out"
	say $? "$kind: no plan of a change is linked"
done
# The messages of its sources must have a code and a text there; so must those of the whole ladderd.
has_texts() { # macro, title; standard input: the sources
	xargs grep -oh 'DIAG_[A-Z0-9_]*' | sed 's/DIAG_//' | sort -u >"$tmp/given"
	printf '#define DIAG(id, code, severity, text) id DIAG_TEXT(code)\n#include "engine/diag.def"\n' |
		${CC:-cc} -E -P -Iruntime "-D$1" - | sed -n 's/^ *\([A-Z0-9_]*\) "\\0"$/\1/p' | sort >"$tmp/left"
	grep -q . "$tmp/left" && ! comm -12 "$tmp/given" "$tmp/left" | tee "$tmp/out" | grep -q .
	say $? "$2"
}
for kind in small small-serial; do
	# A desk prints what runtime/online/ refuses by a number.
	(cd "$build/$kind" && find runtime/engine runtime/ladderd hal -name '*.o') | sed 's/o$/c/' >"$tmp/sources"
	has_texts RUNGBOARD_SMALL "$kind: each message that it can give has its text" <"$tmp/sources"
done
# hal/buses.c is part of ladder and ladder-modbus alone.
find runtime/ladderd hal runtime/engine/base runtime/engine/scan runtime/engine/model runtime/engine/text \
	runtime/engine/check runtime/engine/translate runtime/engine/ladder.c -name '*.c' ! -path hal/buses.c >"$tmp/sources"
has_texts RUNGBOARD_BOARD 'so has each message of the whole ladderd' <"$tmp/sources"
echo "1..$n"
exit $failed
