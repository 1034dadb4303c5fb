/* SPDX-License-Identifier: MIT
 *
 * chips-sim - a module of the kernel: bus 7 of I2C and bus 7 of SPI with chips on them, for tests. Each chip does what
 * its data sheet says of the bytes on the bus; their drivers are the kernel's. i2c-stub cannot stand for them: a
 * MCP4725 and a PCF8574 have no registers, and an ADS1115 has one register for four inputs.
 *
 * /sys/module/chips_sim/parameters/ has the other side of each chip:
 *
 *   ads1115_mv       0x48: voltages at its four inputs
 *   tmp102_mc        0x49: thousandths of a degree
 *   mcp4725_step     0x60: what it gives, of 4096 steps
 *   pcf8574_outside  0x24: 0 for each pin that something pulls to ground; pcf8574_pins: the levels
 *   mcp23017_outside 0x20: levels that something drives; mcp23017_pins: the levels
 *   mcp23017_pull_up its register of pull-up resistors
 *   mcp3008_step     SPI: what it measures at its eight inputs, of 1024 steps
 *   away             the chip of I2C with this address does not answer
 *   spi_away         nothing drives the line from the chip of SPI, which is then high
 *
 * It does not know bus speeds, interrupts and the EEPROM of a MCP4725.
 */
#include <linux/i2c.h>
#include <linux/module.h>
#include <linux/platform_device.h>
#include <linux/regulator/driver.h>
#include <linux/regulator/machine.h>
#include <linux/spi/spi.h>

#define BUS 7

enum { MCP23017 = 0x20, PCF8574 = 0x24, ADS1115 = 0x48, TMP102 = 0x49, MCP4725 = 0x60 };
/* Registers of the MCP23017: A, then B. */
enum { IODIR = 0x00, IPOL = 0x02, GPPU = 0x0c, PORT = 0x12, OLAT = 0x14, MCP_REGISTERS = 0x16 };

static int ads1115_mv[4], mcp3008_step[8], tmp102_mc = 25000, mcp4725_step = 2048, away;
static int pcf8574_outside = 0xff, pcf8574_pins = 0xff, mcp23017_outside = 0xffff, mcp23017_pins = 0xffff, mcp23017_pull_up;
static bool spi_away;
module_param_array(ads1115_mv, int, NULL, 0644);
module_param_array(mcp3008_step, int, NULL, 0644);
module_param(tmp102_mc, int, 0644);
module_param(mcp4725_step, int, 0444);
module_param(pcf8574_outside, int, 0644);
module_param(pcf8574_pins, int, 0444);
module_param(mcp23017_outside, int, 0644);
module_param(mcp23017_pins, int, 0444);
module_param(mcp23017_pull_up, int, 0444);
module_param(away, int, 0644);
module_param(spi_away, bool, 0644);

/* ---- chips with registers of 16 bits, the higher byte first ---- */

struct words {
	u8 at;
	u16 value[4];
};
static struct words tmp102 = { .value = { 0, 0x60a0, 0x4b00, 0x5000 } };
static struct words ads1115 = { .value = { 0, 0x8583, 0x8000, 0x7fff } };

static void words_write(struct words *chip, const u8 *bytes, int count)
{
	chip->at = bytes[0] & 3;
	if (count > 2 && chip->at)
		chip->value[chip->at] = bytes[1] << 8 | bytes[2];
}

static void words_read(const struct words *chip, u16 measured, u8 *bytes, int count)
{
	const u16 value = chip->at ? chip->value[chip->at] : measured;

	for (int i = 0; i < count; i++)
		bytes[i] = i % 2 ? value & 0xff : value >> 8;
}

/* 12 bits, or 13 with the bit EM of its configuration; the bits R1 and R0 cannot be written. */
static u16 tmp102_measures(void)
{
	const bool extended = tmp102.value[1] & 0x10;

	tmp102.value[1] |= 0x6000;
	return extended ? (tmp102_mc * 2 / 125 << 3 | 1) & 0xffff : (tmp102_mc * 2 / 125 << 4) & 0xffff;
}

static u16 ads1115_measures(void)
{
	static const u8 plus[] = { 0, 0, 1, 2 }, minus[] = { 1, 3, 3, 3 };
	static const int full_mv[] = { 6144, 4096, 2048, 1024, 512, 256, 256, 256 };
	const u16 set = ads1115.value[1];
	const int mux = set >> 12 & 7, full = full_mv[set >> 9 & 7];
	const int mv = mux & 4 ? ads1115_mv[mux & 3] : ads1115_mv[plus[mux]] - ads1115_mv[minus[mux]];

	return clamp(mv * 32768 / full, -32768, 32767);
}

