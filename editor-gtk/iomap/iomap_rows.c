/* SPDX-License-Identifier: MIT
 *
 * iomap_rows - what the table of an I/O map shows: rows, messages, choices.
 */
#include "editor-gtk/iomap/iomap_rows.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/spelling.h"

#include "engine/base/ascii.h"
#include "engine/base/name.h"

#include <stdlib.h>
#include <string.h>

/* ---- pages ---- */

static const enum io_field columns[IOMAP_PAGES][IOMAP_KIND] = {
	[IOMAP_PINS] = { IO_ADDRESS, IO_DRIVER, IO_LINE, IO_PULL, IO_ACTIVE_LOW, IO_DEBOUNCE, IO_SAFE,
		IO_DRIVE, IO_COMMENT, IO_FIELDS },
	[IOMAP_ANALOG] = { IO_ADDRESS, IO_DRIVER, IO_DEVICE, IO_CHANNEL, IO_OF, IO_RANGE, IO_FILTER,
		IO_LIMITS, IO_THRESHOLD, IO_HYSTERESIS, IO_STALE, IO_SUBSTITUTE, IO_SAFE, IO_PERIOD,
		IO_POLL, IO_REFRESH, IO_AS, IO_COMMENT, IO_FIELDS },
	[IOMAP_MODBUS] = { IO_ADDRESS, IO_DRIVER, IO_BUS, IO_UNIT, IO_TYPE, IO_TABLE, IO_NUMBER,
		IO_BIT, IO_RANGE, IO_POLL, IO_ASK, IO_STALE, IO_SUBSTITUTE, IO_SAFE, IO_REFRESH, IO_AS, IO_RAW,
		IO_FILTER, IO_LIMITS, IO_THRESHOLD, IO_HYSTERESIS, IO_WORD_ORDER, IO_BYTE_ORDER,
		IO_COMMENT, IO_FIELDS },
	[IOMAP_PEERS] = { IO_ADDRESS, IO_DRIVER, IO_DEVICE, IO_CHANNEL, IO_BUS, IO_RANGE, IO_STALE,
		IO_SUBSTITUTE, IO_AS, IO_COMMENT, IO_FIELDS },
	[IOMAP_BUSES] = { IO_ADDRESS, IO_DRIVER, IO_PORT, IO_BAUD, IO_PARITY, IO_STOP_BITS, IO_HOST,
		IO_INTERFACE, IO_GROUP, IO_TIMEOUT, IO_DI, IO_DQ, IO_AI, IO_AQ, IO_FIRST_DI,
		IO_FIRST_DQ, IO_FIRST_AI, IO_FIRST_AQ, IO_UNIT, IO_READ_REGISTERS, IO_WRITE_REGISTERS,
		IO_READ_COILS, IO_WRITE_COILS, IO_GAP, IO_TOGETHER, IO_WORD_ORDER, IO_BYTE_ORDER, IO_COMMENT, IO_FIELDS },
	[IOMAP_SERVED] = { IO_ADDRESS, IO_DRIVER, IO_BUS, IO_TABLE, IO_NUMBER, IO_ACCESS, IO_NAMES,
		IO_EVERY, IO_LISTEN, IO_PORT, IO_BAUD, IO_PARITY, IO_STOP_BITS, IO_UNIT,
		IO_CONNECTIONS, IO_RATE, IO_COMMENT, IO_FIELDS },
};

enum io_field iomap_column(enum iomap_page page, int column)
{
	return columns[page][column];
}

int iomap_column_of(enum iomap_page page, enum io_field field)
{
	for (int i = 0; columns[page][i] != IO_FIELDS; i++)
		if (columns[page][i] == field)
			return i;
	return -1;
}

const char *iomap_column_name(enum iomap_page page, int column)
{
	static const struct { enum iomap_page page; enum io_field field; const char *name; } other[] = {
		{ IOMAP_PEERS, IO_DEVICE, N_("Board") }, { IOMAP_PEERS, IO_CHANNEL, N_("Variable") },
		{ IOMAP_BUSES, IO_ADDRESS, N_("Name") }, { IOMAP_BUSES, IO_DRIVER, N_("Protocol") },
		{ IOMAP_SERVED, IO_ADDRESS, N_("Name or address") },
		{ IOMAP_SERVED, IO_DRIVER, N_("Protocol") },
		{ IOMAP_SERVED, IO_BUS, N_("Server or bus") },
		{ IOMAP_SERVED, IO_NUMBER, N_("Numbers") },
	};
	const enum io_field field = columns[page][column];

	for (gsize i = 0; i < G_N_ELEMENTS(other); i++)
		if (other[i].page == page && other[i].field == field)
			return _(other[i].name);
	return io_field_name(field);
}

const char *iomap_page_name(enum iomap_page page)
{
	static const char *const names[IOMAP_PAGES] = {
		[IOMAP_PINS] = N_("Pins"), [IOMAP_ANALOG] = N_("Analog"),
		[IOMAP_MODBUS] = N_("Modbus and modules"), [IOMAP_PEERS] = N_("Other boards"),
		[IOMAP_BUSES] = N_("Buses"), [IOMAP_SERVED] = N_("What others may ask"),
	};

	return _(names[page]);
}

static bool word_is(const struct io_text *io, int row, enum io_word word, const char *text)
{
	const struct io_span *span = &io->row[row].word[word];

	return ascii_is(text, io->text + span->at, span->len);
}

/* The addresses of a point or of a WINDOW; false: they cannot be read. */
static bool iomap_values(const struct io_text *io, int row, struct io_values *out)
{
	const enum io_word word = io->row[row].kind == IO_KIND_WINDOW ? IO_WORD_SHOWN : IO_WORD_ADDRESS;
	const struct io_span *span = &io->row[row].word[word];

	return (io->row[row].kind == IO_KIND_POINT || io->row[row].kind == IO_KIND_WINDOW) &&
	       io_values_read(io->text + span->at, span->len, out);
}

