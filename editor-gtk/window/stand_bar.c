/* SPDX-License-Identifier: MIT
 *
 * stand_bar - where the program stands in the middle of a scan: see stand_bar.h.
 */
#include "editor-gtk/window/stand_bar.h"

#include "editor-gtk/document/text_range.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/gtk48/tip.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/front.h"
#include "editor-gtk/window/messages.h"
#include "editor-gtk/window/tabs.h"

#include <string.h>

/* ---- words ---- */

/* An action or a box has line numbers of its own: "line 2 of Main.Count". @line: of the POU, from 0.
 * Caller frees. */
static char *line_words(LadderSim *sim, int pou, int line, const char *name)
{
	LadderDocument *document = ladder_sim_document(sim);
	char *list = ladder_document_list(document, pou), *path, *words;
	struct text_range range;
	bool part;

	text_range_init(&range);
	part = list && text_range_take(&range, list, line) &&
	       ladder_document_project(document)->pou[pou].kind != POU_ACTION;
	path = part ? g_strdup_printf("%s.%s", name, range.name[0] ? range.name : "EXECUTE") :
		      g_strdup(name);
	words = g_strdup_printf(_("line %d of %s"), line + 1 - range.lines, path);
	text_range_clear(&range);
	g_free(list);
	g_free(path);
	return words;
}

/* "line 12 of Fill", "rung 3 of Main"; with the instance of a block. Caller frees. */
static char *place_words(LadderSim *sim, const struct stops_frame *frame)
{
	int pou;
	const int line = ladder_sim_stack_line(sim, frame, &pou);
	char *place = !frame->at.line ?
		g_strdup_printf(_("rung %d of %s"), (int)frame->at.rung, frame->at.pou) :
		line >= 0 ? line_words(sim, pou, line, frame->at.pou) :
		g_strdup_printf(_("line %d of %s"), (int)frame->at.line, frame->at.pou);
	char *whole = frame->instance[0] ?
		g_strdup_printf(_("%s (instance %s)"), place, frame->instance) : g_strdup(place);

	g_free(place);
	return whole;
}

/* Caller frees. */
static char *stand_words(LadderSim *sim, const struct stops_frame *frame, int count)
{
	char *at = place_words(sim, &frame[0]);
	char *by = count > 1 ? place_words(sim, &frame[1]) : NULL;
	char *text = by ? g_strdup_printf(_("Stands before %s, called from %s"), at, by) :
			  g_strdup_printf(_("Stands before %s"), at);

	g_free(at);
	g_free(by);
	return text;
}

/* ---- going there ---- */

/* The focus stays in a dialog. */
static void go(struct stand_bar *bar, const struct stops_frame *frame)
{
	int pou;
	const int line = ladder_sim_stack_line(bar->core->sim, frame, &pou);

	if (pou < 0)
		return;
	if (frame->at.line)
		tabs_go_line(bar->core->tabs, pou, MAX(line, 0));
	else
		tabs_go(bar->core->tabs, pou, (int)frame->at.rung - 1, (int)frame->at.row - 1,
			(int)frame->at.col - 1);
}

static void caller_chosen(GtkButton *button, struct stand_bar *bar)
{
	const int index = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(button), "frame"));
	const struct stops_frame *frame;
	int count;

	gtk_menu_button_popdown(bar->callers);
	frame = ladder_sim_stack(bar->core->sim, &count);
	if (frame && index < count)
		go(bar, &frame[index]);
}

static void list_callers(struct stand_bar *bar, const struct stops_frame *frame, int count)
{
	GtkWidget *child;

	while ((child = gtk_widget_get_first_child(bar->list)))
		gtk_box_remove(GTK_BOX(bar->list), child);
	for (int i = 0; i < count; i++) {
		char *words = place_words(bar->core->sim, &frame[i]);
		GtkWidget *row = gtk_button_new_with_label(words);

		gtk_widget_set_halign(gtk_button_get_child(GTK_BUTTON(row)), GTK_ALIGN_START);
		gtk_widget_add_css_class(row, "flat");
		g_object_set_data(G_OBJECT(row), "frame", GINT_TO_POINTER(i));
		g_signal_connect(row, "clicked", G_CALLBACK(caller_chosen), bar);
		gtk_box_append(GTK_BOX(bar->list), row);
		g_free(words);
	}
	gtk_widget_set_visible(GTK_WIDGET(bar->callers), count > 1);
}

/* ---- what is shown ---- */

