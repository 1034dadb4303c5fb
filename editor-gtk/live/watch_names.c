/* SPDX-License-Identifier: MIT
 *
 * watch_names - names for a status chart: see watch_names.h.
 *
 * Candidates of the quick entry come first, then all names of the program, so that locals of
 * every POU are offered.
 */
#include "editor-gtk/live/watch_names.h"

#include "editor-gtk/edit/entry.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/name_fold.h"

#include "engine/base/name.h"
#include "engine/scan/code.h"
#include "engine/trial/trace.h"
#include "engine/trial/value.h"

#include <string.h>

#define OFFERED 40

/* ---- which variables a line means ---- */

static bool is_pin_of(const char *name, const char *instance, gsize len)
{
	return name[name_head(instance, len, name, strlen(name))] == '.';
}

/* "Delay": Delay.IN, Delay.PT, … */
static bool add_pins(GPtrArray *names, const struct image *image, const char *name)
{
	struct symbol_cursor cursor = { 0 };
	const guint before = names->len;
	struct symbol symbol;

	while (names->len < WATCH_NAMES_MOST && image_next_symbol(image, &cursor, &symbol))
		if (!(symbol.flags & SYMBOL_HIDDEN) &&
		    is_pin_of(symbol.name, name, strlen(name)))
			g_ptr_array_add(names, g_strdup(symbol.name));
	return names->len > before;
}

/* "Main.Delay", where the symbols have the names of pins without the program's: Delay.IN. */
static bool add_local_pins(GPtrArray *names, const struct image *image, const char *name)
{
	const char *point = strchr(name, '.'), *instance = point ? point + 1 : "";
	struct symbol_cursor cursor = { 0 };
	const guint before = names->len;
	struct symbol symbol;
	enum diag_id why;

	while (*instance && names->len < WATCH_NAMES_MOST &&
	       image_next_symbol(image, &cursor, &symbol)) {
		const gsize len = name_head(instance, strlen(instance), symbol.name,
					    strlen(symbol.name));
		char *whole;

		if (symbol.flags & SYMBOL_HIDDEN || len == 0 || symbol.name[len] != '.')
			continue;
		whole = g_strconcat(name, symbol.name + len, NULL);
		if (value_find(image, whole, strlen(whole), &why).type != IEC_NONE)
			g_ptr_array_add(names, g_steal_pointer(&whole));
		g_free(whole);
	}
	return names->len > before;
}

/* A range as in scripts; it needs an image after a cold start. */
static bool add_range(GPtrArray *names, const struct image *program, const char *word)
{
	struct diag_list *diags = g_new0(struct diag_list, 1);
	struct image *image = g_new0(struct image, 1);
	gpointer memory = g_malloc0(image_memory_size(program->program));
	struct trace trace;
	bool good;

	diag_init(diags);
	image_init(image, program->program, memory);
	trace_init(&trace, image, NULL, TRACE_LINES, false);
	good = trace_show(&trace, word, strlen(word), diags, (struct diag){ 0 });
	for (int i = 0; good && i < trace.count && names->len < WATCH_NAMES_MOST; i++)
		g_ptr_array_add(names, g_strdup(trace.column[i].name));
	trace_free(&trace);
	g_free(memory);
	g_free(image);
	g_free(diags);
	return good;
}

static void add_word(GPtrArray *names, const struct image *image, const char *word)
{
	enum diag_id why;

	if (image && value_find(image, word, strlen(word), &why).type == IEC_NONE &&
	    ((strstr(word, "..") && add_range(names, image, word)) ||
	     add_pins(names, image, word) || add_local_pins(names, image, word)))
		return;
	g_ptr_array_add(names, g_strdup(word));
}

GPtrArray *watch_names_expand(const struct image *image, const char *line)
{
	GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
	char **words = g_strsplit_set(line, " \t\r\n,;", -1);

	for (char **word = words; *word && names->len < WATCH_NAMES_MOST; word++)
		if (**word)
			add_word(names, image, *word);
	g_strfreev(words);
	return names;
}

/* ---- what a chart lists already ---- */

struct listed {
	struct location at;
	const char *name;     /* borrowed                                      */
	int line;             /* -1: none yet                                  */
};

/* What the lines of a format mean. Caller: g_array_unref(). */
static GArray *listed_of(const struct image *image, GPtrArray *lines, enum live_format format)
{
	GArray *listed = g_array_new(FALSE, FALSE, sizeof(struct listed));

	for (guint i = 0; i < lines->len; i++) {
		const struct watch_line *line = lines->pdata[i];
		const struct listed one = { live_value_find(image, line->name), line->name, (int)i };

		if (line->format == format)
			g_array_append_val(listed, one);
	}
	return listed;
}

static const struct listed *find_listed(const struct image *image, const GArray *listed,
					const char *name)
{
	const struct location at = live_value_find(image, name);

	for (guint i = 0; i < listed->len; i++) {
		const struct listed *one = &g_array_index(listed, struct listed, i);

		if (name_equal(one->name, name) ||
		    (at.type != IEC_NONE && live_value_is_same(at, one->at)))
			return one;
	}
	return NULL;
}