/* Levels of chips, and drivers whose lines look the same. */
static bool is_pin(const struct io_text *io, int row)
{
	struct io_values values;

	return word_is(io, row, IO_WORD_DRIVER, "gpio") || !iomap_values(io, row, &values) ||
	       (values.first.bits == 1 && (values.first.area == AREA_I || values.first.area == AREA_Q));
}

enum iomap_page iomap_page_of(const struct io_text *io, int row)
{
	static const char *const analog[] = { "iio", "pwm", "w1", "hwmon", "quality" };

	switch (io->row[row].kind) {
	case IO_KIND_BUS: case IO_KIND_MODULE: case IO_KIND_DEVICE: return IOMAP_BUSES;
	case IO_KIND_SERVE: case IO_KIND_WINDOW: case IO_KIND_PUBLISH: return IOMAP_SERVED;
	case IO_KIND_POINT: case IO_KINDS: break;
	}
	if (word_is(io, row, IO_WORD_DRIVER, "modbus") || word_is(io, row, IO_WORD_DRIVER, "module"))
		return IOMAP_MODBUS;
	if (word_is(io, row, IO_WORD_DRIVER, "peer"))
		return IOMAP_PEERS;
	for (gsize i = 0; i < G_N_ELEMENTS(analog); i++)
		if (word_is(io, row, IO_WORD_DRIVER, analog[i]))
			return IOMAP_ANALOG;
	return is_pin(io, row) ? IOMAP_PINS : IOMAP_ANALOG;
}

/* ---- rows ---- */

char *iomap_field(const struct io_text *io, int row, enum io_field field)
{
	char *text = io_text_field(io, row, field);
	char *out = g_strdup(text ? text : "");

	free(text);
	return out;
}

/* %IX0.0..3 as I0.0..3, or the other way round. NULL: it does not begin with an address. */
static char *respelled(enum spelling spelling, const char *text)
{
	const char *rest = strstr(text, "..");
	const gsize len = rest ? (gsize)(rest - text) : strlen(text);
	struct iec_addr addr;
	char first[32];

	if (iec_addr_parse(text, len, &addr) != ADDR_OK)
		return NULL;
	spelling_address(spelling, addr, first, sizeof(first));
	return g_strconcat(first, text + len, NULL);
}

/* A bus may have a name like an address. */
static bool has_addresses(const struct io_text *io, int row, enum io_field field)
{
	const enum io_kind kind = io->row[row].kind;

	return field == IO_OF || (field == IO_ADDRESS && (kind == IO_KIND_POINT || kind == IO_KIND_WINDOW));
}

char *iomap_shown(const struct io_text *io, int row, enum io_field field)
{
	char *text = iomap_field(io, row, field);
	char *shown = *text == '%' && has_addresses(io, row, field) ? respelled(spelling_screen(), text) : NULL;

	if (!shown)
		return text;
	g_free(text);
	return shown;
}

char *iomap_typed(const struct io_text *io, int row, enum io_field field, const char *text)
{
	char *typed = *text != '%' && has_addresses(io, row, field) ? respelled(SPELLING_IEC, text) : NULL;

	return typed ? typed : g_strdup(text);
}

/* Caller: g_free(). */
static char *said_of_row(const struct io_machine *machine, const struct diag *diag)
{
	if (machine->elsewhere && (diag->id == DIAG_IO_NO_LINE || diag->id == DIAG_IO_NO_CHIP))
		return g_strdup_printf(_("\"%s\": the connected board has no such line"), diag->arg);
	return diag_said_whole(diag);
}

/* What is wrong with the row, else its line on this machine or on the board. */
static char *state_of(const struct io_machine *machine, const struct io_placed *placed,
		      const struct diag *diag)
{
	const struct io_found *found;

	if (diag)
		return said_of_row(machine, diag);
	if (placed && placed->point->driver == DRIVER_sim)
		return g_strdup(_("simulated"));
	if (!placed || placed->found < 0)
		return g_strdup("");
	found = &machine->line[placed->found];
	return g_strdup_printf("%s %u", found->chip, (unsigned)found->offset);
}

static void fill_note(LadderPanelRow *row, const struct io_machine *machine, const struct diag *diag, bool warns)
{
	if (!diag)
		return;
	row->note = said_of_row(machine, diag);
	row->tone = warns ? PANEL_WARNING : PANEL_ERROR;
}

static char *spoken(const LadderPanelRow *row, enum iomap_page page)
{
	GString *text = g_string_new(panel_row_text(row, IOMAP_KIND));

	for (int i = 0; columns[page][i] != IO_FIELDS; i++) {
		const char *part = io_field_is_flag(columns[page][i]) && *panel_row_text(row, i) ?
			io_field_name(columns[page][i]) : panel_row_text(row, i);

		if (*part)
			g_string_append_printf(text, "%s%s", i ? ", " : text->len ? " " : "", part);
	}
	if (*panel_row_text(row, IOMAP_SYMBOL))
		g_string_append_printf(text, ", %s", panel_row_text(row, IOMAP_SYMBOL));
	if (*panel_row_text(row, IOMAP_STATE))
		g_string_append_printf(text, ". %s", panel_row_text(row, IOMAP_STATE));
	return g_string_free(text, FALSE);
}

#define SYMBOLS 4 /* names of a line with several values                     */

/* The names that the program has for the values of a line. */
static char *symbols_of(const struct io_uses *uses, const struct io_text *io, int number)
{
	GString *text = g_string_new(NULL);
	struct io_values values;
	int count = 0;

	if (!iomap_values(io, number, &values))
		return g_string_free(text, FALSE);
	for (int i = 0; i < uses->count && count <= SYMBOLS; i++) {
		if (!*uses->use[i].name || !io_values_have(&values, uses->use[i].addr))
			continue;
		if (count++ < SYMBOLS)
			g_string_append_printf(text, "%s%s", text->len ? ", " : "", uses->use[i].name);
		else
			g_string_append(text, " …");
	}
	return g_string_free(text, FALSE);
}

