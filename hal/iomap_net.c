/* SPDX-License-Identifier: MIT
 *
 * iomap_net - reads the lines of an I/O map that are no points: buses, types of modules, and what others
 * may ask of this board.
 */
#include "hal/iomap_net.h"
#include "hal/map_words.h"

#include "engine/base/ascii.h"
#include "engine/base/literal.h"
#include "engine/base/name.h"
#include "engine/scan/image.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#define PEER_GROUP  "239.192.20.1"
#define PEER_PORT   20020
#define MODBUS_PORT 502

/* ---- words of a line ---- */

bool next_option(struct reader *reader, struct option_word *out)
{
	const char *equal;

	if (!next_word(reader, &out->word))
		return false;
	equal = memchr(out->word.text, '=', out->word.len);
	out->name = equal ? (size_t)(equal - out->word.text) : out->word.len;
	out->value = equal ? equal + 1 : NULL;
	out->len = equal ? out->word.len - out->name - 1 : 0;
	return true;
}

bool option_is(const struct option_word *option, const char *name)
{
	return ascii_is(name, option->word.text, option->name);
}

bool read_count(const char *text, size_t len, uint32_t most, uint32_t *out)
{
	uint64_t number = 0;

	for (size_t i = 0; i < len; i++) {
		if (!ascii_digit(text[i]))
			return false;
		number = number * 10 + (uint64_t)(text[i] - '0');
		if (number > most)
			return false;
	}
	*out = (uint32_t)number;
	return len > 0;
}

bool read_time(const char *text, size_t len, int64_t *ns)
{
	return literal_parse_duration(text, len, ns) && *ns > 0 && *ns <= TIME_MOST;
}

const char *find_dots(const char *text, size_t len)
{
	for (size_t i = 0; i + 1 < len; i++)
		if (text[i] == '.' && text[i + 1] == '.')
			return text + i;
	return NULL;
}

/* "5..9" or "5". */
static bool read_span(const char *text, size_t len, uint32_t most, uint32_t *first, uint32_t *last)
{
	const char *dots = find_dots(text, len);

	if (!dots) {
		const bool good = read_count(text, len, most, first);

		*last = *first;
		return good;
	}
	return read_count(text, (size_t)(dots - text), most, first) &&
	       read_count(dots + 2, len - (size_t)(dots - text) - 2, most, last) && *first <= *last;
}

/* HOST:PORT, [HOST]:PORT, or HOST; the port stays as it is if it is not given. */
static bool read_host(struct reader *reader, const char *text, size_t len, const char **host,
		      uint16_t *port)
{
	const bool bracket = len > 0 && *text == '[';
	const char *close = bracket ? memchr(text, ']', len) : NULL;
	size_t end = len;
	uint32_t number;

	if (bracket && !close)
		return false;
	for (size_t i = bracket ? (size_t)(close - text) + 1 : 0; i < len; i++)
		if (text[i] == ':') {
			end = i;
			break;
		}
	if (end < len) {
		if (!read_count(text + end + 1, len - end - 1, UINT16_MAX, &number) || !number)
			return false;
		*port = (uint16_t)number;
	}
	if (bracket) {
		if (end != (size_t)(close - text) + 1)
			return false;
		text++;
		end -= 2;
	}
	*host = read_name(reader, text, end);
	return *host != NULL;
}

struct net_reader *net_of(struct reader *reader)
{
	if (!reader->net)
		reader->net = arena_alloc(reader->arena, sizeof(*reader->net));
	return reader->net;
}

/* ---- BUS and SERVE ---- */

static const struct {
	const char *word;
	enum io_bus_kind kind;
} bus_kinds[] = {
	{ "modbus-rtu", BUS_MODBUS_RTU }, { "modbus-tcp", BUS_MODBUS_TCP }, { "peer", BUS_PEER },
};

const char *bus_word(enum io_bus_kind kind)
{
	return bus_kinds[kind].word;
}

/* What is read: a bus, or a server with its bus. */
struct bus_reader {
	struct io_bus *bus;
	struct io_serve *serve; /* NULL: BUS                                   */
};

struct bus_option {
	const char *name, *form;
	unsigned kinds;         /* OF_… of a bus                                */
	unsigned serves;        /* … of a server                               */
	bool (*set)(struct reader *reader, struct bus_reader *out, const char *value, size_t len);
};

static bool set_port(struct reader *reader, struct bus_reader *out, const char *value, size_t len)
{
	out->bus->port = read_name(reader, value, len);
	return out->bus->port && out->bus->port[0] == '/';
}

