/* SPDX-License-Identifier: MIT
 *
 * address_rows - rows of bytes; see address_rows.h.
 *
 * Between two places where a thing begins or ends, all bytes have the same things.
 */
#include "editor-gtk/document/address_rows.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/spelling.h"

#include <string.h>

#define RUN_MOST 8 /* bytes with the same things that have a row each; a longer run has one */

/* ---- making rows ---- */

static gint by_number(gconstpointer a, gconstpointer b)
{
	const guint32 x = *(const guint32 *)a, y = *(const guint32 *)b;

	return x < y ? -1 : x > y;
}

/* The bytes where something begins or ends, of things @from to @to of one area, with both ends
 * of the area; sorted. */
static GArray *places_of(const struct address_rows *rows, int from, int to, uint32_t bytes)
{
	GArray *place = g_array_new(FALSE, FALSE, sizeof(guint32));
	guint32 at = 0;

	g_array_append_val(place, at);
	at = bytes;
	g_array_append_val(place, at);
	for (int i = from; i < to; i++) {
		at = rows->thing[i].first / 8;
		g_array_append_val(place, at);
		at = (rows->thing[i].end + 7) / 8;
		g_array_append_val(place, at);
	}
	g_array_sort(place, by_number);
	return place;
}

static void add_run(struct address_rows *rows, enum iec_area area, uint32_t byte, uint32_t end,
		    int first)
{
	const int count = (int)rows->member->len - first;
	const bool single = count > 0 && end - byte <= RUN_MOST;

	do {
		const uint32_t to = single ? byte + 1 : end;
		const struct address_row row = { area, byte, to, first, count };

		g_array_append_val(rows->row, row);
		byte = to;
	} while (byte < end);
}

/* Drops the things that end before a byte. */
static void drop_ended(const struct address_rows *rows, GArray *open, uint32_t byte)
{
	guint kept = 0;

	for (guint i = 0; i < open->len; i++) {
		const int number = g_array_index(open, int, i);

		if ((rows->thing[number].end + 7) / 8 > byte)
			g_array_index(open, int, kept++) = number;
	}
	g_array_set_size(open, kept);
}

/* Rows of the area of things @from to @to, which are in the order of their first bits. */
static void add_area(struct address_rows *rows, int from, int to, uint32_t bytes)
{
	const enum iec_area area = rows->thing[from].area;
	GArray *place = places_of(rows, from, to, bytes);
	GArray *open = g_array_new(FALSE, FALSE, sizeof(int));

	for (guint i = 0; i + 1 < place->len; i++) {
		const uint32_t byte = g_array_index(place, guint32, i);
		const uint32_t end = g_array_index(place, guint32, i + 1);
		const int first = (int)rows->member->len;

		if (byte == end)
			continue;
		drop_ended(rows, open, byte);
		for (; from < to && rows->thing[from].first / 8 <= byte; from++)
			g_array_append_val(open, from);
		g_array_append_vals(rows->member, open->data, open->len);
		add_run(rows, area, byte, end, first);
	}
	g_array_unref(open);
	g_array_unref(place);
}

struct address_rows *address_rows_new(LadderDocument *document)
{
	struct project *project = ladder_document_project(document);
	struct address_rows *rows = g_new0(struct address_rows, 1);
	struct areas areas;
	int to;

	rows->member = g_array_new(FALSE, FALSE, sizeof(int));
	rows->row = g_array_new(FALSE, FALSE, sizeof(struct address_row));
	rows->open = g_array_new(FALSE, FALSE, sizeof(int));
	if (!project)
		return rows;
	if (!xref_make(&rows->xref, project))
		g_error("out of memory");
	rows->things = address_map_things(&rows->xref, &rows->thing);
	for (int i = 0; i < rows->things; i++)
		if (rows->thing[i].open)
			g_array_append_val(rows->open, i);
	project_areas(project, &areas);
	for (int from = 0; from < rows->things; from = to) {
		for (to = from; to < rows->things &&
		     rows->thing[to].area == rows->thing[from].area; to++)
			continue;
		add_area(rows, from, to, areas.bytes[rows->thing[from].area]);
	}
	return rows;
}

void address_rows_free(struct address_rows *rows)
{
	if (!rows)
		return;
	if (rows->xref.project)
		xref_free(&rows->xref);
	g_array_unref(rows->member);
	g_array_unref(rows->row);
	g_array_unref(rows->open);
	g_free(rows);
}

const struct address_row *address_rows_at(const struct address_rows *rows, int row)
{
	return &g_array_index(rows->row, struct address_row, row);
}

/* ---- cells ---- */

