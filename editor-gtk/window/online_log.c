/* SPDX-License-Identifier: MIT
 *
 * online_log - asks the board for its events after each status and logs them.
 */
#include "editor-gtk/window/online_log.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/window/messages.h"

#include "online/event.h"

#include <string.h>

#define PAST_MOST 50 /* events from before the connection that are logged     */
#define KEPT_MOST 2048u /* events of all pages: as many as a board keeps        */

/* What a person did has a user. */
static enum log_kind kind_of(const struct event *event)
{
	if (event->id == EVENT_REFUSED)
		return LOG_COMMUNICATION;
	return *event->user ? LOG_OPERATOR : LOG_SYSTEM;
}

/* board_bar logs that a program of this editor starts, runs, stops, fails and ends. */
static bool board_bar_logs(const struct online_log *log, const struct event *event)
{
	return event->id >= EVENT_START && event->id <= EVENT_RUN && core_is_own(log->core);
}

/* As the user of this session is called there, if that is known. */
static bool is_own_user(const struct online_log *log, const struct event *event)
{
	const char *where = ladder_board_link_where(log->core->link);
	const char *at = where && !g_str_has_prefix(where, "unix:") ? strrchr(where, '@') : NULL;
	const gsize len = at ? (gsize)(at - where) : 0;

	return !*event->user || strcmp(event->user, g_get_user_name()) == 0 ||
	       (at && strncmp(event->user, where, len) == 0 && strlen(event->user) == len);
}

/* No person did that: the views needed the program. */
static bool is_own_read(const struct online_log *log, const struct event *event)
{
	return event->id == EVENT_UPLOAD && is_own_user(log, event) &&
	       ladder_board_values_took_read(log->core->values);
}

static void log_read(struct online_log *log, const struct event *event)
{
	char *line = g_strdup_printf(_("%s: its program was read to show values"),
				     ladder_board_link_board(log->core->link));

	messages_log_at(log->core->messages, LOG_COMMUNICATION, event->time_ns / 1000, line);
	g_free(line);
}

static void log_event(struct online_log *log, const struct event *event)
{
	const char *text = event_text(event->id);
	char said_text[512], *line, *user = g_utf8_make_valid(event->user, -1);

	event_fill(event, text ? said(text) : NULL, said_text, sizeof(said_text));
	line = *user ?
		g_strdup_printf(_("%s: %s: %s"), ladder_board_link_board(log->core->link), user,
				said_text) :
		g_strdup_printf(_("%s: %s"), ladder_board_link_board(log->core->link), said_text);
	messages_log_at(log->core->messages, kind_of(event), event->time_ns / 1000, line);
	g_free(line);
	g_free(user);
}

/* Those of before the last connection are in the log already. */
static void log_all(struct online_log *log)
{
	guint first = 0, reads = log->events->len;

	while (reads && is_own_read(log, &g_array_index(log->events, struct event, reads - 1)))
		reads--;
	if (log->past && log->events->len > PAST_MOST)
		first = log->events->len - PAST_MOST;
	for (guint i = first; i < log->events->len; i++) {
		const struct event *event = &g_array_index(log->events, struct event, i);

		if (i >= reads)
			log_read(log, event);
		else if (!board_bar_logs(log, event) &&
			 (!log->past || event->time_ns > log->last_ns))
			log_event(log, event);
	}
	log->past = false;
	if (log->events->len)
		log->last_ns = g_array_index(log->events, struct event,
					     log->events->len - 1).time_ns;
	g_array_set_size(log->events, 0);
}

static void ask(struct online_log *log);

static void answered(gpointer data, struct board_answer *answer)
{
	struct online_log *log = data;
	const uint16_t count = answer->end == DESK_GOOD ? wire_u16(&answer->body) : 0;

	log->asking = false;
	for (uint16_t i = 0; i < count; i++) {
		struct event event;

		event_take(&answer->body, &event);
		if (answer->body.failed || event.seq < log->next)
			break;
		log->next = event.seq + 1;
		g_array_append_val(log->events, event);
	}
	if (log->events->len > KEPT_MOST)
		g_array_remove_range(log->events, 0, log->events->len - KEPT_MOST);
	if (count && !answer->body.failed)
		ask(log); /* the next page */
	else
		log_all(log);
}

static void ask(struct online_log *log)
{
	LadderBoardLink *link = log->core->link;
	struct wire_writer fields;

	if (log->asking || !ladder_board_link_may(link, SERVICE_EVENTS))
		return;
	log->asking = true;
	fields = ladder_board_link_begin(link);
	wire_put_u32(&fields, log->next);
	ladder_board_link_send(link, SERVICE_EVENTS, &fields, log->core->window, answered, log);
}

/* The numbers of a board that began anew may begin anew, too. */
static void state_changed(struct online_log *log)
{
	LadderBoardLink *link = log->core->link;

	if (ladder_board_link_state(link) == LINK_CONNECTED)
		return;
	log->asking = false;
	log->next = 1;
	log->past = true;
	g_array_set_size(log->events, 0);
	if (g_strcmp0(log->where, ladder_board_link_where(link)) == 0)
		return;
	g_free(log->where);
	log->where = g_strdup(ladder_board_link_where(link));
	log->last_ns = 0;
}

void online_log_init(struct online_log *log, struct core *core)
{
	log->core = core;
	log->next = 1;
	log->past = true;
	log->events = g_array_new(FALSE, FALSE, sizeof(struct event));
	core_connect(core, core->link, "state-changed", G_CALLBACK(state_changed), log,
		     G_CONNECT_SWAPPED);
	core_connect(core, core->link, "status", G_CALLBACK(ask), log, G_CONNECT_SWAPPED);
}

void online_log_clear(struct online_log *log)
{
	g_clear_pointer(&log->where, g_free);
	g_clear_pointer(&log->events, g_array_unref);
}
