/* SPDX-License-Identifier: MIT
 *
 * alarm_view - asks the board for its list, or reads the blocks of the simulation.
 */
#include "editor-gtk/panels/alarm_view.h"

#include "editor-gtk/document/panel.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_value.h"

#include "online/alarms.h"

#include <stdlib.h>
#include <string.h>

#define ACTS_MOST 128 /* of one ladder_sim_act_all()                           */

/* Columns of a row; the first text tells rows apart. */
enum { COL_NUMBER, COL_CAME, COL_STATE, COL_CLASS, COL_BLOCK, COL_MESSAGE, COL_WENT,
       COL_ACKED, COL_TIMES };

struct _LadderAlarmView {
	GtkWidget parent_instance;
	GtkWidget *box, *ack, *ack_all;
	GtkLabel *summary, *empty;
	GtkStack *stack;
	GtkMenuButton *columns;
	struct panel_list list;
	LadderSim *sim;
	LadderBoardLink *link;
	struct alarm_watch *watch;   /* of the program that is simulated; NULL: not known */
	GArray *shown, *asked;       /* of struct alarm_row; @asked: pages so far          */
	guint32 next;                /* number of the first row that was not asked for     */
	guint32 lost;                /* alarms that found no room on the board             */
	bool asking, none;           /* @none: this board keeps no list                    */
	char *refused;               /* why the last acknowledgement did nothing; NULL     */
};
G_DEFINE_TYPE(LadderAlarmView, ladder_alarm_view, GTK_TYPE_WIDGET)

static bool is_online(LadderAlarmView *view)
{
	return ladder_board_link_state(view->link) == LINK_CONNECTED;
}

/* ---- texts ---- */

static const char *state_text(uint8_t state)
{
	static const char *const text[] = {
		[ALARM_NORMAL] = N_("gone"), [ALARM_UNACK] = N_("active"),
		[ALARM_ACKED] = N_("active, acknowledged"),
		[ALARM_GONE_UNACK] = N_("gone, not acknowledged"), [ALARM_EVENT] = N_("event"),
	};

	return state <= ALARM_EVENT ? _(text[state]) : "?";
}

static const char *class_text(uint8_t class)
{
	static const char *const text[] = { N_("system"), N_("error"), N_("warning"), N_("notice") };

	return class < G_N_ELEMENTS(text) ? _(text[class]) : "?";
}

/* Texts come from programs: what is not printable is a question mark. */
static char *printable(const char *text)
{
	char *out = g_utf8_make_valid(text, -1);

	for (char *at = out; *at; at++)
		if ((guchar)*at < ' ' || *at == 127)
			*at = '?';
	return out;
}

static char *time_text(LadderAlarmView *view, gint64 ns)
{
	GDateTime *when;
	char text[32], *out;

	if (!ns)
		return g_strdup("");
	if (!is_online(view)) {
		live_time_print(ns, text, sizeof(text));
		return g_strdup(text);
	}
	when = g_date_time_new_from_unix_local(ns / 1000000000);
	out = when ? g_date_time_format(when, "%F %T") : g_strdup("?");
	g_clear_pointer(&when, g_date_time_unref);
	return out;
}

/* ---- rows ---- */