static const struct address_thing *thing_of(const struct address_rows *rows,
					    const struct address_row *row, int number)
{
	return &rows->thing[g_array_index(rows->member, int, row->first + number)];
}

static const struct xref_target *target_of(const struct address_rows *rows,
					   const struct address_thing *thing)
{
	return &rows->xref.use[thing->use].target;
}

/* The bits of one access: 1, 8, 16 … */
static unsigned int width_of(const struct address_rows *rows, const struct address_thing *thing)
{
	return target_of(rows, thing)->addr.bits;
}

static unsigned int column_width(int column)
{
	return column < ADDRESS_BYTE ? 1u : 8u << (column - ADDRESS_BYTE);
}

/* A bit has everything that lies on it; a wider column only what has its width. */
static bool is_in(const struct address_rows *rows, const struct address_row *row, int column,
		  const struct address_thing *thing)
{
	if (column >= ADDRESS_BYTE)
		return width_of(rows, thing) == column_width(column);
	/* a run of bytes has the same things, but an array of bits may end within its last */
	return thing->first < row->end * 8 - 7 + (unsigned int)column &&
	       thing->end > row->byte * 8 + (unsigned int)column;
}

/* Do two things of the row share a bit? */
static bool is_shared(const struct address_rows *rows, const struct address_row *row,
		      const struct address_thing *thing)
{
	for (int i = 0; i < row->count; i++) {
		const struct address_thing *other = thing_of(rows, row, i);

		if (other != thing && other->first < thing->end && thing->first < other->end)
			return true;
	}
	return false;
}

/* The thing whose index may lead to a cell, the last one before it; NULL: none. */
static const struct address_thing *reaching(const struct address_rows *rows,
					    const struct address_row *row, int column)
{
	const struct address_thing *found = NULL;

	for (guint i = 0; i < rows->open->len; i++) {
		const struct address_thing *thing =
			&rows->thing[g_array_index(rows->open, int, i)];
		const uint32_t end = column < ADDRESS_BYTE ?
			row->byte * 8 + (uint32_t)column + 1 : row->end * 8;

		if (thing->area == row->area && thing->first < end &&
		    (column < ADDRESS_BYTE || width_of(rows, thing) == column_width(column)))
			found = thing;
	}
	return found;
}

enum address_state address_state_of(const struct address_rows *rows, int number, int column)
{
	const struct address_row *row = address_rows_at(rows, number);
	enum address_state state = ADDRESS_FREE;
	int things = 0, coils = 0, writes = 0, uses = 0;
	bool shared = false;

	for (int i = 0; i < row->count; i++) {
		const struct address_thing *thing = thing_of(rows, row, i);

		if (!is_in(rows, row, column, thing))
			continue;
		things++;
		coils += thing->coils;
		writes += thing->writes;
		uses += thing->uses;
		shared |= column >= ADDRESS_BYTE && is_shared(rows, row, thing);
	}
	if (!things && reaching(rows, row, column))
		state = ADDRESS_REACHED;
	if (things)
		state = uses ? ADDRESS_USED : ADDRESS_UNUSED;
	if (things > 1 || shared)
		state = ADDRESS_SEVERAL;
	if (coils > 1 || (coils && writes))
		state = ADDRESS_TWICE;
	return state;
}

bool address_is_own(const struct address_rows *rows, int number, int column)
{
	const struct address_row *row = address_rows_at(rows, number);

	for (int i = 0; i < row->count; i++) {
		const struct address_thing *thing = thing_of(rows, row, i);

		if (is_in(rows, row, column, thing) &&
		    width_of(rows, thing) == column_width(column))
			return true;
	}
	return false;
}

bool address_is_reached(const struct address_rows *rows, int number)
{
	const struct address_row *row = address_rows_at(rows, number);

	for (int column = 0; column < ADDRESS_COLUMNS; column++)
		if (reaching(rows, row, column))
			return true;
	return false;
}

/* May the index of something else lead to a cell? */
static bool is_reached_too(const struct address_rows *rows, const struct address_row *row,
			   int column)
{
	const struct address_thing *thing = reaching(rows, row, column);

	return thing && !(thing->first / 8 < row->end && thing->end > row->byte * 8);
}

/* ---- texts ---- */

static void append_address(GString *out, enum iec_area area, unsigned int bits, uint32_t byte,
			   unsigned int bit)
{
	const struct iec_addr addr = { area, (uint8_t)bits, (uint8_t)bit, byte };
	char text[32];

	spelling_address(spelling_screen(), addr, text, sizeof(text));
	g_string_append(out, text);
}