static bool set_baud(struct reader *reader, struct bus_reader *out, const char *value, size_t len)
{
	static const uint32_t rates[] = { 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200,
					  230400, 460800, 921600 };
	uint32_t baud;

	(void)reader;
	if (!read_count(value, len, 1000000, &baud))
		return false;
	out->bus->baud = baud;
	for (size_t i = 0; i < sizeof(rates) / sizeof(*rates); i++)
		if (rates[i] == baud)
			return true;
	return false;
}

static bool set_parity(struct reader *reader, struct bus_reader *out, const char *value, size_t len)
{
	(void)reader;
	out->bus->parity = ascii_is("even", value, len) ? 'E' : ascii_is("odd", value, len) ? 'O' :
			   ascii_is("none", value, len) ? 'N' : '\0';
	return out->bus->parity;
}

static bool set_stop_bits(struct reader *reader, struct bus_reader *out, const char *value, size_t len)
{
	(void)reader;
	out->bus->stop_bits = len == 1 && *value == '1' ? 1 : len == 1 && *value == '2' ? 2 : 0;
	return out->bus->stop_bits;
}

static bool set_timeout(struct reader *reader, struct bus_reader *out, const char *value, size_t len)
{
	(void)reader;
	return read_time(value, len, &out->bus->timeout_ns);
}

static bool set_host(struct reader *reader, struct bus_reader *out, const char *value, size_t len)
{
	return read_host(reader, value, len, &out->bus->host, &out->bus->tcp_port);
}

/* Boards send to all who listen at a multicast address. */
static bool set_group(struct reader *reader, struct bus_reader *out, const char *value, size_t len)
{
	struct in_addr at;

	return read_host(reader, value, len, &out->bus->host, &out->bus->tcp_port) &&
	       inet_pton(AF_INET, out->bus->host, &at) == 1 && IN_MULTICAST(ntohl(at.s_addr));
}

static bool set_interface(struct reader *reader, struct bus_reader *out, const char *value, size_t len)
{
	out->bus->interface = read_name(reader, value, len);
	return out->bus->interface != NULL;
}

static bool set_serve_unit(struct reader *reader, struct bus_reader *out, const char *value, size_t len)
{
	uint32_t unit;

	(void)reader;
	if (!read_count(value, len, 247, &unit) || !unit)
		return false;
	out->serve->unit_id = (uint8_t)unit;
	return true;
}

static bool set_connections(struct reader *reader, struct bus_reader *out, const char *value, size_t len)
{
	uint32_t most;

	(void)reader;
	if (!read_count(value, len, 64, &most) || !most)
		return false;
	out->serve->connections = (uint16_t)most;
	return true;
}

static bool set_rate(struct reader *reader, struct bus_reader *out, const char *value, size_t len)
{
	(void)reader;
	return read_count(value, len, 100000, &out->serve->rate) && out->serve->rate;
}

static const struct bus_option bus_options[] = {
#define BUS_OPTION(id, text, buses, servers, form, set) { text, form, buses, servers, set },
#include "hal/map_words.def"
};
enum { BUS_OPTIONS = sizeof(bus_options) / sizeof(*bus_options) };

static void read_bus_option(struct reader *reader, struct bus_reader *out,
			    const struct option_word *option, unsigned *seen)
{
	const unsigned kind = 1u << out->bus->kind;
	int i = 0;

	while (i < BUS_OPTIONS && !(option_is(option, bus_options[i].name) &&
	       (out->serve ? bus_options[i].serves : bus_options[i].kinds) & kind))
		i++;
	if (i == BUS_OPTIONS)
		complain_about(reader, DIAG_IO_BUS_OPTION, &option->word, bus_word(out->bus->kind));
	else if (*seen & 1u << i)
		complain(reader, DIAG_IO_OPTION_TWICE, &option->word);
	else if (!option->value || !bus_options[i].set(reader, out, option->value, option->len))
		complain_form(reader, &option->word, bus_options[i].form);
	*seen |= i < BUS_OPTIONS ? 1u << i : 0;
}

/* What a bus cannot be without. */
static const char *bus_lacks(const struct bus_reader *of, unsigned seen)
{
	const char *need = of->bus->kind == BUS_MODBUS_RTU ? "port" :
			   of->bus->kind == BUS_PEER ? "interface" : of->serve ? "listen" : "host";

	for (int i = 0; i < BUS_OPTIONS; i++)
		if (strcmp(bus_options[i].name, need) == 0 && !(seen & 1u << i))
			return bus_options[i].form;
	return of->serve && of->bus->kind == BUS_MODBUS_RTU && !of->serve->unit_id ? "unit=1" : NULL;
}

