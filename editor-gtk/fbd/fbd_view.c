/* SPDX-License-Identifier: MIT
 *
 * fbd_view - the class of the sheet of a function block diagram: drawing, names, keys, clicks.
 */
#include "editor-gtk/fbd/fbd_view_inside.h"

#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/comment_text.h"

#include "engine/base/name.h"

#include <math.h>
#include <string.h>

G_DEFINE_FINAL_TYPE(LadderFbdView, ladder_fbd_view, LADDER_TYPE_CANVAS)

#define BELOW     60 /* px of free sheet below the networks                      */
#define SLACK     5  /* px around a part where a click hits it                   */
#define SYMBOLS   12 /* in the context menu of a pin, at most                    */

static struct fbd_pos at_point(LadderFbdView *view, double x, double y, enum fbd_part *part)
{
	return fbd_hit_at(view, canvas_point(LADDER_CANVAS(view), x, y), SLACK, part);
}

/* ---- drawing ---- */

static graphene_size_t size(LadderCanvas *canvas)
{
	const LadderFbdView *view = LADDER_FBD_VIEW(canvas);

	return GRAPHENE_SIZE_INIT(view->width + BELOW, view->height + BELOW);
}

static void push_mark(GArray *marks, int box, int pin, unsigned int signs)
{
	const struct fbd_mark mark = { box, pin, signs };

	g_array_append_val(marks, mark);
}

static void push_at(GArray *marks, int network, struct fbd_pos at, unsigned int signs)
{
	if (at.network == network && at.box >= 0)
		push_mark(marks, at.box, at.pin, signs);
}

static GArray *marks_of(LadderFbdView *view, int network)
{
	GArray *marks = g_array_new(FALSE, FALSE, sizeof(struct fbd_mark));
	const bool *selected = view->strip[network].selected;

	for (int i = 0; selected && i < fbd_graph_of(view, network)->box_count; i++)
		if (selected[i])
			push_mark(marks, i, -1, MARK_SELECTED);
	for (guint i = 0; i < view->marks->len; i++) {
		const struct fbd_problem *problem = &g_array_index(view->marks, struct fbd_problem, i);

		push_at(marks, network, problem->at, problem->marks);
	}
	for (guint i = 0; i < view->found->len; i++) {
		const struct fbd_problem *found = &g_array_index(view->found, struct fbd_problem, i);

		push_at(marks, network, found->at, found->marks);
	}
	fbd_live_marks(view, network, marks);
	push_at(marks, network, view->link, MARK_SELECTED);
	push_at(marks, network, view->drop, MARK_DROP);
	push_at(marks, network, view->cursor, MARK_CURSOR);
	if (view->stroke.drawn && view->stroke.from.pin >= 0)
		push_at(marks, network, view->stroke.to, MARK_DROP);
	return marks;
}

/* Hits of a search in the heading. */
static unsigned int found_state(LadderFbdView *view, int network)
{
	unsigned int state = 0;

	for (guint i = 0; i < view->found->len; i++) {
		const struct fbd_problem *found = &g_array_index(view->found, struct fbd_problem, i);

		if (found->at.network == network && found->at.box < 0)
			state |= RUNG_FOUND | (found->marks & MARK_FOUND_NOW ? RUNG_FOUND_NOW : 0u);
	}
	return state;
}

static void paint_strip(LadderFbdView *view, GtkSnapshot *snapshot, const struct theme *theme, int network)
{
	const struct fbd_strip *strip = &view->strip[network];
	const int current = view->drop.network >= 0 ? view->drop.network : view->cursor.network;
	GArray *marks = marks_of(view, network);
	struct fbd_live live;
	struct fbd_scene scene = {
		.layout = strip->layout, .theme = theme,
		.mark = (const struct fbd_mark *)(void *)marks->data, .mark_count = (int)marks->len,
		.state = (current == network ? RUNG_CURRENT : 0u) | found_state(view, network) |
			 (ladder_document_is_bookmarked(view->canvas->document, view->canvas->pou, network) ?
			  RUNG_MARKED : 0u),
		.width = MAX(view->width, canvas_page(LADDER_CANVAS(view)).size.width),
	};
	GskRenderNode *node;

	if (fbd_live_look(view, network, &live))
		scene.live = &live;
	node = fbd_draw_node(&scene);
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(0, strip->y));
	if (node) {
		gtk_snapshot_append_node(snapshot, node);
		gsk_render_node_unref(node);
	}
	gtk_snapshot_restore(snapshot);
	g_array_unref(marks);
}

/* The wire or the box that the pointer drags, and the heading at the cursor. */
static void paint_over(LadderFbdView *view, GtkSnapshot *snapshot, const struct theme *theme)
{
	const struct fbd_stroke *stroke = &view->stroke;
	struct picture picture;
	graphene_rect_t rect;

	picture_init(&picture);
	if (view->cursor.network >= 0 && view->cursor.box < 0) {
		rect = fbd_rect(view, view->cursor);
		picture_frame(&picture, TOKEN_ACCENT, STROKE_SOLID, 1.5f, rect.origin.x, rect.origin.y, rect.size.width,
			    rect.size.height);
	}
	if (stroke->drawn && stroke->from.pin >= 0) {
		rect = fbd_rect(view, stroke->from);
		picture_line(&picture, TOKEN_ACCENT, STROKE_DASHED, 2, rect.origin.x + rect.size.width / 2,
			     rect.origin.y + rect.size.height / 2, stroke->at.x, stroke->at.y);
		picture_disc(&picture, TOKEN_ACCENT, 1, stroke->at.x, stroke->at.y, 4);
	} else if (stroke->drawn) {
		rect = fbd_rect(view, (struct fbd_pos){ stroke->from.network, stroke->from.box, -1 });
		picture_frame(&picture, TOKEN_ACCENT, STROKE_DASHED, 2, stroke->at.x - stroke->by.x,
			    stroke->at.y - stroke->by.y, rect.size.width, rect.size.height);
	}
	picture_snapshot(&picture, theme, view->canvas->lettering, snapshot);
	picture_clear(&picture);
}