static LadderPanelRow *row_new(LadderAlarmView *view, const struct alarm_row *alarm)
{
	LadderPanelRow *row = ladder_panel_row_new();
	char *who = printable(alarm->who), *acked = time_text(view, alarm->acked_ns);

	row->number = alarm->number;
	row->tone = alarm->state == ALARM_UNACK ? PANEL_ERROR :
		    alarm->state == ALARM_ACKED || alarm->state == ALARM_GONE_UNACK ?
		    PANEL_WARNING : PANEL_PLAIN;
	row->text[COL_NUMBER] = g_strdup_printf("%u", (guint)alarm->number);
	row->text[COL_CAME] = time_text(view, alarm->came_ns);
	row->text[COL_STATE] = g_strdup(state_text(alarm->state));
	row->text[COL_CLASS] = g_strdup(class_text(alarm->class));
	row->text[COL_BLOCK] = printable(alarm->name);
	/* the board's own in the language of this desk */
	row->text[COL_MESSAGE] = printable(alarm->class ? alarm->text : said(alarm->text));
	row->text[COL_WENT] = alarm->state == ALARM_EVENT ? g_strdup("") :
			       time_text(view, alarm->went_ns);
	row->text[COL_ACKED] = *who ? g_strdup_printf("%s %s", acked, who) : g_strdup(acked);
	row->text[COL_TIMES] = g_strdup_printf("%u", (guint)alarm->times);
	row->note = g_strdup(row->text[COL_STATE]);
	row->spoken = g_strdup_printf("%s, %s, %s: %s", row->text[COL_STATE],
				      row->text[COL_CLASS], row->text[COL_BLOCK],
				      row->text[COL_MESSAGE]);
	g_free(who);
	g_free(acked);
	return row;
}

static const struct alarm_row *selected(LadderAlarmView *view)
{
	const LadderPanelRow *row = panel_list_row(&view->list);

	for (guint i = 0; row && i < view->shown->len; i++) {
		const struct alarm_row *alarm = &g_array_index(view->shown, struct alarm_row, i);

		if (alarm->number == row->number)
			return alarm;
	}
	return NULL;
}

static guint count_waiting(LadderAlarmView *view, guint *active)
{
	guint waiting = 0;

	*active = 0;
	for (guint i = 0; i < view->shown->len; i++) {
		const struct alarm_row *row = &g_array_index(view->shown, struct alarm_row, i);

		waiting += alarm_waits(row);
		*active += row->state == ALARM_UNACK || row->state == ALARM_ACKED;
	}
	return waiting;
}

static void show_buttons(LadderAlarmView *view)
{
	const struct alarm_row *row = selected(view);
	guint active;
	const guint waiting = count_waiting(view, &active);
	const char *why = is_online(view) ? ladder_board_link_why_not(view->link, SERVICE_ACK) :
			  ladder_sim_why_not(view->sim, SIM_WISH_SET);

	gtk_widget_set_sensitive(view->ack, !why && row && alarm_waits(row));
	gtk_widget_set_sensitive(view->ack_all, !why && waiting);
	gtk_widget_set_tooltip_text(view->ack, why);
	gtk_widget_set_tooltip_text(view->ack_all, why);
}

static void show_summary(LadderAlarmView *view)
{
	guint active;
	const guint waiting = count_waiting(view, &active);
	const bool on = is_online(view) || ladder_sim_is_on(view->sim);
	char *text = g_strdup_printf(view->lost && is_online(view) ?
		_("%u active, %u to acknowledge. Left out because the list is full: %u. "
		  "An alarm makes room when it is over and acknowledged") :
		_("%u active, %u to acknowledge"), active, waiting, (guint)view->lost);

	gtk_label_set_text(view->summary, view->refused ? view->refused :
			   on && !view->none ? text : "");
	g_free(text);
	gtk_label_set_text(view->empty, view->none && is_online(view) ?
		_("This board keeps no list of alarms") : on ? _("No alarms") :
		_("Start the simulation or connect to a board to see alarms"));
	gtk_stack_set_visible_child_name(view->stack, view->shown->len ? "list" : "none");
	show_buttons(view);
}

static bool is_number(const LadderPanelRow *row, gconstpointer number)
{
	return row->number == *(const gint64 *)number;
}

/* The newest first. @rows: taken over. */
static void show_rows(LadderAlarmView *view, GArray *rows)
{
	const LadderPanelRow *before = panel_list_row(&view->list);
	const gint64 number = before ? before->number : -1;
	GPtrArray *out;

	if (rows->len == view->shown->len &&
	    (!rows->len || memcmp(rows->data, view->shown->data,
				  rows->len * sizeof(struct alarm_row)) == 0)) {
		g_array_unref(rows);
		return;
	}
	g_array_unref(view->shown);
	view->shown = rows;
	out = g_ptr_array_new_with_free_func(g_object_unref);
	for (guint i = rows->len; i-- > 0;)
		g_ptr_array_add(out, row_new(view, &g_array_index(rows, struct alarm_row, i)));
	panel_list_update(&view->list, out);
	g_ptr_array_unref(out);
	before = panel_list_row(&view->list);
	if (number >= 0 && (!before || before->number != number))
		panel_list_select(&view->list, is_number, &number);
	show_summary(view);
}

