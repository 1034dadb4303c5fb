#!/bin/sh
# SPDX-License-Identifier: MIT
# deb.sh - builds the packages of Debian from a copy of this tree: deb.sh OUT [ARCH...]
#
# Each architecture is built in a Debian of its own that mmdebstrap makes once from the archive and
# that is kept in the cache: compilers of this architecture, libraries of the other one. Nothing is
# installed on this machine, and no program of another architecture runs. The build itself has no
# network. The result depends on the tree and that Debian alone: the time is that of the changelog.
set -eu
out=$1
shift
[ $# -gt 0 ] || set -- amd64 arm64 armhf
suite=bookworm
if ! command -v mmdebstrap >/dev/null; then
	echo "deb.sh: apt-get install mmdebstrap$([ "$(id -u)" = 0 ] || echo ' uidmap')" >&2
	exit 1
fi
cd "$(dirname "$0")/.."
mkdir -p "$out"
out=$(cd "$out" && pwd)
cache=${RUNGBOARD_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/rungboard}
mkdir -p "$cache"
here=$(dpkg --print-architecture)
umask 022
exec 3>&2
# A user gets the rights that this needs in namespaces only.
user=
[ "$(id -u)" = 0 ] || user='--map-root-user --map-auto'

# What the editor and the command line are linked with; dpkg-shlibdeps asks the packages.
libraries='libadwaita-1-0 libavahi-client3 libcrypt1 libgtk-4-1 libgtksourceview-5-0 libmd4c0 libmodbus5 libxml2'
control=packaging/debian/control

# Makes the Debian for architecture $1 if it is not in the cache, and sets root. It is the release
# alone, without later updates, so that the packages depend on nothing newer.
root_for() {
	root=$cache/deb-$1-$({
		sed '/^$/,$d' $control
		sed -n -e '/^suite=/p' -e '/^libraries=/p' -e '/^root_/,/^}/p' packaging/deb.sh
	} | sha256sum | cut -c 1-16).tar
	[ ! -f "$root" ] || return 0
	echo "deb.sh: a Debian to build for $1 (once)" >&3
	rm -f "$cache/deb-$1-"*
	# shellcheck disable=SC2016
	archive=$(apt-get indextargets --format '$(REPO_URI) $(COMPONENT) $(ORIGIN)' |
		awk '$2 == "main" && $3 == "Debian" && $1 !~ /security/ { print $1; exit }')
	archive=${archive:+deb $archive $suite main}
	if [ "$1" = "$here" ]; then
		root_here
	else
		root_cross "$1" "$(dpkg-architecture -a"$1" -qDEB_HOST_MULTIARCH)"
	fi && mv "$root.new" "$root"
}

# shellcheck disable=SC2016,SC2086
root_here() {
	mmdebstrap --variant=apt --format=tar --include=build-essential \
		--customize-hook='mkdir -p "$1/build/debian"' \
		--customize-hook="copy-in $control /build/debian" \
		--customize-hook='chroot "$1" apt-get -y --no-install-recommends build-dep /build' \
		--customize-hook='rm -r "$1/build"' \
		$suite "$root.new" ${archive:+"$archive"}
}

# Debian cannot install GTK's headers for two architectures, so those of the other one are only
# unpacked: root_cross ARCH TRIPLET.
# shellcheck disable=SC2016,SC2046,SC2086
root_cross() {
	mmdebstrap --variant=extract --format=tar --architectures="$1" --include="$(
		sed -n 's/^ *\(Build-Depends:\)\{0,1\} *\(lib[a-z0-9.+-]*-dev\)[ ,].*/\2/p' $control | tr '\n' ,)" \
		$suite - ${archive:+"$archive"} |
		mmtarfilter --path-exclude='/*' --path-include='/usr/include/*' --path-include='/usr/share/pkgconfig/*' \
			--path-include="/usr/lib/$2/*" >"$work/dev.tar" &&
		mmdebstrap --variant=apt --format=tar --architectures="$here,$1" \
			--include="crossbuild-essential-$1,debhelper,gettext,libgtk-4-dev,libmodbus-dev,pkg-config,$(
			printf "%s:$1," $libraries)" \
			--customize-hook="tar-in $work/dev.tar /" $suite "$root.new" ${archive:+"$archive"}
}

# The options of dpkg-buildpackage that choose the architecture $1.
for_arch() {
	[ "$1" = "$here" ] || echo "-a$1 -d -Pcross"
}

# Builds for architecture $1 in the folder $work, without a network.
build_in() {
	# shellcheck disable=SC2016,SC2046,SC2086
	unshare $user --mount --pid --net --fork --kill-child sh -euc '
		mkdir root
		tar -x --exclude="./dev/*" -C root <"$1"
		mount -t proc proc root/proc
		mount --rbind /dev root/dev
		mkdir root/build
		tar -x -C root/build <tree.tar
		shift
		exec chroot root env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/nonexistent LC_ALL=C.UTF-8 \
			DEB_BUILD_OPTIONS="noautodbgsym nocheck parallel=$1" \
			sh -ec "cd /build/rungboard; shift; dpkg-buildpackage -b -us -uc \$*; cd ..; tar -cf /build.tar *.deb" sh "$@"
	' sh "$root" "${JOBS:-$(nproc)}" $(for_arch "$1") >>log 2>&1
}

for arch; do
	work=$out/$arch
	rm -rf "$work"
	mkdir -p "$work/rungboard"
	git ls-files -zco --exclude-standard | tar -c --null -T - | tar -x -C "$work/rungboard"
	cp -r packaging/debian "$work/rungboard/debian"
	tar -c --sort=name -C "$work" -f "$work/tree.tar" rungboard
	if ! root_for "$arch" >>"$work/log" 2>&1 || ! (cd "$work" && build_in "$arch"); then
		tail -n 30 "$work/log" >&2
		exit 1
	fi
	tar -x -C "$out" <"$work/root/build.tar"
	if [ -z "${KEEP-}" ]; then
		# shellcheck disable=SC2086
		unshare $user --mount rm -rf "$work/root" "$work/rungboard" "$work/tree.tar"
	fi
done
