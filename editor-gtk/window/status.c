/* SPDX-License-Identifier: MIT
 *
 * status - the status bar; see status.h.
 */
#include "editor-gtk/window/status.h"

#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/verbs.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/window/front.h"
#include "editor-gtk/window/messages.h"

#include <string.h>

/* ---- what the window is doing ---- */

static void set_pill(struct status *status, const char *text, const char *class)
{
	static const char *const classes[] = { "run", "still", "past", "fault" };

	/* GTK redraws a label even if its text is the same. */
	if (g_strcmp0(gtk_label_get_text(status->pill), text) == 0 &&
	    (!class || gtk_widget_has_css_class(GTK_WIDGET(status->pill), class)))
		return;
	for (gsize i = 0; i < G_N_ELEMENTS(classes); i++)
		gtk_widget_remove_css_class(GTK_WIDGET(status->pill), classes[i]);
	if (class)
		gtk_widget_add_css_class(GTK_WIDGET(status->pill), class);
	gtk_label_set_text(status->pill, text);
}

static const char *board_class(struct status *status)
{
	const char *state = ladder_board_run_status(status->core->board)->state;

	return strcmp(state, "FAULT") == 0 ? "fault" : strcmp(state, "RUN") == 0 ? "run" :
	       "still";
}

/* A board was wanted and does not answer. */
static bool is_away(struct status *status)
{
	const enum link_state state = ladder_board_link_state(status->core->link);

	return state == LINK_LOST || state == LINK_FAILED;
}

static void show_board_pill(struct status *status)
{
	static const struct { const char *text, *class; } pills[] = {
		[SIM_OFF] = { N_("ONLINE"), NULL },
		[SIM_STOP] = { N_("ONLINE · STOP"), "still" },
		[SIM_RUN] = { N_("ONLINE"), "run" },
		[SIM_PAUSE] = { N_("ONLINE"), "run" },
		[SIM_FAULT] = { N_("ONLINE · FAULT"), "fault" },
	};
	const enum sim_state state = ladder_sim_state(status->core->sim);
	const gint64 late_ns = ladder_sim_late(status->core->sim);
	char late[32], *text;

	if (ladder_sim_is_recording(status->core->sim)) {
		set_pill(status, _("RECORDING"), "still");
		return;
	}
	if (is_away(status)) {
		set_pill(status, _("NOT CONNECTED"), "fault");
		return;
	}
	if (!late_ns) {
		set_pill(status, _(pills[state].text), pills[state].class);
		return;
	}
	live_time_print_short(late_ns, late, sizeof(late));
	text = g_strdup_printf(_("%s · %s late"), _(pills[state].text), late);
	set_pill(status, text, "still");
	g_free(text);
}

/* Also while no values of the board are shown. */
static bool is_online(struct status *status)
{
	return ladder_sim_board(status->core->sim) ||
	       ladder_board_link_state(status->core->link) != LINK_OFF;
}

static void show_pill(struct status *status)
{
	static const struct { const char *text, *class; } pills[] = {
		[SIM_OFF] = { N_("EDIT"), NULL },
		[SIM_STOP] = { N_("SIMULATION · STOP"), "still" },
		[SIM_RUN] = { N_("SIMULATION"), "run" },
		[SIM_PAUSE] = { N_("SIMULATION · PAUSE"), "still" },
		[SIM_FAULT] = { N_("SIMULATION · FAULT"), "fault" },
	};
	const enum sim_state state = ladder_sim_state(status->core->sim);
	char *text;

	if (ladder_board_run_state(status->core->board) != BOARD_OFF) {
		set_pill(status, _("ON THIS MACHINE"), board_class(status));
		return;
	}
	if (is_online(status) && !ladder_sim_is_past(status->core->sim)) {
		show_board_pill(status);
		return;
	}
	if (!ladder_sim_is_past(status->core->sim)) {
		set_pill(status, _(pills[state].text), pills[state].class);
		return;
	}
	text = g_strdup_printf(_("PAST · scan %llu"),
			       (unsigned long long)ladder_sim_twin(status->core->sim)->scan);
	set_pill(status, text, "past");
	g_free(text);
}

/* ---- the place ---- */

static char *place_in(GtkTextBuffer *text)
{
	GtkTextIter at;

	gtk_text_buffer_get_iter_at_mark(text, &at, gtk_text_buffer_get_insert(text));
	return g_strdup_printf(_("Line %d · column %d"), gtk_text_iter_get_line(&at) + 1,
			       gtk_text_iter_get_line_offset(&at) + 1);
}

