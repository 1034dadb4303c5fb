/* SPDX-License-Identifier: MIT
 *
 * trace - the columns of a trace and its forms: lines, CSV, VCD. It compares with the
 * values shown last, not with the previous scan, so that a hidden scan loses no change.
 */
#include "engine/trial/trace.h"

#include "engine/model/named.h"
#include "engine/scan/value.h"
#include "engine/trial/value.h"

#include <stdio.h>
#include <string.h>

#define RANGE_MAX 65536 /* columns of one range */
#define VALUE_TEXT (IEC_VALUE_TEXT + 16) /* a value and its mark, as "!stale" */

void trace_init(struct trace *trace, const struct image *image,
		const struct sink *out, enum trace_form form, bool changes)
{
	memset(trace, 0, sizeof(*trace));
	arena_init(&trace->arena);
	trace->image = image;
	trace->out = out;
	trace->form = form;
	trace->changes = changes;
	trace->stamp_ns = -1;
}

void trace_free(struct trace *trace)
{
	arena_free(&trace->arena);
	trace->column = NULL;
	trace->count = 0;
}

void trace_clear(struct trace *trace)
{
	arena_reset(&trace->arena);
	trace->column = NULL;
	trace->count = 0;
}

/* Room for the text that was shown last, as large as the variable's. */
static bool own_text(struct trace *trace, struct trace_column *column)
{
	uint16_t capacity = image_get(column->image, column->at).s->capacity;
	struct iec_string *text = arena_alloc(&trace->arena,
					      iec_type_size(IEC_STRING, capacity));

	if (!text)
		return false;
	text->capacity = capacity;
	text->length = 0;
	column->last.s = text;
	return true;
}

static union iec_value present(const struct trace_column *column)
{
	return column->gone ? column->last : image_get(column->image, column->at);
}

/* Keeps @value as the last one; true if it changed. */
static bool trace_update(struct trace_column *column, union iec_value value)
{
	bool same = value.i == column->last.i; /* of a REAL its bits */

	if (column->at.type == IEC_STRING) {
		struct iec_string *last = (struct iec_string *)column->last.s;

		if (value_order(value.s, last) == 0)
			return false;
		iec_store(last, IEC_STRING, value);
		return true;
	}
	column->last = value;
	return !same;
}

/* As trace_update(), of what is told of the value. The plant has no I/O map. */
static bool quality_update(const struct trace *trace, struct trace_column *column)
{
	const char *before = column->bad;

	column->bad = !trace->quality || column->gone || column->image != trace->image ? NULL :
		      trace->quality(trace->quality_context, column->at);
	return column->bad != before;
}

/* What declares @name, if its values have names. */
static const struct var *name_values(const struct trace *trace, const char *name, size_t len)
{
	const struct var *var;

	if (!trace->project || !trace->project->enumeration_count)
		return NULL;
	var = named_of_path(trace->project, name, len);
	return var && var->enumeration ? var : NULL;
}

static bool add_column(struct trace *trace, const struct image *image, const char *name,
		       size_t len, struct location at)
{
	char *copy = arena_copy(&trace->arena, name, len);
	struct trace_column *column;

	if (!copy)
		return false;
	column = arena_push(&trace->arena, &trace->column, &trace->count,
			    sizeof(*column));
	if (!column)
		return false;
	column->name = copy;
	column->at = at;
	column->image = image;
	column->named = name_values(trace, name, len);
	if (at.type == IEC_STRING && !own_text(trace, column))
		return false;
	if (trace->begun)
		trace_update(column, image_get(image, at));
	return true;
}

bool trace_show_all(struct trace *trace)
{
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;

	while (image_next_symbol(trace->image, &cursor, &symbol)) {
		if (symbol.flags & SYMBOL_HIDDEN)
			continue;
		if (!add_column(trace, trace->image, symbol.name, strlen(symbol.name),
				symbol.at))
			return false;
	}
	return true;
}

bool trace_again(struct trace *trace)
{
	for (int i = 0; i < trace->count; i++) {
		struct trace_column *column = &trace->column[i];
		const struct location at = image_find(column->image, column->name,
						      strlen(column->name));

		column->gone = at.type != column->at.type;
		if (column->gone)
			continue;
		column->at = at;
		if (at.type == IEC_STRING && !own_text(trace, column))
			return false;
	}
	return true;
}

static bool complain(struct diag_list *diags, struct diag place,
		     enum diag_id id, const char *text, size_t len)
{
	place.id = id;
	return diag_add(diags, place, "%.*s", (int)(len < 60 ? len : 60), text);
}

static bool show_one(struct trace *trace, const char *name, size_t len,
		     struct diag_list *diags, struct diag place)
{
	enum diag_id why;
	const char *own = name;
	size_t own_len = len;
	const struct image *image = value_side(trace->image, trace->plant, &own,
					       &own_len);
	struct location at = value_find(image, own, own_len, &why);

