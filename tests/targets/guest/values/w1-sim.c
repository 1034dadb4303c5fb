/* SPDX-License-Identifier: MIT
 *
 * w1-sim - a module of the kernel: a 1-wire bus with one DS18B20 on it, for tests. The driver of the
 * sensor is the kernel's, w1_therm.
 *
 *   /sys/module/w1_sim/parameters/temperature  thousandths of a degree
 *   /sys/module/w1_sim/parameters/away         Y: nothing answers a reset
 */
#include <linux/module.h>
#include <linux/w1.h>

#define FAMILY 0x28
#define NUMBER 0x000005e2fdc3ull

static int temperature = 85000;
module_param(temperature, int, 0644);
static bool away;
module_param(away, bool, 0644);

static enum { AT_ROM, AT_MATCH, AT_FUNCTION, AT_READ, AT_WRITE } state;
static int left, at;
/* Temperature, alarms, configuration of 12 bits, reserved, checksum; as after power on. */
static u8 scratch[9] = { 0x50, 0x05, 0x4b, 0x46, 0x7f, 0xff, 0x0c, 0x10, 0 };

static u8 reset_bus(void *data)
{
	state = AT_ROM;
	return away;
}

static void take_function(u8 byte)
{
	const int raw = temperature * 16 / 1000;

	at = 0;
	switch (byte) {
	case 0x44: /* convert */
		scratch[0] = raw & 0xff;
		scratch[1] = raw >> 8 & 0xff;
		break;
	case 0xbe: /* read the scratchpad */
		scratch[8] = w1_calc_crc8(scratch, 8);
		state = AT_READ;
		break;
	case 0x4e: /* write its alarms and its configuration */
		left = 3;
		state = AT_WRITE;
		break;
	}
}

static void write_byte(void *data, u8 byte)
{
	switch (state) {
	case AT_ROM:
		state = byte == W1_MATCH_ROM ? AT_MATCH : byte == W1_SKIP_ROM ? AT_FUNCTION : AT_ROM;
		left = 8;
		break;
	case AT_MATCH:
		if (--left == 0)
			state = AT_FUNCTION;
		break;
	case AT_FUNCTION:
		take_function(byte);
		break;
	case AT_WRITE:
		scratch[5 - left] = byte;
		if (--left == 0)
			state = AT_FUNCTION;
		break;
	case AT_READ:
		break;
	}
}

static u8 read_byte(void *data)
{
	return !away && state == AT_READ && at < 9 ? scratch[at++] : 0xff;
}

/* It has a supply, and a conversion is done at once. */
static u8 touch_bit(void *data, u8 bit)
{
	return 1;
}

static void search(void *data, struct w1_master *master, u8 kind, w1_slave_found_callback found)
{
	const u64 rom = FAMILY | NUMBER << 8;
	u64 number = cpu_to_le64(rom);

	if (!away)
		found(master, rom | (u64)w1_calc_crc8((u8 *)&number, 7) << 56);
}

static struct w1_bus_master master = {
	.reset_bus = reset_bus, .write_byte = write_byte, .read_byte = read_byte, .touch_bit = touch_bit,
	.search = search,
};

static int __init begin(void)
{
	return w1_add_master_device(&master);
}

static void __exit end(void)
{
	w1_remove_master_device(&master);
}

module_init(begin);
module_exit(end);
MODULE_DESCRIPTION("a 1-wire bus with one sensor");
MODULE_LICENSE("Dual MIT/GPL");