static GArray *rows_new(void)
{
	return g_array_new(FALSE, TRUE, sizeof(struct alarm_row));
}

/* ---- the simulation ---- */

static void copy_text(char *out, const struct word_text *text)
{
	memcpy(out, text->text, text->length < WORD_TEXT ? text->length : WORD_TEXT);
}

#define TAKE(fb) do { \
	const struct fb *block = at; \
	out->state = block->STATE <= ALARM_GONE_UNACK ? block->STATE : 0; \
	out->times = block->COUNT; \
	out->class = block->CLASS; \
	out->came_ns = block->came, out->went_ns = block->went, out->acked_ns = block->acked; \
	copy_text(out->text, &block->MSG); \
} while (0)

/* False: it never came. */
static bool take_row(const struct alarm_block *from, const uint8_t *memory, struct alarm_row *out)
{
	const void *at = memory + from->at;
	const struct fb_EVENT *event = at;

	memset(out, 0, sizeof(*out));
	memcpy(out->name, from->name, sizeof(out->name));
	if (from->kind == ALARM_OF_CONDITION) {
		TAKE(fb_ALARM);
	} else if (from->kind == ALARM_OF_LIMIT) {
		TAKE(fb_ALARM_LIMIT);
	} else {
		out->state = ALARM_EVENT;
		out->times = event->COUNT;
		out->class = event->CLASS;
		out->came_ns = event->came;
		copy_text(out->text, &event->MSG);
	}
	if (out->class != 1 && out->class != 3)
		out->class = 2;
	return out->times != 0;
}

static int by_time(gconstpointer left, gconstpointer right)
{
	const struct alarm_row *a = left, *b = right;

	return a->came_ns != b->came_ns ? (a->came_ns > b->came_ns) - (a->came_ns < b->came_ns) :
	       (a->number > b->number) - (a->number < b->number);
}

static void look_at_sim(LadderAlarmView *view)
{
	const struct twin *twin = ladder_sim_twin(view->sim);
	const struct image *image = twin ? &twin->resource.image : NULL;
	GArray *rows = rows_new();

	if (image && (!view->watch || view->watch->program != image->program)) {
		free(view->watch);
		view->watch = alarm_watch_new(image);
	}
	for (guint i = 0; image && view->watch && i < view->watch->count; i++) {
		struct alarm_row row;

		if (!take_row(&view->watch->block[i], image->memory, &row))
			continue;
		row.number = i + 1;
		g_array_append_val(rows, row);
	}
	g_array_sort(rows, by_time);
	show_rows(view, rows);
}

/* A board is on show: its own list is asked for. */
static void look(LadderAlarmView *view)
{
	if (!is_online(view) && gtk_widget_get_mapped(GTK_WIDGET(view)))
		look_at_sim(view);
}

static void state_changed(LadderAlarmView *view)
{
	look(view);
	show_summary(view);
}

static void forget(LadderAlarmView *view)
{
	g_clear_pointer(&view->watch, free);
	look(view);
}

static void ack_in_sim(LadderAlarmView *view, const struct alarm_row *only)
{
	struct act acts[ACTS_MOST];
	int count = 0;

	for (guint i = 0; view->watch && i < view->shown->len && count < ACTS_MOST; i++) {
		const struct alarm_row *row = &g_array_index(view->shown, struct alarm_row, i);

		if (!alarm_waits(row) || (only && only != row) || row->number > view->watch->count)
			continue;
		acts[count++] = (struct act){
			.kind = ACT_SET, .value.i = 1,
			.at = alarm_block_ack(&view->watch->block[row->number - 1]),
		};
	}
	ladder_sim_act_all(view->sim, acts, count);
}