static void paint(LadderCanvas *canvas, GtkSnapshot *snapshot, const struct theme *theme)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	const graphene_rect_t origin = canvas_rect(canvas, GRAPHENE_RECT_INIT(0, 0, 0, 0));
	const graphene_rect_t page = canvas_page(canvas);

	if (view->count == 0) {
		canvas_snapshot_hint(canvas, snapshot, theme,
			_("Press Ins: a network. Type a box in it: AND, TON, or target := value.\n"
			  "At a pin, type what it reads. Draw a wire from pin to pin."),
			GRAPHENE_POINT_INIT(28, 28));
		return;
	}
	gtk_snapshot_save(snapshot);
	gtk_snapshot_translate(snapshot, &GRAPHENE_POINT_INIT(roundf(origin.origin.x), roundf(origin.origin.y)));
	gtk_snapshot_scale(snapshot, (float)view->canvas->zoom, (float)view->canvas->zoom);
	for (int i = 0; i < view->count; i++)
		if (view->strip[i].y < page.origin.y + page.size.height &&
		    view->strip[i].y + view->strip[i].layout->height > page.origin.y)
			paint_strip(view, snapshot, theme, i);
	paint_over(view, snapshot, theme);
	gtk_snapshot_restore(snapshot);
}

/* ---- the document and the simulation ---- */

static void project_changed(LadderCanvas *canvas)
{
	fbd_make_sheet(LADDER_FBD_VIEW(canvas));
}

static void rungs_changed(LadderCanvas *canvas, int pou, int at, int removed, int inserted)
{
	(void)pou;
	(void)at;
	(void)removed;
	(void)inserted;
	fbd_fresh(LADDER_FBD_VIEW(canvas));
}

/* A wire may be a variable now, and the other way round. */
static void variable_changed(LadderCanvas *canvas, int pou, const char *name, const char *address)
{
	(void)pou;
	(void)name;
	(void)address;
	fbd_make_sheet(LADDER_FBD_VIEW(canvas));
}

/* The place of a line and column of the file; network -1: none. */
static struct fbd_pos at_line(LadderFbdView *view, int line, int column)
{
	struct fbd_pos best = FBD_NOWHERE;
	int score = 0;

	for (int n = 0; n < view->count; n++) {
		const struct fbd_graph *graph = fbd_graph_of(view, n);

		if (fbd_lines_line(fbd_pou(view), n) == line)
			return (struct fbd_pos){ n, -1, -1 };
		for (int i = 0; i < graph->box_count; i++) {
			const struct fbd_box *box = &graph->box[i];
			const int own = box->line != line ? 0 : box->column == column ? 3 : box->nested ? 1 : 2;

			if (own > score) {
				score = own;
				best = (struct fbd_pos){ n, i, -1 };
			}
			for (int pin = box->first_pin; pin < box->first_pin + box->pins; pin++)
				if (graph->pin[pin].line == line && graph->pin[pin].column == column &&
				    graph->pin[pin].len > 0 && score < 4) {
					score = 4;
					best = (struct fbd_pos){ n, i, pin };
				}
		}
	}
	return best;
}

static void checked(LadderCanvas *canvas)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	const struct diag_list *diags = ladder_document_diags(view->canvas->document);
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct pou *pou = fbd_pou(view);

	g_array_set_size(view->marks, 0);
	for (int i = 0; pou && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];
		struct fbd_problem problem = { .marks = grid_mark_of(diag) };

		if (!diag->pou || strcmp(diag->pou, project_text(project, pou->name)) != 0)
			continue;
		problem.at = at_line(view, diag->line, diag->column);
		if (problem.at.network >= 0)
			g_array_append_val(view->marks, problem);
	}
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static void values_changed(LadderCanvas *canvas)
{
	LADDER_FBD_VIEW(canvas)->ordered = false;
	gtk_widget_queue_draw(GTK_WIDGET(canvas));
	canvas_cells_later(canvas);
}

static void program_gone(LadderCanvas *canvas)
{
	LADDER_FBD_VIEW(canvas)->ordered = false;
	fbd_live_end(LADDER_FBD_VIEW(canvas), !canvas_is_live(canvas));
}

/* ---- names and tips ---- */

static void say_heading(LadderFbdView *view, GString *text, int network)
{
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct fbd_heading of = fbd_lines_heading(project, fbd_pou(view), network);

	g_string_append_printf(text, _("Network %d"), network + 1);
	if (of.label[0])
		g_string_append_printf(text, ", %s", of.label);
	if (of.title[0])
		g_string_append_printf(text, ", %s", of.title);
	if (of.off)
		g_string_append_printf(text, ", %s", _("off"));
}

static void say_box(GString *text, const struct fbd_box *box)
{
	switch (box->kind) {
	case FBD_BLOCK: g_string_append_printf(text, "%s %s", box->type, box->instance); break;
	case FBD_STORE: g_string_append_printf(text, _("Store in %s"), box->target); break;
	case FBD_SET: g_string_append_printf(text, _("Set %s"), box->target); break;
	case FBD_RESET: g_string_append_printf(text, _("Reset %s"), box->target); break;
	case FBD_JUMP: g_string_append_printf(text, _("Jump to %s"), box->target); break;
	case FBD_RETURN: g_string_append(text, _("Return")); break;
	case FBD_STOP: g_string_append(text, _("Stop the controller")); break;
	case FBD_VALUE: g_string_append_printf(text, _("Value %s"), box->target); break;
	case FBD_FUNCTION: case FBD_OPERATOR: case FBD_TRIGGER: g_string_append(text, box->type); break;
	}
}

