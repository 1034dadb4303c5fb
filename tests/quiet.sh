#!/bin/sh
# SPDX-License-Identifier: MIT
# quiet - code that runs in a scan does not use the system, and the library has no global
# state.
#
# scan/, linked with the few files of base/ that it needs, may leave only mem*, strlen, the
# exact part of libm and compiler helpers undefined. BUILD: the folder of the objects.
set -u
cd "$(dirname "$0")/.." || exit 1
BUILD=${BUILD:-build} CROSS=${CROSS:-}
LD=${LD:-${CROSS}ld} NM=${NM:-${CROSS}nm}
objects=$BUILD/runtime/engine
n=0 failed=0
say() {
	n=$((n + 1))
	if [ "$1" -eq 0 ]; then echo "ok $n - $2"; return; fi
	failed=1
	echo "not ok $n - $2"
	printf '%s\n' "$3" | sed '/^$/d; s/^/#   /'
}

# Files of scan/ that run in a scan; the others are called between scans (symbols, plans,
# text of an instruction, the verifier) and may use more.
between='code|code_[a-z]*|declared|carry_[a-z]*|place|symbols|symbol_index|retain_[a-z]*|still_table'
scan=
for object in "$objects"/scan/*.o; do
	name=$(basename "$object" .o)
	printf '%s' "$name" | grep -Eqx "$between" || scan="$scan $object"
done
whole=$(mktemp) || exit 1
trap 'rm -f "$whole"' EXIT

# Functions of libm whose results IEEE 754 defines to the last bit; those of sin and others
# vary.
libm='(fabs|fmod|sqrt|trunc|floor|ceil|round|rint|l?lrint|nearbyint|isnan|isinf|finite|__isnan|__isinf|__finite|__fpclassify)f?'
helpers='__aeabi_[a-z0-9]*|__u?divdi3|__u?moddi3|__u?divmoddi4|__(mul|add|sub|neg)v[sd]i3|__stack_chk_fail|__stack_chk_guard|_GLOBAL_OFFSET_TABLE_|__(mulo|ashl|ashr|lshr|mul)[a-z0-9]*|__(fix|float)[a-z0-9]*|__popcount[a-z0-9]*|__clz[a-z0-9]*|__gnu_[a-z0-9_]*'
# shellcheck disable=SC2086
if $LD -r -o "$whole" $scan "$objects"/base/areas.o "$objects"/base/iec.o "$objects"/base/iec_days.o \
	"$objects"/base/catalog.o "$objects"/base/digest.o "$objects"/base/big.o \
	"$objects"/base/decimal.o "$objects"/base/number.o "$objects"/base/name.o \
	"$objects"/base/utf8.o 2>/dev/null; then
	open=$($NM -u "$whole" | awk '{print $NF}' |
	       grep -Evx "mem(cpy|move|set|cmp|chr)|strlen|$libm|$helpers")
	[ -z "$open" ]; say $? "scan/ leaves only mem*, strlen, exact libm and helpers open" "$open"
else
	say 1 "scan/ and its few files of base/ can be linked" "$LD -r failed"
fi

# Files that are called between scans: text and an arena only.
for object in "$objects"/scan/*.o; do
	name=$(basename "$object" .o)
	printf '%s' "$name" | grep -Eqx "$between" || continue
	open=$($NM -u "$object" | awk '{print $NF}' |
	       grep -Evx "mem(cpy|move|set|cmp|chr)|$helpers|snprintf|str(len|r?chr|n?cmp|n?casecmp)|arena_[a-z]*|(areas|carry|iec|word|moves|name|digest|code|verify|image|resource|retain|declared|interrupt|still|symbol|task|tasks|vm_row|sys)[a-z0-9_]*")
	[ -z "$open" ]; say $? "$name, between scans, asks the system for nothing" "$open"
done

# No mutable globals in the library and the HAL.
for where in "$BUILD/libladder.a" "$BUILD"/hal/*.o; do
	[ -f "$where" ] || continue
	state=$($NM "$where" 2>/dev/null |
		awk -v file="$(basename "$where"):" '/:$/ {file = $0} NF == 3 && $2 ~ /^[bBdDcCsSgG]$/ {print file, $3}' |
		grep -v '__odr_asan\|__gcov\|__llvm\|\.rel\.ro')
	# Tables of pointers need relocation: `d` in a read-only section is constant.
	if [ -n "$state" ]; then
		${CROSS}objdump -t "$where" 2>/dev/null |
		awk '/ (\.data\.rel\.ro|\.rodata)[^ ]*\t/ {print $NF}' >"$whole"
		state=$(printf '%s\n' "$state" | awk -v constants="$whole" '
			BEGIN {while ((getline name <constants) > 0) constant[name] = 1}
			!($2 in constant)')
	fi
	[ -z "$state" ]; say $? "$(basename "$where") has no mutable globals" "$state"
done
echo "1..$n"
exit $failed