/* ---- a board ---- */

static void ask(LadderAlarmView *view);

static void answered(gpointer data, struct board_answer *answer)
{
	LadderAlarmView *view = data;
	guint16 count = 0;

	view->asking = false;
	view->none = answer->end == DESK_REFUSED && answer->refusal == REFUSAL_NO_SERVICE;
	if (answer->end == DESK_GOOD) {
		wire_u32(&answer->body);
		wire_u32(&answer->body);
		view->lost = wire_u32(&answer->body);
		wire_u32(&answer->body);
		count = wire_u16(&answer->body);
	}
	for (guint16 i = 0; i < count; i++) {
		struct alarm_row row;

		alarm_read(&answer->body, &row);
		if (answer->body.failed || row.number < view->next)
			break;
		view->next = row.number + 1;
		g_array_append_val(view->asked, row);
	}
	if (count && !answer->body.failed && view->asked->len < ALARM_ROWS) {
		ask(view);
		return;
	}
	show_rows(view, g_steal_pointer(&view->asked));
	show_summary(view);
	view->asked = rows_new();
	view->next = 1;
}

static void ask(LadderAlarmView *view)
{
	struct wire_writer fields;

	if (view->asking || !ladder_board_link_may(view->link, SERVICE_ALARMS))
		return;
	view->asking = true;
	fields = ladder_board_link_begin(view->link);
	wire_put_u32(&fields, view->next);
	ladder_board_link_send(view->link, SERVICE_ALARMS, &fields, view, answered, view);
}

static void status_came(LadderAlarmView *view)
{
	if (is_online(view) && gtk_widget_get_mapped(GTK_WIDGET(view)))
		ask(view);
}

static void acked(gpointer data, struct board_answer *answer)
{
	LadderAlarmView *view = data;

	if (answer->end != DESK_GOOD) {
		g_free(view->refused);
		view->refused = g_strdup(answer->text);
		show_summary(view);
	} else {
		ask(view);
	}
}

static void link_changed(LadderAlarmView *view)
{
	view->asking = view->none = false;
	view->next = 1;
	view->lost = 0;
	g_clear_pointer(&view->refused, g_free);
	g_array_set_size(view->asked, 0);
	show_rows(view, rows_new());
	state_changed(view);
	status_came(view);
}

/* ---- acknowledging ---- */

/* @row NULL: all. */
static void acknowledge(LadderAlarmView *view, const struct alarm_row *row)
{
	struct wire_writer fields;

	g_clear_pointer(&view->refused, g_free);
	if (!is_online(view)) {
		ack_in_sim(view, row);
		return;
	}
	fields = ladder_board_link_begin(view->link);
	wire_put_u32(&fields, row ? row->number : 0);
	ladder_board_link_send(view->link, SERVICE_ACK, &fields, view, acked, view);
}

static void ack_pressed(LadderAlarmView *view)
{
	const struct alarm_row *row = selected(view);

	if (row && alarm_waits(row) && gtk_widget_get_sensitive(view->ack))
		acknowledge(view, row);
}

static void ack_all_pressed(LadderAlarmView *view)
{
	acknowledge(view, NULL);
}

static void activated(LadderAlarmView *view)
{
	ack_pressed(view);
}

/* ---- the widget ---- */

static void map(GtkWidget *widget)
{
	LadderAlarmView *view = LADDER_ALARM_VIEW(widget);

	GTK_WIDGET_CLASS(ladder_alarm_view_parent_class)->map(widget);
	look(view);
	status_came(view);
}

static void dispose(GObject *object)
{
	LadderAlarmView *view = LADDER_ALARM_VIEW(object);

	g_clear_pointer(&view->box, gtk_widget_unparent);
	panel_list_clear(&view->list);
	g_clear_pointer(&view->watch, free);
	g_clear_pointer(&view->shown, g_array_unref);
	g_clear_pointer(&view->asked, g_array_unref);
	g_clear_pointer(&view->refused, g_free);
	g_clear_object(&view->sim);
	g_clear_object(&view->link);
	G_OBJECT_CLASS(ladder_alarm_view_parent_class)->dispose(object);
}

