/* SPDX-License-Identifier: MIT
 *
 * iomap_rows - what the table of an I/O map shows: rows, messages, choices.
 */
#include "editor-gtk/iomap/iomap_rows.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include <stdlib.h>
#include <string.h>

/* ---- rows ---- */

char *iomap_field(const struct io_text *io, int row, enum io_field field)
{
	char *text = io_text_field(io, row, field);
	char *out = g_strdup(text ? text : "");

	free(text);
	return out;
}

/* What is wrong with the row, else its line on this machine. */
static char *state_of(const struct io_machine *machine, const struct io_placed *placed,
		      const struct diag *diag)
{
	const struct io_found *found;

	if (diag)
		return diag_said_whole(diag);
	if (placed && !driver_row(placed->point->driver)->needs_line)
		return g_strdup(_("simulated"));
	if (!placed || placed->found < 0)
		return g_strdup("");
	found = &machine->line[placed->found];
	return g_strdup_printf("%s %u", found->chip, (unsigned)found->offset);
}

static void fill_note(LadderPanelRow *row, const struct diag *diag, bool warns)
{
	if (!diag)
		return;
	row->note = diag_said_whole(diag);
	row->tone = warns ? PANEL_WARNING : PANEL_ERROR;
}

static char *spoken(const LadderPanelRow *row)
{
	GString *text = g_string_new(panel_row_text(row, IO_ADDRESS));

	for (int i = IO_DRIVER; i < IOMAP_STATE; i++) {
		const char *part = i == IO_ACTIVE_LOW && *panel_row_text(row, i) ?
			io_field_name(IO_ACTIVE_LOW) : panel_row_text(row, i);

		if (*part)
			g_string_append_printf(text, ", %s", part);
	}
	if (*panel_row_text(row, IOMAP_STATE))
		g_string_append_printf(text, ". %s", panel_row_text(row, IOMAP_STATE));
	return g_string_free(text, FALSE);
}

static const char *symbol_of(const struct io_uses *uses, const char *address)
{
	const struct io_use *use = NULL;
	struct iec_addr addr;

	if (iec_addr_parse(address, strlen(address), &addr) == ADDR_OK)
		use = io_uses_find(uses, addr);
	return use ? use->name : "";
}

LadderPanelRow *iomap_row_new(const struct io_uses *uses, const struct io_machine *machine,
			      const struct io_text *io, const struct io_check *check,
			      int number)
{
	LadderPanelRow *row = ladder_panel_row_new();
	const int line = io->row[number].line;
	const struct io_placed *placed = check ? io_check_point(check, line) : NULL;
	bool warns = false;
	const struct diag *diag = check ? io_check_at(check, line, &warns) : NULL;

	for (int i = 0; i < IO_FIELDS; i++)
		row->text[i] = iomap_field(io, number, (enum io_field)i);
	row->text[IOMAP_SYMBOL] = g_strdup(symbol_of(uses, row->text[IO_ADDRESS]));
	row->text[IOMAP_STATE] = state_of(machine, placed, diag);
	row->index = number;
	row->number = number;
	fill_note(row, diag, warns);
	row->spoken = spoken(row);
	return row;
}

/* ---- points missing in the map ---- */

bool iomap_has(const struct io_text *io, struct iec_addr addr)
{
	for (int i = 0; i < io->count; i++) {
		const struct io_span *word = &io->row[i].word[IO_WORD_ADDRESS];
		struct iec_addr at;

		if (iec_addr_parse(io->text + word->at, word->len, &at) == ADDR_OK &&
		    at.area == addr.area && at.byte == addr.byte && at.bit == addr.bit)
			return true;
	}
	return false;
}

#define LACKS_SHOWN 4 /* missing points to name; others are counted            */

char *iomap_lacks(const struct io_uses *uses, const struct io_text *io)
{
	GString *text = g_string_new(NULL);
	char *whole;
	int count = 0;

	for (int i = 0; i < uses->count; i++) {
		const struct io_use *use = &uses->use[i];
		char address[24];

		if (iomap_has(io, use->addr) || count++ >= LACKS_SHOWN)
			continue;
		iec_addr_print(use->addr, address, sizeof(address));
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

/* Addresses of the program that are missing in the map. */
static void offer_addresses(const struct io_uses *uses, const struct io_text *io,
			    GPtrArray *choices)
{
	char address[24];

	for (int i = 0; i < uses->count; i++) {
		if (iomap_has(io, uses->use[i].addr))
			continue;
		iec_addr_print(uses->use[i].addr, address, sizeof(address));
		offer(choices, address, uses->use[i].name);
	}
}

static const char *about_word(const char *word)
{
	static const struct { const char *word, *about; } row[] = {
		{ "gpio", N_("a line of a GPIO chip") },
		{ "sim", N_("a level in memory, no pin") },
		{ "pull-up", N_("a resistor of the chip to its supply") },
		{ "pull-down", N_("a resistor of the chip to ground") },
		{ "no-pull", N_("no resistor of the chip") },
		{ "push-pull", N_("drives high and low") },
		{ "open-drain", N_("drives low only") },
		{ "open-source", N_("drives high only") },
		{ "0", N_("off while nothing runs") }, { "1", N_("on while nothing runs") },
		{ "hold", N_("keeps its last value while nothing runs") },
	};

	for (gsize i = 0; i < G_N_ELEMENTS(row); i++)
		if (strcmp(row[i].word, word) == 0)
			return _(row[i].about);
	return "";
}

GPtrArray *iomap_choices(const struct io_uses *uses, const struct io_machine *machine,
			 const struct io_text *io, enum io_field field)
{
	GPtrArray *choices = g_ptr_array_new_with_free_func(g_free);
	const char *const *word = io_text_choices(field);

	if (field == IO_ADDRESS)
		offer_addresses(uses, io, choices);
	else if (field == IO_LINE)
		offer_lines(machine, choices);
	else if (field == IO_DRIVER)
		for (int i = 0; i < DRIVER_COUNT; i++)
			offer(choices, driver_row((enum driver_id)i)->word,
			      about_word(driver_row((enum driver_id)i)->word));
	if (word)
		offer(choices, "", "");
	for (; word && *word; word++)
		offer(choices, *word, about_word(*word));
	return choices;
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

	iec_addr_print(use->addr, address, sizeof(address));
	apply_new(text, io_text_add(&io, -1, address, driver, use->name, &edit), &edit);
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