static bool is_any(const char *host)
{
	return strcmp(host, "0.0.0.0") == 0 || strcmp(host, "::") == 0;
}

static bool listen_alike(const struct io_bus *a, const struct io_bus *b)
{
	return a->kind == BUS_MODBUS_TCP && b->kind == BUS_MODBUS_TCP && a->host && b->host &&
	       a->tcp_port == b->tcp_port && (same_text(a->host, b->host) || is_any(a->host) || is_any(b->host));
}

/* Two that open the same serial line or listen at the same place; or have one name. */
static bool check_bus(struct reader *reader, const struct io_bus *bus, bool listens, const struct map_word *name)
{
	const struct io_net *net = &reader->net->net;

	for (int i = 0; i < net->bus_count + net->serve_count; i++) {
		const bool serves = i >= net->bus_count;
		const struct io_bus *other = serves ? &net->serve[i - net->bus_count].at : &net->bus[i];

		if (other == bus)
			continue;
		if (same_text(other->name, bus->name))
			return complain(reader, DIAG_IO_BUS_TWICE, name);
		if (same_text(other->port, bus->port))
			return complain_about(reader, DIAG_IO_PORT_TWICE, name, other->name);
		if (listens && serves && listen_alike(other, bus))
			return complain_about(reader, DIAG_IO_LISTEN_TWICE, name, other->name);
	}
	return true;
}

static bool read_bus_kind(struct reader *reader, struct bus_reader *out)
{
	struct map_word word = { "", 0, 0, 0, false };

	if (!next_word(reader, &word))
		return false;
	for (size_t i = 0; i < sizeof(bus_kinds) / sizeof(*bus_kinds); i++)
		if (ascii_is(bus_kinds[i].word, word.text, word.len) &&
		    !(out->serve && bus_kinds[i].kind == BUS_PEER)) {
			out->bus->kind = bus_kinds[i].kind;
			return true;
		}
	return false;
}

/* BUS rs485 modbus-rtu port=…, or SERVE plc modbus-tcp listen=… */
static void read_bus(struct reader *reader, const struct map_word *first, struct bus_reader *out)
{
	struct io_bus *bus = out->bus;
	struct option_word option;
	struct map_word name;
	unsigned seen = 0;
	const int before = reader->errors;
	const char *lacks;

	*bus = (struct io_bus){ .baud = 19200, .parity = 'E', .stop_bits = 1,
				.text_line = first->line, .text_column = first->column };
	if (next_word(reader, &name))
		bus->name = read_name(reader, name.text, name.len);
	if (!bus->name || !read_bus_kind(reader, out)) {
		complain_form(reader, first, out->serve ? "SERVE plc modbus-tcp listen=127.0.0.1:502" :
			      "BUS rs485 modbus-rtu port=/dev/ttyS1 baud=19200");
		skip_words(reader);
		return;
	}
	bus->timeout_ns = (bus->kind == BUS_MODBUS_RTU ? 1 : 3) * SECOND / 10;
	bus->tcp_port = bus->kind == BUS_PEER ? PEER_PORT : MODBUS_PORT;
	if (bus->kind == BUS_PEER)
		bus->host = PEER_GROUP;
	while (next_option(reader, &option))
		read_bus_option(reader, out, &option, &seen);
	if (reader->errors != before)
		return;
	lacks = bus_lacks(out, seen);
	if (lacks)
		complain_about(reader, DIAG_IO_BUS_NEEDS, &name, lacks);
	else
		check_bus(reader, bus, out->serve != NULL, &name);
}

static void read_bus_line(struct reader *reader, const struct map_word *first)
{
	struct io_net *net = &reader->net->net;
	struct io_bus *bus;

	if (net->bus_count == IO_BUSES) {
		complain(reader, DIAG_IO_TOO_MANY, first);
		skip_words(reader);
		return;
	}
	bus = arena_push(reader->arena, &net->bus, &net->bus_count, sizeof(*bus));
	if (bus)
		read_bus(reader, first, &(struct bus_reader){ bus, NULL });
}

