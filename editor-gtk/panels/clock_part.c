/* SPDX-License-Identifier: MIT
 *
 * clock_part - see clock_part.h.
 */
#include "editor-gtk/panels/clock_part.h"

#include "editor-gtk/kit/gtk48/spoken.h"
#include "editor-gtk/kit/i18n.h"

#include "online/board_time.h"

#include <adwaita.h>
#include <string.h>

#define SAME_NS G_GINT64_CONSTANT(1000000000) /* so far clocks count as the same */

struct clock {
	GtkWidget *part, *set;
	GtkLabel *now, *why;
	LadderBoardLink *link;
	gint64 asked_us;     /* monotonic, when the request was sent          */
	gint64 half_ns;      /* of the way there and back                     */
	bool asking, none;   /* @none: this board tells no time               */
	bool anyway;         /* the request sets a clock that a server keeps  */
};

static void clock_free(gpointer pointer)
{
	struct clock *clock = pointer;

	g_signal_handlers_disconnect_by_data(clock->link, clock);
	g_object_unref(clock->link);
	g_free(clock);
}

/* "3 s behind this computer". Caller frees. */
static char *ahead_text(gint64 ahead_ns)
{
	const gint64 s = ABS(ahead_ns) / G_GINT64_CONSTANT(1000000000);
	char *span, *text;

	if (ABS(ahead_ns) <= SAME_NS)
		return g_strdup(_("as on this computer"));
	span = s < 120 ? g_strdup_printf(_("%d s"), (int)s) :
	       s < 7200 ? g_strdup_printf(_("%d min"), (int)(s / 60)) :
	       s < 172800 ? g_strdup_printf(_("%d h"), (int)(s / 3600)) :
			    g_strdup_printf(_("%d days"), (int)(s / 86400));
	text = g_strdup_printf(ahead_ns > 0 ? _("%s ahead of this computer") :
					      _("%s behind this computer"), span);
	g_free(span);
	return text;
}

static void show_time(struct clock *clock, const struct board_time *time, gint64 ahead_ns)
{
	static const char *const sync[] = { N_("not synchronised"), N_("kept by a time server"), NULL };
	char *ahead = ahead_text(ahead_ns), *zone = g_utf8_make_valid(time->zone, -1), *text;
	const char *kept = time->sync < SYNC_UNKNOWN ? _(sync[time->sync]) : "";
	char when[20];

	board_time_print(time->time_ns, time->zone_s, when);
	text = g_strdup_printf("%s %s · %s%s%s", when, zone, ahead, *kept ? " · " : "", kept);
	if (strcmp(gtk_label_get_text(clock->now), text) != 0)
		gtk_label_set_text(clock->now, text);
	g_free(ahead);
	g_free(zone);
	g_free(text);
}

static void show(struct clock *clock)
{
	const bool on = ladder_board_link_state(clock->link) == LINK_CONNECTED && !clock->none &&
			ladder_board_link_may(clock->link, SERVICE_TIME);
	const char *why = ladder_board_link_needs(clock->link, ROLE_ENG);

	gtk_widget_set_visible(clock->part, on && *gtk_label_get_text(clock->now));
	gtk_widget_set_sensitive(clock->set, !why);
	gtk_widget_set_tooltip_text(clock->set, why);
	gtk_widget_set_visible(GTK_WIDGET(clock->why), *gtk_label_get_text(clock->why) != '\0');
}

/* What a request was answered. */
static void take(struct clock *clock, struct board_answer *answer)
{
	struct board_time time;

	clock->half_ns = (g_get_monotonic_time() - clock->asked_us) * 500;
	board_time_take(&answer->body, &time);
	if (!answer->body.failed)
		show_time(clock, &time, time.time_ns + clock->half_ns - g_get_real_time() * 1000);
	show(clock);
}

static void told(gpointer data, struct board_answer *answer)
{
	struct clock *clock = data;

	clock->asking = false;
	if (answer->end == DESK_GOOD)
		take(clock, answer);
	clock->none = answer->end == DESK_REFUSED && answer->refusal == REFUSAL_NO_SERVICE;
	show(clock);
}

static void ask(struct clock *clock)
{
	struct wire_writer fields;

	if (clock->asking || clock->none || !gtk_widget_get_mapped(gtk_widget_get_parent(clock->part)) ||
	    !ladder_board_link_may(clock->link, SERVICE_TIME))
		return;
	clock->asking = true;
	clock->asked_us = g_get_monotonic_time();
	fields = ladder_board_link_begin(clock->link);
	wire_put_u8(&fields, 0);
	wire_put_i64(&fields, 0);
	ladder_board_link_send(clock->link, SERVICE_TIME, &fields, clock->part, told, clock);
}