/* ---- the others ---- */

static u8 mcp23017[MCP_REGISTERS] = { 0xff, 0xff }, mcp23017_at;

static int pair(int first)
{
	return mcp23017[first] | mcp23017[first + 1] << 8;
}

static void mcp23017_move(void)
{
	mcp23017_pins = (mcp23017_outside & pair(IODIR)) | (pair(OLAT) & ~pair(IODIR));
	mcp23017_pull_up = pair(GPPU);
}

static void mcp23017_write(const u8 *bytes, int count)
{
	mcp23017_at = bytes[0];
	for (int i = 1; i < count && mcp23017_at < MCP_REGISTERS; i++, mcp23017_at++)
		mcp23017[mcp23017_at >= PORT && mcp23017_at < OLAT ? mcp23017_at + 2 : mcp23017_at] = bytes[i];
	mcp23017_move();
}

static void mcp23017_read(u8 *bytes, int count)
{
	mcp23017_move();
	mcp23017[PORT] = (mcp23017_pins & 0xff) ^ (mcp23017[IPOL] & mcp23017[IODIR]);
	mcp23017[PORT + 1] = (mcp23017_pins >> 8) ^ (mcp23017[IPOL + 1] & mcp23017[IODIR + 1]);
	for (int i = 0; i < count; i++, mcp23017_at++)
		bytes[i] = mcp23017_at < MCP_REGISTERS ? mcp23017[mcp23017_at] : 0;
}

static u8 pcf8574 = 0xff; /* a pin that is 0 is pulled down hard, one that is 1 is pulled up weakly */

static void pcf8574_move(void)
{
	pcf8574_pins = pcf8574 & pcf8574_outside;
}

static int mcp4725_down; /* it gives nothing */

/* Two bytes, or three with a command. */
static void mcp4725_write(const u8 *bytes, int count)
{
	if (count == 2 && bytes[0] >> 6 == 0) {
		mcp4725_down = bytes[0] >> 4 & 3;
		mcp4725_step = (bytes[0] & 15) << 8 | bytes[1];
	} else if (count == 3 && bytes[0] >> 6 == 1) {
		mcp4725_down = bytes[0] >> 1 & 3;
		mcp4725_step = bytes[1] << 4 | bytes[2] >> 4;
	}
}

static void mcp4725_read(u8 *bytes, int count)
{
	const u8 says[] = { 0xc0 | mcp4725_down << 1, mcp4725_step >> 4, mcp4725_step << 4, 0x08, 0 };

	for (int i = 0; i < count; i++)
		bytes[i] = i < (int)sizeof(says) ? says[i] : 0xff;
}

/* ---- the bus of I2C ---- */

static bool chip_write(int address, const u8 *bytes, int count)
{
	/* an address alone asks whether somebody is there */
	if (count == 0)
		return address == MCP23017 || address == PCF8574 || address == ADS1115 || address == TMP102 ||
		       address == MCP4725;
	switch (address) {
	case ADS1115:
		words_write(&ads1115, bytes, count);
		return true;
	case TMP102:
		words_write(&tmp102, bytes, count);
		return true;
	case MCP4725:
		mcp4725_write(bytes, count);
		return true;
	case MCP23017:
		mcp23017_write(bytes, count);
		return true;
	case PCF8574:
		pcf8574 = bytes[count - 1];
		pcf8574_move();
		return true;
	}
	return false;
}

static bool chip_read(int address, u8 *bytes, int count)
{
	switch (address) {
	case ADS1115:
		words_read(&ads1115, ads1115_measures(), bytes, count);
		return true;
	case TMP102:
		words_read(&tmp102, tmp102_measures(), bytes, count);
		return true;
	case MCP4725:
		mcp4725_read(bytes, count);
		return true;
	case MCP23017:
		mcp23017_read(bytes, count);
		return true;
	case PCF8574:
		pcf8574_move();
		memset(bytes, pcf8574_pins, count);
		return true;
	}
	return false;
}

