# shellcheck shell=sh disable=SC2153,SC2154
# SPDX-License-Identifier: MIT
# build - what a vehicle is made of, built once into the cache: Debian packages of any
# architecture, libgpiod to link with, kernels, musl, the guest's programs and disk.
# Sourced after vehicle.sh. A product lies in $cache/NAME with its recipe in the file
# `.recipe`; it is built anew when the recipe's hash is another.
#
# $log takes what compilers say.
cache=$(cd "$cache" && pwd)
out=$(cd "$out" && pwd)
log=$out/build.log
jobs=$(nproc)
: >"$log"

# once NAME BUILDER [ARGUMENT|FILE]... : the product NAME by BUILDER. Its arguments, the
# files among them, its own text and that of BUILDER_* are the recipe.
once() {
	product=$1 builder=$2
	shift 2
	recipe=$({
		echo "$@"
		sed -n "/^$builder\(_[a-z_]*\)\{0,1\}() {/,/^}/p" "$here/build.sh"
		for part in "$@"; do [ ! -f "$part" ] || cat "$part"; done
	} | sha256sum | cut -c 1-32)
	is_built && return
	# Another vehicle may be at it.
	exec 9>"$cache/$product.lock"
	flock 9
	is_built && return
	note "building $product (once)"
	since=$(date +%s) dest=$cache/$product
	rm -rf "$dest"
	mkdir -p "$dest"
	echo "== $product" >>"$log"
	built=0
	$builder "$@" >>"$log" 2>&1 || built=$?
	[ ! -s "$dest/.lacking" ] || skip "$(cat "$dest/.lacking")"
	[ $built -eq 0 ] || broken "$product could not be built" "$log"
	echo "$recipe" >"$cache/$product/.recipe"
	exec 9>&-
	note "$product took $(($(date +%s) - since)) s"
}
is_built() { [ "$(cat "$cache/$product/.recipe" 2>/dev/null)" = "$recipe" ]; }