static void append_thing(GString *out, const struct address_rows *rows,
			 const struct address_thing *thing)
{
	const struct xref_target *target = target_of(rows, thing);
	const int writes = thing->coils + thing->writes;
	char name[2 * LIMIT_NAME + 8];

	append_address(out, thing->area, target->addr.bits, target->addr.byte, target->addr.bit);
	xref_name(rows->xref.project, target, &rows->xref.use[thing->use], name, sizeof(name));
	if (target->what == XREF_VARIABLE)
		g_string_append_printf(out, _(": %s, "), name);
	else
		g_string_append(out, _(": "));
	g_string_append_printf(out, ngettext("%d use", "%d uses", (gulong)thing->uses),
			       thing->uses);
	if (writes > 1) {
		g_string_append(out, ", ");
		g_string_append_printf(out, ngettext("written in %d place",
			"written in %d places", (gulong)writes), writes);
	}
}

char *address_cell_text(const struct address_rows *rows, int number, int column)
{
	const struct address_row *row = address_rows_at(rows, number);
	GString *out = g_string_new(NULL);

	for (int i = 0; i < row->count; i++)
		if (is_in(rows, row, column, thing_of(rows, row, i))) {
			g_string_append(out, out->len ? "\n" : "");
			append_thing(out, rows, thing_of(rows, row, i));
		}
	if (out->len && is_reached_too(rows, row, column))
		g_string_append_printf(out, "\n%s", _("an index may reach it"));
	if (!out->len) {
		append_address(out, row->area, column_width(column), row->byte,
			       column < ADDRESS_BYTE ? (unsigned int)column : 0);
		g_string_append_printf(out, ": %s", reaching(rows, row, column) ?
			_("an index may reach it") : column < ADDRESS_BYTE ? _("free") :
			_("not used in this width"));
	}
	return g_string_free(out, FALSE);
}

char *address_row_text(const struct address_rows *rows, int number)
{
	const struct address_row *row = address_rows_at(rows, number);
	GString *out = g_string_new(NULL);

	append_address(out, row->area, 8, row->byte, 0);
	if (row->end - row->byte > 1) {
		g_string_append(out, " – ");
		append_address(out, row->area, 8, row->end - 1, 0);
	}
	return g_string_free(out, FALSE);
}

char *address_row_names(const struct address_rows *rows, int number)
{
	const struct address_row *row = address_rows_at(rows, number);
	const uint32_t bytes = row->end - row->byte;
	GString *out = g_string_new(NULL);

	if (!row->count && reaching(rows, row, 0))
		g_string_append_printf(out, ngettext("%u byte that an index may reach",
			"%u bytes that an index may reach", (gulong)bytes), (guint)bytes);
	else if (!row->count)
		g_string_append_printf(out, ngettext("%u byte free", "%u bytes free",
						     (gulong)bytes), (guint)bytes);
	for (int i = 0; i < row->count; i++) {
		const struct address_thing *thing = thing_of(rows, row, i);
		const struct xref_target *target = target_of(rows, thing);
		char name[2 * LIMIT_NAME + 8];

		xref_name(rows->xref.project, target, &rows->xref.use[thing->use], name,
			  sizeof(name));
		g_string_append_printf(out, "%s%s", i ? ", " : "", name);
		if (target->what != XREF_VARIABLE)
			continue;
		g_string_append(out, " (");
		append_address(out, thing->area, target->addr.bits, target->addr.byte,
			       target->addr.bit);
		g_string_append(out, ")");
	}
	return g_string_free(out, FALSE);
}

/* ---- going there ---- */

bool address_cell_goal(const struct address_rows *rows, int number, int column, int *table,
		       int *index, char **name)
{
	const struct address_row *row = address_rows_at(rows, number);
	const struct xref_target *target = NULL;
	int things = 0;
	GString *text;

	for (int i = 0; i < row->count; i++)
		if (is_in(rows, row, column, thing_of(rows, row, i)) && things++ == 0)
			target = target_of(rows, thing_of(rows, row, i));
	if (!target && reaching(rows, row, column)) {
		target = target_of(rows, reaching(rows, row, column));
		things = 1;
	}
	*name = NULL;
	if (!target)
		return false;
	if (things == 1 && target->what == XREF_VARIABLE) {
		*table = target->table;
		*index = target->index;
		return true;
	}
	text = g_string_new(NULL);
	if (things == 1)
		append_address(text, target->addr.area, target->addr.bits, target->addr.byte,
			       target->addr.bit);
	else
		append_address(text, row->area, column_width(column), row->byte,
			       column < ADDRESS_BYTE ? (unsigned int)column : 0);
	*name = g_string_free(text, FALSE);
	return true;
}
