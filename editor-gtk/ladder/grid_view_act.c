/* SPDX-License-Identifier: MIT
 *
 * grid_view_act - changes values of the running program from the sheet: toggle, set, force.
 *
 * Each change is an act of the simulation, so that it is recorded. While simulating, Space
 * toggles and Enter on a number sets it.
 */
#include "editor-gtk/ladder/grid_view_inside.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "engine/trial/value.h"

#include <string.h>

/* ---- the value at the cursor ---- */

static const struct image *image_of(LadderGridView *view)
{
	return &ladder_sim_twin(view->canvas->sim)->resource.image;
}

static const struct live_cell *cell_of(const struct live_rung *live, int row, int col)
{
	return live && row >= 0 && row < live->rows && col >= 0 && col < live->cols ?
	       &live->cell[row * live->cols + col] : NULL;
}

/* The cell at the cursor; NULL: nothing runs, or the cell has no value in what runs. */
static const struct live_cell *cell_here(LadderGridView *view)
{
	const struct live_rung *live = live_rung_of(view, view->cursor.at.rung);
	const struct live_cell *cell;
	int row, col;

	if (!live || ladder_sim_older(view->canvas->sim, NULL) == view->canvas->document ||
	    !cursor_cell(view, &row, &col))
		return NULL;
	cell = cell_of(live, row, col);
	return cell && cell->at.type != IEC_NONE ? cell : NULL;
}

static bool is_switch(const struct live_cell *cell)
{
	return cell && (cell->at.type == IEC_BOOL || cell->bit) && !cell->at.constant &&
	       (cell->kind == LIVE_CONTACT || cell->kind == LIVE_COIL);
}

static bool is_number(const struct live_cell *cell)
{
	return cell && cell->at.type != IEC_BOOL && !cell->at.constant;
}

/* The operand at the cursor; for a box its instance. */
static const char *name_here(LadderGridView *view)
{
	const struct cell *cell = cursor_cell(view, NULL, NULL);

	return cell ? project_text(ladder_document_project(view->canvas->document),
				   cell->operand) : "";
}

/* What has the value at the cursor: of a bit its number. */
static const char *owner_here(LadderGridView *view, const struct live_cell *cell)
{
	return cell->bit ? cell->name : name_here(view);
}

/* The value of the last act, which may not have reached the simulation yet. */
static union iec_value value_now(LadderGridView *view, struct location at)
{
	const struct sheet_live *live = &view->live;

	return live->ordered && live->ordered == live->stamp &&
	       live_value_is_same(live->ordered_at, at) ? live->ordered_value :
	       image_get(image_of(view), at);
}

static bool is_held(LadderGridView *view, struct location at)
{
	return live_value_is_forced(view->canvas->sim, false, at);
}

/* ---- acts ---- */

static const char *why_not(LadderGridView *view, bool force)
{
	return ladder_sim_why_not(view->canvas->sim, force ? SIM_WISH_FORCE : SIM_WISH_SET);
}

/* False: it is not allowed, and is refused at the cursor. */
static bool order(LadderGridView *view, enum act_kind kind, struct location at,
		  union iec_value value)
{
	const struct act act = { .kind = kind, .at = at, .value = value };
	const char *prompt = _(verb_row(kind == ACT_SET ? VERB_set_value : VERB_force)->label);
	const char *why = why_not(view, kind != ACT_SET);

	if (why) {
		canvas_refuse(LADDER_CANVAS(view), prompt, why);
		return false;
	}
	canvas_acts(LADDER_CANVAS(view), at, prompt);
	ladder_sim_act(view->canvas->sim, &act);
	view->live.ordered = view->live.stamp;
	view->live.ordered_at = at;
	view->live.ordered_value = value;
	return true;
}

static struct live_named names_of(const LadderGridView *view, const char *name)
{
	return live_map_named(view->live.map, name, strlen(name));
}

static void tell_value(LadderGridView *view, const char *name, struct location at,
		       union iec_value value, bool held)
{
	char shown[48], *keys, *text;

	live_named_print(names_of(view, name), at.type, value, shown, sizeof(shown));
	if (!held) {
		text = g_strdup_printf("%s = %s", name, shown);
	} else {
		keys = verb_keys_label(VERB_force);
		text = g_strdup_printf(_("%s is forced: %s · %s: release"), name, shown,
				       keys);
		g_free(keys);
	}
	canvas_tell(LADDER_CANVAS(view), text);
	g_free(text);
}