int watch_names_drop_listed(const struct image *image, GPtrArray *names, GPtrArray *lines,
			    enum live_format format)
{
	GArray *listed = listed_of(image, lines, format);
	int last = -1;

	for (guint i = 0; i < names->len;) {
		const struct listed *one = find_listed(image, listed, names->pdata[i]);

		if (one) {
			last = MAX(last, one->line);
			g_ptr_array_remove_index(names, i);
		} else {
			const char *name = names->pdata[i++];
			const struct listed own = { live_value_find(image, name), name, -1 };

			g_array_append_val(listed, own);
		}
	}
	g_array_unref(listed);
	return last;
}

/* Returns how many lines stand there now. */
static guint unfold_line(const struct image *image, GPtrArray *lines, guint at)
{
	struct watch_line *line = lines->pdata[at];
	GPtrArray *names = watch_names_expand(image, line->name);
	guint count = 1;

	if (names->len > 1 || (names->len == 1 && strcmp(names->pdata[0], line->name) != 0)) {
		g_ptr_array_steal_index(lines, at);
		watch_names_drop_listed(image, names, lines, line->format);
		count = names->len;
		for (guint i = 0; i < count; i++)
			g_ptr_array_insert(lines, (int)(at + i), watch_line_new(line->format,
				names->pdata[i], i == 0 ? line->comment : NULL));
		watch_line_free(line);
	}
	g_ptr_array_unref(names);
	return count;
}

void watch_names_unfold(const struct image *image, GPtrArray *charts)
{
	for (guint i = 0; image && i < charts->len; i++) {
		GPtrArray *lines = ((struct watch *)charts->pdata[i])->lines;

		for (guint at = 0; at < lines->len;)
			at += unfold_line(image, lines, at);
	}
}

/* ---- completion ---- */

struct offer {
	LadderEntryPopup *popup;
	const char *line;
	gsize from, cursor;   /* of the word before the cursor                 */
	GHashTable *seen;     /* names offered so far, in lower case           */
};

static void put(struct offer *offer, const char *text, const char *address,
		const char *note, const char *kind)
{
	char *line = g_strdup_printf("%.*s%s%s", (int)offer->from, offer->line, text,
				     offer->line + offer->cursor);
	struct entry_popup_row row = {
		(char *)text, (char *)address, (char *)note, (char *)kind, line, false,
	};

	if (g_hash_table_size(offer->seen) < OFFERED &&
	    g_hash_table_add(offer->seen, name_fold(text)))
		ladder_entry_popup_add(offer->popup, &row);
	g_free(line);
}

/* Candidates for an operand of any type: that of an expression. */
static void offer_entries(struct offer *offer, struct project *project)
{
	const struct entry_place place = { .project = project };
	struct entry_candidate *found = g_new(struct entry_candidate, OFFERED);
	char *line = g_strdup_printf("[%.*s", (int)(offer->cursor - offer->from),
				     offer->line + offer->from);
	const int count = entry_candidates(&place, line, strlen(line), found, OFFERED);

	for (int i = 0; i < count; i++)
		if (found[i].kind == ENTRY_VARIABLE || found[i].kind == ENTRY_INSTANCE ||
		    found[i].kind == ENTRY_PIN || found[i].kind == ENTRY_ADDRESS)
			put(offer, found[i].text, found[i].address, found[i].note,
			    _(entry_kind_text(found[i].kind)));
	g_free(line);
	g_free(found);
}

static void offer_symbols(struct offer *offer, const struct image *image, bool inside)
{
	char *typed = g_strndup(offer->line + offer->from, offer->cursor - offer->from);
	char *folded = name_fold(typed);
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;

	while (g_hash_table_size(offer->seen) < OFFERED &&
	       image_next_symbol(image, &cursor, &symbol)) {
		char *name = name_fold(symbol.name);

		if (!(symbol.flags & SYMBOL_HIDDEN) && (inside ? strstr(name, folded) != NULL :
							g_str_has_prefix(name, folded)))
			put(offer, symbol.name, "", iec_type_row(symbol.at.type)->word,
			    _(entry_kind_text(ENTRY_VARIABLE)));
		g_free(name);
	}
	g_free(typed);
	g_free(folded);
}

void watch_names_offer(LadderDocument *document, const struct image *image,
		       const char *line, gsize cursor, LadderEntryPopup *popup)
{
	struct project *project = ladder_document_project(document);
	struct offer offer = { .popup = popup, .line = line, .cursor = cursor };

	offer.from = cursor;
	while (offer.from > 0 && !strchr(" \t,;", line[offer.from - 1]))
		offer.from--;
	offer.seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	if (project && project->pou_count > 0)
		offer_entries(&offer, project);
	if (image) {
		offer_symbols(&offer, image, false);
		offer_symbols(&offer, image, true);
	}
	g_hash_table_unref(offer.seen);
}