static void say_pin(LadderFbdView *view, GString *text, struct fbd_pos at)
{
	const struct fbd_graph *graph = fbd_graph_of(view, at.network);
	const struct fbd_pin *pin = &graph->pin[at.pin];
	char *number = g_strdup_printf("%d", fbd_pin_number(graph, at.pin));
	const char *name = pin->name[0] ? pin->name : number;

	g_string_append_printf(text, pin->output ? _(", output %s") : _(", input %s"), name);
	if (pin->negated)
		g_string_append_printf(text, ", %s", _("negated"));
	if (pin->operand)
		g_string_append_printf(text, ": %s", pin->operand);
	else if (pin->wire >= 0 && graph->wire[pin->wire].name)
		g_string_append_printf(text, _(": wire %s"), graph->wire[pin->wire].name);
	else if (pin->wire >= 0)
		g_string_append(text, _(": wire"));
	else
		g_string_append(text, _(": open"));
	g_free(number);
}

static char *name_of(LadderFbdView *view, struct fbd_pos at, bool values)
{
	GString *text = g_string_new(NULL);
	char *value;

	if (at.box < 0) {
		say_heading(view, text, at.network);
		return g_string_free(text, FALSE);
	}
	say_box(text, fbd_box_at(view, at));
	if (at.pin >= 0)
		say_pin(view, text, at);
	else if (fbd_box_at(view, at)->order > 0)
		g_string_append_printf(text, _(", executed as number %d"), fbd_box_at(view, at)->order);
	value = values ? fbd_live_text(view, at) : NULL;
	if (value)
		g_string_append_printf(text, ", %s", value);
	g_free(value);
	return g_string_free(text, FALSE);
}

static bool is_there(LadderFbdView *view, struct fbd_pos at)
{
	const struct fbd_graph *graph;

	if (at.network < 0 || at.network >= view->count)
		return false;
	graph = fbd_graph_of(view, at.network);
	return at.box < graph->box_count && at.pin < graph->pin_count;
}

static char *cursor_name(LadderCanvas *canvas, bool values)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	const struct fbd_pos at = view->cursor;
	char *name, *text;

	if (!is_there(view, at))
		return NULL;
	name = name_of(view, at, values);
	if (values)
		return name;
	text = g_strdup_printf("%d %d %d %s", at.network, at.box, at.pin, name);
	g_free(name);
	return text;
}

static char *place(LadderCanvas *canvas)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	char *name, *text;

	fbd_fresh(view);
	if (!is_there(view, view->cursor))
		return g_strdup("");
	name = name_of(view, view->cursor, true);
	text = view->cursor.box < 0 ? g_strdup(name) :
	       g_strdup_printf(_("Network %d · %s"), view->cursor.network + 1, name);
	g_free(name);
	return text;
}

/* Errors and warnings of a place, and the comment of a network; NULL: none. Caller frees. */
static char *tip_of(LadderFbdView *view, struct fbd_pos at)
{
	const struct diag_list *diags = ladder_document_diags(view->canvas->document);
	const struct project *project = ladder_document_project(view->canvas->document);
	const struct pou *pou = fbd_pou(view);
	GString *text = g_string_new(NULL);
	char *said;

	for (int i = 0; pou && i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		if (!diag->pou || strcmp(diag->pou, project_text(project, pou->name)) != 0 ||
		    !fbd_is_same(at_line(view, diag->line, diag->column), at))
			continue;
		said = diag_said_whole(diag);
		g_string_append_printf(text, _("%s%s: %s"), text->len ? "\n" : "",
			diag_severity(diag->id) == SEVERITY_ERROR ? _("Error") : _("Warning"), said);
		g_free(said);
	}
	return g_string_free(text, text->len == 0);
}

static char *tip(LadderCanvas *canvas, int x, int y, bool by_keys)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	enum fbd_part part;
	const struct fbd_pos at = by_keys ? view->cursor : at_point(view, x, y, &part);

	return is_there(view, at) && (by_keys || part != FBD_PART_NONE) ? tip_of(view, at) : NULL;
}

/* Can Space change the value at the cursor? */
static bool is_switch(LadderFbdView *view)
{
	const struct location at = canvas_is_live(LADDER_CANVAS(view)) ?
				   fbd_live_variable(view, view->cursor, NULL) :
				   (struct location){ .type = IEC_NONE };

	return at.type == IEC_BOOL && !at.constant;
}

static char *next_keys(LadderCanvas *canvas)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	static const enum verb verbs[][4] = {
		{ VERB_network_below, VERB_network_title, VERB_box_block, VERB_COUNT },
		{ VERB_box_block, VERB_box_store, VERB_pin_add, VERB_delete },
		{ VERB_enter, VERB_pin_negate, VERB_pin_link, VERB_box_block },
	};
	GString *text = g_string_new(NULL);
	char *keys;
	int kind;

	fbd_fresh(view);
	kind = view->cursor.pin >= 0 ? 2 : view->cursor.box >= 0 ? 1 : 0;
	if (is_switch(view)) {
		keys = gtk_accelerator_get_label(GDK_KEY_space, 0);
		g_string_append_printf(text, "%s: %s", keys, _("Toggle"));
		g_free(keys);
	}
	for (int i = 0; i < 4 && verbs[kind][i] != VERB_COUNT; i++)
		verb_tell(text, verbs[kind][i]);
	return g_string_free(text, FALSE);
}

/* ---- accessible children ---- */

static struct fbd_pos at_spot(struct canvas_spot spot)
{
	return (struct fbd_pos){ spot.number, spot.row, spot.col };
}

static void add_cell(LadderFbdView *view, struct fbd_pos at)
{
	canvas_add_cell(LADDER_CANVAS(view), (struct canvas_spot){ at.network, at.box, at.pin },
			fbd_is_same(at, view->cursor));
}