static void toggle(LadderGridView *view, const struct live_cell *cell)
{
	const union iec_value value = live_cell_switched(cell, value_now(view, cell->at));
	const bool held = is_held(view, cell->at);

	if (!order(view, held ? ACT_FORCE : ACT_SET, cell->at, value))
		return;
	if (!held && cell->kind == LIVE_COIL &&
	    ladder_sim_state(view->canvas->sim) == SIM_RUN) {
		char *keys = verb_keys_label(VERB_force);
		char *text = g_strdup_printf(_("\"%s\" is written by the program in each scan. %s "
			  "forces it."), owner_here(view, cell), keys);

		canvas_tell(LADDER_CANVAS(view), text);
		g_free(keys);
		g_free(text);
	} else {
		tell_value(view, owner_here(view, cell), cell->at, value, held);
	}
}

static void force_at(LadderGridView *view, const struct live_cell *cell,
		     union iec_value value)
{
	if (!order(view, ACT_FORCE, cell->at, value))
		return;
	canvas_moved(LADDER_CANVAS(view));
	tell_value(view, owner_here(view, cell), cell->at, value, true);
}

static void release(LadderGridView *view, const struct live_cell *cell)
{
	char *text;

	if (!order(view, ACT_RELEASE, cell->at, image_get(image_of(view), cell->at)))
		return;
	text = g_strdup_printf(_("%s is released"), owner_here(view, cell));
	canvas_moved(LADDER_CANVAS(view));
	canvas_tell(LADDER_CANVAS(view), text);
	g_free(text);
}

/* Forces the present value: no output changes. */
static void force(LadderGridView *view)
{
	const struct live_cell *cell = cell_here(view);

	if (!canvas_is_live(LADDER_CANVAS(view)))
		canvas_tell(LADDER_CANVAS(view), _("The simulation is not running."));
	else if (!cell || cell->at.constant || cell->at.type == IEC_STRING)
		canvas_tell(LADDER_CANVAS(view), _("Nothing here can be forced."));
	else if (is_held(view, cell->at))
		release(view, cell);
	else
		force_at(view, cell, value_now(view, cell->at));
}

/* ---- the entry for a new value ---- */

struct asked {
	LadderGridView *view;
	struct location at;
	char *name;
};

static void asked_free(gpointer data)
{
	g_free(((struct asked *)data)->name);
	g_free(data);
}

/* Caller frees. */
static char *bad_value(enum iec_type of, enum diag_id fault, const char *text)
{
	const struct iec_type_row *type = iec_type_row(of);
	char *said = diag_said_of(fault, text), *why;

	if (type->low < type->high && type->class & (ANY_INT | CLASS_BITS) && !iec_is_wide(of))
		why = g_strdup_printf(_("%s: %s, %lld to %lld"), said, type->word,
				      (long long)type->low, (long long)type->high);
	else
		why = g_strdup_printf(_("%s: %s"), said, type->word);
	g_free(said);
	return why;
}

/* Why @line is no value; NULL: it is one. Caller frees. */
static char *read_value(const struct asked *asked, const char *line, struct iec_text *room,
			union iec_value *value)
{
	const char *refused = why_not(asked->view, is_held(asked->view, asked->at));
	enum diag_id fault = DIAG_BAD_LITERAL;
	char *plain = g_strstrip(g_strdup(line)), *why = NULL;

	if (refused) {
		why = g_strdup(refused);
	} else if (live_named_parse(names_of(asked->view, asked->name), plain, value)) {
		why = NULL;
	} else if (!value_parse(asked->at.type, plain, strlen(plain), room, value, &fault)) {
		why = fault == DIAG_BAD_LITERAL ? live_named_wrong(names_of(asked->view, asked->name)) :
						  NULL;
		if (!why)
			why = bad_value(asked->at.type, fault, plain);
	} else if (!value_has_room(image_of(asked->view), asked->at, *value)) {
		why = g_strdup(_("the text is too long"));
	}
	g_free(plain);
	return why;
}

static char *set_changed(void *context, const char *line, int cursor, bool *good)
{
	const struct asked *asked = context;
	struct iec_text *room = g_new0(struct iec_text, 1);
	union iec_value value = { 0 };
	const bool live = canvas_is_live(LADDER_CANVAS(asked->view));
	char *why = live ? read_value(asked, line, room, &value) :
		    g_strdup(_("The simulation is not running.")), shown[48];

	(void)cursor;
	*good = why == NULL;
	if (!why && asked->at.type == IEC_TIME) { /* a bare number is in ms */
		live_value_print(IEC_TIME, value, shown, sizeof(shown));
		why = g_strdup_printf("= %s", shown);
	}
	g_free(room);
	return why;
}

