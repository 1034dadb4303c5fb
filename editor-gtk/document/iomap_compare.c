/* SPDX-License-Identifier: MIT
 *
 * iomap_compare - two I/O maps line by line; see iomap_compare.h.
 */
#include "editor-gtk/document/iomap_compare.h"

#include "editor-gtk/document/iomap_text.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/base/name.h"

#include <stdlib.h>
#include <string.h>

struct comparing {
	struct io_text a, b;
	bool *met;           /* rows of a that have a partner in b              */
	void (*take)(void *context, const struct iomap_difference *what);
	void *context;
};

static char *field_of(const struct io_text *io, int row, enum io_field field)
{
	char *text = io_text_field(io, row, field);

	if (!text)
		g_error("out of memory");
	return text;
}

/* What names a line: "%IX0.0", "BUS plant". Caller frees. */
static char *name_of(const struct io_text *io, int row)
{
	char *name = field_of(io, row, IO_ADDRESS);
	const char *word = io_kind_word(io->row[row].kind);
	char *whole = g_strdup_printf("%s%s%s", word, *word ? " " : "", name);

	free(name);
	return whole;
}

/* "gpio GPIO17 pull=up", as it stands in the line. Caller frees. */
static char *words_of(const struct io_text *io, int row)
{
	const struct io_row *of = &io->row[row];
	const struct io_span *name = &of->word[of->kind == IO_KIND_WINDOW ? IO_WORD_STATEMENT :
								IO_WORD_ADDRESS];
	const gsize from = name->at + name->len;
	char *words = g_strndup(io->text + from, of->words_end > from ? of->words_end - from : 0);
	char *valid = g_utf8_make_valid(g_strstrip(words), -1);

	g_free(words);
	return valid;
}

/* The row of a with this address that has no partner yet; -1: none. */
static int partner_of(const struct comparing *of, const char *address)
{
	for (int i = 0; i < of->a.count; i++) {
		char *other = of->met[i] ? NULL : name_of(&of->a, i);
		const bool same = other && name_equal(other, address);

		g_free(other);
		if (same)
			return i;
	}
	return -1;
}

static void tell_line(struct comparing *of, const struct io_text *io, int row)
{
	const bool newer = io == &of->b;
	char *address = name_of(io, row), *words = words_of(io, row);

	of->take(of->context, &(struct iomap_difference){ address, !newer, newer, NULL,
		newer ? "" : words, newer ? words : "" });
	g_free(address);
	g_free(words);
}

static void tell_fields(struct comparing *of, int a, int b)
{
	char *address = name_of(&of->b, b);

	for (int i = IO_ADDRESS + 1; i < IO_FIELDS; i++) {
		char *from = field_of(&of->a, a, (enum io_field)i);
		char *to = field_of(&of->b, b, (enum io_field)i);

		if (strcmp(from, to) != 0)
			of->take(of->context, &(struct iomap_difference){ address, true, true,
				io_field_name((enum io_field)i), from, to });
		free(from);
		free(to);
	}
	g_free(address);
}

static void tell_board(struct comparing *of)
{
	char *a = io_text_board(&of->a), *b = io_text_board(&of->b);

	if (!a || !b)
		g_error("out of memory");
	if (strcmp(a, b) != 0)
		of->take(of->context, &(struct iomap_difference){ "BOARD", *a, *b,
			*a && *b ? _("Board") : NULL, a, b });
	free(a);
	free(b);
}

void iomap_compare(const char *a, const char *b,
		   void (*take)(void *context, const struct iomap_difference *what), void *context)
{
	struct comparing of = { .take = take, .context = context };

	if (!io_text_read(&of.a, a ? a : "", a ? strlen(a) : 0) ||
	    !io_text_read(&of.b, b ? b : "", b ? strlen(b) : 0))
		g_error("out of memory");
	of.met = g_new0(bool, of.a.count + 1);
	tell_board(&of);
	for (int i = 0; i < of.b.count; i++) {
		char *address = name_of(&of.b, i);
		const int at = partner_of(&of, address);

		g_free(address);
		if (at >= 0) {
			of.met[at] = true;
			tell_fields(&of, at, i);
		} else {
			tell_line(&of, &of.b, i);
		}
	}
	for (int i = 0; i < of.a.count; i++)
		if (!of.met[i])
			tell_line(&of, &of.a, i);
	g_free(of.met);
	io_text_free(&of.a);
	io_text_free(&of.b);
}