LadderPanelRow *iomap_row_new(const struct io_uses *uses, const struct io_machine *machine,
			      const struct io_text *io, const struct io_check *check,
			      int number)
{
	LadderPanelRow *row = ladder_panel_row_new();
	const enum iomap_page page = iomap_page_of(io, number);
	const int line = io->row[number].line;
	const struct io_placed *placed = check ? io_check_point(check, line) : NULL;
	bool warns = false;
	const struct diag *diag = check ? io_check_at(check, line, &warns) : NULL;

	for (int i = 0; columns[page][i] != IO_FIELDS; i++) {
		row->text[i] = iomap_shown(io, number, columns[page][i]);
		if (io_text_has(io, number, columns[page][i]))
			row->flags |= 1u << i;
	}
	row->text[IOMAP_KIND] = g_strdup(io_kind_word(io->row[number].kind));
	row->text[IOMAP_SYMBOL] = symbols_of(uses, io, number);
	row->text[IOMAP_STATE] = state_of(machine, placed, diag);
	row->table = (int)page;
	row->index = number;
	row->number = number;
	fill_note(row, machine, diag, warns);
	row->spoken = spoken(row, page);
	return row;
}

/* ---- points missing in the map ---- */

/* A module has inputs and outputs of four areas, at the place that its address says. */
static bool module_has(const struct io_values *values, struct iec_addr addr)
{
	static const struct { enum iec_area area; uint32_t bytes; } part[] = {
		{ AREA_XI, 3 }, { AREA_XQ, 2 }, { AREA_XAI, 16 }, { AREA_XAQ, 16 },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(part); i++) {
		struct io_values of = { .count = part[i].bytes };

		of.first.area = part[i].area;
		of.first.bits = 8;
		of.first.byte = values->first.byte / 3 * part[i].bytes;
		if (io_values_have(&of, addr))
			return true;
	}
	return false;
}

/* The check gives the lines without errors; it also knows the types of modules. */
bool iomap_has(const struct io_text *io, const struct io_check *check, struct iec_addr addr)
{
	struct io_values values;

	if (check && io_check_has(check, addr))
		return true;
	for (int i = 0; i < io->count; i++) {
		if (io->row[i].kind != IO_KIND_POINT || !iomap_values(io, i, &values) ||
		    (check && io_check_point(check, io->row[i].line)))
			continue;
		if (io_values_have(&values, addr) ||
		    (word_is(io, i, IO_WORD_DRIVER, "module") && module_has(&values, addr)))
			return true;
	}
	return false;
}

#define LACKS_SHOWN 4 /* missing points to name; others are counted            */

char *iomap_lacks(const struct io_uses *uses, const struct io_text *io,
		  const struct io_check *check)
{
	GString *text = g_string_new(NULL);
	char *whole;
	int count = 0;

	for (int i = 0; i < uses->count; i++) {
		const struct io_use *use = &uses->use[i];
		char address[24];

		if (iomap_has(io, check, use->addr) || count++ >= LACKS_SHOWN)
			continue;
		spelling_address(spelling_screen(), use->addr, address, sizeof(address));
		g_string_append_printf(text, "%s%s%s%s", text->len ? ", " : "", address,
				       *use->name ? " " : "", use->name);
	}
	if (count > LACKS_SHOWN)
		g_string_append_printf(text, ngettext(" and %d more", " and %d more",
			(gulong)(count - LACKS_SHOWN)), count - LACKS_SHOWN);
	whole = count ? g_strdup_printf(_("Used by the program, missing in the map: %s"),
					text->str) : NULL;
	g_string_free(text, TRUE);
	return whole;
}

/* ---- messages ---- */

static bool has_row(const struct io_text *io, int line)
{
	for (int i = 0; i < io->count; i++)
		if (io->row[i].line == line)
			return true;
	return false;
}

char *iomap_first_error(const struct io_check *check, const struct io_text *io, bool all)
{
	for (int i = 0; check && i < check->errors.count; i++) {
		const struct diag *diag = &check->errors.diag[i];
		char *said, *text;

		if (!all && has_row(io, diag->line) && diag->id != DIAG_IO_NO_BOARD)
			continue;
		said = diag_said_whole(diag);
		text = diag->line ? g_strdup_printf(_("Line %d: %s"), diag->line, said) :
			g_strdup(said);
		g_free(said);
		return text;
	}
	return NULL;
}

char *iomap_first_doubt(const struct io_check *check)
{
	const struct diag *first = check && check->doubts.count ? &check->doubts.diag[0] : NULL;
	char *arg, *said, *text;

	if (!first)
		return NULL;
	arg = check->doubts.count + check->doubts.dropped == 1 ? g_strdup(first->arg) :
	      g_strdup_printf("%s" DIAG_AND "%d", first->arg,
			      check->doubts.count + check->doubts.dropped - 1);
	said = diag_said_of(first->id, arg);
	text = g_strdup_printf(_("Line %d: %s"), first->line, said);
	g_free(said);
	g_free(arg);
	return text;
}

/* ---- choices ---- */

static void offer(GPtrArray *choices, const char *text, const char *about)
{
	g_ptr_array_add(choices, g_strdup(text));
	g_ptr_array_add(choices, g_strdup(about));
}

static void offer_lines(const struct io_machine *machine, GPtrArray *choices)
{
	for (int i = 0; i < machine->count; i++) {
		const struct io_found *found = &machine->line[i];
		char name[LIMIT_NAME + 64];
		char *about = g_strdup_printf("%s (%s) %u, %s", found->chip, found->label,
			(unsigned)found->offset, !found->used ? _("free") :
			*found->owner ? found->owner : _("in use"));

		io_machine_name(machine, i, name, sizeof(name));
		offer(choices, name, about);
		g_free(about);
	}
	if (!choices->len)
		offer(choices, "", _("no GPIO lines on this machine"));
}

