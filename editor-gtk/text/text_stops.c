/* SPDX-License-Identifier: MIT
 *
 * text_stops - breakpoints on the sheet of Structured Text: see text_stops.h.
 */
#include "editor-gtk/text/text_stops.h"

#include "editor-gtk/kit/gtk48/popover.h"
#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/style.h"
#include "editor-gtk/kit/theme.h"
#include "editor-gtk/sim/sim_stops.h"
#include "editor-gtk/text/stop_gutter.h"

#include "engine/base/name.h"

#include <gtk/gtk.h>
#include <stdlib.h>
#include <string.h>

#define WHY_HEIGHT  42 /* two lines: a popover does not grow while it is open     */
#define WASH_STANDS 0.18f
#define WASH_CALLS  0.08f

/* A breakpoint of the POU. */
struct point {
	GtkTextMark *mark;     /* NULL: its line is not shown                   */
	int line;              /* then: of the POU, or below the shown part     */
	bool below;
	bool condition;
	int reached;           /* line before which it stands; -1: none        */
};

struct text_stops {
	LadderLineValues *values; /* the text                                  */
	GtkSourceView *view;     /* the same                                   */
	GtkTextBuffer *buffer;
	LadderDocument *document;
	const int *pou;
	const struct text_range *part;
	LadderSim *sim;          /* NULL: none                                 */
	GtkSourceGutterRenderer *gutter; /* NULL: the sheet has none           */
	GtkTextTag *stands, *calls;
	GArray *point;           /* of struct point, in the order of the breakpoints */
	char *name;              /* of the POU, as last looked at              */
	bool moves;              /* the sheet itself moves breakpoints         */
	bool holds;              /* nobody else moves them                     */
	GArray *waits;           /* of int: the line that stands, then lines that wait; -1: it
				  * is in another POU                          */
	GtkWidget *popover;      /* the question for a condition; NULL: none   */
	GtkWidget *entry;
	GtkLabel *why;
	int asked;               /* line of the POU                             */
};

/* ---- the POU ---- */

static const struct pou *pou_of(const struct text_stops *stops)
{
	const struct project *project = ladder_document_project(stops->document);

	return project && *stops->pou >= 0 && *stops->pou < project->pou_count ?
	       &project->pou[*stops->pou] : NULL;
}

static char *name_of(const struct text_stops *stops)
{
	const struct pou *pou = pou_of(stops);

	return g_strdup(pou ? project_text(ladder_document_project(stops->document), pou->name) : "");
}

/* A page that only shows a program stands nowhere. */
static bool has_stops(const struct text_stops *stops)
{
	const struct pou *pou = pou_of(stops);

	return stops->sim && pou && (pou->language == LANGUAGE_ST || pou->st) &&
	       ladder_sim_document(stops->sim) == stops->document && !ladder_document_is_fixed(stops->document);
}

/* ---- marks ---- */

static struct point *point_at(const struct text_stops *stops, guint index)
{
	return &g_array_index(stops->point, struct point, index);
}

/* In the POU. */
static int line_of(const struct text_stops *stops, const struct point *point)
{
	GtkTextIter at;

	if (!point->mark)
		return point->line + (point->below ? stops->part->lines +
				      gtk_text_buffer_get_line_count(stops->buffer) : 0);
	gtk_text_buffer_get_iter_at_mark(stops->buffer, &at, point->mark);
	return stops->part->lines + gtk_text_iter_get_line(&at);
}

static void draw(struct text_stops *stops)
{
	if (stops->gutter)
		gtk_widget_queue_draw(GTK_WIDGET(stops->gutter));
}

static void drop_points(struct text_stops *stops)
{
	for (guint i = 0; i < stops->point->len; i++)
		if (point_at(stops, i)->mark)
			gtk_text_buffer_delete_mark(stops->buffer, point_at(stops, i)->mark);
	g_array_set_size(stops->point, 0);
}