static void link_changed(struct clock *clock)
{
	if (ladder_board_link_state(clock->link) != LINK_CONNECTED) {
		clock->none = clock->asking = false;
		gtk_label_set_text(clock->now, "");
		gtk_label_set_text(clock->why, "");
	}
	show(clock);
}

/* ---- setting ---- */

static void question(struct clock *clock, const char *heading, const char *body, bool anyway);

static void was_set(gpointer data, struct board_answer *answer)
{
	struct clock *clock = data;

	clock->asking = false;
	if (answer->end == DESK_REFUSED && answer->refusal == REFUSAL_TIME_KEPT) {
		question(clock, _("Set the clock all the same?"),
			 _("A time server sets the clock of this board and will undo your change."), true);
		return;
	}
	gtk_label_set_text(clock->why, answer->text);
	if (answer->end == DESK_GOOD)
		take(clock, answer);
	show(clock);
}

static void set_now(struct clock *clock)
{
	struct wire_writer fields = ladder_board_link_begin(clock->link);

	clock->asking = true;
	clock->asked_us = g_get_monotonic_time();
	wire_put_u8(&fields, clock->anyway ? 2 : 1);
	wire_put_i64(&fields, g_get_real_time() * 1000 + clock->half_ns);
	ladder_board_link_send(clock->link, SERVICE_TIME, &fields, clock->part, was_set, clock);
}

static void answered(GtkWidget *part, const char *answer)
{
	if (strcmp(answer, "set") == 0)
		set_now(g_object_get_data(G_OBJECT(part), "clock"));
}

static void question(struct clock *clock, const char *heading, const char *body, bool anyway)
{
	GtkWindow *window = GTK_WINDOW(gtk_widget_get_root(clock->part));
	GtkWidget *dialog = adw_message_dialog_new(window, heading, body);
	AdwMessageDialog *ask_first = ADW_MESSAGE_DIALOG(dialog);

	clock->anyway = anyway;
	adw_message_dialog_add_responses(ask_first, "cancel", _("Cancel"), "set", _("Set clock"), NULL);
	adw_message_dialog_set_response_appearance(ask_first, "set", ADW_RESPONSE_SUGGESTED);
	adw_message_dialog_set_default_response(ask_first, "set");
	adw_message_dialog_set_close_response(ask_first, "cancel");
	g_signal_connect_object(dialog, "response", G_CALLBACK(answered), clock->part, G_CONNECT_SWAPPED);
	gtk_window_present(GTK_WINDOW(dialog));
}

static void pressed(struct clock *clock)
{
	char *heading = g_strdup_printf(_("Set the clock of “%s”?"), ladder_board_link_board(clock->link));

	question(clock, heading,
		 _("The board gets the date and time of this computer. Its program goes on, and no timer moves."), false);
	g_free(heading);
}

/* ---- life ---- */

static GtkLabel *line(GtkWidget *part)
{
	GtkWidget *label = gtk_label_new("");

	gtk_label_set_xalign(GTK_LABEL(label), 0);
	gtk_label_set_wrap(GTK_LABEL(label), TRUE);
	gtk_label_set_selectable(GTK_LABEL(label), TRUE);
	gtk_box_append(GTK_BOX(part), label);
	return GTK_LABEL(label);
}

GtkWidget *ladder_clock_part_new(LadderBoardLink *link)
{
	struct clock *clock = g_new0(struct clock, 1);
	GtkWidget *part = gtk_box_new(GTK_ORIENTATION_VERTICAL, 8), *heading = gtk_label_new(_("Clock"));

	clock->part = part;
	clock->link = g_object_ref(link);
	gtk_label_set_xalign(GTK_LABEL(heading), 0);
	gtk_widget_add_css_class(heading, "heading");
	gtk_box_append(GTK_BOX(part), heading);
	clock->now = line(part);
	spoken_name(GTK_WIDGET(clock->now), _("Clock"));
	clock->why = line(part);
	gtk_widget_add_css_class(GTK_WIDGET(clock->why), "error");
	clock->set = gtk_button_new_with_label(_("Set clock…"));
	gtk_widget_set_halign(clock->set, GTK_ALIGN_START);
	gtk_box_append(GTK_BOX(part), clock->set);
	g_signal_connect_swapped(clock->set, "clicked", G_CALLBACK(pressed), clock);
	g_object_set_data_full(G_OBJECT(part), "clock", clock, clock_free);
	g_signal_connect_swapped(link, "status", G_CALLBACK(ask), clock);
	g_signal_connect_swapped(link, "state-changed", G_CALLBACK(link_changed), clock);
	show(clock);
	return part;
}
