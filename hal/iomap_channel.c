/* SPDX-License-Identifier: MIT
 *
 * iomap_channel - reads the points of an I/O map that are more than a level of a chip.
 */
#include "hal/iomap_net.h"
#include "hal/map_words.h"

#include "engine/base/ascii.h"
#include "engine/base/literal.h"

#include <stdio.h>

#define MODULES 16 /* places of modules                                      */

bool io_is_gateway(const struct io_point *point)
{
	return point->driver == DRIVER_modbus || point->driver == DRIVER_module ||
	       point->driver == DRIVER_peer;
}

/* ---- quantities ---- */

static const struct {
	const char *word;
	enum io_unit unit;
	double factor;
} units[] = {
#define UNIT(id, word) { word, UNIT_##id, 1 },
#define UNIT_ALSO(id, word, factor) { word, UNIT_##id, factor },
#include "hal/units.def"
};

const char *io_unit_word(enum io_unit unit)
{
	static const char *const words[] = {
#define UNIT(id, word) word,
#include "hal/units.def"
	};

	return (unsigned)unit < sizeof(words) / sizeof(*words) ? words[unit] : "";
}

static bool read_number(const char *text, size_t len, double *out)
{
	struct literal literal;

	if (literal_parse(text, len, &literal) != LITERAL_OK || literal.type != IEC_NONE || literal.high)
		return false;
	*out = literal.real ? literal.value.r : (double)literal.value.i;
	return true;
}

/* "10V", "-40C", "3.6mA", "27648". */
static bool read_quantity(const char *text, size_t len, double *out, enum io_unit *unit)
{
	size_t end = 0;

	while (end < len && (ascii_digit(text[end]) || text[end] == '.' || text[end] == '_' ||
			     ((text[end] == '-' || text[end] == '+') && end == 0)))
		end++;
	if (!read_number(text, end, out))
		return false;
	for (size_t i = 0; i < sizeof(units) / sizeof(*units); i++)
		if (ascii_is(units[i].word, text + end, len - end)) {
			*unit = units[i].unit;
			*out *= units[i].factor;
			return true;
		}
	return false;
}

/* "0V..10V". Both have one unit. */
static bool read_range(const char *text, size_t len, double *low, double *high, enum io_unit *unit)
{
	const char *dots = find_dots(text, len);
	enum io_unit other;

	return dots && read_quantity(text, (size_t)(dots - text), low, unit) &&
	       read_quantity(dots + 2, len - (size_t)(dots - text) - 2, high, &other) && other == *unit;
}

/* ---- lines of points ---- */

/* What was read of a line; what needs the type of the value is settled at its end. */
struct line_reader {
	struct reader *reader;
	struct map_word address;
	struct io_point point;
	struct io_channel channel;
	uint32_t count;          /* values                                    */
	uint64_t seen;           /* options, a bit each                       */
	struct map_word range, at, substitute, safe, limits, threshold; /* len 0: none  */
	int ask_column;          /* of ask=, in the line of the address       */
	double hysteresis;
	enum io_unit at_unit, limits_unit, threshold_unit, hysteresis_unit;
	const struct module_type *module;
};

/* ---- owners ---- */

bool complain_owner(struct reader *reader, struct iec_addr addr, const struct map_word *word)
{
	const uint32_t first = 8 * addr.byte + addr.bit;
	char text[24];

	for (int i = 0; i < reader->map.count; i++) {
		const struct iec_addr other = reader->map.point[i].addr;
		const uint32_t from = 8 * other.byte + other.bit;

		if (other.area != addr.area || first >= from + other.bits || from >= first + addr.bits)
			continue;
		iec_addr_print(other, text, sizeof(text));
		return complain_about(reader, DIAG_IO_TWICE, word, text);
	}
	return complain(reader, DIAG_IO_TWICE, word);
}

bool complain_line_twice(struct reader *reader, const struct io_point *point, const struct io_point *first,
			 const struct map_word *word)
{
	char line[LIMIT_ARG], text[24];
	struct map_word named = *word;

	io_line_print(point, line, sizeof(line));
	iec_addr_print(first->addr, text, sizeof(text));
	named.text = line;
	named.len = strlen(line);
	return complain_about(reader, first->output == point->output ? DIAG_IO_LINE_TWICE : DIAG_IO_BOTH_WAYS, &named, text);
}

/* ---- addresses ---- */

/* The bits from the start of the area, so that addresses of any width can be compared. */
static uint32_t first_bit(struct iec_addr addr)
{
	return 8 * addr.byte + addr.bit;
}