static bool set_taken(void *context, const char *line)
{
	const struct asked *asked = context;
	LadderGridView *view = asked->view;
	struct iec_text *room = g_new0(struct iec_text, 1);
	union iec_value value = { 0 };
	char *why = canvas_is_live(LADDER_CANVAS(view)) ? read_value(asked, line, room, &value) : NULL;
	const bool good = canvas_is_live(LADDER_CANVAS(view)) && !why;

	if (good) {
		const bool held = is_held(view, asked->at);

		order(view, held ? ACT_FORCE : ACT_SET, asked->at, value);
		tell_value(view, asked->name, asked->at, value, held);
		view->live.ordered = 0; /* a text would not outlive @room */
	}
	g_free(why);
	g_free(room);
	return good;
}

static void ask(LadderGridView *view, const char *name, struct location at)
{
	struct asked *asked = g_new0(struct asked, 1);
	char *now = live_named_literal(names_of(view, name), at.type, image_get(image_of(view), at));
	char *prompt = g_strdup_printf(_("value of %s"), name);
	const struct canvas_question question = {
		.prompt = prompt, .text = now, .drops = true, .changed = set_changed,
		.taken = set_taken, .context = asked, .free = asked_free,
	};

	*asked = (struct asked){ view, at, g_strdup(name) };
	canvas_ask(LADDER_CANVAS(view), &question);
	g_free(now);
	view->asks_value = true;
}

/* Asks for a new value; for a box that of its counting pin. */
static void set_here(LadderGridView *view)
{
	const struct live_cell *cell = cell_here(view);
	const char *name = name_here(view);

	if (!cell || cell->at.constant)
		canvas_refuse(LADDER_CANVAS(view), _(verb_row(VERB_set_value)->label),
			      canvas_is_live(LADDER_CANVAS(view)) ?
			      _("Nothing at the cursor has a value that can be set.") :
			      _("The simulation is not running."));
	else
		ask(view, cell->parts || cell->bit ? cell->name : name, cell->at);
}

void act_forget(LadderGridView *view)
{
	view->live.ordered = 0;
	if (view->canvas->entry && view->asks_value)
		canvas_close_entry(LADDER_CANVAS(view));
}

/* ---- verbs ---- */

bool act_do(LadderGridView *view, enum verb verb)
{
	const struct live_cell *cell = cell_here(view);

	if (verb == VERB_force)
		force(view);
	else if (verb == VERB_cycle && is_switch(cell))
		toggle(view, cell);
	else if (verb == VERB_set_value ||
		 (verb == VERB_enter && is_number(cell) && cell->kind == LIVE_TEXT))
		set_here(view);
	else
		return false;
	return true;
}

/* ---- a click ---- */

#define REACH 14 /* px from the middle of an element; a wider name is hit, too    */

bool act_is_click(LadderGridView *view, float x, float y)
{
	const struct live_cell *cell = cell_here(view);
	const struct strip *strip;
	const struct rung_layout *layout;
	const struct cell *shown = cursor_cell(view, NULL, NULL);
	float middle, wire;

	if (!is_switch(cell))
		return false;
	strip = strips_get(view, view->cursor.at.rung);
	layout = strip->layout;
	middle = layout->column_x[view->cursor.at.col] +
		 layout->column_width[view->cursor.at.col] / 2;
	wire = layout->row[view->cursor.at.row].wire;
	if (y > wire + REACH || y < layout->row[view->cursor.at.row].y)
		return false;
	if (y > wire - REACH)
		return ABS(x - middle) <= REACH;
	return ABS(x - middle) <=
	       MAX(rung_layout_label(&view->drafting, shown) / 2, REACH) + 2;
}

void act_click(LadderGridView *view)
{
	const struct live_cell *cell = cell_here(view);

	if (is_switch(cell))
		toggle(view, cell);
}

/* ---- the menu ---- */