static void add_point(struct text_stops *stops, const struct breakpoint *from)
{
	const int count = gtk_text_buffer_get_line_count(stops->buffer);
	const int line = from->line - stops->part->lines;
	struct point point = { .condition = from->condition != NULL };
	GtkTextIter at;

	if (stops->part->kind == RANGE_WHOLE || (line >= 0 && line < count)) {
		gtk_text_buffer_get_iter_at_line(stops->buffer, &at, CLAMP(line, 0, count - 1));
		point.mark = gtk_text_buffer_create_mark(stops->buffer, NULL, &at, FALSE);
	} else {
		point.below = line >= count;
		point.line = point.below ? line - count : from->line;
	}
	point.reached = ladder_sim_reached(stops->sim, *stops->pou, from->line);
	g_array_append_val(stops->point, point);
}

/* Another program runs. */
static void reach(struct text_stops *stops)
{
	for (guint i = 0; has_stops(stops) && i < stops->point->len; i++)
		point_at(stops, i)->reached = ladder_sim_reached(stops->sim, *stops->pou,
								 line_of(stops, point_at(stops, i)));
	draw(stops);
}

static void load(struct text_stops *stops)
{
	LadderBreakpoints *points = stops->sim ? ladder_sim_breakpoints(stops->sim) : NULL;

	if (stops->moves)
		return;
	drop_points(stops);
	for (guint i = 0; has_stops(stops) && i < ladder_breakpoints_count(points); i++)
		if (name_equal(ladder_breakpoints_at(points, i)->pou, stops->name))
			add_point(stops, ladder_breakpoints_at(points, i));
	draw(stops);
}

/* ---- the text changes ---- */

/* Breakpoints go where their marks are. */
static void move_points(struct text_stops *stops)
{
	int *to = g_new(int, stops->point->len + 1);
	char *name = name_of(stops);

	for (guint i = 0; i < stops->point->len; i++)
		to[i] = line_of(stops, point_at(stops, i));
	stops->moves = true;
	if (stops->point->len)
		ladder_breakpoints_move(ladder_sim_breakpoints(stops->sim), stops->name, name, to);
	stops->moves = false;
	g_free(stops->name);
	stops->name = name;
	g_free(to);
	load(stops);
}

static void hold(struct text_stops *stops, bool hold)
{
	if (stops->holds != hold)
		ladder_sim_hold_stops(stops->sim, hold);
	stops->holds = hold;
}

void text_stops_take(struct text_stops *stops)
{
	if (has_stops(stops))
		hold(stops, true);
}

void text_stops_taken(struct text_stops *stops)
{
	if (has_stops(stops))
		move_points(stops);
	hold(stops, false);
}

void text_stops_exchanged(struct text_stops *stops)
{
	load(stops);
}


/* ---- where it stands ---- */

/* @line: of the POU; it may not be shown. */
static void wash(struct text_stops *stops, GtkTextTag *tag, int line)
{
	GtkTextIter start, end;

	line -= stops->part->lines;
	if (line < 0 || line >= gtk_text_buffer_get_line_count(stops->buffer))
		return;
	gtk_text_buffer_get_iter_at_line(stops->buffer, &start, line);
	end = start;
	if (!gtk_text_iter_forward_line(&end))
		gtk_text_buffer_get_end_iter(stops->buffer, &end);
	gtk_text_buffer_apply_tag(stops->buffer, tag, &start, &end);
}

static void colour(struct text_stops *stops)
{
	GdkRGBA color = theme_screen()->color[TOKEN_ACCENT];

	color.alpha = WASH_STANDS;
	g_object_set(stops->stands, "paragraph-background-rgba", &color, NULL);
	color.alpha = WASH_CALLS;
	g_object_set(stops->calls, "paragraph-background-rgba", &color, NULL);
	draw(stops);
}

/* The lines of this text in the stack. */
static GArray *waiting_lines(struct text_stops *stops)
{
	GArray *lines = g_array_new(FALSE, FALSE, sizeof(int));
	const struct stops_frame *frame;
	int count = 0, pou, line;

	frame = has_stops(stops) ? ladder_sim_stack(stops->sim, &count) : NULL;
	for (int i = 0; frame && i < count; i++) {
		line = ladder_sim_stack_line(stops->sim, &frame[i], &pou);
		if (pou != *stops->pou)
			line = -1;
		if (i == 0 || line >= 0)
			g_array_append_val(lines, line);
	}
	return lines;
}