/* What stands behind "..": a byte, or for bits also a bit of the same byte, or byte and bit. */
static bool read_last(const char *text, size_t len, struct iec_addr first, uint32_t *last)
{
	const char *dot = memchr(text, '.', len);
	uint32_t byte, bit;

	if (first.bits != 1) {
		if (!read_count(text, len, LIMIT_AREA, &byte))
			return false;
		*last = 8 * byte;
		return true;
	}
	if (!dot) {
		*last = 8 * first.byte;
		return read_count(text, len, 7, &bit) && (*last += bit, true);
	}
	if (!read_count(text, (size_t)(dot - text), LIMIT_AREA, &byte) ||
	    !read_count(dot + 1, len - (size_t)(dot - text) - 1, 7, &bit))
		return false;
	*last = 8 * byte + bit;
	return true;
}

bool iomap_group_read(const char *text, size_t whole, struct iec_addr *addr, uint32_t *bits)
{
	const char *dots = find_dots(text, whole);
	const size_t len = dots ? (size_t)(dots - text) : whole;
	uint32_t last;

	if (iec_addr_parse(text, len, addr) != ADDR_OK)
		return false;
	last = first_bit(*addr);
	if (dots && (!read_last(dots + 2, whole - len - 2, *addr, &last) || last < first_bit(*addr)))
		*bits = 0;
	else
		*bits = ((last - first_bit(*addr)) / addr->bits + 1) * addr->bits;
	return true;
}

static bool read_addresses(struct line_reader *line, const struct map_word *word)
{
	struct iec_addr *addr = &line->point.addr;
	uint32_t bits;

	if (!iomap_group_read(word->text, word->len, addr, &bits) || !iec_area_is_io(addr->area))
		return complain(line->reader, DIAG_IO_ADDRESS, word);
	line->point.output = iec_area_row(addr->area)->access == ACCESS_WRITE;
	line->count = bits / addr->bits;
	if (!bits)
		return complain(line->reader, DIAG_IO_GROUP, word);
	return line->count <= LIMIT_IO_POINTS || complain(line->reader, DIAG_IO_TOO_MANY, word);
}

static void step_address(struct iec_addr *addr)
{
	const uint32_t bit = first_bit(*addr) + addr->bits;

	addr->byte = bit / 8;
	addr->bit = (uint8_t)(bit % 8);
}

struct channel_option {
	const char *name, *form;
	unsigned drivers;       /* ON_…                                        */
	enum option_for use;
	bool (*set)(struct line_reader *line, const struct option_word *option);
};

static bool set_as(struct line_reader *line, const struct option_word *option)
{
	line->channel.type = iec_type_find(option->value, option->len);
	return line->channel.type != IEC_NONE && line->channel.type <= IEC_LREAL;
}

static bool set_raw(struct line_reader *line, const struct option_word *option)
{
	line->channel.raw = iec_type_find(option->value, option->len);
	return line->channel.raw != IEC_NONE && line->channel.raw <= IEC_LREAL &&
	       iec_type_row(line->channel.raw)->size > 1;
}

/* Two more words may follow: at 0V..10V. */
static bool set_range(struct line_reader *line, const struct option_word *option)
{
	struct io_channel *channel = &line->channel;
	struct map_word word;
	enum io_unit unit = UNIT_NONE;
	bool good;

	good = read_range(option->value, option->len, &channel->value_low, &channel->value_high, &unit) &&
	       unit == UNIT_NONE;
	line->range = option->word;
	channel->scaled = true;
	channel->at_low = channel->value_low;
	channel->at_high = channel->value_high;
	if (!lex_is(&line->reader->lex, "at"))
		return good;
	next_word(line->reader, &word);
	if (!next_word(line->reader, &line->at))
		return false;
	return read_range(line->at.text, line->at.len, &channel->at_low, &channel->at_high,
			  &line->at_unit) && good;
}

static bool set_limits(struct line_reader *line, const struct option_word *option)
{
	line->limits = option->word;
	line->channel.limited = true;
	return read_range(option->value, option->len, &line->channel.least, &line->channel.most,
			  &line->limits_unit);
}

static bool set_threshold(struct line_reader *line, const struct option_word *option)
{
	line->threshold = option->word;
	line->channel.switches = true;
	return read_quantity(option->value, option->len, &line->channel.on_at, &line->threshold_unit);
}

static bool set_hysteresis(struct line_reader *line, const struct option_word *option)
{
	return read_quantity(option->value, option->len, &line->hysteresis, &line->hysteresis_unit) &&
	       line->hysteresis >= 0;
}

static bool set_filter(struct line_reader *line, const struct option_word *option)
{
	return read_time(option->value, option->len, &line->channel.filter_ns);
}

static bool set_stale(struct line_reader *line, const struct option_word *option)
{
	return read_time(option->value, option->len, &line->channel.stale_ns);
}

