#!/bin/sh
# SPDX-License-Identifier: MIT
# make.sh BUILD CASES PROGRAMS - writes all cases of the guest suite to CASES: the samples
# of ladders/ that use only bits, the programs of the suite, maps, images with errors, and
# the bundle of random programs.
set -eu
build=$1 done=$2 programs=$3
cases=$done.new # renamed at the end, so that it is complete
guest=tests/targets/guest
rm -rf "$cases"
mkdir -p "$cases"
cp ladders/boards/s3c44b0x.io ladders/boards/raspberry-pi-analog.io "$cases"
: >"$cases/plans"

build_image() { # FILE.rung
    name=$(basename "$1" .rung)
    cp "$1" "$cases"
    "$build/ladder" build "$1" -o "$cases/$name.rungc"
}

for rung in ladders/*.rung; do
    name=$(basename "$rung" .rung)
    case $name in *.plant) continue ;; esac
    map=
    [ "$name" != board-44b0x ] || map=$cases/s3c44b0x.io
    status=0
    "$build/make_cases" plan "$cases" "$rung" "ladders/$name.scn" \
        ${map:+"$map"} || status=$?
    case $status in
    0)  echo "$name" >>"$cases/plans"
        build_image "$rung" ;;
    3)  echo "# $name: left out, it uses more than bits, or has tasks" ;;
    *)  exit 1 ;;
    esac
done

for rung in "$guest"/programs/*.rung; do
    build_image "$rung"
done
# A thousand motors with seal-in, to measure memory.
perl tests/bench/programs.pl seal 1000 >"$cases/thousand.rung"
"$build/ladder" build "$cases/thousand.rung" -o "$cases/thousand.rungc" 2>/dev/null
# Four elements each, to measure a start.
perl tests/bench/programs.pl seal 2500 >"$cases/ten-thousand.rung"
"$build/ladder" build "$cases/ten-thousand.rung" -o "$cases/ten-thousand.rungc" 2>/dev/null
cp "$guest"/programs/*.io "$cases"
"$build/make_cases" bad "$cases" "$cases/panel.rungc"
"$build/make_cases" bundle "$cases/programs.bundle" "$programs" 1
rm -rf "$done"
mv "$cases" "$done"
