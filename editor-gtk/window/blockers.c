/* SPDX-License-Identifier: MIT
 *
 * blockers - why the element at the cursor has no power; see blockers.h.
 */
#include "editor-gtk/window/blockers.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/front.h"
#include "editor-gtk/window/messages.h"

#include "engine/trial/why.h"

#include <string.h>

#define PAUSE_MS 100 /* a text is read as a whole for its conditions, and nobody reads faster */

static void end_pause(struct blockers *blockers)
{
	g_clear_handle_id(&blockers->pause, g_source_remove);
	blockers->late = false;
}

static void forget(struct blockers *blockers)
{
	end_pause(blockers);
	if (blockers->sheet)
		ladder_grid_view_set_blockers(blockers->sheet, -1, NULL, 0);
	g_clear_weak_pointer(&blockers->sheet);
	g_clear_weak_pointer(&blockers->asked);
	g_clear_pointer(&blockers->place, g_free);
	g_clear_pointer(&blockers->told, g_free);
}

/* ---- in words ---- */

/* Each text of why.def has at most one %s. */
static void append_said(GString *out, enum why_kind kind, bool on, const char *name)
{
	const char *text = said(why_text(kind, on)), *hole = strstr(text, "%s");

	if (!hole) {
		g_string_append(out, text);
		return;
	}
	g_string_append_len(out, text, hole - text);
	g_string_append(out, name);
	g_string_append(out, hole + strlen("%s"));
}

static void append_cell(GString *out, const struct why_cell *cell, bool on)
{
	append_said(out, cell->kind, on, cell->name);
	if (cell->values[0])
		g_string_append_printf(out, " (%s)", cell->values);
}

static char *in_words(const struct why *why)
{
	GString *out = g_string_new(why->on ? _("It has power: ") : _("No power: "));

	if (why->whole != WHY_COUNT)
		append_said(out, why->whole, false, why->name);
	for (int i = 0; i < why->ways; i++) {
		if (i)
			g_string_append(out, why->on ? _("; and ") : _("; or "));
		for (int k = 0; k < why->way[i].count; k++) {
			g_string_append(out, k ? _(" and ") : "");
			append_cell(out, &why->way[i].cell[k], why->on);
		}
		if (!why->way[i].count)
			g_string_append(out, _("from the left rail"));
	}
	if (why->more)
		g_string_append(out, " …");
	return g_string_free(out, FALSE);
}

/* ---- in the rung ---- */

static bool has(const GArray *cells, const struct why_cell *cell)
{
	for (guint i = 0; i < cells->len; i++) {
		const struct grid_blocker *one = &g_array_index(cells, struct grid_blocker, i);

		if (one->row == cell->row - 1 && one->col == cell->col - 1)
			return true;
	}
	return false;
}

static void mark(struct blockers *blockers, const struct why *why)
{
	GArray *cells = g_array_new(FALSE, FALSE, sizeof(struct grid_blocker));

	for (int i = 0; !why->on && i < why->ways; i++)
		for (int k = 0; k < why->way[i].count; k++) {
			const struct why_cell *cell = &why->way[i].cell[k];
			const struct grid_blocker one = { cell->row - 1, cell->col - 1, NULL };

			if (!has(cells, cell))
				g_array_append_val(cells, one);
		}
	ladder_grid_view_set_blockers(blockers->sheet, blockers->rung,
		(const struct grid_blocker *)(gpointer)cells->data, (int)cells->len);
	g_array_unref(cells);
}

/* ---- asking ---- */