static void list_cells(LadderCanvas *canvas)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	const graphene_rect_t page = canvas_page(canvas);

	fbd_fresh(view);
	for (int n = 0; n < view->count; n++) {
		const struct fbd_graph *graph = fbd_graph_of(view, n);

		if (view->strip[n].y > page.origin.y + page.size.height ||
		    view->strip[n].y + view->strip[n].layout->height < page.origin.y)
			continue;
		add_cell(view, (struct fbd_pos){ n, -1, -1 });
		for (int i = 0; i < graph->box_count; i++) {
			const struct fbd_box *box = &graph->box[i];

			add_cell(view, (struct fbd_pos){ n, i, -1 });
			for (int pin = box->first_pin; pin < box->first_pin + box->pins; pin++)
				add_cell(view, (struct fbd_pos){ n, i, pin });
		}
	}
}

static char *cell_name(LadderCanvas *canvas, struct canvas_spot spot)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);

	return is_there(view, at_spot(spot)) ? name_of(view, at_spot(spot), true) : NULL;
}

static bool cell_box(LadderCanvas *canvas, struct canvas_spot spot, graphene_rect_t *box)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);

	if (!is_there(view, at_spot(spot)))
		return false;
	*box = fbd_rect(view, at_spot(spot));
	return true;
}

static void go_to_cell(LadderCanvas *canvas, struct canvas_spot spot)
{
	if (is_there(LADDER_FBD_VIEW(canvas), at_spot(spot)))
		fbd_go(LADDER_FBD_VIEW(canvas), at_spot(spot), false);
}

static graphene_rect_t cursor_box(LadderCanvas *canvas)
{
	return fbd_rect(LADDER_FBD_VIEW(canvas), LADDER_FBD_VIEW(canvas)->cursor);
}

static void reveal(LadderCanvas *canvas)
{
	fbd_reveal(LADDER_FBD_VIEW(canvas));
}

/* ---- keys ---- */

/* False: there was nothing to end; the window gets the key. */
static bool escape(LadderFbdView *view)
{
	bool any = view->link.network >= 0;

	for (int i = 0; i < view->count; i++)
		any |= view->strip[i].selected != NULL;
	view->link = FBD_NOWHERE;
	fbd_select(view, false);
	return any;
}

/* The value of the last act, which may not have reached the simulation yet. */
static union iec_value value_now(LadderFbdView *view, struct location at)
{
	return view->ordered && live_value_is_same(view->ordered_at, at) ? view->ordered_value :
	       live_value_get(view->canvas->sim, false, at);
}

static void set_ordered(LadderFbdView *view, struct location at, union iec_value value)
{
	view->ordered = true;
	view->ordered_at = at;
	view->ordered_value = value;
}

/* Does a box write the variable at the cursor? */
static bool is_written(LadderFbdView *view)
{
	const struct fbd_pin *pin = fbd_pin_at(view, view->cursor);

	return !pin || pin->output || !pin->operand;
}

static void tell_written(LadderFbdView *view, const char *name)
{
	char *keys = verb_keys_label(VERB_force);
	char *text = g_strdup_printf(_("\"%s\" is written by the program in each scan. %s forces it."), name, keys);

	canvas_tell(LADDER_CANVAS(view), text);
	g_free(keys);
	g_free(text);
}

static void toggle_it(LadderFbdView *view, struct location at, const char *name)
{
	LadderSim *sim = view->canvas->sim;
	const bool held = live_value_is_forced(sim, false, at);
	const char *why = ladder_sim_why_not(sim, held ? SIM_WISH_FORCE : SIM_WISH_SET);
	union iec_value value = value_now(view, at);

	if (why) {
		canvas_refuse(LADDER_CANVAS(view), _("Toggle"), why);
		return;
	}
	canvas_acts(LADDER_CANVAS(view), at, _("Toggle"));
	value.i = !value.i;
	live_value_set(sim, false, at, value);
	set_ordered(view, at, value);
	if (!held && is_written(view) && ladder_sim_state(sim) == SIM_RUN)
		tell_written(view, name);
}

/* A BOOL of the running program becomes the other value, as on the sheet of a ladder. False: none is here. */
static bool toggle(LadderFbdView *view)
{
	struct location at;
	char *name;

	if (!canvas_is_live(LADDER_CANVAS(view)) || !fbd_box_at(view, view->cursor))
		return false;
	at = fbd_live_variable(view, view->cursor, &name);
	if (at.type == IEC_BOOL && !at.constant)
		toggle_it(view, at, name);
	else
		canvas_tell(LADDER_CANVAS(view), _("Nothing at the cursor has a value that can be set."));
	g_free(name);
	return true;
}

static bool move_by_key(LadderCanvas *canvas, guint key, GdkModifierType state)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	const bool extend = state & GDK_SHIFT_MASK;

	fbd_fresh(view);
	if (view->count == 0 || state & (GDK_CONTROL_MASK | GDK_ALT_MASK))
		return false;
	switch (key) {
	case GDK_KEY_space: return toggle(view);
	case GDK_KEY_Up: case GDK_KEY_KP_Up: fbd_step(view, 0, -1, extend); return true;
	case GDK_KEY_Down: case GDK_KEY_KP_Down: fbd_step(view, 0, 1, extend); return true;
	case GDK_KEY_Left: case GDK_KEY_KP_Left: fbd_step(view, -1, 0, extend); return true;
	case GDK_KEY_Right: case GDK_KEY_KP_Right: fbd_step(view, 1, 0, extend); return true;
	case GDK_KEY_Home: fbd_go(view, (struct fbd_pos){ 0, -1, -1 }, false); return true;
	case GDK_KEY_End: fbd_go(view, (struct fbd_pos){ view->count - 1, -1, -1 }, false); return true;
	case GDK_KEY_Page_Up: fbd_go(view, (struct fbd_pos){ view->cursor.network - 1, -1, -1 }, false); return true;
	case GDK_KEY_Page_Down: fbd_go(view, (struct fbd_pos){ view->cursor.network + 1, -1, -1 }, false); return true;
	case GDK_KEY_Escape: return escape(view);
	default: return false;
	}
}

