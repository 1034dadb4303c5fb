#!/bin/sh
# SPDX-License-Identifier: MIT
#
# pot.sh - every text of the editor that a person reads, as a template for translators.
#
# pot.sh OUTPUT, in the folder of the project. Six sources: the marked texts of the
# editor, its .ui files, the engine's diagnostics, its reports of imports and exports, events and alarms of a board, and what
# it says of its words (a row's texts are arguments of nested macros, so the preprocessor takes
# them apart; those of conversions are macros). It merges nothing: `make po` does.
set -eu
out=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LC_ALL=C.UTF-8
take="xgettext --from-code=UTF-8 --add-location=file --sort-by-file --package-name=Rungboard"

$take -L C -k -k_ -kN_ -kngettext:1,2 -o "$work/editor.pot" \
	$(find editor-gtk -name "*.c" -o -name "*.h" -o -name "*.def" | sort)
$take -L Glade -o "$work/ui.pot" editor-gtk/ui/*.ui 2>/dev/null
$take -L C -k -kDIAG:4 -o "$work/diag.pot" runtime/engine/diag.def

mkdir -p "$work/runtime/engine/model"
cat >"$work/rows.c" <<'ROWS'
#define ELEM(id, word, glyph, family, place, operand, edge, first, next, negate, doc) \
	N_(family) N_(doc)
#define FB(id, family, doc, pins) N_(family) N_(doc) pins
#define FB_DEF(fb, pin, type, value, doc) N_(doc)
#define FB_IN(fb, pin, type, doc) N_(doc)
#define FB_OUT(fb, pin, type, doc) N_(doc)
#define FB_TEXT(fb, pin, doc) N_(doc)
#define FB_VAR(fb, pin, type)
#define FB_STORE(fb, pin, type, count)
#define FN(id, family, doc, result, most, pins) N_(family) N_(doc) pins
#define FN_IN(pin, classes, doc) N_(doc)
#define FN_OWN(pin, classes, doc) N_(doc)
#define SYS(id, address, type, doc) N_(doc)
#include "engine/catalog.def"
ROWS
${CC:-cc} -E -P -Iruntime "$work/rows.c" | sed 's/N_("")//g' \
	>"$work/runtime/engine/catalog.def"
sed -n 's/^#define [A-Z_]* *\(".*"\)$/N_(\1)/p' runtime/engine/model/convert.c \
	>"$work/runtime/engine/model/convert.c"
mkdir "$work/runtime/engine/text" # the family of a project's own blocks
sed -n 's/.*\.family = \("[A-Za-z]*"\).*/N_(\1)/p' runtime/engine/text/read_words.c \
	>"$work/runtime/engine/text/read_words.c"
sed -n 's/^\t*\(.*? \)\?\("[a-z ]*"\|") or \]"\)\();\| :\)$/N_(\2)/p' runtime/engine/text/read_array.c \
	>"$work/runtime/engine/text/read_array.c" # of an expression, which xgettext misses
sed -n 's/^static const char blank\[\] = \(".*"\);$/N_(\1)/p' runtime/engine/text/mend.c \
	>"$work/runtime/engine/text/mend.c"
mkdir "$work/runtime/engine/trial"
sed -n 's/^WHY(\w*, *\("[^"]*"\), *\("[^"]*"\))$/N_(\1) N_(\2)/p' runtime/engine/trial/why.def |
	sed 's/ N_("")//' >"$work/runtime/engine/trial/why.def"
sed -n 's/^\t*\[FAILURE_[A-Z]*\] = \(".*"\),$/N_(\1)/p' runtime/engine/trial/scenario.c \
	>"$work/runtime/engine/trial/scenario.c"
mkdir "$work/runtime/engine/scan" # why a scan faults
sed -n 's/^\t*\[FAULT_[A-Z]*\] = \(".*"\),$/N_(\1)/p' runtime/engine/scan/vm.c \
	>"$work/runtime/engine/scan/vm.c"
(cd "$work" && $take -L C -k -kN_ -o catalog.pot runtime/engine/catalog.def \
	runtime/engine/model/convert.c runtime/engine/text/read_words.c \
	runtime/engine/text/read_array.c runtime/engine/text/mend.c runtime/engine/trial/why.def \
	runtime/engine/trial/scenario.c runtime/engine/scan/vm.c)

# What was expected, or too many: arguments of messages, those of them that are words.
$take -L C -k -kreader_fail_word:3 -kreader_fail_many:3 -kfail_word:3 -kfail_expected:2 -kreader_name:2 -kread_quoted:2 -kst_fail:5 \
	-kil_need_bool:4 -kreport:4 -kreport_line:5 -kreport_var:5 -o - \
	runtime/engine/text/*.c runtime/engine/model/*.c runtime/engine/check/*.c 2>/dev/null |
	msggrep --msgid -e '[a-z][a-z][a-z]' -e ' or ' -o "$work/args.pot" -

# Reports of an import or export; "%s" and the like are no words.
$take -L C -k -ktell:3 -ktell_change:2 -ktell_lost:2 -ktell_line:3 -kclassic_lost:2 -kREPORTED -o - \
	-kw_tell:3 runtime/engine/exchange/classic/*.c runtime/engine/exchange/ldmicro/*.c runtime/engine/exchange/openplc/*.c runtime/engine/exchange/plcopen/*.c | sed 's/charset=CHARSET/charset=UTF-8/' |
	msggrep --msgid -e '[a-z][a-z][a-z]' -o "$work/told.pot" -
$take -L C -k -kPROPERTY:2 -o "$work/properties.pot" runtime/engine/properties.def
$take -L C -k -kEVENT:3 -kALARM:4 -o "$work/events.pot" runtime/online/events.def runtime/online/alarms.def

# The date would differ each time, and nothing reads it.
xgettext --from-code=UTF-8 --add-location=file --package-name=Rungboard -L PO -o - \
	"$work/editor.pot" "$work/ui.pot" "$work/diag.pot" "$work/catalog.pot" \
	"$work/args.pot" "$work/told.pot" "$work/properties.pot" "$work/events.pot" |
	sed -e '/^"POT-Creation-Date:/d' -e 's/charset=CHARSET/charset=UTF-8/' >"$out"