static void read_serve_line(struct reader *reader, const struct map_word *first)
{
	struct io_net *net = &reader->net->net;
	struct io_serve *serve;

	if (net->serve_count == IO_BUSES) {
		complain(reader, DIAG_IO_TOO_MANY, first);
		skip_words(reader);
		return;
	}
	serve = arena_push(reader->arena, &net->serve, &net->serve_count, sizeof(*serve));
	if (!serve)
		return;
	*serve = (struct io_serve){ .connections = 4, .rate = 1000 };
	read_bus(reader, first, &(struct bus_reader){ &serve->at, serve });
}

/* ---- WINDOW ---- */

const char *table_word(enum io_table table)
{
	static const char *const words[] = {
		"",
#define TABLE_WORD(id, text, of_bits) text,
#include "hal/map_words.def"
	};

	return words[table];
}

bool is_of_bits(enum io_table table)
{
	static const bool of[] = {
		false,
#define TABLE_WORD(id, text, of_bits) of_bits,
#include "hal/map_words.def"
	};

	return of[table];
}

enum io_table table_of(const struct option_word *option)
{
	for (int i = TABLE_COIL; i <= TABLE_HOLDING_REGISTER; i++)
		if (option_is(option, table_word((enum io_table)i)))
			return (enum io_table)i;
	return TABLE_NONE;
}

static int find_serve(const struct io_net *net, const struct map_word *word)
{
	for (int i = 0; i < net->serve_count; i++)
		if (net->serve[i].at.name && strlen(net->serve[i].at.name) == word->len &&
		    memcmp(net->serve[i].at.name, word->text, word->len) == 0)
			return i;
	return -1;
}

static bool windows_overlap(const struct io_window *a, const struct io_window *b)
{
	return a->serve == b->serve && a->table == b->table && a->first < b->first + b->count &&
	       b->first < a->first + a->count;
}

/* "read-only" or "read-write". False: it is another word. */
static bool read_access(const struct map_word *word, bool *writable)
{
	static const struct { const char *word; bool writable; } access[] = {
#define ACCESS_WORD(text, writable) { text, writable },
#include "hal/map_words.def"
	};

	for (size_t i = 0; i < sizeof(access) / sizeof(*access); i++)
		if (ascii_is(access[i].word, word->text, word->len)) {
			*writable = access[i].writable;
			return true;
		}
	return false;
}

/* The words behind the name of the server. Returns an example if they make no sense. */
static bool read_window_words(struct reader *reader, struct io_window *window)
{
	struct option_word option;
	struct map_word word;
	uint32_t first = 0, last = 0;

	if (!next_option(reader, &option) || !option.value)
		return false;
	window->table = table_of(&option);
	if (window->table == TABLE_NONE || !read_span(option.value, option.len, UINT16_MAX, &first, &last) ||
	    !next_word(reader, &word) ||
	    iec_addr_parse(word.text, word.len, &window->addr) != ADDR_OK ||
	    window->addr.bits != (is_of_bits(window->table) ? 1 : 16) || !next_word(reader, &word))
		return false;
	window->first = (uint16_t)first;
	window->count = last - first + 1;
	return read_access(&word, &window->writable);
}

/* Discrete inputs and input registers cannot be written in Modbus, and SM not at all. */
static bool may_write(const struct io_window *window)
{
	return window->table != TABLE_DISCRETE_INPUT && window->table != TABLE_INPUT_REGISTER &&
	       iec_area_row(window->addr.area)->access == ACCESS_WRITE;
}

static void read_window_line(struct reader *reader, const struct map_word *first)
{
	struct io_net *net = &reader->net->net;
	struct io_window window = { .text_line = first->line, .text_column = first->column }, *kept;
	struct map_word name;

	if (!next_word(reader, &name)) {
		complain_form(reader, first, "WINDOW plc coil=0..15 %QX0.0 read-only");
		return;
	}
	window.serve = find_serve(net, &name);
	if (window.serve < 0)
		complain_about(reader, DIAG_IO_NO_BUS, &name, "SERVE");
	else if (!read_window_words(reader, &window))
		complain_form(reader, first, "WINDOW plc holding-register=0..9 %MW0 read-write");
	else if (window.writable && !may_write(&window))
		complain(reader, DIAG_IO_WINDOW_WRITE, first);
	else {
		for (int i = 0; i < net->window_count; i++)
			if (windows_overlap(&window, &net->window[i])) {
				complain(reader, DIAG_IO_WINDOW_TWICE, first);
				break;
			}
		kept = arena_push(reader->arena, &net->window, &net->window_count, sizeof(*kept));
		if (kept)
			*kept = window;
	}
	skip_words(reader);
}

/* ---- PUBLISH ---- */