/* In Structured Text F12 goes to the definition. */
static char *keys_in_list(bool st)
{
	GString *text = g_string_new(NULL);
	char *keys = verb_keys_label(VERB_go_coil);

	if (st)
		g_string_append_printf(text, _("%s%s: %s"), "", keys,
				       _(verb_row(VERB_go_definition)->label));
	else
		verb_tell(text, VERB_go_coil);
	g_free(keys);
	verb_tell(text, VERB_show_uses);
	verb_tell(text, VERB_rename);
	verb_tell(text, VERB_next_problem);
	return g_string_free(text, FALSE);
}

/* @place, @zoom, @keys: taken over. */
static void show(struct status *status, char *place, char *zoom, char *keys)
{
	gtk_label_set_text(status->place, place);
	gtk_label_set_text(status->zoom, zoom);
	messages_keys(status->core->messages, keys); /* they get the room that is left */
	g_free(place);
	g_free(zoom);
}

static char *percent(double zoom)
{
	return g_strdup_printf("%d %%", (int)(zoom * 100 + 0.5));
}

static void show_place(struct status *status);

/* The text below a sheet; NULL: none. */
static void follow(struct status *status, GtkTextBuffer *text)
{
	if (text == status->below)
		return;
	if (status->below) {
		g_signal_handlers_disconnect_by_data(status->below, status);
		g_object_remove_weak_pointer(G_OBJECT(status->below), (gpointer *)&status->below);
	}
	status->below = text;
	if (!text)
		return;
	g_object_add_weak_pointer(G_OBJECT(text), (gpointer *)&status->below);
	core_connect(status->core, text, "notify::cursor-position", G_CALLBACK(show_place), status,
		     G_CONNECT_SWAPPED);
}

static void show_place(struct status *status)
{
	struct front *front = status->core->front;
	GtkTextBuffer *text = page_text(front_tab(front));
	LadderTextView *list = front_list(front);
	LadderCanvas *canvas = NULL;

	if (list && !text)
		text = GTK_TEXT_BUFFER(ladder_text_view_buffer(list));
	else
		canvas = front_seen_canvas(front);
	follow(status, list && text != page_text(front_tab(front)) ? text : NULL);
	if (canvas)
		show(status, ladder_canvas_place(canvas), percent(ladder_canvas_zoom(canvas)),
		     ladder_canvas_next_keys(canvas));
	else
		show(status, text ? place_in(text) : g_strdup(""), g_strdup(""),
		     front_list(front) ?
		     keys_in_list(ladder_text_view_is_st(front_list(front))) : g_strdup(""));
}

/* The hint says what is forced at the cursor. A message of a force that has ended is not true any more. */
static void shown(struct status *status)
{
	const int forces = ladder_sim_forces(status->core->sim);

	if (forces == status->forces)
		return;
	show_place(status);
	if (forces < status->forces)
		messages_over(status->core->messages);
	status->forces = forces;
}

/* ---- the checks ---- */

static void show_checked(struct status *status)
{
	const struct diag_list *diags = ladder_document_diags(status->core->document);
	const int warnings = diags->count + diags->dropped - diags->errors;
	char *text;

	if (diags->errors)
		text = g_strdup_printf(ngettext("%d error", "%d errors",
			(unsigned long)diags->errors), diags->errors);
	else if (warnings)
		text = g_strdup_printf(ngettext("%d warning", "%d warnings",
			(unsigned long)warnings), warnings);
	else
		text = g_strdup(_("no problems"));
	gtk_label_set_text(status->checked, text);
	g_free(text);
}

/* ---- life ---- */

void status_init(struct status *status, struct core *core)
{
	status->core = core;
	spoken_text(status->place);
	spoken_text(status->checked);
	spoken_text(status->zoom);
	core_connect(core, core->window, "cursor-moved", G_CALLBACK(show_place), status,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->window, "place-changed", G_CALLBACK(show_place), status,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->document, "checked", G_CALLBACK(show_checked), status,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->sim, "state-changed", G_CALLBACK(show_pill), status,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->sim, "shown", G_CALLBACK(show_pill), status,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->sim, "shown", G_CALLBACK(shown), status, G_CONNECT_SWAPPED);
	core_connect(core, core->link, "state-changed", G_CALLBACK(show_pill), status,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->board, "changed", G_CALLBACK(show_pill), status,
		     G_CONNECT_SWAPPED);
}