static void show_lines(struct text_stops *stops)
{
	GArray *lines = waiting_lines(stops);
	GtkTextIter start, end;

	if (lines->len == stops->waits->len &&
	    (!lines->len || memcmp(lines->data, stops->waits->data, lines->len * sizeof(int)) == 0)) {
		g_array_unref(lines);
		return;
	}
	g_array_unref(stops->waits);
	stops->waits = lines;
	gtk_text_buffer_get_bounds(stops->buffer, &start, &end);
	gtk_text_buffer_remove_tag(stops->buffer, stops->stands, &start, &end);
	gtk_text_buffer_remove_tag(stops->buffer, stops->calls, &start, &end);
	for (guint i = 0; i < lines->len; i++)
		if (g_array_index(lines, int, i) >= 0)
			wash(stops, i ? stops->calls : stops->stands, g_array_index(lines, int, i));
	draw(stops);
}

/* Each step is shown at once. */
static void show_waiting(struct text_stops *stops)
{
	const bool before = stops->waits->len;

	show_lines(stops);
	if (before || stops->waits->len)
		line_values_tell(stops->values);
}

static unsigned waits_in(const struct text_stops *stops, int line)
{
	unsigned marks = 0;

	for (guint i = 0; i < stops->waits->len; i++)
		if (g_array_index(stops->waits, int, i) == line)
			marks |= i ? STOP_CALLS : STOP_STANDS;
	return marks;
}

static unsigned marks_of(void *context, int line)
{
	const struct text_stops *stops = context;
	unsigned marks;

	line += stops->part->lines;
	marks = waits_in(stops, line);
	for (guint i = 0; i < stops->point->len; i++) {
		const struct point *point = point_at(stops, i);

		if (line_of(stops, point) == line)
			marks |= STOP_SET | (point->condition ? STOP_IF : 0u) |
				 (point->reached < 0 ? STOP_LOST : 0u);
	}
	return marks;
}

/* ---- what a screen reader says ---- */

static const struct breakpoint *breakpoint_in(struct text_stops *stops, int line)
{
	return has_stops(stops) ?
	       ladder_breakpoints_find(ladder_sim_breakpoints(stops->sim), stops->name,
				       stops->part->lines + line) : NULL;
}

char *text_stops_say(struct text_stops *stops, int line)
{
	const struct breakpoint *at = breakpoint_in(stops, line);
	const unsigned marks = marks_of(stops, line);
	const char *stands = marks & STOP_STANDS ? _("the program stands before this line") :
			     marks & STOP_CALLS ? _("the program waits here for what it called") : NULL;
	char *point = !at ? NULL : marks & STOP_LOST ? g_strdup(_("breakpoint that is never reached")) :
		      at->condition ? g_strdup_printf(_("breakpoint, if %s"), at->condition) :
		      g_strdup(_("breakpoint"));
	char *both = stands && point ? g_strdup_printf("%s · %s", stands, point) :
		     stands ? g_strdup(stands) : g_strdup(point);

	g_free(point);
	return both;
}

/* ---- setting ---- */

void text_stops_toggle(struct text_stops *stops, int line)
{
	LadderBreakpoints *points;

	if (!has_stops(stops))
		return;
	points = ladder_sim_breakpoints(stops->sim);
	if (breakpoint_in(stops, line))
		ladder_breakpoints_clear(points, stops->name, stops->part->lines + line);
	else
		ladder_breakpoints_set(points, stops->name, stops->part->lines + line, NULL);
}

static void show_why(struct text_stops *stops, const char *why)
{
	gtk_label_set_text(stops->why, why ? why : "");
	style_wrong(stops->entry, why != NULL);
}

/* The cursor goes to the mistake. */
static void take_condition(struct text_stops *stops)
{
	char *text = g_strstrip(g_strdup(gtk_editable_get_text(GTK_EDITABLE(stops->entry))));
	int column = -1;
	char *why = *text ? sim_stops_check(stops->document, *stops->pou, text, &column) : NULL;

	show_why(stops, why);
	if (why) {
		if (column >= 0 && column <= (int)strlen(text))
			gtk_editable_set_position(GTK_EDITABLE(stops->entry),
						  (int)g_utf8_strlen(text, column));
	} else {
		ladder_breakpoints_set(ladder_sim_breakpoints(stops->sim), stops->name, stops->asked,
				       *text ? text : NULL);
		gtk_popover_popdown(GTK_POPOVER(stops->popover));
	}
	g_free(why);
	g_free(text);
}