/* Addresses of the program that are missing in the map. With a row, of its width. */
static void offer_addresses(const struct io_uses *uses, const struct io_text *io, int row,
			    GPtrArray *choices)
{
	struct io_values values = { .count = 0 };
	const bool wide = row >= 0 && iomap_values(io, row, &values);
	char address[24];

	for (int i = 0; i < uses->count; i++) {
		const struct iec_addr addr = uses->use[i].addr;

		if ((wide && addr.bits != values.first.bits) || iomap_has(io, NULL, addr))
			continue;
		spelling_address(spelling_screen(), addr, address, sizeof(address));
		offer(choices, address, uses->use[i].name);
	}
}

/* The names of all BUS lines that fit, or of all SERVE lines. */
static void offer_buses(const struct io_text *io, int row, GPtrArray *choices)
{
	const bool window = row >= 0 && io->row[row].kind == IO_KIND_WINDOW;
	const bool peer = row >= 0 && (io->row[row].kind == IO_KIND_PUBLISH ||
				       word_is(io, row, IO_WORD_DRIVER, "peer"));

	for (int i = 0; i < io->count; i++) {
		char *name, *about;

		if (io->row[i].kind != (window ? IO_KIND_SERVE : IO_KIND_BUS) ||
		    (!window && row >= 0 && peer != word_is(io, i, IO_WORD_DRIVER, "peer")))
			continue;
		name = iomap_field(io, i, IO_ADDRESS);
		about = iomap_field(io, i, IO_DRIVER);
		if (*name)
			offer(choices, name, about);
		g_free(name);
		g_free(about);
	}
}

static char *about_module(const char *di, const char *dq, const char *ai, const char *aq)
{
	return g_strdup_printf(_("DI %s, DQ %s, AI %s, AQ %s"), *di ? di : "0", *dq ? dq : "0",
			       *ai ? ai : "0", *aq ? aq : "0");
}

static void offer_modules(const struct io_text *io, GPtrArray *choices)
{
	static const struct { const char *name, *count[4]; } known[] = {
#define MODULE(name, di, dq, ai, aq) { #name, { #di, #dq, #ai, #aq } },
#include "hal/modules.def"
	};

	for (int i = 0; i < io->count; i++) {
		char *name, *count[4], *about;

		if (io->row[i].kind != IO_KIND_MODULE)
			continue;
		name = iomap_field(io, i, IO_ADDRESS);
		for (int k = 0; k < 4; k++)
			count[k] = iomap_field(io, i, (enum io_field)(IO_DI + k));
		about = about_module(count[0], count[1], count[2], count[3]);
		offer(choices, name, about);
		g_free(about);
		for (int k = 0; k < 4; k++)
			g_free(count[k]);
		g_free(name);
	}
	for (gsize i = 0; i < G_N_ELEMENTS(known); i++) {
		char *about = about_module(known[i].count[0], known[i].count[1], known[i].count[2],
					   known[i].count[3]);

		offer(choices, known[i].name, about);
		g_free(about);
	}
}

/* Types of as= that have the width of the address; of raw= those of whole registers. */
static void offer_types(const struct io_text *io, int row, bool raw, GPtrArray *choices)
{
	struct io_values values = { .count = 0 };
	const bool known = row >= 0 && iomap_values(io, row, &values);

	for (enum iec_type type = (enum iec_type)(IEC_NONE + 1); type <= IEC_LREAL; type++) {
		const struct iec_type_row *of = iec_type_row(type);
		const int bits = type == IEC_BOOL ? 1 : 8 * of->size;

		if (raw ? of->size > 1 : !known || bits == values.first.bits)
			offer(choices, of->word, "");
	}
}

static const char *about_word(const char *word)
{
	static const struct { const char *word, *about; } row[] = {
		{ "gpio", N_("a line of a GPIO chip") },
		{ "sim", N_("a value in memory, no pin") },
		{ "iio", N_("an analog input or output of the kernel") },
		{ "pwm", N_("a pulse width") },
		{ "w1", N_("a temperature on a 1-wire bus") },
		{ "hwmon", N_("a sensor of the board") },
		{ "modbus", N_("a coil or registers of a Modbus device") },
		{ "module", N_("all of an expansion module") },
		{ "peer", N_("a variable of another board") },
		{ "quality", N_("how good the value of another input is") },
		{ "modbus-rtu", N_("Modbus on a serial line") },
		{ "modbus-tcp", N_("Modbus on a network") },
		{ "pull-up", N_("a resistor of the chip to its supply") },
		{ "pull-down", N_("a resistor of the chip to ground") },
		{ "no-pull", N_("no resistor of the chip") },
		{ "push-pull", N_("drives high and low") },
		{ "open-drain", N_("drives low only") },
		{ "open-source", N_("drives high only") },
		{ "coil", N_("bits that can be written") },
		{ "discrete-input", N_("bits that can be read") },
		{ "input-register", N_("words that can be read") },
		{ "holding-register", N_("words that can be written") },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(row); i++)
		if (strcmp(row[i].word, word) == 0)
			return _(row[i].about);
	return "";
}

/* "0", "1" and "hold" mean something else for each field. */
static const char *about_value(enum io_field field, const char *word)
{
	if (field == IO_SAFE)
		return strcmp(word, "0") == 0 ? _("off while nothing runs") :
		       strcmp(word, "1") == 0 ? _("on while nothing runs") :
						_("keeps its last value while nothing runs");
	if (field == IO_SUBSTITUTE)
		return strcmp(word, "hold") == 0 ? _("keeps its last value while it is stale") :
						   _("this value while it is stale");
	return about_word(word);
}

static void offer_drivers(const struct io_text *io, int row, GPtrArray *choices)
{
	const enum io_kind kind = row < 0 ? IO_KIND_POINT : io->row[row].kind;
	static const char *const bus[] = { "modbus-rtu", "modbus-tcp", "peer" };

	if (kind == IO_KIND_BUS || kind == IO_KIND_SERVE)
		for (int i = 0; i < (kind == IO_KIND_BUS ? 3 : 2); i++)
			offer(choices, bus[i], about_word(bus[i]));
	else
		for (int i = 0; i < DRIVER_COUNT; i++)
			offer(choices, driver_row((enum driver_id)i)->word,
			      about_word(driver_row((enum driver_id)i)->word));
}