int find_bus(const struct io_net *net, const char *text, size_t len)
{
	for (int i = 0; i < net->bus_count; i++)
		if (net->bus[i].name && strlen(net->bus[i].name) == len &&
		    memcmp(net->bus[i].name, text, len) == 0)
			return i;
	return -1;
}

/* The only bus of peers, for lines that name none; -1: there are none or several. */
int only_peer_bus(const struct io_net *net)
{
	int found = -1;

	for (int i = 0; i < net->bus_count; i++) {
		if (net->bus[i].kind != BUS_PEER)
			continue;
		if (found >= 0)
			return -1;
		found = i;
	}
	return found;
}

const char *peer_bus_needed(const struct io_net *net)
{
	for (int i = 0; i < net->bus_count; i++)
		if (net->bus[i].kind == BUS_PEER)
			return "bus=";
	return "a line BUS yard peer interface=eth0 above it";
}

bool peer_board_fits(struct reader *reader, const struct map_word *at, const char *text, size_t len)
{
	struct map_word name = *at;

	if (len <= IO_PEER_BOARD)
		return true;
	name.text = text;
	name.len = len;
	return complain(reader, DIAG_IO_LONG_NAME, &name);
}

/* Names with commas between them, with or without blanks. */
static bool read_names(struct reader *reader, struct io_publish *publish, const struct map_word *word)
{
	const char *at = word->text, *end = word->text + word->len;

	while (at < end) {
		const char *comma = memchr(at, ',', (size_t)(end - at));
		const char *stop = comma ? comma : end;
		const char **name;

		if (stop > at) {
			char *text = read_name(reader, at, (size_t)(stop - at));

			if (!text)
				return false;
			name = arena_push(reader->arena, (void *)&publish->name, &publish->count,
					  sizeof(*name));
			if (name)
				*name = text;
		}
		at = stop + 1;
	}
	return true;
}

static bool set_every(struct reader *reader, struct io_publish *publish, const struct option_word *option,
		      const char *form)
{
	return read_time(option->value, option->len, &publish->every_ns) ||
	       complain_form(reader, &option->word, form);
}

static bool set_publish_bus(struct reader *reader, struct io_publish *publish, const struct option_word *option,
			    const char *form)
{
	(void)form;
	publish->bus = find_bus(&reader->net->net, option->value, option->len);
	return publish->bus >= 0 || complain_about(reader, DIAG_IO_NO_BUS, &option->word, "BUS");
}

static bool read_publish_word(struct reader *reader, struct io_publish *publish,
			      const struct option_word *option)
{
	static const struct {
		const char *name, *form;
		bool (*set)(struct reader *reader, struct io_publish *publish, const struct option_word *option,
			    const char *form);
	} options[] = {
#define PUBLISH_OPTION(id, text, form, set) { text, form, set },
#include "hal/map_words.def"
	};

	if (!option->value)
		return read_names(reader, publish, &option->word) ||
		       complain(reader, DIAG_IO_SYNTAX, &option->word);
	for (size_t i = 0; i < sizeof(options) / sizeof(*options); i++)
		if (option_is(option, options[i].name))
			return options[i].set(reader, publish, option, options[i].form);
	return complain_form(reader, &option->word, "every=100ms or bus=yard");
}

static void read_publish_line(struct reader *reader, const struct map_word *first)
{
	struct io_net *net = &reader->net->net;
	struct io_publish publish = { .bus = only_peer_bus(net), .every_ns = SECOND / 10,
				      .text_line = first->line, .text_column = first->column }, *kept;
	struct option_word option;
	struct map_word as;
	const int before = reader->errors;

	if (next_word(reader, &as) && peer_board_fits(reader, &as, as.text, as.len))
		publish.as = read_name(reader, as.text, as.len);
	while (next_option(reader, &option))
		read_publish_word(reader, &publish, &option);
	if (reader->errors != before)
		return;
	if (!publish.as || !publish.count) {
		complain_form(reader, first, "PUBLISH pump-house Level, Running every=100ms");
	} else if (publish.bus < 0 || net->bus[publish.bus].kind != BUS_PEER) {
		complain_about(reader, DIAG_IO_BUS_NEEDS, first, peer_bus_needed(net));
	} else {
		kept = arena_push(reader->arena, &net->publish, &net->publish_count, sizeof(*kept));
		if (kept)
			*kept = publish;
	}
}

/* ---- DEVICE ---- */

