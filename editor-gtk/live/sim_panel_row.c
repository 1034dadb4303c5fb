/* SPDX-License-Identifier: MIT
 *
 * sim_panel_row - a line of the panel: see sim_panel_row.h. sim_panel_rows.c makes the lines.
 */
#include "editor-gtk/live/sim_panel_row.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_value.h"
#include "engine/base/name.h"

#include <gdk/gdk.h>
#include <string.h>

G_DEFINE_FINAL_TYPE(LadderSimRow, ladder_sim_row, G_TYPE_OBJECT)

static void finalize(GObject *object)
{
	LadderSimRow *row = LADDER_SIM_ROW(object);

	g_free(row->name);
	g_free(row->address);
	g_free(row->comment);
	g_free(row->block);
	g_free(row->owner);
	g_clear_pointer(&row->parts, g_ptr_array_unref);
	g_free(row->place);
	g_free(row->pin);
	g_free(row->pin_told);
	g_free(row->key);
	G_OBJECT_CLASS(ladder_sim_row_parent_class)->finalize(object);
}

static void ladder_sim_row_class_init(LadderSimRowClass *class)
{
	G_OBJECT_CLASS(class)->finalize = finalize;
}

static void ladder_sim_row_init(LadderSimRow *row)
{
	row->name = g_strdup("");
}

LadderSimRow *sim_row_heading(const LadderSimRow *first, bool folded)
{
	LadderSimRow *row = g_object_new(LADDER_TYPE_SIM_ROW, NULL);

	row->group = first->group;
	row->place = g_strdup(first->place);
	row->kind = SIM_HEADING;
	row->folded = folded;
	return row;
}

char *sim_row_section(const LadderSimRow *row)
{
	if (row->kind != SIM_HEADING && row->parts)
		return g_strdup_printf("%s%s", row->plant ? "@" : "", row->name);
	return g_strdup_printf("%d %s", (int)row->group, row->place ? row->place : "");
}

const char *sim_group_name(enum sim_group group)
{
	static const char *const name[SIM_GROUPS] = {
		[SIM_INPUTS] = N_("Inputs"), [SIM_OUTPUTS] = N_("Outputs"),
		[SIM_MEMORY] = N_("Memory"), [SIM_TIMERS] = N_("Timers"),
		[SIM_COUNTERS] = N_("Counters"), [SIM_BLOCKS] = N_("Blocks"),
		[SIM_CHARTS] = N_("Charts"), [SIM_ANALOGUE] = N_("Analogue"),
		[SIM_VALUES] = N_("Values"), [SIM_PLANT] = N_("Plant"),
	};

	return _(name[group]);
}

bool sim_row_is_bit(const LadderSimRow *row)
{
	return row->kind == SIM_SWITCH || row->kind == SIM_LAMP;
}

bool sim_row_is(const LadderSimRow *row, const LadderSimRow *other)
{
	return row->group == other->group && row->kind == other->kind &&
	       row->plant == other->plant && row->driven == other->driven &&
	       row->at.type == other->at.type && row->at.constant == other->at.constant &&
	       strcmp(row->name, other->name) == 0 &&
	       g_strcmp0(row->address, other->address) == 0 &&
	       g_strcmp0(row->comment, other->comment) == 0 &&
	       g_strcmp0(row->block, other->block) == 0 &&
	       g_strcmp0(row->owner, other->owner) == 0 && !row->parts == !other->parts &&
	       g_strcmp0(row->place, other->place) == 0 &&
	       g_strcmp0(row->pin, other->pin) == 0 &&
	       g_strcmp0(row->pin_told, other->pin_told) == 0;
}

void sim_row_become(LadderSimRow *row, const LadderSimRow *from)
{
	row->at = from->at;
	row->named = from->named;
	row->preset = from->preset;
	row->given = from->given;
	row->done = from->done;
	row->start = from->start;
}

void sim_row_set_range(LadderSimRow *row, bool ranged, double low, double high)
{
	const struct iec_type_row *type = iec_type_row(row->at.type);
	const bool real = type->class == CLASS_REAL;

	row->ranged = ranged;
	row->low = ranged ? low : real ? 0 : (double)type->low;
	row->high = ranged ? high : real ? 100 : (double)type->high;
}