static void offer_names(const struct io_uses *uses, GPtrArray *choices)
{
	for (int i = 0; i < uses->count; i++)
		if (*uses->use[i].name)
			offer(choices, uses->use[i].name, "");
}

/* Devices of the driver of the row, each once; or the channels of its device. */
static void offer_devices(const struct io_devices *devices, bool elsewhere, const struct io_text *io, int row,
			  bool channels, GPtrArray *choices)
{
	char *of = row < 0 ? g_strdup("") : iomap_field(io, row, IO_DEVICE);
	const char *last = NULL;

	for (int i = 0; i < devices->count; i++) {
		const struct io_device *device = &devices->device[i];

		if (row >= 0 && !word_is(io, row, IO_WORD_DRIVER, device->driver))
			continue;
		if (channels ? *device->channel && (!*of || strcmp(device->device, of) == 0) :
			       !last || strcmp(last, device->device) != 0)
			offer(choices, channels ? device->channel : device->device, device->about);
		last = device->device;
	}
	if (!choices->len)
		offer(choices, "", elsewhere ? _("the connected board has none") : _("this machine has none"));
	g_free(of);
}

GPtrArray *iomap_choices(const struct io_uses *uses, const struct io_machine *machine,
			 const struct io_devices *devices, const struct io_text *io, int row,
			 enum io_field field)
{
	GPtrArray *choices = g_ptr_array_new_with_free_func(g_free);
	const char *const *word = io_text_choices(field);

	switch ((int)field) {
	case IO_ADDRESS: offer_addresses(uses, io, row, choices); break;
	case IO_LINE: offer_lines(machine, choices); break;
	case IO_DRIVER: offer_drivers(io, row, choices); break;
	case IO_DEVICE: offer_devices(devices, machine->elsewhere, io, row, false, choices); break;
	case IO_CHANNEL: offer_devices(devices, machine->elsewhere, io, row, true, choices); break;
	case IO_BUS: offer_buses(io, row, choices); break;
	case IO_TYPE: offer_modules(io, choices); break;
	case IO_AS: offer_types(io, row, false, choices); break;
	case IO_RAW: offer_types(io, row, true, choices); break;
	case IO_NAMES: offer_names(uses, choices); break;
	default: break;
	}
	if (word && field != IO_TABLE && field != IO_ACCESS)
		offer(choices, "", "");
	for (; word && *word; word++)
		offer(choices, *word, about_value(field, *word));
	return choices;
}

void iomap_offer_units(const GArray *units, GPtrArray *choices)
{
	for (guint i = 0; units && i < units->len; i++) {
		const struct iomap_unit *unit = &g_array_index(units, struct iomap_unit, i);
		char *number = g_strdup_printf("%d", unit->unit);
		char *about = unit->exception ? g_strdup_printf(_("answers in %.1f ms: exception %d"), unit->ms, unit->exception) :
						g_strdup_printf(_("answers in %.1f ms"), unit->ms);

		offer(choices, number, about);
		g_free(about);
		g_free(number);
	}
}

static bool is_modbus(const struct io_text *io, int row)
{
	return io->row[row].kind == IO_KIND_BUS && (word_is(io, row, IO_WORD_DRIVER, "modbus-rtu") ||
						     word_is(io, row, IO_WORD_DRIVER, "modbus-tcp"));
}

int iomap_bus_of(const struct io_text *io, int row, bool any)
{
	char *name = row >= 0 && row < io->count ? iomap_field(io, row, IO_BUS) : g_strdup("");
	int found = row >= 0 && row < io->count && is_modbus(io, row) ? row : -1;

	for (int i = 0; i < io->count && found < 0; i++) {
		char *own = iomap_field(io, i, IO_ADDRESS);

		if (is_modbus(io, i) && (*name ? name_equal(own, name) : any))
			found = i;
		g_free(own);
	}
	g_free(name);
	return found;
}

/* ---- a new map ---- */

/* The model of the machine if it is a board, else the project's name. Caller: g_free. */
static char *board_name(LadderDocument *document, bool board)
{
	char *name = NULL;

	if (board && g_file_get_contents("/proc/device-tree/model", &name, NULL, NULL) &&
	    g_utf8_validate(name, -1, NULL) && *g_strstrip(name))
		return name;
	g_free(name);
	return ladder_document_name(document);
}

/* Applies @edit to @text; takes its text over. */
static void apply_new(GString *text, enum io_refusal why, struct io_edit *edit)
{
	if (why == IO_GOOD) {
		g_string_erase(text, (gssize)edit->at, (gssize)edit->removed);
		g_string_insert(text, (gssize)edit->at, edit->with);
	}
	free(edit->with);
}

static void add_use(GString *text, const struct io_use *use, const char *driver)
{
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io = { .text = text->str, .len = text->len };
	char address[24];

	if (use->addr.bits != 1 || (use->addr.area != AREA_I && use->addr.area != AREA_Q))
		driver = "sim";
	iec_addr_print(use->addr, address, sizeof(address));
	apply_new(text, io_text_add(&io, -1, address, driver, "", use->name, &edit), &edit);
}

char *iomap_new_text(LadderDocument *document)
{
	struct project *project = ladder_document_project(document);
	GString *text = g_string_new(NULL);
	struct io_edit edit = { 0, 0, NULL };
	struct io_text io = { .text = "" };
	struct io_machine machine;
	struct io_uses uses;
	char *board;

	io_machine_look(&machine, NULL);
	board = board_name(document, machine.count > 0);
	apply_new(text, io_text_set_board(&io, board, &edit), &edit);
	g_string_append_c(text, '\n');
	if (project && io_uses_make(&uses, project)) {
		for (int i = 0; i < uses.count; i++)
			add_use(text, &uses.use[i], machine.count ? "gpio" : "sim");
		io_uses_free(&uses);
	}
	io_machine_free(&machine);
	g_free(board);
	return g_string_free(text, FALSE);
}

