#!/bin/sh
# SPDX-License-Identifier: MIT
# deb.sh - builds the packages of Debian from a copy of this tree: deb.sh OUT [ARCH...]
#
# The editor is built for the architecture of this machine only; a cross build needs no library of
# the other one. The result depends on the tree alone: the time is that of the changelog.
set -eu
out=$1
shift
[ $# -gt 0 ] || set -- amd64 arm64 armhf
if ! command -v dh >/dev/null || ! command -v dpkg-buildpackage >/dev/null; then
	echo "deb.sh: apt-get install debhelper dpkg-dev" >&2
	exit 1
fi
cd "$(dirname "$0")/.."
mkdir -p "$out"
out=$(cd "$out" && pwd)
here=$(dpkg --print-architecture)
umask 022
for arch; do
	work=$out/$arch
	rm -rf "$work"
	mkdir -p "$work/rungboard"
	git ls-files -zco --exclude-standard | xargs -0 tar -c | tar -x -C "$work/rungboard"
	cp -r packaging/debian "$work/rungboard/debian"
	native=
	[ "$arch" = "$here" ] || native='-d -Ppkg.rungboard.noeditor,cross'
	# The options are words.
	# shellcheck disable=SC2086
	(cd "$work/rungboard" && LC_ALL=C.UTF-8 DEB_BUILD_OPTIONS="noautodbgsym nocheck parallel=${JOBS:-$(nproc)}" \
		dpkg-buildpackage -b -us -uc -a"$arch" $native >"$work/log" 2>&1) || {
		tail -n 30 "$work/log" >&2
		exit 1
	}
	mv "$work"/*.deb "$out/"
	[ -n "${KEEP-}" ] || rm -rf "$work/rungboard"
done