static bool ask(struct blockers *blockers, struct why *why)
{
	LadderSim *sim = ladder_canvas_sim(LADDER_CANVAS(blockers->sheet));
	const struct twin *twin = ladder_sim_twin(sim);
	LadderDocument *document = ladder_canvas_document(LADDER_CANVAS(blockers->sheet));
	const int shown = ladder_canvas_pou(LADDER_CANVAS(blockers->sheet));
	const int pou = ladder_sim_pou(sim, document, shown);
	const int rung = ladder_sim_rung(sim, document, shown,
		blockers->rung + ladder_grid_view_first(blockers->sheet));
	struct arena arena;
	bool good;

	if (!twin || rung < 0 || pou < 0)
		return false;
	arena_init(&arena);
	good = why_ask(&(struct why_place){
		.project = ladder_project(ladder_sim_ladder(sim)),
		.resource = &twin->resource, .pou = pou,
		.instance = ladder_grid_view_instance(blockers->sheet),
		.rung = rung + 1, .row = blockers->row + 1, .col = blockers->col + 1,
	}, &arena, why);
	arena_free(&arena);
	return good;
}

static void tell(struct blockers *blockers, const struct why *why)
{
	char *text = in_words(why);

	if (g_strcmp0(text, blockers->told) != 0) {
		mark(blockers, why);
		messages_tell(blockers->core->messages, text);
	}
	g_free(blockers->told);
	blockers->told = text;
}

/* ---- conditions and networks ---- */

/* Where the cursor is. Caller frees. */
static char *place_of(GtkWidget *asked)
{
	GtkTextBuffer *text;
	GtkTextIter at;

	if (LADDER_IS_CANVAS(asked))
		return ladder_canvas_place(LADDER_CANVAS(asked));
	text = GTK_TEXT_BUFFER(ladder_text_view_buffer(LADDER_TEXT_VIEW(asked)));
	gtk_text_buffer_get_iter_at_mark(text, &at, gtk_text_buffer_get_insert(text));
	return g_strdup_printf("%d", gtk_text_iter_get_line(&at));
}

/* NULL: nothing can be said. Caller frees. */
static char *why_of(GtkWidget *asked)
{
	return LADDER_IS_FBD_VIEW(asked) ? ladder_fbd_view_why(LADDER_FBD_VIEW(asked)) :
					   ladder_text_view_why(LADDER_TEXT_VIEW(asked));
}

/* The text follows the values while the cursor stays and its page is open, and no other message stands there. */
static void look_again(struct blockers *blockers)
{
	struct messages *messages = blockers->core->messages;
	char *place = blockers->asked ? place_of(blockers->asked) : NULL, *why = NULL;
	bool stays;

	if (place && strcmp(place, blockers->place) == 0 && gtk_widget_get_mapped(blockers->asked))
		why = why_of(blockers->asked);
	stays = why && (strcmp(why, blockers->told) == 0 || messages_retell(messages, blockers->told, why));
	if (stays) {
		g_free(blockers->told);
		blockers->told = g_steal_pointer(&why);
	} else {
		messages_untell(messages, blockers->told);
		forget(blockers);
	}
	g_free(why);
	g_free(place);
}

static void look_in_time(struct blockers *blockers);

static gboolean pause_over(gpointer data)
{
	struct blockers *blockers = data;
	const bool late = blockers->late;

	blockers->pause = 0;
	blockers->late = false;
	if (late && blockers->place)
		look_in_time(blockers);
	return G_SOURCE_REMOVE;
}

/* Some times a second, and for the last scan that was shown. */
static void look_in_time(struct blockers *blockers)
{
	if (blockers->pause) {
		blockers->late = true;
		return;
	}
	look_again(blockers);
	if (blockers->place)
		blockers->pause = g_timeout_add(PAUSE_MS, pause_over, blockers);
}

static void tell_text(struct blockers *blockers, GtkWidget *asked, const char *nothing)
{
	char *why = why_of(asked);

	forget(blockers);
	messages_tell(blockers->core->messages, why ? why : nothing);
	if (!why)
		return;
	blockers->told = why;
	blockers->place = place_of(asked);
	g_set_weak_pointer(&blockers->asked, asked);
}