static bool set_poll(struct line_reader *line, const struct option_word *option)
{
	return read_time(option->value, option->len, &line->channel.poll_ns);
}

static bool set_refresh(struct line_reader *line, const struct option_word *option)
{
	return read_time(option->value, option->len, &line->channel.refresh_ns);
}

static bool set_substitute(struct line_reader *line, const struct option_word *option)
{
	line->substitute = option->word;
	return option->len > 0;
}

static bool set_channel_safe(struct line_reader *line, const struct option_word *option)
{
	line->safe = option->word;
	return option->len > 0;
}

static bool set_device(struct line_reader *line, const struct option_word *option)
{
	line->channel.device = read_name(line->reader, option->value, option->len);
	return line->channel.device != NULL;
}

static bool set_name(struct line_reader *line, const struct option_word *option)
{
	line->channel.name = read_name(line->reader, option->value, option->len);
	return line->channel.name != NULL;
}

static bool set_number(struct line_reader *line, const struct option_word *option)
{
	return read_count(option->value, option->len, 1023, &line->channel.number);
}

static bool set_period(struct line_reader *line, const struct option_word *option)
{
	return read_time(option->value, option->len, &line->channel.period_ns) &&
	       line->channel.period_ns <= 10 * SECOND;
}

static bool set_bus(struct line_reader *line, const struct option_word *option)
{
	const struct net_reader *net = line->reader->net;
	const enum driver_id driver = line->point.driver;

	line->channel.bus = net ? find_bus(&net->net, option->value, option->len) : -1;
	if (line->channel.bus < 0)
		complain_about(line->reader, DIAG_IO_NO_BUS, &option->word, "BUS");
	else if ((net->net.bus[line->channel.bus].kind == BUS_PEER) != (driver == DRIVER_peer))
		complain_about(line->reader, DIAG_IO_BUS_KIND, &option->word,
			       bus_word(net->net.bus[line->channel.bus].kind));
	return true;
}

static bool set_unit(struct line_reader *line, const struct option_word *option)
{
	uint32_t unit;

	if (!read_count(option->value, option->len, 255, &unit) || (unit > 247 && unit != 255))
		return false;
	line->channel.unit_id = (uint8_t)unit;
	return true;
}

static bool set_table(struct line_reader *line, const struct option_word *option)
{
	const enum io_table table = table_of(option);
	uint32_t number;

	if (line->channel.table != TABLE_NONE) {
		complain(line->reader, DIAG_IO_CONFLICT, &option->word);
		return true;
	}
	line->channel.table = table;
	if (!read_count(option->value, option->len, UINT16_MAX, &number))
		return false;
	line->channel.reg = (uint16_t)number;
	if (line->point.output && (table == TABLE_DISCRETE_INPUT || table == TABLE_INPUT_REGISTER))
		complain(line->reader, DIAG_IO_FOR_INPUT, &option->word);
	return true;
}

static bool set_bit(struct line_reader *line, const struct option_word *option)
{
	uint32_t bit;

	if (!read_count(option->value, option->len, 15, &bit))
		return false;
	line->channel.reg_bit = (int8_t)bit;
	return true;
}

static bool set_word_order(struct line_reader *line, const struct option_word *option)
{
	line->channel.has_word_order = true;
	return read_order(option, &line->channel.word_swapped);
}

static bool set_byte_order(struct line_reader *line, const struct option_word *option)
{
	line->channel.has_byte_order = true;
	return read_order(option, &line->channel.byte_swapped);
}

static bool set_module_type(struct line_reader *line, const struct option_word *option)
{
	const struct net_reader *net = net_of(line->reader);

	line->module = net ? find_module(net, option->value, option->len) : NULL;
	if (!line->module)
		complain(line->reader, DIAG_IO_MODULE, &option->word);
	return true;
}

/* Outputs are written on each change anyway: the word has no effect. */
static bool set_on_change(struct line_reader *line, const struct option_word *option)
{
	(void)line;
	return !option->value;
}

static bool set_of(struct line_reader *line, const struct option_word *option)
{
	struct io_channel *channel = &line->channel;

	return iomap_group_read(option->value, option->len, &channel->of, &channel->of_bits) &&
	       iec_area_is_io(channel->of.area) &&
	       channel->of_bits && iec_area_row(channel->of.area)->access == ACCESS_READ;
}

static bool set_ask(struct line_reader *line, const struct option_word *option)
{
	line->ask_column = option->word.column;
	line->channel.ask = find_ask(line->reader, option->value, option->len) + 1;
	return line->channel.ask > 0;
}