	if (at.type == IEC_NONE)
		return complain(diags, place, why, name, len);
	if (!add_column(trace, image, name, len, at))
		return complain(diags, place, DIAG_NO_MEMORY, "", 0);
	return true;
}

/* Length of the text before the number at its end; *number is -1 without one. */
static size_t split_number(const char *text, size_t len, long *number)
{
	size_t stem = len;

	while (stem && text[stem - 1] >= '0' && text[stem - 1] <= '9')
		stem--;
	*number = stem == len || len - stem > 6 ? -1 : 0;
	for (size_t i = stem; *number >= 0 && i < len; i++)
		*number = *number * 10 + (text[i] - '0');
	return stem;
}

/* `-3` as a number of at most six digits. */
static bool take_bound(const char *text, size_t len, long *number)
{
	bool negative = len > 1 && *text == '-';
	size_t stem = split_number(text, len, number);

	if (*number < 0 || stem != negative)
		return false;
	if (negative)
		*number = -*number;
	return true;
}

/* `Table[1..4]`, `Line[2].Recipes[1..4].Speed`: @stem gets the bytes up to and with
 * the [, @tail those from the ] on. */
static bool split_bounds(const char *text, size_t len, const char *dots,
			 size_t *stem, size_t *tail, long *first, long *last)
{
	const char *open = dots, *close;

	while (open > text && open[-1] != '[')
		open--;
	close = memchr(dots, ']', (size_t)(text + len - dots));
	if (open == text || !close)
		return false;
	*stem = (size_t)(open - text);
	*tail = (size_t)(text + len - close);
	return take_bound(open, (size_t)(dots - open), first) &&
	       take_bound(dots + 2, (size_t)(close - dots) - 2, last);
}

/* Each column: @stem, a number, @tail. */
static bool show_numbers(struct trace *trace, const char *stem, size_t len,
			 long first, long last, const char *tail, size_t tail_len,
			 struct diag_list *diags, struct diag place)
{
	char name[LIMIT_NAME + 1];

	if (last < first || last - first >= RANGE_MAX)
		return complain(diags, place, DIAG_LITERAL_RANGE, stem, len);
	for (long i = first; i <= last; i++) {
		int n = snprintf(name, sizeof(name), "%.*s%ld%.*s", (int)len,
				 stem, i, (int)tail_len, tail);

		if (n < 0 || (size_t)n >= sizeof(name))
			return complain(diags, place, DIAG_NAME_TOO_LONG, stem,
					len);
		if (!show_one(trace, name, (size_t)n, diags, place))
			return false;
	}
	return true;
}

static bool same_place(struct location a, struct location b)
{
	return a.type == b.type && a.area == b.area && a.where == b.where;
}

/* A separate frame: the cursor holds a name. False: *@why is the reason. */
__attribute__((noinline))
static bool show_declared(struct trace *trace, struct location first,
			  struct location last, enum diag_id *why)
{
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;
	bool inside = false;

	while (image_next_symbol(trace->image, &cursor, &symbol)) {
		if (symbol.flags & SYMBOL_HIDDEN)
			continue;
		inside = inside || same_place(symbol.at, first);
		*why = DIAG_NO_MEMORY;
		if (inside && !add_column(trace, trace->image, symbol.name,
					  strlen(symbol.name), symbol.at))
			return false;
		if (inside && same_place(symbol.at, last))
			return true;
	}
	*why = DIAG_LITERAL_RANGE;
	return false;
}

bool trace_show(struct trace *trace, const char *text, size_t len,
		struct diag_list *diags, struct diag place)
{
	const char *dots = NULL;
	long first, last;

	for (size_t i = 0; i + 1 < len && !dots; i++)
		if (text[i] == '.' && text[i + 1] == '.')
			dots = text + i;
	if (!dots)
		return show_one(trace, text, len, diags, place);
	size_t left = (size_t)(dots - text), right = len - left - 2;
	size_t stem = split_number(text, left, &first);
	size_t other = split_number(dots + 2, right, &last), tail;

	if (first >= 0 && last >= 0 &&
	    (!other || (other == stem && !memcmp(text, dots + 2, stem))))
		return show_numbers(trace, text, stem, first, last, "", 0, diags,
				    place);
	if (split_bounds(text, len, dots, &stem, &tail, &first, &last))
		return show_numbers(trace, text, stem, first, last,
				    text + len - tail, tail, diags, place);
	enum diag_id why;
	struct location from = value_find(trace->image, text, left, &why);

	if (from.type == IEC_NONE)
		return complain(diags, place, why, text, left);
	struct location to = value_find(trace->image, dots + 2, right, &why);