static int transfer(struct i2c_adapter *adapter, struct i2c_msg *messages, int count)
{
	for (int i = 0; i < count; i++) {
		struct i2c_msg *it = messages + i;

		if (it->addr == away ||
		    !(it->flags & I2C_M_RD ? chip_read(it->addr, it->buf, it->len)
					   : chip_write(it->addr, it->buf, it->len)))
			return -ENXIO;
	}
	return count;
}

static u32 able(struct i2c_adapter *adapter)
{
	return I2C_FUNC_I2C | I2C_FUNC_SMBUS_EMUL;
}

static const struct i2c_algorithm algorithm = { .master_xfer = transfer, .functionality = able };
static struct i2c_adapter bus = { .owner = THIS_MODULE, .name = "chips-sim", .nr = BUS, .algo = &algorithm };

/* ---- the bus of SPI, with a MCP3008 ---- */

/* Clocks since the start bit, and the four bits that followed it: single, and three of the input. */
struct conversion {
	int clocks, command;
};

static int converted(int command)
{
	const int input = command & 7;

	return command & 8 ? mcp3008_step[input] : clamp(mcp3008_step[input] - mcp3008_step[input ^ 1], 0, 1023);
}

/* A clock: a bit goes in, another one comes out. */
static int mcp3008_clock(struct conversion *it, int in)
{
	const int n = it->clocks;

	if (n || in)
		it->clocks++;
	if (n >= 1 && n <= 4)
		it->command = it->command << 1 | in;
	if (n == 6 || n > 16)
		return 0;
	return n < 7 || spi_away ? 1 : converted(it->command) >> (16 - n) & 1;
}

static int message(struct spi_controller *controller, struct spi_message *message)
{
	struct conversion conversion = { 0 };
	struct spi_transfer *it;

	list_for_each_entry(it, &message->transfers, transfer_list) {
		const u8 *out = it->tx_buf;
		u8 *in = it->rx_buf;

		for (unsigned int i = 0; i < it->len; i++) {
			int got = 0;

			for (int bit = 7; bit >= 0; bit--)
				got = got << 1 | mcp3008_clock(&conversion, out ? out[i] >> bit & 1 : 0);
			if (in)
				in[i] = got;
		}
		message->actual_length += it->len;
	}
	message->status = 0;
	spi_finalize_current_message(controller);
	return 0;
}

/* ---- the supply, which is the reference of both converters ---- */

static struct regulator_consumer_supply users[] = {
	REGULATOR_SUPPLY("vdd", "7-0060"), REGULATOR_SUPPLY("vref", "spi7.0"),
};
static struct regulator_init_data supply_data = {
	.constraints = { .always_on = true }, .consumer_supplies = users, .num_consumer_supplies = ARRAY_SIZE(users),
};
static const struct regulator_ops supply_ops;
static const struct regulator_desc supply = {
	.name = "chips-sim", .type = REGULATOR_VOLTAGE, .n_voltages = 1, .fixed_uV = 3300000, .ops = &supply_ops,
	.owner = THIS_MODULE,
};

static struct platform_device *device;
static struct spi_controller *spi;

static int begin_spi(void)
{
	struct spi_board_info chip = { .modalias = "mcp3008", .max_speed_hz = 1000000 };
	int failed;

	spi = spi_alloc_master(&device->dev, 0);
	if (!spi)
		return -ENOMEM;
	spi->bus_num = BUS;
	spi->num_chipselect = 1;
	spi->transfer_one_message = message;
	failed = spi_register_controller(spi);
	if (failed) {
		spi_controller_put(spi);
		return failed;
	}
	return spi_new_device(spi, &chip) ? 0 : -ENODEV;
}

static int __init begin(void)
{
	struct regulator_config config = { .init_data = &supply_data };
	struct regulator_dev *reference;
	int failed;

	device = platform_device_register_simple("chips-sim", PLATFORM_DEVID_NONE, NULL, 0);
	if (IS_ERR(device))
		return PTR_ERR(device);
	config.dev = &device->dev;
	reference = devm_regulator_register(&device->dev, &supply, &config);
	if (IS_ERR(reference)) {
		platform_device_unregister(device);
		return PTR_ERR(reference);
	}
	/* other chips have a supply that nobody describes */
	regulator_has_full_constraints();
	bus.dev.parent = &device->dev;
	failed = i2c_add_numbered_adapter(&bus);
	return failed ? failed : begin_spi();
}

/* It stays as long as the guest. */
module_init(begin);
MODULE_DESCRIPTION("chips on I2C and SPI");
MODULE_LICENSE("Dual MIT/GPL");