static void typed(struct text_stops *stops)
{
	show_why(stops, NULL);
}

static void closed(struct text_stops *stops)
{
	gtk_widget_grab_focus(GTK_WIDGET(stops->view));
}

static GtkWidget *button(struct text_stops *stops, const char *label, GCallback pressed)
{
	GtkWidget *one = gtk_button_new_with_label(label);

	g_signal_connect_swapped(one, "clicked", pressed, stops);
	return one;
}

static void pop_down(struct text_stops *stops)
{
	gtk_popover_popdown(GTK_POPOVER(stops->popover));
}

static void make_question(struct text_stops *stops)
{
	GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 8);
	GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
	GtkWidget *label = gtk_label_new(_("Stop here only while this is TRUE:"));
	GtkWidget *set = button(stops, _("Set"), G_CALLBACK(take_condition));

	stops->entry = gtk_entry_new();
	stops->why = GTK_LABEL(gtk_label_new(""));
	spoken_name(stops->entry, _("Condition of the breakpoint"));
	gtk_widget_add_css_class(stops->entry, "monospace");
	gtk_entry_set_placeholder_text(GTK_ENTRY(stops->entry), _("Level > 50 (empty: always)"));
	gtk_editable_set_width_chars(GTK_EDITABLE(stops->entry), 36);
	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_xalign(stops->why, 0);
	gtk_label_set_yalign(stops->why, 0);
	gtk_widget_set_size_request(GTK_WIDGET(stops->why), -1, WHY_HEIGHT);
	gtk_label_set_wrap(stops->why, TRUE);
	gtk_label_set_max_width_chars(stops->why, 44);
	gtk_widget_add_css_class(GTK_WIDGET(stops->why), "error");
	gtk_widget_add_css_class(set, "suggested-action");
	gtk_widget_set_halign(row, GTK_ALIGN_END);
	gtk_box_append(GTK_BOX(row), button(stops, _("Cancel"), G_CALLBACK(pop_down)));
	gtk_box_append(GTK_BOX(row), set);
	gtk_box_append(GTK_BOX(box), label);
	gtk_box_append(GTK_BOX(box), stops->entry);
	gtk_box_append(GTK_BOX(box), GTK_WIDGET(stops->why));
	gtk_box_append(GTK_BOX(box), row);
	stops->popover = gtk_popover_new();
	gtk_popover_set_child(GTK_POPOVER(stops->popover), box);
	gtk_popover_set_position(GTK_POPOVER(stops->popover), GTK_POS_BOTTOM);
	gtk_widget_set_parent(stops->popover, GTK_WIDGET(stops->view));
	g_signal_connect_swapped(stops->entry, "activate", G_CALLBACK(take_condition), stops);
	g_signal_connect_swapped(stops->entry, "changed", G_CALLBACK(typed), stops);
	g_signal_connect_swapped(stops->popover, "closed", G_CALLBACK(closed), stops);
}

void text_stops_ask(struct text_stops *stops, int line)
{
	const struct breakpoint *at = breakpoint_in(stops, line);
	GdkRectangle where;
	GtkTextIter start;

	if (!has_stops(stops))
		return;
	if (!stops->popover)
		make_question(stops);
	gtk_text_buffer_get_iter_at_line(stops->buffer, &start, line);
	gtk_text_view_get_iter_location(GTK_TEXT_VIEW(stops->view), &start, &where);
	gtk_text_view_buffer_to_window_coords(GTK_TEXT_VIEW(stops->view), GTK_TEXT_WINDOW_WIDGET,
					      where.x, where.y, &where.x, &where.y);
	where.width = MAX(where.width, 1);
	stops->asked = stops->part->lines + line;
	gtk_editable_set_text(GTK_EDITABLE(stops->entry), at && at->condition ? at->condition : "");
	show_why(stops, NULL);
	popover_point(stops->popover, &where);
	gtk_popover_popup(GTK_POPOVER(stops->popover));
	gtk_widget_grab_focus(stops->entry);
}