/* ---- lines to add ---- */

void iomap_line_clear(struct iomap_line *line)
{
	g_free(line->first);
	g_free(line->second);
	g_free(line->words);
	*line = (struct iomap_line){ .behind = -1 };
}

static void line_set(struct iomap_line *out, int behind, const char *first, const char *second,
		     char *words)
{
	*out = (struct iomap_line){ g_strdup(first), g_strdup(second), words, behind };
}

/* The first address of this kind at or behind @from that is not in the map. */
static bool iomap_next(const struct io_text *io, const struct io_check *check, struct iec_addr from,
		       struct iec_addr *out)
{
	const uint32_t most = 8 * iec_area_row(from.area)->usual;
	uint32_t bit = 8 * from.byte + from.bit;

	for (*out = from; bit + from.bits <= most; bit += from.bits) {
		out->byte = bit / 8;
		out->bit = (uint8_t)(bit % 8);
		if (!iomap_has(io, check, *out))
			return true;
	}
	return false;
}

/* The last row of a page, or of an area on it; -1: none. */
static int last_on(const struct io_text *io, enum iomap_page page, enum iec_area area)
{
	struct io_values values;
	int last = -1;

	for (int i = 0; i < io->count; i++)
		if (iomap_page_of(io, i) == page &&
		    (!area || (iomap_values(io, i, &values) && values.first.area == area)))
			last = i;
	return last;
}

/* The driver of the other pins: a map is for a board or for a desk. */
static const char *pin_driver(const struct io_text *io, const struct io_machine *machine)
{
	for (int i = 0; i < io->count; i++)
		if (iomap_page_of(io, i) == IOMAP_PINS)
			return word_is(io, i, IO_WORD_DRIVER, "gpio") ? "gpio" :
			       word_is(io, i, IO_WORD_DRIVER, "sim") ? "sim" :
			       machine->count ? "gpio" : "sim";
	return machine->count ? "gpio" : "sim";
}

void iomap_line_for(struct iomap_line *out, const struct io_text *io,
		    const struct io_machine *machine, struct iec_addr addr)
{
	const bool pin = addr.bits == 1 && (addr.area == AREA_I || addr.area == AREA_Q);
	char address[24];

	iec_addr_print(addr, address, sizeof(address));
	line_set(out, last_on(io, pin ? IOMAP_PINS : IOMAP_ANALOG, addr.area), address,
		 pin ? pin_driver(io, machine) : "sim", g_strdup(""));
}

/* The address of a new point: behind that of the selected one, else the first one that is free. */
static bool free_address(const struct io_text *io, const struct io_check *check, int row,
			 enum iec_area area, uint8_t bits, char *out, gsize size)
{
	struct io_values values = { .count = 0 };
	struct iec_addr first = { .bits = bits }, addr;

	first.area = area;
	if (row >= 0 && iomap_values(io, row, &values)) {
		first.area = values.first.area;
		first.bits = values.first.bits;
	}
	if (!iomap_next(io, check, first, &addr))
		return false;
	iec_addr_print(addr, out, size);
	return true;
}

static const char *no_room(void)
{
	return _("All addresses of this kind have a line");
}

static bool make_pin(struct iomap_line *out, const struct io_text *io, const struct io_check *check,
		     const struct io_machine *machine, int row, const char **why)
{
	char address[24];

	*why = no_room();
	if (!free_address(io, check, row, AREA_I, 1, address, sizeof(address)))
		return false;
	line_set(out, row >= 0 ? row : last_on(io, IOMAP_PINS, AREA_I), address,
		 pin_driver(io, machine), g_strdup(""));
	return true;
}

static bool is_mapped(const struct io_text *io, const struct io_device *device)
{
	bool is = false;

	for (int i = 0; i < io->count && !is; i++) {
		char *name = iomap_field(io, i, IO_DEVICE), *channel = iomap_field(io, i, IO_CHANNEL);

		is = word_is(io, i, IO_WORD_DRIVER, device->driver) && strcmp(name, device->device) == 0 &&
		     strcmp(channel, device->channel) == 0;
		g_free(name);
		g_free(channel);
	}
	return is;
}

/* The first channel of this machine that no line has; NULL: none. */
static const struct io_device *free_device(const struct io_devices *devices, const struct io_text *io,
					   bool output)
{
	for (int i = 0; i < devices->count; i++)
		if (devices->device[i].output == output && !strpbrk(devices->device[i].device, " \"") &&
		    !is_mapped(io, &devices->device[i]))
			return &devices->device[i];
	return NULL;
}

static char *words_for(const struct io_device *device)
{
	if (strcmp(device->driver, "pwm") == 0)
		return g_strdup_printf("chip=%s channel=%s period=20ms", device->device, device->channel);
	if (strcmp(device->driver, "w1") == 0)
		return g_strdup_printf("sensor=%s", device->device);
	return g_strdup_printf("device=%s channel=%s", device->device, device->channel);
}

static bool make_analog(struct iomap_line *out, const struct io_text *io,
			const struct io_check *check, const struct io_devices *devices, int row,
			const char **why)
{
	const struct io_device *device;
	struct io_values values;
	char address[24];

	*why = no_room();
	if (!free_address(io, check, row, AREA_AI, 16, address, sizeof(address)))
		return false;
	device = free_device(devices, io, io_values_read(address, strlen(address), &values) &&
			     iec_area_row(values.first.area)->access == ACCESS_WRITE);
	line_set(out, row >= 0 ? row : last_on(io, IOMAP_ANALOG, AREA_NONE), address,
		 device ? device->driver : "sim", device ? words_for(device) : g_strdup(""));
	return true;
}

/* A BUS line of peers or of Modbus; -1: none. */
static int bus_row(const struct io_text *io, bool peer)
{
	for (int i = 0; i < io->count; i++)
		if (io->row[i].kind == IO_KIND_BUS && word_is(io, i, IO_WORD_DRIVER, "peer") == peer)
			return i;
	return -1;
}