static bool has(const char *text, const char *folded)
{
	char *own = text ? g_utf8_casefold(text, -1) : NULL;
	const bool is = own && strstr(own, folded);

	g_free(own);
	return is;
}

const char *sim_row_label(const LadderSimRow *row)
{
	const char *rest = row->owner ? row->name + strlen(row->owner) : row->name;

	return row->owner && *rest == '.' ? rest + 1 : rest;
}

char *sim_row_told(const LadderSimRow *row, LadderSim *sim)
{
	GString *text = row->group == SIM_CHARTS && row->parts ? g_string_new(NULL) : NULL;

	for (guint i = 0; text && i < row->parts->len; i++) {
		const LadderSimRow *step = row->parts->pdata[i];

		if (live_value_get(sim, step->plant, step->done).i)
			g_string_append_printf(text, "%s%s", text->len ? ", " : "",
					       sim_row_label(step));
	}
	return text ? g_string_free(text, FALSE) : NULL;
}

bool sim_row_matches(const LadderSimRow *row, const char *wanted)
{
	char *folded = g_utf8_casefold(wanted, -1);
	const char *name = strchr(wanted, '.') ? row->name : sim_row_label(row);
	const bool is = has(name, folded) || has(row->address, folded) ||
			has(row->comment, folded) || has(row->block, folded) ||
			has(row->pin_told, folded);

	g_free(folded);
	return is;
}

/* ---- what a person does ---- */

bool sim_row_is_forced(const LadderSimRow *row, LadderSim *sim)
{
	return live_value_is_forced(sim, row->plant, row->at) ||
	       live_value_is_forced(sim, row->plant, row->preset);
}

void sim_row_release(const LadderSimRow *row, LadderSim *sim)
{
	live_value_release(sim, row->plant, row->at);
	live_value_release(sim, row->plant, row->preset);
}

void sim_row_set_elapsed(const LadderSimRow *row, LadderSim *sim, union iec_value value)
{
	const struct twin *twin = ladder_sim_twin(sim);
	const struct resource *resource = !twin ? NULL :
		row->plant ? &twin->plant : &twin->resource;

	if (twin && row->start.type != IEC_NONE)
		live_value_set(sim, row->plant, row->start, (union iec_value){
			.i = twin->now_ns + resource->timers_ns - value.i });
	live_value_set(sim, row->plant, row->at, value);
}

/* An input that the plant drives can only be forced: another value would not last. */
static bool is_dead(const LadderSimRow *row, LadderSim *sim)
{
	return !sim_row_is_bit(row) || row->at.constant ||
	       (row->driven && !sim_row_is_forced(row, sim));
}

void sim_row_press(const LadderSimRow *row, LadderSim *sim)
{
	const bool on = live_value_get(sim, row->plant, row->at).i;

	if (!is_dead(row, sim))
		live_value_set(sim, row->plant, row->at, (union iec_value){
			.i = row->push || !on });
}

void sim_row_unpress(const LadderSimRow *row, LadderSim *sim)
{
	if (row->push && !is_dead(row, sim))
		live_value_set(sim, row->plant, row->at, (union iec_value){ 0 });
}

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

/* ---- choices: read from the VIEW part ---- */

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

/* False: another kind of line. @out: choices_clear(). */
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
	       name_equal(choices->name, row->name);
}

/* @choices: NULL: none. True: the row changed. */
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

bool sim_row_read_choices(const char *view, GPtrArray *rows)
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

/* ---- choices: written to the VIEW part ---- */

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

static bool is_line_of(void *row, const char *line)
{
	struct choices choices;
	const bool is = line_read(line, &choices) && is_of(&choices, row);

	choices_clear(&choices);
	return is;
}

char *sim_row_write_choices(const char *view, const LadderSimRow *row)
{
	GString *own = g_string_new(NULL);
	char *text;

	put_line(own, row);
	text = live_lines_replace(view, is_line_of, (gpointer)row, own->str);
	g_string_free(own, TRUE);
	return text;
}