static void pressed(struct text_stops *stops, int line, gboolean ask)
{
	if (ask)
		text_stops_ask(stops, line);
	else
		text_stops_toggle(stops, line);
}

/* ---- life ---- */

static void show_gutter(struct text_stops *stops)
{
	GtkSourceGutter *gutter = gtk_source_view_get_gutter(stops->view, GTK_TEXT_WINDOW_LEFT);

	if (has_stops(stops) == (stops->gutter != NULL))
		return;
	if (stops->gutter) {
		gtk_source_gutter_remove(gutter, stops->gutter);
		stops->gutter = NULL;
		return;
	}
	stops->gutter = stop_gutter_new(marks_of, stops);
	g_signal_connect_swapped(stops->gutter, "pressed", G_CALLBACK(pressed), stops);
	gtk_source_gutter_insert(gutter, stops->gutter, -100);
}

void text_stops_leave(struct text_stops *stops)
{
	drop_points(stops);
	g_array_set_size(stops->waits, 0);
	g_free(stops->name);
	stops->name = g_strdup("");
}

/* A POU that has another name keeps its breakpoints. */
void text_stops_renew(struct text_stops *stops)
{
	char *name = name_of(stops);

	const bool same = strcmp(name, stops->name) == 0;

	show_gutter(stops);
	if (same) {
		reach(stops);
	} else if (has_stops(stops) && stops->point->len) {
		move_points(stops);
	} else {
		g_free(stops->name);
		stops->name = g_strdup(name);
		load(stops);
	}
	g_free(name);
	show_waiting(stops);
}

void text_stops_set_sim(struct text_stops *stops, LadderSim *sim)
{
	if (stops->sim) {
		g_signal_handlers_disconnect_by_data(stops->sim, stops);
		g_signal_handlers_disconnect_by_data(ladder_sim_breakpoints(stops->sim), stops);
	}
	text_stops_leave(stops);
	g_set_object(&stops->sim, sim);
	text_stops_renew(stops);
	if (!sim)
		return;
	g_signal_connect_swapped(sim, "shown", G_CALLBACK(show_waiting), stops);
	g_signal_connect_swapped(sim, "program-changed", G_CALLBACK(reach), stops);
	g_signal_connect_swapped(sim, "state-changed", G_CALLBACK(show_waiting), stops);
	g_signal_connect_swapped(ladder_sim_breakpoints(sim), "changed", G_CALLBACK(load), stops);
}

struct text_stops *text_stops_new(LadderLineValues *view, LadderDocument *document, const int *pou,
				  const struct text_range *part)
{
	struct text_stops *stops = g_new0(struct text_stops, 1);

	stops->values = view;
	stops->view = GTK_SOURCE_VIEW(view);
	stops->buffer = g_object_ref(gtk_text_view_get_buffer(GTK_TEXT_VIEW(view)));
	stops->document = document;
	stops->pou = pou;
	stops->part = part;
	stops->name = g_strdup("");
	stops->point = g_array_new(FALSE, FALSE, sizeof(struct point));
	stops->waits = g_array_new(FALSE, FALSE, sizeof(int));
	stops->calls = gtk_text_buffer_create_tag(stops->buffer, NULL, NULL);
	stops->stands = gtk_text_buffer_create_tag(stops->buffer, NULL, NULL);
	colour(stops);
	theme_call(stops, G_CALLBACK(colour));
	return stops;
}

void text_stops_free(struct text_stops *stops)
{
	if (!stops)
		return;
	hold(stops, false);
	theme_leave(stops);
	if (stops->sim) {
		g_signal_handlers_disconnect_by_data(stops->sim, stops);
		g_signal_handlers_disconnect_by_data(ladder_sim_breakpoints(stops->sim), stops);
	}
	if (stops->gutter)
		gtk_source_gutter_remove(gtk_source_view_get_gutter(stops->view, GTK_TEXT_WINDOW_LEFT),
					 stops->gutter);
	g_clear_pointer(&stops->popover, gtk_widget_unparent);
	g_clear_object(&stops->sim);
	g_array_unref(stops->point);
	g_array_unref(stops->waits);
	g_object_unref(stops->buffer);
	g_free(stops->name);
	g_free(stops);
}