/* Updates marks and text for the scan that is shown. */
static void look(struct blockers *blockers)
{
	struct why *why;

	if (blockers->place)
		look_in_time(blockers);
	if (!blockers->sheet)
		return;
	why = g_new0(struct why, 1);
	if (ask(blockers, why))
		tell(blockers, why);
	else
		forget(blockers);
	g_free(why);
}

/* The element at the cursor, else the first output of its rung. */
static bool meant(LadderGridView *sheet, int *row, int *col)
{
	const struct project *project = ladder_document_project(
		ladder_canvas_document(LADDER_CANVAS(sheet)));
	const struct rung *rung = project->pou[ladder_canvas_pou(LADDER_CANVAS(sheet))]
		.rung[ladder_grid_view_first(sheet) + ladder_grid_view_cursor(sheet).rung];

	if (ladder_grid_view_cell(sheet, row, col))
		return true;
	*col = rung->cols - 1;
	for (*row = 0; *row < rung->rows; (*row)++)
		if (word_row(rung_at(rung, *row, *col)->word)->place == PLACE_LAST)
			return true;
	return false;
}

void blockers_ask(struct blockers *blockers)
{
	LadderGridView *sheet = front_seen_sheet(blockers->core->front);
	LadderSfcView *chart = front_seen_chart(blockers->core->front);
	int row, col;
	const int rung = sheet ? ladder_grid_view_cursor(sheet).rung : -1;
	bool again;

	if (!ladder_sim_is_on(blockers->core->sim)) {
		messages_tell(blockers->core->messages, _("Start the simulation first"));
		return;
	}
	/* Opens the condition as rungs first, so that their power is visible. */
	if (!sheet && chart && ladder_sfc_view_why(chart))
		return;
	if (!sheet && front_seen_networks(blockers->core->front)) {
		tell_text(blockers, GTK_WIDGET(front_seen_networks(blockers->core->front)),
			  _("Put the cursor on an input that is TRUE or FALSE"));
		return;
	}
	if (!sheet && front_list(blockers->core->front)) {
		tell_text(blockers, GTK_WIDGET(front_list(blockers->core->front)),
			  _("No condition with known values begins in this line."));
		return;
	}
	if (!sheet || !meant(sheet, &row, &col)) {
		messages_tell(blockers->core->messages, _("Put the cursor on an element first"));
		return;
	}
	again = blockers->sheet == sheet && blockers->rung == rung && blockers->row == row &&
		blockers->col == col;
	forget(blockers);
	messages_tell(blockers->core->messages, "");
	if (again)
		return;
	g_set_weak_pointer(&blockers->sheet, sheet);
	blockers->rung = rung;
	blockers->row = row;
	blockers->col = col;
	look(blockers);
	if (!blockers->sheet)
		messages_tell(blockers->core->messages, _("This rung is not in the running "
							  "program"));
}

/* ---- life ---- */

/* While a simulation stands, no scan is shown. */
static void moved(struct blockers *blockers)
{
	if (blockers->place)
		look_again(blockers);
}

void blockers_init(struct blockers *blockers, struct core *core)
{
	blockers->core = core;
	/* Sheets that follow the simulation have followed it then. */
	core_connect(core, core->sim, "shown", G_CALLBACK(look), blockers,
		     G_CONNECT_SWAPPED | G_CONNECT_AFTER);
	core_connect(core, core->sim, "program-changed", G_CALLBACK(moved), blockers, G_CONNECT_SWAPPED);
	core_connect(core, core->window, "cursor-moved", G_CALLBACK(moved), blockers, G_CONNECT_SWAPPED);
	core_connect(core, core->window, "place-changed", G_CALLBACK(moved), blockers, G_CONNECT_SWAPPED);
}

void blockers_clear(struct blockers *blockers)
{
	end_pause(blockers);
	g_clear_weak_pointer(&blockers->sheet);
	g_clear_weak_pointer(&blockers->asked);
	g_clear_pointer(&blockers->place, g_free);
	g_clear_pointer(&blockers->told, g_free);
}