static void type(LadderCanvas *canvas, const char *text)
{
	fbd_fresh(LADDER_FBD_VIEW(canvas));
	fbd_ask(LADDER_FBD_VIEW(canvas), FBD_ASK_HERE, text);
}

/* ---- the pointer ---- */

static void pressed_twice(LadderFbdView *view, struct fbd_pos at, enum fbd_part part)
{
	if (part == FBD_PART_PIN)
		fbd_edit_do(view, VERB_pin_link);
	else if (part == FBD_PART_NONE && at.network >= 0)
		fbd_ask(view, FBD_ASK_ADD, NULL);
	else
		fbd_ask(view, FBD_ASK_HERE, NULL);
}

static void press(LadderCanvas *canvas, double x, double y, int count, GdkModifierType state)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	const graphene_point_t point = canvas_point(canvas, x, y);
	enum fbd_part part;
	struct fbd_pos at;
	graphene_rect_t rect;

	fbd_fresh(view);
	at = at_point(view, x, y, &part);
	view->stroke = (struct fbd_stroke){ .from = FBD_NOWHERE, .to = FBD_NOWHERE };
	if (at.network < 0)
		return;
	fbd_go(view, at, state & GDK_SHIFT_MASK);
	if (count == 2) {
		if (!canvas_is_fixed(canvas))
			pressed_twice(view, at, part);
		return;
	}
	rect = fbd_rect(view, (struct fbd_pos){ at.network, at.box, -1 });
	view->stroke.from = at;
	view->stroke.by = GRAPHENE_POINT_INIT(point.x - rect.origin.x, point.y - rect.origin.y);
}

static bool can_drag(LadderCanvas *canvas)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);

	return is_there(view, view->stroke.from) && view->stroke.from.box >= 0 &&
	       !ladder_document_is_fixed(view->canvas->document);
}

static bool drag(LadderCanvas *canvas, double x, double y, GdkModifierType state)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	enum fbd_part part;

	(void)state;
	if (!can_drag(canvas)) /* the network changed since the press */
		return false;
	view->stroke.drawn = true;
	view->stroke.at = canvas_point(canvas, x, y);
	view->stroke.to = at_point(view, x, y, &part);
	if (view->stroke.to.pin < 0 || fbd_is_same(view->stroke.to, view->stroke.from))
		view->stroke.to = FBD_NOWHERE;
	gtk_widget_queue_draw(GTK_WIDGET(view));
	return true;
}

static void drag_end(LadderCanvas *canvas, bool cancelled)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	const struct fbd_stroke stroke = view->stroke;

	if (!stroke.drawn)
		return;
	view->stroke.drawn = false;
	view->stroke.from = FBD_NOWHERE;
	gtk_widget_queue_draw(GTK_WIDGET(view));
	if (cancelled)
		return;
	if (stroke.from.pin >= 0 && stroke.to.network >= 0)
		fbd_join(view, stroke.from, stroke.to);
	else if (stroke.from.pin < 0)
		fbd_move_box(view, stroke.from, GRAPHENE_POINT_INIT(stroke.at.x - stroke.by.x,
								    stroke.at.y - stroke.by.y));
}

/* ---- the menu ---- */

static const enum verb of_pin[] = { VERB_enter, VERB_pin_negate, VERB_pin_link, VERB_box_block, VERB_box_store,
	VERB_force, VERB_COUNT };
static const enum verb of_box[] = { VERB_pin_add, VERB_pin_remove, VERB_box_earlier, VERB_box_later,
	VERB_box_unplace, VERB_COUNT };
static const enum verb of_network[] = { VERB_network_below, VERB_network_above, VERB_network_title,
	VERB_network_label, VERB_network_comment, VERB_network_off, VERB_network_duplicate, VERB_network_up,
	VERB_network_down, VERB_network_delete, VERB_COUNT };
static const enum verb of_symbol[] = { VERB_rename, VERB_show_uses, VERB_go_definition, VERB_watch_add, VERB_COUNT };
static const enum verb of_clipboard[] = { VERB_cut, VERB_copy, VERB_paste, VERB_delete, VERB_COUNT };

static bool grows(const struct fbd_box *box)
{
	return box && box->row && box->row->kind == WORD_FN && box->row->most_inputs > 0;
}

/* Does the verb apply at the cursor? */
static bool applies(LadderCanvas *canvas, enum verb verb)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	const struct fbd_box *box = fbd_box_at(view, view->cursor);
	const struct fbd_pin *pin = fbd_pin_at(view, view->cursor);

	switch ((int)verb) {
	case VERB_pin_negate: return pin && !pin->open;
	case VERB_pin_link: return pin;
	case VERB_pin_add: return grows(box);
	case VERB_pin_remove: return grows(box) && pin && !pin->output;
	case VERB_box_earlier: case VERB_box_later: return box;
	case VERB_box_unplace: return box && box->at_column > 0;
	case VERB_force:
		return canvas_is_live(canvas) && fbd_live_variable(view, view->cursor, NULL).type != IEC_NONE;
	case VERB_box_store: return box && (!pin || pin->output);
	case VERB_rename: case VERB_show_uses: case VERB_go_definition: case VERB_watch_add: case VERB_cut:
		return box;
	default: return view->cursor.network >= 0 || verb == VERB_network_below;
	}
}