	if (to.type == IEC_NONE)
		return complain(diags, place, why, dots + 2, right);
	return show_declared(trace, from, to, &why) ||
	       complain(diags, place, why, "", 0);
}

/* Red of an enumeration, the constant of any other type. */
static void print_value(const struct trace *trace, const struct trace_column *column, char *text,
			size_t size)
{
	const char *word = column->named ? named_word(trace->project, column->named,
						      column->last.i) : NULL;

	if (word)
		snprintf(text, size, "%s", word);
	else
		iec_value_print(column->at.type, column->last, text, size);
	if (column->bad) {
		const size_t len = strlen(text);

		snprintf(text + len, size - len, "!%s", column->bad);
	}
}

static void write_value(struct trace *trace, const struct trace_column *column)
{
	char text[VALUE_TEXT];

	print_value(trace, column, text, sizeof(text));
	sink_text(trace->out, text);
}

bool trace_stopped(const struct trace *trace)
{
	return trace->stop && *trace->stop;
}

static void write_lines(struct trace *trace, uint64_t scan, int64_t now_ns)
{
	char text[40];
	union iec_value time = { .i = now_ns };
	bool any = false;

	iec_value_print(IEC_TIME, time, text, sizeof(text));
	if (!trace->changes) {
		sink_printf(trace->out, "%llu t=%s", (unsigned long long)scan,
			   text);
		any = true;
	}
	for (int i = 0; i < trace->count && !trace_stopped(trace); i++) {
		struct trace_column *column = &trace->column[i];
		union iec_value value = present(column);
		const bool other = quality_update(trace, column);

		if (!trace_update(column, value) && !other && trace->changes)
			continue;
		if (!any)
			sink_printf(trace->out, "%llu t=%s",
				   (unsigned long long)scan, text);
		any = true;
		sink_text(trace->out, " ");
		sink_text(trace->out, column->name);
		sink_text(trace->out, "=");
		write_value(trace, column);
	}
	if (any)
		sink_text(trace->out, "\n");
}

static void trace_csv_head(struct trace *trace)
{
	sink_text(trace->out, "scan,t_ms");
	for (int i = 0; i < trace->count; i++) {
		sink_text(trace->out, ",");
		sink_text(trace->out, trace->column[i].name);
	}
	sink_text(trace->out, "\r\n");
}

/* In double quotes if it contains a separator. */
static void csv_field(struct trace *trace, const char *text)
{
	bool quoted = strpbrk(text, ",\"") != NULL;

	if (quoted)
		sink_text(trace->out, "\"");
	for (; *text; text++)
		sink_write(trace->out, *text == '"' ? "\"\"" : text,
			   *text == '"' ? 2 : 1);
	if (quoted)
		sink_text(trace->out, "\"");
}

static void trace_csv(struct trace *trace, uint64_t scan, int64_t now_ns)
{
	union iec_value time = { .i = now_ns };
	char text[VALUE_TEXT];
	bool changed = false;

	if (!trace->begun)
		trace_csv_head(trace);
	for (int i = 0; i < trace->count; i++) {
		struct trace_column *column = &trace->column[i];

		changed |= quality_update(trace, column);
		changed |= trace_update(column,
					present(column));
	}
	if (trace->changes && !changed)
		return;
	iec_value_print(IEC_TIME, time, text, sizeof(text));
	sink_printf(trace->out, "%llu,%s", (unsigned long long)scan, text);
	for (int i = 0; i < trace->count && !trace_stopped(trace); i++) {
		const struct trace_column *column = &trace->column[i];

		print_value(trace, column, text, sizeof(text));
		sink_text(trace->out, ",");
		csv_field(trace, text);
	}
	sink_text(trace->out, "\r\n");
}

/* The identifier of a column: a number to base 94, in printable characters. */
static void vcd_id(int column, char out[8])
{
	int n = 0;

	do {
		out[n++] = (char)('!' + column % 94);
		column /= 94;
	} while (column && n < 7);
	out[n] = '\0';
}

static int vcd_width(enum iec_type type)
{
	return type == IEC_BOOL ? 1 : iec_type_row(type)->size * 8;
}

static bool is_real(enum iec_type type)
{
	return iec_type_row(type)->class == CLASS_REAL;
}

/* IEEE 1364 has no texts; viewers accept s and bytes, others as \\ooo. */
static void vcd_text(struct trace *trace, const struct iec_string *s)
{
	sink_text(trace->out, "s");
	for (int i = 0; i < s->length; i++) {
		unsigned char c = (unsigned char)s->text[i];

		if (c > ' ' && c < 0x7f && c != '\\')
			sink_write(trace->out, &s->text[i], 1);
		else
			sink_printf(trace->out, "\\%03o", c);
	}
}

