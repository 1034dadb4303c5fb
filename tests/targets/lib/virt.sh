# shellcheck shell=sh disable=SC2154,SC2086,SC2034
# SPDX-License-Identifier: MIT
# virt - the two vehicles that are emulated `virt` machines with Debian's kernel. Sourced
# after build.sh. GPIO_DRIVERS: the gpio drivers to test.

# with_libiio ARCH : $out/ladderd-iio, which is not static, of the objects of the others.
with_libiio() {
	rm -rf "$build/hal" "$build/ladderd"
	C_INCLUDE_PATH=$cache/iio-$1/include LDFLAGS='-s -no-pie' make -s -j"$jobs" CROSS="$triplet-" HAL=uapi IIO=libiio BUILD="$build" \
		"$build/ladderd" >>"$log" 2>&1 || broken "ladderd with libiio failed" "$log"
	mv "$build/ladderd" "$out/ladderd-iio"
	rm -rf "$build/hal"
}

# virt ARCH FLAVOUR KARCH TRIPLET EMULATOR
# VALUES=1: with chips on I2C, a 1-wire bus and a ladderd with libiio. MEMORY: MiB of the machine.
virt() {
	deb=$1 triplet=$4
	drivers=${GPIO_DRIVERS:-uapi gpiod1 gpiod2}
	needs $KERNEL_NEEDS pkg-config=pkg-config modprobe=kmod "${5%% *}=qemu-system-arm" \
		"$triplet-gcc=gcc-$triplet"
	once "stock-$1" stock "$1" "$2" "$3" "$4-"
	once "gpiod1-$1" gpiod "$1" "$triplet" bookworm
	once "gpiod2-$1" gpiod "$1" "$triplet" bookworm-backports
	once "cyclictest-$1" cyclictest "$1" "$triplet"
	[ -z "${VALUES-}" ] || once "values-$1" values "$1" "$2" "$3" "$4-" $sims
	[ -z "${VALUES-}" ] || once "iio-$1" iio "$1" "$triplet"

	programs CROSS="$triplet-" -- $drivers
	command_line
	[ -z "${VALUES-}" ] || with_libiio "$1"
	disk "$triplet-gcc" "$out/build/guest" "$out/build/replay" "$out/ladder" "$out"/ladderd-* \
		"$out/ladder-guard" "$out/cases" "$cache/cyclictest-$1/guest"/*
	cp -r "$cache/stock-$1/sim" "$root/modules"
	[ -z "${VALUES-}" ] || cp "$cache/values-$1/modules"/* "$root/modules/"
	[ -z "${VALUES-}" ] || cp "$out/ladderd-iio" "$root/"
	[ -z "${VALUES-}" ] || cp "$cache/iio-$1/guest/lib"/* "$root/lib/"
	guest_runs /guest $(guest_options) /cases $(printf '/ladderd-%s ' $drivers)
	guest_runs /replay /cases/programs.bundle
	disk_close
	# Without the gpio chip of the machine, so that those of the suite come first.
	boot $5 -M virt -m ${MEMORY:-256} -nographic -nodefaults -no-reboot -serial stdio -monitor none \
		-icount shift=0,sleep=off -kernel "$cache/stock-$1/vmlinuz" -initrd "$out/initrd" \
		-append "console=ttyAMA0 quiet loglevel=1 panic=-1 initcall_blacklist=pl061_gpio_driver_init"
	guest_said
}