static const struct {
	const char *name, *form;
	uint32_t most, least;
	size_t at;            /* of its number in struct io_takes               */
} device_options[] = {
#define DEVICE_OPTION(id, text, form, most, least, member) { text, form, most, least, offsetof(struct io_takes, member) },
#include "hal/map_words.def"
};
enum { DEVICE_OPTIONS = sizeof(device_options) / sizeof(*device_options) };

/* False: it is none. */
static bool set_device_flag(struct io_takes *device, const struct option_word *option)
{
#define DEVICE_FLAG(id, text, member)                                         \
	if (option_is(option, text)) {                                        \
		device->member = true;                                        \
		return true;                                                  \
	}
#include "hal/map_words.def"
	return false;
}

bool read_order(const struct option_word *option, bool *swapped)
{
	*swapped = option->value && ascii_is("little", option->value, option->len);
	return *swapped || (option->value && ascii_is("big", option->value, option->len));
}

/* Bits of read_device_word(), behind those of device_options and of the flag. */
static bool *order_of(struct io_takes *device, const struct option_word *option, int *bit, const char **form)
{
	*bit = DEVICE_OPTIONS;
#define DEVICE_ORDER(id, text, its_form, member)                              \
	*bit += 1;                                                            \
	*form = its_form;                                                     \
	if (option_is(option, text))                                          \
		return &device->member;
#include "hal/map_words.def"
	return NULL;
}

static void read_device_word(struct reader *reader, struct io_takes *device,
			     const struct option_word *option, unsigned *seen)
{
	uint16_t number;
	uint32_t count;
	const char *form = NULL;
	int i;
	bool *order = order_of(device, option, &i, &form);

	for (i = order ? i : 0; i < DEVICE_OPTIONS && !option_is(option, device_options[i].name);)
		i++;
	if (i == DEVICE_OPTIONS && (option->value || !set_device_flag(device, option)))
		complain_form(reader, &option->word, "unit=3, read-registers=50, write-registers=20, "
			      "read-coils=256, write-coils=16, gap=0, together, word-order=little or byte-order=little");
	else if (*seen & 1u << i)
		complain(reader, DIAG_IO_OPTION_TWICE, &option->word);
	else if (i == DEVICE_OPTIONS)
		; /* it is set */
	else if (order) {
		if (!read_order(option, order))
			complain_form(reader, &option->word, form);
	}
	else if (!option->value || !read_count(option->value, option->len, device_options[i].most, &count) ||
		 count < device_options[i].least)
		complain_form(reader, &option->word, device_options[i].form);
	else {
		number = (uint16_t)count;
		memcpy((char *)device + device_options[i].at, &number, sizeof(number));
	}
	*seen |= 1u << i;
}

static bool device_is_twice(const struct io_net *net, const struct io_takes *device)
{
	for (int i = 0; i < net->takes_count; i++)
		if (net->takes[i].bus == device->bus && net->takes[i].unit_id == device->unit_id)
			return true;
	return false;
}

static void read_device_line(struct reader *reader, const struct map_word *first)
{
	struct io_net *net = &reader->net->net;
	struct io_takes device = { .gap_words = -1, .text_line = first->line, .text_column = first->column };
	struct io_takes *kept;
	struct map_word bus = { "", 0, 0, 0, false };
	struct option_word option;
	const int before = reader->errors;
	unsigned seen = 0;

	if (next_word(reader, &bus))
		device.bus = find_bus(net, bus.text, bus.len);
	while (next_option(reader, &option))
		read_device_word(reader, &device, &option, &seen);
	if (reader->errors != before)
		return;
	if (!bus.len || !(seen & 1u))
		complain_form(reader, first, "DEVICE plant unit=3 read-registers=50");
	else if (device.bus < 0 || net->bus[device.bus].kind == BUS_PEER)
		complain_about(reader, DIAG_IO_NO_BUS, &bus, "BUS");
	else if (device_is_twice(net, &device))
		complain(reader, DIAG_IO_BUS_TWICE, first);
	else {
		kept = arena_push(reader->arena, &net->takes, &net->takes_count, sizeof(*kept));
		if (kept)
			*kept = device;
	}
}

/* ---- ask= ---- */

int find_ask(struct reader *reader, const char *text, size_t len)
{
	struct net_reader *net = net_of(reader);
	struct io_ask *ask;
	char *name;

	for (int i = 0; net && i < net->net.ask_count; i++)
		if (name_is(net->net.ask[i].name, text, len))
			return i;
	name = net ? read_name(reader, text, len) : NULL;
	ask = name ? arena_push(reader->arena, &net->net.ask, &net->net.ask_count, sizeof(*ask)) : NULL;
	if (!ask)
		return -1;
	*ask = (struct io_ask){ .name = name, .bus = -1 };
	return net->net.ask_count - 1;
}