/* "fbd.operand": the symbol that was chosen for the pin at the cursor. */
static void put_symbol(GtkWidget *widget, const char *action, GVariant *name)
{
	LadderFbdView *view = LADDER_FBD_VIEW(widget);
	struct fbd_pos at;
	struct fbd_spot spot;
	struct fbd_edit *edit;

	(void)action;
	fbd_fresh(view);
	at = view->cursor;
	if (!fbd_pin_at(view, at) || canvas_is_fixed(LADDER_CANVAS(view)))
		return;
	spot = fbd_spot_of(view, at);
	edit = fbd_begin(view, at.network);
	if (edit && fbd_put(view, edit, at.network, fbd_edit_operand(edit, &spot, g_variant_get_string(name, NULL)),
			    _("Change what is at a pin")))
		fbd_go(view, at, false);
}

/* Symbols that may stand at the pin. */
static GMenu *symbols_of(LadderFbdView *view, const struct fbd_pin *pin)
{
	const struct entry_place at = { .project = ladder_document_project(view->canvas->document),
		.pou = view->canvas->pou, .output = pin->output, .xref = canvas_uses(LADDER_CANVAS(view)) };
	struct entry_candidate *found = g_new(struct entry_candidate, SYMBOLS);
	const char *line = pin->output ? "OUT " : "[";
	const int count = entry_candidates(&at, line, strlen(line), found, SYMBOLS);
	GMenu *menu = g_menu_new();

	for (int i = 0; i < count; i++) {
		GMenuItem *item;

		if (found[i].kind != ENTRY_VARIABLE && found[i].kind != ENTRY_PIN)
			continue;
		item = g_menu_item_new(NULL, NULL);
		g_menu_item_set_attribute(item, "label", "s", found[i].text);
		g_menu_item_set_action_and_target(item, "fbd.operand", "s", found[i].text);
		g_menu_append_item(menu, item);
		g_object_unref(item);
	}
	g_free(found);
	return menu;
}

static GMenu *make_menu(LadderCanvas *canvas)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);
	const struct fbd_pin *pin = fbd_pin_at(view, view->cursor);
	GMenu *menu = g_menu_new(), *parts = g_menu_new(), *symbols;

	if (view->cursor.box >= 0) {
		canvas_append_section(canvas, menu, of_pin, applies);
		canvas_append_section(canvas, menu, of_box, applies);
	}
	if (pin) {
		symbols = symbols_of(view, pin);
		g_menu_append_submenu(parts, _("Put a symbol here"), G_MENU_MODEL(symbols));
		g_object_unref(symbols);
	}
	canvas_append_submenu(canvas, parts, N_("Symbol"), of_symbol, applies);
	canvas_append_submenu(canvas, parts, N_("Network"), of_network, applies);
	g_menu_append_section(menu, NULL, G_MENU_MODEL(parts));
	g_object_unref(parts);
	canvas_append_section(canvas, menu, of_clipboard, applies);
	return menu;
}

/* ---- verbs ---- */

/* Releases the value at the cursor, or forces it: a bit to the other value. */
static void force(LadderFbdView *view)
{
	LadderSim *sim = view->canvas->sim;
	const struct location at = fbd_live_variable(view, view->cursor, NULL);
	const char *prompt = _(verb_row(VERB_force)->label);
	const char *why = sim ? ladder_sim_why_not(sim, SIM_WISH_FORCE) : NULL;
	union iec_value value;

	if (at.type == IEC_NONE || at.constant || at.type == IEC_STRING) {
		canvas_tell(LADDER_CANVAS(view), canvas_is_live(LADDER_CANVAS(view)) ?
			    _("Nothing here can be forced.") : _("The simulation is not running."));
		return;
	}
	if (why) {
		canvas_refuse(LADDER_CANVAS(view), prompt, why);
		return;
	}
	canvas_acts(LADDER_CANVAS(view), at, prompt);
	value = value_now(view, at);
	if (live_value_is_forced(sim, false, at)) {
		live_value_release(sim, false, at);
		return;
	}
	if (at.type == IEC_BOOL)
		value.i = !value.i;
	live_value_force(sim, false, at, value);
	set_ordered(view, at, value);
}

static bool changes(enum verb verb)
{
	return verb != VERB_copy && verb != VERB_select_all && verb != VERB_context_menu && verb != VERB_force &&
	       verb != VERB_bookmark;
}

static void do_verb(LadderCanvas *canvas, enum verb verb)
{
	LadderFbdView *view = LADDER_FBD_VIEW(canvas);

	fbd_fresh(view);
	if (!fbd_pou(view) || (changes(verb) && canvas_is_fixed(canvas)) || fbd_edit_do(view, verb))
		return;
	switch ((int)verb) {
	case VERB_enter: fbd_ask(view, FBD_ASK_HERE, NULL); break;
	case VERB_box_block:
		fbd_ask(view, view->cursor.pin >= 0 ? FBD_ASK_INSERT : FBD_ASK_ADD, NULL);
		break;
	case VERB_box_store: fbd_ask(view, FBD_ASK_STORE, NULL); break;
	case VERB_network_title: fbd_ask(view, FBD_ASK_TITLE, NULL); break;
	case VERB_network_label: fbd_ask(view, FBD_ASK_LABEL, NULL); break;
	case VERB_network_comment: fbd_ask(view, FBD_ASK_COMMENT, NULL); break;
	case VERB_select_all: fbd_select(view, true); break;
	case VERB_context_menu: canvas_show_menu(canvas); break;
	case VERB_force: force(view); break;
	case VERB_bookmark:
		if (view->cursor.network >= 0)
			ladder_document_toggle_bookmark(view->canvas->document, view->canvas->pou,
							view->cursor.network);
		break;
	default: break;
	}
}

static void bookmarks_changed(LadderCanvas *canvas)
{
	gtk_widget_queue_draw(GTK_WIDGET(canvas));
}

/* ---- the palette ---- */

