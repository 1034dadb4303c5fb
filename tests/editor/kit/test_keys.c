/* SPDX-License-Identifier: MIT
 *
 * test_keys - the schemes of keys: every key is valid and has one meaning, every inserted
 * word exists. tests/editor/person/ tests what they do.
 */
#include "editor-gtk/kit/verbs.h"
#include "engine/base/catalog.h"
#include "tests/tap.h"

#include <string.h>

/* Key and modifiers as a text, for a set. */
static char *normal(const char *key)
{
	guint value = 0;
	GdkModifierType state = 0;

	return gtk_accelerator_parse(key, &value, &state) && value ?
	       g_strdup_printf("%u %u", value, (unsigned)state) : NULL;
}

static bool takes(GHashTable *taken, const char *keys, const char *what)
{
	char **each = g_strsplit(keys, "|", -1);
	bool good = true;

	for (char **key = each; *key && **key; key++) {
		char *name = normal(*key);
		const char *other = name ? g_hash_table_lookup(taken, name) : NULL;

		if (!name || other) {
			printf("# %s of %s: %s\n", *key, what, other ? other : "no key");
			good = false;
		}
		if (name)
			g_hash_table_insert(taken, name, (gpointer)what);
	}
	g_strfreev(each);
	return good;
}

/* Do its keys work where the focus is, in a ladder, a chart or a text? */
static bool works_in(enum verb verb, enum verb_where focus)
{
	const enum verb_where where = verb_row(verb)->where;

	return where == VERB_WINDOW || where == focus || (where == VERB_BOTH && focus != VERB_TEXT);
}

static void test_scheme(enum key_scheme scheme, enum verb_where focus)
{
	GHashTable *taken = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
	bool alone = true, known = true;
	const char *word, *keys;

	takes(taken, "<Control><Shift>d|<Control><Shift>i", "the inspector of GTK");
	for (int i = 0; i < VERB_COUNT; i++) {
		char *of = verb_keys_of((enum verb)i, scheme);

		if (works_in((enum verb)i, focus))
			alone = takes(taken, of, verb_row((enum verb)i)->action) && alone;
		g_free(of);
	}
	for (int i = 0; key_scheme_put(scheme, i, &word, &keys); i++) {
		if (focus == VERB_SHEET)
			alone = takes(taken, keys, word) && alone;
		known = known && word_find(word, strlen(word)) != WORD_COUNT;
	}
	CHECK_AS(alone, key_scheme_name(scheme));
	CHECK_AS(known, "each word of a key scheme exists in the catalogue");
	g_hash_table_unref(taken);
}

static void check_accel(enum verb verb, const char *want)
{
	GMenu *menu = g_menu_new();
	char *label = NULL, *accel = NULL;

	verb_append(menu, verb, NULL, NULL);
	g_menu_model_get_item_attribute(G_MENU_MODEL(menu), 0, "label", "s", &label);
	g_menu_model_get_item_attribute(G_MENU_MODEL(menu), 0, "accel", "s", &accel);
	CHECK_TEXT(label, verb_row(verb)->label);
	CHECK_TEXT(accel, want);
	g_free(label);
	g_free(accel);
	g_object_unref(menu);
}

/* In the main menu nobody reads a list of more rows without a line between them. */
static void test_sections(void)
{
	int rows = 0, most = 0;

	for (int i = 0; i < VERB_COUNT; i++) {
		const bool begins = i == 0 || verb_is_parted((enum verb)i) ||
			verb_row((enum verb)i)->group != verb_row((enum verb)(i - 1))->group;

		rows = begins ? 1 : rows + 1;
		most = MAX(most, rows);
	}
	CHECK_AS(most <= 7, "no section of the main menu has more than seven rows");
}

/* The menus Draw and Simulation fit a window of 700 px; a menu nested in one is one of its rows.
 * Other menus of more rows scroll there. */
static void test_heights(void)
{
	int rows[VERBS_GROUPS] = { 0 }, most = 0;

	for (int i = 0; i < VERB_COUNT; i++) {
		const enum verb_group group = verb_row((enum verb)i)->group;
		enum verb last = VERB_COUNT;

		if (verb_nested((enum verb)i, &last)) {
			CHECK(last > (enum verb)i && verb_row(last)->group == group);
			i = (int)last;
		}
		rows[group]++;
		most = MAX(most, rows[group]);
	}
	CHECK_AS(rows[VERBS_DRAW] <= 15, "the menu Draw has no more than 15 rows");
	CHECK_AS(rows[VERBS_RUN] <= 15, "the menu Simulation has no more than 15 rows");
	CHECK_AS(most <= 20, "no menu of the main menu has more than 20 rows");
}