static void menu_do(GSimpleAction *action, GVariant *parameter, gpointer data)
{
	LadderGridView *view = data;
	const char *name = g_action_get_name(G_ACTION(action));
	const struct live_cell *cell = cell_here(view);
	const char *text = parameter ? g_variant_get_string(parameter, NULL) : NULL;

	if (!canvas_is_live(LADDER_CANVAS(view)) || !view->live.map)
		return;
	if (g_str_equal(name, "instance")) {
		ladder_grid_view_set_instance(view, text);
	} else if (g_str_equal(name, "set")) {
		const struct location at = live_map_find(view->live.map, text,
							 strlen(text));

		if (at.type != IEC_NONE)
			ask(view, text, at);
	} else if (!cell) {
		return;
	} else if (g_str_equal(name, "toggle") && is_switch(cell)) {
		toggle(view, cell);
	} else if (g_str_equal(name, "on")) {
		force_at(view, cell, (union iec_value){ .i = 1 });
	} else if (g_str_equal(name, "off")) {
		force_at(view, cell, (union iec_value){ .i = 0 });
	} else if (g_str_equal(name, "force")) {
		force(view);
	}
}

static void add_sets(GMenu *menu, const struct live_cell *cell)
{
	for (guint i = 0; i < cell->parts->len; i++) {
		const struct live_part *part =
			&g_array_index(cell->parts, struct live_part, i);
		GMenuItem *item;
		char *label;

		if (part->at.type == IEC_NONE || part->at.constant)
			continue;
		label = g_strdup_printf(_("Set %s…"), part->text);
		item = g_menu_item_new(label, NULL);
		g_menu_item_set_action_and_target(item, "live.set", "s", part->text);
		g_menu_append_item(menu, item);
		g_object_unref(item);
		g_free(label);
	}
}

static void add_instances(LadderGridView *view, GMenu *menu)
{
	GPtrArray *names = view->live.map ? live_map_instances(view->live.map) : NULL;
	GMenu *part = g_menu_new();

	for (guint i = 0; names && i < names->len && i < 100; i++) {
		GMenuItem *item = g_menu_item_new(names->pdata[i], NULL);

		g_menu_item_set_action_and_target(item, "live.instance", "s",
						  names->pdata[i]);
		g_menu_append_item(part, item);
		g_object_unref(item);
	}
	if (names && names->len > 1)
		g_menu_append_submenu(menu, _("Instance"), G_MENU_MODEL(part));
	g_object_unref(part);
	if (names)
		g_ptr_array_unref(names);
}

GMenuModel *act_menu(LadderGridView *view)
{
	const struct live_cell *cell = cell_here(view);
	GMenu *menu = g_menu_new();

	if (is_switch(cell))
		verb_append(menu, VERB_cycle, _("Toggle"), "live.toggle");
	if (cell && cell->parts)
		add_sets(menu, cell);
	else if (cell && !cell->at.constant)
		verb_append(menu, VERB_set_value, NULL, NULL);
	if (cell && cell->at.type == IEC_BOOL && !cell->at.constant) {
		g_menu_append(menu, _("Force on"), "live.on");
		g_menu_append(menu, _("Force off"), "live.off");
	} else if (is_number(cell) && !is_held(view, cell->at)) {
		verb_append(menu, VERB_force, _("Force at this value"), "live.force");
	}
	if (cell && is_held(view, cell->at))
		verb_append(menu, VERB_force, _("Release"), "live.force");
	if (canvas_is_live(LADDER_CANVAS(view)) && ladder_sim_forces(view->canvas->sim) > 0)
		verb_append(menu, VERB_sim_release, NULL, NULL);
	if (canvas_is_live(LADDER_CANVAS(view)))
		add_instances(view, menu);
	return G_MENU_MODEL(menu);
}

void act_init(LadderGridView *view)
{
	static const GActionEntry entries[] = {
		{ "toggle", menu_do, NULL, NULL, NULL, { 0 } },
		{ "on", menu_do, NULL, NULL, NULL, { 0 } },
		{ "off", menu_do, NULL, NULL, NULL, { 0 } },
		{ "force", menu_do, NULL, NULL, NULL, { 0 } },
		{ "set", menu_do, "s", NULL, NULL, { 0 } },
		{ "instance", menu_do, "s", NULL, NULL, { 0 } },
	};
	GSimpleActionGroup *group = g_simple_action_group_new();

	g_action_map_add_action_entries(G_ACTION_MAP(group), entries,
					G_N_ELEMENTS(entries), view);
	gtk_widget_insert_action_group(GTK_WIDGET(view), "live", G_ACTION_GROUP(group));
	g_object_unref(group);
}

/* ---- texts ---- */

static void add_key(GString *text, enum verb verb, const char *what)
{
	char *keys = verb_keys_label(verb);

	if (keys[0])
		g_string_append_printf(text, _("%s%s: %s"), text->len ? " · " : "", keys, what);
	g_free(keys);
}

