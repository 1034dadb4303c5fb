#!/bin/sh
# SPDX-License-Identifier: MIT
#
# languages.t - every language of editor-gtk/po/ has every text of the editor.
#
# The template is made from the present sources. The quality of a translation is not tested.
cd "$(dirname "$0")/.." || exit 2
if ! command -v xgettext >/dev/null || ! command -v msgcmp >/dev/null; then
	echo "1..0 # SKIP xgettext is not here"
	exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
count=0

# told NAME COMMAND... - a test: the status of the command, and its output after a failure
told() {
	name=$1
	shift
	count=$((count + 1))
	if "$@" >"$work/said" 2>&1; then
		echo "ok $count - $name"
	else
		echo "not ok $count - $name"
		sed 's/^/# /' "$work/said"
	fi
}

# current LANGUAGE - merging the present template changes nothing
current() {
	msgmerge -q -N --add-location=file -o "$work/merged.po" "editor-gtk/po/$1.po" \
		"$work/fresh.pot" &&
		msgattrib --no-obsolete --add-location=file -o "$work/new.po" "$work/merged.po" &&
		diff "editor-gtk/po/$1.po" "$work/new.po" >"$work/diff" ||
		{ head -20 "$work/diff"; echo "make po, then translate what is new"; return 1; }
}

# whole LANGUAGE - all texts are translated, and none is fuzzy
whole() {
	msgcmp "editor-gtk/po/$1.po" "$work/fresh.pot" &&
		test -z "$(msgattrib --only-fuzzy "editor-gtk/po/$1.po")"
}

# once LANGUAGE - no translation has many more lines than its original: it would contain the
# text twice
once() {
	msgcat --no-wrap "editor-gtk/po/$1.po" | perl -00 -ne '
		next unless /^msgid ((?:".*"\n)+)msgstr ((?:".*"\n?)+)/m;
		my ($of, $said) = ($1, $2);
		next if $of eq "\"\"\n";
		my ($most, $lines) = map { scalar(() = /\\n/g) } $of, $said;
		if ($lines > $most + 2) { print "$lines lines, not $most: $of"; $bad = 1 }
		END { exit($bad ? 1 : 0) }'
}

# alike LANGUAGE - an ellipsis stands at its word, as in the other texts of the language
alike() {
	! msgcat --no-wrap "editor-gtk/po/$1.po" | grep '^msgstr.* …"$'
}

# pointed LANGUAGE - a number has the point of its original: the editor writes all numbers with one
pointed() {
	msgcat --no-wrap "${2:-editor-gtk/po/$1.po}" | perl -CSD -00 -ne '
		next unless /^msgid ((?:".*"\n)+)msgstr ((?:".*"\n?)+)/m;
		my ($of, $said) = ($1, $2);
		next if $of eq "\"\"\n";
		my ($points, $kept) = map { join " ", sort /(?<![\d.])\d+\.\d+(?![\d.])/g } $of, $said;
		if ($points ne $kept) { print "$points, not $kept: $of"; $bad = 1 }
		END { exit($bad ? 1 : 0) }'
}

# comma - tests the test: one decimal comma is noticed
comma() {
	sed '/^msgstr/s/0\.5 s TRUE/0,5 s TRUE/' editor-gtk/po/de.po >"$work/comma.po"
	! pointed de "$work/comma.po" >/dev/null
}

# kept - French texts have a no-break blank (U+00A0) before a colon and inside of quotes, a narrow
# one (U+202F) before ; ! ? so that no line begins with the sign. An original that has " : "
# itself shows a declaration.
kept() {
	msgcat --no-wrap "${1:-editor-gtk/po/fr.po}" | perl -CSD -00 -ne '
		my ($of, $said) = /^msgid (.*?)^msgstr(.*)/ms or next;
		next if $of eq "\"\"\n";
		my $colon = $of =~ / : / ? "" : ":";
		while ($said =~ /(.{0,24}(?: [$colon;!?](?=[ "\\.)\x{a0}]|$)|\x{ab} | \x{bb}))/g) {
			print "$1\n"; $bad = 1;
		}
		END { exit($bad ? 1 : 0) }'
}

# breaks - tests the test: one ordinary blank is noticed
breaks() {
	perl -CSD -pe '$done ||= s/\x{202f};/ ;/' editor-gtk/po/fr.po >"$work/breaks.po"
	! kept "$work/breaks.po" >/dev/null
}

# noticed LANGUAGE - tests the test: a missing text is noticed
noticed() {
	sed '0,/^msgstr "[^"]/s/^msgstr "[^"].*/msgstr ""/' "editor-gtk/po/$1.po" >"$work/less.po"
	! msgcmp "$work/less.po" "$work/fresh.pot" 2>/dev/null
}

told "a template of the sources" editor-gtk/po/pot.sh "$work/fresh.pot"
told "it has the texts of all sources" sh -c "
	for t in 'Cross reference' 'Match case' 'not a regular file' \
		'on-delay timer' 'seconds since 1970-01-01; ENO FALSE out of range' \
		'the wire is there already' 'Contacts'; do
		grep -qxF \"msgid \\\"\$t\\\"\" $work/fresh.pot || { echo \"\$t\"; exit 1; }
	done"
for language in $(cat editor-gtk/po/LINGUAS); do
	told "$language: every text is translated" whole "$language"
	told "$language: no text stands there twice" once "$language"
	told "$language: formats, plurals, access keys agree" msgfmt -c \
		--check-accelerators=_ -o /dev/null "editor-gtk/po/$language.po"
	told "$language: an ellipsis stands at its word" alike "$language"
	told "$language: numbers have the point of the original" pointed "$language"
	told "$language: is of these sources" current "$language"
done
told "a missing text would be noticed" noticed de
told "de: a decimal comma would be noticed" comma
told "fr: no line can begin with : ; ! ? or a closing quote" kept
told "fr: an ordinary blank there would be noticed" breaks
echo "1..$count"