# debs ARCH SUITE DEST PACKAGE... : unpack packages of the archive that this machine's
# apt names, whatever the architecture and suite. apt's own state is only read.
debs() {
	debs_arch=$1 debs_suite=$2 debs_dest=$3
	shift 3
	apt_open "$debs_arch" "$debs_suite" || return
	mkdir -p "$debs_dest"
	for package in "$@"; do
		rm -f "$apt"/debs/*.deb
		(cd "$apt/debs" && APT_CONFIG=$apt/conf apt-get -qq download "$package") || {
			echo "the package $package of $debs_suite could not be fetched" >"$dest/.lacking"
			return 0
		}
		dpkg -x "$apt"/debs/*.deb "$debs_dest" || return
	done
	rm -f "$apt"/debs/*.deb
}
apt_open() {
	apt=$cache/apt/$2-$1
	mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$apt/debs" "$apt/none"
	: >"$apt/status"
	# shellcheck disable=SC2016
	uri=$(apt-get indextargets --format '$(REPO_URI) $(COMPONENT) $(ORIGIN)' |
		awk '$2 == "main" && $3 == "Debian" && $1 !~ /security/ { print $1; exit }')
	[ -n "$uri" ] || {
		echo "apt on this machine knows no Debian archive" >"$dest/.lacking"
		return 0
	}
	ring='[signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]'
	printf '%s\n' "deb $ring $uri $2 main" "deb-src $ring $uri $2 main" >"$apt/sources.list"
	cat >"$apt/conf" <<-CONF
		APT::Architecture "$1";
		APT::Architectures { "$1"; };
		APT::Sandbox::User "";
		Dir::State "$apt";
		Dir::State::status "$apt/status";
		Dir::Cache "$apt/cache";
		Dir::Etc::sourcelist "$apt/sources.list";
		Dir::Etc::sourceparts "$apt/none";
		Dir::Etc::preferencesparts "$apt/none";
		Acquire::Languages "none";
		Acquire::Retries "3";
	CONF
	# A list of yesterday may name packages that have gone.
	[ -n "$(find "$apt/fresh" -mmin -600 2>/dev/null)" ] && return
	if APT_CONFIG=$apt/conf apt-get -qq update; then touch "$apt/fresh"; fi
}

# gpiod ARCH TRIPLET SUITE : libgpiod's headers and archives; its .pc finds itself.
gpiod() {
	debs "$1" "$3" "$dest" libgpiod-dev || return
	[ ! -s "$dest/.lacking" ] || return 0
	# shellcheck disable=SC2016
	sed -i -e 's|/usr|${prefix}|g' -e 's|^prefix=.*|prefix=${pcfiledir}/../../..|' \
		"$dest/usr/lib/$2"/pkgconfig/*.pc
}

# linux_source : one tree for all; large drivers that none of them can use stay out.
linux_source() {
	debs amd64 bookworm-backports "$dest/deb" linux-source-6.12 || return
	[ ! -s "$dest/.lacking" ] || return 0
	tar -xJf "$dest"/deb/usr/src/linux-source-6.12.tar.xz -C "$dest" --strip-components=1 \
		--exclude='*/drivers/gpu/*.[ch]' --exclude='*/drivers/net/*/*.[ch]' \
		--exclude='*/drivers/media/*.[ch]' --exclude='*/sound/*.[ch]' \
		--exclude='*/Documentation/*.rst' --exclude='*/tools/testing/*' || return
	# User Mode Linux gives the registers back as it got them; the kernel of a machine with AMX
	# takes only all of them, 11,008 bytes. More room than a machine has does no harm.
	sed -i 's/(HOST_FP_SIZE, 2696)/(HOST_FP_SIZE, 12288)/' "$dest/arch/x86/um/user-offsets.c"
	# The dummy of Industrial I/O measures what was written to its input. Without this it measures 73.
	sed -i '/^static int iio_dummy_write_raw/,/^}/s/if (chan->output == 0)/if (!chan->output) { st->single_ended_adc_val = val; return 0; } if (0)/' \
		"$dest/drivers/iio/dummy/iio_simple_dummy.c" || return
	# Chips on a bus that is only memory, without a module.
	sed -i '/^config I2C_STUB/,/^config/{/depends on m$/d}' "$dest/drivers/i2c/Kconfig" || return
	rm -r "$dest/deb"
}
# kernel ARCH CROSS TARGETS FILES FRAGMENT... : builds the targets, keeps the files.
kernel() {
	arch=$1 cross=$2 targets=$3 files=$4
	shift 4
	mkdir "$dest/build"
	cat "$@" >"$dest/fragment"
	set -- make -s -C "$cache/linux" O="$dest/build" ARCH="$arch" CROSS_COMPILE="$cross"
	"$@" KCONFIG_ALLCONFIG="$dest/fragment" allnoconfig || return
	grep '^CONFIG_' "$dest/fragment" | grep -vxFf "$dest/build/.config" | sed 's/^/not taken: /'
	for must in GPIO_SIM GPIO_CDEV GPIO_CDEV_V1 CONFIGFS_FS BLK_DEV_INITRD; do
		grep -q "^CONFIG_$must=y" "$dest/build/.config" || {
			echo "CONFIG_$must was lost"
			return 1
		}
	done
	# shellcheck disable=SC2086
	"$@" -j"$jobs" $targets && (cd "$dest/build" && mv $files ..) && rm -r "$dest/build"
}
# um_kernel FRAGMENT FRAGMENT SOURCE... : User Mode Linux with drivers of the tests, built in a tree of links.
um_kernel() {
	mkdir -p "$dest/tree/linux" && cp -al "$cache/linux/." "$dest/tree/linux/" || return
	fragments="$1 $2" masters=$dest/tree/linux/drivers/w1/masters
	shift 2
	cp "$@" "$masters/" && sed -i '$a obj-y += w1-sim.o chips-sim.o' "$masters/Makefile" || return
	# shellcheck disable=SC2030,SC2086
	(cache=$dest/tree && kernel um '' linux linux $fragments) && rm -r "$dest/tree"
}
# drivers of the tests: a bus of 1-wire, and buses of I2C and SPI
# shellcheck disable=SC2034
sims='tests/targets/guest/values/w1-sim.c tests/targets/guest/values/chips-sim.c'
# what a build of a kernel needs here
# shellcheck disable=SC2034
KERNEL_NEEDS='gcc=gcc make=make flex=flex bison=bison bc=bc xz=xz-utils perl=perl
	apt-get=apt dpkg=dpkg flock=util-linux timeout=coreutils cpio=cpio gzip=gzip
	/usr/share/keyrings/debian-archive-keyring.gpg=debian-archive-keyring'

# stock ARCH FLAVOUR KARCH CROSS : Debian's own kernel, unchanged: vmlinuz, the modules of
# each of two vehicles in the order of loading (sim/, aspeed/), the AST2600's device tree.
# Its configuration leaves gpio-sim out: that is built from its source and its headers.
stock() {
	debs "$1" bookworm "$dest/tree"
	[ ! -s "$dest/.lacking" ] || return 0
	abi=$(APT_CONFIG=$apt/conf apt-cache show "linux-image-$2" |
		sed -n 's/^Depends: .*linux-image-\([^ ,]*\).*/\1/p' | sort -V | tail -n 1)
	debs "$1" bookworm "$dest/tree" "linux-image-$abi" "linux-headers-$abi" \
		"linux-headers-${abi%-"$2"}-common" linux-source-6.1 || return
	[ ! -s "$dest/.lacking" ] || return 0
	# the programs that build a module run here
	debs "$(dpkg --print-architecture)" bookworm "$dest/tree" linux-kbuild-6.1 || return
	[ ! -s "$dest/.lacking" ] || return 0
	(cd "$dest/tree" && stock_gpio_sim "$abi" "${abi%-"$2"}" "$3" "$4") || return
	stock_modules sim gpio-sim || return
	if [ "$1" = armhf ]; then
		stock_modules aspeed gpio-aspeed || return
		cp "$dest/tree/usr/lib/linux-image-$abi/aspeed-ast2600-evb.dtb" "$dest" || return
	fi
	cp "$dest/tree/boot/vmlinuz-$abi" "$dest/vmlinuz" && rm -r "$dest/tree"
}
stock_modules() { # FOLDER MODULE : with what it needs, numbered
	mkdir "$dest/$1"
	n=10
	for module in $(for wanted in configfs "$2"; do
			modprobe -d "$dest/tree" -S "$abi" --show-depends "$wanted"
		done | awk '$1 == "insmod" && !seen[$2]++ { print $2 }'); do
		cp "$module" "$dest/$1/$n-$(basename "$module")" || return
		n=$((n + 1))
	done
	ls "$dest/$1"/*-"$2".ko
}
stock_gpio_sim() { # ABI BASE KARCH CROSS
	headers=$PWD/usr/src/linux-headers-$1
	mkdir sim
	tar -xJf usr/src/linux-source-6.1.tar.xz -C sim --transform 's|.*/||' \
		linux-source-6.1/drivers/gpio/gpio-sim.c linux-source-6.1/drivers/gpio/gpiolib.h \
		linux-source-6.1/kernel/irq/irq_sim.c || return
	# The headers name each other by absolute paths below /usr.
	sed -i "s|^include /usr/src/|include $PWD/usr/src/|" "$headers/Makefile"
	for folder in scripts tools; do
		ln -sfn "$PWD/usr/lib/linux-kbuild-6.1/$folder" "$headers/$folder"
		ln -sfn "$PWD/usr/lib/linux-kbuild-6.1/$folder" "usr/src/linux-headers-$2-common/$folder"
	done
	# Its gpio-sim takes an open drain that lets go for an output still; later kernels
	# look at the direction of the line, as is done here.
	sed -i 's/!test_bit(FLAG_IS_OUT, &desc->flags)/test_bit(offset, chip->direction_map)/' sim/gpio-sim.c
	# A module that is loaded by hand needs no alias table, and modpost of 64 bits
	# takes the one of 32 for wrong.
	sed -i '/^MODULE_DEVICE_TABLE/d' sim/gpio-sim.c
	echo 'obj-m := gpio-sim.o' >sim/Kbuild
	# The kernel may lack the simulated interrupts, too: then they go into the module,
	# by way of a function that modules may call.
	if ! grep -q '^CONFIG_IRQ_SIM=y' "$headers/.config"; then
		sed -i -e '/EXPORT_SYMBOL/d' \
			-e 's/irq_to_desc(\([a-z]*\))/irq_data_to_desc(irq_get_irq_data(\1))/' sim/irq_sim.c
		mv sim/gpio-sim.c sim/main.c
		echo 'gpio-sim-y := main.o irq_sim.o' >>sim/Kbuild
	fi
	make -s -C "$headers" M="$PWD/sim" ARCH="$3" CROSS_COMPILE="$4" modules || return
	mkdir -p "lib/modules/$1/extra"
	cp sim/gpio-sim.ko "lib/modules/$1/extra/"
	depmod -b "$PWD" "$1"
}