static const struct channel_option channel_options[] = {
#define VALUE_OPTION(id, text, drivers, use, form, set) { text, form, drivers, use, set },
#include "hal/map_words.def"
};
enum { CHANNEL_OPTIONS = sizeof(channel_options) / sizeof(*channel_options) };

static unsigned bit_of(enum driver_id driver)
{
	return 1u << driver;
}

/* Options of a module are of its inputs and its outputs. */
static bool is_for(const struct line_reader *line, const struct channel_option *option)
{
	return line->point.driver == DRIVER_module || option->use == FOR_BOTH ||
	       (option->use == FOR_OUTPUT) == line->point.output;
}

static void read_channel_option(struct line_reader *line, const struct option_word *option)
{
	const unsigned driver = bit_of(line->point.driver);
	struct reader *reader = line->reader;
	const struct channel_option *row;
	int i = 0;

	while (i < CHANNEL_OPTIONS && !(option_is(option, channel_options[i].name) &&
					channel_options[i].drivers & driver))
		i++;
	row = &channel_options[i < CHANNEL_OPTIONS ? i : 0];
	if (i == CHANNEL_OPTIONS) {
		complain_about(reader, DIAG_IO_CHANNEL_OPTION, &option->word,
			       driver_row(line->point.driver)->word);
		return;
	}
	if (line->seen >> i & 1) {
		complain(reader, DIAG_IO_OPTION_TWICE, &option->word);
		return;
	}
	line->seen |= UINT64_C(1) << i;
	if (!is_for(line, row))
		complain(reader, row->use == FOR_INPUT ? DIAG_IO_FOR_INPUT : DIAG_IO_FOR_OUTPUT,
			 &option->word);
	else if ((!option->value && row->set != set_on_change) || !row->set(line, option))
		complain_form(reader, &option->word, row->form);
}

static bool is_given(const struct line_reader *line, const char *name)
{
	for (int i = 0; i < CHANNEL_OPTIONS; i++)
		if (line->seen >> i & 1 && strcmp(channel_options[i].name, name) == 0)
			return true;
	return false;
}

/* ---- the end of a line ---- */

static enum iec_type type_of(struct iec_addr addr)
{
	switch (addr.bits) {
	case 1: return IEC_BOOL;
	case 8: return IEC_USINT;
	case 16: return IEC_INT;
	case 32: return IEC_DINT;
	default: return IEC_LINT;
	}
}

static bool is_register(enum io_table table)
{
	return table == TABLE_INPUT_REGISTER || table == TABLE_HOLDING_REGISTER;
}

static bool is_real(enum iec_type type)
{
	return type == IEC_REAL || type == IEC_LREAL;
}

/* What a device measures; UNIT_NONE: numbers only. */
static enum io_unit unit_of(const struct line_reader *line)
{
	static const struct {
		const char *head;
		enum io_unit unit;
	} heads[] = {
		{ "voltage", UNIT_VOLT }, { "altvoltage", UNIT_VOLT }, { "current", UNIT_AMPERE },
		{ "temp", UNIT_CELSIUS }, { "resistance", UNIT_OHM }, { "in", UNIT_VOLT },
		{ "curr", UNIT_AMPERE },
	};
	const char *name = line->channel.name;
	const enum driver_id driver = line->point.driver;

	if (driver == DRIVER_w1)
		return UNIT_CELSIUS;
	if (driver == DRIVER_pwm)
		return UNIT_PERCENT;
	if (driver != DRIVER_iio && driver != DRIVER_hwmon)
		return UNIT_NONE;
	for (size_t i = 0; name && i < sizeof(heads) / sizeof(*heads); i++) {
		const size_t len = strlen(heads[i].head);

		if (strncmp(name, heads[i].head, len) == 0 && (!name[len] || ascii_digit(name[len])))
			return heads[i].unit;
	}
	return UNIT_NONE;
}

static void scale(struct io_channel *channel, double value_high, double at_high, enum io_unit unit)
{
	channel->scaled = true;
	channel->value_low = channel->at_low = 0;
	channel->value_high = value_high;
	channel->at_high = at_high;
	channel->unit = unit;
}

/* Values of lines that have no range=. */
static void scale_usually(struct line_reader *line, enum io_unit unit)
{
	struct io_channel *channel = &line->channel;
	const bool real = is_real(channel->type);

	if (channel->switches || unit == UNIT_NONE)
		channel->unit = unit;
	else if (real)
		scale(channel, 1, 1, unit);
	else if (line->point.driver == DRIVER_pwm)
		scale(channel, 27648, 100, unit);
	else if (unit == UNIT_CELSIUS && line->point.driver != DRIVER_iio)
		scale(channel, 100, 1, unit);   /* hundredths of a degree */
	else if (line->point.driver == DRIVER_hwmon)
		scale(channel, 1000, 1, unit);  /* millivolts, milliamperes */
	if (!channel->scaled && channel->raw != channel->type && !channel->switches && channel->reg_bit < 0)
		scale(channel, 1, 1, UNIT_NONE);
}