/* Keys that people of these editors know; an action, or a word that is inserted. */
static const struct { enum key_scheme scheme; const char *key, *does; } known_keys[] = {
	{ SCHEME_GXWORKS, "F5", "contact" }, { SCHEME_GXWORKS, "<Shift>F5", "parallel" },
	{ SCHEME_GXWORKS, "F6", "contact_not" }, { SCHEME_GXWORKS, "<Shift>F6", "parallel_not" },
	{ SCHEME_GXWORKS, "F7", "coil" }, { SCHEME_GXWORKS, "F8", "block" },
	{ SCHEME_GXWORKS, "F9", "wire_here" }, { SCHEME_GXWORKS, "<Shift>F9", "link_here" },
	{ SCHEME_GXWORKS, "<Control>F9", "delete" }, { SCHEME_GXWORKS, "<Control>F10", "delete" },
	{ SCHEME_GXWORKS, "F4", "next_problem" }, { SCHEME_GXWORKS, "F3", "sim_mode" },
	{ SCHEME_GXWORKS, "<Control>F3", "find_next" },
	{ SCHEME_LDMICRO, "c", "contact" }, { SCHEME_LDMICRO, "l", "coil" },
	{ SCHEME_LDMICRO, "n", "negate" }, { SCHEME_LDMICRO, "s", "S" }, { SCHEME_LDMICRO, "r", "R" },
	{ SCHEME_LDMICRO, "e", "R" }, { SCHEME_LDMICRO, "o", "TON" }, { SCHEME_LDMICRO, "f", "TOF" },
	{ SCHEME_LDMICRO, "t", "TONR" }, { SCHEME_LDMICRO, "u", "CTU" }, { SCHEME_LDMICRO, "i", "CTD" },
	{ SCHEME_LDMICRO, "slash", "P" }, { SCHEME_LDMICRO, "backslash", "N" },
	{ SCHEME_LDMICRO, "m", "MOVE" }, { SCHEME_LDMICRO, "plus", "ADD" },
	{ SCHEME_LDMICRO, "minus", "SUB" }, { SCHEME_LDMICRO, "asterisk", "MUL" },
	{ SCHEME_LDMICRO, "d", "DIV" }, { SCHEME_LDMICRO, "equal", "EQ" },
	{ SCHEME_LDMICRO, "exclam", "NE" }, { SCHEME_LDMICRO, "greater", "GT" },
	{ SCHEME_LDMICRO, "period", "GE" }, { SCHEME_LDMICRO, "less", "LT" },
	{ SCHEME_LDMICRO, "comma", "LE" }, { SCHEME_LDMICRO, "semicolon", "comment" },
	{ SCHEME_LDMICRO, "<Shift>6", "rung_above" }, { SCHEME_LDMICRO, "<Shift>v", "rung_below" },
	{ SCHEME_LDMICRO, "<Alt>Up", "rung_up" }, { SCHEME_LDMICRO, "<Alt>Down", "rung_down" },
	{ SCHEME_LDMICRO, "<Control>d", "rung_duplicate" },
	{ SCHEME_LDMICRO, "<Shift>Return", "delete" }, { SCHEME_LDMICRO, "<Control>Return", "wire_here" },
	{ SCHEME_MICROWIN, "F4", "contact" }, { SCHEME_MICROWIN, "F6", "coil" },
	{ SCHEME_MICROWIN, "F9", "block" }, { SCHEME_MICROWIN, "<Control>y", "show_as" },
};

static bool has_key(const char *keys, const char *key)
{
	char **each = g_strsplit(keys, "|", -1);
	const bool has = g_strv_contains((const char *const *)each, key);

	g_strfreev(each);
	return has;
}

static void test_known_keys(void)
{
	for (size_t i = 0; i < sizeof(known_keys) / sizeof(*known_keys); i++) {
		const enum key_scheme scheme = known_keys[i].scheme;
		const char *word, *keys;
		bool found = false;

		for (int v = 0; v < VERB_COUNT; v++) {
			char *of = verb_keys_of((enum verb)v, scheme);
			const char *action = verb_row((enum verb)v)->action;

			if (works_in((enum verb)v, VERB_SHEET) && has_key(of, known_keys[i].key))
				found |= !strcmp(strchr(action, '.') ? strchr(action, '.') + 1 : action,
						 known_keys[i].does);
			g_free(of);
		}
		for (int p = 0; key_scheme_put(scheme, p, &word, &keys); p++)
			found |= has_key(keys, known_keys[i].key) && !strcmp(word, known_keys[i].does);
		CHECK_AS(found, known_keys[i].key);
	}
}

int main(void)
{
	char *label;

	test_known_keys();

	for (int i = 0; i < KEY_SCHEMES; i++) {
		test_scheme((enum key_scheme)i, VERB_CHART);
		test_scheme((enum key_scheme)i, VERB_NETWORK);
		test_scheme((enum key_scheme)i, VERB_SHEET);
		test_scheme((enum key_scheme)i, VERB_TEXT);
	}
	CHECK_TEXT(verb_keys(VERB_contact), "F5");
	check_accel(VERB_negate, "slash");
	check_accel(VERB_cut, "<Control>x");
	verbs_use_scheme(NULL, SCHEME_MICROWIN);
	check_accel(VERB_contact, "F4");
	CHECK_TEXT(verb_keys(VERB_contact), "F4");
	CHECK_TEXT(verb_keys(VERB_step_branch), "F6");
	CHECK_AS(strcmp(verb_keys(VERB_side), "") == 0, "the scheme takes the verb's key");
	CHECK_TEXT(verb_keys(VERB_redo), "<Control><Shift>z");
	label = verb_keys_label(VERB_block);
	CHECK_TEXT(label, "F9");
	g_free(label);
	verbs_use_scheme(NULL, SCHEME_RUNGBOARD);
	CHECK_TEXT(verb_keys(VERB_contact), "F5");
	test_sections();
	test_heights();
	return tap_done();
}