# values ARCH FLAVOUR KARCH CROSS MODULE... : drivers of values for the kernel of `stock`: those that Debian builds, and
# from its source chips on I2C and the memory that stands for them. A MODULE is a source of the tests.
values() {
	debs "$1" bookworm "$dest/tree"
	[ ! -s "$dest/.lacking" ] || return 0
	abi=$(APT_CONFIG=$apt/conf apt-cache show "linux-image-$2" |
		sed -n 's/^Depends: .*linux-image-\([^ ,]*\).*/\1/p' | sort -V | tail -n 1)
	debs "$1" bookworm "$dest/tree" "linux-image-$abi" "linux-headers-$abi" \
		"linux-headers-${abi%-"$2"}-common" linux-source-6.1 || return
	[ ! -s "$dest/.lacking" ] || return 0
	debs "$(dpkg --print-architecture)" bookworm "$dest/tree" linux-kbuild-6.1 || return
	[ ! -s "$dest/.lacking" ] || return 0
	flavour=$2 karch=$3 cross=$4
	shift 4
	mkdir "$dest/tree/chips" && cp "$@" "$dest/tree/chips" || return
	(cd "$dest/tree" && values_modules "$abi" "${abi%-"$flavour"}" "$karch" "$cross") || return
	mkdir "$dest/modules"
	n=30
	for module in $(for wanted in i2c-dev i2c-stub pwm-pca9685 lm75 w1_therm w1-sim ti-ads1015 iio-dummy chips-sim tmp102 mcp320x mcp4725 \
			pinctrl-mcp23s08_i2c gpio-pcf857x; do
			modprobe -d "$dest/tree" -S "$abi" --show-depends "$wanted"
		done | awk '$1 == "insmod" && $2 !~ "/configfs.ko" && !seen[$2]++ { print $2 }'); do
		cp "$module" "$dest/modules/$n-$(basename "$module")" || return
		n=$((n + 1))
	done
	rm -r "$dest/tree"
	ls "$dest/modules"/*-w1-sim.ko "$dest/modules"/*-chips-sim.ko "$dest/modules"/*-mcp4725.ko
}
values_modules() { # ABI BASE KARCH CROSS
	headers=$PWD/usr/src/linux-headers-$1
	tar -xJf usr/src/linux-source-6.1.tar.xz -C chips --transform 's|.*/||' \
		linux-source-6.1/drivers/i2c/i2c-stub.c linux-source-6.1/drivers/pwm/pwm-pca9685.c \
		linux-source-6.1/drivers/iio/industrialio-sw-device.c linux-source-6.1/drivers/iio/industrialio-configfs.c \
		linux-source-6.1/drivers/iio/dummy/iio_simple_dummy.c linux-source-6.1/drivers/iio/dummy/iio_simple_dummy.h \
		linux-source-6.1/drivers/gpio/gpio-pcf857x.c linux-source-6.1/drivers/pinctrl/pinctrl-mcp23s08.c \
		linux-source-6.1/drivers/pinctrl/pinctrl-mcp23s08.h linux-source-6.1/drivers/pinctrl/pinctrl-mcp23s08_i2c.c || return
	sed -i "s|^include /usr/src/|include $PWD/usr/src/|" "$headers/Makefile"
	for folder in scripts tools; do
		ln -sfn "$PWD/usr/lib/linux-kbuild-6.1/$folder" "$headers/$folder"
		ln -sfn "$PWD/usr/lib/linux-kbuild-6.1/$folder" "usr/src/linux-headers-$2-common/$folder"
	done
	# The guest loads modules without parameters: these addresses have a chip.
	sed -i 's/^static unsigned short chip_addr\[MAX_CHIPS\];/static unsigned short chip_addr[MAX_CHIPS] = { 0x40, 0x48, 0x4f };/' chips/i2c-stub.c
	# It measures what was written to its input, as in linux_source.
	sed -i '/^static int iio_dummy_write_raw/,/^}/s/if (chan->output == 0)/if (!chan->output) { st->single_ended_adc_val = val; return 0; } if (0)/' \
		chips/iio_simple_dummy.c
	mv chips/iio_simple_dummy.c chips/iio-dummy.c
	printf '%s\n' 'obj-m := i2c-stub.o pwm-pca9685.o w1-sim.o industrialio-sw-device.o industrialio-configfs.o iio-dummy.o \
			chips-sim.o gpio-pcf857x.o pinctrl-mcp23s08.o pinctrl-mcp23s08_i2c.o' \
		'ccflags-y := -DCONFIG_CONFIGFS_FS' >chips/Kbuild
	make -s -C "$headers" M="$PWD/chips" ARCH="$3" CROSS_COMPILE="$4" modules || return
	mkdir -p "lib/modules/$1/extra"
	cp chips/*.ko "lib/modules/$1/extra/"
	depmod -b "$PWD" "$1"
}

# modules ARCH FLAVOUR MODULE... : modules of the kernel of `stock`, numbered in the order of loading.
modules() {
	debs "$1" bookworm "$dest/tree"
	[ ! -s "$dest/.lacking" ] || return 0
	abi=$(APT_CONFIG=$apt/conf apt-cache show "linux-image-$2" |
		sed -n 's/^Depends: .*linux-image-\([^ ,]*\).*/\1/p' | sort -V | tail -n 1)
	debs "$1" bookworm "$dest/tree" "linux-image-$abi" || return
	[ ! -s "$dest/.lacking" ] || return 0
	depmod -b "$dest/tree" "$abi" || return
	shift 2
	mkdir "$dest/modules"
	n=50
	for module in $(for wanted; do
			modprobe -d "$dest/tree" -S "$abi" --show-depends "$wanted"
		done | awk '$1 == "insmod" && !seen[$2]++ { print $2 }'); do
		cp "$module" "$dest/modules/$n-$(basename "$module")" || return
		n=$((n + 1))
	done
	rm -r "$dest/tree"
	[ "$n" -gt 50 ]
}

