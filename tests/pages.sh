#!/bin/sh
# SPDX-License-Identifier: MIT
#
# pages - checks shell scripts and man pages with their own tools.
set -u
BUILD=${BUILD:-build}
n=0
status=0
say() { # exit status, what, log
	n=$((n + 1))
	if [ "$1" -eq 0 ]; then
		echo "ok $n - $2"
	else
		echo "not ok $n - $2"
		printf '%s\n' "$3" | sed 's/^/# /' | head -n 20
		status=1
	fi
}
for tool in shellcheck mandoc; do
	if ! command -v $tool >/dev/null; then
		n=$((n + 1))
		echo "ok $n # SKIP $tool is not installed"
	fi
done
if command -v shellcheck >/dev/null; then
	log=$(shellcheck -S warning run .ci/run tests/*.sh tests/bench/*.sh \
		packaging/ladderd-run packaging/ladderd.procd 2>&1)
	say $? 'shellcheck has nothing to say' "$log"
fi
if command -v mandoc >/dev/null; then
	for page in "$BUILD"/man/*.[18]; do
		log=$(mandoc -T lint -W error "$page" 2>&1)
		say $? "$(basename "$page") is a good man page" "$log"
	done
fi
echo "1..$n"
exit $status
