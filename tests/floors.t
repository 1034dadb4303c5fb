#!/bin/sh
# SPDX-License-Identifier: MIT
# floors.t - floors.sh finds each kind of wrong include, room and library.
#
# It works on a copy of the sources, with all mistakes at once; each must be reported.
cd "$(dirname "$0")/.." || exit 2
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -R runtime hal editor-gtk "$copy"
n=0

# wrong FILE INCLUDE: FILE gets `#include INCLUDE`, which floors.sh must list.
wrong() {
	printf '#include %s\n' "$2" >>"$copy/$1"
	printf '%s includes %s\n' "$1" "$2" | tr -d '"' >>"$copy/expected"
}
wrong runtime/engine/base/arena.c '"engine/model/rung.h"'           # up
wrong runtime/engine/model/rung.c '"engine/scan/code.h"'            # sideways
wrong runtime/engine/check/check_rung.c '"engine/text/text.h"'      # sideways
wrong runtime/engine/xref/xref.c '"engine/show/sfc_layout.h"'       # sideways
wrong runtime/engine/text/read_rung.c '"engine/ladder.h"'           # the facade
wrong runtime/engine/scan/vm.c '"hal/hal.h"'                        # another floor
wrong runtime/ladderd/cycle.c '"engine/trial/twin.h"'               # no door of this program
wrong hal/hal.c '"engine/model/rung.h"'
wrong hal/sim.c '"tests/tap.h"'                                     # a test
wrong hal/iomap.c '<gtk/gtk.h>'                                     # a library of another room
wrong editor-gtk/edit/grid_edit.c '<gtk/gtk.h>'                     # a room without toolkit
wrong editor-gtk/kit/theme.c '"editor-gtk/draw/grid_draw.h"'        # up
wrong editor-gtk/document/document.c '"editor-gtk/sim/sim.h"'       # up
wrong editor-gtk/ladder/grid_view.c '"editor-gtk/sfc/sfc_view.h"'   # sideways
wrong editor-gtk/panels/palette.c '"editor-gtk/window/window.h"'    # up
wrong editor-gtk/text/text_view.c '<engine/ladder.h>'               # ours, as if a library
wrong editor-gtk/sim/sim.c '"engine/translate/translate.h"'         # no door of the engine
mkdir "$copy/editor-gtk/attic"                                      # an unknown room
echo >"$copy/editor-gtk/attic/attic.c"
echo 'editor-gtk/attic' >>"$copy/expected"
rm -r "$copy/editor-gtk/iomap"                                      # a room that is gone
echo 'editor-gtk/iomap: no such folder' >>"$copy/expected"

FLOORS_ROOT=$copy sh tests/floors.sh >"$copy/said"
status=$?
while read -r line; do
	n=$((n + 1))
	if grep -qF "$line" "$copy/said"; then echo "ok $n - told: $line"
	else echo "not ok $n - told: $line"; fi
done <"$copy/expected"
n=$((n + 1))
if [ $status -ne 0 ]; then echo "ok $n - floors.sh fails"; else echo "not ok $n - it fails"; fi
# banned.pl finds a public function that nobody calls, and one that only its own file calls. A test
# does not count; its own test may name a function that its file uses.
mkdir "$copy/tests"
{
	echo '/* SPDX-License-Identifier: MIT'
	echo ' *'
	echo ' * test_sink - calls functions. */'
	echo 'int main(void) { return only_tests() + own_and_test(); }'
} >"$copy/tests/test_sink.c"
{
	echo 'int only_tests(void)' && echo '{' && echo '	return 0;' && echo '}'
	echo 'int own_and_test(void)' && echo '{' && echo '	return 0;' && echo '}'
	echo 'int only_here(void)' && echo '{' && echo '	return own_and_test();' && echo '}'
	echo 'static int calls(void)' && echo '{' && echo '	return only_here() + calls();' && echo '}'
} >>"$copy/runtime/engine/base/sink.c"
BANNED_ROOT=$copy perl tests/banned.pl >"$copy/said" 2>/dev/null
# told RULE: which of these functions are listed below the rule.
told() {
	sed -n "/- $1\$/,/^[on]/p" "$copy/said" | sed -n 's|^#   runtime/engine/base/sink.c: ||p' | tr '\n' ' '
}
n=$((n + 1))
if [ "$(told 'the program uses every public function')" = 'only_tests ' ] &&
	[ "$(told 'what one file uses is static')" = 'only_here ' ]; then
	echo "ok $n - told: functions without a caller"
else
	echo "not ok $n - told: functions without a caller"
fi
# The unchanged tree has no mistake, so the messages above come from the changes.
n=$((n + 1))
if sh tests/floors.sh >"$copy/clean"; then echo "ok $n - nothing is told of the tree as it is"
else
	echo "not ok $n - nothing is told of the tree as it is"
	sed -n '/^not ok/,/^ok/p' "$copy/clean" | sed 's/^/#   /'
fi
echo "1..$n"
