/* SPDX-License-Identifier: MIT
 *
 * csv - records of fields from text, and the table of all symbols as text. What an
 * import does is csv_plan.c's.
 */
#include "editor-gtk/document/csv.h"

#include "editor-gtk/kit/i18n.h"

#include <string.h>

struct reader {
	const char *at, *end;
	char separator;
	int line;
	GPtrArray *field;    /* of char *                                     */
	const char *why;
};

static bool fail(struct reader *reader, const char *why)
{
	reader->why = why;
	return false;
}

/* What parts the fields of the first line. */
static char find_separator(const char *text, const char *end)
{
	static const char candidates[] = ",;\t";
	int count[3] = { 0 }, best = 0;
	bool quoted = false;

	for (; text < end && (quoted || (*text != '\n' && *text != '\r')); text++) {
		const char *found = *text ? strchr(candidates, *text) : NULL;

		if (*text == '"')
			quoted = !quoted;
		else if (found && !quoted)
			count[found - candidates]++;
	}
	for (int i = 1; i < 3; i++)
		best = count[i] > count[best] ? i : best;
	return candidates[best];
}

/* Steps over one line end; false: there is none here. */
static bool skip_newline(struct reader *reader)
{
	if (reader->at == reader->end || (*reader->at != '\n' && *reader->at != '\r'))
		return false;
	if (*reader->at == '\r' && reader->at + 1 < reader->end && reader->at[1] == '\n')
		reader->at++;
	reader->at++;
	reader->line++;
	return true;
}

/* The line of the place is where the field begins. */
static bool fail_at(struct reader *reader, int line, const char *why)
{
	reader->line = line;
	return fail(reader, why);
}

/* The opening quote is behind us. */
static bool read_quoted(struct reader *reader, GString *out)
{
	const int first = reader->line;

	for (;;) {
		const char *at = reader->at;

		if (at == reader->end)
			return fail_at(reader, first, N_("a quoted field does not end"));
		if (*at == '"') {
			reader->at++;
			if (reader->at == reader->end || *reader->at != '"')
				return true;
			at++;
		}
		reader->line += *at == '\n' ||
				(*at == '\r' && (at + 1 == reader->end || at[1] != '\n'));
		g_string_append_c(out, *at);
		reader->at = at + 1;
		if (out->len > CSV_FIELD_MOST)
			return fail_at(reader, first, N_("a field is too long"));
	}
}

static bool is_end(const struct reader *reader)
{
	return reader->at == reader->end || *reader->at == reader->separator ||
	       *reader->at == '\n' || *reader->at == '\r';
}

static bool read_field(struct reader *reader)
{
	GString *out = g_string_new("");
	bool good = true;

	if (reader->at < reader->end && *reader->at == '"') {
		reader->at++;
		good = read_quoted(reader, out);
		if (good && !is_end(reader))
			good = fail(reader, N_("text behind a quoted field"));
	} else {
		while (!is_end(reader) && out->len <= CSV_FIELD_MOST)
			g_string_append_c(out, *reader->at++);
		if (out->len > CSV_FIELD_MOST)
			good = fail(reader, N_("a field is too long"));
	}
	g_ptr_array_add(reader->field, g_string_free(out, FALSE));
	if (good && reader->field->len > CSV_COLUMNS_MOST)
		good = fail(reader, N_("too many columns"));
	return good;
}

static bool read_record(struct reader *reader)
{
	g_ptr_array_set_size(reader->field, 0);
	for (;;) {
		if (!read_field(reader))
			return false;
		if (reader->at == reader->end || *reader->at != reader->separator)
			return true;
		reader->at++;
	}
}

/* Line of the first byte that is no UTF-8, or a NUL; 0: none. */
static int bad_byte(const char *text, gsize len)
{
	const char *bad;
	int line = 1;

	if (g_utf8_validate(text, (gssize)len, &bad))
		return 0;
	for (; text < bad; text++)
		line += *text == '\n';
	return line;
}

int csv_read(const char *text, gsize len,
	     bool (*take)(void *context, int line, char *const *field, int count),
	     void *context, const char **why)
{
	struct reader reader = { text, text + len, ',', 1, NULL, NULL };
	int bad = bad_byte(text, len), rows = 0;
	bool more = true;

	*why = _("this is not UTF-8 text");
	if (bad)
		return bad;
	if (len >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
		reader.at += 3;
	reader.separator = find_separator(reader.at, reader.end);
	reader.field = g_ptr_array_new_with_free_func(g_free);
	while (more && reader.at < reader.end) {
		const int line = reader.line;

		if (skip_newline(&reader))
			continue;
		more = ++rows <= CSV_ROWS_MOST ? read_record(&reader) :
		       fail(&reader, N_("too many rows"));
		more = more && take(context, line, (char *const *)reader.field->pdata,
				    (int)reader.field->len);
		skip_newline(&reader);
	}
	g_ptr_array_unref(reader.field);
	*why = reader.why ? _(reader.why) : NULL;
	return reader.why ? reader.line : 0;
}

/* ---- writing ---- */

void csv_write_field(GString *out, const char *text)
{
	if (!text[strcspn(text, ",;\t\"\r\n")] && *text != ' ') {
		g_string_append(out, text);
		return;
	}
	g_string_append_c(out, '"');
	for (; *text; text++) {
		if (*text == '"')
			g_string_append_c(out, '"');
		g_string_append_c(out, *text);
	}
	g_string_append_c(out, '"');
}

static void write_row(GString *out, const struct symbol_row *symbol)
{
	csv_write_field(out, symbol->scope);
	g_string_append_c(out, ',');
	csv_write_field(out, symbol->member ? "STRUCT" :
			vars_head((uint16_t)(symbol->flags & ~VAR_GLOBAL_WORD)));
	for (int i = 0; i < SYMBOL_FIELDS; i++) {
		g_string_append_c(out, ',');
		csv_write_field(out, symbol->text[i]);
	}
	g_string_append(out, "\r\n");
}

char *csv_export(LadderDocument *document, int *count)
{
	struct symbols *symbols = symbols_new(document);
	GString *out = g_string_new("Scope,Block,Name,Type,Address,Initial value,Retain,"
				    "Constant,Comment\r\n");

	*count = 0;
	for (int i = 0; i < symbols->count; i++)
		if (!symbols->symbol[i].included) {
			write_row(out, &symbols->symbol[i]);
			++*count;
		}
	symbols_free(symbols);
	return g_string_free(out, FALSE);
}