/* ---- MODULE ---- */

static const struct module_type known_modules[] = {
#define MODULE(name, di, dq, ai, aq) { #name, { dq, di, ai, aq }, { 0, 0, 0, 0 } },
#include "hal/modules.def"
};
enum { KNOWN_MODULES = sizeof(known_modules) / sizeof(*known_modules) };

/* The most that a module has of each kind, as its window has room for. */
static const uint16_t module_most[4] = { 8 * DQ_BYTES, 8 * DI_BYTES, ANALOG_BYTES / 2, ANALOG_BYTES / 2 };

const struct module_type *find_module(const struct net_reader *net, const char *text, size_t len)
{
	for (int i = 0; i < net->module_count; i++)
		if (net->module[i].name && ascii_is(net->module[i].name, text, len))
			return &net->module[i];
	for (int i = 0; i < KNOWN_MODULES; i++)
		if (ascii_is(known_modules[i].name, text, len))
			return &known_modules[i];
	return NULL;
}

static bool read_module_word(struct module_type *type, const struct option_word *option)
{
	static const char *const counts[4] = {
#define MODULE_OPTION(id, text, table) [(table) - 1] = text,
#include "hal/map_words.def"
	};
	uint32_t number;

	for (int i = 0; i < 4 && option->value; i++) {
		const bool counted = option_is(option, counts[i]);

		if (!counted && !option_is(option, table_word((enum io_table)(i + 1))))
			continue;
		if (!read_count(option->value, option->len, counted ? module_most[i] : 65000, &number))
			return false;
		*(counted ? &type->count[i] : &type->first[i]) = (uint16_t)number;
		return true;
	}
	return false;
}

static void read_module_line(struct reader *reader, const struct map_word *first)
{
	static const char form[] = "MODULE Card di=16 dq=8 discrete-input=0 coil=0";
	struct net_reader *net = reader->net;
	struct module_type type = { .name = NULL }, *kept;
	struct option_word option;
	const int before = reader->errors;
	struct map_word name;
	bool good;

	good = next_word(reader, &name);
	if (good)
		type.name = read_name(reader, name.text, name.len);
	good = good && type.name;
	while (good && next_option(reader, &option))
		if (!read_module_word(&type, &option))
			complain_form(reader, &option.word, "di=24, dq=16, ai=8 or aq=8, which are the most, or discrete-input=0, coil=0 …");
	if (reader->errors != before)
		return;
	if (!good) {
		complain_form(reader, first, form);
		skip_words(reader);
	} else if (find_module(net, type.name, strlen(type.name))) {
		complain(reader, DIAG_IO_BUS_TWICE, &name);
	} else {
		kept = arena_push(reader->arena, &net->module, &net->module_count, sizeof(*kept));
		if (kept)
			*kept = type;
	}
}

bool read_statement(struct reader *reader, const struct map_word *word)
{
	static const struct {
		const char *word;
		void (*read)(struct reader *reader, const struct map_word *first);
	} statements[] = {
#define MAP_STATEMENT(id, read) { #id, read },
#include "hal/map_words.def"
	};

	for (size_t i = 0; i < sizeof(statements) / sizeof(*statements); i++) {
		if (!ascii_is(statements[i].word, word->text, word->len))
			continue;
		if (net_of(reader))
			statements[i].read(reader, word);
		return true;
	}
	return false;
}

/* What a DEVICE line says of the registers of its unit. It may stand behind their lines. */
static void settle_orders(const struct iomap *map, const struct io_net *net)
{
	for (int i = 0; net->takes_count && i < map->count; i++) {
		struct io_channel *channel = (struct io_channel *)map->point[i].channel;

		for (int j = 0; channel && channel->bus >= 0 && j < net->takes_count; j++) {
			const struct io_takes *device = &net->takes[j];

			if (device->bus != channel->bus || device->unit_id != channel->unit_id)
				continue;
			if (!channel->has_word_order)
				channel->word_swapped = device->word_swapped;
			if (!channel->has_byte_order)
				channel->byte_swapped = device->byte_swapped;
		}
	}
}

void finish_net(struct reader *reader)
{
	check_qualities(reader);
	if (reader->net)
		settle_orders(&reader->map, &reader->net->net);
	if (reader->net && (reader->net->net.bus_count || reader->net->net.serve_count))
		reader->map.net = &reader->net->net;
}