bool act_keys(LadderGridView *view, GString *text)
{
	const struct live_cell *cell = cell_here(view);
	const bool held = cell && is_held(view, cell->at);

	if (!cell || cell->at.constant)
		return false;
	if (is_switch(cell))
		add_key(text, VERB_cycle, held ? _("Toggle the forced value") : _("Toggle"));
	else if (is_number(cell) && cell->kind == LIVE_TEXT)
		add_key(text, VERB_enter, _(verb_row(VERB_set_value)->label));
	add_key(text, VERB_force, held ? _("Release") : _("Force"));
	return true;
}

static void add_pins(LadderGridView *view, const struct cell *cell, GString *text)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct word_row *row = words_row(&project->words, (enum word)cell->word);
	const char *instance = project_text(project, cell->operand), *gap = "\n";
	char shown[48];

	for (int i = 0; row->kind == WORD_FB && i < row->pin_count; i++) {
		char *name = g_strdup_printf("%s.%s", instance, row->pin[i].name);
		const struct location at = row->pin[i].dir == PIN_VAR ?
			(struct location){ .type = IEC_NONE } :
			live_map_find(view->live.map, name, strlen(name));

		g_free(name);
		if (at.type == IEC_NONE)
			continue;
		live_value_print(at.type, image_get(image_of(view), at), shown,
				 sizeof(shown));
		g_string_append_printf(text, "%s%s = %s", gap, row->pin[i].name, shown);
		gap = " · ";
	}
}

static void add_filled(LadderGridView *view, uint32_t id, GString *text)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	GArray *parts = live_parts(view->live.map, project_text(project, id));
	char *filled;

	if (!parts)
		return;
	filled = live_parts_print(parts, image_of(view));
	g_string_append_printf(text, "\n= %s", filled);
	g_free(filled);
	g_array_unref(parts);
}

void act_tip(LadderGridView *view, int rung, int row, int col, GString *text)
{
	const struct live_rung *live = live_rung_of(view, rung);
	const struct live_cell *cell = cell_of(live, row, col);
	const struct cell *shown = live ? rung_at(live->shown, row, col) : NULL;
	char value[48];

	if (!cell)
		return;
	if (cell->kind == LIVE_BOX) {
		add_pins(view, shown, text);
		add_filled(view, shown->args, text);
	} else if (cell->parts) {
		add_filled(view, shown->operand, text);
	} else if (cell->bit) {
		live_value_print(IEC_BOOL, live_cell_bit(cell, image_get(image_of(view), cell->at)), value,
				 sizeof(value));
		g_string_append_printf(text, "\n= %s", value);
	} else if (cell->at.type != IEC_NONE) {
		live_named_print(cell->named, cell->at.type, image_get(image_of(view), cell->at),
				 value, sizeof(value));
		g_string_append_printf(text, "\n= %s", value);
	}
	if (live->bits[row * live->cols + col] & LIVE_FORCED)
		g_string_append_printf(text, "\n%s", _("forced"));
	if (cell->quality != SIM_GOOD)
		g_string_append_printf(text, "\n%s", live_quality_word((enum sim_quality)cell->quality));
	if (live->bits[row * live->cols + col] & LIVE_FAILED)
		g_string_append_printf(text, "\n%s", _("ENO is FALSE: it failed in this "
							"scan"));
}

void act_said(LadderGridView *view, int rung, int row, int col, GString *text)
{
	const struct live_rung *live = live_rung_of(view, rung);
	const struct live_cell *cell = cell_of(live, row, col);
	unsigned int bits;

	if (!cell)
		return;
	bits = live->bits[row * live->cols + col];
	if (cell->text[0])
		g_string_append_printf(text, ", %s", cell->text);
	if (cell->kind == LIVE_CONTACT || cell->parts)
		g_string_append_printf(text, ", %s", bits & LIVE_CLOSED ? _("closed") :
				       _("open"));
	else if (cell->kind == LIVE_COIL)
		g_string_append_printf(text, ", %s", bits & LIVE_CLOSED ? _("on") :
				       _("off"));
	if (bits & LIVE_FORCED)
		g_string_append_printf(text, ", %s", _("forced"));
	if (cell->quality != SIM_GOOD)
		g_string_append_printf(text, ", %s", live_quality_word((enum sim_quality)cell->quality));
	if (bits & LIVE_FAILED)
		g_string_append_printf(text, ", %s", _("ENO is FALSE: it failed in this "
						       "scan"));
}