static bool settle_unit(struct line_reader *line, const struct map_word *word, enum io_unit given,
			enum io_unit unit)
{
	if (!word->len || given == unit || given == UNIT_NONE)
		return true;
	return unit == UNIT_NONE ? complain_form(line->reader, word, "0..4095") :
	       complain_about(line->reader, DIAG_IO_UNIT, word, io_unit_word(unit));
}

static bool settle_scale(struct line_reader *line)
{
	struct io_channel *channel = &line->channel;
	const enum io_unit unit = unit_of(line);
	const bool raw = channel->scaled && line->at_unit == UNIT_NONE;

	if (channel->scaled && channel->value_low >= channel->value_high)
		return complain(line->reader, DIAG_IO_RANGE, &line->range);
	if (channel->scaled && channel->at_low == channel->at_high)
		return complain(line->reader, DIAG_IO_RANGE, &line->at);
	if (channel->limited && channel->least >= channel->most)
		return complain(line->reader, DIAG_IO_RANGE, &line->limits);
	if (!settle_unit(line, &line->at, line->at_unit, unit) ||
	    !settle_unit(line, &line->limits, line->limits_unit, unit) ||
	    !settle_unit(line, &line->threshold, line->threshold_unit, unit))
		return false;
	channel->unit = raw || line->point.driver == DRIVER_modbus || line->point.driver == DRIVER_peer ?
			UNIT_NONE : unit;
	channel->off_below = channel->on_at - line->hysteresis;
	if (!channel->scaled)
		scale_usually(line, channel->unit);
	return true;
}

/* @bits: the width that the address must have: the message shows one. */
static bool complain_width(struct line_reader *line, const char *word, uint32_t bits)
{
	struct iec_addr addr = line->point.addr;
	char text[24], wanted[48];

	addr.bits = (uint8_t)bits;
	addr.bit = 0;
	iec_addr_print(addr, text, sizeof(text));
	snprintf(wanted, sizeof(wanted), "%s (%s)", word, text);
	return complain_about(line->reader, DIAG_IO_WIDTH, &line->address, wanted);
}

/* Whether the width of the address fits what the device has. */
static bool settle_width(struct line_reader *line)
{
	struct io_channel *channel = &line->channel;
	const struct iec_addr addr = line->point.addr;
	const bool bit = addr.bits == 1, bits = is_of_bits(channel->table);
	const uint32_t size = channel->type ? iec_type_row(channel->type)->size : 0;

	if (channel->type && (bit ? channel->type != IEC_BOOL : channel->type == IEC_BOOL || 8 * size != addr.bits))
		return complain_width(line, iec_type_row(channel->type)->word, channel->type == IEC_BOOL ? 1 : 8 * size);
	if (!channel->type)
		channel->type = type_of(addr);
	if (bit_of(line->point.driver) & (ON_SIM | ON_PEER | ON_QUALITY))
		return true;
	if (bits ? !bit : bit && !channel->switches && channel->reg_bit < 0)
		return complain_width(line, bits ? "BOOL" : "WORD", bits ? 1 : 16);
	if (!bit && (channel->switches || channel->reg_bit >= 0))
		return complain_width(line, "BOOL", 1);
	if (is_register(channel->table) && addr.bits == 8)
		return complain_width(line, "WORD", 16);
	return true;
}

/* A number of the type of the value; both signs of a bit string are good. */
static bool read_value(const struct io_channel *channel, const struct map_word *word, union iec_value *out)
{
	const char *value = (const char *)memchr(word->text, '=', word->len) + 1;
	const size_t len = word->len - (size_t)(value - word->text);
	const enum iec_type plain = iec_type_row(channel->type)->size == 8 ? IEC_LWORD :
		iec_type_row(channel->type)->size == 4 ? IEC_DWORD :
		iec_type_row(channel->type)->size == 2 ? IEC_WORD : IEC_BYTE;
	struct literal literal;
	uint64_t bits;

	if (literal_parse(value, len, &literal) != LITERAL_OK)
		return false;
	if (literal_fit(&literal, channel->type, out))
		return true;
	if (channel->type == IEC_BOOL || is_real(channel->type) || !literal_fit(&literal, plain, out))
		return false;
	iec_store(&bits, plain, *out);
	*out = iec_load(&bits, channel->type);
	return true;
}