/* ---- against a program ---- */

static bool check_window(const struct iomap *map, const struct io_window *window,
			 const struct areas *areas, struct diag_list *diags)
{
	struct iec_addr last = window->addr;
	const uint32_t bit = 8 * last.byte + last.bit + (window->count - 1) * last.bits;
	char text[24];

	last.byte = bit / 8;
	last.bit = (uint8_t)(bit % 8);
	if (areas_have(areas, last))
		return true;
	iec_addr_print(last, text, sizeof(text));
	return diag_add(diags, (struct diag){ .id = DIAG_IO_OUTSIDE, .file = map->file,
		.line = window->text_line, .column = window->text_column }, "%s", text);
}

/* Whether @symbol is BUSY of the block that asks. */
static bool is_block(const struct symbol *symbol, const struct io_ask *ask)
{
	static const char pin[] = ".BUSY";
	const size_t len = strlen(symbol->name), head = len - (sizeof(pin) - 1);

	return symbol->block && strcmp(symbol->block, ask->writes ? "MB_WRITE" : "MB_READ") == 0 &&
	       symbol->at.area == AREA_NONE && len >= sizeof(pin) && strcmp(symbol->name + head, pin) == 0 &&
	       name_is(ask->name, symbol->name, head);
}

/* How many blocks have this name, with or without that of their program; @at of the last one. */
static int count_blocks(const struct image *image, const struct io_ask *ask, bool whole, uint32_t *at)
{
	struct symbol_cursor cursor = { .whole = whole };
	struct symbol symbol;
	int count = 0;

	while (image_next_symbol(image, &cursor, &symbol)) {
		if (!is_block(&symbol, ask))
			continue;
		*at = symbol.at.where - (uint32_t)offsetof(struct fb_MB_READ, BUSY);
		count++;
	}
	return count;
}

bool io_ask_find(const struct image *image, const struct io_ask *ask, uint32_t *at)
{
	return count_blocks(image, ask, true, at) == 1 || count_blocks(image, ask, false, at) == 1;
}

static bool ask_said(const struct iomap *map, const struct io_ask *ask, enum diag_id id, const char *block,
		     struct diag_list *diags)
{
	const struct diag place = { .id = id, .file = map->file, .line = ask->text_line, .column = ask->text_column };

	return *block ? diag_add(diags, place, "%.60s" DIAG_AND "%s", ask->name, block) :
			diag_add(diags, place, "%.60s", ask->name);
}

static bool check_asks(const struct iomap *map, const struct image *image, struct diag_list *diags)
{
	const struct io_net *net = map->net;
	bool good = true;

	for (int i = 0; i < net->ask_count; i++) {
		const struct io_ask *ask = &net->ask[i];
		uint32_t at, other;

		if (!io_ask_find(image, ask, &at)) {
			good = ask_said(map, ask, DIAG_IO_ASK_NO_BLOCK, ask->writes ? "MB_WRITE" : "MB_READ", diags);
			continue;
		}
		for (int k = 0; k < i; k++)
			if (io_ask_find(image, &net->ask[k], &other) && other == at)
				good = ask_said(map, ask, DIAG_IO_ASK_TWICE, "", diags);
	}
	return good;
}

static bool check_published(const struct iomap *map, const struct io_publish *publish,
			    const struct image *image, struct diag_list *diags)
{
	bool good = true;

	for (int i = 0; i < publish->count; i++)
		if (image_find(image, publish->name[i], strlen(publish->name[i])).type == IEC_NONE)
			good = diag_add(diags, (struct diag){ .id = DIAG_IO_NO_VARIABLE, .file = map->file,
				.line = publish->text_line, .column = publish->text_column }, "%s",
				publish->name[i]);
	return good;
}

bool check_net(const struct iomap *map, const struct program *program, struct arena *arena,
	       struct diag_list *diags)
{
	const struct io_net *net = map->net;
	struct image *image = net ? arena_alloc(arena, sizeof(*image)) : NULL;
	bool good = true;

	if (!image)
		return !net;
	image->program = program;
	for (int i = 0; i < net->window_count; i++)
		good = check_window(map, &net->window[i], &program->areas, diags) && good;
	for (int i = 0; i < net->publish_count; i++)
		good = check_published(map, &net->publish[i], image, diags) && good;
	good = check_asks(map, image, diags) && good;
	return good;
}