# iio ARCH TRIPLET : libiio with its header, and in guest/lib what it is linked with.
iio() {
	debs "$1" bookworm "$dest/tree" libiio-dev libiio0 libusb-1.0-0 libudev1 libavahi-client3 libavahi-common3 \
		libdbus-1-3 libsystemd0 libcap2 libgcrypt20 libgpg-error0 liblz4-1 libzstd1 liblzma5 libxml2 libicu72 zlib1g \
		libstdc++6 libgcc-s1 libc6 || return
	[ ! -s "$dest/.lacking" ] || return 0
	mkdir -p "$dest/guest/lib" "$dest/include"
	for file in iio usb-1.0 udev avahi-client avahi-common dbus-1 systemd cap gcrypt gpg-error lz4 zstd lzma xml2 icuuc icudata \
		z stdc++ gcc_s m c; do
		find "$dest/tree/lib/$2" "$dest/tree/usr/lib/$2" -maxdepth 1 -name "lib$file.so.[0-9]*" |
			while IFS= read -r path; do cp -L "$path" "$dest/guest/lib/"; done
	done
	cp -L "$dest/tree/lib/$2"/ld-linux* "$dest/guest/lib/" && cp "$dest/tree/usr/include/iio.h" "$dest/include/" || return
	# Each library once, by the name that others ask for.
	rm -f "$dest/guest/lib"/*.so.*.*
	rm -r "$dest/tree"
	ls "$dest/guest/lib/libiio.so.0"
}

# musl CROSS CPU TARGET LIBGCC HEADERS PATCH : a C library for a machine without MMU, and
# $dest/cc, a compiler that makes static PIE with it: what the kernel's FDPIC loader
# takes. There is no guard page below a stack; STACK says how many bytes it has.
musl() {
	apt_open amd64 bookworm
	mkdir "$dest/src"
	(cd "$dest/src" && APT_CONFIG=$apt/conf apt-get -qq source --download-only --tar-only musl) || {
		echo "the source of musl could not be fetched" >"$dest/.lacking"
		return 0
	}
	patch=$PWD/$6
	(
		cd "$dest/src" && tar -xzf musl_*.orig.tar.gz --strip-components=1 &&
			patch -sp1 <"$patch" &&
			# for the other instruction set, which a Cortex-M does not have
			rm src/thread/arm/atomics.s &&
			CC="$1gcc $2" CFLAGS='-Os -fPIC' LIBCC=$4 CROSS_COMPILE=$1 ./configure --target="$3" \
				--prefix="$dest" --disable-shared --disable-wrapper &&
			make -s -j"$jobs" && make -s install
	) || return
	cp "$4" "$dest/lib/libgcc.a" || return
	for folder in linux asm asm-generic; do ln -s "$5/$folder" "$dest/include/$folder"; done
	cat >"$dest/cc" <<-CC
		#!/bin/sh
		set -- $2 -fPIE -nostdinc -isystem "$dest/include" \\
		    -isystem "\$($1gcc -print-file-name=include)" "\$@"
		# -fPIE once more: the Makefile takes it away from programs that have a fixed address elsewhere.
		case " \$* " in *" -c "* | *" -S "* | *" -E "* | *" -M "*) exec $1gcc "\$@" -fPIE ;; esac
		exec $1gcc -nostdlib -static -pie -Wl,-pie,--no-dynamic-linker,-z,text,--gc-sections \\
		    -Wl,-z,stack-size=\${STACK:-65536},-z,noexecstack -L"$dest/lib" "$dest/lib/rcrt1.o" \\
		    "$dest/lib/crti.o" "\$@" -Wl,--start-group -lc -lgcc -Wl,--end-group "$dest/lib/crtn.o"
	CC
	chmod +x "$dest/cc"
	rm -r "$dest/src"
}

# programs VARIABLE=VALUE... -- DRIVER... : the guest's suite, and for each driver ladderd
# and its counting twin, all static: uapi, or gpiod1 and gpiod2 for $deb and $triplet.
# GUARD_CC: another compiler for ladder-guard, for example one with musl.
programs() {
	make_with=
	while [ "$1" != -- ]; do
		make_with="$make_with $1"
		shift
	done
	shift
	note "building the guest's programs"
	build=$out/build
	rm -f "$out"/ladderd-*
	make_programs none guest replay
	case " $make_with " in
	*" SMALL=1 "*) ;;
	*)
		(
			build=${GUARD_CC:+$out/guard}
			build=${build:-$out/build}
			make_with="$make_with${GUARD_CC:+ CC=$GUARD_CC CFLAGS=-Os}"
			make_programs none ladder-guard
			mv "$build/ladder-guard" "$out/"
		) || exit
		;;
	esac
	for driver in "$@"; do
		# The objects of the library serve all drivers, those of the HAL one.
		rm -rf "$build/hal"
		case $driver in
		gpiod*)
			libgpiod=$cache/$driver-$deb/usr/lib/$triplet/pkgconfig
			PKG_CONFIG_LIBDIR=$libgpiod make_programs gpiod ladderd ladderd-count
			;;
		*) make_programs "$driver" ladderd ladderd-count ;;
		esac
		mv "$build/ladderd" "$out/ladderd-$driver"
		mv "$build/ladderd-count" "$out/ladderd-$driver-count"
	done
	(
		flock 9
		rm -rf "$out/cases"
		make -s BUILD="$BUILD" cases && cp -r "$BUILD/cases" "$out/cases"
	) 9>"$BUILD/targets/cases.lock" >>"$log" 2>&1 || broken "the cases could not be made" "$log"
}
# Options of the guest's suite for a long run: GUEST_ONLY is the number of one test, GUARD_KILLS,
# GUARD_STOPS and GUARD_STARTS say how often ladderd dies, freezes and starts.
guest_options() {
	echo "${GUEST_ONLY:+--only $GUEST_ONLY} ${GUARD_KILLS:+--kills $GUARD_KILLS}" \
		"${GUARD_STOPS:+--stops $GUARD_STOPS} ${GUARD_STARTS:+--starts $GUARD_STARTS}"
}
# A small ladderd with a serial line, which has fewer words.
small_serial() { # VARIABLE=VALUE...
	make_with="$* SMALL=1 LINK=serial WORDS=core" build=$out/build-serial
	make_programs uapi ladderd
	mv "$build/ladderd" "$out/ladderd-serial"
	build=$out/build
}
# The command line beside them, for `ladder io`.
command_line() {
	rm -rf "$build/hal"
	make_programs uapi ladder
	mv "$build/ladder" "$out/ladder"
}
make_programs() { # HAL PROGRAM...
	hal=$1
	shift
	echo "== HAL=$hal: $*" >>"$log"
	for program in "$@"; do
		# shellcheck disable=SC2086
		LDFLAGS=-s make -s -j"$jobs" STATIC=1 HAL="$hal" BUILD="$build" $make_with \
			"$build/$program" >>"$log" 2>&1 || broken "$program with HAL=$hal failed" "$log"
	done
}

# disk CC FILE... : a guest's disk, with init and the files (a folder `modules` among
# them is loaded); guest_runs COMMAND [ARGUMENT]... : what init is to run there, in turn;
# disk_close : it lies in $out/initrd now.
disk() {
	root=$out/root
	rm -rf "$root"
	mkdir -p "$root/proc" "$root/sys" "$root/dev"
	"$1" -std=c11 -Os -s -static -o "$root/init" "$here/init.c" >>"$log" 2>&1 ||
		broken "the guest's init could not be built" "$log"
	shift
	cp -r "$@" "$root/"
}
# cyclictest ARCH TRIPLET : the program and what it is linked with, as a guest has them.
cyclictest() {
	debs "$1" bookworm "$dest/tree" rt-tests libc6 libnuma1 || return
	[ ! -s "$dest/.lacking" ] || return 0
	tree=$dest/tree
	mkdir -p "$dest/guest/lib"
	cp "$tree/usr/bin/cyclictest" "$dest/guest" &&
		cp -L "$tree/lib/$2"/libc.so.6 "$tree/lib/$2"/librt.so.1 "$tree/lib/$2"/libpthread.so.0 \
			"$tree/usr/lib/$2"/libnuma.so.1 "$tree/lib/$2"/ld-linux* "$dest/guest/lib/" || return
	ln -s lib "$dest/guest/lib64"
	rm -r "$tree"
}
guest_runs() {
	printf '%s\0' "$@" '' >>"$root/cmd"
}
disk_close() {
	(cd "$root" && find . | LC_ALL=C sort | cpio -o -H newc --quiet -R 0:0) | gzip -1n >"$out/initrd"
}

# Disks for a small machine: the suite, and what replays the random programs. A file of a disk
# takes memory as long as the machine runs, so what tier small does not read is left out: the texts
# of programs, and the program of 10,000 elements. Without an MMU a program needs one piece of memory;
# where there is none, the kernel ends it at its start with SIGSEGV.
suite() { # CC
	disk "$1" "$out/build/guest" "$out"/ladderd-* "$out/cases"
	rm "$root/cases/programs.bundle" "$root"/cases/*.rung "$root/cases/ten-thousand.rungc"
	# shellcheck disable=SC2046
	guest_runs /guest --tier small $(guest_options) /cases /ladderd-uapi
}
# All random programs, some on each disk: `start` boots the machine with it.
replay() { # CC
	rm -rf "$out/parts"
	mkdir "$out/parts"
	perl "$here/parts.pl" "$out/cases/programs.bundle" 600000 "$out/parts" >>"$log" 2>&1 ||
		broken "the programs to replay could not be divided" "$log"
	for part in "$out"/parts/*; do
		disk "$1" "$out/build/replay" "$part"
		guest_runs /replay "/$(basename "$part")"
		start
	done
}