/* How many places in its table a row takes. */
static unsigned places(const struct io_text *io, int row, const char *table)
{
	struct io_values values = { .count = 1 };
	char *bit = iomap_field(io, row, IO_BIT);
	const bool bits = *bit || strcmp(table, "coil") == 0 || strcmp(table, "discrete-input") == 0;
	unsigned each;

	iomap_values(io, row, &values);
	each = bits || values.first.bits <= 16 ? 1 : values.first.bits / 16;
	g_free(bit);
	return values.count * each;
}

/* The first number of a table of that unit behind all that the map has. */
static unsigned next_number(const struct io_text *io, const char *bus, const char *unit,
			    const char *table)
{
	unsigned next = 0;

	for (int i = 0; i < io->count; i++) {
		char *is[4] = { iomap_field(io, i, IO_BUS), iomap_field(io, i, IO_UNIT),
				iomap_field(io, i, IO_TABLE), iomap_field(io, i, IO_NUMBER) };
		unsigned end = 0;

		if (io->row[i].kind == IO_KIND_POINT && strcmp(is[0], bus) == 0 &&
		    strcmp(is[1], unit) == 0 && strcmp(is[2], table) == 0)
			end = (unsigned)g_ascii_strtoull(is[3], NULL, 10) + places(io, i, table);
		if (end > next)
			next = end;
		for (int k = 0; k < 4; k++)
			g_free(is[k]);
	}
	return MIN(next, 65535);
}

/* The module behind the selected one: the next place and the next unit. */
static bool make_module(struct iomap_line *out, const struct io_text *io,
			const struct io_check *check, int row, const char **why)
{
	char *bus = iomap_field(io, row, IO_BUS), *type = iomap_field(io, row, IO_TYPE);
	char *unit = iomap_field(io, row, IO_UNIT), address[24] = "";

	*why = _("There are 16 places for modules, and all have a line");
	for (uint32_t place = 0; place < 16 && !*address; place++) {
		struct iec_addr addr = { .bits = 8, .byte = 3 * place };

		addr.area = AREA_XI;
		if (!iomap_has(io, check, addr))
			iec_addr_print(addr, address, sizeof(address));
	}
	if (*address)
		line_set(out, row, address, "module", g_strdup_printf("bus=%s unit=%u type=%s safe=0",
			 bus, MIN((unsigned)g_ascii_strtoull(unit, NULL, 10) + 1, 247), type));
	g_free(bus);
	g_free(type);
	g_free(unit);
	return *address;
}

static bool make_modbus(struct iomap_line *out, const struct io_text *io,
			const struct io_check *check, int row, const char **why)
{
	const bool like = row >= 0 && word_is(io, row, IO_WORD_DRIVER, "modbus");
	const int bus_at = bus_row(io, false);
	char *bus, *unit, *table, address[24];
	bool good;

	if (row >= 0 && word_is(io, row, IO_WORD_DRIVER, "module"))
		return make_module(out, io, check, row, why);
	*why = _("The map has no bus for Modbus: add one on the page Buses first");
	if (!like && bus_at < 0)
		return false;
	*why = no_room();
	bus = iomap_field(io, like ? row : bus_at, like ? IO_BUS : IO_ADDRESS);
	unit = like ? iomap_field(io, row, IO_UNIT) : g_strdup("1");
	table = like ? iomap_field(io, row, IO_TABLE) : g_strdup("input-register");
	good = free_address(io, check, like ? row : -1, AREA_I, 16, address, sizeof(address));
	if (good)
		line_set(out, like ? row : last_on(io, IOMAP_MODBUS, AREA_NONE), address, "modbus",
			 g_strdup_printf("bus=%s unit=%s %s=%u", bus, unit,
					 *table ? table : "input-register",
					 next_number(io, bus, unit, table)));
	g_free(bus);
	g_free(unit);
	g_free(table);
	return good;
}

static bool make_peer(struct iomap_line *out, const struct io_text *io, const struct io_check *check,
		      int row, const char **why)
{
	char *from = row >= 0 ? iomap_field(io, row, IO_DEVICE) : g_strdup(""), address[24];
	bool good;

	*why = _("The map has no bus of kind peer: add one on the page Buses first");
	good = bus_row(io, true) >= 0;
	if (good) {
		*why = no_room();
		good = free_address(io, check, row, AREA_I, 16, address, sizeof(address));
	}
	if (good)
		line_set(out, row >= 0 ? row : last_on(io, IOMAP_PEERS, AREA_NONE), address, "peer",
			 g_strdup_printf("from=%s name=Level", *from ? from : "other"));
	g_free(from);
	return good;
}

static bool has_name(const struct io_text *io, enum io_kind kind, const char *name)
{
	for (int i = 0; i < io->count; i++) {
		char *is = iomap_field(io, i, IO_ADDRESS);
		const bool same = io->row[i].kind == kind && strcmp(is, name) == 0;

		g_free(is);
		if (same)
			return true;
	}
	return false;
}

/* "bus", "bus2", "bus3" … Caller frees. */
static char *free_name(const struct io_text *io, enum io_kind kind, const char *name)
{
	char *out = g_strdup(name);

	for (int i = 2; has_name(io, kind, out); i++) {
		g_free(out);
		out = g_strdup_printf("%s%d", name, i);
	}
	return out;
}

/* Lines that others refer to stand before them. */
static int last_of(const struct io_text *io, enum io_kind kind)
{
	int last = IO_AT_START;

	for (int i = 0; i < io->count; i++)
		if (io->row[i].kind == kind)
			last = i;
	return last;
}

static void make_named(struct iomap_line *out, const struct io_text *io, enum io_kind kind, int row,
		       const char *name, const char *words)
{
	char *free_one = free_name(io, kind, name);

	line_set(out, row, io_kind_word(kind), free_one, g_strdup(words));
	g_free(free_one);
}