static void shown(struct stand_bar *bar)
{
	LadderSim *sim = bar->core->sim;
	const struct twin *twin = ladder_sim_twin(sim);
	const struct stops_frame *frame;
	char *text;
	int count;

	frame = ladder_sim_stack(sim, &count);
	text = frame ? stand_words(sim, frame, count) : NULL;
	gtk_widget_set_visible(bar->bar, text != NULL);
	if (g_strcmp0(text, bar->text) == 0 && (!text || bar->scan == twin->scan)) {
		g_free(text);
		return;
	}
	g_free(bar->text);
	bar->text = text;
	bar->scan = text ? twin->scan : 0;
	if (!text)
		return;
	gtk_label_set_text(bar->label, text);
	list_callers(bar, frame, count);
	messages_tell(bar->core->messages, text);
	go(bar, &frame[0]);
}

/* ---- verbs ---- */

static void on_text(struct stand_bar *bar, enum verb verb)
{
	LadderTextView *list = front_list(bar->core->front);

	if (!list || !ladder_text_view_is_st(list))
		return;
	if (verb == VERB_stop_toggle)
		ladder_text_view_toggle_stop(list);
	else if (verb == VERB_stop_if)
		ladder_text_view_ask_stop(list);
	else if (!ladder_text_view_run_here(list))
		messages_tell(bar->core->messages, _("No statement is in this line or behind it"));
}

bool stand_bar_do(struct stand_bar *bar, enum verb verb)
{
	LadderSim *sim = bar->core->sim;

	switch ((int)verb) {
	case VERB_stop_toggle: case VERB_stop_if: case VERB_stop_to: on_text(bar, verb); return true;
	case VERB_stop_none: ladder_breakpoints_clear_all(ladder_sim_breakpoints(sim)); return true;
	case VERB_stop_go: ladder_sim_step(sim, STOPS_GO); return true;
	case VERB_stop_into: ladder_sim_step(sim, STOPS_INTO); return true;
	case VERB_stop_over: ladder_sim_step(sim, STOPS_OVER); return true;
	case VERB_stop_out: ladder_sim_step(sim, STOPS_OUT); return true;
	default: return false;
	}
}

/* ---- life ---- */

static void add_button(GtkWidget *box, enum verb verb, const char *label)
{
	GtkWidget *button = gtk_button_new_with_label(label);
	char *keys = verb_keys_label(verb);
	char *tip = g_strdup_printf(keys[0] ? "%s (%s)" : "%s", _(verb_row(verb)->label), keys);

	gtk_actionable_set_action_name(GTK_ACTIONABLE(button), verb_row(verb)->action);
	gtk_widget_set_focus_on_click(button, FALSE);
	tip_set(button, tip);
	spoken_name(button, _(verb_row(verb)->label));
	gtk_box_append(GTK_BOX(box), button);
	g_free(tip);
	g_free(keys);
}

static void make_callers(struct stand_bar *bar)
{
	GtkWidget *popover = gtk_popover_new();

	bar->list = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
	gtk_popover_set_child(GTK_POPOVER(popover), bar->list);
	bar->callers = GTK_MENU_BUTTON(gtk_menu_button_new());
	gtk_menu_button_set_label(bar->callers, _("Callers"));
	gtk_menu_button_set_popover(bar->callers, popover);
	tip_set(GTK_WIDGET(bar->callers), _("Callers of this body; choose one to go there"));
}

void stand_bar_init(struct stand_bar *bar, struct core *core, GtkWidget *above)
{
	GtkWidget *box = gtk_widget_get_parent(above);

	bar->core = core;
	bar->bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
	bar->label = GTK_LABEL(gtk_label_new(NULL));
	gtk_label_set_xalign(bar->label, 0);
	gtk_label_set_wrap(bar->label, TRUE);
	gtk_widget_set_hexpand(GTK_WIDGET(bar->label), TRUE);
	make_callers(bar);
	gtk_widget_add_css_class(bar->bar, "stand-bar");
	gtk_box_append(GTK_BOX(bar->bar), gtk_image_new_from_icon_name("media-playback-pause-symbolic"));
	gtk_box_append(GTK_BOX(bar->bar), GTK_WIDGET(bar->label));
	gtk_box_append(GTK_BOX(bar->bar), GTK_WIDGET(bar->callers));
	add_button(bar->bar, VERB_stop_go, _("Continue"));
	add_button(bar->bar, VERB_stop_over, _("Over"));
	add_button(bar->bar, VERB_stop_into, _("Into"));
	add_button(bar->bar, VERB_stop_out, _("Out"));
	gtk_widget_set_visible(bar->bar, FALSE);
	gtk_box_insert_child_after(GTK_BOX(box), bar->bar, gtk_widget_get_prev_sibling(above));
	core_connect(core, core->sim, "shown", G_CALLBACK(shown), bar, G_CONNECT_SWAPPED);
	core_connect(core, core->sim, "state-changed", G_CALLBACK(shown), bar, G_CONNECT_SWAPPED);
}

void stand_bar_clear(struct stand_bar *bar)
{
	g_clear_pointer(&bar->text, g_free);
}