void ladder_fbd_view_put(LadderFbdView *view, enum word word)
{
	struct project *project;
	const struct word_row *row;

	fbd_fresh(view);
	project = ladder_document_project(view->canvas->document);
	if (!fbd_pou(view) || canvas_is_fixed(LADDER_CANVAS(view)))
		return;
	gtk_widget_grab_focus(GTK_WIDGET(view));
	if (view->cursor.network < 0)
		fbd_edit_do(view, VERB_network_below);
	row = words_row(&project->words, word);
	project = ladder_document_project(view->canvas->document);
	row = words_row(&project->words, word);
	if (row->kind == WORD_FB)
		fbd_add_block(view, row, NULL);
	else
		fbd_add_word(view, row->word, NULL);
}

#define LADDER_TYPE_BOX_WORD (ladder_box_word_get_type())

/* A word that is dragged. */
static int *ladder_box_word_copy(int *word)
{
	return g_memdup2(word, sizeof(*word));
}

static GType ladder_box_word_get_type(void)
{
	static GType type_of;

	if (g_once_init_enter(&type_of))
		g_once_init_leave(&type_of, g_boxed_type_register_static("LadderBoxWord",
			(GBoxedCopyFunc)ladder_box_word_copy, g_free));
	return type_of;
}

GdkContentProvider *ladder_fbd_view_drag(int word)
{
	return gdk_content_provider_new_typed(LADDER_TYPE_BOX_WORD, &word);
}

