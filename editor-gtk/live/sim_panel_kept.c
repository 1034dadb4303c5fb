/* SPDX-License-Identifier: MIT
 *
 * sim_panel_kept - choices as lines of the VIEW part, and back.
 *
 * A line of ours that says what nobody knows is left out when it is written again; lines of
 * others stay as they are.
 */
#include "editor-gtk/live/sim_panel_kept.h"

#include <gdk/gdk.h>
#include <string.h>

#define OWN "panel"
#define PLANT "panel-plant"

struct choices {
	bool plant, push, toggles, ranged;
	char *name, *key;
	double low, high;
};

static void choices_clear(struct choices *choices)
{
	g_free(choices->name);
	g_free(choices->key);
	memset(choices, 0, sizeof(*choices));
}

/* ---- reading ---- */

/* The next word of a line; NULL: there is none. Caller frees. */
static char *next_word(const char **at)
{
	const char *from = *at + strspn(*at, " \t\r");
	const gsize len = strcspn(from, " \t\r");

	*at = from + len;
	return len ? g_strndup(from, len) : NULL;
}

static bool take_number(const char **at, double *out)
{
	char *word = next_word(at), *end = NULL;

	if (word)
		*out = g_ascii_strtod(word, &end);
	const bool good = word && *end == '\0' && end != word && *out > -1e300 && *out < 1e300;

	g_free(word);
	return good;
}

static void take_key(const char **at, bool toggles, struct choices *out)
{
	char *key = next_word(at);

	if (!key || gdk_keyval_from_name(key) == GDK_KEY_VoidSymbol) {
		g_free(key);
		return;
	}
	g_free(out->key);
	out->key = key;
	out->toggles = toggles;
}

static void take_choice(const char **at, const char *word, struct choices *out)
{
	double low = 0, high = 0;

	if (strcmp(word, "push") == 0)
		out->push = true;
	else if (strcmp(word, "hold") == 0 || strcmp(word, "toggle") == 0)
		take_key(at, word[0] == 't', out);
	else if (strcmp(word, "range") == 0 && take_number(at, &low) &&
		 take_number(at, &high) && low < high) {
		out->ranged = true;
		out->low = low;
		out->high = high;
	}
}

/* False: it is a line of somebody else. @out: choices_clear(). */
static bool line_read(const char *line, struct choices *out)
{
	const char *at = line;
	char *word = next_word(&at);

	memset(out, 0, sizeof(*out));
	out->plant = g_strcmp0(word, PLANT) == 0;
	if (out->plant || g_strcmp0(word, OWN) == 0)
		out->name = next_word(&at);
	g_free(word);
	while (out->name && (word = next_word(&at)) != NULL) {
		take_choice(&at, word, out);
		g_free(word);
	}
	return out->name != NULL;
}

static bool is_of(const struct choices *choices, const LadderSimRow *row)
{
	return choices->plant == row->plant &&
	       g_ascii_strcasecmp(choices->name, row->name) == 0;
}

/* @choices NULL: none. True: it was other. */
static bool choose(LadderSimRow *row, const struct choices *choices)
{
	static const struct choices none;
	const struct choices *to = choices ? choices : &none;
	const bool push = to->push && row->kind == SIM_SWITCH;
	const bool ranged = to->ranged && row->kind != SIM_PRESET;
	const bool same = row->push == push && g_strcmp0(row->key, to->key) == 0 &&
			  row->key_toggles == to->toggles && row->ranged == ranged &&
			  (!ranged || (row->low == to->low && row->high == to->high));

	if (same)
		return false;
	row->push = push;
	g_free(row->key);
	row->key = g_strdup(to->key);
	row->key_toggles = to->toggles;
	sim_row_set_range(row, ranged, to->low, to->high);
	return true;
}

bool sim_kept_read(const char *view, GPtrArray *rows)
{
	char **lines = g_strsplit(view, "\n", -1);
	GHashTable *said = g_hash_table_new(NULL, NULL);
	struct choices choices;
	bool other = false;

	for (char **line = lines; *line; line++) {
		const bool ours = line_read(*line, &choices);

		for (guint i = 0; ours && i < rows->len; i++)
			if (is_of(&choices, rows->pdata[i])) {
				other = choose(rows->pdata[i], &choices) || other;
				g_hash_table_add(said, rows->pdata[i]);
			}
		choices_clear(&choices);
	}
	for (guint i = 0; i < rows->len; i++)
		if (!g_hash_table_contains(said, rows->pdata[i]))
			other = choose(rows->pdata[i], NULL) || other;
	g_hash_table_unref(said);
	g_strfreev(lines);
	return other;
}

/* ---- writing ---- */

static void put_number(GString *out, double number)
{
	char text[G_ASCII_DTOSTR_BUF_SIZE];

	g_string_append_printf(out, " %s", g_ascii_formatd(text, sizeof(text), "%.15g",
							   number));
}

static void put_line(GString *out, const LadderSimRow *row)
{
	if (!row->push && !row->key && !row->ranged)
		return;
	g_string_append_printf(out, "  %s %s", row->plant ? PLANT : OWN, row->name);
	if (row->push)
		g_string_append(out, " push");
	if (row->key)
		g_string_append_printf(out, " %s %s", row->key_toggles ? "toggle" : "hold",
				       row->key);
	if (row->ranged) {
		g_string_append(out, " range");
		put_number(out, row->low);
		put_number(out, row->high);
	}
	g_string_append_c(out, '\n');
}

static bool is_end(const char *line)
{
	return g_ascii_strncasecmp(line + strspn(line, " \t"), "END_VIEW", 8) == 0;
}

char *sim_kept_write(const char *view, const LadderSimRow *row)
{
	char **lines = g_strsplit(*view ? view : "VIEW\nEND_VIEW", "\n", -1);
	GString *out = g_string_new(NULL);
	bool written = false;

	for (char **line = lines; *line; line++) {
		struct choices choices;
		const bool ours = line_read(*line, &choices) && is_of(&choices, row);

		if (!written && (ours || is_end(*line))) {
			put_line(out, row);
			written = true;
		}
		if (!ours)
			g_string_append_printf(out, "%s\n", *line);
		choices_clear(&choices);
	}
	g_string_truncate(out, out->len - 1);
	g_strfreev(lines);
	return g_string_free(out, FALSE);
}