static void vcd_value(struct trace *trace, int i)
{
	const struct trace_column *column = &trace->column[i];
	char id[8], text[80];
	int width = vcd_width(column->at.type), n = 0;
	uint64_t bits = (uint64_t)column->last.i;

	vcd_id(i, id);
	if (column->at.type == IEC_STRING) {
		vcd_text(trace, column->last.s);
		sink_printf(trace->out, " %s\n", id);
		return;
	}
	if (is_real(column->at.type)) {
		sink_printf(trace->out, "r%.*g %s\n",
			    column->at.type == IEC_REAL ? 9 : 17,
			    column->last.r, id);
		return;
	}
	if (width == 1) {
		sink_printf(trace->out, "%d%s\n", bits != 0, id);
		return;
	}
	while (width-- > 0)
		text[n++] = (char)('0' + (bits >> width & 1));
	text[n] = '\0';
	sink_printf(trace->out, "b%s %s\n", text, id);
}

static void trace_vcd_head(struct trace *trace)
{
	char id[8];

	sink_text(trace->out, "$version Rungboard $end\n$timescale 1ns $end\n"
			      "$scope module program $end\n");
	for (int i = 0; i < trace->count; i++) {
		const struct trace_column *column = &trace->column[i];
		bool real = is_real(column->at.type);
		bool text_column = column->at.type == IEC_STRING;

		vcd_id(i, id);
		sink_printf(trace->out, "$var %s %d %s ", text_column ? "string" :
			    real ? "real" : "wire", text_column ? 1 :
			    real ? 64 : vcd_width(column->at.type), id);
		sink_text(trace->out, column->name);
		sink_text(trace->out, " $end\n");
	}
	sink_text(trace->out, "$upscope $end\n$enddefinitions $end\n#0\n"
			      "$dumpvars\n");
	for (int i = 0; i < trace->count; i++)
		vcd_value(trace, i);
	sink_text(trace->out, "$end\n");
	trace->stamp_ns = 0;
}

static void vcd_stamp(struct trace *trace, int64_t now_ns)
{
	if (trace->stamp_ns != now_ns)
		sink_printf(trace->out, "#%lld\n", (long long)now_ns);
	trace->stamp_ns = now_ns;
}

/* A wave has no such mark: the value stays, and a comment says what it is. */
static void vcd_quality(struct trace *trace, int64_t now_ns)
{
	for (int i = 0; i < trace->count && !trace_stopped(trace); i++) {
		struct trace_column *column = &trace->column[i];

		if (!quality_update(trace, column))
			continue;
		vcd_stamp(trace, now_ns);
		sink_printf(trace->out, "$comment %s: %s $end\n", column->name,
			    column->bad ? column->bad : "good");
	}
}

static void trace_vcd(struct trace *trace, int64_t now_ns)
{
	if (!trace->begun)
		trace_vcd_head(trace);
	trace->last_ns = now_ns;
	vcd_quality(trace, now_ns);
	for (int i = 0; i < trace->count && !trace_stopped(trace); i++) {
		struct trace_column *column = &trace->column[i];

		if (!trace_update(column, present(column)))
			continue;
		vcd_stamp(trace, now_ns);
		vcd_value(trace, i);
	}
}

void trace_scan(struct trace *trace, uint64_t scan, int64_t now_ns)
{
	if (trace->form == TRACE_LINES)
		write_lines(trace, scan, now_ns);
	else if (trace->form == TRACE_CSV)
		trace_csv(trace, scan, now_ns);
	else
		trace_vcd(trace, now_ns);
	trace->begun = true;
}

static void trace_vcd_note(struct trace *trace, const char *text, size_t len)
{
	if (!trace->begun || memchr(text, '$', len))
		return; /* before the head it would end the comment */
	sink_text(trace->out, "$comment ");
	sink_write(trace->out, text, len);
	sink_text(trace->out, " $end\n");
}

void trace_note(struct trace *trace, const char *text, size_t len)
{
	if (trace->form == TRACE_CSV)
		return;
	if (trace->form == TRACE_VCD) {
		trace_vcd_note(trace, text, len);
		return;
	}
	sink_text(trace->out, "# ");
	sink_write(trace->out, text, len);
	sink_text(trace->out, "\n");
}

void trace_end(struct trace *trace)
{
	/* Ends with the time of the last scan; otherwise viewers do not show the time
	 * without changes. */
	if (trace->begun && trace->form == TRACE_VCD &&
	    trace->last_ns > trace->stamp_ns)
		sink_printf(trace->out, "#%lld\n", (long long)trace->last_ns);
	if (trace->begun)
		return;
	if (trace->form == TRACE_CSV)
		trace_csv_head(trace);
	else if (trace->form == TRACE_VCD)
		trace_vcd_head(trace);
	trace->begun = true;
}