static void drop_at(LadderFbdView *view, struct fbd_pos at)
{
	if (fbd_is_same(at, view->drop))
		return;
	view->drop = at;
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

static GdkDragAction drop_motion(GtkDropTarget *target, double x, double y, LadderFbdView *view)
{
	enum fbd_part part;

	(void)target;
	fbd_fresh(view);
	if (!fbd_pou(view) || ladder_document_is_fixed(view->canvas->document))
		return 0;
	drop_at(view, at_point(view, x, y, &part));
	return view->drop.network >= 0 || view->count == 0 ? GDK_ACTION_COPY : 0;
}

static void drop_leave(GtkDropTarget *target, LadderFbdView *view)
{
	(void)target;
	drop_at(view, FBD_NOWHERE);
}

static gboolean dropped(GtkDropTarget *target, const GValue *value, double x, double y, LadderFbdView *view)
{
	const int word = *(const int *)g_value_get_boxed(value);

	if (!drop_motion(target, x, y, view))
		return FALSE;
	if (view->drop.network >= 0)
		fbd_go(view, view->drop, false);
	drop_at(view, FBD_NOWHERE);
	ladder_fbd_view_put(view, (enum word)word);
	return TRUE;
}

static void take_drops(LadderFbdView *view)
{
	GtkDropTarget *target = gtk_drop_target_new(LADDER_TYPE_BOX_WORD, GDK_ACTION_COPY);

	g_signal_connect(target, "motion", G_CALLBACK(drop_motion), view);
	g_signal_connect(target, "leave", G_CALLBACK(drop_leave), view);
	g_signal_connect(target, "drop", G_CALLBACK(dropped), view);
	gtk_widget_add_controller(GTK_WIDGET(view), GTK_EVENT_CONTROLLER(target));
}

/* ---- for the window ---- */

void ladder_fbd_view_go(LadderFbdView *view, int network)
{
	fbd_fresh(view);
	if (network >= 0)
		fbd_go(view, (struct fbd_pos){ network, -1, -1 }, false);
	gtk_widget_grab_focus(GTK_WIDGET(view));
}

int ladder_fbd_view_network(LadderFbdView *view)
{
	fbd_fresh(view);
	return view->cursor.network;
}

int ladder_fbd_view_count(LadderFbdView *view)
{
	fbd_fresh(view);
	return view->count;
}

void ladder_fbd_view_go_row(LadderFbdView *view, int row, int col)
{
	struct fbd_pos at;

	fbd_fresh(view);
	at = fbd_pou(view) ? at_line(view, fbd_pou(view)->line + row, col + 1) : FBD_NOWHERE;
	if (at.network >= 0)
		fbd_go(view, at, false);
	gtk_widget_grab_focus(GTK_WIDGET(view));
}

int ladder_fbd_view_row(LadderFbdView *view)
{
	const struct fbd_box *box;
	const struct fbd_pin *pin;

	fbd_fresh(view);
	if (!fbd_pou(view) || view->cursor.network < 0)
		return -1;
	box = fbd_box_at(view, view->cursor);
	pin = fbd_pin_at(view, view->cursor);
	return MAX((pin ? pin->line : box ? box->line : fbd_lines_line(fbd_pou(view), view->cursor.network)) -
		   fbd_pou(view)->line, -1);
}

bool ladder_fbd_view_is_at(LadderFbdView *view, int row)
{
	return ladder_fbd_view_row(view) == row;
}

/* The pin whose text has that place of the file, else the box of the line, else the heading. */
static struct fbd_pos found_at(LadderFbdView *view, int line, int column)
{
	const struct fbd_pos at = at_line(view, line, column);
	int network = -1;

	for (int n = 0; n < view->count && fbd_lines_line(fbd_pou(view), n) <= line; n++) {
		const struct fbd_graph *graph = fbd_graph_of(view, n);

		network = n;
		for (int pin = 0; pin < graph->pin_count; pin++)
			if (graph->pin[pin].line == line && graph->pin[pin].column <= column &&
			    column < graph->pin[pin].column + graph->pin[pin].len)
				return (struct fbd_pos){ n, graph->pin[pin].box, pin };
	}
	return at.network >= 0 ? at : (struct fbd_pos){ network, -1, -1 };
}

void ladder_fbd_view_set_found(LadderFbdView *view, const struct find_seen *seen)
{
	const struct find_hit *hit;
	int index = 0;
	bool now;

	fbd_fresh(view);
	g_array_set_size(view->found, 0);
	while (fbd_pou(view) && (hit = find_seen_next(seen, view->canvas->pou, &index, &now)) != NULL) {
		const struct fbd_problem found = {
			found_at(view, fbd_pou(view)->line + hit->row, hit->col + 1),
			MARK_FOUND | (now ? MARK_FOUND_NOW : 0u)
		};

		if (found.at.network >= 0)
			g_array_append_val(view->found, found);
	}
	gtk_widget_queue_draw(GTK_WIDGET(view));
}

const char *ladder_fbd_view_word(LadderFbdView *view)
{
	const struct fbd_box *box;

	fbd_fresh(view);
	box = fbd_box_at(view, view->cursor);
	return box && box->row && (box->kind == FBD_FUNCTION || box->kind == FBD_BLOCK || box->kind == FBD_OPERATOR) ?
	       box->row->word : NULL;
}

/* The name that the cursor is on, as a text. NULL: none. */
static const char *name_here(LadderFbdView *view)
{
	const struct fbd_box *box = fbd_box_at(view, view->cursor);
	const struct fbd_pin *pin = fbd_pin_at(view, view->cursor);

	if (!box)
		return NULL;
	if (pin)
		return pin->operand ? pin->operand : pin->wire >= 0 ?
		       fbd_graph_of(view, view->cursor.network)->wire[pin->wire].name : NULL;
	return box->kind == FBD_BLOCK ? box->instance : box->target;
}

/* Is it a use of the name at the cursor, or of the wire of this network with that name? */
static bool is_use_of(LadderFbdView *view, const struct xref *xref, const struct xref_use *use, const char *name)
{
	struct project *project = ladder_document_project(view->canvas->document);
	const gsize len = strcspn(name, "[^"), head = strcspn(name, ".[^");
	const int wire = fbd_lines_wire(project, fbd_pou(view), view->cursor.network, name, head);
	char text[3 * LIMIT_NAME + 8];

	if (wire >= 0)
		return use->target.what == XREF_VARIABLE && use->target.table == view->canvas->pou + 1 &&
		       use->target.index == wire;
	xref_name(xref->project, &use->target, use, text, sizeof(text));
	return name_is(text, name, len) || name_is(text, name, head);
}

const struct xref_use *ladder_fbd_view_use(LadderFbdView *view, const struct xref *xref)
{
	const char *name;
	const struct xref_use *found = NULL;
	int row;

	fbd_fresh(view);
	name = fbd_pou(view) ? name_here(view) : NULL;
	row = ladder_fbd_view_row(view);
	for (int i = 0; name && i < xref->count; i++) {
		const struct xref_use *use = &xref->use[i];

		if (use->pou == view->canvas->pou && is_use_of(view, xref, use, name) &&
		    (!found || use->row == row + 1))
			found = use;
	}
	return found;
}

/* ---- life ---- */

static void ladder_fbd_view_dispose(GObject *object)
{
	LadderFbdView *view = LADDER_FBD_VIEW(object);

	canvas_close_entry(LADDER_CANVAS(view));
	fbd_live_end(view, true);
	fbd_clear(view);
	G_OBJECT_CLASS(ladder_fbd_view_parent_class)->dispose(object);
}

static void ladder_fbd_view_finalize(GObject *object)
{
	g_array_unref(LADDER_FBD_VIEW(object)->marks);
	g_array_unref(LADDER_FBD_VIEW(object)->found);
	G_OBJECT_CLASS(ladder_fbd_view_parent_class)->finalize(object);
}

static void ladder_fbd_view_class_init(LadderFbdViewClass *class)
{
	LadderCanvasClass *canvas = LADDER_CANVAS_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = ladder_fbd_view_dispose;
	G_OBJECT_CLASS(class)->finalize = ladder_fbd_view_finalize;
	gtk_widget_class_install_action(GTK_WIDGET_CLASS(class), "fbd.operand", "s", put_symbol);
	canvas->least_zoom = 0.3;
	canvas->keys = VERB_NETWORK;
	canvas->name = N_("Networks");
	canvas->size = size;
	canvas->paint = paint;
	canvas->cursor_box = cursor_box;
	canvas->reveal = reveal;
	canvas->cursor_name = cursor_name;
	canvas->place = place;
	canvas->next_keys = next_keys;
	canvas->do_verb = do_verb;
	canvas->key = move_by_key;
	canvas->type = type;
	canvas->press = press;
	canvas->can_drag = can_drag;
	canvas->drag = drag;
	canvas->drag_end = drag_end;
	canvas->menu = make_menu;
	canvas->tip = tip;
	canvas->list_cells = list_cells;
	canvas->cell_name = cell_name;
	canvas->cell_box = cell_box;
	canvas->go_to_cell = go_to_cell;
	canvas->project_changed = project_changed;
	canvas->rungs_changed = rungs_changed;
	canvas->variable_changed = variable_changed;
	canvas->bookmarks_changed = bookmarks_changed;
	canvas->checked = checked;
	canvas->values_changed = values_changed;
	canvas->program_gone = program_gone;
	canvas->program_changed = values_changed;
}

static void ladder_fbd_view_init(LadderFbdView *view)
{
	view->canvas = canvas_state(LADDER_CANVAS(view));
	view->found = g_array_new(FALSE, FALSE, sizeof(struct fbd_problem));
	view->cursor = view->link = view->drop = FBD_NOWHERE;
	view->stroke = (struct fbd_stroke){ .from = FBD_NOWHERE, .to = FBD_NOWHERE };
	view->marks = g_array_new(FALSE, TRUE, sizeof(struct fbd_problem));
	take_drops(view);
	fbd_live_watch(view);
}

GtkWidget *ladder_fbd_view_new(LadderDocument *document, int pou)
{
	LadderFbdView *view = g_object_new(LADDER_TYPE_FBD_VIEW, NULL);

	canvas_show(LADDER_CANVAS(view), document, pou);
	return GTK_WIDGET(view);
}