static int serve_row(const struct io_text *io, int row)
{
	if (row >= 0 && io->row[row].kind == IO_KIND_SERVE)
		return row;
	for (int i = 0; i < io->count; i++)
		if (io->row[i].kind == IO_KIND_SERVE)
			return i;
	return -1;
}

/* Eight coils behind those of the windows that the server has. */
static bool make_window(struct iomap_line *out, const struct io_text *io, int row, const char **why)
{
	const int serve = serve_row(io, row);
	unsigned next = 0;
	char *name;

	*why = _("The map has no server: add one first");
	if (serve < 0)
		return false;
	name = iomap_field(io, serve, IO_ADDRESS);
	for (int i = 0; i < io->count; i++) {
		char *bus = iomap_field(io, i, IO_BUS), *table = iomap_field(io, i, IO_TABLE);
		char *number = iomap_field(io, i, IO_NUMBER), *dots = strstr(number, "..");

		if (io->row[i].kind == IO_KIND_WINDOW && strcmp(bus, name) == 0 &&
		    strcmp(table, "coil") == 0)
			next = MAX(next, (unsigned)g_ascii_strtoull(dots ? dots + 2 : number, NULL, 10) + 1);
		g_free(bus);
		g_free(table);
		g_free(number);
	}
	next = MIN(next, 65528);
	line_set(out, MAX(serve, last_of(io, IO_KIND_WINDOW)), "WINDOW", name,
		 g_strdup_printf("coil=%u..%u %%QX%u.0 read-only", next, next + 7, next / 8));
	g_free(name);
	return true;
}

static bool make_publish(struct iomap_line *out, const struct io_uses *uses, const struct io_text *io,
			 const char **why)
{
	const int bus = bus_row(io, true);
	char *board = io_text_board(io), *name;
	const char *variable = "Level";

	*why = _("The map has no bus of kind peer: add one on the page Buses first");
	for (int i = uses->count - 1; i >= 0; i--)
		if (*uses->use[i].name && !strpbrk(uses->use[i].name, ".["))
			variable = uses->use[i].name;
	name = g_strcanon(g_ascii_strdown(board && *board ? board : "board", -1),
			  "abcdefghijklmnopqrstuvwxyz0123456789-", '-');
	if (bus >= 0)
		line_set(out, MAX(bus, last_of(io, IO_KIND_PUBLISH)), "PUBLISH", name,
			 g_strdup_printf("%s every=100ms", variable));
	g_free(name);
	free(board);
	return bus >= 0;
}

/* The first unit of the first bus of Modbus that has no line of its own. */
static bool make_device(struct iomap_line *out, const struct io_text *io, const char **why)
{
	const int bus = bus_row(io, false);
	char *name = bus >= 0 ? iomap_field(io, bus, IO_ADDRESS) : NULL;
	unsigned unit = 1;

	*why = _("The map has no bus for Modbus: add one on the page Buses first");
	for (int i = 0; name && i < io->count; i++) {
		char *of = iomap_field(io, i, IO_ADDRESS), *number = iomap_field(io, i, IO_UNIT);
		const unsigned is = (unsigned)g_ascii_strtoull(number, NULL, 10);

		if (io->row[i].kind == IO_KIND_DEVICE && strcmp(of, name) == 0 && is >= unit)
			unit = is + 1;
		g_free(of);
		g_free(number);
	}
	if (name)
		line_set(out, MAX(bus, last_of(io, IO_KIND_DEVICE)), "DEVICE", name,
			 g_strdup_printf("unit=%u", MIN(unit, 247)));
	g_free(name);
	return bus >= 0;
}

/* The next line of a page whose lines are no points. */
static enum io_kind kind_for(const struct io_text *io, enum iomap_page page, int row)
{
	if (page == IOMAP_BUSES)
		return row >= 0 ? io->row[row].kind : IO_KIND_BUS;
	if (row < 0)
		return serve_row(io, -1) < 0 ? IO_KIND_SERVE : IO_KIND_WINDOW;
	return io->row[row].kind == IO_KIND_SERVE ? IO_KIND_WINDOW : io->row[row].kind;
}

static bool make_other(struct iomap_line *out, const struct io_uses *uses, const struct io_text *io,
		       enum io_kind kind, int row, const char **why)
{
	switch (kind) {
	case IO_KIND_MODULE:
		make_named(out, io, kind, last_of(io, kind), "Card", "di=8 dq=8");
		return true;
	case IO_KIND_SERVE:
		make_named(out, io, kind, last_of(io, kind), "server", "modbus-tcp  listen=127.0.0.1:1502");
		return true;
	case IO_KIND_WINDOW: return make_window(out, io, row, why);
	case IO_KIND_PUBLISH: return make_publish(out, uses, io, why);
	case IO_KIND_DEVICE: return make_device(out, io, why);
	case IO_KIND_BUS: case IO_KIND_POINT: case IO_KINDS: break;
	}
	make_named(out, io, IO_KIND_BUS, last_of(io, IO_KIND_BUS), "bus", "modbus-tcp  host=127.0.0.1:502");
	return true;
}

bool iomap_line_make(struct iomap_line *out, const struct io_uses *uses, const struct io_text *io,
		     const struct io_check *check, const struct io_machine *machine,
		     const struct io_devices *devices, enum iomap_page page, enum io_kind kind,
		     int row, const char **why)
{
	*out = (struct iomap_line){ .behind = -1 };
	switch (page) {
	case IOMAP_ANALOG: return make_analog(out, io, check, devices, row, why);
	case IOMAP_MODBUS: return make_modbus(out, io, check, row, why);
	case IOMAP_PEERS: return make_peer(out, io, check, row, why);
	case IOMAP_BUSES: case IOMAP_SERVED:
		return make_other(out, uses, io, kind == IO_KIND_POINT ? kind_for(io, page, row) : kind,
				  row, why);
	case IOMAP_PINS: case IOMAP_PAGES: break;
	}
	return make_pin(out, io, check, machine, row, why);
}