static bool is_hold(const struct map_word *word)
{
	const char *value = (const char *)memchr(word->text, '=', word->len) + 1;

	return ascii_is("hold", value, word->len - (size_t)(value - word->text));
}

static bool settle_values(struct line_reader *line)
{
	struct io_channel *channel = &line->channel;
	struct io_point *point = &line->point;

	if (line->substitute.len && !is_hold(&line->substitute)) {
		channel->substituted = true;
		if (!read_value(channel, &line->substitute, &channel->substitute))
			return complain_form(line->reader, &line->substitute,
					     "substitute=0 or substitute=hold");
	}
	point->has_safe = line->safe.len > 0;
	point->hold = line->safe.len && is_hold(&line->safe);
	if (line->safe.len && !point->hold && !read_value(channel, &line->safe, &channel->safe))
		return complain_form(line->reader, &line->safe, "safe=0 or safe=hold");
	point->safe = channel->safe.i != 0;
	return true;
}

/* How many registers or coils a value takes. */
static uint32_t places_of(const struct io_channel *channel)
{
	if (!is_register(channel->table) || channel->reg_bit >= 0 || channel->raw == IEC_BOOL)
		return 1;
	return (iec_type_row(channel->raw)->size + 1u) / 2;
}

static bool overlaps(const struct io_channel *a, const struct io_channel *b)
{
	if (a->bus != b->bus || a->unit_id != b->unit_id || a->table != b->table)
		return false;
	if (a->reg_bit >= 0 && b->reg_bit >= 0 && a->reg_bit != b->reg_bit)
		return false;
	return a->reg < b->reg + places_of(b) && b->reg < a->reg + places_of(a);
}

/* Whether two points have one owner. A value may be read in two forms, but not written. */
static bool is_same_place(const struct io_point *a, const struct io_point *b)
{
	const struct io_channel *x = a->channel, *y = b->channel;

	if (!y || a->output != b->output || !a->output)
		return false;
	if (io_is_gateway(a) && io_is_gateway(b))
		return overlaps(x, y);
	return a->driver == b->driver && same_text(x->device, y->device) && x->number == y->number &&
	       (!x->name || same_text(x->name, y->name));
}

static bool check_places(struct line_reader *line, const struct io_point *point)
{
	const struct iomap *map = &line->reader->map;
	char first[24], what[LIMIT_ARG];
	struct map_word word = line->address;

	for (int i = 0; i < map->count; i++) {
		if (point->driver == DRIVER_sim || !is_same_place(point, &map->point[i]))
			continue;
		iec_addr_print(map->point[i].addr, first, sizeof(first));
		io_line_print(point, what, sizeof(what));
		word.text = what;
		word.len = strlen(what);
		return complain_about(line->reader, DIAG_IO_LINE_TWICE, &word, first);
	}
	return true;
}

/* The point with a channel of its own, as a group has one for each value. */
static bool keep(struct line_reader *line, struct io_point point, const struct io_channel *channel)
{
	struct io_channel *kept = arena_alloc(line->reader->arena, sizeof(*kept));

	if (!kept)
		return false;
	*kept = *channel;
	point.channel = kept;
	return take_address(line->reader, point.addr, &line->address) &&
	       check_places(line, &point) && add_point(line->reader, &point, &line->address);
}

/* The last step of a line: its point and channel become those of each value in turn. */
static void keep_group(struct line_reader *line)
{
	struct io_channel *channel = &line->channel;

	for (uint32_t i = 0; i < line->count; i++) {
		const uint32_t next = channel->reg + places_of(channel);

		if (!keep(line, line->point, channel))
			return;
		step_address(&line->point.addr);
		if (channel->reg_bit >= 0 && channel->reg_bit < 15) {
			channel->reg_bit++;
			continue;
		}
		channel->reg_bit = channel->reg_bit < 0 ? -1 : 0;
		if (next > UINT16_MAX && i + 1 < line->count && channel->table != TABLE_NONE) {
			complain(line->reader, DIAG_IO_LAST, &line->address);
			return;
		}
		channel->reg = (uint16_t)next;
	}
}

/* ---- modules ---- */

/* One kind of a module's values. */
static bool keep_part(struct line_reader *line, enum io_table table, struct iec_addr addr)
{
	struct io_channel channel = line->channel;
	struct io_point point = line->point;

	channel.table = table;
	channel.reg = line->module->first[table - 1];
	channel.type = channel.raw = type_of(addr);
	point.addr = addr;
	point.output = iec_area_row(addr.area)->access == ACCESS_WRITE;
	if (point.output)
		channel.substituted = false;
	else
		point.has_safe = point.hold = point.safe = false;
	for (uint16_t i = 0; i < line->module->count[table - 1]; i++) {
		if (!keep(line, point, &channel))
			return false;
		step_address(&point.addr);
		channel.reg++;
	}
	return true;
}

