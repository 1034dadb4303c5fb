#!/bin/sh
# SPDX-License-Identifier: MIT
# changed - prints the rooms with changes in git, a path each: changes that are not
# committed, and those of the branch that its upstream does not have. Without changes: the
# rooms of the last commit.
set -u
cd "$(dirname "$0")/.." || exit 1

rooms() { # of the files on standard input; a test belongs to the room that it tests
	sed -n -e 's|^tests/editor/\(.*\)/[^/]*\.[ch]$|editor-gtk/\1|p' \
		-e 's|^tests/unit/\(ladder\)/[^/]*$|runtime/\1|p' \
		-e 's|^tests/unit/engine/[^/]*$|runtime/engine|p' \
		-e 's|^tests/unit/\(.*\)/[^/]*$|runtime/engine/\1|p' \
		-e 's|^tests/hal/.*|hal|p' \
		-e 's|^\(runtime/.*\)/[^/]*$|\1|p; s|^\(editor-gtk/.*\)/[^/]*$|\1|p; s|^hal/.*|hal|p' |
		sort -u | while read -r room; do
		if [ -d "$room" ]; then echo "$room"; fi
	done
}

base=$(git merge-base HEAD '@{upstream}' 2>/dev/null) || base=HEAD
found=$({ git diff --name-only "$base"; git ls-files -o --exclude-standard; } | rooms)
[ -n "$found" ] || found=$(git diff --name-only HEAD~1 2>/dev/null | rooms)
echo "$found"
