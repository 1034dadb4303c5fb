/* SPDX-License-Identifier: MIT
 *
 * sim_panel_row - a line of the panel: its values, as texts and as acts. Which lines there
 * are is sim_panel_rows.c's.
 */
#include "editor-gtk/live/sim_panel_row.h"

#include "editor-gtk/kit/i18n.h"

#include "engine/base/literal.h"
#include "engine/trial/value.h"

#include <string.h>

G_DEFINE_FINAL_TYPE(LadderSimRow, ladder_sim_row, G_TYPE_OBJECT)

static void finalize(GObject *object)
{
	LadderSimRow *row = LADDER_SIM_ROW(object);

	g_free(row->name);
	g_free(row->address);
	g_free(row->comment);
	g_free(row->block);
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
	return g_strdup_printf("%d %s", (int)row->group, row->place ? row->place : "");
}

const char *sim_group_name(enum sim_group group)
{
	static const char *const name[SIM_GROUPS] = {
		[SIM_INPUTS] = N_("Inputs"), [SIM_OUTPUTS] = N_("Outputs"),
		[SIM_MEMORY] = N_("Memory"), [SIM_TIMERS] = N_("Timers"),
		[SIM_COUNTERS] = N_("Counters"), [SIM_ANALOGUE] = N_("Analogue"),
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
	       g_strcmp0(row->place, other->place) == 0 &&
	       g_strcmp0(row->pin, other->pin) == 0 &&
	       g_strcmp0(row->pin_told, other->pin_told) == 0;
}

void sim_row_become(LadderSimRow *row, const LadderSimRow *from)
{
	row->at = from->at;
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

bool sim_row_matches(const LadderSimRow *row, const char *wanted)
{
	char *folded = g_utf8_casefold(wanted, -1);
	const bool is = has(row->name, folded) || has(row->address, folded) ||
			has(row->comment, folded) || has(row->block, folded) ||
			has(row->pin_told, folded);

	g_free(folded);
	return is;
}

/* ---- values ---- */

static const struct image *image_of(const LadderSimRow *row, LadderSim *sim)
{
	const struct twin *twin = ladder_sim_twin(sim);

	return !twin ? NULL : row->plant ? &twin->plant.image : &twin->resource.image;
}

union iec_value sim_row_value(const LadderSimRow *row, LadderSim *sim, struct location at)
{
	const struct image *image = image_of(row, sim);

	return image && image->program ? image_get(image, at) : (union iec_value){ 0 };
}

bool sim_row_is_forced(const LadderSimRow *row, LadderSim *sim)
{
	const struct image *image = image_of(row, sim);

	return image && image->force_count &&
	       (image_is_forced(image, row->at) ||
		(row->preset.type != IEC_NONE && image_is_forced(image, row->preset)));
}

#define SECOND INT64_C(1000000000)

/* Digits behind the point: two as a rule, so that they stand still while it counts. */
static int digits_of(guint64 ns)
{
	static const guint step[] = { 10000000, 1000000, 1000, 1 };
	static const int digits[] = { 2, 3, 6, 9 };
	int i = 0;

	while (ns % step[i])
		i++;
	return digits[i];
}

static char *time_text(gint64 ns)
{
	const guint64 size = ns < 0 ? -(guint64)ns : (guint64)ns;
	const char *sign = ns < 0 ? "-" : "";
	const int digits = digits_of(size);
	guint64 fraction = size % SECOND;
	const guint s = (guint)(size / SECOND % 60), m = (guint)(size / SECOND / 60 % 60);
	const guint64 h = size / SECOND / 3600;

	for (int i = digits; i < 9; i++)
		fraction /= 10;
	if (h)
		return g_strdup_printf("%s%" G_GUINT64_FORMAT "h%02um%02u.%0*"
				       G_GUINT64_FORMAT "s", sign, h, m, s, digits, fraction);
	if (m)
		return g_strdup_printf("%s%um%02u.%0*" G_GUINT64_FORMAT "s", sign, m, s,
				       digits, fraction);
	return g_strdup_printf("%s%u.%0*" G_GUINT64_FORMAT "s", sign, s, digits, fraction);
}

char *sim_value_text(enum iec_type type, union iec_value value)
{
	char text[IEC_VALUE_TEXT + 1];

	if (type == IEC_TIME)
		return time_text(value.i);
	iec_value_print(type, value, text, sizeof(text));
	return g_utf8_make_valid(text, -1);
}

/* 1m30s, -2.5s, 20ms: a literal but for its T#. */
static bool time_read(const char *text, union iec_value *out)
{
	char *whole = strchr(text, '#') ? g_strdup(text) : g_strconcat("T#", text, NULL);
	struct literal literal;
	const bool good = literal_parse(whole, strlen(whole), &literal) == LITERAL_OK &&
			  literal.type == IEC_TIME;

	*out = literal.value;
	g_free(whole);
	return good;
}

bool sim_value_read(enum iec_type type, const char *text, struct iec_text *room,
		    union iec_value *out)
{
	enum diag_id why;
	char *own = g_strstrip(g_strdup(text)), *quoted = NULL;
	bool good;

	if (type == IEC_STRING && own[0] != '\'')
		quoted = g_strdup_printf("'%s'", own);
	good = (type == IEC_TIME && time_read(own, out)) ||
	       value_parse(type, quoted ? quoted : own, strlen(quoted ? quoted : own), room,
			   out, &why);
	g_free(quoted);
	g_free(own);
	return good;
}

/* ---- acts ---- */

static void act(const LadderSimRow *row, LadderSim *sim, enum act_kind kind,
		struct location at, union iec_value value)
{
	const struct act act = { .kind = kind, .plant = row->plant, .at = at,
				 .value = value };

	ladder_sim_act(sim, &act);
}

void sim_row_set(const LadderSimRow *row, LadderSim *sim, struct location at,
		 union iec_value value)
{
	const struct image *image = image_of(row, sim);

	if (image && at.type != IEC_NONE)
		act(row, sim, image_is_forced(image, at) ? ACT_FORCE : ACT_SET, at, value);
}

void sim_row_set_elapsed(const LadderSimRow *row, LadderSim *sim, union iec_value value)
{
	const struct twin *twin = ladder_sim_twin(sim);
	const struct resource *resource = !twin ? NULL :
		row->plant ? &twin->plant : &twin->resource;
	union iec_value start;

	if (!twin)
		return;
	if (row->start.type != IEC_NONE) {
		start.i = twin->now_ns + resource->timers_ns - value.i;
		act(row, sim, ACT_SET, row->start, start);
	}
	sim_row_set(row, sim, row->at, value);
}

/* Of what the plant drives only a force would last. */
static bool is_dead(const LadderSimRow *row, LadderSim *sim)
{
	return !sim_row_is_bit(row) || row->at.constant ||
	       (row->driven && !sim_row_is_forced(row, sim));
}

void sim_row_press(const LadderSimRow *row, LadderSim *sim)
{
	union iec_value value = sim_row_value(row, sim, row->at);

	value.i = row->push || !value.i;
	if (!is_dead(row, sim))
		sim_row_set(row, sim, row->at, value);
}

void sim_row_unpress(const LadderSimRow *row, LadderSim *sim)
{
	if (row->push && !is_dead(row, sim))
		sim_row_set(row, sim, row->at, (union iec_value){ 0 });
}

void sim_row_force(const LadderSimRow *row, LadderSim *sim, union iec_value value)
{
	act(row, sim, ACT_FORCE, row->at, value);
}

void sim_row_release(const LadderSimRow *row, LadderSim *sim)
{
	const struct image *image = image_of(row, sim);

	if (image && image_is_forced(image, row->at))
		act(row, sim, ACT_RELEASE, row->at, (union iec_value){ 0 });
	if (image && row->preset.type != IEC_NONE && image_is_forced(image, row->preset))
		act(row, sim, ACT_RELEASE, row->preset, (union iec_value){ 0 });
}