/* The place of a module is that of its digital inputs. */
static void keep_module(struct line_reader *line)
{
	const struct iec_addr at = line->point.addr;
	const uint32_t place = at.byte / DI_BYTES;

	if (at.area != AREA_XI || at.bits != 8 || at.byte % DI_BYTES || place >= MODULES ||
	    (line->count != 1 && line->count != DI_BYTES)) {
		complain(line->reader, DIAG_IO_MODULE_PLACE, &line->address);
		return;
	}
	line->channel.module = (int)place;
	line->channel.type = IEC_BOOL;
	if (!settle_values(line))
		return;
	if (keep_part(line, TABLE_DISCRETE_INPUT, (struct iec_addr){ .area = AREA_XI, .bits = 1, .byte = DI_BYTES * place }) &&
	    keep_part(line, TABLE_COIL, (struct iec_addr){ .area = AREA_XQ, .bits = 1, .byte = DQ_BYTES * place }) &&
	    keep_part(line, TABLE_INPUT_REGISTER, (struct iec_addr){ .area = AREA_XAI, .bits = 16, .byte = ANALOG_BYTES * place }))
		keep_part(line, TABLE_HOLDING_REGISTER,
			  (struct iec_addr){ .area = AREA_XAQ, .bits = 16, .byte = ANALOG_BYTES * place });
}

/* ---- a line ---- */

static bool has(const struct line_reader *line, const char *option)
{
	if (strcmp(option, "bus") == 0)
		return line->channel.bus >= 0;
	if (strcmp(option, "holding-register") == 0)
		return line->channel.table != TABLE_NONE;
	return is_given(line, option);
}

/* Whether all is there that the driver cannot be without; else says what is not. */
static bool has_needs(struct line_reader *line)
{
	static const char *const needs[DRIVER_COUNT][3] = {
		[DRIVER_iio] = { "device", "channel" }, [DRIVER_pwm] = { "chip", "channel", "period" },
		[DRIVER_w1] = { "sensor" }, [DRIVER_hwmon] = { "device", "channel" },
		[DRIVER_modbus] = { "bus", "unit", "holding-register" },
		[DRIVER_module] = { "bus", "unit", "type" }, [DRIVER_peer] = { "bus", "from", "name" },
		[DRIVER_quality] = { "of" },
	};
	char missing[80] = "";

	for (int i = 0; i < 3; i++) {
		const char *option = needs[line->point.driver][i];
		const size_t len = strlen(missing);

		if (option && !has(line, option))
			snprintf(missing + len, sizeof(missing) - len, "%s%s=%s", len ? ", " : "", option,
				 strcmp(option, "holding-register") == 0 ? " (or coil= …)" : "");
	}
	return !*missing || complain_about(line->reader, DIAG_IO_CHANNEL_NEEDS, &line->address, missing);
}

/* Whether the driver knows this direction. */
static bool check_direction(struct line_reader *line, const struct map_word *driver)
{
	const enum driver_id id = line->point.driver;

	if (line->point.output && (id == DRIVER_w1 || id == DRIVER_hwmon || id == DRIVER_peer || id == DRIVER_quality))
		return complain(line->reader, DIAG_IO_FOR_INPUT, driver);
	if (!line->point.output && id == DRIVER_pwm)
		return complain(line->reader, DIAG_IO_FOR_OUTPUT, driver);
	if (line->count > 1 && id != DRIVER_sim && id != DRIVER_modbus && id != DRIVER_module)
		return complain(line->reader, DIAG_IO_GROUP_DRIVER, &line->address);
	return true;
}

/* A point that a block asks for has no times of its own, and no safe value: nobody asks while no program
 * runs. All points of a block go one way, on one bus. */
static bool settle_ask(struct line_reader *line)
{
	static const char *const by_time[] = { "poll", "stale", "refresh", "on-change", "safe" };
	struct io_point *point = &line->point;
	struct map_word word = line->address;
	struct io_ask *ask;

	if (!line->channel.ask)
		return true;
	ask = &line->reader->net->net.ask[line->channel.ask - 1];
	word.text = ask->name;
	word.len = strlen(ask->name);
	word.column = line->ask_column;
	for (size_t i = 0; i < sizeof(by_time) / sizeof(*by_time); i++)
		if (is_given(line, by_time[i]))
			return complain(line->reader, DIAG_IO_CONFLICT, &word);
	if (ask->bus < 0)
		*ask = (struct io_ask){ .name = ask->name, .bus = line->channel.bus, .writes = point->output,
					.text_line = word.line, .text_column = word.column };
	point->has_safe = point->hold = point->output;
	return (ask->bus == line->channel.bus && ask->writes == point->output) ||
	       complain(line->reader, DIAG_IO_ASK_MIXED, &word);
}