static void ladder_alarm_view_class_init(LadderAlarmViewClass *class)
{
	GtkWidgetClass *widget = GTK_WIDGET_CLASS(class);

	G_OBJECT_CLASS(class)->dispose = dispose;
	widget->map = map;
	gtk_widget_class_set_layout_manager_type(widget, GTK_TYPE_BIN_LAYOUT);
	gtk_widget_class_set_template_from_resource(widget, "/org/rungboard/Editor/ui/alarm_view.ui");
	gtk_widget_class_bind_template_child(widget, LadderAlarmView, box);
	gtk_widget_class_bind_template_child(widget, LadderAlarmView, ack);
	gtk_widget_class_bind_template_child(widget, LadderAlarmView, ack_all);
	gtk_widget_class_bind_template_child(widget, LadderAlarmView, summary);
	gtk_widget_class_bind_template_child(widget, LadderAlarmView, empty);
	gtk_widget_class_bind_template_child(widget, LadderAlarmView, stack);
	gtk_widget_class_bind_template_child(widget, LadderAlarmView, columns);
	panel_bind_list(widget, LadderAlarmView);
	gtk_widget_class_bind_template_callback_full(widget, "ack_pressed", G_CALLBACK(ack_pressed));
	gtk_widget_class_bind_template_callback_full(widget, "ack_all_pressed",
						     G_CALLBACK(ack_all_pressed));
	gtk_widget_class_bind_template_callback_full(widget, "activated", G_CALLBACK(activated));
}

/* In a narrow list the message stays whole: the icon tells the state, too. */
static void add_columns(LadderAlarmView *view)
{
	static const int leaving[] = { COL_ACKED, COL_WENT, COL_TIMES, COL_CLASS, COL_STATE };

	panel_list_column(&view->list, "", COL_STATE, PANEL_ICON, 0);
	panel_list_column(&view->list, _("Came"), COL_CAME, PANEL_NUMBER, 150);
	panel_list_column(&view->list, _("Message"), COL_MESSAGE, PANEL_EXPAND, 260);
	panel_list_column(&view->list, _("Block"), COL_BLOCK, 0, 120);
	panel_list_column(&view->list, _("State"), COL_STATE, 0, 110);
	panel_list_column(&view->list, _("Class"), COL_CLASS, 0, 80);
	panel_list_column(&view->list, _("Went"), COL_WENT, 0, 150);
	panel_list_column(&view->list, _("Acknowledged"), COL_ACKED, 0, 150);
	panel_list_column(&view->list, _("Times"), COL_TIMES, 0, 60);
	panel_list_may_leave(&view->list, leaving, G_N_ELEMENTS(leaving), view->columns);
}

static void ladder_alarm_view_init(LadderAlarmView *view)
{
	view->shown = rows_new();
	view->asked = rows_new();
	view->next = 1;
	gtk_widget_init_template(GTK_WIDGET(view));
	panel_list_init(&view->list, view->list.view);
	add_columns(view);
	panel_list_follow(&view->list, G_CALLBACK(show_buttons), view);
}

GtkWidget *ladder_alarm_view_new(LadderSim *sim, LadderBoardLink *link)
{
	LadderAlarmView *view = g_object_new(LADDER_TYPE_ALARM_VIEW, NULL);

	view->sim = g_object_ref(sim);
	view->link = g_object_ref(link);
	g_signal_connect_object(sim, "shown", G_CALLBACK(look), view, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "state-changed", G_CALLBACK(state_changed), view, G_CONNECT_SWAPPED);
	g_signal_connect_object(sim, "program-changed", G_CALLBACK(forget), view, G_CONNECT_SWAPPED);
	g_signal_connect_object(link, "state-changed", G_CALLBACK(link_changed), view,
				G_CONNECT_SWAPPED);
	g_signal_connect_object(link, "status", G_CALLBACK(status_came), view, G_CONNECT_SWAPPED);
	show_summary(view);
	return GTK_WIDGET(view);
}