/* The only bus of peers need not be named. */
static bool settle_peer(struct line_reader *line)
{
	struct io_channel *channel = &line->channel;
	static const struct io_net none;
	const struct io_net *net = line->reader->net ? &line->reader->net->net : &none;

	if (channel->bus < 0)
		channel->bus = only_peer_bus(net);
	if (channel->bus < 0)
		return complain_about(line->reader, DIAG_IO_BUS_NEEDS, &line->address, peer_bus_needed(net));
	return !channel->device || peer_board_fits(line->reader, &line->address, channel->device,
						   strlen(channel->device));
}

static void settle(struct line_reader *line)
{
	struct io_channel *channel = &line->channel;

	if (line->point.driver == DRIVER_peer && !settle_peer(line))
		return;
	if (!has_needs(line))
		return;
	if (line->point.driver == DRIVER_module) {
		keep_module(line);
		return;
	}
	if (!settle_width(line))
		return;
	if (!channel->raw)
		channel->raw = channel->switches || (channel->scaled && is_register(channel->table)) ?
			       IEC_INT : channel->reg_bit >= 0 ? IEC_WORD : channel->type;
	if (settle_scale(line) && settle_values(line) && settle_ask(line))
		keep_group(line);
}

bool read_channel(struct reader *reader, const struct map_word *address, enum driver_id driver,
		  const struct map_word *word)
{
	struct line_reader line = {
		.reader = reader, .address = *address,
		.point = { .driver = driver, .text_line = address->line, .text_column = address->column },
		.channel = { .stale_ns = IO_STALE_NS, .poll_ns = IO_POLL_NS, .refresh_ns = IO_REFRESH_NS,
			     .bus = -1, .module = -1, .reg_bit = -1 },
	};
	struct option_word option;
	const int before = reader->errors;
	struct iec_addr addr;

	if (!driver_row(driver)->by_channel &&
	    (driver != DRIVER_sim || (iec_addr_parse(address->text, address->len, &addr) == ADDR_OK &&
				      addr.bits == 1 && (addr.area == AREA_I || addr.area == AREA_Q))))
		return false;
	if (!read_addresses(&line, address) || !check_direction(&line, word)) {
		skip_words(reader);
		return true;
	}
	while (next_option(reader, &option))
		read_channel_option(&line, &option);
	if (reader->errors == before)
		settle(&line);
	return true;
}

/* ---- the quality of others ---- */

static bool has_points(const struct iomap *map, const struct io_channel *quality)
{
	const uint32_t from = first_bit(quality->of);

	for (int i = 0; i < map->count; i++) {
		const struct iec_addr at = map->point[i].addr;

		if (at.area == quality->of.area && first_bit(at) < from + quality->of_bits &&
		    from < first_bit(at) + at.bits && map->point[i].driver != DRIVER_quality)
			return true;
	}
	return false;
}

void check_qualities(struct reader *reader)
{
	for (int i = 0; i < reader->map.count; i++) {
		const struct io_point *point = &reader->map.point[i];
		struct map_word word = { .line = point->text_line, .column = point->text_column };
		char text[24];

		if (point->driver != DRIVER_quality || has_points(&reader->map, point->channel))
			continue;
		iec_addr_print(point->channel->of, text, sizeof(text));
		word.text = text;
		word.len = strlen(text);
		complain(reader, DIAG_IO_QUALITY, &word);
	}
}

/* ---- for others ---- */

int channel_line_print(const struct io_point *point, char *out, size_t size)
{
	const struct io_channel *channel = point->channel;

	switch (bit_of(point->driver)) {
	case ON_IIO: case ON_HWMON: case ON_PEER:
		return snprintf(out, size, "%.40s %.20s", channel->device, channel->name);
	case ON_PWM:
		return snprintf(out, size, "%.40s %u", channel->device, (unsigned)channel->number);
	case ON_QUALITY:
		return iec_addr_print(channel->of, out, size);
	case ON_W1:
		return snprintf(out, size, "%.60s", channel->device);
	case ON_MODBUS: case ON_MODULE:
		if (channel->reg_bit >= 0)
			return snprintf(out, size, "unit %u %s %u bit %d", channel->unit_id,
					table_word(channel->table), channel->reg, channel->reg_bit);
		return snprintf(out, size, "unit %u %s %u", channel->unit_id, table_word(channel->table),
				channel->reg);
	default:
		return iec_addr_print(point->addr, out, size);
	}
}
